//! How often each span is divided, so that chords stay within a tolerance.
//!
//! Inside one polynomial piece let `a`, `b`, `c` bound the lengths of `S_uu`, `S_uv`, `S_vv`. The
//! linear interpolant on a triangle whose corners lie in a box of `x` by `y` in the parameters is
//! nowhere farther from the surface than `(a x^2 + 2 b x y + c y^2) / 8`: by Taylor's theorem the
//! error at `p = sum l_i p_i` is at most half of `sum l_i (a du_i^2 + 2 b |du_i dv_i| + c dv_i^2)`
//! with `(du_i, dv_i) = p_i - p`; the sums of squares are variances of numbers in intervals of
//! length `x` and `y`, at most `x^2 / 4` and `y^2 / 4` (Popoviciu), and that of the products at
//! most the root of their product (Cauchy and Schwarz). Filip, Magedson and Markot, *Surface
//! algorithms using bounds on derivatives* (1986), have the same bound for right triangles.
//!
//! So any triangle may be used that stays in one cell of a grid that holds all knots, and pieces
//! that share a border divide it alike.

use super::bezier::{Bounds, Row, combinations};
use super::curve::Curve;
use super::knots::Knots;
use super::surface::Surface;
use super::{Fineness, MAX_POLYLINE_POINTS, MAX_VERTEX_WORK, NurbsError};

/// How much finer than the chord asks for the turn may divide.
const MOST_BY_TURN: f64 = 16.0;

/// A part of a span of one parameter.
#[derive(Clone, Copy, Debug)]
struct Interval {
    /// Position in the list of spans.
    piece: usize,
    low: f64,
    high: f64,
    /// Length as a part of the span's.
    part: f64,
    divisions: usize,
}

/// The lines of a grid along one parameter.
#[derive(Clone, Debug, Default)]
pub(super) struct Lines {
    /// Parameters, increasing; one more than cells.
    pub at: Vec<f64>,
    /// For each cell the span it lies in, by its lower knot.
    pub span: Vec<usize>,
    /// For each cell the number of its run of spans that join smoothly, by their knots alone.
    pub run: Vec<u32>,
}

/// The grid of a surface.
pub(super) struct Grid {
    pub u: Lines,
    pub v: Lines,
    /// Bounds of the lengths of `dS/du` and `dS/dv`.
    pub largest: (f64, f64),
    /// The distance that triangles within cells keep to the surface.
    pub chord_bound: f64,
}

/// Divisions of each span of a curve, and the chord that they keep.
pub(super) fn curve_divisions(
    curve: &Curve,
    fineness: &Fineness,
) -> Result<(Vec<usize>, f64), NurbsError> {
    let mut chord = checked(fineness)?;
    let bounds: Vec<Bounds> = curve
        .knots
        .spans()
        .iter()
        .map(|&span| curve.patch(span).bounds())
        .collect();
    // One part a span, at the least.
    let limit = fineness
        .most_points
        .clamp(bounds.len(), MAX_POLYLINE_POINTS.max(bounds.len())) as f64;
    let mut turn_rad = fineness.turn_rad;
    loop {
        let wanted = |b: &Bounds| divisions(b.uu, b.turn_u_rad, 1.0, chord, turn_rad);
        let total: f64 = bounds.iter().map(wanted).sum();
        if total <= limit {
            return Ok((bounds.iter().map(|b| wanted(b) as usize).collect(), chord));
        }
        widen(&mut chord, &mut turn_rad, total / limit);
    }
}

/// Gives up some fineness where too many parts are asked for by a factor: first the turn, which
/// only serves looks.
fn widen(chord: &mut f64, turn_rad: &mut f64, excess: f64) {
    if turn_rad.is_finite() {
        *turn_rad = f64::INFINITY;
    } else {
        *chord *= excess.max(2.0);
    }
}

fn checked(fineness: &Fineness) -> Result<f64, NurbsError> {
    // NaN fails as well.
    if fineness.chord > 0.0 && fineness.turn_rad > 0.0 {
        Ok(fineness.chord)
    } else {
        Err(NurbsError::Tolerance)
    }
}

