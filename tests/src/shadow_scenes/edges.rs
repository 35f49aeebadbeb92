//! Meshes whose edges have any number of faces, in any order: none is closed and simple, and all of
//! them cast shadows nevertheless.

use std::f64::consts::TAU;

use glam::DVec3;

use super::text::{Mesh, Text};
use super::{ShadowScene, over, perspective};
use crate::reference::RefCamera;

/// Three quads that meet in one edge.
pub fn three_quads() -> ShadowScene {
    let wings = [[1.3, 0.2, 0.0], [-0.9, 0.7, 0.0], [-0.5, -0.8, 0.0]];
    lamp_over_floor("three quads on an edge", &book(&wings))
}

/// An edge with 128 triangles: as in the Power Plant model, more than a patch of 32 vertices holds.
pub fn many_on_an_edge() -> ShadowScene {
    const COUNT: usize = 128;
    let mut mesh = Mesh::new(&[[0.0, 1.2, -0.7], [0.0, 1.2, 0.7]], &[]);
    for i in 0..COUNT {
        let (sin, cos) = (TAU * i as f64 / COUNT as f64 + 0.013).sin_cos();
        let length = if i % 2 == 0 { 1.0 } else { 0.6 };
        mesh.points
            .push(DVec3::new(length * cos, 1.2 + length * sin, 0.0));
        // No rule in which way round they go.
        let face = if i % 3 == 0 {
            [0, 1, i + 2]
        } else {
            [1, 0, i + 2]
        };
        mesh.faces.push(face.to_vec());
    }
    lamp_over_floor("128 triangles on an edge", &mesh)
}

/// A cone without a base, and with a gap.
pub fn open_fan() -> ShadowScene {
    lamp_over_floor("open fan", &fan(&[false]))
}

/// The same with every second triangle the other way round.
pub fn reversed_fan() -> ShadowScene {
    lamp_over_floor("fan of both orientations", &fan(&[false, true]))
}

/// A box without its top.
pub fn open_box() -> ShadowScene {
    let mut mesh = cuboid();
    mesh.faces.remove(3);
    lamp_over_floor("open box", &mesh)
}

/// A box that says its inside is outside.
pub fn inverted_box() -> ShadowScene {
    lamp_over_floor("inverted box", &cuboid().reversed())
}

/// A torus that is thicker than its ring is wide, so that it runs through itself, and a box
/// through it.
pub fn self_intersecting() -> ShadowScene {
    let bar = Mesh::cuboid([-1.3, 0.9, -0.2], [1.5, 1.3, 0.3]);
    let spindle = torus(0.4, 0.6, [24, 16]).moved(DVec3::new(0.1, 1.3, 0.0));
    lamp_over_floor("self-intersecting solid", &spindle.with(&bar))
}

/// A box with each face twice, some of these the other way round, and triangles without area.
pub fn duplicates() -> ShadowScene {
    let mut mesh = cuboid();
    let again = mesh.faces.clone();
    for (i, face) in again.iter().enumerate() {
        let turned = if i % 2 == 0 {
            face.iter().rev().copied().collect()
        } else {
            face.clone()
        };
        mesh.faces.push(turned);
        let [a, b, ..] = face[..] else { continue };
        mesh.faces.push(vec![a, b, a]);
    }
    let [p, q] = [mesh.points[0], mesh.points[7]];
    let first = mesh.points.len();
    mesh.points.extend([p, p.midpoint(q), q]);
    mesh.faces.push(vec![first, first + 1, first + 2]);
    // Other points at the same places: edges that only positions join.
    let copy = cuboid();
    lamp_over_floor("duplicates and degenerate triangles", &mesh.with(&copy))
}

fn lamp_over_floor(name: &'static str, mesh: &Mesh) -> ShadowScene {
    let mut text = Text::new();
    text.point_light([0.6, 3.7, 0.4]);
    text.floor(0.0, 4.0);
    text.colored([0.9, 0.6, 0.3], mesh);
    ShadowScene {
        name,
        text: text.finish(),
        cameras: cameras(),
    }
}

/// From above, from within the shadow, and close to the caster.
fn cameras() -> Vec<(&'static str, RefCamera)> {
    let at = DVec3::new(0.0, 1.0, 0.0);
    let below = DVec3::new(-0.11, 0.13, 0.07);
    vec![
        ("over", over()),
        (
            "in the shadow",
            perspective(below, DVec3::new(2.0, 0.3, 1.5), 0.8),
        ),
        ("close", perspective(DVec3::new(1.4, 2.1, 1.9), at, 0.35)),
    ]
}

fn cuboid() -> Mesh {
    Mesh::cuboid([-0.7, 0.5, -0.6], [0.8, 1.4, 0.7])
}

/// Quads on the edge along Z at height 1, one for each vector.
fn book(wings: &[[f64; 3]]) -> Mesh {
    let mut mesh = Mesh::new(&[[0.0, 1.0, -0.8], [0.0, 1.0, 0.8]], &[]);
    for wing in wings {
        let first = mesh.points.len();
        let ends = [0, 1].map(|end| mesh.points[end] + DVec3::from(*wing));
        mesh.points.extend(ends);
        mesh.faces.push(vec![0, 1, first + 1, first]);
    }
    mesh
}

/// Triangles about a point; `turns` says, in turn, which are the other way round.
fn fan(turns: &[bool]) -> Mesh {
    const COUNT: usize = 9;
    let mut mesh = Mesh::new(&[[0.0, 1.8, 0.0]], &[]);
    for i in 0..=COUNT {
        let (sin, cos) = (5.0 * i as f64 / COUNT as f64).sin_cos();
        let height = if i % 2 == 0 { 0.9 } else { 0.6 };
        mesh.points.push(DVec3::new(1.1 * sin, height, 1.1 * cos));
    }
    for i in 1..=COUNT {
        let turned = turns[i % turns.len()];
        let face = if turned { [0, i + 1, i] } else { [0, i, i + 1] };
        mesh.faces.push(face.to_vec());
    }
    mesh
}

/// Around the Y axis, faces outward.
fn torus(ring: f64, tube: f64, [around, across]: [usize; 2]) -> Mesh {
    let mut mesh = Mesh::default();
    for i in 0..around {
        let (sin, cos) = (TAU * i as f64 / around as f64).sin_cos();
        for j in 0..across {
            let (up, out) = (TAU * j as f64 / across as f64).sin_cos();
            let reach = ring + tube * out;
            mesh.points
                .push(DVec3::new(reach * sin, tube * up, reach * cos));
            let at = |i: usize, j: usize| (i % around) * across + j % across;
            // Near the axis a quad would cross itself.
            let [a, b] = [at(i, j), at(i + 1, j + 1)];
            mesh.faces.push(vec![a, at(i + 1, j), b]);
            mesh.faces.push(vec![a, b, at(i, j + 1)]);
        }
    }
    mesh
}
