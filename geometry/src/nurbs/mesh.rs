//! The triangles of a surface, trimmed or not. How fine they are is decided in `divide.rs`.

use glam::{DVec2, DVec3};

use super::cells::{Cuts, Lattice};
use super::divide::{Grid, surface_grid};
use super::outline::{Outline, TrimLoop};
use super::surface::{Closing, Surface};
use super::{COINCIDENT, Fineness, MAX_TRIM_WORK, NurbsError};

/// Normals at one place that differ by less, in their cosine, are one: 1.4 thousandths of a radian.
const SAME_NORMAL: f64 = 1.0 / (1 << 20) as f64;

const NONE: u32 = u32::MAX;

/// A surface as triangles, counter-clockwise seen from the front.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceMesh {
    /// Places on the surface. Where it closes or ends in a point they are equal bit by bit.
    pub points: Vec<DVec3>,
    /// Unit normals of the surface, one for each point; a place on an edge of the surface has
    /// several points.
    pub normals: Vec<DVec3>,
    /// The parameters (u, v) of each point.
    pub parameters: Vec<DVec2>,
    /// Positions in `points`.
    pub triangles: Vec<[u32; 3]>,
    /// No triangle is farther than this from the surface, and no border of a trimmed surface
    /// farther from its trim curve, but for rounding. Larger than was asked for only where a limit
    /// was met.
    pub chord_bound: f64,
    /// Pieces of trim loops that cross others; near them the border is rough.
    pub trim_crossings: usize,
}

impl Surface {
    /// The triangles for a fineness, cut out by trim loops. The parameters `knots` are
    /// lines of the grid too, as for a texture that has knots of its own.
    ///
    /// # Errors
    ///
    /// [`NurbsError::Tolerance`], [`NurbsError::TooLarge`] and, of the loops,
    /// [`NurbsError::Magnitude`] and [`NurbsError::TrimTooIntricate`].
    pub fn triangles(
        &self,
        fineness: &Fineness,
        knots: (&[f64], &[f64]),
        trim: &[TrimLoop],
    ) -> Result<SurfaceMesh, NurbsError> {
        // A trimmed border errs by the chord of its triangles and that of the trim curve.
        let shared = Fineness {
            chord: fineness.chord * 0.5,
            ..*fineness
        };
        let trimmed = !trim.is_empty();
        let grid = surface_grid(self, if trimmed { &shared } else { fineness }, knots)?;
        let scale = DVec2::from(grid.largest);
        let outline = if trimmed {
            let ((u0, u1), (v0, v1)) = (self.domain_u(), self.domain_v());
            let (low, high) = (DVec2::new(u0, v0), DVec2::new(u1, v1));
            // `u` and `v` err together.
            Outline::new(trim, &shared, scale * std::f64::consts::SQRT_2, low, high)?
        } else {
            None
        };
        let lines = Lattice {
            u: &grid.u.at,
            v: &grid.v.at,
        };
        let cuts = match &outline {
            Some(outline) => Some(Cuts::new(outline, lines)?),
            None => None,
        };
        let extra = cuts.as_ref().map_or(&[][..], |c| &c.extra);
        let mut maker = Maker::new(self, &grid, lines, extra);
        let mut work = MAX_TRIM_WORK;
        for j in 0..lines.v.len() - 1 {
            // Whether the cell before was untouched and kept: its neighbour then is as well.
            let mut last: Option<bool> = None;
            for i in 0..lines.u.len() - 1 {
                let (Some(cuts), Some(outline)) = (&cuts, &outline) else {
                    maker.quad((i, j));
                    continue;
                };
                let at = (j as u32, i as u32);
                if cuts.cells.contains_key(&at) {
                    last = None;
                    let (triangles, crossings) =
                        cuts.triangles(at, lines, scale, outline, &mut work)?;
                    maker.mesh.trim_crossings += crossings;
                    for t in triangles {
                        maker.triangle(t, (i, j));
                    }
                    continue;
                }
                let keep = match last {
                    Some(known) => known,
                    None => outline.keeps(lines.middle(i, j), &mut work)?,
                };
                last = Some(keep);
                if keep {
                    maker.quad((i, j));
                }
            }
        }
        let mut mesh = maker.finish();
        let border = outline.map_or(0.0, |o| o.chord_bound);
        mesh.chord_bound = grid.chord_bound + border;
        Ok(mesh)
    }
}

/// One of the vertices at a numbered point.
struct Vertex {
    runs: [u32; 2],
    vertex: u32,
    next: u32,
}

/// Makes vertices when triangles ask for them.
struct Maker<'a> {
    surface: &'a Surface,
    grid: &'a Grid,
    lines: Lattice<'a>,
    extra: &'a [DVec2],
    closing: Closing,
    near: f64,
    /// For each numbered point the first of its vertices.
    first: Vec<u32>,
    vertices: Vec<Vertex>,
    mesh: SurfaceMesh,
}

impl<'a> Maker<'a> {
    fn new(surface: &'a Surface, grid: &'a Grid, lines: Lattice<'a>, extra: &'a [DVec2]) -> Self {
        Self {
            surface,
            grid,
            lines,
            extra,
            closing: surface.closing(),
            near: COINCIDENT * surface.diagonal(),
            first: vec![NONE; lines.corners() + extra.len()],
            vertices: Vec::new(),
            mesh: SurfaceMesh::default(),
        }
    }

