//! A glTF file that carries its source gives it back byte for byte, and what is made of that is the
//! same file.

use std::fs;
use std::path::Path;

use convert::{
    InventorFiles, InventorOptions, Options, Recorder, Source, gltf_to_inventor,
    write_glb_with_source,
};
use scenegraph::{FileLoader, ResolveOptions, load, resolve};

use super::models::{Model, check_all};

/// The `.glb` with source of a text in `folder`.
pub fn glb_with_source(text: &[u8], folder: &Path, loader: &FileLoader) -> Result<Vec<u8>, String> {
    glb_made_so(text, folder, loader, &Options::default())
}

/// As [`glb_with_source`], with options.
pub fn glb_made_so(
    text: &[u8],
    folder: &Path,
    loader: &FileLoader,
    options: &Options,
) -> Result<Vec<u8>, String> {
    let recorder = Recorder::new(loader, folder);
    let graph = load(text, "model.iv", folder, &recorder);
    let resolve_options = ResolveOptions::default();
    let scene = resolve(&graph, &resolve_options).scene;
    let mut glb = Vec::new();
    let source = Source {
        text,
        recorder: &recorder,
        resolve: &resolve_options,
    };
    write_glb_with_source(&scene, options, &source, &mut glb).map_err(|error| error.to_string())?;
    Ok(glb)
}

/// The text of a `.glb` and what belongs beside it, for an empty folder.
pub fn back(glb: &[u8]) -> Result<InventorFiles, String> {
    let nothing = FileLoader::default();
    let options = InventorOptions::default();
    gltf_to_inventor(glb, "m.glb", Path::new(""), &nothing, &|_| None, &options)
        .map_err(|error| error.to_string())
}

fn check(model: &Model) -> Result<(), String> {
    let text = fs::read(&model.path).map_err(|e| e.to_string())?;
    let folder = model.path.parent().unwrap_or(Path::new("."));
    let folder = folder.canonicalize().map_err(|e| e.to_string())?;
    let first = glb_with_source(&text, &folder, &model.loader())?;
    let files = back(&first)?;
    if files.text != text {
        return Err(format!("another text: {:?}", files.notes));
    }
    let out = tempfile::tempdir().map_err(|e| e.to_string())?;
    let out = out.path().canonicalize().map_err(|e| e.to_string())?;
    for (name, bytes) in &files.beside {
        let path = out.join(name);
        let parent = path.parent().ok_or("a file without a folder")?;
        fs::create_dir_all(parent).map_err(|e| e.to_string())?;
        fs::write(path, bytes).map_err(|e| e.to_string())?;
    }
    let loader = FileLoader::new([out.as_path()]);
    let second = glb_with_source(&files.text, &out, &loader)?;
    match first == second {
        true => Ok(()),
        false => Err(format!("{} bytes, then {}", first.len(), second.len())),
    }
}

#[test]
fn source_and_file_come_back_byte_for_byte() {
    check_all(check);
}
