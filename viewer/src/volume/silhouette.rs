//! The silhouette method: the multiplicity of an edge is the sum of the signs of its
//! triangles, each with the way it runs. Integers only, so it cannot disagree with the caps.
//!
//! Source: Kim, Kim and Turk, *A Shadow Volume Algorithm for Opaque and Transparent
//! Non-Manifold Casters* (2008), with the signs decided once for each triangle.

use crate::volume::extract::Volume;
use crate::volume::topology::CasterMesh;

/// Appends the sides of all edges with a multiplicity, and the caps.
pub(crate) fn extract(mesh: &CasterMesh, signs: &[i8], volume: &mut Volume) {
    let signs = &signs[..signs.len().min(mesh.triangles.len())];
    for (number, edge) in (0..).zip(&mesh.edges) {
        let refs = mesh.refs_of(edge);
        let multiplicity = refs.iter().map(|&r| contribution(signs, r)).sum();
        volume.push_side(number, multiplicity);
    }
    volume.push_caps(signs.iter().copied());
}

/// The sign of a reference's triangle, negated if it runs `b -> a`.
#[inline]
pub(crate) fn contribution(signs: &[i8], reference: u32) -> i32 {
    let s = signs
        .get((reference >> 1) as usize)
        .map_or(0, |&s| s.into());
    if reference & 1 == 0 { s } else { -s }
}
