//! Corners to a mesh: positions about a local origin, triangles, normals, welded vertices.
//!
//! Coordinates are numbered anew in order of first use, so a shape that uses little of a long
//! list costs little. Vertices are equal when all their values are, bit by bit.

use geometry::bounds::Aabb;
use geometry::local_origin::local_origin;
use geometry::triangulate::{Outcome, Triangulator};
use geometry::weld::Welder;
use glam::{DVec3, Vec3};

use crate::remarks::Remarks;
use crate::resolve::Ordering;
use crate::scene::{Mesh, Topology};

use super::attributes::Attributes;
use super::faces::{Corners, Take};
use super::normals::NormalMaker;
use super::texcoords::TexCoordMaker;
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
    loop_points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    triangulator: Triangulator,
    normal_maker: NormalMaker,
}

/// The values that corners take, ready to be looked up.
pub(super) struct Values<'a> {
    /// Source coordinate index of each numbered coordinate.
    used: &'a [u32],
    /// Number of each corner's coordinate.
    numbers: &'a [u32],
    normals: Normals<'a>,
    colors: Option<(&'a Take, &'a Attributes<'a>)>,
    texcoords: Option<(&'a Take, TexCoordMaker<'a>)>,
}

enum Normals<'a> {
    None,
    /// From the file.
    Given(&'a Take, &'a [f64]),
    /// One for each corner.
    Made(&'a [[f32; 3]]),
}

impl Values<'_> {
    fn index(&self, take: &Take, corner: usize) -> usize {
        match take {
            Take::Nothing | Take::First => 0,
            Take::Coordinate => self.used[self.numbers[corner] as usize] as usize,
            Take::Corners(list) => list[corner] as usize,
        }
    }

    fn normal(&self, corner: usize) -> Option<[f32; 3]> {
        match &self.normals {
            Normals::None => None,
            Normals::Given(take, list) => {
                let at = 3 * self.index(take, corner);
                Some(unit_normal(list.get(at..at + 3)))
            }
            Normals::Made(list) => Some(list[corner]),
        }
    }

    fn color(&self, corner: usize) -> Option<[f32; 4]> {
        let (take, attributes) = self.colors.as_ref()?;
        Some(attributes.colors.rgba_srgb(self.index(take, corner)))
    }

    fn texcoord(&self, corner: usize) -> Option<[f32; 2]> {
        let (take, maker) = self.texcoords.as_ref()?;
        let coordinate = self.used[self.numbers[corner] as usize] as usize;
        Some(maker.texcoord(self.index(take, corner), coordinate))
    }

    /// Whether every value follows from the coordinate.
    fn follow_coordinates(&self) -> bool {
        let follows = |take: &Take| !matches!(take, Take::Corners(_));
        let normals = match &self.normals {
            Normals::None => true,
            Normals::Given(take, _) => follows(take),
            Normals::Made(_) => false,
        };
        let colors = self.colors.as_ref().is_none_or(|(take, _)| follows(take));
        normals
            && colors
            && self
                .texcoords
                .as_ref()
                .is_none_or(|(take, _)| follows(take))
    }
}

/// A given normal at unit length; (0, 0, 1) for one without direction.
fn unit_normal(given: Option<&[f64]>) -> [f32; 3] {
    let Some(&[x, y, z]) = given else {
        return [0.0, 0.0, 1.0];
    };
    let length = (x * x + y * y + z * z).sqrt();
    if !(length > 1e-150 && length < 1e150) {
        // Squares of such numbers leave the range of f64.
        let v = DVec3::new(x, y, z);
        let v = v / v.abs().max_element();
        return v.normalize_or(DVec3::Z).as_vec3().to_array();
    }
    [x, y, z].map(|v| (v / length) as f32 + 0.0)
}

