//! The parts of a volume that are drawn, and the three methods that find them.

use glam::DVec4;

use crate::volume::topology::CasterMesh;
use crate::volume::{per_triangle, reference_edge, silhouette};

/// How the sides of a volume are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Adds up the stored signs at each edge. Sides and caps come from the same integers.
    #[default]
    Silhouette,
    /// Adds up what each opposite vertex of an edge says, by the reference edge of its
    /// triangle, in `f32` as a GPU computes it. For comparison: all triangles cast, and those
    /// nearly in a plane with the light may be taken for others.
    ReferenceEdge,
    /// The three sides of each casting triangle; nothing cancels. For comparison.
    PerTriangle,
}

/// The parts of the volumes of one mesh. What the numbers mean is said in
/// [`crate::volume`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Volume {
    /// `edge << 1 | reversed`, once for each side quad; so an edge can occur many times.
    pub sides: Vec<u32>,
    /// The triangles with `s = +1`, ascending.
    pub cap_pos: Vec<u32>,
    /// The triangles with `s = -1`, ascending.
    pub cap_neg: Vec<u32>,
}

impl Volume {
    /// Empties the lists and keeps their memory.
    pub fn clear(&mut self) {
        self.sides.clear();
        self.cap_pos.clear();
        self.cap_neg.clear();
    }

    /// Appends a side `multiplicity.abs()` times.
    pub(crate) fn push_side(&mut self, edge: u32, multiplicity: i32) {
        let side = edge << 1 | u32::from(multiplicity < 0);
        for _ in 0..multiplicity.unsigned_abs() {
            self.sides.push(side);
        }
    }

    /// Appends the caps of triangles with the signs given.
    pub(crate) fn push_caps(&mut self, signs: impl Iterator<Item = i8>) {
        for (triangle, s) in (0..).zip(signs) {
            match s {
                1 => self.cap_pos.push(triangle),
                -1 => self.cap_neg.push(triangle),
                _ => {}
            }
        }
    }
}

/// Appends the volume of a mesh to `volume`.
///
/// `signs` are those of [`crate::volume::facing()`]; missing ones are 0. [`Method::ReferenceEdge`]
/// does not read them, but the light and `mirrored`, which the others do not read.
pub fn extract(
    mesh: &CasterMesh,
    method: Method,
    signs: &[i8],
    light: DVec4,
    mirrored: bool,
    volume: &mut Volume,
) {
    match method {
        Method::Silhouette => silhouette::extract(mesh, signs, volume),
        Method::ReferenceEdge => reference_edge::extract(mesh, light, mirrored, volume),
        Method::PerTriangle => per_triangle::extract(mesh, signs, volume),
    }
}
