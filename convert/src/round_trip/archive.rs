//! The source of a model in a glTF file: its text, what it includes, and images of which the file
//! has no equal copy. It stands as compressed base64 in `extras.iv.source` of the scene, which
//! other tools keep.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use flate2::Compression;
use flate2::Crc;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;
use rustc_hash::FxHashMap;
use scenegraph::{LoadError, Loader};
use serde_json::{Map, Value, json};

use super::paths::candidates;

/// Version of the form.
const VERSION: u64 = 1;
/// Most bytes that a source may have when it is unpacked: as much as a parser takes.
const MAX_BYTES: u64 = u32::MAX as u64;
/// Beyond what is free, so often may the packed bytes fit into the unpacked ones.
const MAX_RATIO: u64 = 200;
/// Most files of a source.
const MAX_FILES: usize = 100_000;

/// The bytes of one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Content {
    /// Here.
    Here(Arc<[u8]>),
    /// The glTF file's image of this number, as long as it has this checksum.
    Image { index: usize, crc: u32 },
}

/// A source: the model's text first, under the empty path.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Archive {
    pub(crate) files: Vec<(String, Content)>,
    /// Checksum and length of the `.glb` that was made of it, with null for this source in it.
    pub(crate) glb: (u32, u64),
    /// The choices it was made with: see `made`.
    pub(crate) made: Value,
}

pub(crate) fn crc(bytes: &[u8]) -> u32 {
    let mut crc = Crc::new();
    crc.update(bytes);
    crc.sum()
}

impl Archive {
    /// As JSON text.
    pub(crate) fn pack(&self) -> std::io::Result<String> {
        let mut files = Vec::new();
        for (path, content) in &self.files {
            let mut file = Map::new();
            if !path.is_empty() {
                file.insert("path".to_owned(), path.as_str().into());
            }
            match content {
                Content::Here(bytes) => {
                    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
                    encoder.write_all(bytes)?;
                    file.insert("bytes".to_owned(), bytes.len().into());
                    file.insert("deflate".to_owned(), base64(&encoder.finish()?).into());
                }
                Content::Image { index, crc } => {
                    file.insert("image".to_owned(), (*index).into());
                    file.insert("crc32".to_owned(), (*crc).into());
                }
            }
            files.push(Value::Object(file));
        }
        let (crc, length) = self.glb;
        let mut source = json!({
            "version": VERSION,
            "files": files,
            "glb": { "crc32": crc, "bytes": length },
        });
        if !self.made.is_null() {
            source["made"] = self.made.clone();
        }
        Ok(source.to_string())
    }

    /// From JSON; says what is wrong with it.
    pub(crate) fn unpack(source: &Value) -> Result<Self, String> {
        if source["version"].as_u64() != Some(VERSION) {
            return Err("it is of another version".to_owned());
        }
        let none = Vec::new();
        let list = source["files"].as_array().unwrap_or(&none);
        if list.len() > MAX_FILES {
            return Err("it has too many files".to_owned());
        }
        let mut left = MAX_BYTES;
        let mut files = Vec::new();
        for file in list {
            let path = file["path"].as_str().unwrap_or_default();
            let is_root = files.is_empty();
            if is_root != path.is_empty() || !super::paths::is_clean(path) {
                return Err("it names files outside its folder".to_owned());
            }
            files.push((path.to_owned(), unpack_file(file, &mut left)?));
        }
        if !matches!(files.first(), Some((_, Content::Here(_)))) {
            return Err("it has no text".to_owned());
        }
        let number = |value: &Value| value.as_u64().unwrap_or_default();
        let glb = &source["glb"];
        let crc = u32::try_from(number(&glb["crc32"])).unwrap_or_default();
        Ok(Self {
            files,
            glb: (crc, number(&glb["bytes"])),
            made: source["made"].clone(),
        })
    }

    /// The model's text.
    pub(crate) fn root(&self) -> &[u8] {
        match self.files.first() {
            Some((_, Content::Here(bytes))) => bytes,
            _ => &[],
        }
    }
}

fn unpack_file(file: &Value, left: &mut u64) -> Result<Content, String> {
    if let Some(index) = file["image"].as_u64() {
        let crc = file["crc32"]
            .as_u64()
            .and_then(|crc| u32::try_from(crc).ok());
        let index = usize::try_from(index).unwrap_or(usize::MAX);
        let crc = crc.ok_or("an image has no checksum")?;
        return Ok(Content::Image { index, crc });
    }
    let length = file["bytes"].as_u64().ok_or("a file has no length")?;
    *left = left.checked_sub(length).ok_or("it is too long")?;
    let packed = file["deflate"]
        .as_str()
        .and_then(|text| crate::read::base64(text.as_bytes()));
    let packed = packed.ok_or("a file is not base64")?;
    if length > unpack::Limits::FREE_BYTES.max(MAX_RATIO * packed.len() as u64) {
        return Err("a file is packed too well to be a model".to_owned());
    }
    let mut bytes = Vec::new();
    // A byte more than it says tells a lie.
    let mut decoder = DeflateDecoder::new(&packed[..]).take(length + 1);
    let read = decoder.read_to_end(&mut bytes);
    match read {
        Ok(count) if count as u64 == length => Ok(Content::Here(bytes.into())),
        _ => Err("a file does not unpack".to_owned()),
    }
}

