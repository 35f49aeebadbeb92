//! The ray tracer that pictures are compared with, against values known in closed form.

mod edges;
mod geometry;
mod look;
mod phong;
mod scenes;
mod shadows;

use glam::DVec3;
use tests::reference::{RefCamera, RefImage, RefLens, RefOptions, render};
use tests::shadow_scenes::scene_of;

const BACKGROUND: [f64; 3] = [0.25, 0.5, 0.75];

/// A picture of a file's body.
fn picture(body: &str, camera: &RefCamera, size: [u32; 2]) -> RefImage {
    let scene = scene_of(&format!("#Inventor V2.1 ascii\n{body}"));
    assert_eq!(scene.check(), Vec::new());
    render(&scene, camera, size, BACKGROUND, &RefOptions::of(&scene))
}

/// Colour of the one pixel around the centre of the view.
fn colour_at(body: &str, camera: &RefCamera) -> [f64; 3] {
    picture(body, camera, [1, 1]).color[0]
}

/// From `eye` to the origin.
fn to_origin(eye: [f64; 3]) -> RefCamera {
    let lens = RefLens::Perspective {
        tan_half_height: 0.1,
    };
    let up = DVec3::new(0.1, 1.0, 0.2);
    RefCamera::look_at(DVec3::from(eye), DVec3::ZERO, up, lens)
}

/// A parallel view along -Z to the origin.
fn parallel(half_height: f64) -> RefCamera {
    let lens = RefLens::Orthographic { half_height };
    RefCamera::look_at(DVec3::Z * 9.0, DVec3::ZERO, DVec3::Y, lens)
}

/// A square of side 4 through the origin, its front to +Z.
const WALL: &str = "Coordinate3 { point [ -2 -2 0, 2 -2 0, 2 2 0, -2 2 0 ] }
    IndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1 ] }\n";

/// Largest difference of a channel.
fn difference(a: [f64; 3], b: [f64; 3]) -> f64 {
    (DVec3::from(a) - DVec3::from(b)).abs().max_element()
}
