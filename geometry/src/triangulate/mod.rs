//! Polygons as triangles. One loop in, index triples out; no vertices are added, so crossing
//! edges are not resolved. Holes are loops joined to the outer one by bridge edges.
//!
//! The polygon is projected along the dominant axis of its Newell normal. From there on
//! every decision is exact (Shewchuk's orientation predicate on the projected coordinates):
//! four-gons by cases, convex polygons as a fan, the others by ear clipping.

mod ears;
mod plane;
mod point_tree;
mod ring;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod weak_tests;

pub use crate::newell::newell_normal;
pub use ears::STEPS_PER_VERTEX;

use ears::{Clipped, EarClipper};
use glam::{DVec2, DVec3};
use plane::{Projection, is_collinear, orient};
use ring::Ring;

/// What became of a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The triangles cover the polygon once, each turning the way the loop does.
    Triangulated,
    /// There is no area, or a coordinate is not finite, or there are more than `u32::MAX`
    /// points. Nothing was pushed.
    Degenerate,
    /// The loop crosses itself. The triangles' signed areas add up to the loop's, but they
    /// may overlap, leave out parts, or turn the other way. Not every crossing is noticed: a
    /// loop that winds twice around some points may count as `Triangulated`.
    SelfIntersecting,
    /// More than [`STEPS_PER_VERTEX`] were needed; the remainder was fanned blindly.
    BudgetExceeded,
}

/// Triangulates polygons. Holds only scratch memory: one instance may serve many polygons,
/// and results do not depend on what it did before.
#[derive(Default)]
pub struct Triangulator {
    ring: Ring,
    ears: EarClipper,
}

impl Triangulator {
    /// A triangulator without memory yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Appends the triangles of the polygon with this loop to `out`, as positions in
    /// `points`. Closing points equal to the first are tolerated and not used.
    ///
    /// Triangles wind like the loop does around its [`newell_normal`]. A simple polygon of
    /// `n` points gives `n - 2` triangles of positive area. Points in the middle of a straight
    /// edge are kept as corners, so that a neighbour that has them too meets this polygon
    /// without a T-junction. Only what encloses nothing is left out: repeated points and
    /// spikes (edges that go back on themselves). Polygons need not be planar: "area",
    /// "straight" and "equal" refer to the projection.
    ///
    /// A convex polygon gives the fan of its first point, or where straight edges would make
    /// that fan's triangles empty, of the first point for which they are not.
    ///
    /// Takes `n log n` time for the polygons that files contain, and never more than
    /// [`STEPS_PER_VERTEX`] allows.
    pub fn triangulate(&mut self, points: &[DVec3], out: &mut Vec<[u32; 3]>) -> Outcome {
        match without_closing_points(points) {
            [] | [_] | [_, _] => Outcome::Degenerate,
            &[a, b, c] => triangle([a, b, c], out),
            &[a, b, c, d] => match split_quad([a, b, c, d]) {
                Some(triangles) => {
                    out.extend(triangles);
                    Outcome::Triangulated
                }
                None => self.polygon(&[a, b, c, d], out),
            },
            points => self.polygon(points, out),
        }
    }

    fn polygon(&mut self, points: &[DVec3], out: &mut Vec<[u32; 3]>) -> Outcome {
        if u32::try_from(points.len()).is_err() {
            return Outcome::Degenerate;
        }
        let Some(projection) = Projection::of_loop(points) else {
            return Outcome::Degenerate;
        };
        self.ring.fill(points, &projection);
        if self.ring.len() < 3 {
            return Outcome::Degenerate;
        }
        let mut turning_number = self.ring.turning_number();
        if turning_number == -1 && !projection.is_orientation_certain {
            self.ring.reflect();
            turning_number = 1;
        }
        if turning_number == 1
            && let Some(start) = self.ring.convex_fan_start()
        {
            out.extend(self.ring.fan(start));
            return Outcome::Triangulated;
        }
        let count_before = out.len();
        match self.ears.clip(&self.ring, out) {
            Clipped::OutOfBudget => Outcome::BudgetExceeded,
            _ if out.len() == count_before => Outcome::Degenerate,
            Clipped::All if turning_number == 1 => Outcome::Triangulated,
            Clipped::All | Clipped::ByForce => Outcome::SelfIntersecting,
        }
    }
}

fn without_closing_points(mut points: &[DVec3]) -> &[DVec3] {
    while let [first, .., last] = points
        && first == last
    {
        points = &points[..points.len() - 1];
    }
    points
}

fn triangle(corners: [DVec3; 3], out: &mut Vec<[u32; 3]>) -> Outcome {
    if !corners.iter().all(|p| p.is_finite()) || is_collinear(corners) {
        return Outcome::Degenerate;
    }
    out.push([0, 1, 2]);
    Outcome::Triangulated
}

/// The two triangles of a four-gon, or `None` if it needs the general case.
///
/// A diagonal is good when both its triangles are positive; a simple four-gon, convex or
/// not, with straight corners or without, always has one.
fn split_quad(corners: [DVec3; 4]) -> Option<[[u32; 3]; 2]> {
    let projection = project_quad(&corners)?;
    let [a, b, c, d] = corners.map(|p| projection.apply(p));
    let is_positive = |p: DVec2, q: DVec2, r: DVec2| orient(p, q, r) > 0.0;
    if is_positive(a, b, c) && is_positive(a, c, d) {
        Some([[0, 1, 2], [0, 2, 3]])
    } else if is_positive(b, c, d) && is_positive(b, d, a) {
        Some([[1, 2, 3], [1, 3, 0]])
    } else {
        None
    }
}

/// The projection of a four-gon, quickly if its size is not extreme.
fn project_quad(corners: &[DVec3; 4]) -> Option<Projection> {
    /// Where products of coordinate differences, and their rounding errors, are normal.
    const PLAIN_AREA: std::ops::Range<f64> = 1e-120..1e120;
    let [a, b, c, d] = *corners;
    // The cross product of the diagonals is Newell's normal. A coordinate that is not finite
    // makes some element not finite.
    let normal = (c - a).cross(d - b);
    if normal.is_finite() && PLAIN_AREA.contains(&normal.abs().max_element()) {
        Some(Projection::along(normal))
    } else {
        Projection::of_loop(corners)
    }
}