/// The divisions, a whole number of at least 1, of a part of a span whose second derivative is at
/// most `second` and whose control polygon turns by `turn`.
fn divisions(second: f64, turn: f64, part: f64, chord: f64, turn_rad: f64) -> f64 {
    let by_chord = part * (second / (8.0 * chord)).sqrt();
    let by_turn = (part * turn / turn_rad).min(MOST_BY_TURN * by_chord);
    // A rounding error must not ask for one more.
    (by_chord.max(by_turn) * (1.0 - 1e-12)).ceil().max(1.0)
}

/// The grid of a surface whose lines hold all knots, and the parameters `extra_u` and `extra_v`.
pub(super) fn surface_grid(
    surface: &Surface,
    fineness: &Fineness,
    extra: (&[f64], &[f64]),
) -> Result<Grid, NurbsError> {
    let mut chord = checked(fineness)?;
    let (pieces_u, pieces_v) = (surface.u.spans().len(), surface.v.spans().len());
    let mut bounds = Vec::with_capacity(pieces_u * pieces_v);
    let spans_u = surface.u.spans().iter();
    let rows_u: Vec<Vec<Row>> = spans_u.map(|&s| combinations(&surface.u, s)).collect();
    for &span_v in surface.v.spans() {
        let rows_v = combinations(&surface.v, span_v);
        for (&span_u, rows_u) in surface.u.spans().iter().zip(&rows_u) {
            let patch = surface.patch((span_u, rows_u), (span_v, &rows_v));
            bounds.push(patch.bounds());
        }
    }
    let per_vertex = surface.u.order() * surface.v.order();
    let hard_limit = (MAX_VERTEX_WORK / per_vertex) as f64;
    let mut u = intervals(&surface.u, extra.0);
    let mut v = intervals(&surface.v, extra.1);
    // One part a span, at the least.
    let fewest = (u.len() * v.len()) as f64;
    if fewest > hard_limit {
        return Err(NurbsError::TooLarge);
    }
    let limit = (fineness.most_points as f64).clamp(fewest, hard_limit);
    let mut turn_rad = fineness.turn_rad;
    loop {
        let total = divide(&mut u, &mut v, &bounds, pieces_u, chord, turn_rad, limit);
        if total <= limit {
            break;
        }
        widen(&mut chord, &mut turn_rad, total / limit);
    }
    let steepest = |f: fn(&Bounds) -> f64, knots: &Knots, piece: &dyn Fn(usize) -> usize| {
        let slope = |(k, b): (usize, &Bounds)| {
            let (low, high) = knots.ends(knots.spans()[piece(k)]);
            f(b) / (high - low)
        };
        bounds.iter().enumerate().map(slope).fold(0.0, f64::max)
    };
    Ok(Grid {
        largest: (
            steepest(|b| b.u, &surface.u, &|k| k % pieces_u),
            steepest(|b| b.v, &surface.v, &|k| k / pieces_u),
        ),
        u: lines(&surface.u, &u),
        v: lines(&surface.v, &v),
        chord_bound: chord,
    })
}

/// The spans, cut at `extra` parameters.
fn intervals(knots: &Knots, extra: &[f64]) -> Vec<Interval> {
    let mut cuts: Vec<f64> = extra.iter().copied().filter(|t| t.is_finite()).collect();
    cuts.sort_by(f64::total_cmp);
    let mut out = Vec::with_capacity(knots.spans().len());
    for (piece, &span) in knots.spans().iter().enumerate() {
        let (low, high) = knots.ends(span);
        // Cuts beside a knot are that knot, written with another last digit.
        let near = (high - low) * super::COINCIDENT;
        let mut from = low;
        let first = cuts.partition_point(|&t| t <= low + near);
        let inside = cuts[first..].iter().take_while(|&&t| t < high - near);
        for to in inside.copied().chain([high]) {
            if to - from > near || to == high {
                out.push(Interval {
                    piece,
                    low: from,
                    high: to,
                    part: (to - from) / (high - low),
                    divisions: 1,
                });
                from = to;
            }
        }
    }
    out
}

