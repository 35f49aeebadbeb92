//! Normals where a file gives none: of faces, and of vertices by Inventor's crease-angle
//! rule. Normals that a file gives are not touched here.

mod crease;
#[cfg(test)]
mod tests;

pub use crate::newell::newell_normal;
pub use crease::{Corners, CreaseNormals, MAX_DISTINCT_NORMALS, crease_normals};

use crate::newell::{area_vector, range_factor};
use glam::DVec3;

/// The unit normal of a face given as a loop, by the right-hand rule; zero if the face is
/// degenerate: fewer than three points, a non-finite point, or an area no larger than the
/// rounding error of computing it.
#[must_use]
#[inline]
pub fn face_normal(points: &[DVec3]) -> DVec3 {
    let Some(factor) = range_factor(points) else {
        return DVec3::ZERO;
    };
    let area = area_vector(points, factor);
    if !area.is_significant() {
        return DVec3::ZERO;
    }
    // In range: significant areas of points in the factor's range have lengths above 1e-140.
    area.vector.normalize_or_zero()
}
