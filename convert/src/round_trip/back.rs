//! The way back by the source that a file carries.

use std::collections::BTreeMap;
use std::sync::Arc;

use iv_parser::{Encoding, Limits};
use scenegraph::{RegistryLayout, legal_name};

use super::again::{Carried, again};
use super::archive::{Archive, Unpacked};
use super::beside::{beside, unedited};
use super::edits::Edits;
use super::is_untouched;
use super::patch::{self, Materials};
use crate::read::{Objects, ReadError, carried_source};
use crate::to_inventor::{Input, InventorFiles, Note};

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
