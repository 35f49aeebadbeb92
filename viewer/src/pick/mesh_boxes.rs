//! Boxes over the triangles, segments or points of one mesh, and over all objects of a scene.

use geometry::bounds::Aabb;
use glam::{DVec3, Vec3};
use scenegraph::scene::{Mesh, Topology};

use crate::content::positions;
use crate::hierarchy::{Bounds, Hierarchy};

/// Things in a leaf at most. Half as many would take twice the memory and as long.
const LEAF: usize = 8;

/// A mesh made ready for rays. Its frame is that of [`positions::positions`]. Takes at most 20 bytes
/// a primitive.
#[derive(Debug)]
pub struct MeshBoxes {
    pub boxes: Hierarchy,
    shared: [f32; 3],
}

impl MeshBoxes {
    /// Looks at each index a few times the logarithm of their number.
    pub fn new(mesh: &Mesh) -> Self {
        let shared = positions::shared(mesh);
        let bounds = mesh.indices.chunks_exact(corner_count(mesh)).map(|of| {
            let mut bounds = Bounds::EMPTY;
            for p in of.iter().filter_map(|&i| mesh.positions.get(i as usize)) {
                // Exact, as `positions::positions` is.
                bounds.add(Vec3::from(*p) - Vec3::from(shared));
            }
            bounds
        });
        Self {
            boxes: Hierarchy::new(bounds, LEAF),
            shared,
        }
    }

    /// Corners of a primitive in the mesh's frame; `None` for one that is not there.
    pub fn corners<const N: usize>(&self, mesh: &Mesh, primitive: u32) -> Option<[DVec3; N]> {
        let first = primitive as usize * N;
        let of = mesh.indices.get(first..first + N)?;
        let mut corners = [DVec3::ZERO; N];
        for (corner, &i) in corners.iter_mut().zip(of) {
            let p = Vec3::from(*mesh.positions.get(i as usize)?) - Vec3::from(self.shared);
            *corner = p.as_dvec3();
        }
        Some(corners)
    }
}

fn corner_count(mesh: &Mesh) -> usize {
    match mesh.topology {
        Topology::Triangles => 3,
        Topology::Lines => 2,
        Topology::Points => 1,
    }
}

/// Boxes over boxes of the world, relative to `origin`, rounded outwards.
pub fn world_boxes(boxes: &[Aabb], origin: DVec3) -> Hierarchy {
    let bounds = boxes.iter().map(|b| {
        if b.is_empty() {
            return Bounds::EMPTY;
        }
        // A difference of f64 is rounded by less than a step of f32.
        let low = (b.min - origin).as_vec3().to_array().map(f32::next_down);
        let high = (b.max - origin).as_vec3().to_array().map(f32::next_up);
        Bounds {
            low: Vec3::from(low),
            high: Vec3::from(high),
        }
    });
    Hierarchy::new(bounds, 1)
}
