//! Three orthogonal columns as a rotation and a scale: missing axes, mirroring, exact cases.
//! Whether the columns are orthogonal is decided elsewhere.

use super::Trs;
use crate::num::{exponent, scale_pow2, scale_pow2_vec};
use glam::{DMat3, DQuat, DVec3};

/// A matrix column as direction and length, each to a few ulps at any magnitude.
#[derive(Clone, Copy)]
pub(super) struct Column {
    /// A unit vector, or zero for a zero column.
    pub(super) unit: DVec3,
    pub(super) length: f64,
    /// Whether the column lies along a coordinate axis, so that nothing was rounded.
    is_exact: bool,
}

impl Column {
    pub(super) fn new(v: DVec3) -> Self {
        let max = v.abs().max_element();
        if max == 0.0 {
            return Self {
                unit: DVec3::ZERO,
                length: 0.0,
                is_exact: true,
            };
        }
        // Squares of numbers near 1 neither overflow nor vanish.
        let e = exponent(max);
        let scaled = scale_pow2_vec(v, -e);
        let length = scaled.length();
        Self {
            unit: scaled / length,
            length: scale_pow2(length, e).min(f64::MAX),
            is_exact: v.abs().cmpgt(DVec3::ZERO).bitmask().count_ones() == 1,
        }
    }

    /// The same direction, `2^e` times as long.
    pub(super) fn scaled(self, e: i32) -> Self {
        Self {
            length: scale_pow2(self.length, e).min(f64::MAX),
            ..self
        }
    }
}

/// The transform whose linear part has these mutually orthogonal columns. Lengths within
/// `snap` of 1 become 1 unless they are exact.
pub(super) fn trs_from_columns(translation: DVec3, columns: [Column; 3], snap: f64) -> Trs {
    let mut axes = completed(columns.map(|c| c.unit));
    let signs = mirror_signs(&axes);
    for (axis, sign) in axes.iter_mut().zip(signs) {
        *axis *= sign;
    }
    let length = |i: usize| {
        let Column {
            length, is_exact, ..
        } = columns[i];
        let snapped = if !is_exact && (length - 1.0).abs() <= snap {
            1.0
        } else {
            length
        };
        // Not a negative zero: it would be printed.
        if snapped == 0.0 {
            0.0
        } else {
            signs[i] * snapped
        }
    };
    Trs {
        translation,
        rotation: quat_from_axes(axes),
        scale: DVec3::new(length(0), length(1), length(2)),
    }
}

/// The rotation that takes the coordinate axes to these orthonormal right-handed ones, with
/// `w >= 0`.
pub(super) fn quat_from_axes([x, y, z]: [DVec3; 3]) -> DQuat {
    let q = DQuat::from_rotation_axes(x, y, z).normalize();
    let q = if q.w < 0.0 { -q } else { q };
    // Adding +0 turns -0 into +0.
    q + DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0)
}

/// Replaces zero vectors among orthonormal ones so that the three form a right-handed basis.
fn completed(units: [DVec3; 3]) -> [DVec3; 3] {
    let is_set = units.map(|u| u != DVec3::ZERO);
    let mut axes = units;
    match is_set.iter().filter(|&&set| set).count() {
        0 => axes = [DVec3::X, DVec3::Y, DVec3::Z],
        1 => {
            let i = is_set.iter().position(|&set| set).unwrap_or(0);
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            // Prefer the coordinate axes themselves, so that diagonal matrices stay unrotated.
            // The one farther from the given axis leaves at least sqrt(1/2) of its length.
            if units[i][j].abs() <= units[i][k].abs() {
                axes[j] = DVec3::AXES[j].reject_from_normalized(units[i]).normalize();
                axes[k] = units[i].cross(axes[j]);
            } else {
                axes[k] = DVec3::AXES[k].reject_from_normalized(units[i]).normalize();
                axes[j] = axes[k].cross(units[i]);
            }
        }
        2 => {
            let i = is_set.iter().position(|&set| !set).unwrap_or(0);
            axes[i] = units[(i + 1) % 3]
                .cross(units[(i + 2) % 3])
                .normalize_or_zero();
        }
        _ => {}
    }
    axes
}

/// Factors of 1 or -1 that make the axes right-handed. Of the ways to do so with one factor
/// or all three negative, the one that leaves the smallest rotation (the largest trace).
fn mirror_signs(axes: &[DVec3; 3]) -> [f64; 3] {
    if DMat3::from_cols(axes[0], axes[1], axes[2]).determinant() >= 0.0 {
        return [1.0; 3];
    }
    const CANDIDATES: [[f64; 3]; 4] = [
        [-1.0, 1.0, 1.0],
        [1.0, -1.0, 1.0],
        [1.0, 1.0, -1.0],
        [-1.0, -1.0, -1.0],
    ];
    let trace =
        |signs: &[f64; 3]| signs[0] * axes[0].x + signs[1] * axes[1].y + signs[2] * axes[2].z;
    let mut best = CANDIDATES[0];
    for candidate in &CANDIDATES[1..] {
        if trace(candidate) > trace(&best) {
            best = *candidate;
        }
    }
    best
}