    /// A cell, cut along its shorter diagonal.
    fn quad(&mut self, cell: (usize, usize)) {
        let (i, j) = cell;
        let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        let [a, b, c, d] = corners.map(|(i, j)| self.lines.corner(i, j));
        let [pa, pb, pc, pd] = [a, b, c, d].map(|n| {
            let vertex = self.vertex(n, cell);
            self.mesh.points[vertex as usize]
        });
        if pa.distance_squared(pc) <= pb.distance_squared(pd) {
            self.triangle([a, b, c], cell);
            self.triangle([a, c, d], cell);
        } else {
            self.triangle([a, b, d], cell);
            self.triangle([b, c, d], cell);
        }
    }

    /// A triangle within a cell, unless two of its corners are in one place.
    fn triangle(&mut self, numbers: [u32; 3], cell: (usize, usize)) {
        let triangle = numbers.map(|n| self.vertex(n, cell));
        let [a, b, c] = triangle.map(|v| self.mesh.points[v as usize]);
        if a != b && b != c && c != a {
            self.mesh.triangles.push(triangle);
        }
    }

    /// The vertex of a numbered point as seen from a cell.
    fn vertex(&mut self, number: u32, cell: (usize, usize)) -> u32 {
        let runs = [self.grid.u.run[cell.0], self.grid.v.run[cell.1]];
        let mut next = self.first[number as usize];
        while let Some(known) = self.vertices.get(next as usize) {
            if known.runs == runs {
                return known.vertex;
            }
            next = known.next;
        }
        let span = (self.grid.u.span[cell.0], self.grid.v.span[cell.1]);
        let at = self.lines.place(number, self.extra);
        let here = self.surface.point_in(span.0, span.1, at.x, at.y);
        let normal = self
            .surface
            .normal_in(span, (at.x, at.y), &here, self.grid.largest)
            .unwrap_or(DVec3::ZERO);
        let mut point = self.where_it_closes(at, span).unwrap_or(here.p);
        let mut same = None;
        let mut next = self.first[number as usize];
        while let Some(known) = self.vertices.get(next as usize) {
            let vertex = known.vertex as usize;
            let there = self.mesh.points[vertex];
            // Further away only where the surface is torn.
            if there.distance(point) <= self.near {
                point = there;
                if self.mesh.normals[vertex].dot(normal) >= 1.0 - SAME_NORMAL {
                    same = Some(known.vertex);
                }
            }
            next = known.next;
        }
        let vertex = same.unwrap_or_else(|| {
            self.mesh.points.push(point);
            self.mesh.normals.push(normal);
            self.mesh.parameters.push(at);
            self.mesh.points.len() as u32 - 1
        });
        self.vertices.push(Vertex {
            runs,
            vertex,
            next: self.first[number as usize],
        });
        self.first[number as usize] = self.vertices.len() as u32 - 1;
        vertex
    }

    /// The one place that stands for all that meet here because the surface closes or ends in a
    /// point; `None` where it does neither.
    fn where_it_closes(&self, at: DVec2, span: (usize, usize)) -> Option<DVec3> {
        let closing = &self.closing;
        let ((u0, u1), (v0, v1)) = (self.surface.domain_u(), self.surface.domain_v());
        let mut to = at;
        if closing.closed_u && to.x == u1 {
            to.x = u0;
        }
        if closing.closed_v && to.y == v1 {
            to.y = v0;
        }
        if (closing.point_v[0] && to.y == v0) || (closing.point_v[1] && to.y == v1) {
            to.x = u0;
        }
        if (closing.point_u[0] && to.x == u0) || (closing.point_u[1] && to.x == u1) {
            to.y = v0;
        }
        if to == at {
            return None;
        }
        let span_u = if to.x == at.x {
            span.0
        } else {
            self.surface.u.spans()[0]
        };
        let span_v = if to.y == at.y {
            span.1
        } else {
            self.surface.v.spans()[0]
        };
        Some(self.surface.point_in(span_u, span_v, to.x, to.y).p)
    }

    fn finish(self) -> SurfaceMesh {
        let mut mesh = self.mesh;
        mesh.drop_unused();
        mesh.mend_normals();
        mesh
    }
}

impl SurfaceMesh {
    /// Drops points that no triangle uses.
    fn drop_unused(&mut self) {
        let mut number = vec![NONE; self.points.len()];
        let mut order = Vec::new();
        for corner in self.triangles.as_flattened_mut() {
            let slot = &mut number[*corner as usize];
            if *slot == NONE {
                *slot = order.len() as u32;
                order.push(*corner as usize);
            }
            *corner = *slot;
        }
        self.points = order.iter().map(|&k| self.points[k]).collect();
        self.normals = order.iter().map(|&k| self.normals[k]).collect();
        self.parameters = order.iter().map(|&k| self.parameters[k]).collect();
    }

    /// Gives points without a normal the mean of their triangles'.
    fn mend_normals(&mut self) {
        if self.normals.iter().all(|n| *n != DVec3::ZERO) {
            return;
        }
        let mut sums = vec![DVec3::ZERO; self.points.len()];
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|v| self.points[v as usize]);
            let normal = (b - a).cross(c - a);
            triangle.iter().for_each(|&v| sums[v as usize] += normal);
        }
        for (normal, sum) in self.normals.iter_mut().zip(sums) {
            if *normal == DVec3::ZERO {
                *normal = sum.normalize_or(DVec3::Z);
            }
        }
    }
}
