//! The multiplicity of an edge by reference edges, in `f32`. A reference for comparison, not
//! what is drawn by default.
//!
//! Source: Pečiva et al., *Souhrnná zpráva za rok 2012*, section "Silhouette shadow volumes",
//! algorithms 2 to 4. Each opposite vertex of an edge makes a triangle with it. The triangle's
//! corners are put in geometric order, and the side on which the light is, is found from the
//! edge between the smallest and the largest of them. So the same triangle gives the same sign
//! at all three of its edges, although it is computed three times.
//!
//! The caps use the same function with the same order, so they agree with the sides, and the
//! volume is closed for any rounding.

use std::cmp::Ordering;

use glam::{DVec4, Vec3, Vec4, Vec4Swizzles};

use crate::volume::extract::Volume;
use crate::volume::topology::CasterMesh;

/// Appends the sides of all edges with a multiplicity, and the caps. All triangles cast.
pub(crate) fn extract(mesh: &CasterMesh, light: DVec4, mirrored: bool, volume: &mut Volume) {
    let light = light.as_vec4();
    let orientation = if mirrored { -1 } else { 1 };
    for (number, edge) in (0..).zip(&mesh.edges) {
        let [a, b, ..] = *edge;
        let multiplicity: i32 = mesh
            .refs_of(edge)
            .iter()
            .map(|&r| {
                let opposite = opposite_vertex(&mesh.triangles[(r >> 1) as usize], a, b);
                i32::from(sign_seen_from(light, mesh, [a, b, opposite]))
            })
            .sum();
        volume.push_side(number, orientation * multiplicity);
    }
    volume.push_caps(
        mesh.triangles
            .iter()
            .map(|&[a, b, c, _]| orientation as i8 * sign_seen_from(light, mesh, [a, b, c])),
    );
}

fn opposite_vertex(&[u, v, w, _]: &[u32; 4], a: u32, b: u32) -> u32 {
    if u != a && u != b {
        u
    } else if v != a && v != b {
        v
    } else {
        w
    }
}

/// The sign of the triangle with these corners in this order: that of the ordered triangle,
/// negated if ordering it is an odd permutation.
fn sign_seen_from(light: Vec4, mesh: &CasterMesh, corners: [u32; 3]) -> i8 {
    let mut p = corners.map(|v| Vec4::from(mesh.positions[v as usize]).xyz());
    let mut parity = 1;
    for (i, j) in [(0, 1), (1, 2), (0, 1)] {
        if greater(p[i], p[j]) {
            p.swap(i, j);
            parity = -parity;
        }
    }
    parity * ordered_multiplicity(light, p)
}

/// Algorithm 4, `a < b < c`: the reference edge is the one from `a` to `c`.
fn ordered_multiplicity(light: Vec4, [a, b, c]: [Vec3; 3]) -> i8 {
    let x = c - a;
    let y = light.xyz() - a * light.w;
    let n = x.cross(y).dot(b - a);
    i8::from(n > 0.0) - i8::from(n < 0.0)
}

/// Algorithm 2: the signs of the differences weighted by 4, 2, 1 order points by x, then y,
/// then z.
fn greater(a: Vec3, b: Vec3) -> bool {
    a.to_array().partial_cmp(&b.to_array()) == Some(Ordering::Greater)
}
