//! The bytes that accessors and images lie in: the binary chunk, data URIs, and files, which only
//! the caller's loader opens.

use std::path::Path;
use std::rc::Rc;

use gltf::json::Index;
use gltf::json::buffer::View;
use rustc_hash::FxHashMap;
use scenegraph::Loader;

use super::budget::Budget;
use super::compressed::{self, Compressed};
use super::document::Document;
use super::error::ReadError;

/// All buffers, each read once. One that is not to be had is an error where it is used.
pub(crate) struct Buffers<'b> {
    contents: Vec<Content<'b>>,
    /// By view: its bytes, where they are compressed in the file; `None` within if they are broken.
    decoded: FxHashMap<usize, Option<Vec<u8>>>,
}

enum Content<'b> {
    Chunk(&'b [u8]),
    Read(Rc<Vec<u8>>),
    Missing(String),
}

impl<'b> Buffers<'b> {
    pub(crate) fn new(
        document: &Document<'b>,
        beside: &Path,
        loader: &dyn Loader,
        budget: &mut Budget,
    ) -> Result<Self, ReadError> {
        let mut known: FxHashMap<&str, Rc<Vec<u8>>> = FxHashMap::default();
        let mut contents = Vec::with_capacity(document.root.buffers.len());
        for (i, buffer) in document.root.buffers.iter().enumerate() {
            contents.push(match (&buffer.uri, document.bin) {
                (None, Some(bin)) if i == 0 => Content::Chunk(bin),
                (None, _) => Content::Missing("it has neither data nor a name".to_owned()),
                (Some(uri), _) => match known.get(uri.as_str()) {
                    Some(bytes) => Content::Read(Rc::clone(bytes)),
                    None => match read(uri, beside, loader) {
                        Ok(bytes) => {
                            budget.grow(bytes.len() as u64)?;
                            let bytes = Rc::new(bytes);
                            known.insert(uri, Rc::clone(&bytes));
                            Content::Read(bytes)
                        }
                        Err(reason) => Content::Missing(reason),
                    },
                },
            });
        }
        let mut buffers = Self {
            contents,
            decoded: FxHashMap::default(),
        };
        buffers.decode(document, budget)?;
        Ok(buffers)
    }

    fn decode(&mut self, document: &Document, budget: &mut Budget) -> Result<(), ReadError> {
        for (i, view) in document.root.buffer_views.iter().enumerate() {
            let extensions = view.extensions.as_ref();
            let mut named = compressed::NAMES.into_iter();
            let Some(extension) = named.find_map(|n| extensions?.others.get(n)) else {
                continue;
            };
            let decoded = match Compressed::of(extension) {
                Some(compressed) => {
                    budget.take(compressed.decoded_len())?;
                    self.compressed_bytes(&compressed)
                        .and_then(|bytes| compressed.decode(bytes))
                }
                None => None,
            };
            self.decoded.insert(i, decoded);
        }
        Ok(())
    }

    fn compressed_bytes(&self, compressed: &Compressed) -> Option<&[u8]> {
        let bytes = match self.contents.get(compressed.buffer)? {
            Content::Chunk(bytes) => bytes,
            Content::Read(bytes) => bytes.as_slice(),
            Content::Missing(_) => return None,
        };
        slice(bytes, compressed.byte_offset, compressed.byte_length)
    }

    /// The bytes of a buffer view, and the stride it states.
    pub(crate) fn view(
        &self,
        document: &Document,
        index: Index<View>,
    ) -> Result<(&[u8], Option<usize>), ReadError> {
        let broken = |reason| ReadError::broken("buffer view", index.value(), reason);
        let view = document
            .root
            .get(index)
            .ok_or(broken("it does not exist"))?;
        let stride = view.byte_stride.map(|stride| stride.0);
        match self.decoded.get(&index.value()) {
            Some(Some(bytes)) => return Ok((bytes, stride)),
            Some(None) => return Err(broken("its compressed bytes are broken")),
            None => {}
        }
        let buffer = view.buffer.value();
        let bytes = match self.contents.get(buffer) {
            None => return Err(broken("its buffer does not exist")),
            Some(Content::Chunk(bytes)) => bytes,
            Some(Content::Read(bytes)) => bytes.as_slice(),
            Some(Content::Missing(reason)) => {
                return Err(ReadError::Buffer {
                    index: buffer,
                    reason: reason.clone(),
                });
            }
        };
        let start = view.byte_offset.map_or(0, |offset| offset.0);
        let range = slice(bytes, start, view.byte_length.0);
        let bytes = range.ok_or(broken("it reaches beyond its buffer"))?;
        Ok((bytes, stride))
    }
}

