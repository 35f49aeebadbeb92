//! A rational B-spline surface: checked data, points, derivatives and normals.

use glam::{DVec3, DVec4, Vec4Swizzles};

use super::bezier::{Patch, Row, bound_work, combinations};
use super::curve::checked_points;
use super::knots::Knots;
use super::{COINCIDENT, MAX_BOUND_WORK, MAX_CONTROL_POINTS, NurbsError};

/// A cross product of derivatives that is a smaller part than this of the product of their largest
/// lengths has no direction: it is made of rounding (2^-53, times the number of operations).
const NO_DIRECTION: f64 = 1.0 / (1_u64 << 36) as f64;

/// Where a normal is looked for beside a place that has none: parts of the way to the middle of the
/// span. The first turns the normal by about as many radians at most.
const BESIDE: [f64; 3] = [1.0 / 65_536.0, 1.0 / 256.0, 0.25];

/// A checked surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    pub(super) u: Knots,
    pub(super) v: Knots,
    pub(super) points: Vec<DVec4>,
}

/// A place on a surface, with its derivatives by the parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The place.
    pub p: DVec3,
    /// `dS/du`.
    pub du: DVec3,
    /// `dS/dv`.
    pub dv: DVec3,
}

impl Surface {
    /// A surface from homogeneous points (x w, y w, z w, w), `u_count` in each row along `u`, and
    /// the knots of both parameters, whose numbers decide the orders.
    ///
    /// # Errors
    ///
    /// See [`NurbsError`]. The work of everything done with the surface is bounded.
    pub fn new(
        points: Vec<DVec4>,
        u_count: usize,
        u_knots: Vec<f64>,
        v_knots: Vec<f64>,
    ) -> Result<Self, NurbsError> {
        if points.len() > MAX_CONTROL_POINTS {
            return Err(NurbsError::TooLarge);
        }
        if u_count == 0 || points.is_empty() || !points.len().is_multiple_of(u_count) {
            return Err(NurbsError::PointCount);
        }
        let u = Knots::new(u_knots, u_count)?;
        let v = Knots::new(v_knots, points.len() / u_count)?;
        let points = checked_points(points)?;
        let pieces = u.spans().len() * v.spans().len();
        let work = bound_work(u.degree(), v.degree());
        if pieces.saturating_mul(work) > MAX_BOUND_WORK {
            return Err(NurbsError::TooLarge);
        }
        Ok(Self { u, v, points })
    }

    /// The least and the largest `u`.
    #[must_use]
    pub fn domain_u(&self) -> (f64, f64) {
        self.u.domain()
    }

    /// The least and the largest `v`.
    #[must_use]
    pub fn domain_v(&self) -> (f64, f64) {
        self.v.domain()
    }

    /// The place at parameters, which are first brought into the domain. At knots where the surface
    /// has an edge, the derivatives are those towards larger parameters.
    #[must_use]
    pub fn point(&self, u: f64, v: f64) -> SurfacePoint {
        let ((u0, u1), (v0, v1)) = (self.domain_u(), self.domain_v());
        // Unlike `clamp`, this takes NaN to an end.
        let (u, v) = (u.max(u0).min(u1), v.max(v0).min(v1));
        let span_u = self.u.spans()[self.u.span_index(u)];
        let span_v = self.v.spans()[self.v.span_index(v)];
        self.point_in(span_u, span_v, u, v)
    }

    /// The place in a piece, its border included.
    pub(super) fn point_in(&self, span_u: usize, span_v: usize, u: f64, v: f64) -> SurfacePoint {
        let (bu, bv) = (self.u.basis(span_u, u), self.v.basis(span_v, v));
        let first_u = self.u.first_point(span_u);
        let first_v = self.v.first_point(span_v);
        let width = self.u.count();
        let (mut h, mut h_u, mut h_v) = (DVec4::ZERO, DVec4::ZERO, DVec4::ZERO);
        for j in 0..self.v.order() {
            let start = (first_v + j) * width + first_u;
            let (mut row, mut row_u) = (DVec4::ZERO, DVec4::ZERO);
            for (i, &point) in self.points[start..start + self.u.order()]
                .iter()
                .enumerate()
            {
                row += point * bu.value[i];
                row_u += point * bu.derivative[i];
            }
            h += row * bv.value[j];
            h_u += row_u * bv.value[j];
            h_v += row * bv.derivative[j];
        }
        let p = h.xyz() / h.w;
        SurfacePoint {
            p,
            du: (h_u.xyz() - p * h_u.w) / h.w,
            dv: (h_v.xyz() - p * h_v.w) / h.w,
        }
    }

