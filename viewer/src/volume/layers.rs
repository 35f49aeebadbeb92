//! An upper bound of the count that any point can get, so that a stencil buffer with few bits
//! does not wrap. Not an exact maximum.
//!
//! Along a ray from the light the count only grows, so the most that a point on the ray can
//! get is the number `N` of casting triangles that the ray meets. `N` is a function on the
//! sphere of directions from the light (on a plane, for a light at infinity) that is constant
//! but for jumps at silhouette sides, by one at each. So on a convex cell of directions
//!
//! ```text
//! N <= N(reference point of the cell) + sides that touch the cell and have the reference
//!                                       point on their outer side
//! ```
//!
//! because the straight way from the reference point to any other crosses a side at most
//! once, and inwards only from its outer side. Cells are the faces of a cube around the light,
//! or the box of the projection; the cell with the largest bound is cut in four until that
//! bound is small enough or a budget is used up. The reference value of a cell is found by
//! walking from that of the parent. Rounding only makes the bound larger: a crossing that is
//! not certain counts, and a side that is near a cell touches it.

use std::collections::BinaryHeap;

use geometry::bounds::Aabb;
use glam::{DAffine3, DVec2, DVec3, DVec4};

use crate::volume::exact::bounded_determinant;
use crate::volume::light::Light;
use crate::volume::topology::CasterMesh;

/// A caster whose volume [`layer_bound`] looks at.
#[derive(Clone, Copy, Debug)]
pub struct LayerCaster<'a> {
    /// The mesh.
    pub mesh: &'a CasterMesh,
    /// The signs of its triangles, from [`crate::volume::facing()`].
    pub signs: &'a [i8],
    /// The sides by the silhouette method, from [`crate::volume::extract()`].
    pub sides: &'a [u32],
    /// From the mesh's frame to that of the light given to [`layer_bound`].
    pub frame_from_local: DAffine3,
}

/// How far beside a cell a side still touches it, relative to the cell's coordinates: what a
/// device may be off by in some four roundings of `f32`.
const DEVICE_ERROR: f64 = 1.0 / (1 << 20) as f64;

/// The most that sides are looked at for each side, and in all: some tenths of a second.
const LOOKS_PER_SIDE: usize = 256;
const MAX_LOOKS: usize = 1 << 24;

/// Cells smaller than the device error are of no use.
const MAX_DEPTH: u32 = 20;

