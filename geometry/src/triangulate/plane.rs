//! From three dimensions to two: the projection of a loop, and the exact predicates on it.

use crate::newell::{area_vector, range_factor};
use glam::{DVec2, DVec3};
use robust::Coord;

/// The sign of the turn from `a` to `b` to `c`, exactly: positive for a left turn, zero if
/// the three are collinear.
pub(super) fn orient(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    robust::orient2d(coord(a), coord(b), coord(c))
}

/// Whether `b` lies in the box spanned by `a` and `c`; for collinear points, on the segment.
pub(super) fn is_between(a: DVec2, b: DVec2, c: DVec2) -> bool {
    b.cmpge(a.min(c)).all() && b.cmple(a.max(c)).all()
}

/// Whether three finite points lie on a line, exactly.
pub(super) fn is_collinear(corners: [DVec3; 3]) -> bool {
    let factor = range_factor(&corners).unwrap_or(1.0);
    [DVec3::X, DVec3::Y, DVec3::Z].into_iter().all(|axis| {
        let projection = Projection {
            factor,
            ..Projection::along(axis)
        };
        let [a, b, c] = corners.map(|p| projection.apply(p));
        orient(a, b, c) == 0.0
    })
}

/// The projection along a coordinate axis, such that a loop that is counter-clockwise about
/// the chosen normal is counter-clockwise in the plane.
pub(super) struct Projection {
    /// The coordinates of space that become x and y.
    axes: [usize; 2],
    /// A power of two that keeps products of coordinates in range.
    factor: f64,
    /// Whether the normal was more than rounding noise, so that the loop's orientation is
    /// known without looking at its corners.
    pub(super) is_orientation_certain: bool,
}

impl Projection {
    /// Along the dominant axis of the normal.
    pub(super) fn along(normal: DVec3) -> Self {
        let axis = normal.abs().max_position();
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        Self {
            axes: if normal[axis] >= 0.0 { [u, v] } else { [v, u] },
            factor: 1.0,
            is_orientation_certain: true,
        }
    }

    /// Along the dominant axis of the loop's Newell normal. If that is no larger than its
    /// rounding error (slivers, figures of eight), along that of a large triangle of its
    /// points. `None` if a point is not finite or all are equal.
    pub(super) fn of_loop(points: &[DVec3]) -> Option<Self> {
        let factor = range_factor(points)?;
        let area = area_vector(points, factor);
        let normal = if area.is_significant() {
            area.vector
        } else {
            let normal = normal_of_spread(points, factor)?;
            if normal.dot(area.vector) < 0.0 {
                -normal
            } else {
                normal
            }
        };
        Some(Self {
            factor,
            is_orientation_certain: area.is_significant(),
            ..Self::along(normal)
        })
    }

    pub(super) fn apply(&self, p: DVec3) -> DVec2 {
        let p = p.to_array();
        DVec2::new(p[self.axes[0]], p[self.axes[1]]) * self.factor
    }
}

/// The normal of the triangle made of the first point, the one farthest from it, and the one
/// farthest from the line through both. For collinear points, some normal of their line.
fn normal_of_spread(points: &[DVec3], factor: f64) -> Option<DVec3> {
    let (&first, rest) = points.split_first()?;
    let arms = || rest.iter().map(|&p| p * factor - first * factor);
    let farther = |a: DVec3, b: DVec3| {
        if b.length_squared() > a.length_squared() {
            b
        } else {
            a
        }
    };
    let arm = arms().fold(DVec3::ZERO, farther);
    if arm == DVec3::ZERO {
        return None;
    }
    let normal = arms().map(|p| arm.cross(p)).fold(DVec3::ZERO, farther);
    Some(if normal == DVec3::ZERO {
        arm.any_orthogonal_vector()
    } else {
        normal
    })
}
