//! VRML 2: what its nodes mean, by rows of text and expected scene.

mod geometry;
mod look;
mod proto;

use std::path::{Path, PathBuf};

use scenegraph::scene::Scene;
use scenegraph::{Graph, LoadError, Loader, ResolveOptions, load, resolve};

/// Files in memory beside `main.wrl`, which is never read again.
pub struct Library(pub &'static [(&'static str, &'static str)]);

impl Loader for Library {
    fn find(&self, beside: &Path, name: &str) -> Result<PathBuf, LoadError> {
        let path = beside.join(name);
        let names = self.0.iter().map(|(known, _)| *known);
        let is_here = names
            .chain(["main.wrl"])
            .any(|known| path == Path::new(known));
        is_here.then_some(path).ok_or(LoadError::NotFound)
    }

    fn read(&self, id: &Path) -> Result<Vec<u8>, LoadError> {
        let found = self.0.iter().find(|(known, _)| id == Path::new(known));
        found
            .map(|(_, text)| text.as_bytes().to_vec())
            .ok_or(LoadError::NotFound)
    }
}

/// The scene of a text, and the codes of all that is said about it.
pub fn scene_of(text: &str) -> (Scene, Vec<&'static str>) {
    scene_with(text, &Library(&[]))
}

/// As [`scene_of`], with other files; the text is `main.wrl`.
pub fn scene_with(text: &str, library: &Library) -> (Scene, Vec<&'static str>) {
    let graph = graph_of(text, library);
    let resolved = resolve(&graph, &ResolveOptions::default());
    assert_eq!(resolved.scene.check(), [], "{text}");
    let all = graph.diagnostics.iter().chain(&resolved.diagnostics);
    let codes = all.map(|d| d.code).collect();
    (resolved.scene, codes)
}

/// The graph of a text; a header is added where there is none.
pub fn graph_of(text: &str, library: &Library) -> Graph {
    let text = if text.starts_with('#') {
        text.to_owned()
    } else {
        format!("#VRML V2.0 utf8\n{text}")
    };
    load(text.as_bytes(), "main.wrl", Path::new(""), library)
}
