//! How many components the pictures of `ImageTexture` have, by the first bytes of their files. It
//! decides what a texture of VRML 2 does to the colours under it (ISO 14772-1, 4.14). Nothing is
//! decoded; what cannot be told is left open.

use std::path::PathBuf;
use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::Builder;
use crate::graph::NodeId;
use crate::registry::Class;

/// Bytes in which a picture says what it is; profiles and thumbnails can stand before that.
const BEGINNING: u64 = 256 << 10;

/// Most files that are looked at.
const MAX_FILES: usize = 10_000;

impl Builder<'_> {
    /// Looks at the pictures of all textures.
    pub(super) fn look_at_pictures(&mut self) -> FxHashMap<NodeId, u8> {
        let mut by_name: FxHashMap<(u32, Arc<str>), Option<u8>> = FxHashMap::default();
        let mut by_file: FxHashMap<PathBuf, Option<u8>> = FxHashMap::default();
        let mut found = FxHashMap::default();
        for (i, node) in self.nodes.iter().enumerate() {
            if node.class() != Some(Class::VRMLImageTexture) {
                continue;
            }
            let Some(name) = picture_name(node.value("url").texts()) else {
                continue;
            };
            let file = node.pos.file;
            let components = *by_name.entry((file, Arc::clone(name))).or_insert_with(|| {
                let folder = &self.files[file as usize].folder;
                let loader = self.includes.loader();
                let id = loader.find(folder, name).ok()?;
                if by_file.len() >= MAX_FILES && !by_file.contains_key(&id) {
                    return None;
                }
                let look = |id: &PathBuf| components(&loader.beginning(id, BEGINNING).ok()?);
                *by_file.entry(id.clone()).or_insert_with(|| look(&id))
            });
            found.extend(components.map(|n| (NodeId(i as u32), n)));
        }
        found
    }
}

/// Of several places the first one that is no web address, else the first.
pub(crate) fn picture_name(urls: &[Arc<str>]) -> Option<&Arc<str>> {
    let local = urls.iter().find(|url| !url.contains("://"));
    local.or(urls.first())
}

/// 1 grey, 2 grey with alpha, 3 colours, 4 colours with alpha.
fn components(bytes: &[u8]) -> Option<u8> {
    match bytes {
        [0x89, b'P', b'N', b'G', 0x0d, 0x0a, 0x1a, 0x0a, ..] => png(bytes),
        [0xff, 0xd8, 0xff, ..] => jpeg(bytes),
        // SGI's: the size of the third axis.
        [0x01, 0xda, ..] => match bytes.get(10..12)? {
            [0, n @ 1..=4] => Some(*n),
            _ => None,
        },
        _ => None,
    }
}

/// The colour type (PNG, 11.2.2), and whether there is a `tRNS` before the pixels.
fn png(bytes: &[u8]) -> Option<u8> {
    let has_transparency = || {
        let mut at = 8_usize;
        while let Some(head) = bytes.get(at..at + 8) {
            let (length, name) = head.split_at(4);
            match name {
                b"tRNS" => return true,
                b"IDAT" => return false,
                _ => {}
            }
            let length = u32::from_be_bytes(length.try_into().unwrap_or_default());
            // The length, the name and a check sum stand around a chunk.
            at = at.saturating_add(length as usize).saturating_add(12);
            if at > bytes.len() {
                return false;
            }
        }
        false
    };
    match bytes.get(25)? {
        0 => Some(1 + u8::from(has_transparency())),
        2 | 3 => Some(3 + u8::from(has_transparency())),
        4 => Some(2),
        6 => Some(4),
        _ => None,
    }
}

/// The number of components in the frame header (ITU T.81, B.2.2).
fn jpeg(bytes: &[u8]) -> Option<u8> {
    let mut at = 2_usize;
    loop {
        match *bytes.get(at..at + 10)? {
            [0xff, 0xff, ..] => at += 1,
            [0xff, 0x01 | 0xd0..=0xd8, ..] => at += 2,
            // Frame headers; the other three are tables.
            [
                0xff,
                0xc0..=0xc3 | 0xc5..=0xc7 | 0xc9..=0xcb | 0xcd..=0xcf,
                ..,
                count,
            ] => {
                return match count {
                    1 => Some(1),
                    3 | 4 => Some(3),
                    _ => None,
                };
            }
            [0xff, 0xd9 | 0xda, ..] => return None,
            [0xff, _, high, low, ..] => {
                at += 2 + usize::from(u16::from_be_bytes([high, low]).max(2));
            }
            _ => return None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_say_how_many_components_they_have() {
        let png = |kind: u8, chunk: &[u8]| {
            let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x01\0\0\0\x01\x08".to_vec();
            bytes.extend([kind, 0, 0, 0, 1, 2, 3, 4]);
            bytes.extend_from_slice(chunk);
            bytes.extend(b"\0\0\0\0IDAT\0\0\0\0tRNS");
            bytes
        };
        let transparent = b"\0\0\0\x02tRNS\0\0\x01\x02\x03\x04";
        let jpeg = |count: u8| {
            let mut bytes =
                b"\xff\xd8\xff\xe0\0\x04ab\xff\xff\xc4\0\x02\xff\xc2\0\x0b\x08\0\x01\0\x01"
                    .to_vec();
            bytes.extend([count, 0, 0, 0]);
            bytes
        };
        let rows = [
            (png(0, b""), Some(1)),
            (png(0, transparent), Some(2)),
            (png(2, b""), Some(3)),
            (png(3, transparent), Some(4)),
            (png(4, b""), Some(2)),
            (png(6, b""), Some(4)),
            (png(7, b""), None),
            (jpeg(1), Some(1)),
            (jpeg(3), Some(3)),
            (
                b"\x01\xda\x01\x01\0\x03\0\x10\0\x10\0\x02".to_vec(),
                Some(2),
            ),
            (b"GIF89a".to_vec(), None),
            (Vec::new(), None),
        ];
        for (bytes, wanted) in rows {
            assert_eq!(components(&bytes), wanted, "{bytes:?}");
            for len in 0..bytes.len() {
                components(&bytes[..len]);
            }
        }
    }
}
