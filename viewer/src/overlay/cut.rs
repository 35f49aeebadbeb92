//! Where a plane cuts solids: the area, in triangles.
//!
//! Each triangle that has corners on both sides gives a piece of the area's border. Its ends lie on
//! edges, and are named by them, so the pieces of a closed mesh meet exactly; corners in the plane
//! count as behind it, so no piece begins in a corner. Pieces that make no closed border, of meshes
//! that are open there, give no area.

use geometry::outline::{MAX_COORDINATE, Polyline, fill};
use glam::{DVec2, DVec3, DVec4, Vec4Swizzles};
use rustc_hash::FxHashMap;
use scenegraph::scene::Scene;

use super::{Corner, MOST, Meshes, anchor, as_f64, from_anchor, shown};
use crate::content::Content;
use crate::volume::topology::CasterMesh;

/// An edge: its two vertices, ascending.
type EdgeName = (u32, u32);

/// The area where the plane `n . p + d = 0` of the world cuts what is shown, each object in its own
/// colour.
pub fn caps(scene: &Scene, content: &Content, meshes: &mut Meshes, plane: DVec4) -> Vec<Corner> {
    let mut corners = Vec::new();
    let normal = plane.xyz();
    let (right, up) = normal.any_orthonormal_pair();
    let anchor = anchor(content);
    // In the plane, near the anchor.
    let origin = anchor - normal * (normal.dot(anchor) + plane.w);
    for (_, object) in shown(content) {
        let (center, half) = (object.bounds.center(), object.bounds.size() * 0.5);
        if (normal.dot(center) + plane.w).abs() > normal.abs().dot(half) {
            continue;
        }
        let Some(mesh) = meshes.of(scene, object) else {
            continue;
        };
        let place = |p: DVec3| object.world_from_mesh.transform_point3(p);
        let loops = borders(mesh, place, plane);
        let polylines: Vec<Polyline> = loops
            .into_iter()
            .map(|points| Polyline {
                tangents: vec![[DVec2::ZERO; 2]; points.len()],
                points: points
                    .into_iter()
                    .map(|p| DVec2::new((p - origin).dot(right), (p - origin).dot(up)))
                    .collect(),
            })
            .collect();
        let reach = polylines
            .iter()
            .flat_map(|line| &line.points)
            .fold(0.0_f64, |reach, p| reach.max(p.abs().max_element()));
        if !(reach > 0.0 && reach.is_finite()) {
            continue;
        }
        let area = fill(&polylines, reach * 2.0 / MAX_COORDINATE);
        let material = &content.surfaces[object.surface as usize];
        let rgba = cap_color(material.diffuse_srgb);
        for triangle in &area.triangles {
            if corners.len() + 3 > MOST {
                return corners;
            }
            corners.extend(triangle.map(|i| {
                let p = area.corners[i as usize].p;
                Corner {
                    p: from_anchor(anchor, origin + right * p.x + up * p.y),
                    object: content.objects.len() as u32,
                    rgba,
                }
            }));
        }
    }
    corners
}

/// Somewhat darker than the surface, so that a cut is told from a face.
fn cap_color(diffuse_srgb: [f64; 3]) -> [u8; 4] {
    let [r, g, b] = diffuse_srgb.map(|c| (c.clamp(0.0, 1.0) * 0.7 * 255.0).round() as u8);
    [r, g, b, 255]
}

/// The closed borders of the cut, in the world.
fn borders(mesh: &CasterMesh, place: impl Fn(DVec3) -> DVec3, plane: DVec4) -> Vec<Vec<DVec3>> {
    let places: Vec<DVec3> = mesh.positions.iter().map(|p| place(as_f64(p))).collect();
    let distances: Vec<f64> = places
        .iter()
        .map(|p| plane.xyz().dot(*p) + plane.w)
        .collect();
    let is_front = |i: u32| distances[i as usize] > 0.0;
    // From the edge where a border comes in to those where it goes on.
    let mut next: FxHashMap<EdgeName, Vec<EdgeName>> = FxHashMap::default();
    let mut starts = Vec::new();
    for &[a, b, c, _] in &mesh.triangles {
        let crossings = [(a, b), (b, c), (c, a)];
        let out = crossings
            .iter()
            .find(|(a, b)| is_front(*a) && !is_front(*b));
        let back = crossings
            .iter()
            .find(|(a, b)| !is_front(*a) && is_front(*b));
        if let (Some(&out), Some(&back)) = (out, back) {
            let (from, to) = (name(out), name(back));
            next.entry(from).or_default().push(to);
            starts.push(from);
        }
    }
    let point = |(a, b): EdgeName| {
        let (p, q) = (places[a as usize], places[b as usize]);
        let (s, t) = (distances[a as usize], distances[b as usize]);
        p + (q - p) * (s / (s - t))
    };
    let mut loops = Vec::new();
    for start in starts {
        let mut points = Vec::new();
        let mut at = start;
        while let Some(to) = next.get_mut(&at).and_then(Vec::pop) {
            points.push(point(at));
            at = to;
            if at == start {
                loops.push(std::mem::take(&mut points));
                break;
            }
        }
    }
    loops
}

fn name((a, b): (u32, u32)) -> EdgeName {
    (a.min(b), a.max(b))
}
