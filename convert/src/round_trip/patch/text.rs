//! Nodes and numbers as they go into the text.

use std::fmt::Write;

use geometry::transform::{Decomposition, decompose};
use glam::{DAffine3, DMat3, DVec3};
use scenegraph::legal_name;
use scenegraph::scene::{Faces, Material};

use super::No;

/// How far a matrix may be from the identity and still be written as a translation.
const TRANSLATION_TOLERANCE: f64 = 1e-12;

/// Fields of a `ShapeHints`.
pub(super) fn hints(faces: Faces) -> &'static str {
    match faces {
        Faces::FrontOnly => "vertexOrdering COUNTERCLOCKWISE shapeType SOLID",
        Faces::BothTwoSidedLighting => {
            "vertexOrdering COUNTERCLOCKWISE shapeType UNKNOWN_SHAPE_TYPE"
        }
        Faces::BothOneSidedLighting => {
            "vertexOrdering UNKNOWN_ORDERING shapeType UNKNOWN_SHAPE_TYPE"
        }
    }
}

/// A `Material` on one line.
pub(super) fn material_text(material: &Material) -> String {
    let name = material.name.as_deref().and_then(legal_name);
    let mut text = name.map_or(String::new(), |name| format!("DEF {name} "));
    text += "Material {";
    for (field, [r, g, b]) in [
        ("ambientColor", material.ambient_srgb),
        ("diffuseColor", material.diffuse_srgb),
        ("specularColor", material.specular_srgb),
        ("emissiveColor", material.emissive_srgb),
    ] {
        // Writing to a String does not fail.
        let _ = write!(text, " {field} {r} {g} {b}");
    }
    let (shininess, transparency) = (material.shininess, material.transparency);
    let _ = write!(text, " shininess {shininess} transparency {transparency}");
    text + " }"
}

/// A change of frame to 15 digits, its linear part left out where it is none.
pub(super) fn tidy(mut change: DAffine3) -> Result<DAffine3, No> {
    if !change.is_finite() {
        return Err("a frame without an inverse was edited".to_owned());
    }
    let off = (change.matrix3 - DMat3::IDENTITY).to_cols_array();
    if off.iter().all(|v| v.abs() <= TRANSLATION_TOLERANCE) {
        change.matrix3 = DMat3::IDENTITY;
    }
    change.translation = tidy_triple(change.translation);
    Ok(change)
}

pub(super) fn tidy_triple(v: DVec3) -> DVec3 {
    let most = v.abs().max_element();
    let tidy = |x: f64| {
        // Rounding of the largest shows in the others.
        let x = if x.abs() <= most * 1e-15 { 0.0 } else { x };
        format!("{x:.14e}").parse().unwrap_or(x)
    };
    DVec3::new(tidy(v.x), tidy(v.y), tidy(v.z))
}

pub(super) fn triple_text(v: DVec3) -> String {
    format!("{} {} {}", v.x, v.y, v.z)
}

pub(super) fn transform_text(change: &DAffine3) -> String {
    if change.matrix3 == DMat3::IDENTITY {
        let translation = triple_text(change.translation);
        return format!("Translation {{ translation {translation} }}");
    }
    let mut text = String::from("MatrixTransform { matrix");
    for value in glam::DMat4::from(*change).to_cols_array() {
        // Writing to a String does not fail.
        let _ = write!(text, " {value}");
    }
    text + " }"
}

/// The fields of a VRML 2.0 `Transform`.
pub(super) fn vrml_transform_text(change: &DAffine3) -> Result<String, No> {
    let Decomposition::Trs(trs) = decompose(change) else {
        return Err("a change that shears has no Transform".to_owned());
    };
    let mut text = format!("translation {}", triple_text(trs.translation));
    let (axis, angle_rad) = trs.rotation.to_axis_angle();
    if angle_rad != 0.0 {
        // Writing to a String does not fail.
        let _ = write!(text, " rotation {} {angle_rad}", triple_text(axis));
    }
    if trs.scale != DVec3::ONE {
        // ISO 14772-1, 6.52: factors are above 0.
        if trs.scale.min_element() <= 0.0 {
            return Err("a Transform does not mirror".to_owned());
        }
        let _ = write!(text, " scale {}", triple_text(trs.scale));
    }
    Ok(text)
}
