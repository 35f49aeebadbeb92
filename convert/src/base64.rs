//! Base64 (RFC 4648, with padding) of what is written.

use std::io::{self, Write};

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
/// Bytes turned at a time; a multiple of three.
const BLOCK: usize = 3 * 4096;

/// Length of `bytes` bytes as text.
pub(crate) fn text_len(bytes: u64) -> u64 {
    bytes.div_ceil(3) * 4
}

/// A stream that goes on as text. [`Base64::finish`] writes the last of it.
pub(crate) struct Base64<W> {
    out: W,
    waiting: Vec<u8>,
    text: Vec<u8>,
}

impl<W: Write> Base64<W> {
    pub(crate) fn new(out: W) -> Self {
        Self {
            out,
            waiting: Vec::with_capacity(BLOCK),
            text: Vec::new(),
        }
    }

    pub(crate) fn finish(mut self) -> io::Result<W> {
        self.write_waiting()?;
        Ok(self.out)
    }

    fn write_waiting(&mut self) -> io::Result<()> {
        self.text.clear();
        let (triples, rest) = self.waiting.as_chunks::<3>();
        let digits = |[a, b, c]: [u8; 3]| {
            let bits = u32::from_be_bytes([0, a, b, c]);
            [18, 12, 6, 0].map(|shift| DIGITS[(bits >> shift & 63) as usize])
        };
        self.text
            .extend(triples.iter().flat_map(|&triple| digits(triple)));
        match *rest {
            [a] => {
                let [first, second, ..] = digits([a, 0, 0]);
                self.text.extend([first, second, b'=', b'=']);
            }
            [a, b] => {
                let [first, second, third, _] = digits([a, b, 0]);
                self.text.extend([first, second, third, b'=']);
            }
            _ => {}
        }
        self.waiting.clear();
        self.out.write_all(&self.text)
    }
}

impl<W: Write> Write for Base64<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = bytes.len().min(BLOCK - self.waiting.len());
        self.waiting.extend_from_slice(&bytes[..count]);
        if self.waiting.len() == BLOCK {
            self.write_waiting()?;
        }
        Ok(count)
    }

    /// What does not fill three bytes waits for more.
    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_vectors_of_rfc_4648() {
        for (bytes, want) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ] {
            let mut out = Base64::new(Vec::new());
            out.write_all(bytes.as_bytes()).unwrap();
            assert_eq!(out.finish().unwrap(), want.as_bytes());
            assert_eq!(text_len(bytes.len() as u64), want.len() as u64);
        }
        let long = vec![0xfb; 3 * BLOCK + 2];
        let mut out = Base64::new(Vec::new());
        for part in long.chunks(1000) {
            out.write_all(part).unwrap();
        }
        let text = out.finish().unwrap();
        assert!(text.starts_with(b"+/v7+/v7") && text.ends_with(b"+/s="));
        assert_eq!(text.len() as u64, text_len(long.len() as u64));
    }
}
