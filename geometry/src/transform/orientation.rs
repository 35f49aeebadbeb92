//! What a matrix does to orientation: whether it mirrors, and how normals follow it.

use crate::num::{exponent, scale_pow2_vec};
use glam::{DAffine3, DMat3, DVec3};
use robust::Coord3D;

/// Whether the matrix turns counter-clockwise faces clockwise: its determinant is negative.
///
/// The sign is exact (Shewchuk's adaptive predicate). Singular and non-finite matrices do
/// not mirror.
#[must_use]
pub fn is_mirroring(world_from_local: &DAffine3) -> bool {
    let m = &world_from_local.matrix3;
    m.is_finite() && determinant_sign(m) < 0.0
}

/// The matrix that takes normals from local to world, up to a positive factor; normalise
/// the results.
///
/// It is the inverse transpose where that exists, computed as the cofactor matrix times the
/// determinant's sign, so it also serves singular matrices: flattened geometry keeps the
/// normal of its plane. The largest element is about 1; a zero matrix is returned for a
/// matrix of rank below 2, a non-finite matrix gives the identity.
#[must_use]
pub fn normal_matrix(world_from_local: &DAffine3) -> DMat3 {
    let m = &world_from_local.matrix3;
    if !m.is_finite() {
        return DMat3::IDENTITY;
    }
    let sign = if determinant_sign(m) < 0.0 { -1.0 } else { 1.0 };
    let columns = [m.x_axis, m.y_axis, m.z_axis].map(split_exponent);
    // Each column of the cofactor matrix is the cross product of the other two.
    let cofactors = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
        let (a, a_exponent) = columns[i];
        let (b, b_exponent) = columns[j];
        let (cross, e) = split_exponent(a.cross(b) * sign);
        (cross, a_exponent + b_exponent + e)
    });
    let largest = cofactors
        .iter()
        .filter(|(c, _)| *c != DVec3::ZERO)
        .map(|&(_, e)| e)
        .max()
        .unwrap_or(0);
    let [x, y, z] = cofactors.map(|(c, e)| scale_pow2_vec(c, e - largest));
    DMat3::from_cols(x, y, z)
}

/// A vector as one whose largest element is in [1, 2), and a power of two.
fn split_exponent(v: DVec3) -> (DVec3, i32) {
    let e = exponent(v.abs().max_element());
    (scale_pow2_vec(v, -e), e)
}

/// A number with exactly the sign of the determinant.
fn determinant_sign(m: &DMat3) -> f64 {
    // A positive factor for each column changes no sign and keeps products in range.
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis].map(|c| {
        let (c, _) = split_exponent(c);
        Coord3D {
            x: c.x,
            y: c.y,
            z: c.z,
        }
    });
    robust::orient3d(
        x,
        y,
        z,
        Coord3D {
            x: 0.0,
            y: 0.0,
            z: 0.0,
        },
    )
}
