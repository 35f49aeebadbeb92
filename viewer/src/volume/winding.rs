//! The winding number of closed components at a point, exactly. Not a point-in-mesh index:
//! each call looks at every triangle once.
//!
//! A ray leaves the point `p` in the direction `z + e x + e^2 y` with an infinitely small `e`,
//! so that it meets no edge and no vertex; signs that are zero for `z` are decided by `x`,
//! then by `y` (simulation of simplicity, Edelsbrunner and Mücke 1990).

use glam::DVec3;
use robust::{Coord, orient2d};

use crate::volume::exact::{sign, volume_sign};
use crate::volume::topology::CasterMesh;

/// For each component that has a point, the winding number of the component's triangles
/// there, or `None` if a triangle touches the point. Means something for closed components
/// only. Components beyond the end of `points` have no point.
pub(crate) fn windings(mesh: &CasterMesh, points: &[Option<DVec3>]) -> Vec<Option<i32>> {
    let mut windings: Vec<Option<i32>> = points.iter().map(|point| point.map(|_| 0)).collect();
    for triangle in &mesh.triangles {
        let component = triangle[3] as usize;
        let Some(Some(point)) = points.get(component) else {
            continue;
        };
        let winding = &mut windings[component];
        match (crossing(mesh.corners(triangle), *point), &winding) {
            (Crossing::None, _) | (_, None) => {}
            (Crossing::Touching, _) => *winding = None,
            (Crossing::Through(outwards), Some(before)) => *winding = Some(before + outwards),
        }
    }
    windings
}

/// How the ray from a point meets a triangle.
enum Crossing {
    None,
    /// The point may lie on the triangle.
    Touching,
    /// +1: the ray leaves through the triangle's front, -1: it enters.
    Through(i32),
}

fn crossing([a, b, c]: [DVec3; 3], p: DVec3) -> Crossing {
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    if low.x > p.x || high.x < p.x || low.y > p.y || high.y < p.y || high.z < p.z {
        return Crossing::None;
    }
    let side = volume_sign(a, b, c, p);
    if side == 0 {
        // In the triangle's plane and above its lower end: inside the box is near enough.
        return if low.z <= p.z {
            Crossing::Touching
        } else {
            Crossing::None
        };
    }
    let hit = [(a, b), (b, c), (c, a)]
        .into_iter()
        .all(|(from, to)| ray_side(p, from, to) == side);
    if hit {
        Crossing::Through(side.into())
    } else {
        Crossing::None
    }
}

/// The sign of the volume of the ray's direction, `from - p` and `to - p`; 0 only if `p` is on
/// the line of the edge.
pub(crate) fn ray_side(p: DVec3, from: DVec3, to: DVec3) -> i8 {
    let minor = |i: usize, j: usize| {
        let coord = |v: DVec3| Coord { x: v[i], y: v[j] };
        sign(orient2d(coord(from), coord(to), coord(p)))
    };
    [(0, 1), (1, 2), (2, 0)]
        .into_iter()
        .map(|(i, j)| minor(i, j))
        .find(|&side| side != 0)
        .unwrap_or(0)
}