/// Chooses the divisions of all intervals for a chord; the number of cells. Gives up beyond `limit`.
fn divide(
    u: &mut [Interval],
    v: &mut [Interval],
    bounds: &[Bounds],
    pieces_u: usize,
    chord: f64,
    turn_rad: f64,
    limit: f64,
) -> f64 {
    // What each direction needs by itself.
    let pieces_v = bounds.len() / pieces_u;
    let worst = |along: &dyn Fn(usize) -> usize, count: usize, f: fn(&Bounds) -> f64| {
        (0..count).map(|k| f(&bounds[along(k)])).fold(0.0, f64::max)
    };
    let alone = |second: f64, turn: f64, part: f64| divisions(second, turn, part, chord, turn_rad);
    let need_u: Vec<f64> = u
        .iter()
        .map(|i| {
            let along = |k: usize| k * pieces_u + i.piece;
            let second = worst(&along, pieces_v, |b| b.uu);
            alone(second, worst(&along, pieces_v, |b| b.turn_u_rad), i.part)
        })
        .collect();
    let need_v: Vec<f64> = v
        .iter()
        .map(|i| {
            let along = |k: usize| i.piece * pieces_u + k;
            let second = worst(&along, pieces_u, |b| b.vv);
            alone(second, worst(&along, pieces_u, |b| b.turn_v_rad), i.part)
        })
        .collect();
    let total = need_u.iter().sum::<f64>() * need_v.iter().sum::<f64>();
    if total > limit {
        return total;
    }
    let take = |intervals: &mut [Interval], need: &[f64]| {
        for (interval, n) in intervals.iter_mut().zip(need) {
            interval.divisions = *n as usize;
        }
    };
    take(u, &need_u);
    take(v, &need_v);
    share(u, v, bounds, pieces_u, chord, limit)
}

/// Divides on until both directions together keep the chord in every piece: of each piece that
/// does not, the direction that errs more.
fn share(
    u: &mut [Interval],
    v: &mut [Interval],
    bounds: &[Bounds],
    pieces_u: usize,
    chord: f64,
    limit: f64,
) -> f64 {
    let mut more_u = vec![false; u.len()];
    let mut more_v = vec![false; v.len()];
    loop {
        for (iv, more_v) in v.iter().zip(&mut more_v) {
            for (iu, more_u) in u.iter().zip(&mut more_u) {
                let b = &bounds[iv.piece * pieces_u + iu.piece];
                let x = iu.part / iu.divisions as f64;
                let y = iv.part / iv.divisions as f64;
                let (a, b, c) = (b.uu * x * x, b.uv * x * y, b.vv * y * y);
                // A rounding error must not ask for one more.
                if (a + 2.0 * b + c) * (1.0 - 1e-9) > 8.0 * chord {
                    // Where neither errs by itself, cells are kept square in the parameters.
                    if a > c || (a == c && x >= y) {
                        *more_u = true;
                    } else {
                        *more_v = true;
                    }
                }
            }
        }
        let mut changed = false;
        for (interval, more) in u
            .iter_mut()
            .zip(&mut more_u)
            .chain(v.iter_mut().zip(&mut more_v))
        {
            if std::mem::take(more) {
                interval.divisions += (interval.divisions / 8).max(1);
                changed = true;
            }
        }
        let sum = |list: &[Interval]| list.iter().map(|i| i.divisions as f64).sum::<f64>();
        let total = sum(u) * sum(v);
        if !changed || total > limit {
            return total;
        }
    }
}

fn lines(knots: &Knots, intervals: &[Interval]) -> Lines {
    let mut lines = Lines::default();
    let mut run = 0;
    let mut last_piece = 0;
    for interval in intervals {
        let span = knots.spans()[interval.piece];
        if interval.piece != last_piece {
            let multiplicity = knots.multiplicity_below(span);
            run += u32::from(multiplicity >= knots.degree());
            last_piece = interval.piece;
        }
        for k in 0..interval.divisions {
            let part = k as f64 / interval.divisions as f64;
            let at = interval.low + (interval.high - interval.low) * part;
            lines.at.push(at);
            lines.span.push(span);
            lines.run.push(run);
        }
    }
    lines.at.push(knots.domain().1);
    lines
}