    /// The unit normal in a piece, along `dS/du x dS/dv`; where that vanishes, as in a pole, that of
    /// a place beside it. `largest` bounds the lengths of the derivatives. `None` if there is none
    /// beside it either.
    pub(super) fn normal_in(
        &self,
        span: (usize, usize),
        at: (f64, f64),
        here: &SurfacePoint,
        largest: (f64, f64),
    ) -> Option<DVec3> {
        let normal = |s: &SurfacePoint| {
            let unit = |d: DVec3, largest: f64| if largest > 0.0 { d / largest } else { d };
            let n = unit(s.du, largest.0).cross(unit(s.dv, largest.1));
            (n.length() > NO_DIRECTION).then(|| n.normalize())
        };
        normal(here).or_else(|| {
            let middle = |(low, high): (f64, f64)| low * 0.5 + high * 0.5;
            let (mu, mv) = (middle(self.u.ends(span.0)), middle(self.v.ends(span.1)));
            BESIDE.iter().find_map(|&part| {
                let (u, v) = (at.0 + (mu - at.0) * part, at.1 + (mv - at.1) * part);
                normal(&self.point_in(span.0, span.1, u, v))
            })
        })
    }

    /// The polynomial piece of two spans, from their combinations.
    pub(super) fn patch(
        &self,
        (span_u, rows_u): (usize, &[Row]),
        (span_v, rows_v): (usize, &[Row]),
    ) -> Patch {
        let first_u = self.u.first_point(span_u);
        let first_v = self.v.first_point(span_v);
        let width = self.u.count();
        Patch::new(rows_u, rows_v, |i, j| {
            self.points[(first_v + j) * width + first_u + i]
        })
    }

    /// The diagonal of the box around the control points.
    #[must_use]
    pub fn diagonal(&self) -> f64 {
        diagonal(self.points.iter().map(|h| h.xyz() / h.w))
    }

    /// How the borders of the domain lie to each other.
    pub(super) fn closing(&self) -> Closing {
        let near = COINCIDENT * self.diagonal();
        let (nu, nv) = (self.u.count(), self.v.count());
        let (last_u, last_v) = (nu - 1, nv - 1);
        // The border's own control points: for clamped knots those of the net, otherwise combined.
        let line =
            |knots: &Knots, at_end: bool, count: usize, point: &dyn Fn(usize, usize) -> DVec4| {
                let spans = knots.spans();
                let (span, k) = if at_end {
                    (spans[spans.len() - 1], knots.degree())
                } else {
                    (spans[0], 0)
                };
                let row = combinations(knots, span)[k];
                let first = knots.first_point(span);
                let combined = |j: usize| {
                    let h = (0..knots.order())
                        .fold(DVec4::ZERO, |sum, i| sum + point(first + i, j) * row[i]);
                    (h.xyz() / h.w, h.w)
                };
                (0..count).map(combined).collect::<Vec<(DVec3, f64)>>()
            };
        let at_u = |i: usize, j: usize| self.points[j * nu + i];
        let at_v = |j: usize, i: usize| self.points[j * nu + i];
        let u0 = line(&self.u, false, last_v + 1, &at_u);
        let u1 = line(&self.u, true, last_v + 1, &at_u);
        let v0 = line(&self.v, false, last_u + 1, &at_v);
        let v1 = line(&self.v, true, last_u + 1, &at_v);
        let same = |a: &[(DVec3, f64)], b: &[(DVec3, f64)]| {
            a.iter().zip(b).all(|(p, q)| {
                p.0.distance(q.0) <= near && (p.1 - q.1).abs() <= COINCIDENT * p.1.max(q.1)
            })
        };
        let is_point = |a: &[(DVec3, f64)]| a.iter().all(|p| p.0.distance(a[0].0) <= near);
        Closing {
            closed_u: same(&u0, &u1),
            closed_v: same(&v0, &v1),
            point_u: [is_point(&u0), is_point(&u1)],
            point_v: [is_point(&v0), is_point(&v1)],
        }
    }
}

/// The diagonal of the box around points.
fn diagonal(points: impl Iterator<Item = DVec3>) -> f64 {
    let (low, high) = points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
        (low.min(p), high.max(p))
    });
    (high - low).length()
}

impl super::Curve {
    /// The diagonal of the box around the control points.
    #[must_use]
    pub fn diagonal(&self) -> f64 {
        diagonal(self.points.iter().map(|h| h.xyz() / h.w))
    }
}

/// How the borders of a surface meet, within [`COINCIDENT`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Closing {
    /// The ends of `u` are one line.
    pub closed_u: bool,
    /// The ends of `v` are one line.
    pub closed_v: bool,
    /// The line at the lower, at the upper end of `u` is one point.
    pub point_u: [bool; 2],
    /// The line at the lower, at the upper end of `v` is one point.
    pub point_v: [bool; 2],
}
