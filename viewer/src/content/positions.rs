//! Positions of a mesh near zero on every axis.
//!
//! The scene keeps a coordinate that all vertices share as it is, which f32 holds exactly but cannot
//! add to anything: a floor at a height of a million metres. It is taken out here and added, in
//! f64, to the frame.

use std::borrow::Cow;

use glam::DVec3;
use scenegraph::scene::Mesh;

/// What stands before the positions of [`positions`]: `p_in_local = place + position`.
pub fn place(mesh: &Mesh) -> DVec3 {
    mesh.origin + DVec3::from(shared(mesh).map(f64::from))
}

/// The positions relative to [`place`].
pub fn positions(mesh: &Mesh) -> Cow<'_, [[f32; 3]]> {
    let shared = shared(mesh);
    if shared == [0.0; 3] {
        return Cow::Borrowed(&mesh.positions);
    }
    let moved = mesh.positions.iter().map(|p| {
        // Exact: where something is shared the difference is zero, elsewhere zero is taken away.
        [p[0] - shared[0], p[1] - shared[1], p[2] - shared[2]]
    });
    Cow::Owned(moved.collect())
}

/// The coordinates that all vertices share; zero on the other axes.
pub fn shared(mesh: &Mesh) -> [f32; 3] {
    std::array::from_fn(|axis| {
        let first = mesh.positions.first().map_or(0.0, |p| p[axis]);
        let is_shared = mesh.positions.iter().all(|p| p[axis] == first);
        if is_shared { first } else { 0.0 }
    })
}
