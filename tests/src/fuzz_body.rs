//! What must hold for any bytes at all. Each body panics where something does not; fuzzers and
//! tests call the same ones.

// A fault is a panic here: that is what fuzzers look for.
#![allow(clippy::panic)]

use std::path::Path;

use glam::DVec3;
use iv_parser::{Encoding, Tree};
use scenegraph::scene::is_below;
use scenegraph::{
    FileLoader, Geometry, RegistryLayout, ResolveLimits, ResolveOptions, Resolved, load,
};

use crate::measure::totals;
use crate::same_tree;

/// Small enough that one input takes milliseconds.
const LIMITS: ResolveLimits = ResolveLimits {
    steps: 100_000,
    depth: 1000,
    items: 2_000,
    geometry_bytes: 8 << 20,
};

/// Parsing ends, and what was read without a problem reads back equal from its print.
///
/// # Panics
///
/// When that does not hold.
pub fn parse(bytes: &[u8]) {
    let parsed = iv_parser::parse(bytes);
    let readable = parsed.tree.header.encoding != Encoding::Binary;
    if !readable || !parsed.problems.is_empty() || parsed.problems_dropped > 0 {
        // Printing must end all the same.
        print(&parsed.tree);
        return;
    }
    let text = print(&parsed.tree);
    let again = iv_parser::parse(&text);
    if let Some(difference) = same_tree::difference(&parsed.tree, &again.tree) {
        panic!("printed and read again: {difference}");
    }
    assert!(again.problems.is_empty(), "print: {:?}", again.problems);
    assert!(print(&again.tree) == text, "a second print differs");
}

/// Reading a file of either form ends, and so does writing what was read in both forms.
///
/// # Panics
///
/// When something is not written.
pub fn binary(bytes: &[u8]) {
    let limits = iv_parser::Limits::default();
    let parsed = iv_parser::parse_any(bytes, &RegistryLayout, &limits);
    let text = print(&parsed.tree);
    iv_parser::parse(&text);
    if !iv_parser::has_binary_form(&parsed.tree.header) {
        return;
    }
    let mut stored = Vec::new();
    match iv_parser::print_binary(&parsed.tree, &RegistryLayout, &mut stored) {
        Ok(_) => print(&iv_parser::parse_any(&stored, &RegistryLayout, &limits).tree),
        Err(error) => panic!("{error}"),
    };
}

/// A tree as text.
///
/// # Panics
///
/// Never: a vector takes all that is written.
pub fn print(tree: &Tree<'_>) -> Vec<u8> {
    let mut text = Vec::new();
    if let Err(error) = iv_parser::print(tree, &RegistryLayout, &mut text) {
        panic!("{error}");
    }
    text
}

/// Loading and resolving end, within the limits, and the scene keeps its guarantees.
///
/// # Panics
///
/// When that does not hold.
pub fn resolve(bytes: &[u8]) -> Resolved {
    resolve_within(bytes, LIMITS)
}

/// As [`resolve`], within other limits.
///
/// # Panics
///
/// When the guarantees do not hold.
pub fn resolve_within(bytes: &[u8], limits: ResolveLimits) -> Resolved {
    let loader = FileLoader::default();
    let graph = load(bytes, "input.iv", Path::new("."), &loader);
    let options = |geometry| ResolveOptions {
        geometry,
        limits,
        ..ResolveOptions::default()
    };
    let mut resolved = scenegraph::resolve(&graph, &options(Geometry::Build));
    assert_eq!(resolved.scene.check(), []);
    let measured = scenegraph::resolve(&graph, &options(Geometry::Measure));
    check_measures(&resolved, &measured);
    resolved.diagnostics.splice(0..0, graph.diagnostics);
    resolved
}

