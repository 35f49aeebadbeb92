//! The models of the benchmark, small: always the same bytes, and read without a remark.

use std::path::Path;

use scenegraph::{FileLoader, ResolveOptions, load, resolve};
use tests::large::{Sizes, all};
use tests::measure::totals;

/// More parts than there are materials, so that some are used again.
const SMALL: Sizes = Sizes {
    grid: [20, 7],
    parts: 230,
    copies: 6,
};

#[test]
fn models_are_the_same_each_time() {
    for (first, again) in all(SMALL).iter().zip(&all(SMALL)) {
        assert!(first.text == again.text, "{}", first.name);
    }
}

#[test]
fn models_hold_what_they_say() {
    // Coordinates, materials: of one surface, of each part, of the one part that is copied.
    let shared = [[1, 1], [230, 200], [1, 1]];
    for (model, [meshes, materials]) in all(SMALL).iter().zip(shared) {
        let files = FileLoader::default();
        let graph = load(model.text.as_bytes(), model.name, Path::new("."), &files);
        let resolved = resolve(&graph, &ResolveOptions::default());
        let remarks = [graph.diagnostics, resolved.diagnostics].concat();
        assert!(remarks.is_empty(), "{}: {remarks:?}", model.name);
        let scene = &resolved.scene;
        assert_eq!(totals(scene).triangles, model.triangles, "{}", model.name);
        assert_eq!(scene.instances.len(), model.instances, "{}", model.name);
        let got = [scene.meshes.len(), scene.materials.len()];
        assert_eq!(got, [meshes, materials], "{}", model.name);
    }
}
