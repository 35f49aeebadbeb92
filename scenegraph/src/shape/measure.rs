//! The size of a mesh that is made, counted, and not kept. Nothing less tells how many triangles a
//! polygon becomes, and what of a shape cannot be drawn.

use geometry::bounds::Aabb;

use crate::scene::{Mesh, Topology};

/// How much a shape draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// Of what.
    pub topology: Topology,
    /// Triangles, segments or points, as in the mesh.
    pub primitives: usize,
    /// Around what is drawn, in the local frame.
    pub bounds: Aabb,
}

impl Measure {
    /// The size of a mesh.
    pub fn of(mesh: &Mesh) -> Self {
        let mut bounds = Aabb::EMPTY;
        let vertices = mesh.indices.iter();
        vertices.for_each(|&i| bounds.include(mesh.p_in_local(i)));
        Self {
            topology: mesh.topology,
            primitives: mesh.primitive_count(),
            bounds,
        }
    }
}
