//! A stream in blocks: what is written goes on in pieces that all begin at a multiple of the block
//! size. Systems take whole pages of a file with less work than parts of them, which is what
//! [`std::io::BufWriter`] gives them: it empties its buffer when the next piece does not fit.

use std::io::{self, Write};

const BLOCK_BYTES: usize = 1 << 16;

/// A stream in blocks. What is not flushed is lost.
pub(crate) struct Blocks<W> {
    out: W,
    /// The beginning of the next block; never full.
    block: Vec<u8>,
}

impl<W: Write> Blocks<W> {
    pub(crate) fn new(out: W) -> Self {
        Self {
            out,
            block: Vec::with_capacity(BLOCK_BYTES),
        }
    }

    /// The stream behind, with all that was written.
    pub(crate) fn finish(mut self) -> io::Result<W> {
        self.flush()?;
        Ok(self.out)
    }

    fn write_block(&mut self) -> io::Result<()> {
        self.out.write_all(&self.block)?;
        self.block.clear();
        Ok(())
    }
}

impl<W: Write> Write for Blocks<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let whole = bytes.len() - bytes.len() % BLOCK_BYTES;
        if self.block.is_empty() && whole > 0 {
            self.out.write_all(&bytes[..whole])?;
            return Ok(whole);
        }
        let count = bytes.len().min(BLOCK_BYTES - self.block.len());
        self.block.extend_from_slice(&bytes[..count]);
        if self.block.len() == BLOCK_BYTES {
            self.write_block()?;
        }
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.write_block()?;
        self.out.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Remembers where each piece began.
    #[derive(Default)]
    struct Pieces {
        bytes: Vec<u8>,
        starts: Vec<usize>,
    }

    impl Write for Pieces {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.starts.push(self.bytes.len());
            self.bytes.extend_from_slice(bytes);
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn all_arrives_in_whole_blocks() {
        let all: Vec<u8> = (0..5 * BLOCK_BYTES + 77).map(|i| (i % 253) as u8).collect();
        for piece in [
            1000,
            BLOCK_BYTES - 1,
            BLOCK_BYTES,
            BLOCK_BYTES + 1,
            all.len(),
        ] {
            let mut out = Blocks::new(Pieces::default());
            for part in all.chunks(piece) {
                out.write_all(part).unwrap();
            }
            let out = out.finish().unwrap();
            assert!(out.bytes == all, "pieces of {piece}");
            let aligned = |start: &usize| start.is_multiple_of(BLOCK_BYTES);
            assert!(out.starts.iter().all(aligned), "pieces of {piece}");
        }
    }
}
