//! Corners to a mesh: positions about a local origin, triangles, normals, welded vertices.
//!
//! Coordinates are numbered anew in order of first use, so a shape that uses little of a long
//! list costs little. Vertices are equal when all their values are, bit by bit.

use geometry::bounds::Aabb;
use geometry::local_origin::local_origin;
use geometry::triangulate::{Outcome, Triangulator};
use geometry::weld::Welder;
use glam::{DVec3, Vec3};
use iv_parser::Severity;

use crate::remarks::Remarks;
use crate::resolve::Ordering;
use crate::scene::{Mesh, Topology};

use super::attributes::Attributes;
use super::corners::{Corners, Take};
use super::normals::NormalMaker;
use super::texcoords::TexCoordMaker;
use super::values::{Normals, Values};
use super::{Job, point};

const UNUSED: u32 = u32::MAX;

/// Makes meshes; holds scratch memory only.
#[derive(Default)]
pub struct Assembler {
    /// For each coordinate of the source its number in the mesh; `UNUSED` between calls.
    numbers: Vec<u32>,
    welder: Welder,
    groups: Vec<u32>,
    words: Vec<u32>,
    used: Vec<u32>,
    made_normals: Vec<[f32; 3]>,
    vertex_of: Vec<u32>,
    corner_of: Vec<u32>,
    /// The numbered coordinates, once something asks for them.
    points: Vec<DVec3>,
    positions: Vec<[f32; 3]>,
    loop_points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// Triangles of polygons that have no area.
    without_area: usize,
    triangulator: Triangulator,
    normal_maker: NormalMaker,
}

impl Assembler {
    /// The mesh of `corners`; `None` if nothing of it can be drawn. Replaces their coordinate
    /// indices by numbers, or takes them.
    pub fn assemble(
        &mut self,
        corners: &mut Corners,
        topology: Topology,
        attributes: &Attributes<'_>,
        job: &Job<'_>,
        remarks: &mut Remarks,
    ) -> Option<Mesh> {
        self.without_area = 0;
        // Scratch is taken out while it is borrowed, and put back.
        let mut used = std::mem::take(&mut self.used);
        let mut made = std::mem::take(&mut self.made_normals);
        let coordinate_count = attributes.coordinate_count();
        self.number_coordinates(&mut corners.coordinates, coordinate_count, &mut used);
        let is_list = topology != Topology::Triangles || corners.is_triangle_list();
        self.points.clear();
        if !is_list {
            self.find_points(attributes, &used);
        }
        let mut positions = std::mem::take(&mut self.positions);
        let (origin, bounds) = if self.points.is_empty() {
            let points = used.iter().map(|&i| coordinate(attributes, i));
            fill_positions(points, &mut positions)
        } else {
            fill_positions(self.points.iter().copied(), &mut positions)
        };
        let words = bytemuck::cast_slice(&positions);
        let group_count = self.welder.weld(words, 3, &mut self.groups);
        if !is_list {
            self.triangulate(corners, attributes, job, remarks);
        }
        let clockwise = attributes.ordering == Ordering::Clockwise;
        // Normals are made for faces only; lines and points are lit if the file gives them some.
        let given = job.lit && enough(attributes, corners, &used, remarks);
        let wants_normals = given || (job.lit && topology == Topology::Triangles);
        if wants_normals && !given {
            self.find_points(attributes, &used);
            let groups = (&self.groups[..], group_count);
            let groups = corners.by_position.then_some(groups);
            let crease_angle_rad = attributes.crease_angle_rad;
            self.normal_maker.make(
                corners,
                &self.points,
                groups,
                crease_angle_rad,
                clockwise,
                &mut made,
            );
        }
        let values = Values {
            used: &used,
            numbers: &corners.coordinates,
            normals: match (wants_normals, given) {
                (false, _) => Normals::None,
                (true, true) => Normals::Given(&corners.normals, attributes.normals),
                (true, false) => Normals::Made(&made),
            },
            colors: (corners.colors != Take::Nothing).then_some((&corners.colors, attributes)),
            texcoords: match (&corners.texcoords, attributes.texcoords) {
                (Take::Nothing, _) | (_, None) => None,
                (take, Some(source)) => {
                    let maker = TexCoordMaker::new(attributes, source, &bounds);
                    Some((take, maker))
                }
            },
        };
        let mut mesh = Mesh {
            topology,
            origin,
            positions: Vec::new(),
            normals: Vec::new(),
            texcoords: Vec::new(),
            colors_srgb: Vec::new(),
            indices: Vec::new(),
            pos: attributes.pos,
        };
        self.corner_of.clear();
        if values.follow_coordinates() && group_count == used.len() {
            // Each coordinate is one vertex; any corner that uses it shows its values.
            self.corner_of.resize(used.len(), 0);
            for (i, &number) in corners.coordinates.iter().enumerate().rev() {
                self.corner_of[number as usize] = i as u32;
            }
            values.fill(&mut mesh, &self.corner_of);
            mesh.positions = given_away(&mut positions);
            mesh.indices = match is_list {
                true => given_away(&mut corners.coordinates),
                false => self.triangle_indices(&corners.coordinates),
            };
        } else {
            self.weld(&values, group_count);
            values.fill(&mut mesh, &self.corner_of);
            let number_of = |&corner: &u32| corners.coordinates[corner as usize] as usize;
            let position = |corner| positions[number_of(corner)];
            mesh.positions = self.corner_of.iter().map(position).collect();
            mesh.indices = match is_list {
                true => self.vertex_of.clone(),
                false => self.triangle_indices(&self.vertex_of),
            };
        }
        self.positions = positions;
        self.used = used;
        self.made_normals = made;
        if topology == Topology::Triangles {
            let dropped = drop_collapsed(&mut mesh) + self.without_area;
            // Of a shape that is given by rule the ends may meet in a point.
            if dropped > 0 && job.made.is_none() {
                remarks.count(
                    Severity::Note,
                    "degenerate",
                    "triangles without an area are left out",
                    "they show nothing",
                    attributes.pos,
                    dropped,
                );
            }
            let by_normals = given && attributes.ordering == Ordering::Unknown;
            if clockwise || by_normals {
                turn(&mut mesh, clockwise);
            }
        }
        (!mesh.indices.is_empty()).then_some(mesh)
    }

