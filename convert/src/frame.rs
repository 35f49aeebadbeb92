//! The frames of lights and cameras: glTF looks along -Z, and viewers may take a node's frame
//! for a rotation, which a scaled or sheared one is not.

use glam::{DAffine3, DMat3, DVec3};

/// How far a frame may be from a rotation with uniform scale and still count as one. Matrices
/// that went through f32 are within a few 1e-7; a viewer that reads a rotation out of a frame
/// within this bound errs by less than a pixel in a million.
const SIMILARITY_TOLERANCE: f64 = 1e-6;

/// Stretches as near to 1 as this are rotations that went through f32, and count as 1.
pub(crate) const STRETCH_TOLERANCE: f64 = 1e-6;

/// A bound of what lengths grow by, the largest singular value: the root of the largest sum of a row of MᵀM, which is
/// exact for turned and then scaled axes.
pub(crate) fn stretch(linear: &DMat3) -> f64 {
    let squares = linear.transpose() * *linear;
    let rows = squares.transpose();
    let sum = |row: DVec3| row.abs().element_sum();
    let largest = sum(rows.x_axis).max(sum(rows.y_axis)).max(sum(rows.z_axis));
    let stretch = largest.sqrt();
    if (stretch - 1.0).abs() <= STRETCH_TOLERANCE {
        1.0
    } else {
        stretch
    }
}

/// The scale of a frame that is a rotation and a uniform scale; `None` for any other.
pub(crate) fn uniform_scale(linear: &DMat3) -> Option<f64> {
    let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
    let scale = linear.determinant().cbrt();
    if !(scale > 0.0 && scale.is_finite()) {
        return None;
    }
    let (x, y, z) = (x / scale, y / scale, z / scale);
    let near = |value: f64, want: f64| (value - want).abs() <= SIMILARITY_TOLERANCE;
    let similar = near(x.length(), 1.0)
        && near(y.length(), 1.0)
        && near(z.length(), 1.0)
        && near(x.dot(y), 0.0)
        && near(y.dot(z), 0.0)
        && near(z.dot(x), 0.0);
    similar.then_some(scale)
}

pub(crate) fn is_rotation(linear: &DMat3) -> bool {
    uniform_scale(linear).is_some_and(|scale| (scale - 1.0).abs() <= SIMILARITY_TOLERANCE)
}

/// `v` at unit length at any magnitude, or `otherwise` if it has no direction.
pub(crate) fn unit_or(v: DVec3, otherwise: DVec3) -> DVec3 {
    let largest = v.abs().max_element();
    if largest > 0.0 && v.is_finite() {
        (v / largest).normalize()
    } else {
        otherwise
    }
}

/// A frame at `position` that looks along `direction` (-Z) with `up` upwards as far as can be;
/// unit directions. Exactly the identity for -Z and +Y.
pub(crate) fn looking(position: DVec3, direction: DVec3, up: DVec3) -> DAffine3 {
    let z = -direction;
    // Upwards along the view says nothing; X or Y then does, whichever is farther from it.
    let spare = if z.y.abs() < 0.5 { DVec3::Y } else { DVec3::X };
    let x = match up.cross(z) {
        x if x.length_squared() > 1e-12 => x.normalize(),
        _ => spare.cross(z).normalize(),
    };
    let axes = DMat3::from_cols(x, z.cross(x), z);
    DAffine3::from_mat3_translation(axes, position)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    #[test]
    fn a_looking_frame_is_a_rotation_that_turns_minus_z_to_the_direction() {
        assert_eq!(
            looking(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y),
            DAffine3::IDENTITY
        );
        let directions = [
            DVec3::X,
            DVec3::Y,
            DVec3::NEG_Y,
            DVec3::Z,
            DVec3::NEG_Z,
            DVec3::new(1e-9, 0.0, 1.0),
            DVec3::new(1e-9, -1.0, 0.0),
            DVec3::new(0.3, -0.8, 0.2),
        ];
        for direction in directions.map(DVec3::normalize) {
            for up in [DVec3::X, DVec3::Y, DVec3::Z] {
                let frame = looking(DVec3::ONE, direction, up);
                let turned = DQuat::from_mat3(&frame.matrix3) * DVec3::NEG_Z;
                // A quaternion and a product: a dozen roundings of numbers up to 1.
                assert!(
                    (turned - direction).length() < 4e-15,
                    "{direction} {turned}"
                );
                assert!(is_rotation(&frame.matrix3));
            }
        }
    }

    #[test]
    fn only_rotations_with_uniform_scale_pass() {
        let turn = DMat3::from_quat(DQuat::from_xyzw(0.1, -0.7, 0.3, 0.6).normalize());
        let scale = |x, y, z| DMat3::from_diagonal(DVec3::new(x, y, z));
        for (linear, want) in [
            (turn, Some(1.0)),
            (turn * scale(1e-3, 1e-3, 1e-3), Some(1e-3)),
            (turn * scale(1.0, 1.0, 1.0 + 1e-5), None),
            (turn * scale(-1.0, 1.0, 1.0), None),
            (scale(0.0, 1.0, 1.0), None),
            (scale(f64::NAN, 1.0, 1.0), None),
            (
                DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(0.1, 0.0, 1.0)),
                None,
            ),
        ] {
            let got = uniform_scale(&linear);
            assert_eq!(got.is_some(), want.is_some(), "{linear}");
            assert!((got.unwrap_or(0.0) - want.unwrap_or(0.0)).abs() < 1e-12);
        }
    }
}