/// As [`resolve`], with what the file has besides what it shows.
///
/// # Panics
///
/// When that does not hold.
pub fn resolve_alternatives(bytes: &[u8]) -> Resolved {
    let loader = FileLoader::default();
    let graph = load(bytes, "input.iv", Path::new("."), &loader);
    let options = ResolveOptions {
        alternatives: true,
        limits: LIMITS,
        ..ResolveOptions::default()
    };
    let resolved = scenegraph::resolve(&graph, &options);
    assert_eq!(resolved.scene.check(), []);
    resolved
}

/// What is only measured reaches at least as far as what is made.
fn check_measures(made: &Resolved, measured: &Resolved) {
    let Some([low, high]) = totals(&made.scene).bounds else {
        return;
    };
    assert!(low.is_finite() && high.is_finite());
    let mut around = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    for instance in &measured.scene.instances {
        let bounds = measured.measures[instance.mesh.index()].bounds;
        for i in 0..8 {
            let pick = |bit: usize, low: f64, high: f64| if i & bit == 0 { low } else { high };
            let corner = DVec3::new(
                pick(1, bounds.min.x, bounds.max.x),
                pick(2, bounds.min.y, bounds.max.y),
                pick(4, bounds.min.z, bounds.max.z),
            );
            let p = instance.placement.world_from_local.transform_point3(corner);
            around = [around[0].min(p), around[1].max(p)];
        }
    }
    // Made positions are rounded to f32 relative to an origin within their shape.
    let rounding = 1e-6 * low.abs().max(high.abs()).max_element();
    let [below, above] = [around[0] - low, high - around[1]];
    assert!(
        below.max(above).max_element() <= rounding,
        "made {low}..{high}, measured {around:?}"
    );
}

/// The output is written, and a reader takes it.
///
/// # Panics
///
/// When that does not hold.
pub fn convert(resolved: &Resolved) {
    let mut bytes = Vec::new();
    let options = convert::Options::default();
    if let Err(error) = convert::write_glb(&resolved.scene, &options, &NoImages, &mut bytes) {
        panic!("not written: {error}");
    }
    let scene = &resolved.scene;
    if scene.instances.is_empty() && scene.lights.is_empty() && scene.cameras.is_empty() {
        // glTF allows a scene without nodes, the reader used here does not.
        return;
    }
    if let Err(error) = gltf::Gltf::from_slice(&bytes) {
        panic!("written, but not readable: {error}");
    }
    let not_shown = scene.nodes_not_shown();
    let instances = scene.instances.iter();
    let shown = instances.filter(|i| !is_below(i.placement.node, &not_shown));
    match read_gltf(&bytes) {
        Ok(read) => assert_eq!(read.scene.instances.len(), shown.count()),
        Err(error) => panic!("written, but not read back: {error}"),
    }
}

/// Reading glTF ends, and a scene that it gives keeps its guarantees.
///
/// # Errors
///
/// As [`convert::read_gltf`] does.
///
/// # Panics
///
/// When that does not hold.
pub fn read_gltf(bytes: &[u8]) -> Result<convert::Model, convert::ReadError> {
    let limits = convert::ReadLimits {
        items: 100_000,
        ..convert::ReadLimits::default()
    };
    let loader = FileLoader::default();
    let model = convert::read_gltf(bytes, "input.glb", Path::new("."), &loader, &limits)?;
    assert_eq!(model.scene.check(), []);
    Ok(model)
}

/// As [`read_gltf`], within the limits that the command has.
///
/// # Errors
///
/// As [`convert::read_gltf`] does.
///
/// # Panics
///
/// When a scene breaks its guarantees.
pub fn read_gltf_within(bytes: &[u8]) -> Result<convert::Model, convert::ReadError> {
    let limits = convert::ReadLimits::default();
    let loader = FileLoader::default();
    let model = convert::read_gltf(bytes, "input.glb", Path::new("."), &loader, &limits)?;
    assert_eq!(model.scene.check(), []);
    Ok(model)
}

/// Finds no image file.
struct NoImages;

impl convert::TextureLoader for NoImages {
    fn load(&self, _beside: &Path, name: &str) -> Result<Vec<u8>, String> {
        Err(format!("no file {name}"))
    }
}
