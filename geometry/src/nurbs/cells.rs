//! Trim polygons cut along the lines of a grid, and the triangles of a cell that they run through.
//! What is inside and what outside is asked of `outline.rs`.
//!
//! Each cell is triangulated by itself (constrained Delaunay, crate `spade`): triangles never leave
//! a cell, which the chord bound of `divide.rs` needs, and cells that share a border have the same
//! points on it, because a place where a polygon meets a line is computed once.

use std::collections::{BTreeMap, HashMap};

use glam::DVec2;
use spade::{ConstrainedDelaunayTriangulation, HierarchyHintGenerator, Point2, Triangulation};

use super::outline::Outline;
use super::{COINCIDENT, MAX_TRIM_CUTS, NurbsError};

/// Finds a point's triangle in logarithmic time.
type Triangles =
    ConstrainedDelaunayTriangulation<Point2<f64>, (), (), (), HierarchyHintGenerator<f64>>;

/// The polygons along a grid. Points are numbered: first the corners of the grid, `u` fastest, then
/// the others.
pub(super) struct Cuts {
    /// The points that are no corners of the grid.
    pub extra: Vec<DVec2>,
    /// The cells (row, column) that a polygon touches.
    pub cells: BTreeMap<(u32, u32), Cell>,
}

/// What is in a cell, its border included.
#[derive(Default)]
pub(super) struct Cell {
    points: Vec<u32>,
    pieces: Vec<[u32; 2]>,
}

/// The grid's lines and corners.
#[derive(Clone, Copy)]
pub(super) struct Lattice<'a> {
    pub u: &'a [f64],
    pub v: &'a [f64],
}

impl Lattice<'_> {
    /// The number of grid corner (i, j).
    pub fn corner(&self, i: usize, j: usize) -> u32 {
        (j * self.u.len() + i) as u32
    }

    /// Number of corners.
    pub fn corners(&self) -> usize {
        self.u.len() * self.v.len()
    }

    /// The middle of cell (i, j).
    pub fn middle(&self, i: usize, j: usize) -> DVec2 {
        let between = |lines: &[f64], k: usize| lines[k] * 0.5 + lines[k + 1] * 0.5;
        DVec2::new(between(self.u, i), between(self.v, j))
    }

    /// Where a numbered point is.
    pub fn place(&self, point: u32, extra: &[DVec2]) -> DVec2 {
        let point = point as usize;
        match point.checked_sub(self.corners()) {
            Some(k) => extra[k],
            None => DVec2::new(self.u[point % self.u.len()], self.v[point / self.u.len()]),
        }
    }
}

