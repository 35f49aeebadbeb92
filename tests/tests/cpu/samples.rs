//! The samples say of themselves what remarks reading them gives; here they are held to it.

use std::fs;

use samples::{ALL, data_dir, path_of};
use scenegraph::{FileLoader, ResolveOptions, load, resolve};

#[test]
fn remarks_are_as_listed() {
    let folder = data_dir();
    let loader = FileLoader::new([folder.as_path()]);
    for sample in ALL {
        let path = path_of(sample);
        let bytes = fs::read(&path).expect("a sample");
        let beside = path.parent().unwrap_or(&folder);
        let graph = load(&bytes, sample.path, beside, &loader);
        let resolved = resolve(&graph, &ResolveOptions::default());
        let mut codes: Vec<&str> = Vec::new();
        for d in graph.diagnostics.iter().chain(&resolved.diagnostics) {
            if !codes.contains(&d.code) {
                codes.push(d.code);
            }
        }
        assert_eq!(codes, sample.codes, "{}", sample.path);
        assert!(!resolved.scene.instances.is_empty(), "{}", sample.path);
    }
}
