//! Millimetres at coordinates of thousands of kilometres: a part of 50 m in Swiss coordinates,
//! given in several ways, against positions computed here in f64.
//!
//! A position is an f64 origin and an f32 offset. Offsets of a part of 50 m are below 32 m from its
//! middle and below 64 m from anywhere in it: half a unit in the last place is 2^-19 m = 1.9e-6 m
//! at most. The matrices add roundings of 2^-53 of 2.6e6 m, which is nothing beside it.

use std::fmt::Write;
use std::path::Path;

use glam::DVec3;
use scenegraph::scene::Scene;
use scenegraph::{FileLoader, ResolveOptions, load, resolve};
use tests::glb;
use tests::measure::world_positions;

use super::models::Images;

const TOLERANCE_M: f64 = 2e-6;

const EASTING: f64 = 2_600_000.0;
const NORTHING: f64 = 1_200_000.0;
const HEIGHT: f64 = 431.207;

/// Corners of 200 triangles within 50 m, each with millimetres of its own.
fn part() -> Vec<[f64; 3]> {
    let mm = |n: usize| n as f64 / 1000.0;
    let corner = |i: usize| {
        let (along, across, up) = (83 * i, 7919 * i % 20_011, 104_729 * i % 9_973);
        [mm(along), mm(across), mm(up)]
    };
    (0..600).map(corner).collect()
}

/// A face set of these corners. Rust prints an f64 with all the digits that tell it from others.
fn face_set(corners: &[[f64; 3]]) -> String {
    let mut text = String::from("Coordinate3 { point [ ");
    for [x, y, z] in corners {
        let _ = write!(text, "{x} {y} {z}, ");
    }
    text + "] } FaceSet { numVertices [ " + &"3, ".repeat(corners.len() / 3) + "] }"
}

/// The largest distance along an axis from a position to the nearest true one, or the other way
/// round.
fn largest_error_m(positions: impl IntoIterator<Item = DVec3>, truth: &[[f64; 3]]) -> f64 {
    let mut hit = vec![f64::INFINITY; truth.len()];
    let mut worst: f64 = 0.0;
    for p in positions {
        let mut nearest = f64::INFINITY;
        for (t, hit) in truth.iter().zip(&mut hit) {
            let axes = [p.x - t[0], p.y - t[1], p.z - t[2]];
            let distance = axes.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
            nearest = nearest.min(distance);
            *hit = hit.min(distance);
        }
        worst = worst.max(nearest);
    }
    hit.into_iter().fold(worst, f64::max)
}

/// One way to say where the part is.
struct Placed {
    name: &'static str,
    text: String,
    truth: Vec<[f64; 3]>,
}

fn placed() -> Vec<Placed> {
    let moved = |[x, y, z]: [f64; 3]| [x + EASTING, y + NORTHING, z + HEIGHT];
    let local = part();
    let absolute: Vec<_> = local.iter().map(|&p| moved(p)).collect();
    let offset = format!("{EASTING} {NORTHING} {HEIGHT}");
    let angle_rad = 0.123_456_789;
    let (sin, cos) = f64::sin_cos(angle_rad);
    // The matrix swaps x and y and mirrors; the rotation turns about z; the translation is local.
    let shift = [12.345, -6.789, 0.001];
    let turned: Vec<_> = local
        .iter()
        .map(|p| {
            let [x, y, z] = [p[0] + shift[0], p[1] + shift[1], p[2] + shift[2]];
            let [x, y] = [cos * x - sin * y, sin * x + cos * y];
            moved([y, x, z])
        })
        .collect();
    let millimetres: Vec<_> = absolute
        .iter()
        .map(|p| p.map(|v| (v * 1000.0).round()))
        .collect();
    vec![
        Placed {
            name: "in the coordinates",
            text: face_set(&absolute),
            truth: absolute.clone(),
        },
        Placed {
            name: "by a Transform",
            text: format!("Transform {{ translation {offset} }} {}", face_set(&local)),
            truth: absolute.clone(),
        },
        Placed {
            name: "by a matrix, a rotation and nested groups",
            text: format!(
                "MatrixTransform {{ matrix 0 1 0 0  1 0 0 0  0 0 1 0  {offset} 1 }}
                Separator {{ Rotation {{ rotation 0 0 1 {angle_rad} }}
                Separator {{ Translation {{ translation {} {} {} }} {} }} }}",
                shift[0],
                shift[1],
                shift[2],
                face_set(&local)
            ),
            truth: turned,
        },
        Placed {
            name: "in millimetres",
            text: format!("Units {{ units MILLIMETERS }} {}", face_set(&millimetres)),
            truth: absolute,
        },
    ]
}

fn scene_of(placed: &Placed) -> Scene {
    let text = format!("#Inventor V2.1 ascii\nSeparator {{ {} }}", placed.text);
    let loader = FileLoader::default();
    let graph = load(text.as_bytes(), placed.name, Path::new("."), &loader);
    resolve(&graph, &ResolveOptions::default()).scene
}

fn check(positions: impl IntoIterator<Item = DVec3>, placed: &Placed) {
    let error_m = largest_error_m(positions, &placed.truth);
    println!("{}: {error_m:.2e} m", placed.name);
    assert!(error_m <= TOLERANCE_M, "{}: {error_m:.3e} m", placed.name);
}

#[test]
fn positions_in_the_scene() {
    for placed in placed() {
        let scene = scene_of(&placed);
        let triangles: usize = scene.meshes.iter().map(|m| m.primitive_count()).sum();
        assert_eq!(triangles, placed.truth.len() / 3, "{}", placed.name);
        check(world_positions(&scene), &placed);
    }
}

#[test]
fn positions_in_the_glb() {
    for placed in placed() {
        let mut bytes = Vec::new();
        let options = convert::Options::default();
        let images = Images(FileLoader::default());
        convert::write_glb(&scene_of(&placed), &options, &images, &mut bytes).expect("a .glb");
        let positions = glb::world_positions(&bytes).expect("a .glb that can be read");
        assert_eq!(positions.len(), placed.truth.len(), "{}", placed.name);
        check(positions, &placed);
    }
}