/// A number without order: neighbours are far apart. The finalizer of SplitMix64 (Steele, Lea and
/// Flood 2014), which maps no two numbers to one.
fn scattered(number: u32) -> u64 {
    let mut z = u64::from(number).wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The line at exactly `t`.
fn line_at(lines: &[f64], t: f64) -> Option<usize> {
    lines.binary_search_by(|l| l.total_cmp(&t)).ok()
}

/// `t`, or the line that it is meant to be on.
fn snapped(lines: &[f64], t: f64) -> f64 {
    let near = COINCIDENT * (lines[lines.len() - 1] - lines[0]);
    let above = lines.partition_point(|&l| l < t).min(lines.len() - 1);
    let below = above.saturating_sub(1);
    if (lines[above] - t).abs() <= near {
        lines[above]
    } else if (lines[below] - t).abs() <= near {
        lines[below]
    } else {
        // Adding zero turns -0 into +0, so that equal parameters have equal bits.
        t + 0.0
    }
}

/// The cells, at most two, whose closed range along one parameter holds `t`.
fn holding(lines: &[f64], t: f64) -> std::ops::Range<usize> {
    let cells = lines.len() - 1;
    if !(lines[0] <= t && t <= lines[cells]) {
        return 0..0;
    }
    let first = lines.partition_point(|&l| l < t).saturating_sub(1);
    let end = lines.partition_point(|&l| l <= t).min(cells);
    first..end.max(first + 1)
}

impl Cuts {
    pub fn new(outline: &Outline, lattice: Lattice<'_>) -> Result<Self, NurbsError> {
        let mut cuts = Self {
            extra: Vec::new(),
            cells: BTreeMap::new(),
        };
        let mut known = HashMap::new();
        let mut room = MAX_TRIM_CUTS;
        let mut path = Vec::new();
        for [a, b] in outline.edges() {
            let snap = |p: DVec2| DVec2::new(snapped(lattice.u, p.x), snapped(lattice.v, p.y));
            cut_edge(snap(a), snap(b), lattice, &mut path);
            room = room
                .checked_sub(path.len())
                .ok_or(NurbsError::TrimTooIntricate)?;
            for pair in path.windows(2) {
                cuts.piece([pair[0], pair[1]], lattice, &mut known);
            }
        }
        for cell in cuts.cells.values_mut() {
            cell.points.sort_unstable();
            cell.points.dedup();
            // Along a curve each point may undo most of the triangles of those before it; in an
            // order that knows nothing of places it undoes a few.
            cell.points.sort_by_key(|&point| scattered(point));
        }
        Ok(cuts)
    }

    /// Adds a piece that crosses no line.
    fn piece(
        &mut self,
        ends: [DVec2; 2],
        lattice: Lattice<'_>,
        known: &mut HashMap<[u64; 2], u32>,
    ) {
        let middle = ends[0] * 0.5 + ends[1] * 0.5;
        if ends[0] == ends[1]
            || holding(lattice.u, middle.x).is_empty()
            || holding(lattice.v, middle.y).is_empty()
        {
            return;
        }
        let numbers = ends.map(|p| self.number(p, lattice, known));
        for (p, number) in ends.into_iter().zip(numbers) {
            for j in holding(lattice.v, p.y) {
                for i in holding(lattice.u, p.x) {
                    let cell = self.cells.entry((j as u32, i as u32)).or_default();
                    cell.points.push(number);
                }
            }
        }
        // A piece along a line needs no triangle's edge: it is the border of cells.
        let along = |f: fn(DVec2) -> f64, lines: &[f64]| {
            f(ends[0]) == f(ends[1]) && line_at(lines, f(ends[0])).is_some()
        };
        if along(|p| p.x, lattice.u) || along(|p| p.y, lattice.v) {
            return;
        }
        let (i, j) = (
            holding(lattice.u, middle.x).start,
            holding(lattice.v, middle.y).start,
        );
        if let Some(cell) = self.cells.get_mut(&(j as u32, i as u32)) {
            cell.pieces.push(numbers);
        }
    }

    fn number(
        &mut self,
        p: DVec2,
        lattice: Lattice<'_>,
        known: &mut HashMap<[u64; 2], u32>,
    ) -> u32 {
        if let (Some(i), Some(j)) = (line_at(lattice.u, p.x), line_at(lattice.v, p.y)) {
            return lattice.corner(i, j);
        }
        *known
            .entry(p.to_array().map(f64::to_bits))
            .or_insert_with(|| {
                self.extra.push(p);
                (lattice.corners() + self.extra.len() - 1) as u32
            })
    }

    /// The kept triangles of a touched cell, counter-clockwise, as numbered points; and how many
    /// pieces were left out because they cross others.
    pub fn triangles(
        &self,
        at: (u32, u32),
        lattice: Lattice<'_>,
        scale: DVec2,
        outline: &Outline,
        work: &mut usize,
    ) -> Result<(Vec<[u32; 3]>, usize), NurbsError> {
        let (j, i) = (at.0 as usize, at.1 as usize);
        let Some(cell) = self.cells.get(&at) else {
            return Ok((Vec::new(), 0));
        };
        let low = DVec2::new(lattice.u[i], lattice.v[j]);
        let size = DVec2::new(lattice.u[i + 1], lattice.v[j + 1]) - low;
        // Well-shaped in space, not in the parameters; but never far from square.
        let real = size * scale;
        let longest = real.max_element();
        let aspect = if longest > 0.0 {
            (real / longest).max(DVec2::splat(1.0 / 64.0))
        } else {
            DVec2::ONE
        };
        let local = |p: DVec2| {
            let q = (p - low) / size * aspect;
            Point2::new(q.x, q.y)
        };
        let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        let corners = corners.map(|(i, j)| lattice.corner(i, j));
        let mut cdt = Triangles::new();
        let mut number_of = Vec::new();
        let mut handle_of = BTreeMap::new();
        for &number in corners.iter().chain(&cell.points) {
            let Ok(handle) = cdt.insert(local(lattice.place(number, &self.extra))) else {
                continue;
            };
            if handle.index() == number_of.len() {
                number_of.push(number);
            }
            handle_of.insert(number, handle);
        }
        let mut crossings = 0;
        for piece in &cell.pieces {
            let [Some(&a), Some(&b)] = [handle_of.get(&piece[0]), handle_of.get(&piece[1])] else {
                crossings += 1;
                continue;
            };
            if a != b && cdt.try_add_constraint(a, b).is_empty() {
                crossings += 1;
            }
        }
        let triangles = kept(&cdt, &number_of, crossings > 0, |triangle| {
            let places = triangle.map(|n| lattice.place(n, &self.extra));
            outline.keeps((places[0] + places[1] + places[2]) / 3.0, work)
        })?;
        Ok((triangles, crossings))
    }
}

/// The triangles that are kept. Those that no piece parts are alike, so only the largest of them is
/// asked for; with `each`, every one is.
fn kept(
    cdt: &Triangles,
    number_of: &[u32],
    each: bool,
    mut keeps: impl FnMut([u32; 3]) -> Result<bool, NurbsError>,
) -> Result<Vec<[u32; 3]>, NurbsError> {
    let numbers = |corners: [usize; 3]| corners.map(|k| number_of[k]);
    let mut seen = vec![false; cdt.num_all_faces()];
    let mut out = Vec::new();
    for face in cdt.inner_faces() {
        if seen[face.index()] {
            continue;
        }
        seen[face.index()] = true;
        let mut alike = Vec::new();
        let mut open = vec![face];
        let mut largest = (f64::NEG_INFINITY, [0; 3]);
        while let Some(face) = open.pop() {
            let triangle = numbers(face.vertices().map(|v| v.index()));
            alike.push(triangle);
            if face.area() > largest.0 {
                largest = (face.area(), triangle);
            }
            for edge in face.adjacent_edges() {
                if each || edge.is_constraint_edge() {
                    continue;
                }
                if let Some(next) = edge.rev().face().as_inner()
                    && !std::mem::replace(&mut seen[next.index()], true)
                {
                    open.push(next);
                }
            }
        }
        if keeps(largest.1)? {
            out.append(&mut alike);
        }
    }
    Ok(out)
}

/// The places of an edge from `a` to `b`: its ends, and where it crosses lines, in order.
fn cut_edge(a: DVec2, b: DVec2, lattice: Lattice<'_>, path: &mut Vec<DVec2>) {
    let mut cuts: Vec<(f64, DVec2)> = Vec::new();
    let d = b - a;
    let between = |lines: &[f64], from: f64, to: f64| {
        let (low, high) = (from.min(to), from.max(to));
        let first = lines.partition_point(|&l| l <= low);
        first..lines.partition_point(|&l| l < high).max(first)
    };
    for i in between(lattice.u, a.x, b.x) {
        let t = (lattice.u[i] - a.x) / d.x;
        cuts.push((
            t,
            DVec2::new(lattice.u[i], snapped(lattice.v, a.y + d.y * t)),
        ));
    }
    for j in between(lattice.v, a.y, b.y) {
        let t = (lattice.v[j] - a.y) / d.y;
        cuts.push((
            t,
            DVec2::new(snapped(lattice.u, a.x + d.x * t), lattice.v[j]),
        ));
    }
    cuts.sort_by(|x, y| x.0.total_cmp(&y.0));
    path.clear();
    path.push(a);
    path.extend(cuts.into_iter().map(|(_, p)| p));
    path.push(b);
    path.dedup();
}
