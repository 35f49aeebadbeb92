//! Trim loops: flattened to polygons in the parameters, and what lies inside them. Cutting them
//! along a grid is done in `cells.rs`.

use glam::{DVec2, DVec4};

use super::{Curve, Fineness, MAX_MAGNITUDE, MAX_POLYLINE_POINTS, NurbsError};

/// A piece of a trim loop, in the parameters (u, v).
#[derive(Clone, Debug, PartialEq)]
pub enum TrimPiece {
    /// Points joined by straight lines.
    Line(Vec<DVec2>),
    /// A curve; its `z` plays no part.
    Curve(Curve),
}

/// A loop of a trimmed surface: pieces end to end, joined by straight lines where they do not meet,
/// as the last is with the first. What is to the left of it is kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TrimLoop {
    /// In order.
    pub pieces: Vec<TrimPiece>,
}

/// All loops of a surface as polygons.
pub(super) struct Outline {
    /// Closed: the last point is joined to the first.
    pub loops: Vec<Vec<DVec2>>,
    /// The distance that they keep to the curves, in scaled parameters.
    pub chord_bound: f64,
    /// Counts around a place that no loop goes around: 1 if the outermost loops are holes.
    base: i32,
    /// Edges that cross each of a row of bands of `v`.
    bands: Vec<Vec<[DVec2; 2]>>,
    low_v: f64,
    band_height: f64,
}

impl TrimLoop {
    /// The polygon, within `chord` after `u` and `v` are multiplied by `scale`.
    fn flattened(
        &self,
        fineness: &Fineness,
        scale: DVec2,
        room: &mut usize,
        chord_bound: &mut f64,
    ) -> Result<Vec<DVec2>, NurbsError> {
        let mut polygon: Vec<DVec2> = Vec::new();
        for piece in &self.pieces {
            let points = match piece {
                TrimPiece::Line(points) => points.clone(),
                TrimPiece::Curve(curve) => {
                    let (points, bound) = flattened(curve, fineness, scale)?;
                    *chord_bound = chord_bound.max(bound);
                    points
                }
            };
            for p in points {
                // NaN fails as well.
                if !(p.x.abs() <= MAX_MAGNITUDE && p.y.abs() <= MAX_MAGNITUDE) {
                    return Err(NurbsError::Magnitude);
                }
                if polygon.last() != Some(&p) {
                    *room = room.checked_sub(1).ok_or(NurbsError::TrimTooIntricate)?;
                    polygon.push(p);
                }
            }
        }
        while polygon.len() > 1 && polygon.first() == polygon.last() {
            polygon.pop();
        }
        Ok(polygon)
    }
}

/// The points of a curve, and the chord that they keep.
fn flattened(
    curve: &Curve,
    fineness: &Fineness,
    scale: DVec2,
) -> Result<(Vec<DVec2>, f64), NurbsError> {
    // A direction in which the surface does not extend needs no accuracy.
    let scaled = |h: &DVec4| DVec4::new(h.x * scale.x, h.y * scale.y, 0.0, h.w);
    let measured = Curve {
        knots: curve.knots.clone(),
        points: curve.points.iter().map(scaled).collect(),
    };
    let line = measured.polyline(fineness)?;
    // The points are those of the curve as given, so that what lies on the border stays there.
    let places = line.parameters.iter().map(|&t| curve.point(t).truncate());
    Ok((places.collect(), line.chord_bound))
}

/// Twice the area; positive if counter-clockwise.
fn doubled_area(polygon: &[DVec2]) -> f64 {
    let Some(&o) = polygon.first() else {
        return 0.0;
    };
    let pairs = polygon.windows(2);
    pairs.map(|w| (w[0] - o).perp_dot(w[1] - o)).sum()
}

impl Outline {
    /// Flattens loops for a surface whose domain is `low` to `high` and whose derivatives have
    /// lengths of at most `scale`. `None` if none of them encloses anything.
    pub fn new(
        loops: &[TrimLoop],
        fineness: &Fineness,
        scale: DVec2,
        low: DVec2,
        high: DVec2,
    ) -> Result<Option<Self>, NurbsError> {
        let mut room = MAX_POLYLINE_POINTS;
        let mut polygons = Vec::new();
        let mut chord_bound = fineness.chord;
        for trim in loops {
            let polygon = trim.flattened(fineness, scale, &mut room, &mut chord_bound)?;
            if polygon.len() > 2 && doubled_area(&polygon) != 0.0 {
                polygons.push(polygon);
            }
        }
        if polygons.is_empty() {
            return Ok(None);
        }
        // A clockwise loop around all of the domain would leave nothing: the writer meant the other
        // direction, for all loops.
        let all = 2.0 * (high - low).element_product() * (1.0 - 1e-3);
        if polygons.iter().any(|p| doubled_area(p) <= -all) {
            polygons.iter_mut().for_each(|p| p.reverse());
        }
        let mut outline = Self {
            loops: polygons,
            chord_bound,
            base: 0,
            bands: Vec::new(),
            low_v: low.y,
            band_height: 1.0,
        };
        outline.fill_bands(high.y);
        // The largest loop is an outermost one. If it is clockwise there is no outer one, and all
        // of the domain around it is kept.
        let largest = outline
            .loops
            .iter()
            .map(|p| doubled_area(p))
            .fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        outline.base = i32::from(largest < 0.0);
        Ok(Some(outline))
    }

    pub fn edges(&self) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        self.loops.iter().flat_map(|polygon| {
            let next = polygon.iter().cycle().skip(1);
            polygon.iter().zip(next).map(|(&a, &b)| [a, b])
        })
    }

    fn fill_bands(&mut self, high_v: f64) {
        let edges: Vec<[DVec2; 2]> = self.edges().collect();
        // As many as edges, unless long edges would each be in many of them.
        let mut count = edges.len().clamp(1, 1024);
        let height: f64 = edges.iter().map(|[a, b]| (b.y - a.y).abs()).sum();
        let mean = height / (high_v - self.low_v) / edges.len() as f64;
        while count > 1 && mean * count as f64 > 8.0 {
            count /= 2;
        }
        self.band_height = (high_v - self.low_v) / count as f64;
        self.bands = vec![Vec::new(); count];
        for edge in edges {
            let first = self.band(edge[0].y.min(edge[1].y));
            let last = self.band(edge[0].y.max(edge[1].y));
            for band in &mut self.bands[first..=last] {
                band.push(edge);
            }
        }
    }

    fn band(&self, v: f64) -> usize {
        // Out of range saturates.
        (((v - self.low_v) / self.band_height) as usize).min(self.bands.len() - 1)
    }

    /// Whether a place is kept: whether more loops go around it to the left than to the right.
    /// Counts edges looked at down from `work`.
    pub fn keeps(&self, p: DVec2, work: &mut usize) -> Result<bool, NurbsError> {
        let band = &self.bands[self.band(p.y)];
        *work = work
            .checked_sub(band.len() + 1)
            .ok_or(NurbsError::TrimTooIntricate)?;
        let mut winding = self.base;
        for [a, b] in band {
            let up = a.y <= p.y && p.y < b.y;
            let down = b.y <= p.y && p.y < a.y;
            if up || down {
                let side = (*b - *a).perp_dot(p - *a);
                if up && side > 0.0 {
                    winding += 1;
                } else if down && side < 0.0 {
                    winding -= 1;
                }
            }
        }
        Ok(winding > 0)
    }
}
