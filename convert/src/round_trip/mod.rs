//! The exact way back: a glTF file that carries the Inventor source it was made of.
//!
//! On the way back the source is converted again and compared with the file, object by object. Where
//! nothing was edited, the source comes back byte for byte. What was edited is put into the source's
//! text at its place; the result is converted and compared once more, so that an edit which did not
//! arrive is never taken for one that did. What cannot be put there makes the text anew, as of any
//! glTF.

mod archive;
mod edits;
mod made;
mod patch;
mod paths;
mod recorder;
mod same;

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;

use iv_parser::{Encoding, Limits};
use rustc_hash::FxHashMap;
use scenegraph::scene::Scene;
use scenegraph::{RegistryLayout, ResolveOptions, legal_name};

pub(crate) use archive::{Archive, Content, Unpacked};
pub use recorder::Recorder;

use crate::plan::Origins;
use crate::prepare::Prepared;
use crate::read::{Objects, ReadError, ReadLimits, carried_source};
use crate::to_inventor::{Input, InventorFiles, Note};
use crate::{Container, Error, Options, Plan, Report, write_file, write_glb};
use archive::crc;
use edits::Edits;
use patch::Materials;

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

/// A source that a file carries, with the images of the file.
pub(crate) struct Carried {
    pub(crate) archive: Archive,
    pub(crate) files: Unpacked,
    /// Paths of images that are no longer those of the source.
    pub(crate) images_edited: Vec<String>,
}

impl Carried {
    /// Puts images where the source has them.
    pub(crate) fn new(archive: Archive, images: &[Option<Arc<[u8]>>]) -> Self {
        let mut by_sum: FxHashMap<u32, usize> = FxHashMap::default();
        for (i, image) in images.iter().enumerate() {
            if let Some(bytes) = image {
                by_sum.entry(crc(bytes)).or_insert(i);
            }
        }
        let mut files = Vec::new();
        let mut images_edited = Vec::new();
        for (path, content) in &archive.files {
            match content {
                Content::Here(bytes) => files.push((path.clone(), Arc::clone(bytes))),
                Content::Image { index, crc } => {
                    let same = by_sum.get(crc).copied();
                    if same.is_none() {
                        images_edited.push(path.clone());
                    }
                    let image = images.get(same.unwrap_or(*index)).cloned().flatten();
                    files.extend(image.map(|bytes| (path.clone(), bytes)));
                }
            }
        }
        Self {
            archive,
            files: Unpacked::new(files),
            images_edited,
        }
    }
}

/// The way back.
pub(crate) enum Back {
    /// By the source.
    Source(InventorFiles),
    /// There is none, or none that can be used.
    No(Option<Note>),
}

/// Goes back by the source that a file carries.
///
/// # Errors
///
/// As [`read_gltf`](crate::read_gltf).
pub(crate) fn back(input: &Input<'_>) -> Result<Back, ReadError> {
    let Some(source) = carried_source(input.bytes)? else {
        return Ok(Back::No(Some(Note {
            code: "no-source",
            message: "the file does not carry the Inventor text it was made of, if any: this text \
                      is made of what it shows"
                .to_owned(),
            hint: "files written with --round-trip carry it",
            is_loss: false,
        })));
    };
    let archive = match Archive::unpack(&source) {
        Ok(archive) => archive,
        Err(why) => return Ok(Back::No(Some(unusable(&why)))),
    };
    if is_untouched(input.bytes, &archive) {
        let images = crate::read::images_of(input.bytes)?;
        let carried = Carried::new(archive, &images);
        return Ok(Back::Source(unedited(input, &carried)));
    }
    let edited = Objects::read(
        input.bytes,
        input.beside,
        input.loader,
        &input.options.limits,
    )?;
    let carried = Carried::new(archive, &edited.images);
    let limits = &input.options.limits;
    let original = match again(&carried, &carried.files, carried.archive.root(), limits) {
        Ok(original) => original,
        Err(why) => return Ok(Back::No(Some(unusable(&why)))),
    };
    let edits = Edits::between(&original.objects, &edited);
    if edits.is_empty() {
        return Ok(Back::Source(unedited(input, &carried)));
    }
    let changed = edits.summary();
    // Images of the file stand in for those of the source, so that they do not tell.
    if original.glb != carried.archive.glb && carried.images_edited.is_empty() {
        let why = "it is converted otherwise now, so that what was edited cannot be known";
        return Ok(Back::No(Some(unusable(why))));
    }
    let patched = match edits.structure {
        Some(_) => Err("its parts are others".to_owned()),
        None => with_edits(input, &carried, &edited, &changed),
    };
    match patched {
        Ok(files) => Ok(Back::Source(files)),
        Err(why) => Ok(Back::No(Some(Note {
            code: "edited",
            message: format!(
                "what was edited ({changed}) has no place in the source's text ({why}): the text \
                 is made anew of what the file shows"
            ),
            hint: "comments, unknown nodes and all that is not shown are left out",
            is_loss: true,
        }))),
    }
}

