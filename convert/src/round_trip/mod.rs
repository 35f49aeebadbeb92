//! The exact way back: a glTF file that carries the Inventor source it was made of.
//!
//! On the way back the source is converted again and compared with the file, object by object. Where
//! nothing was edited, the source comes back byte for byte. What was edited is put into the source's
//! text at its place; the result is converted and compared once more, so that an edit which did not
//! arrive is never taken for one that did. What cannot be put there makes the text anew, as of any
//! glTF.

mod again;
mod archive;
mod back;
mod beside;
mod edits;
mod made;
mod patch;
mod paths;
mod recorder;
mod same;

use std::io::Write;
use std::path::Path;

use rustc_hash::FxHashMap;
use scenegraph::ResolveOptions;
use scenegraph::scene::Scene;

pub(crate) use back::{Back, back};
pub use recorder::Recorder;

use crate::{Container, Error, Options, Report, write_file, write_glb};
use archive::{Archive, Content, crc};

/// What a scene was made of.
#[derive(Clone, Copy)]
pub struct Source<'a> {
    /// The bytes of the model.
    pub text: &'a [u8],
    /// What read all that the model refers to.
    pub recorder: &'a Recorder<'a>,
    /// How it was resolved.
    pub resolve: &'a ResolveOptions,
}

/// As [`write_file`], with the source in the file. Takes the time of two conversions and that of the
/// compression, and memory for a `.glb` besides.
///
/// # Errors
///
/// As [`write_file`].
pub fn write_file_with_source(
    scene: &Scene,
    options: &Options,
    source: &Source<'_>,
    path: &Path,
) -> Result<Report, Error> {
    let options = with_source(scene, options, source)?;
    write_file(scene, &options, source.recorder, path)
}

/// As [`write_glb`], with the source in the file.
///
/// # Errors
///
/// As [`write_glb`].
pub fn write_glb_with_source(
    scene: &Scene,
    options: &Options,
    source: &Source<'_>,
    out: &mut dyn Write,
) -> Result<Report, Error> {
    let options = with_source(scene, options, source)?;
    write_glb(scene, &options, source.recorder, out)
}

/// The options with the source in them.
fn with_source(scene: &Scene, options: &Options, source: &Source<'_>) -> Result<Options, Error> {
    let mut glb = Vec::new();
    write_glb(scene, &without_source(options), source.recorder, &mut glb)?;
    let images = crate::read::images_of(&glb).unwrap_or_default();
    let mut files = vec![(String::new(), Content::Here(source.text.into()))];
    let mut by_bytes: FxHashMap<&[u8], usize> = FxHashMap::default();
    for (i, image) in images.iter().enumerate() {
        if let Some(bytes) = image {
            by_bytes.entry(&**bytes).or_insert(i);
        }
    }
    for (path, bytes) in source.recorder.files() {
        let same = by_bytes.get(&*bytes).copied();
        let content = match same {
            Some(index) => Content::Image {
                index,
                crc: crc(&bytes),
            },
            None => Content::Here(bytes),
        };
        files.push((path, content));
    }
    let archive = Archive {
        files,
        glb: (crc(&glb), glb.len() as u64),
        made: made::to_value(options, source.resolve),
    };
    Ok(Options {
        source: Some(archive.pack()?.into()),
        ..options.clone()
    })
}

/// The options for a `.glb` with null in the place of its source.
fn without_source(options: &Options) -> Options {
    Options {
        container: Container::Glb,
        source: Some("null".into()),
        ..options.clone()
    }
}

/// Whether a `.glb` is to the bit as it was written.
fn is_untouched(bytes: &[u8], archive: &Archive) -> bool {
    let empty = |bytes: &[u8]| -> Option<Vec<u8>> {
        let length = u32::from_le_bytes(*bytes.get(12..)?.first_chunk()?) as usize;
        let text = bytes.get(20..)?.get(..length)?.trim_ascii_end();
        let rest = bytes.get(20 + length..)?;
        let key = b"\"source\":{";
        let start = memchr::memmem::find(text, key)? + key.len() - 1;
        let mut values = serde_json::Deserializer::from_slice(text.get(start..)?).into_iter();
        let _: serde::de::IgnoredAny = values.next()?.ok()?;
        let end = start + values.byte_offset();
        let mut json = [text.get(..start)?, b"null", text.get(end..)?].concat();
        json.resize(json.len().next_multiple_of(4), b' ');
        let length = u32::try_from(20 + json.len() + rest.len()).ok()?;
        let json_length = (json.len() as u32).to_le_bytes();
        let head = [
            &bytes[..8],
            &length.to_le_bytes(),
            &json_length,
            &bytes[16..20],
        ]
        .concat();
        Some([&head, &json[..], rest].concat())
    };
    bytes.starts_with(b"glTF")
        && empty(bytes).is_some_and(|glb| (crc(&glb), glb.len() as u64) == archive.glb)
}
