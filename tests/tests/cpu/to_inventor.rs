//! Inventor text made of a scene shows that scene.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use convert::{InventorOptions, Options, gltf_to_inventor, write_glb};
use iv_parser::Severity;
use scenegraph::scene::Scene;
use scenegraph::{FileLoader, LoadError, Loader, ResolveOptions, load, resolve};
use tests::fuzz_body;
use tests::same_scene::differences;

use super::models::{Model, check_all};

/// Files in memory, by name.
struct Files(BTreeMap<String, Vec<u8>>);

impl Loader for Files {
    fn find(&self, _: &Path, name: &str) -> Result<PathBuf, LoadError> {
        match self.0.contains_key(name) {
            true => Ok(name.into()),
            false => Err(LoadError::NotFound),
        }
    }

    fn read(&self, id: &Path) -> Result<Vec<u8>, LoadError> {
        let name = id.to_string_lossy();
        self.0.get(&*name).cloned().ok_or(LoadError::NotFound)
    }
}

/// The scene of a text, which must be free of problems; references are looked for in `files`.
fn scene_of(text: &[u8], files: &Files) -> Result<Scene, String> {
    let graph = load(text, "model.iv", Path::new(""), files);
    let resolved = resolve(&graph, &ResolveOptions::default());
    let diagnostics = graph.diagnostics.iter().chain(&resolved.diagnostics);
    let mut serious = diagnostics.filter(|d| d.severity >= Severity::Warning);
    match serious.next() {
        None => Ok(resolved.scene),
        Some(d) => Err(format!("{d}")),
    }
}

fn check(model: &Model) -> Result<(), String> {
    let mut glb = Vec::new();
    let options = Options::default();
    write_glb(&model.scene(), &options, &model.images(), &mut glb).map_err(|e| e.to_string())?;
    let want = fuzz_body::read_gltf_within(&glb)
        .map_err(|e| e.to_string())?
        .scene;
    let nothing = FileLoader::default();
    let made = gltf_to_inventor(
        &glb,
        "model.glb",
        Path::new(""),
        &nothing,
        &|_| None,
        &InventorOptions::default(),
    )
    .map_err(|e| e.to_string())?;
    if let Some(note) = made
        .notes
        .iter()
        .find(|n| n.is_loss && n.code != "light-scope")
    {
        return Err(note.message.clone());
    }
    let images = made.beside.iter();
    let files = Files(images.map(|(n, b)| (n.clone(), b.to_vec())).collect());
    let got = scene_of(&made.text, &files)?;
    let lit_by_more = made.notes.iter().any(|n| n.code == "light-scope");
    let differences = differences(&want, &got);
    let mut counted = differences
        .iter()
        .filter(|why| !(lit_by_more && why.contains("lit by")));
    counted.next().map_or(Ok(()), |why| Err(why.clone()))
}

#[test]
fn text_of_converted_models_shows_the_same() {
    check_all(check);
}
