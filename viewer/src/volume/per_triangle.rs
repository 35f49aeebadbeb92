//! One closed volume for each casting triangle: the plain method that the silhouette method
//! is compared with.

use crate::volume::extract::Volume;
use crate::volume::silhouette::contribution;
use crate::volume::topology::CasterMesh;

/// Appends the three sides of each casting triangle, ordered by edge, and the caps.
pub(crate) fn extract(mesh: &CasterMesh, signs: &[i8], volume: &mut Volume) {
    let signs = &signs[..signs.len().min(mesh.triangles.len())];
    for (number, edge) in (0..).zip(&mesh.edges) {
        for &reference in mesh.refs_of(edge) {
            volume.push_side(number, contribution(signs, reference));
        }
    }
    volume.push_caps(signs.iter().copied());
}