    /// Looks up the numbered coordinates, unless that was done.
    fn find_points(&mut self, attributes: &Attributes<'_>, used: &[u32]) {
        if self.points.is_empty() {
            let points = used.iter().map(|&i| coordinate(attributes, i));
            self.points.extend(points);
        }
    }

    /// The triangles' corners, each replaced by what `map` has for it.
    fn triangle_indices(&self, map: &[u32]) -> Vec<u32> {
        let corners = self.triangles.as_flattened();
        corners.iter().map(|&c| map[c as usize]).collect()
    }

    /// Replaces coordinate indices by numbers in order of first use; `used` gets the indices.
    fn number_coordinates(&mut self, indices: &mut [u32], count: usize, used: &mut Vec<u32>) {
        if self.numbers.len() < count {
            self.numbers.resize(count, UNUSED);
        }
        used.clear();
        for index in indices {
            let number = &mut self.numbers[*index as usize];
            if *number == UNUSED {
                *number = used.len() as u32;
                used.push(*index);
            }
            *index = *number;
        }
        for &index in used.iter() {
            self.numbers[index as usize] = UNUSED;
        }
    }

    fn triangulate(
        &mut self,
        corners: &Corners,
        attributes: &Attributes<'_>,
        job: &Job<'_>,
        remarks: &mut Remarks,
    ) {
        self.triangles.clear();
        for range in corners.faces() {
            let first = range.start as u32;
            if range.len() == 3 {
                self.triangles.push([first, first + 1, first + 2]);
                continue;
            }
            if job.fans {
                let fan = (2..range.len() as u32).map(|i| [first, first + i - 1, first + i]);
                self.triangles.extend(fan);
                continue;
            }
            let range_len = range.len();
            let at = |n: u32| self.points[n as usize];
            let numbers = &corners.coordinates[range];
            let begin = self.triangles.len();
            let quad;
            let points: &[DVec3] = if let &[a, b, c, d] = numbers {
                quad = [at(a), at(b), at(c), at(d)];
                &quad
            } else {
                self.loop_points.clear();
                self.loop_points.extend(numbers.iter().map(|&n| at(n)));
                &self.loop_points
            };
            let outcome = self.triangulator.triangulate(points, &mut self.triangles);
            for triangle in &mut self.triangles[begin..] {
                *triangle = triangle.map(|i| i + first);
            }
            match outcome {
                Outcome::Triangulated => {}
                Outcome::Degenerate => self.without_area += range_len - 2,
                Outcome::SelfIntersecting => remarks.warn(
                    "crossing-polygon",
                    "a polygon crosses itself",
                    "its triangles may overlap",
                    attributes.pos,
                ),
                Outcome::BudgetExceeded => remarks.warn(
                    "hard-polygon",
                    "a polygon is too intricate",
                    "the rest of it was filled as if it were convex",
                    attributes.pos,
                ),
            }
        }
    }

    /// Finds the vertex of each corner, and a corner of each vertex: corners with equal values
    /// share one.
    fn weld(&mut self, values: &Values<'_>, group_count: usize) {
        if let Some(normals) = values.made_normals_only() {
            // The usual case of generated normals: few in each place, and never NaN.
            let groups = &self.groups;
            let welded = self.welder.weld_in_groups(
                values.numbers.iter().map(|&number| groups[number as usize]),
                group_count,
                |i, j| normals[i as usize] == normals[j as usize],
                &mut self.vertex_of,
                &mut self.corner_of,
            );
            if welded {
                return;
            }
        }
        self.weld_by_words(values);
        self.corner_of.clear();
        for (&vertex, corner) in self.vertex_of.iter().zip(0..) {
            if vertex as usize == self.corner_of.len() {
                self.corner_of.push(corner);
            }
        }
    }

