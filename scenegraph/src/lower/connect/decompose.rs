//! `DecomposeMatrix`: a matrix as the parts of a Transform (SbMatrix::getTransform): a rotation and
//! a symmetric stretch, which is a scale along turned axes. Where the matrix mirrors, all three
//! factors are negative.

use geometry::transform::{Decomposition, Trs, decompose};
use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};

use super::engine::{axis_angle, each};
use crate::graph::{FieldValue, Node};

/// An output; `None` if there is none of this name.
pub fn output(engine: &Node, name: &str) -> Option<FieldValue> {
    let part: fn(&Parts) -> Vec<f64> = match name {
        "translation" => |p| p.translation.to_array().to_vec(),
        "rotation" => |p| axis_angle(p.rotation),
        "scaleFactor" => |p| p.scale.to_array().to_vec(),
        "scaleOrientation" => |p| axis_angle(p.scale_orientation),
        _ => return None,
    };
    let lists = [
        (engine.numbers("matrix"), 16),
        (engine.numbers("center"), 3),
    ];
    Some(each(&lists, |v| {
        part(&Parts::of(v[0], DVec3::from_slice(v[1])))
    }))
}

struct Parts {
    translation: DVec3,
    rotation: DQuat,
    scale: DVec3,
    scale_orientation: DQuat,
}

impl Parts {
    /// Sixteen numbers in Inventor's order; a perspective row is disregarded.
    fn of(numbers: &[f64], center: DVec3) -> Self {
        let mut array = [0.0; 16];
        array.copy_from_slice(numbers);
        let matrix = DMat4::from_cols_array(&array);
        let affine = DAffine3::from_mat4(matrix);
        let (u, s, v) = match decompose(&affine) {
            Decomposition::Trs(Trs {
                rotation, scale, ..
            }) => (rotation, scale, DQuat::IDENTITY),
            Decomposition::Sheared { outer, inner } => {
                (outer.rotation, outer.scale, inner.conjugate())
            }
        };
        let sign = if s.x * s.y * s.z < 0.0 { -1.0 } else { 1.0 };
        let turned = DMat3::from_quat(u) * DMat3::from_diagonal(sign * s.signum());
        let rotation = DQuat::from_mat3(&(turned * DMat3::from_quat(v.conjugate())));
        let translation = affine.transform_point3(center) - center;
        Self {
            translation: if translation.is_finite() {
                translation
            } else {
                DVec3::ZERO
            },
            rotation: if rotation.is_finite() {
                rotation.normalize()
            } else {
                DQuat::IDENTITY
            },
            scale: sign * s.abs(),
            scale_orientation: v,
        }
    }
}
