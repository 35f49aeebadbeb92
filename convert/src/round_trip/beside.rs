//! What a source refers to, beside the text that is written.

use std::sync::Arc;

use super::again::Carried;
use super::archive::Unpacked;
use crate::to_inventor::{Input, InventorFiles};

/// The source as it was, and what of it is not beside the output yet.
pub(crate) fn unedited(input: &Input<'_>, carried: &Carried) -> InventorFiles {
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
pub(crate) fn beside(input: &Input<'_>, source: &Unpacked, files: &mut InventorFiles) {
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
