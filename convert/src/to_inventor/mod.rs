//! glTF to Inventor text.
//!
//! What is read is a scene as any other; its text is written by `scenegraph`. Images become files
//! beside the text, or pixels in it.

mod images;

use std::path::Path;
use std::sync::Arc;

use scenegraph::{Loader, SceneText, write_scene};

use crate::read::{Model, ReadError, ReadLimits, read_with_alternatives};
use crate::round_trip::{self, Back};
use images::Images;

/// How Inventor text is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InventorOptions {
    /// Images go into the text, as numbers; else they become files of their own.
    pub embed_images: bool,
    /// What a reader may take.
    pub limits: ReadLimits,
}

/// Inventor text, with the images that belong beside it.
#[derive(Clone, Debug, Default)]
pub struct InventorFiles {
    /// The text.
    pub text: Vec<u8>,
    /// Images and included texts by the name that the text has for them, with `/` for folders; none
    /// of them is there yet.
    pub beside: Vec<(String, Arc<[u8]>)>,
    /// What is to be said, most important first.
    pub notes: Vec<Note>,
    /// Sizes of the model.
    pub counts: InventorCounts,
}

impl InventorFiles {
    /// Adds a note.
    pub(crate) fn note(
        &mut self,
        code: &'static str,
        message: String,
        hint: &'static str,
        is_loss: bool,
    ) {
        self.notes.push(Note {
            code,
            message,
            hint,
            is_loss,
        });
    }
}

/// Something to be said about a conversion to Inventor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Stable short name.
    pub code: &'static str,
    /// What is so, without a full stop.
    pub message: String,
    /// What can be done; may be empty.
    pub hint: &'static str,
    /// Whether something of the model is not in the output.
    pub is_loss: bool,
}

/// How much there is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InventorCounts {
    /// Groups.
    pub nodes: usize,
    /// Shapes, every occurrence counted.
    pub instances: usize,
    /// Distinct geometry.
    pub meshes: usize,
    /// Distinct materials.
    pub materials: usize,
    /// Lights.
    pub lights: usize,
    /// Cameras.
    pub cameras: usize,
}

/// Converts glTF. `name` is what the file is called and `beside` its folder, where its buffers and
/// images are looked for first, by way of `loader`. `existing` gives the bytes of a file that is in
/// the folder of the output already: none is written over; one with other content makes an image
/// take another name.
///
/// # Errors
///
/// As [`read_gltf`](crate::read_gltf).
pub fn gltf_to_inventor(
    bytes: &[u8],
    name: &str,
    beside: &Path,
    loader: &dyn Loader,
    existing: &dyn Fn(&str) -> Option<Vec<u8>>,
    options: &InventorOptions,
) -> Result<InventorFiles, ReadError> {
    let input = Input {
        bytes,
        name,
        beside,
        loader,
        existing,
        options,
    };
    let why = match round_trip::back(&input)? {
        Back::Source(files) => return Ok(files),
        Back::No(why) => why,
    };
    let mut files = anew(&input)?;
    files.notes.extend(why);
    Ok(files)
}

/// What is asked for.
pub(crate) struct Input<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) name: &'a str,
    pub(crate) beside: &'a Path,
    pub(crate) loader: &'a dyn Loader,
    pub(crate) existing: &'a dyn Fn(&str) -> Option<Vec<u8>>,
    pub(crate) options: &'a InventorOptions,
}

/// Text of what the file shows, whatever it was made of.
fn anew(input: &Input<'_>) -> Result<InventorFiles, ReadError> {
    let &Input {
        bytes,
        name,
        beside,
        loader,
        existing,
        options,
    } = input;
    let Model {
        scene, warnings, ..
    } = read_with_alternatives(bytes, name, beside, loader, &options.limits)?;
    let mut images = Images::new(loader, existing, options.embed_images);
    let forms: Vec<_> = scene.textures.iter().map(|t| images.form(t)).collect();
    let SceneText {
        text,
        renamed,
        lit_by_more,
    } = write_scene(&scene, &forms);
    let mut files = InventorFiles {
        text,
        counts: InventorCounts {
            nodes: scene.nodes.len(),
            instances: scene.instances.len(),
            meshes: scene.meshes.len(),
            materials: scene.materials.len(),
            lights: scene.lights.len(),
            cameras: scene.cameras.len(),
        },
        ..InventorFiles::default()
    };
    let left_out = warnings.into_iter().map(|message| Note {
        code: "left-out",
        message,
        hint: "",
        is_loss: true,
    });
    files.notes.extend(left_out);
    files.notes.append(&mut images.notes);
    files.beside = images.files;
    if lit_by_more > 0 {
        files.notes.push(Note {
            code: "light-scope",
            message: format!(
                "{lit_by_more} parts are lit by lights that do not light them in glTF"
            ),
            hint: "",
            is_loss: true,
        });
    }
    if renamed > 0 {
        files.notes.push(Note {
            code: "renamed",
            message: format!("{renamed} names have characters that Inventor's cannot have"),
            hint: "they are replaced by `_`; each name stands in a Label as it was",
            is_loss: false,
        });
    }
    Ok(files)
}

/// Whether bytes are glTF rather than Inventor: a `.glb`, or JSON.
#[must_use]
pub fn is_gltf(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    bytes.starts_with(b"glTF") || text.trim_ascii_start().starts_with(b"{")
}
