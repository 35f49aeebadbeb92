//! Curves to chords, each with the directions of the true curve at its ends.

use std::f64::consts::FRAC_1_SQRT_2;

use glam::DVec2;

/// A piece of a contour; it begins where the one before it ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// Straight, to this point.
    Line(DVec2),
    /// Bézier curve with one control point, and its end.
    Quadratic(DVec2, DVec2),
    /// Bézier curve with two control points, and its end.
    Cubic(DVec2, DVec2, DVec2),
}

/// A closed curve; where its end is not its start, a line closes it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contour {
    /// Where it starts.
    pub start: DVec2,
    /// Its pieces.
    pub segments: Vec<Segment>,
}

/// A closed polygon along a contour.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyline {
    /// Corners; the first does not come again at the end.
    pub points: Vec<DVec2>,
    /// The contour's unit directions as it comes to each corner and as it leaves it. Zero where
    /// it has none.
    pub tangents: Vec<[DVec2; 2]>,
}

/// Chords that one curve may take, whatever the tolerance.
pub const MAX_CURVE_PIECES: u32 = 64;

/// The polygon that misses the contour by at most `tolerance`, unless that takes more than
/// [`MAX_CURVE_PIECES`] a curve.
///
/// A curve is cut into pieces of equal parameter. The chord of a piece of length `h` misses it by
/// at most `h² max |P''| / 8`. A piece turns by about 45 degrees at most, however small it is, so
/// that the curve's directions suit the chords.
#[must_use]
pub fn flatten(contour: &Contour, tolerance: f64) -> Polyline {
    let mut out = Builder::default();
    let mut from = contour.start;
    for &segment in &contour.segments {
        match segment {
            Segment::Line(to) => out.line(from, to),
            Segment::Quadratic(a, to) => {
                let bend = (from - 2.0 * a + to).length();
                let count = pieces(bend / 4.0, tolerance).max(turns(a - from, to - a));
                out.curve(
                    [from, from.lerp(a, 2.0 / 3.0), to.lerp(a, 2.0 / 3.0), to],
                    count,
                );
            }
            Segment::Cubic(a, b, to) => {
                let bend = (from - 2.0 * a + b)
                    .length()
                    .max((a - 2.0 * b + to).length());
                let turned = turns(a - from, b - a) + turns(b - a, to - b) - 1;
                let count = pieces(bend * 0.75, tolerance).max(turned);
                out.curve([from, a, b, to], count);
            }
        }
        from = match segment {
            Segment::Line(to) | Segment::Quadratic(_, to) | Segment::Cubic(_, _, to) => to,
        };
    }
    out.line(from, contour.start);
    out.finish()
}

/// How many equal pieces keep `error / n²` within the tolerance.
fn pieces(error: f64, tolerance: f64) -> u32 {
    let count = (error / tolerance).sqrt().ceil();
    // NaN becomes 0 in the cast.
    (count.min(f64::from(MAX_CURVE_PIECES)) as u32).max(1)
}

/// In how many parts of 45 degrees one direction turns to another.
fn turns(from: DVec2, to: DVec2) -> u32 {
    let cosine = from.normalize_or_zero().dot(to.normalize_or_zero());
    match cosine {
        c if c > FRAC_1_SQRT_2 => 1,
        c if c > -1e-9 => 2,
        c if c > -FRAC_1_SQRT_2 => 3,
        _ => 4,
    }
}

/// Chords in a row: where each ends, with its directions at both ends.
#[derive(Default)]
struct Builder {
    ends: Vec<DVec2>,
    directions: Vec<[DVec2; 2]>,
}

impl Builder {
    fn line(&mut self, from: DVec2, to: DVec2) {
        let direction = (to - from).normalize_or_zero();
        self.chord(from, to, [direction; 2]);
    }

    /// A cubic as `count` chords.
    fn curve(&mut self, [p0, p1, p2, p3]: [DVec2; 4], count: u32) {
        let at = |t: f64| {
            let s = 1.0 - t;
            p0 * (s * s * s) + p1 * (3.0 * s * s * t) + p2 * (3.0 * s * t * t) + p3 * (t * t * t)
        };
        let along = |t: f64| {
            let s = 1.0 - t;
            let derivative = (p1 - p0) * (s * s) + (p2 - p1) * (2.0 * s * t) + (p3 - p2) * (t * t);
            derivative.normalize_or_zero()
        };
        let (mut from, mut begins) = (p0, along(0.0));
        for i in 1..=count {
            let t = f64::from(i) / f64::from(count);
            let to = if i == count { p3 } else { at(t) };
            let ends = along(t);
            self.chord(from, to, [begins, ends]);
            (from, begins) = (to, ends);
        }
    }

    fn chord(&mut self, from: DVec2, to: DVec2, directions: [DVec2; 2]) {
        if from != to && to.is_finite() {
            self.ends.push(to);
            self.directions.push(directions);
        }
    }

    fn finish(self) -> Polyline {
        let count = self.ends.len();
        let tangent = |i: usize| [self.directions[i][1], self.directions[(i + 1) % count][0]];
        Polyline {
            tangents: (0..count).map(tangent).collect(),
            points: self.ends,
        }
    }
}
