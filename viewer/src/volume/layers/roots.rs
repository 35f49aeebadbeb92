//! The cells that a search begins with: sides seen from the light, and first reference values.

use geometry::bounds::Aabb;
use glam::{DVec2, DVec3};

use crate::volume::layers::cell::{Cell, Plane, Side, walk};
use crate::volume::layers::{DEVICE_ERROR, LayerCaster};
use crate::volume::light::Light;

/// A cell to begin with.
pub(super) struct Root {
    pub(super) cell: Cell,
    /// How far beside a cell a side still touches it.
    pub(super) margin: f64,
    /// Not less than `N` at the cell's reference point.
    pub(super) reference: u64,
    /// All sides that may touch the cell.
    pub(super) sides: Vec<Side>,
}

/// The cells that all directions in which there are volumes are in.
pub(super) fn roots(casters: &[LayerCaster<'_>], light: Light) -> Vec<Root> {
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
            let count = u32::try_from(equal.len()).unwrap_or(u32::MAX);
            sides.push(Side::new(place(from), place(to), count));
        }
    }
    sides
}

/// The corner of the box of all sides is outside of all volumes: there `N = 0`.
fn direction_roots(casters: &[LayerCaster<'_>], direction: DVec3) -> Vec<Root> {
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
        *side = Side::new(side.from - center, side.to - center, side.count);
    }
    let half = bounds.size().max_element() * 0.5;
    // Larger than the box, so that the walk starts outside.
    let cell = Cell {
        min: DVec2::splat(-1.5 * half),
        max: DVec2::splat(1.5 * half),
    };
    let outside = cell.min.extend(1.0);
    let reference = walk(0, sides.iter(), outside, cell.reference());
    vec![Root {
        cell,
        margin: half * DEVICE_ERROR,
        reference,
        sides,
    }]
}

/// Six faces of a cube around the light. `N` is counted along one ray, the rest is walked.
fn point_roots(casters: &[LayerCaster<'_>], point: DVec3) -> Vec<Root> {
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
            let reference = walk(start.1, sides.iter(), start.0, at);
            start = (at, reference);
            let turned: Vec<Side> = sides
                .iter()
                .map(|side| Side::new(turn(face, side.from), turn(face, side.to), side.count))
                .filter(|side| cell.may_touch(side, DEVICE_ERROR))
                .collect();
            Root {
                cell,
                margin: DEVICE_ERROR,
                reference,
                sides: turned,
            }
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
            let front = Plane::new(a, b);
            let signs = [
                front.side_of(ray),
                Plane::new(b, c).side_of(ray),
                Plane::new(c, a).side_of(ray),
                front.side_of(c),
            ];
            !(signs.contains(&1) && signs.contains(&-1))
        });
    hits.count() as u64
}
