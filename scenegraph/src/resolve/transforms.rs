//! Transformation nodes.

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};

use crate::graph::Node;
use crate::registry::Class;
use crate::remarks::Remarks;

use super::state::State;

/// Applies a transformation node of class `class`; false if it is none.
pub fn apply(class: Class, node: &Node, state: &mut State, remarks: &mut Remarks) -> bool {
    match class {
        Class::Transform => state.transform(&transform(node, remarks)),
        Class::Translation => {
            if !node.is_ignored("translation") {
                state.transform(&translation(node, "translation"));
            }
        }
        Class::Shuttle if node.is_ignored("translation0") => {}
        Class::Shuttle => state.transform(&translation(node, "translation0")),
        Class::Rotation | Class::Rotor => {
            state.transform(&DAffine3::from_quat(rotation(node, "rotation", remarks)))
        }
        Class::Pendulum => {
            state.transform(&DAffine3::from_quat(rotation(node, "rotation0", remarks)))
        }
        Class::RotationXYZ if node.is_ignored("axis") || node.is_ignored("angle") => {}
        Class::RotationXYZ => state.transform(&DAffine3::from_quat(about_axis(node))),
        Class::Scale => {
            if !node.is_ignored("scaleFactor") {
                state.transform(&DAffine3::from_scale(triple(node, "scaleFactor")));
            }
        }
        Class::MatrixTransform => state.transform(&matrix(node, remarks)),
        Class::ResetTransform => {
            if node.has_bits("whatToReset", "TRANSFORM") {
                state.base = 0;
                state.relative = DAffine3::IDENTITY;
            }
        }
        Class::Units if node.is_ignored("units") => {}
        Class::Units => units(node, state),
        Class::AntiSquish | Class::SurroundScale => remarks.add(
            iv_parser::Severity::Note,
            "no-effect",
            &format!("{} has no effect here", class.name()),
            "it serves draggers only",
            node.pos,
        ),
        _ => return false,
    }
    true
}

fn triple(node: &Node, field: &str) -> DVec3 {
    DVec3::from(node.triple(field))
}

fn translation(node: &Node, field: &str) -> DAffine3 {
    DAffine3::from_translation(triple(node, field))
}

/// An axis and an angle as a unit quaternion. An axis of no length gives no rotation.
pub fn rotation(node: &Node, field: &str, remarks: &mut Remarks) -> DQuat {
    let &[x, y, z, angle_rad] = node.numbers(field) else {
        return DQuat::IDENTITY;
    };
    if angle_rad == 0.0 || node.is_ignored(field) {
        return DQuat::IDENTITY;
    }
    match unit(DVec3::new(x, y, z)) {
        Some(axis) => DQuat::from_axis_angle(axis, angle_rad),
        None => {
            remarks.warn(
                "zero-axis",
                "a rotation has an axis of no length",
                "it was left out",
                node.pos,
            );
            DQuat::IDENTITY
        }
    }
}

/// The vector at unit length; `None` if it has none. Scaled first, so that squares cannot
/// overflow or vanish.
pub fn unit(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    (largest > 0.0 && largest.is_finite()).then(|| (v / largest).normalize())
}

fn about_axis(node: &Node) -> DQuat {
    let angle_rad = node.number("angle");
    match node.word("axis") {
        "Y" => DQuat::from_rotation_y(angle_rad),
        "Z" => DQuat::from_rotation_z(angle_rad),
        _ => DQuat::from_rotation_x(angle_rad),
    }
}

/// Scale about `center` along `scaleOrientation`, rotate about `center`, translate (Inventor
/// Reference, SoTransform).
fn transform(node: &Node, remarks: &mut Remarks) -> DAffine3 {
    let mut result = DAffine3::IDENTITY;
    let given = |field: &str| node.entry(field).is_some_and(|f| !f.ignored);
    let center = given("center").then(|| triple(node, "center"));
    if given("translation") {
        result.translation += triple(node, "translation");
    }
    if let Some(center) = center {
        result.translation += center;
    }
    if given("rotation") {
        result *= DAffine3::from_quat(rotation(node, "rotation", remarks));
    }
    if given("scaleFactor") {
        let scale = DMat3::from_diagonal(triple(node, "scaleFactor"));
        let turn = DMat3::from_quat(rotation(node, "scaleOrientation", remarks));
        result *= DAffine3::from_mat3(if turn == DMat3::IDENTITY {
            scale
        } else {
            turn * scale * turn.transpose()
        });
    }
    if let Some(center) = center {
        result *= DAffine3::from_translation(-center);
    }
    result
}

/// Inventor's matrices act on row vectors and are written row by row, which is the column-vector
/// matrix column by column.
fn matrix(node: &Node, remarks: &mut Remarks) -> DAffine3 {
    let Ok(numbers) = <[f64; 16]>::try_from(node.numbers("matrix")) else {
        return DAffine3::IDENTITY;
    };
    if node.is_ignored("matrix") {
        return DAffine3::IDENTITY;
    }
    affine(&numbers, node, remarks)
}

/// The affine part of a matrix.
pub fn affine(numbers: &[f64; 16], node: &Node, remarks: &mut Remarks) -> DAffine3 {
    let mut m = DMat4::from_cols_array(numbers);
    let w = m.w_axis.w;
    let projective = m.x_axis.w != 0.0 || m.y_axis.w != 0.0 || m.z_axis.w != 0.0;
    if projective || w == 0.0 {
        remarks.warn(
            "projective",
            "a matrix is projective",
            "its affine part was used",
            node.pos,
        );
    } else if w != 1.0 {
        m *= 1.0 / w;
    }
    DAffine3::from_mat4(m)
}

/// `Units` is absolute: it replaces the unit in force, it does not multiply with it.
fn units(node: &Node, state: &mut State) {
    let metres = match node.word("units") {
        "CENTIMETERS" => 1e-2,
        "MILLIMETERS" => 1e-3,
        "MICROMETERS" | "MICRONS" => 1e-6,
        "NANOMETERS" => 1e-9,
        "ANGSTROMS" => 1e-10,
        "KILOMETERS" => 1e3,
        "FEET" => 0.3048,
        "INCHES" => 0.0254,
        "POINTS" => 0.0254 / 72.0,
        "YARDS" => 0.9144,
        "MILES" => 1609.344,
        "NAUTICAL_MILES" => 1852.0,
        _ => 1.0,
    };
    let factor = metres / state.units_m;
    state.units_m = metres;
    if factor != 1.0 {
        state.transform(&DAffine3::from_scale(DVec3::splat(factor)));
    }
}
