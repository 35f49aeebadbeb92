//! A rational B-spline curve, and the polyline that stands for it.

use glam::{DVec3, DVec4, Vec4Swizzles};

use super::bezier::{Patch, bound_work, combinations};
use super::divide::curve_divisions;
use super::knots::Knots;
use super::{Fineness, MAX_BOUND_WORK, MAX_CONTROL_POINTS, MAX_MAGNITUDE, MIN_WEIGHT, NurbsError};

/// A checked curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    pub(super) knots: Knots,
    pub(super) points: Vec<DVec4>,
}

/// A curve as points on it, joined by straight segments.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// At least two; the first and the last are the ends of the curve.
    pub points: Vec<DVec3>,
    /// The parameter of each point.
    pub parameters: Vec<f64>,
    /// No segment is farther than this from its piece of the curve, but for rounding. Larger than
    /// was asked for only where a limit was met.
    pub chord_bound: f64,
}

impl Curve {
    /// A curve from homogeneous points (x w, y w, z w, w) and knots, whose number decides the order.
    ///
    /// # Errors
    ///
    /// See [`NurbsError`]. The work of everything done with the curve is bounded.
    pub fn new(points: Vec<DVec4>, knots: Vec<f64>) -> Result<Self, NurbsError> {
        if points.len() > MAX_CONTROL_POINTS {
            return Err(NurbsError::TooLarge);
        }
        let knots = Knots::new(knots, points.len())?;
        let points = checked_points(points)?;
        if knots.spans().len() * bound_work(knots.degree(), 0) > MAX_BOUND_WORK {
            return Err(NurbsError::TooLarge);
        }
        Ok(Self { knots, points })
    }

    /// The least and the largest parameter.
    #[must_use]
    pub fn domain(&self) -> (f64, f64) {
        self.knots.domain()
    }

    /// The point at a parameter, which is first brought into the domain.
    #[must_use]
    pub fn point(&self, t: f64) -> DVec3 {
        let (low, high) = self.domain();
        // Unlike `clamp`, this takes NaN to an end.
        let t = t.max(low).min(high);
        self.point_in(self.knots.spans()[self.knots.span_index(t)], t)
    }

    pub(super) fn point_in(&self, span: usize, t: f64) -> DVec3 {
        let basis = self.knots.basis(span, t);
        let first = self.knots.first_point(span);
        let h = self.points[first..=span]
            .iter()
            .zip(basis.value)
            .fold(DVec4::ZERO, |sum, (&p, b)| sum + p * b);
        h.xyz() / h.w
    }

    /// The polynomial piece of a span.
    pub(super) fn patch(&self, span: usize) -> Patch {
        let first = self.knots.first_point(span);
        let one = {
            let mut row = [0.0; super::MAX_ORDER];
            row[0] = 1.0;
            [row]
        };
        Patch::new(&combinations(&self.knots, span), &one, |i, _| {
            self.points[first + i]
        })
    }

    /// The polyline for a fineness. Every knot is a point of it.
    ///
    /// # Errors
    ///
    /// [`NurbsError::Tolerance`] if the chord is not positive.
    pub fn polyline(&self, fineness: &Fineness) -> Result<Polyline, NurbsError> {
        let (divisions, chord_bound) = curve_divisions(self, fineness)?;
        let mut line = Polyline {
            points: Vec::new(),
            parameters: Vec::new(),
            chord_bound,
        };
        let mut push = |span: usize, t: f64| {
            line.points.push(self.point_in(span, t));
            line.parameters.push(t);
        };
        for (&span, &n) in self.knots.spans().iter().zip(&divisions) {
            let (low, high) = self.knots.ends(span);
            for k in 0..n {
                push(span, low + (high - low) * (k as f64 / n as f64));
            }
        }
        if let Some(&span) = self.knots.spans().last() {
            push(span, self.knots.ends(span).1);
        }
        Ok(line)
    }
}

/// Homogeneous points with positive weights; all are turned around if all weights are negative.
pub(super) fn checked_points(mut points: Vec<DVec4>) -> Result<Vec<DVec4>, NurbsError> {
    if !points
        .iter()
        .all(|h| h.abs().max_element() <= MAX_MAGNITUDE && !h.is_nan())
    {
        return Err(NurbsError::Magnitude);
    }
    if points.iter().all(|h| h.w < 0.0) {
        points.iter_mut().for_each(|h| *h = -*h);
    }
    let range = MIN_WEIGHT..=1.0 / MIN_WEIGHT;
    if !points.iter().all(|h| range.contains(&h.w)) {
        return Err(NurbsError::Weight);
    }
    Ok(points)
}