/// The source with the edits in it; says why that cannot be.
fn with_edits(
    input: &Input<'_>,
    carried: &Carried,
    edited: &Objects,
    changed: &str,
) -> Result<InventorFiles, String> {
    let limits = &input.options.limits;
    let text = as_ascii(carried.archive.root());
    let parsed = iv_parser::parse(&text);
    let was = again(carried, &carried.files, &text, limits)?;
    let edits = Edits::between(&was.objects, edited);
    // An edited image whose name is taken gets another one.
    let mut names = BTreeMap::new();
    for path in &carried.images_edited {
        if (input.existing)(path).is_some() {
            names.insert(path.clone(), free_name(path, input.existing));
        }
    }
    let attempt = |materials| {
        let patched = patch::patch(&parsed.tree, &was, edited, &edits, &names, materials)?;
        let now = (carried.files.files().iter()).map(|(path, bytes)| {
            let new = patched.renamed_images.get(path).unwrap_or(path);
            (new.clone(), Arc::clone(bytes))
        });
        let now = Unpacked::new(now.collect());
        let result = again(carried, &now, &patched.text, limits)?;
        let moved = !(edits.frames.is_empty() && edits.meshes.is_empty());
        let left = not_arrived(&result.objects, edited, moved);
        match left.is_empty() {
            true => Ok((patched, now)),
            false => Err(format!("{} would not arrive", left.summary())),
        }
    };
    let first = attempt(Materials::Nodes);
    let (patched, now) = match first {
        Err(_) if !edits.materials.is_empty() => attempt(Materials::Shapes)?,
        other => other?,
    };
    let mut files = InventorFiles {
        text: patched.text,
        ..InventorFiles::default()
    };
    files.note(
        "edited",
        format!("the text is that of the source, with what was edited: {changed}"),
        "",
        false,
    );
    beside(input, &now, &mut files);
    Ok(files)
}

/// What a file has and the converted result has not; names as Inventor can write them.
fn not_arrived(result: &Objects, wanted: &Objects, moved: bool) -> Edits {
    let mut left = match moved {
        true => Edits::but_for_size(result, wanted),
        false => Edits::between(result, wanted),
    };
    left.names.retain(|&(at, to)| {
        let name = wanted.nodes[to].name.as_deref().and_then(legal_name);
        name.as_deref() != result.nodes[at].name.as_deref()
    });
    left
}

/// A text as ASCII; one that is so already stays as it is.
fn as_ascii(text: &[u8]) -> Vec<u8> {
    let parsed = iv_parser::parse_any(text, &RegistryLayout, &Limits::default());
    if parsed.tree.header.encoding == Encoding::Ascii {
        return text.to_vec();
    }
    let mut printed = Vec::new();
    match iv_parser::print(&parsed.tree, &RegistryLayout, &mut printed) {
        Ok(()) => printed,
        Err(_) => text.to_vec(),
    }
}

