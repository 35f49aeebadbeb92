//! The same scene a million metres from the origin gives the same picture.

use std::fmt::Write;

use glam::DVec3;
use scenegraph::scene::Scene;
use tests::reference::{RefCamera, RefOptions, Reference};
use tests::shadow_scenes::{ShadowScene, all, far_by_coordinates, far_by_transform, scene_of};
use viewer::frame::Settings;

use super::device::Stage;

const FAR: DVec3 = DVec3::splat(1e6);
const SIZE: [u32; 2] = [256, 256];
/// Steps of 8 bits that a pixel away from edges may differ by: a rounding to either side.
const STEPS: u8 = 1;

/// Share of all pixels that may differ: those whose centres lie on an edge.
const MOST_EDGES: f64 = 0.0002;

/// The scene moved, after all its transforms.
fn moved(mut scene: Scene, by: DVec3) -> Scene {
    for instance in &mut scene.instances {
        instance.placement.world_from_local.translation += by;
    }
    for light in &mut scene.lights {
        light.placement.world_from_local.translation += by;
    }
    scene
}

/// The largest difference away from edges, and the share of all pixels that differ by more than
/// [`STEPS`].
fn compare(near: &Scene, far: Scene, camera: &RefCamera) -> (u8, f64) {
    let options = RefOptions::of(near);
    let edge = Reference::new(near, &options)
        .render(camera, SIZE, [0.0; 3])
        .near_edge(1);
    let settings = Settings::default();
    let here = Stage::new(near.clone()).shoot(camera, SIZE, &settings).rgba;
    let there = Stage::new(far)
        .shoot(&camera.moved(FAR), SIZE, &settings)
        .rgba;
    let (mut largest, mut beyond) = (0, 0);
    let pixels = here.as_chunks::<4>().0.iter().zip(there.as_chunks::<4>().0);
    for ((a, b), edge) in pixels.zip(&edge) {
        let difference = a
            .iter()
            .zip(b)
            .map(|(a, b)| a.abs_diff(*b))
            .fold(0, u8::max);
        beyond += usize::from(difference > STEPS);
        if !edge {
            largest = largest.max(difference);
        }
    }
    (largest, beyond as f64 / edge.len() as f64)
}

/// Prints a row for each picture; fails with those that differ.
fn check(rows: Vec<(ShadowScene, Scene)>) {
    let mut wrong = String::new();
    for (near, far) in rows {
        let scene = scene_of(&near.text);
        assert!(!scene.instances.is_empty(), "{}", near.name);
        for (camera_name, camera) in &near.cameras {
            let (largest, beyond) = compare(&scene, far.clone(), camera);
            let line = format!(
                "largest {largest}, beyond {:.3} %: {}, {camera_name}",
                beyond * 100.0,
                near.name
            );
            println!("{line}");
            if largest > STEPS || beyond > MOST_EDGES {
                let _ = writeln!(wrong, "{line}");
            }
        }
    }
    assert!(wrong.is_empty(), "different pictures:\n{wrong}");
}

#[test]
fn far_by_coordinates_and_by_transforms() {
    check(vec![
        (
            far_by_coordinates(DVec3::ZERO),
            scene_of(&far_by_coordinates(FAR).text),
        ),
        (
            far_by_transform(DVec3::ZERO),
            scene_of(&far_by_transform(FAR).text),
        ),
    ]);
}

#[test]
fn every_scene_moved() {
    let rows = all(DVec3::ZERO)
        .into_iter()
        .map(|near| {
            let far = moved(scene_of(&near.text), FAR);
            (near, far)
        })
        .collect();
    check(rows);
}