/// RFC 4648, the standard alphabet.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let [a, b, c] = [0, 1, 2].map(|i| u32::from(chunk.get(i).copied().unwrap_or_default()));
        let word = a << 16 | b << 8 | c;
        for i in 0..4 {
            let digit = DIGITS[(word >> (18 - 6 * i)) as usize & 63];
            text.push(if i <= chunk.len() {
                char::from(digit)
            } else {
                '='
            });
        }
    }
    text
}

/// The files of an unpacked source; images are those of the glTF file it came with.
pub(crate) struct Unpacked {
    files: Vec<(String, Arc<[u8]>)>,
    /// By path, the first of equals.
    by_path: FxHashMap<String, usize>,
}

impl Unpacked {
    /// The model's text first.
    pub(crate) fn new(files: Vec<(String, Arc<[u8]>)>) -> Self {
        let mut by_path = FxHashMap::default();
        for (i, (path, _)) in files.iter().enumerate() {
            by_path.entry(path.clone()).or_insert(i);
        }
        Self { files, by_path }
    }

    pub(crate) fn files(&self) -> &[(String, Arc<[u8]>)] {
        &self.files
    }

    fn get(&self, path: &str) -> Option<&Arc<[u8]>> {
        let at = self.by_path.get(path)?;
        self.files.get(*at).map(|(_, bytes)| bytes)
    }
}

impl Loader for Unpacked {
    fn find(&self, beside: &Path, name: &str) -> Result<PathBuf, LoadError> {
        let beside = beside.to_string_lossy();
        let found = candidates(&beside, name)
            .into_iter()
            .find(|c| self.get(c).is_some());
        found.map(PathBuf::from).ok_or(LoadError::NotFound)
    }

    fn read(&self, id: &Path) -> Result<Vec<u8>, LoadError> {
        let found = self.get(&id.to_string_lossy());
        found.map(|bytes| bytes.to_vec()).ok_or(LoadError::NotFound)
    }
}

impl crate::TextureLoader for Unpacked {
    fn load(&self, beside: &Path, name: &str) -> Result<Vec<u8>, String> {
        let loaded = Loader::load(self, beside, name).map_err(|why| why.to_string())?;
        Ok(loaded.bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Archive {
        Archive {
            files: vec![
                (
                    String::new(),
                    Content::Here(b"#Inventor V2.1 ascii\nCube {}".as_slice().into()),
                ),
                (
                    "parts/a.iv".to_owned(),
                    Content::Here(vec![0xff; 1000].into()),
                ),
                (
                    "wood.png".to_owned(),
                    Content::Image {
                        index: 2,
                        crc: u32::MAX,
                    },
                ),
            ],
            glb: (7, 1 << 40),
            made: json!({ "chord": 0.5 }),
        }
    }

    #[test]
    fn a_source_comes_back() {
        let text = sample().pack().unwrap();
        let value: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(Archive::unpack(&value).unwrap(), sample());
    }

    #[test]
    fn what_is_wrong_is_refused() {
        let good: Value = serde_json::from_str(&sample().pack().unwrap()).unwrap();
        let rows: [(&str, Value); 8] = [
            ("/version", 2.into()),
            ("/files", Value::Null),
            ("/files/0/path", "a.iv".into()),
            ("/files/1/path", "../a.iv".into()),
            ("/files/1/path", "/etc/a.iv".into()),
            ("/files/1/bytes", 999.into()),
            ("/files/1/bytes", u64::MAX.into()),
            ("/files/1/deflate", "AAAA".into()),
        ];
        for (pointer, value) in rows {
            let mut bad = good.clone();
            let shown = format!("{pointer} {value}");
            let (parent, key) = pointer.rsplit_once('/').unwrap();
            bad.pointer_mut(parent).unwrap()[key] = value;
            assert!(Archive::unpack(&bad).is_err(), "{shown}");
        }
    }

    #[test]
    fn base64_as_in_rfc_4648() {
        for text in ["", "f", "fo", "foo", "foob", "fooba", "foobar"] {
            let packed = base64(text.as_bytes());
            assert_eq!(packed.len() % 4, 0);
            assert_eq!(
                crate::read::base64(packed.as_bytes()).unwrap(),
                text.as_bytes()
            );
        }
        assert_eq!(base64(b"fo"), "Zm8=");
    }
}
