//! gzip and bzip2: one stream, or several in a row.

use std::io::Read;

use bzip2::read::MultiBzDecoder;
use flate2::read::MultiGzDecoder;

use crate::limits::drain;
use crate::{Error, Format, Limits};

/// What a stream held.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unpacked {
    /// Its bytes, as far as they came out.
    pub bytes: Vec<u8>,
    /// Why they are not all, if they are not.
    pub damage: Option<String>,
}

/// Most streams within each other. A file that was packed once more by a server or a mail program
/// is packed twice.
const MAX_LAYERS: u32 = 4;

/// Unpacks a gzip or bzip2 stream, and streams in it; `None` for bytes that are neither. What comes
/// out is no stream any more. A stream that breaks off gives what came out before.
///
/// # Errors
///
/// When nothing came out, or more than the limits allow, all streams together.
pub fn unpack(bytes: &[u8], limits: &Limits) -> Option<Result<Unpacked, Error>> {
    let mut stream = decoder(bytes)?;
    let packed = bytes.len() as u64;
    let mut unpacked = match layer(&mut *stream, packed, 0, limits) {
        Ok(unpacked) => unpacked,
        Err(error) => return Some(Err(error)),
    };
    let mut total = unpacked.bytes.len() as u64;
    let mut layers = 1;
    loop {
        let Some(mut stream) = decoder(&unpacked.bytes) else {
            return Some(Ok(unpacked));
        };
        if layers == MAX_LAYERS {
            return Some(Err(Error::TooManyLayers { limit: MAX_LAYERS }));
        }
        layers += 1;
        let inner = match layer(&mut *stream, packed, total, limits) {
            Ok(inner) => inner,
            Err(error) => return Some(Err(error)),
        };
        drop(stream);
        total += inner.bytes.len() as u64;
        unpacked = Unpacked {
            bytes: inner.bytes,
            damage: unpacked.damage.or(inner.damage),
        };
    }
}

fn decoder(bytes: &[u8]) -> Option<Box<dyn Read + '_>> {
    match Format::of(bytes)? {
        Format::Gzip => Some(Box::new(MultiGzDecoder::new(bytes))),
        Format::Bzip2 => Some(Box::new(MultiBzDecoder::new(bytes))),
        Format::Zip => None,
    }
}

/// What one stream holds. The input has `packed` bytes, out of which `before` came before.
fn layer(
    stream: &mut dyn Read,
    packed: u64,
    before: u64,
    limits: &Limits,
) -> Result<Unpacked, Error> {
    // Text is packed to about a fifth.
    let drained = drain(stream, packed, before, 5 * packed, limits)?;
    match drained.fault {
        Some(fault) if drained.bytes.is_empty() => Err(Error::Damaged(fault.to_string())),
        fault => Ok(Unpacked {
            bytes: drained.bytes,
            damage: fault.map(|fault| fault.to_string()),
        }),
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use std::io::Write;

    pub(crate) fn gzip(bytes: &[u8]) -> Vec<u8> {
        let mut out = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
        out.write_all(bytes).unwrap();
        out.finish().unwrap()
    }

    fn bzip2(bytes: &[u8]) -> Vec<u8> {
        let mut out = ::bzip2::write::BzEncoder::new(Vec::new(), ::bzip2::Compression::best());
        out.write_all(bytes).unwrap();
        out.finish().unwrap()
    }

    fn noise(len: usize) -> Vec<u8> {
        let mut state = 7_u32;
        let next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as u8
        };
        std::iter::repeat_with(next).take(len).collect()
    }

    #[test]
    fn what_was_packed_comes_out() {
        for bytes in [vec![], b"Cube { }".to_vec(), noise(200_000)] {
            for packed in [gzip(&bytes), bzip2(&bytes)] {
                let twice = [&packed[..], &packed].concat();
                for (packed, times) in [(packed, 1), (twice, 2)] {
                    let out = unpack(&packed, &Limits::default()).unwrap().unwrap();
                    assert_eq!(out.damage, None);
                    assert!(out.bytes == bytes.repeat(times));
                }
            }
        }
        assert_eq!(unpack(b"#Inventor", &Limits::default()), None);
        assert_eq!(unpack(b"", &Limits::default()), None);
    }

    #[test]
    fn streams_in_streams_come_out_whole() {
        let bytes = noise(100_000);
        let mut packed = bytes.clone();
        for layers in 1..=MAX_LAYERS + 1 {
            packed = match layers % 2 {
                0 => bzip2(&packed),
                _ => gzip(&packed),
            };
            let out = unpack(&packed, &Limits::default()).unwrap();
            match layers <= MAX_LAYERS {
                true => assert!(out.unwrap().bytes == bytes, "{layers} layers"),
                false => assert_eq!(out, Err(Error::TooManyLayers { limit: MAX_LAYERS })),
            }
        }
        // All that comes out counts.
        let twice = gzip(&gzip(&bytes));
        let limit = 150_000;
        let out = unpack(&twice, &Limits::of_bytes(limit)).unwrap();
        assert_eq!(out, Err(Error::TooLong { limit }));
        let inner_cut = gzip(&gzip(&bytes)[..50_000]);
        let out = unpack(&inner_cut, &Limits::default()).unwrap().unwrap();
        assert!(out.damage.is_some() && bytes.starts_with(&out.bytes));
    }

    #[test]
    fn what_is_cut_off_gives_its_beginning() {
        let bytes = noise(2_000_000);
        for packed in [gzip(&bytes), bzip2(&bytes)] {
            let half = &packed[..packed.len() / 2];
            let out = unpack(half, &Limits::default()).unwrap().unwrap();
            assert!(out.damage.is_some());
            assert!(!out.bytes.is_empty() && bytes.starts_with(&out.bytes));
            for len in 2..20 {
                if let Some(Ok(out)) = unpack(&packed[..len], &Limits::default()) {
                    assert!(bytes.starts_with(&out.bytes));
                }
            }
        }
    }

    #[test]
    fn too_much_is_refused() {
        let zeros = vec![0; 80 << 20];
        for packed in [gzip(&zeros), bzip2(&zeros)] {
            let length = |limits| {
                let out = unpack(&packed, &limits).unwrap();
                out.map(|out| out.bytes.len())
            };
            let limit = 70 << 20;
            assert_eq!(length(Limits::default()), Err(Error::Bomb { ratio: 200 }));
            assert_eq!(
                length(Limits::of_bytes(limit)),
                Err(Error::TooLong { limit })
            );
            assert_eq!(length(Limits::of_bytes(100 << 20)), Ok(zeros.len()));
        }
    }
}
