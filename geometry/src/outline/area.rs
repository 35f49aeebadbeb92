//! Closed polygons as one area: overlaps united, holes found, triangles made. By whole numbers on
//! a grid, in which the crates `i_overlay` and `i_triangle` decide exactly.

use std::collections::BTreeMap;

use glam::DVec2;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::Overlay;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;
use i_triangle::int::unchecked::IntUncheckedTriangulatable;

use super::flatten::Polyline;

/// Largest coordinate, in grid steps: room for differences and their products.
pub const MAX_COORDINATE: f64 = (1 << 29) as f64;

/// A corner of an area's border.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Where it is.
    pub p: DVec2,
    /// Unit directions of the border as it comes to the corner and as it leaves it: those of the
    /// curve where one was, else those of the edges. The area lies to their left.
    pub tangents: [DVec2; 2],
}

/// An area of the plane.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Area {
    /// Corners, loop by loop.
    pub corners: Vec<Corner>,
    /// How many corners each loop has. Outer loops run counter-clockwise, holes clockwise.
    pub loops: Vec<u32>,
    /// Indices of corners, counter-clockwise. Their corners are all of the border's, and every
    /// edge of the border is the edge of one triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl Area {
    /// The corners of each loop, as ranges.
    pub fn loop_ranges(&self) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
        let mut end = 0;
        self.loops.iter().map(move |&count| {
            let start = end;
            end += count as usize;
            start..end
        })
    }
}

/// Curves differ from their chords by less; what differs by more is not the same border.
const TANGENT_COSINE: f64 = 0.5;

/// The area that the polygons wind around a number of times that is not zero.
///
/// Corners are moved onto a grid of steps `grid` first; polygons of points beyond
/// [`MAX_COORDINATE`] steps, or without a value, are left out.
#[must_use]
pub fn fill(polylines: &[Polyline], grid: f64) -> Area {
    let mut tangents = BTreeMap::new();
    let mut contours: Vec<Vec<IntPoint<i32>>> = Vec::new();
    for line in polylines {
        let Some(contour) = on_grid(&line.points, grid) else {
            continue;
        };
        for (point, &pair) in contour.iter().zip(&line.tangents) {
            // Where two borders touch, neither's direction counts.
            tangents
                .entry((point.x, point.y))
                .and_modify(|known| *known = None)
                .or_insert(Some(pair));
        }
        contours.push(contour);
    }
    let shapes = Overlay::from_subj(&contours).overlay(OverlayRule::Subject, FillRule::NonZero);
    let mut area = Area::default();
    for shape in &shapes {
        let mut numbers = BTreeMap::new();
        for contour in shape {
            let first = area.corners.len();
            for (i, point) in contour.iter().enumerate() {
                numbers
                    .entry((point.x, point.y))
                    .or_insert((first + i) as u32);
                let before = contour[(i + contour.len() - 1) % contour.len()];
                let after = contour[(i + 1) % contour.len()];
                let p = off_grid(*point, grid);
                let chords = [
                    (p - off_grid(before, grid)).normalize_or_zero(),
                    (off_grid(after, grid) - p).normalize_or_zero(),
                ];
                let known = tangents.get(&(point.x, point.y)).copied().flatten();
                area.corners.push(Corner {
                    p,
                    tangents: known.map_or(chords, |known| agreeing(known, chords)),
                });
            }
            area.loops.push(contour.len() as u32);
        }
        let raw = shape.uncheck_triangulate();
        let points = raw.points();
        let number = |index: u32| {
            let point = points.get(index as usize)?;
            numbers.get(&(point.x, point.y)).copied()
        };
        let indices = raw.triangle_indices::<u32>();
        for triangle in indices.as_chunks::<3>().0 {
            if let [Some(a), Some(b), Some(c)] = triangle.map(number) {
                area.triangles.push([a, b, c]);
            }
        }
    }
    area
}

fn on_grid(points: &[DVec2], grid: f64) -> Option<Vec<IntPoint<i32>>> {
    let place = |p: &DVec2| {
        let p = (*p / grid).round();
        // NaN fails, too.
        (p.abs().max_element() <= MAX_COORDINATE && p.is_finite())
            .then(|| IntPoint::new(p.x as i32, p.y as i32))
    };
    points.iter().map(place).collect()
}

fn off_grid(point: IntPoint<i32>, grid: f64) -> DVec2 {
    DVec2::new(f64::from(point.x), f64::from(point.y)) * grid
}

/// The curve's directions where they are about those of the border's edges, which may run the
/// other way; else the edges' own.
fn agreeing(curve: [DVec2; 2], edges: [DVec2; 2]) -> [DVec2; 2] {
    let [comes, leaves] = curve;
    let agree = |candidate: [DVec2; 2]| {
        (candidate[0].dot(edges[0]) > TANGENT_COSINE && candidate[1].dot(edges[1]) > TANGENT_COSINE)
            .then_some(candidate)
    };
    agree(curve)
        .or_else(|| agree([-leaves, -comes]))
        .unwrap_or(edges)
}