/// A part of some bytes, if it lies within.
pub(crate) fn slice(bytes: &[u8], start: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(start).ok()?;
    let length = usize::try_from(length).ok()?;
    bytes.get(start..start.checked_add(length)?)
}

fn read(uri: &str, beside: &Path, loader: &dyn Loader) -> Result<Vec<u8>, String> {
    if let Some(data) = data_uri(uri) {
        return data.ok_or_else(|| "its data URI is not base64".to_owned());
    }
    let name = unescaped(uri);
    match loader.load(beside, &name) {
        Ok(loaded) => Ok(loaded.bytes),
        Err(why) => Err(format!("{name}: {why}")),
    }
}

/// The bytes of a data URI (RFC 2397); `None` for another URI, and within, for other than base64.
pub(crate) fn data_uri(uri: &str) -> Option<Option<Vec<u8>>> {
    let rest = uri.strip_prefix("data:")?;
    let data = rest
        .split_once(',')
        .and_then(|(kind, data)| kind.ends_with(";base64").then(|| base64(data.as_bytes())));
    Some(data.flatten())
}

/// RFC 4648, the standard alphabet; padding may be missing.
pub(crate) fn base64(text: &[u8]) -> Option<Vec<u8>> {
    let padding = text.iter().rev().take_while(|&&b| b == b'=').count();
    let digits = &text[..text.len() - padding];
    let mut bytes = Vec::with_capacity(digits.len() / 4 * 3 + 2);
    let (mut bits, mut count) = (0_u32, 0);
    for &digit in digits {
        let value = match digit {
            b'A'..=b'Z' => digit - b'A',
            b'a'..=b'z' => digit - b'a' + 26,
            b'0'..=b'9' => digit - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => return None,
        };
        bits = bits << 6 | u32::from(value);
        count += 6;
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
            bits &= (1 << count) - 1;
        }
    }
    (digits.len() % 4 != 1).then_some(bytes)
}

/// A URI's name with percent-encoding undone; what does not decode stays as it is.
pub(crate) fn unescaped(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, tail)) = rest.split_first() {
        let hex = |b: u8| char::from(b).to_digit(16);
        let code = match (first, tail) {
            (b'%', [high, low, ..]) => hex(*high).zip(hex(*low)),
            _ => None,
        };
        match code {
            Some((high, low)) => {
                bytes.push((high * 16 + low) as u8);
                rest = &tail[2..];
            }
            None => {
                bytes.push(first);
                rest = tail;
            }
        }
    }
    String::from_utf8(bytes).unwrap_or_else(|_| uri.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_as_in_rfc_4648() {
        for (text, want) in [
            ("", Some(&b""[..])),
            ("Zg==", Some(b"f")),
            ("Zg", Some(b"f")),
            ("Zm8=", Some(b"fo")),
            ("Zm9v", Some(b"foo")),
            ("Zm9vYmFy", Some(b"foobar")),
            ("+/+/", Some(&[0xfb, 0xff, 0xbf])),
            ("Z", None),
            ("Zm9vY", None),
            ("Zm 9v", None),
            ("Z=m8", None),
        ] {
            assert_eq!(base64(text.as_bytes()).as_deref(), want, "{text}");
        }
    }

    #[test]
    fn names_in_uris_are_unescaped() {
        for (uri, want) in [
            ("a%20b%25.bin", "a b%.bin"),
            ("t%C3%BCr.bin", "tür.bin"),
            ("100%.bin", "100%.bin"),
            ("%4", "%4"),
            ("%+1", "%+1"),
            ("%FF", "%FF"),
        ] {
            assert_eq!(unescaped(uri), want);
        }
    }
}