/// A path beside `path` that nothing has.
fn free_name(path: &str, existing: &dyn Fn(&str) -> Option<Vec<u8>>) -> String {
    let (stem, extension) = match path.rsplit_once('.') {
        Some((stem, extension)) if !extension.contains('/') => (stem, format!(".{extension}")),
        _ => (path, String::new()),
    };
    let name = |number: u32| format!("{stem}-{number}{extension}");
    let mut free = (2..u32::MAX)
        .map(name)
        .filter(|name| existing(name).is_none());
    free.next().unwrap_or_else(|| path.to_owned())
}

fn unusable(why: &str) -> Note {
    Note {
        code: "source-unusable",
        message: format!("the source in the file cannot be used: {why}"),
        hint: "the text is made anew of what the file shows",
        is_loss: true,
    }
}

/// A source converted again.
pub(crate) struct Again {
    /// As it was written: with the group that turns or scales it, if any.
    pub(crate) scene: Scene,
    pub(crate) origins: Origins,
    pub(crate) objects: Objects,
    pub(crate) glb: (u32, u64),
}

/// Converts a source; says why that cannot be.
fn again(
    carried: &Carried,
    files: &Unpacked,
    text: &[u8],
    limits: &ReadLimits,
) -> Result<Again, String> {
    let (options, resolve) = made::from_value(&carried.archive.made);
    let graph = scenegraph::load(text, "source.iv", Path::new(""), files);
    let scene = scenegraph::resolve(&graph, &resolve).scene;
    let options = without_source(&options);
    let prepared = Prepared::new(&scene, &options).map_err(|e| e.to_string())?;
    let plan = Plan::new(&prepared, &options, files).map_err(|e| e.to_string())?;
    let mut glb = Vec::new();
    plan.write_glb(&mut glb).map_err(|e| e.to_string())?;
    let objects = Objects::read(&glb, Path::new(""), files, limits).map_err(|e| e.to_string())?;
    let origins = plan.origins();
    drop(plan);
    let arranged = match prepared.scene {
        Cow::Owned(scene) => Some(scene),
        Cow::Borrowed(_) => None,
    };
    Ok(Again {
        scene: arranged.unwrap_or(scene),
        origins,
        objects,
        glb: (crc(&glb), glb.len() as u64),
    })
}

/// The source as it was, and what of it is not beside the output yet.
fn unedited(input: &Input<'_>, carried: &Carried) -> InventorFiles {
    let mut files = InventorFiles {
        text: carried.archive.root().to_vec(),
        ..InventorFiles::default()
    };
    files.note(
        "source",
        "this is the text that the file was made of, byte for byte".to_owned(),
        "",
        false,
    );
    beside(input, &carried.files, &mut files);
    files
}

/// Whether bytes are what a model refers to. Others may come from a file that somebody made up, and
/// do not belong on a disk.
fn is_of_a_model(path: &str, bytes: &[u8]) -> bool {
    const SGI_IMAGE: &[u8] = &[0x01, 0xda];
    let begins = [b"#Inventor".as_slice(), b"#VRML", SGI_IMAGE]
        .iter()
        .any(|magic| bytes.starts_with(magic));
    // Targa has no mark of its own.
    let is_targa = path.to_ascii_lowercase().ends_with(".tga");
    begins || is_targa || image::guess_format(bytes).is_ok() || unpack::Format::of(bytes).is_some()
}

/// Adds what the source refers to, as far as it is not there. Nothing is written over.
fn beside(input: &Input<'_>, source: &Unpacked, files: &mut InventorFiles) {
    for (path, bytes) in source.files().iter().skip(1) {
        if !is_of_a_model(path, bytes) {
            files.note(
                "no-image",
                format!("`{path}`, which the file carries, is neither an image nor a model"),
                "it was not written",
                true,
            );
            continue;
        }
        match (input.existing)(path) {
            None => files.beside.push((path.clone(), Arc::clone(bytes))),
            Some(found) if *found == **bytes => {}
            Some(_) => files.note(
                "other-file",
                format!("`{path}` beside the output is not the one that the file was made with"),
                "it was left as it is",
                true,
            ),
        }
    }
}
