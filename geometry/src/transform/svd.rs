//! The singular value decomposition of a 3x3 matrix by one-sided Jacobi rotations.
//! Singular values are not sorted: a nearly diagonal matrix keeps its axes in place.
//!
//! Source: Golub and Van Loan, *Matrix Computations*, 4th ed., section 8.6.3 (Hestenes'
//! method); the rotation is that of section 8.5.2.

use super::frame::Column;
use crate::num::{exponent, gamma, scale_pow2_vec};
use glam::{DMat3, DVec3};

/// `M = U * S * V^T`.
pub(super) struct Svd {
    /// The columns of `U * S`; mutually orthogonal, possibly zero.
    pub(super) u_times_s: [Column; 3],
    /// The columns of the rotation `V`.
    pub(super) v: [DVec3; 3],
}

/// Jacobi rotations converge quadratically: six sweeps do for any 3x3 matrix seen, and the
/// cap only bounds the cost.
const MAX_SWEEPS: usize = 32;

/// Columns count as orthogonal below this cosine: a normalised column carries four
/// roundings, the dot product of two adds three.
const CONVERGED_COSINE: f64 = gamma(11);

/// A rotated column shorter than this part of what it was computed from consists of
/// rounding errors (four for the factors' sine and cosine, two here; doubled) and is zero.
/// Without this, sweep after sweep would shrink it until it has no direction.
const CANCELLED: f64 = gamma(12);

/// Decomposes a finite matrix of any magnitude and rank.
pub(super) fn one_sided_jacobi(m: &DMat3) -> Svd {
    // Scaled to near 1, away from overflow and from numbers with fewer digits.
    let columns = [m.x_axis, m.y_axis, m.z_axis];
    let max = columns
        .map(|c| c.abs().max_element())
        .into_iter()
        .fold(0.0, f64::max);
    let e = exponent(max);
    let mut a = columns.map(|c| scale_pow2_vec(c, -e));
    let mut v = [DVec3::X, DVec3::Y, DVec3::Z];
    for _ in 0..MAX_SWEEPS {
        let mut rotated = false;
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if let Some(rotation) = Rotation::orthogonalizing(a[p], a[q]) {
                rotation.apply(&mut a, p, q, true);
                rotation.apply(&mut v, p, q, false);
                rotated = true;
            }
        }
        if !rotated {
            break;
        }
    }
    Svd {
        u_times_s: a.map(|c| Column::new(c).scaled(e)),
        v,
    }
}

/// A plane rotation by the angle with this cosine and sine.
struct Rotation {
    cos: f64,
    sin: f64,
}

impl Rotation {
    /// The rotation that makes two columns orthogonal, or `None` if they are.
    fn orthogonalizing(p: DVec3, q: DVec3) -> Option<Self> {
        let (p, q) = (Column::new(p), Column::new(q));
        let cosine = p.unit.dot(q.unit);
        if cosine.abs() <= CONVERGED_COSINE {
            return None;
        }
        // zeta = (|q|^2 - |p|^2) / (2 p.q), with the lengths' ratio taken first so that no
        // square overflows.
        let zeta = (q.length / p.length - p.length / q.length) / (2.0 * cosine);
        // Beyond this, 1 + zeta^2 equals zeta^2, which might overflow.
        const LARGE: f64 = 1e100;
        let tan = if zeta.abs() > LARGE {
            0.5 / zeta
        } else {
            1.0_f64.copysign(zeta) / (zeta.abs() + (1.0 + zeta * zeta).sqrt())
        };
        let cos = 1.0 / (1.0 + tan * tan).sqrt();
        // A rotation too small to be represented leaves the columns as they are.
        (tan != 0.0).then_some(Self {
            cos,
            sin: cos * tan,
        })
    }

    fn apply(&self, columns: &mut [DVec3; 3], p: usize, q: usize, zero_cancelled: bool) {
        let sum = |a: DVec3, b: DVec3| {
            let sum = a + b;
            let largest = a.abs().max(b.abs()).max_element();
            let is_noise = sum.abs().max_element() <= CANCELLED * largest;
            if zero_cancelled && is_noise {
                DVec3::ZERO
            } else {
                sum
            }
        };
        let (old_p, old_q) = (columns[p], columns[q]);
        columns[p] = sum(old_p * self.cos, old_q * -self.sin);
        columns[q] = sum(old_p * self.sin, old_q * self.cos);
    }
}
