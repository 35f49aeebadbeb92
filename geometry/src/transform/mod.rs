//! A matrix as translation, rotation and scale, as glTF nodes hold it; with one more
//! rotation when the matrix shears. It does not compose transforms: `glam` does.

mod frame;
mod orientation;
mod svd;
#[cfg(test)]
mod tests;

pub use orientation::{is_mirroring, normal_matrix};

use crate::num::gamma;
use frame::Column;
use glam::{DAffine3, DMat3, DQuat, DVec3};

/// Translation after rotation after scale: `p -> translation + rotation * (scale * p)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trs {
    /// Applied last.
    pub translation: DVec3,
    /// A unit quaternion with `w >= 0`; exactly `(0, 0, 0, 1)` for no rotation.
    pub rotation: DQuat,
    /// Applied first; negative factors mirror.
    pub scale: DVec3,
}

impl Trs {
    /// The matrix of this transform.
    #[must_use]
    pub fn to_affine(&self) -> DAffine3 {
        DAffine3::from_scale_rotation_translation(self.scale, self.rotation, self.translation)
    }
}

/// A matrix in the form glTF nodes can hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Decomposition {
    /// One node suffices.
    Trs(Trs),
    /// The matrix shears: an outer node, and inside it a node that only rotates.
    Sheared {
        /// Applied last.
        outer: Trs,
        /// Applied first.
        inner: DQuat,
    },
}

impl Decomposition {
    /// The matrix of this transform.
    #[must_use]
    pub fn to_affine(&self) -> DAffine3 {
        match self {
            Self::Trs(trs) => trs.to_affine(),
            Self::Sheared { outer, inner } => outer.to_affine() * DAffine3::from_quat(*inner),
        }
    }
}

/// The cosine between two columns up to which [`decompose`] takes them for orthogonal.
///
/// A rotation matrix made of a normalised quaternion has columns orthogonal within about
/// `gamma(12)`, and each product of two matrices adds `gamma(3)`; so this covers a chain of
/// more than sixteen rotated and scaled nodes even if every rounding errs the same way.
/// Matrices that went through `f32` need a wider bound, see [`decompose_within`]: rounding
/// each element changes a column's direction by up to 2^-24, so cosines reach 2^-23.
pub const ORTHOGONAL_COSINE: f64 = gamma(64);

/// Splits a matrix into translation, rotation and scale; see [`decompose_within`], here with
/// [`ORTHOGONAL_COSINE`].
#[must_use]
pub fn decompose(world_from_local: &DAffine3) -> Decomposition {
    decompose_within(world_from_local, ORTHOGONAL_COSINE)
}

/// Splits a matrix into translation, rotation and scale.
///
/// If the cosine of each pair of columns is at most `max_cosine`, the result is one
/// [`Trs`] and differs from the matrix by about `max_cosine` times its norm at most;
/// otherwise it is the singular value decomposition `U S V^T` as `Sheared { outer: U S,
/// inner: V^T }`, exact to a few ulps of the norm.
///
/// - A mirroring matrix gets its sign on one scale factor, or on all three, whichever leaves
///   the smallest rotation: `diag(-1, 1, 1)` is scale `(-1, 1, 1)` without rotation.
/// - A regular diagonal matrix with at most one negative, or three negative, elements is kept
///   bit for bit.
/// - A scale factor that a rotation has left within `max_cosine` of 1 becomes 1.
/// - Singular matrices have scale factors that are zero, or rounding noise if they shear.
///   Magnitudes may span the range of `f64`, short of its last factor of two.
/// - A linear part with a NaN or an infinity is replaced by the identity; the translation is
///   always passed on as it is.
#[must_use]
pub fn decompose_within(world_from_local: &DAffine3, max_cosine: f64) -> Decomposition {
    let translation = world_from_local.translation;
    let linear = world_from_local.matrix3;
    if !linear.is_finite() {
        return Decomposition::Trs(Trs {
            translation,
            rotation: DQuat::IDENTITY,
            scale: DVec3::ONE,
        });
    }
    let columns = columns_of(&linear);
    let is_orthogonal = [(0, 1), (0, 2), (1, 2)]
        .into_iter()
        .all(|(i, j)| columns[i].unit.dot(columns[j].unit).abs() <= max_cosine);
    if is_orthogonal {
        let trs = frame::trs_from_columns(translation, columns, max_cosine);
        return Decomposition::Trs(trs);
    }
    let svd = svd::one_sided_jacobi(&linear);
    Decomposition::Sheared {
        outer: frame::trs_from_columns(translation, svd.u_times_s, ORTHOGONAL_COSINE),
        inner: frame::quat_from_axes(svd.v).conjugate(),
    }
}

/// The largest factor by which a finite matrix lengthens a vector: its largest singular value.
#[must_use]
pub fn largest_stretch(linear: &DMat3) -> f64 {
    let columns = svd::one_sided_jacobi(linear).u_times_s;
    columns.iter().fold(0.0, |most, c| most.max(c.length))
}

fn columns_of(m: &DMat3) -> [Column; 3] {
    [m.x_axis, m.y_axis, m.z_axis].map(Column::new)
}
