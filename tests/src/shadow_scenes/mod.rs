//! Scenes that shadows are hard on, as Inventor text that goes through the ordinary path, with
//! cameras to look at them. Y is up.

mod sphere_grid;
mod text;

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

/// A camera with Y up; not for views straight down.
fn perspective(eye: DVec3, target: DVec3, tan_half_height: f64) -> RefCamera {
    let lens = RefLens::Perspective { tan_half_height };
    RefCamera::look_at(eye, target, DVec3::Y, lens)
}
