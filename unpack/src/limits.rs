//! How much may come out, and the loop that watches it.

use std::io::{self, Read};

use crate::Error;

/// How much may come out of one input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes in all.
    pub bytes: u64,
    /// How often the packed bytes may fit into the unpacked ones. Text models are packed to a
    /// tenth, repetitive ones to a hundredth.
    pub ratio: u64,
}

impl Limits {
    /// Of a usual model's size nothing is thought: the ratio counts beyond that.
    pub const FREE_BYTES: u64 = 64 << 20;

    /// So many bytes whatever they are packed in, as somebody wants it.
    pub fn of_bytes(bytes: u64) -> Self {
        Self {
            bytes,
            ratio: u64::MAX,
        }
    }

    /// Whether so many bytes may come out of `packed` ones.
    fn check(&self, packed: u64, unpacked: u64) -> Result<(), Error> {
        if unpacked > self.bytes {
            return Err(Error::TooLong { limit: self.bytes });
        }
        if unpacked > Self::FREE_BYTES && unpacked / self.ratio > packed {
            return Err(Error::Bomb { ratio: self.ratio });
        }
        Ok(())
    }
}

impl Default for Limits {
    /// 1 GiB, and 200 times the packed length.
    fn default() -> Self {
        Self {
            bytes: 1 << 30,
            ratio: 200,
        }
    }
}

/// What came out of a stream, and why it ended before its end.
pub(crate) struct Drained {
    pub bytes: Vec<u8>,
    pub fault: Option<io::Error>,
}

/// Reads a stream that unpacks `packed` bytes, behind `before` bytes that count too. `expected` is
/// how much it says to hold.
pub(crate) fn drain(
    stream: &mut dyn Read,
    packed: u64,
    before: u64,
    expected: u64,
    limits: &Limits,
) -> Result<Drained, Error> {
    /// Room made at once on the stream's word.
    const TRUSTED: u64 = 16 << 20;
    let mut bytes = Vec::new();
    reserve(&mut bytes, expected.min(TRUSTED) as usize)?;
    let mut chunk = [0; 1 << 16];
    loop {
        match stream.read(&mut chunk) {
            Ok(0) => return Ok(Drained { bytes, fault: None }),
            Ok(count) => {
                let unpacked = before + bytes.len() as u64 + count as u64;
                limits.check(packed, unpacked)?;
                reserve(&mut bytes, count)?;
                bytes.extend_from_slice(&chunk[..count]);
            }
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => {
                return Ok(Drained {
                    bytes,
                    fault: Some(error),
                });
            }
        }
    }
}

fn reserve(bytes: &mut Vec<u8>, more: usize) -> Result<(), Error> {
    bytes.try_reserve(more).map_err(|_| Error::NoMemory)
}
