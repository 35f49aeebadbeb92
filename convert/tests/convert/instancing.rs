//! Copies of a mesh in one node: the same corners in the world, whatever becomes a copy.

use convert::{Options, Quantize, ReadLimits, read_gltf};
use glam::{DAffine3, DVec3};
use scenegraph::scene::Mesh;
use std::path::Path;

use crate::decode::corners;
use crate::read::{Converted, convert_with};
use crate::reading::OneFile;
use crate::scenes::{Build, Images, lines, material, scale, shift, triangle, turn};

fn converted(build: &Build, quantize: Option<f64>) -> Converted {
    let options = Options {
        instancing: true,
        quantize: quantize.map(Quantize::within),
        ..Options::default()
    };
    convert_with(&build.scene, &options, &Images::default())
}

/// How many copies each node with a mesh holds, by name.
fn batches(converted: &Converted) -> Vec<(String, u64)> {
    let count = |node: &serde_json::Value| {
        let accessor = node.pointer("/extensions/EXT_mesh_gpu_instancing/attributes/TRANSLATION");
        accessor.map_or(1, |a| {
            let accessor = &converted.json["accessors"][a.as_u64().unwrap() as usize];
            accessor["count"].as_u64().unwrap()
        })
    };
    let with_mesh = converted
        .nodes()
        .iter()
        .filter(|node| node.get("mesh").is_some());
    with_mesh
        .map(|node| (node["name"].as_str().unwrap_or("").to_owned(), count(node)))
        .collect()
}

/// The farthest that a corner of the one is from the nearest of the other.
fn distance(build: &Build, got: &Converted) -> f64 {
    let plain = convert_with(&build.scene, &Options::default(), &Images::default());
    let places = |c: &Converted| -> Vec<DVec3> {
        corners(c)
            .into_iter()
            .flatten()
            .map(|c| c.p_in_world)
            .collect()
    };
    let (want, got) = (places(&plain), places(got));
    assert_eq!(want.len(), got.len());
    let nearest = |p: &DVec3| {
        got.iter()
            .map(|q| q.distance(*p))
            .fold(f64::INFINITY, f64::min)
    };
    want.iter().map(nearest).fold(0.0, f64::max)
}

fn frame(i: u32) -> DAffine3 {
    let i = f64::from(i);
    shift(i * 3.7, (i * 0.3).sin() * 50.0, -i)
        * turn(DVec3::new(1.0, i, 0.5), i)
        * scale(1.0, 1.0 + i, 2.0)
}

#[test]
fn what_is_alike_below_one_node_becomes_one() {
    let far = shift(2_600_000.0, 1_200_000.0, 0.0);
    let mut build = Build::new();
    let site = build.group(None, Some("Site"), far * turn(DVec3::ONE, 1.0));
    for i in 0..20 {
        build.shape(Some(site), Some("Screw"), frame(i));
        build.shape(Some(site), None, frame(100 + i));
        build.shape(Some(site), Some(&format!("Part{i}")), frame(200 + i));
        build.instance(
            Some(site),
            None,
            shift(f64::from(i), 0.0, 0.0),
            lines(),
            material(),
        );
    }
    let other = build.group(None, Some("Other"), DAffine3::IDENTITY);
    for i in 0..3 {
        build.shape(Some(other), None, frame(i));
    }
    let got = converted(&build, None);
    let mut batches = batches(&got);
    batches.retain(|(name, _)| !name.starts_with("Part"));
    let named = |name: &str, count| (name.to_owned(), count);
    let want = [
        named("Screw", 20),
        named("", 20),
        named("", 20),
        named("", 1),
        named("", 1),
        named("", 1),
    ];
    let mut sorted = want.to_vec();
    sorted.sort();
    batches.sort();
    assert_eq!(batches, sorted);
    assert_eq!(*got.at("/extensionsRequired/0"), "EXT_mesh_gpu_instancing");
    // Frames are f32 about the middle of a hundred units.
    let worst = distance(&build, &got);
    assert!(worst < 1e-4, "{worst}");

    let loader = OneFile(Vec::new());
    let limits = ReadLimits::default();
    let model = read_gltf(&got.bytes, "m", Path::new(""), &loader, &limits).unwrap();
    assert_eq!(model.scene.instances.len(), build.scene.instances.len());
}

#[test]
fn what_shears_or_mirrors_stays_a_node() {
    // A batch cannot shear, and its viewers turn the faces of all copies alike.
    for stretch in [scale(1.0, 3.0, 1.0), scale(1.0, 1.0, -1.0)] {
        let mut build = Build::new();
        for i in 0..10 {
            build.shape(None, None, stretch * turn(DVec3::Z, 0.5 + f64::from(i)));
        }
        let got = converted(&build, None);
        assert!(batches(&got).iter().all(|(_, count)| *count == 1));
        assert!(got.json.get("extensionsRequired").is_none());
    }
}

#[test]
fn copies_keep_the_tolerance() {
    let mut mesh = triangle();
    mesh.positions = (0..900)
        .map(|i| [i as f32 * 0.01, (i as f32 * 0.7).sin(), (i % 7) as f32])
        .collect();
    mesh.normals = vec![[0.0, 0.0, 1.0]; 900];
    mesh.indices = (0..900).collect();
    for (tolerance, spread, is_batch) in [
        (1e-2, 1.0, true),
        (1e-3, 1.0, true),
        // f32 has steps of 1e-3 there.
        (1e-3, 1e4, false),
    ] {
        let mut build = Build::new();
        let group = build.group(None, None, turn(DVec3::X, 0.3));
        for i in 0..6 {
            let at = shift(f64::from(i) * spread * 1.37, 0.0, 0.0) * turn(DVec3::ONE, f64::from(i));
            let mesh = Mesh { ..mesh.clone() };
            build.instance(Some(group), None, at, mesh, material());
        }
        let got = converted(&build, Some(tolerance));
        assert_eq!(batches(&got).len() == 1, is_batch, "{tolerance} {spread}");
        let worst = distance(&build, &got);
        assert!(worst <= tolerance, "{tolerance} {spread}: {worst}");
    }
}