/// A number that no point's count exceeds, in the volumes of all these casters of one light
/// together. Refined until it is at most `limit`, or until that is found to be impossible or
/// too much work; so a result above `limit` may be far too large, and 0 asks for all that can
/// be done.
///
/// The light is in the frame that `frame_from_local` leads to. 0 for a light that is not
/// finite, because it casts nothing.
#[must_use]
pub fn layer_bound(casters: &[LayerCaster<'_>], light: DVec4, limit: u32) -> u32 {
    let casting: usize = casters
        .iter()
        .flat_map(|caster| caster.signs)
        .filter(|&&s| s != 0)
        .count();
    // More than all casting triangles is not possible; few of them need no search.
    let most = u32::try_from(casting).unwrap_or(u32::MAX);
    let Some(light) = Light::new(light) else {
        return 0;
    };
    if most <= limit {
        return most;
    }
    refine(roots(casters, light), limit).min(most)
}

/// A side as seen from the light, in coordinates of which only the direction matters.
/// Directions `r` on its inner side have `(from, to, r)` run clockwise: a negative determinant.
#[derive(Clone, Copy)]
struct Side {
    from: DVec3,
    to: DVec3,
    count: u32,
}

/// A rectangle of directions `(x, y, 1)`.
#[derive(Clone, Copy)]
struct Cell {
    min: DVec2,
    max: DVec2,
}

impl Cell {
    /// A point inside that is on no symmetry of a model.
    fn reference(&self) -> DVec3 {
        let across = self.max - self.min;
        (self.min + across * DVec2::new(0.463_251, 0.528_417)).extend(1.0)
    }

    fn quarter(&self, quarter: usize) -> Self {
        let middle = self.min.midpoint(self.max);
        let (mut min, mut max) = (self.min, self.max);
        for axis in 0..2 {
            if quarter >> axis & 1 == 0 {
                max[axis] = middle[axis];
            } else {
                min[axis] = middle[axis];
            }
        }
        Self { min, max }
    }

    /// False only if the side is clear of the cell and a margin around it.
    fn may_touch(&self, side: &Side, margin: f64) -> bool {
        let (min, max) = (self.min - margin, self.max + margin);
        let outside = |p: DVec3| {
            [
                p.x < min.x * p.z,
                p.x > max.x * p.z,
                p.y < min.y * p.z,
                p.y > max.y * p.z,
            ]
        };
        let (from, to) = (outside(side.from), outside(side.to));
        if (0..4).any(|i| from[i] && to[i]) {
            return false;
        }
        let corners = [min, max, DVec2::new(min.x, max.y), DVec2::new(max.x, min.y)];
        let sides = corners.map(|corner| certain_sign(side.from, side.to, corner.extend(1.0)));
        sides[0] == 0 || sides.iter().any(|&s| s != sides[0])
    }
}

/// A cell with what touches it.
struct Node {
    bound: u64,
    cell: Cell,
    depth: u32,
    margin: f64,
    /// Not less than `N` at the cell's reference point.
    reference: u64,
    sides: Vec<Side>,
}

impl Node {
    fn new(cell: Cell, depth: u32, margin: f64, reference: u64, candidates: &[Side]) -> Self {
        let touching = candidates
            .iter()
            .filter(|side| cell.may_touch(side, margin));
        let sides: Vec<Side> = touching.copied().collect();
        let at = cell.reference();
        let inwards = sides
            .iter()
            .filter(|side| certain_sign(side.from, side.to, at) >= 0);
        let bound = reference + inwards.map(|side| u64::from(side.count)).sum::<u64>();
        Self {
            bound,
            cell,
            depth,
            margin,
            reference,
            sides,
        }
    }

    fn child(&self, quarter: usize) -> Self {
        let cell = self.cell.quarter(quarter);
        let (from, to) = (self.cell.reference(), cell.reference());
        let reference = walk(self.reference, &self.sides, from, to);
        let mut child = Self::new(cell, self.depth + 1, self.margin, reference, &self.sides);
        child.bound = child.bound.min(self.bound);
        child
    }
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Node {}

impl PartialOrd for Node {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Node {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.bound.cmp(&other.bound)
    }
}

/// Cuts the cell with the largest bound until that is small enough.
fn refine(roots: Vec<Node>, limit: u32) -> u32 {
    let total: usize = roots.iter().map(|node| node.sides.len()).sum();
    let mut looks_left = total.saturating_mul(LOOKS_PER_SIDE).min(MAX_LOOKS);
    let mut heap = BinaryHeap::from(roots);
    while let Some(node) = heap.pop() {
        let looks = node.sides.len() * 4;
        let settled = node.bound <= limit.into() || node.sides.is_empty();
        if settled || node.depth == MAX_DEPTH || looks > looks_left {
            return u32::try_from(node.bound).unwrap_or(u32::MAX);
        }
        looks_left -= looks;
        heap.extend((0..4).map(|quarter| node.child(quarter)));
    }
    0
}

/// -1, 0 or +1: the sign of the determinant, 0 if rounding leaves it open.
fn certain_sign(a: DVec3, b: DVec3, c: DVec3) -> i8 {
    let (determinant, bound) = bounded_determinant(a, b, c);
    i8::from(determinant > bound) - i8::from(determinant < -bound)
}

/// An upper bound of `N` at `to` from one at `from`, the sides being all that may cross the
/// shorter arc between the two directions.
fn walk(value: u64, sides: &[Side], from: DVec3, to: DVec3) -> u64 {
    let (mut inwards, mut outwards) = (0_u64, 0_u64);
    for side in sides {
        // Two arcs cross if these four have one sign, which is -1 for a crossing inwards
        // (the criterion of the library S2).
        let signs = [
            -certain_sign(side.from, side.to, from),
            certain_sign(side.from, side.to, to),
            -certain_sign(from, to, side.to),
            certain_sign(from, to, side.from),
        ];
        let (some_in, some_out) = (signs.contains(&-1), signs.contains(&1));
        let certain = !signs.contains(&0);
        if !some_out {
            inwards += u64::from(side.count);
        } else if !some_in && certain {
            outwards += u64::from(side.count);
        }
    }
    (value + inwards).saturating_sub(outwards)
}

fn roots(casters: &[LayerCaster<'_>], light: Light) -> Vec<Node> {
    match light {
        Light::Point(point) => point_roots(casters, point),
        Light::Towards(direction) => direction_roots(casters, direction),
    }
}

/// The sides of all casters, each end mapped by `project`.
fn project_sides(casters: &[LayerCaster<'_>], project: impl Fn(DVec3) -> DVec3) -> Vec<Side> {
    let mut sides = Vec::new();
    for caster in casters {
        let place = |v: u32| {
            let local = caster.mesh.position(v);
            project(caster.frame_from_local.transform_point3(local))
        };
        for equal in caster.sides.chunk_by(|x, y| x == y) {
            let Some(&[a, b, ..]) = caster.mesh.edges.get((equal[0] >> 1) as usize) else {
                continue;
            };
            let (from, to) = if equal[0] & 1 == 0 { (a, b) } else { (b, a) };
            sides.push(Side {
                from: place(from),
                to: place(to),
                count: u32::try_from(equal.len()).unwrap_or(u32::MAX),
            });
        }
    }
    sides
}

/// The corner of the box of all sides is outside of all volumes: there `N = 0`.
fn direction_roots(casters: &[LayerCaster<'_>], direction: DVec3) -> Vec<Node> {
    let away = -direction.normalize();
    let (right, up) = away.any_orthonormal_pair();
    // A right-handed frame, so that determinants keep their sign.
    let up = if right.cross(up).dot(away) < 0.0 {
        -up
    } else {
        up
    };
    let mut sides = project_sides(casters, |p| DVec3::new(p.dot(right), p.dot(up), 1.0));
    let bounds: Aabb = sides.iter().flat_map(|side| [side.from, side.to]).collect();
    let center = bounds.center().with_z(0.0);
    for side in &mut sides {
        side.from -= center;
        side.to -= center;
    }
    let half = bounds.size().max_element() * 0.5;
    // Larger than the box, so that the walk starts outside.
    let cell = Cell {
        min: DVec2::splat(-1.5 * half),
        max: DVec2::splat(1.5 * half),
    };
    let outside = cell.min.extend(1.0);
    let reference = walk(0, &sides, outside, cell.reference());
    vec![Node::new(cell, 0, half * DEVICE_ERROR, reference, &sides)]
}

/// Six faces of a cube around the light. `N` is counted along one ray, the rest is walked.
fn point_roots(casters: &[LayerCaster<'_>], point: DVec3) -> Vec<Node> {
    let sides = project_sides(casters, |p| p - point);
    let cell = Cell {
        min: DVec2::NEG_ONE,
        max: DVec2::ONE,
    };
    let first = cell.reference();
    let hits: u64 = casters
        .iter()
        .map(|caster| hits(caster, point, first))
        .sum();
    // Of opposite faces, neither is reached by an arc from the other; two steps do.
    let mut start = (first, hits);
    (0..6)
        .map(|face| {
            let at = unturn(face, cell.reference());
            let reference = walk(start.1, &sides, start.0, at);
            start = (at, reference);
            let turned: Vec<Side> = sides
                .iter()
                .map(|side| Side {
                    from: turn(face, side.from),
                    to: turn(face, side.to),
                    count: side.count,
                })
                .collect();
            Node::new(cell, 0, DEVICE_ERROR, reference, &turned)
        })
        .collect()
}

/// Turns the cube so that a face lies at `z = 1`: in this order, neighbours follow each other.
fn turn(face: usize, v: DVec3) -> DVec3 {
    match face {
        0 => v,
        1 => DVec3::new(v.y, v.z, v.x),
        2 => DVec3::new(v.z, v.x, v.y),
        3 => DVec3::new(v.x, -v.y, -v.z),
        4 => DVec3::new(v.y, -v.z, -v.x),
        _ => DVec3::new(v.z, -v.x, -v.y),
    }
}

/// The inverse of [`turn`].
fn unturn(face: usize, v: DVec3) -> DVec3 {
    match face {
        0 => v,
        1 => DVec3::new(v.z, v.x, v.y),
        2 => DVec3::new(v.y, v.z, v.x),
        3 => DVec3::new(v.x, -v.y, -v.z),
        4 => DVec3::new(-v.z, v.x, -v.y),
        _ => DVec3::new(-v.y, -v.z, v.x),
    }
}

/// How many casting triangles the ray may hit.
fn hits(caster: &LayerCaster<'_>, point: DVec3, ray: DVec3) -> u64 {
    let place = |local: DVec3| caster.frame_from_local.transform_point3(local) - point;
    let hits = caster
        .mesh
        .triangles
        .iter()
        .zip(caster.signs)
        .filter(|&(triangle, &s)| {
            if s == 0 {
                return false;
            }
            let [a, b, c] = caster.mesh.corners(triangle).map(place);
            let signs = [
                certain_sign(a, b, ray),
                certain_sign(b, c, ray),
                certain_sign(c, a, ray),
                certain_sign(a, b, c),
            ];
            !(signs.contains(&1) && signs.contains(&-1))
        });
    hits.count() as u64
}