impl Assembler {
    /// The mesh of `corners`; `None` if nothing of it can be drawn.
    pub fn assemble(
        &mut self,
        mut corners: Corners,
        topology: Topology,
        attributes: &Attributes<'_>,
        job: &Job<'_>,
        remarks: &mut Remarks,
    ) -> Option<Mesh> {
        let used = self.number_coordinates(&mut corners.coordinates, attributes.coordinate_count());
        if used.is_empty() {
            return None;
        }
        let (origin, positions, bounds) = self.positions(attributes, &used);
        let group_count = self
            .welder
            .weld(bytemuck::cast_slice(&positions), 3, &mut self.groups);
        let is_plain_list = corners.ends.is_empty() && corners.step == 3;
        if topology == Topology::Triangles && !is_plain_list {
            self.triangulate(&corners, attributes, &used, remarks);
        }
        let clockwise = attributes.ordering == Ordering::Clockwise;
        let wants_normals = topology == Topology::Triangles && job.lit;
        let given = wants_normals && enough(attributes, &corners, &used, remarks);
        let mut made = Vec::new();
        if wants_normals && !given {
            let groups = corners
                .by_position
                .then_some((&self.groups[..], group_count));
            made = self
                .normal_maker
                .make(&corners, attributes, &used, groups, clockwise);
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
                    Some((take, TexCoordMaker::new(attributes, source, &bounds)))
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
        if values.follow_coordinates() && group_count == used.len() {
            // Each coordinate is one vertex; any corner that uses it shows its values.
            let mut corner_of = vec![0; used.len()];
            for (i, &number) in corners.coordinates.iter().enumerate().rev() {
                corner_of[number as usize] = i;
            }
            fill(&mut mesh, &values, &corner_of);
            mesh.positions = positions;
            drop(values);
            mesh.indices = match topology {
                Topology::Triangles if !is_plain_list => {
                    let list = self.triangles.iter().flatten();
                    list.map(|&c| corners.coordinates[c as usize]).collect()
                }
                _ => corners.coordinates,
            };
        } else {
            let vertex_of = self.weld(&values, &corners.coordinates);
            let mut corner_of = Vec::new();
            for (i, &vertex) in vertex_of.iter().enumerate() {
                if vertex as usize == corner_of.len() {
                    corner_of.push(i);
                }
            }
            fill(&mut mesh, &values, &corner_of);
            let position = |&corner: &usize| positions[corners.coordinates[corner] as usize];
            mesh.positions = corner_of.iter().map(position).collect();
            drop(values);
            mesh.indices = match topology {
                Topology::Triangles if !is_plain_list => {
                    let list = self.triangles.iter().flatten();
                    list.map(|&c| vertex_of[c as usize]).collect()
                }
                _ => vertex_of,
            };
        }
        if topology == Topology::Triangles {
            drop_collapsed(&mut mesh);
            turn(
                &mut mesh,
                clockwise,
                given && attributes.ordering == Ordering::Unknown,
            );
        }
        (!mesh.indices.is_empty()).then_some(mesh)
    }

    /// Replaces coordinate indices by numbers in order of first use; returns the indices used.
    fn number_coordinates(&mut self, indices: &mut [u32], count: usize) -> Vec<u32> {
        if self.numbers.len() < count {
            self.numbers.resize(count, UNUSED);
        }
        let mut used = Vec::new();
        for index in indices {
            let number = &mut self.numbers[*index as usize];
            if *number == UNUSED {
                *number = used.len() as u32;
                used.push(*index);
            }
            *index = *number;
        }
        for &index in &used {
            self.numbers[index as usize] = UNUSED;
        }
        used
    }

    /// The local origin, the positions relative to it, and the box around them.
    fn positions(&self, attributes: &Attributes<'_>, used: &[u32]) -> (DVec3, Vec<[f32; 3]>, Aabb) {
        let at = |&i: &u32| coordinate(attributes, i);
        let mut bounds = Aabb::EMPTY;
        used.iter().for_each(|i| bounds.include(at(i)));
        let origin = local_origin(&bounds);
        // Adding zero turns -0 into +0, so that equal positions have equal bits.
        let store = |p: DVec3| {
            let limit = DVec3::splat(f64::from(f32::MAX));
            ((p - origin).clamp(-limit, limit).as_vec3() + Vec3::ZERO).to_array()
        };
        (origin, used.iter().map(|i| store(at(i))).collect(), bounds)
    }

    fn triangulate(
        &mut self,
        corners: &Corners,
        attributes: &Attributes<'_>,
        used: &[u32],
        remarks: &mut Remarks,
    ) {
        self.triangles.clear();
        for range in corners.faces() {
            if range.len() == 3 {
                let first = range.start as u32;
                self.triangles.push([first, first + 1, first + 2]);
                continue;
            }
            self.loop_points.clear();
            let numbers = &corners.coordinates[range.clone()];
            self.loop_points.extend(
                numbers
                    .iter()
                    .map(|&n| coordinate(attributes, used[n as usize])),
            );
            let begin = self.triangles.len();
            let outcome = self
                .triangulator
                .triangulate(&self.loop_points, &mut self.triangles);
            for triangle in &mut self.triangles[begin..] {
                *triangle = triangle.map(|i| i + range.start as u32);
            }
            match outcome {
                Outcome::Triangulated | Outcome::Degenerate => {}
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

    /// The vertex of each corner: corners with equal values share one.
    fn weld(&mut self, values: &Values<'_>, numbers: &[u32]) -> Vec<u32> {
        use geometry::weld::key_bits;
        self.words.clear();
        let mut stride = 0;
        for (corner, &number) in numbers.iter().enumerate() {
            self.words.push(self.groups[number as usize]);
            self.words
                .extend(values.normal(corner).into_iter().flatten().map(key_bits));
            self.words
                .extend(values.texcoord(corner).into_iter().flatten().map(key_bits));
            self.words
                .extend(values.color(corner).into_iter().flatten().map(key_bits));
            if corner == 0 {
                stride = self.words.len();
            }
        }
        let mut vertex_of = Vec::new();
        self.welder.weld(&self.words, stride, &mut vertex_of);
        vertex_of
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

/// Fills all but positions and indices: vertex `i` has the values of corner `corner_of[i]`.
fn fill(mesh: &mut Mesh, values: &Values<'_>, corner_of: &[usize]) {
    mesh.normals = corner_of.iter().map_while(|&c| values.normal(c)).collect();
    mesh.texcoords = corner_of
        .iter()
        .map_while(|&c| values.texcoord(c))
        .collect();
    mesh.colors_srgb = corner_of.iter().map_while(|&c| values.color(c)).collect();
}

/// Whether the file gives a normal for every corner; if not they are all made, as Coin does.
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
            "normals were made from its faces",
            attributes.pos,
        );
    }
    enough
}

/// Drops triangles with two corners in the same place.
fn drop_collapsed(mesh: &mut Mesh) {
    let collapsed = |t: &[u32; 3], positions: &[[f32; 3]]| {
        let [a, b, c] = t.map(|v| positions[v as usize]);
        t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || a == b || b == c || c == a
    };
    let (triangles, _) = mesh.indices.as_chunks::<3>();
    if triangles.iter().any(|t| collapsed(t, &mesh.positions)) {
        let kept = triangles.iter().filter(|t| !collapsed(t, &mesh.positions));
        mesh.indices = kept.flatten().copied().collect();
        drop_unused(mesh);
    }
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
fn turn(mesh: &mut Mesh, clockwise: bool, by_normals: bool) {
    let positions = &mesh.positions;
    let normals = &mesh.normals;
    let faces_away = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| Vec3::from(positions[v as usize]).as_dvec3());
        let n: Vec3 = t.iter().map(|&v| Vec3::from(normals[v as usize])).sum();
        (b - a).cross(c - a).dot(n.as_dvec3()) < 0.0
    };
    for t in mesh.indices.as_chunks_mut::<3>().0 {
        if clockwise || (by_normals && faces_away(t)) {
            t.swap(1, 2);
        }
    }
}
