//! Which corner or edge of what is hit was meant, for measuring.

use glam::DVec3;

use super::aim::{Lines, offset_px, pixel_of};
use super::crossing::beside_segment;
use super::{Hit, Part};
use crate::view::{Region, View};

/// A place that a hit snaps to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Snap {
    /// The corner, or the place on the edge that is nearest in the image.
    pub p_in_world: DVec3,
    /// Distance from the hit in the image.
    pub distance_px: f64,
    /// What it is.
    pub feature: Feature,
}

/// A corner or an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feature {
    /// A corner of a triangle, an end of a segment, or a point.
    Vertex,
    /// An edge of a triangle, or a segment, with its ends in the world.
    Edge([DVec3; 2]),
}

/// Where a perspective view cuts off edges, as a share of the depth of the hit: there a pixel is
/// a millionth as wide.
const NEAR_SHARE: f64 = 1.0 / 1_048_576.0;

/// The nearest corner of the triangle or segment that is hit, within so many pixels in the image;
/// else the nearest place on an edge. Edges are those of the mesh's triangles, also where two of
/// them lie in a plane. `None` if there is none so near, or the view does not show the hit.
#[must_use]
pub fn snap(hit: &Hit, tolerance_px: f64, view: &View, region: &Region) -> Option<Snap> {
    let pixel = pixel_of(view, region, hit.p_in_world)?;
    let lines = Lines::through(view, region, pixel)?;
    let in_aim = |p: DVec3| lines.aim_from_world * (p - lines.ray.origin);
    let vertex = |p: DVec3| {
        let [x, y] = offset_px(in_aim(p), lines.is_perspective)?;
        Some(Snap {
            p_in_world: p,
            distance_px: x.hypot(y),
            feature: Feature::Vertex,
        })
    };
    let edge = |ends: [DVec3; 2]| {
        let near = hit.depth * NEAR_SHARE;
        let beside = beside_segment(ends.map(in_aim), 0.0, near, lines.is_perspective)?;
        Some(Snap {
            p_in_world: ends[0].lerp(ends[1], beside.along),
            distance_px: beside.outside_px,
            feature: Feature::Edge(ends),
        })
    };
    let nearest = |snaps: &[Option<Snap>]| {
        let near = snaps.iter().flatten();
        near.filter(|snap| snap.distance_px <= tolerance_px)
            .min_by(|a, b| a.distance_px.total_cmp(&b.distance_px))
            .copied()
    };
    match hit.part {
        Part::Triangle { corners, .. } => {
            let [a, b, c] = corners;
            nearest(&corners.map(vertex)).or_else(|| nearest(&[[a, b], [b, c], [c, a]].map(edge)))
        }
        Part::Segment { ends, .. } => nearest(&ends.map(vertex)).or_else(|| nearest(&[edge(ends)])),
        Part::Point => nearest(&[vertex(hit.p_in_world)]),
    }
}
