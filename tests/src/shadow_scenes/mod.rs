//! Scenes that shadows are hard on, as Inventor text that goes through the ordinary path, with
//! cameras to look at them. Y is up.

mod edges;
mod layers;
mod looks;
mod places;
mod sphere_grid;
mod text;

pub use edges::{
    duplicates, inverted_box, many_on_an_edge, open_box, open_fan, reversed_fan, self_intersecting,
    three_quads,
};
pub use layers::{LAYERS, nested_open_shells, nested_shells, quad_stack};
pub use looks::{beams, fogs, many_lights, panes, textures, vertex_colors};
pub use places::{
    closed_room, culled_casters, eye_in_shadow, eye_on_side_plane, far_by_coordinates,
    far_by_transform, light_in_plane, mirrored, parallel_views, parallel_views_of_lamp,
    room_with_window,
};
pub use sphere_grid::{GridLight, GridSize, sphere_grid};

use std::path::Path;

use glam::DVec3;
use scenegraph::scene::Scene;
use scenegraph::{FileLoader, ResolveOptions, load, resolve};

use crate::reference::{RefCamera, RefLens};

/// A scene and where to look at it from.
#[derive(Clone, Debug)]
pub struct ShadowScene {
    /// What it is about.
    pub name: &'static str,
    /// Open Inventor V2.1.
    pub text: String,
    /// Named, at least one.
    pub cameras: Vec<(&'static str, RefCamera)>,
}

/// The scene that a text stands for; remarks on it are dropped.
pub fn scene_of(text: &str) -> Scene {
    let graph = load(
        text.as_bytes(),
        "scene.iv",
        Path::new("."),
        &FileLoader::default(),
    );
    resolve(&graph, &ResolveOptions::default()).scene
}

/// All scenes but the grid of spheres; those far away at `offset`.
pub fn all(offset: DVec3) -> Vec<ShadowScene> {
    let mut scenes = vec![
        three_quads(),
        many_on_an_edge(),
        open_fan(),
        reversed_fan(),
        open_box(),
        inverted_box(),
        self_intersecting(),
        duplicates(),
        quad_stack(),
        nested_shells(),
        nested_open_shells(),
        eye_in_shadow(),
        eye_on_side_plane(),
        closed_room(),
        room_with_window(),
        light_in_plane(),
        mirrored(),
        culled_casters(),
        parallel_views(),
        parallel_views_of_lamp(),
        far_by_coordinates(offset),
        far_by_transform(offset),
        many_lights(),
        panes(),
        vertex_colors(),
    ];
    scenes.extend(textures());
    scenes.extend(fogs());
    scenes
}

/// A camera with Y up; not for views straight down.
fn perspective(eye: DVec3, target: DVec3, tan_half_height: f64) -> RefCamera {
    let lens = RefLens::Perspective { tan_half_height };
    RefCamera::look_at(eye, target, DVec3::Y, lens)
}

/// A view of what is around the origin, from above.
fn over() -> RefCamera {
    perspective(DVec3::new(2.9, 4.2, 5.3), DVec3::new(0.0, 0.4, 0.0), 0.45)
}

/// A view along -Z to the origin.
fn facing(distance: f64, tan_half_height: f64) -> RefCamera {
    perspective(DVec3::new(0.0, 0.0, distance), DVec3::ZERO, tan_half_height)
}

/// A parallel view with Y up.
fn orthographic(eye: DVec3, target: DVec3, half_height: f64) -> RefCamera {
    let lens = RefLens::Orthographic { half_height };
    RefCamera::look_at(eye, target, DVec3::Y, lens)
}
