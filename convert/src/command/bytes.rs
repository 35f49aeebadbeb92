//! The bytes of an input in memory of their own.
//!
//! A long input is most of what is resident while it is parsed. It is read into pages mapped for
//! it alone, large ones where the system has them: a page fault then costs 2 MiB, not 4 KiB, and
//! the pages go back at once. The file itself is not mapped, so that whoever changes it while it
//! is read changes nothing here.

use std::fs::File;
use std::io::{self, Read};
use std::ops::Deref;
use std::path::Path;

use memmap2::MmapMut;

/// Longest input read: one byte more than the parser takes, so that it can say so.
const MAX_BYTES: u64 = 1 << 32;

/// Inputs at least this long get pages of their own: two large ones.
const LONG_BYTES: usize = 4 << 20;

/// The bytes of a file; dereferences to them.
pub enum Bytes {
    /// In pages of their own, of which the first so many bytes count.
    Pages(MmapMut, usize),
    /// On the heap.
    Heap(Vec<u8>),
}

impl Deref for Bytes {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        match self {
            Self::Pages(pages, len) => &pages[..*len],
            Self::Heap(bytes) => bytes,
        }
    }
}

impl Bytes {
    /// The same bytes on the heap.
    ///
    /// # Errors
    ///
    /// In words, when there is no room for them.
    pub fn into_vec(self) -> Result<Vec<u8>, String> {
        match self {
            Self::Heap(bytes) => Ok(bytes),
            Self::Pages(ref pages, len) => {
                let mut bytes = room_for(len).map_err(|error| error.to_string())?;
                bytes.extend_from_slice(&pages[..len]);
                Ok(bytes)
            }
        }
    }
}

/// The bytes of an input.
///
/// # Errors
///
/// What the system says, in words.
pub fn read(path: &Path) -> Result<Bytes, String> {
    let cannot = |error: io::Error| format!("cannot be read: {error}");
    let file = File::open(path).map_err(cannot)?;
    let length = file.metadata().map_err(cannot)?.len();
    read_all(&mut file.take(MAX_BYTES), length).map_err(cannot)
}

/// All bytes of a stream that says it has `length` of them, and may have more or less.
fn read_all(stream: &mut impl Read, length: u64) -> io::Result<Bytes> {
    let length = length.min(MAX_BYTES) as usize;
    let pages = (length >= LONG_BYTES).then(|| new_pages(length));
    if let Some(Ok(mut pages)) = pages {
        let len = fill(stream, &mut pages)?;
        if len < pages.len() {
            return Ok(Bytes::Pages(pages, len));
        }
        // The file has grown: room for all of it is not known.
        let mut bytes = room_for(len)?;
        bytes.extend_from_slice(&pages);
        drop(pages);
        stream.read_to_end(&mut bytes)?;
        return Ok(Bytes::Heap(bytes));
    }
    let mut bytes = room_for(length)?;
    stream.read_to_end(&mut bytes)?;
    Ok(Bytes::Heap(bytes))
}

/// Memory for `length` bytes and one more, by which the end of the file shows.
fn new_pages(length: usize) -> io::Result<MmapMut> {
    let pages = MmapMut::map_anon(length + 1)?;
    // Only advice: small pages do as well.
    #[cfg(target_os = "linux")]
    let _ = pages.advise(memmap2::Advice::HugePage);
    Ok(pages)
}

/// An empty list with room; a failed reservation would end the process in `read_to_end`.
fn room_for(length: usize) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    bytes
        .try_reserve_exact(length)
        .map_err(|_| io::Error::other("there is not enough memory"))?;
    Ok(bytes)
}

/// Reads until the end of the stream or of `room`; returns how many bytes there were.
fn fill(stream: &mut impl Read, room: &mut [u8]) -> io::Result<usize> {
    let mut len = 0;
    while len < room.len() {
        match stream.read(&mut room[len..]) {
            Ok(0) => break,
            Ok(count) => len += count,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(len)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_whole_whatever_length_it_claims() {
        for (length, claimed) in [
            (0, 0),
            (100, 100),
            (100, 0),
            (LONG_BYTES, LONG_BYTES),
            (LONG_BYTES, LONG_BYTES + 5000),
            (LONG_BYTES + 5000, LONG_BYTES),
            (LONG_BYTES + 1, LONG_BYTES),
            (10, LONG_BYTES),
            (LONG_BYTES, 10),
        ] {
            let bytes: Vec<u8> = (0..length).map(|i| (i % 251) as u8).collect();
            let read = read_all(&mut &bytes[..], claimed as u64).unwrap();
            assert!(*read == bytes, "{length} bytes of {claimed}");
        }
    }
}