    fn weld_by_words(&mut self, values: &Values<'_>) {
        self.words.clear();
        let corners = values.numbers.iter().zip(0..);
        let mut stride = 0;
        for (&number, corner) in corners {
            self.words.push(self.groups[number as usize]);
            values.push_key(corner, &mut self.words);
            if corner == 0 {
                stride = self.words.len();
                self.words.reserve(stride * values.numbers.len());
            }
        }
        self.welder.weld(&self.words, stride, &mut self.vertex_of);
    }
}

/// The local origin of points, and the box around them; `positions` gets them relative to it.
pub(super) fn fill_positions(
    points: impl ExactSizeIterator<Item = DVec3> + Clone,
    positions: &mut Vec<[f32; 3]>,
) -> (DVec3, Aabb) {
    let mut bounds = Aabb::EMPTY;
    points.clone().for_each(|p| bounds.include(p));
    let origin = local_origin(&bounds);
    // Adding zero turns -0 into +0, so that equal positions have equal bits.
    let store = |p: DVec3| {
        let limit = DVec3::splat(f64::from(f32::MAX));
        ((p - origin).clamp(-limit, limit).as_vec3() + Vec3::ZERO).to_array()
    };
    positions.clear();
    positions.reserve_exact(points.len());
    positions.extend(points.map(store));
    (origin, bounds)
}

/// The values of a scratch array as one of exactly their size: given away if that is its size,
/// copied if it is larger and may serve on.
fn given_away<T: Copy>(scratch: &mut Vec<T>) -> Vec<T> {
    if scratch.capacity() == scratch.len() {
        std::mem::take(scratch)
    } else {
        scratch.clone()
    }
}

/// A coordinate of the source, which is known to exist.
pub(super) fn coordinate(attributes: &Attributes<'_>, index: u32) -> DVec3 {
    point(
        attributes.coordinates,
        attributes.coordinate_size,
        index as usize,
    )
    .unwrap_or(DVec3::ZERO)
}

/// Whether the file gives a normal for every corner. If not, all are made for faces, as Coin does,
/// and left out for lines and points.
fn enough(
    attributes: &Attributes<'_>,
    corners: &Corners,
    used: &[u32],
    remarks: &mut Remarks,
) -> bool {
    let largest = match &corners.normals {
        Take::Nothing => return false,
        Take::First => Some(0),
        Take::Coordinate => used.iter().max().copied(),
        Take::Corners(list) => list.iter().max().copied(),
    };
    let count = attributes.normals.len() / 3;
    let enough = largest.is_some_and(|i| (i as usize) < count);
    if !enough {
        remarks.warn(
            "few-normals",
            &format!(
                "{} has fewer normals than it uses",
                attributes.node.class_name()
            ),
            "its own were not used",
            attributes.pos,
        );
    }
    enough
}

/// Drops triangles with two corners in the same place; returns how many.
pub(super) fn drop_collapsed(mesh: &mut Mesh) -> usize {
    let collapsed = |t: &[u32; 3], positions: &[[f32; 3]]| {
        let [a, b, c] = t.map(|v| positions[v as usize]);
        t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || a == b || b == c || c == a
    };
    let (triangles, _) = mesh.indices.as_chunks::<3>();
    if !triangles.iter().any(|t| collapsed(t, &mesh.positions)) {
        return 0;
    }
    let before = triangles.len();
    let kept = triangles.iter().filter(|t| !collapsed(t, &mesh.positions));
    mesh.indices = kept.flatten().copied().collect();
    drop_unused(mesh);
    before - mesh.indices.len() / 3
}

/// Drops vertices that no triangle uses, so that the mesh's box is that of what is drawn.
fn drop_unused(mesh: &mut Mesh) {
    let mut number = vec![UNUSED; mesh.positions.len()];
    let mut order = Vec::new();
    for index in &mut mesh.indices {
        let slot = &mut number[*index as usize];
        if *slot == UNUSED {
            *slot = order.len() as u32;
            order.push(*index as usize);
        }
        *index = *slot;
    }
    fn pick<T: Copy>(list: &mut Vec<T>, order: &[usize]) {
        if !list.is_empty() {
            *list = order.iter().map(|&i| list[i]).collect();
        }
    }
    pick(&mut mesh.positions, &order);
    pick(&mut mesh.normals, &order);
    pick(&mut mesh.texcoords, &order);
    pick(&mut mesh.colors_srgb, &order);
}

/// Makes front faces counter-clockwise: all are turned if the source says clockwise; where it
/// says nothing and gives normals, a triangle is turned if it faces against them.
pub(super) fn turn(mesh: &mut Mesh, clockwise: bool) {
    let positions = &mesh.positions;
    let normals = &mesh.normals;
    let faces_away = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| Vec3::from(positions[v as usize]).as_dvec3());
        let n: Vec3 = t.iter().map(|&v| Vec3::from(normals[v as usize])).sum();
        (b - a).cross(c - a).dot(n.as_dvec3()) < 0.0
    };
    for t in mesh.indices.as_chunks_mut::<3>().0 {
        if clockwise || faces_away(t) {
            t.swap(1, 2);
        }
    }
}
