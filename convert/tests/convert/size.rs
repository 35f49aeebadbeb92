//! Large models stay small.

use glam::{DAffine3, DVec3};
use scenegraph::scene::Mesh;

use crate::read::convert;
use crate::scenes::{Build, material, shift, triangle, turn};

#[test]
fn five_thousand_instances_fit_into_little() {
    let mut build = Build::new();
    let root = build.group(None, Some("Site"), DAffine3::IDENTITY);
    for i in 0..5000 {
        let i = f64::from(i);
        let local = shift(i * 0.137, i.sin() * 100.0, 12.5) * turn(DVec3::new(1.0, i, 0.5), i);
        let group = build.group(Some(root), Some("Screw"), local);
        build.shape(Some(group), None, DAffine3::IDENTITY);
    }
    let converted = convert(&build.scene);
    assert_eq!(converted.nodes().len(), 5001);
    assert!(
        converted.bytes.len() < 1_400_000,
        "{}",
        converted.bytes.len()
    );
}

#[test]
fn many_small_meshes_share_their_views() {
    let mut build = Build::new();
    for i in 0..500 {
        let mut mesh = Mesh {
            indices: vec![0, 2, 1],
            ..triangle()
        };
        mesh.positions[1][0] = 1.0 + i as f32;
        build.instance(None, None, DAffine3::IDENTITY, mesh, material());
    }
    let converted = convert(&build.scene);
    assert_eq!(converted.json["bufferViews"].as_array().unwrap().len(), 2);
    // Two accessors of vertices and one of indices, a mesh and a node.
    assert!(converted.bytes.len() - converted.bin.len() < 500 * 520);
}
