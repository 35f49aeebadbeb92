//! Cameras and lights as nodes, in the frame that they stand in.

use glam::{DAffine3, DMat3, DQuat, DVec3};

use crate::scene::{Camera, Environment, FogType, Light, LightKind, Projection, ViewportMapping};

use super::text::Text;

/// How far a frame may be from a rotation and still be written as a camera's orientation: the
/// roundings of a few products of rotations.
const ROTATION_TOLERANCE: f64 = 1e-13;

/// The frame of a camera as position and orientation; `None` if it is more than a rotation and a
/// translation.
pub(super) fn rigid(frame: &DAffine3) -> Option<(DQuat, DVec3)> {
    let m = &frame.matrix3;
    let error = (m.transpose() * *m - DMat3::IDENTITY).to_cols_array();
    let is_rotation = error.iter().all(|e| e.abs() <= ROTATION_TOLERANCE) && m.determinant() > 0.0;
    is_rotation.then(|| (DQuat::from_mat3(m), frame.translation))
}

/// A camera that stands in the frame `pose` (rotation and translation).
pub(super) fn camera(text: &mut Text, def: Option<&str>, camera: &Camera, pose: (DQuat, DVec3)) {
    let (rotation, translation) = pose;
    let class = match camera.projection {
        Projection::Perspective { .. } => "PerspectiveCamera",
        Projection::Orthographic { .. } => "OrthographicCamera",
    };
    text.open(def, class);
    match camera.viewport_mapping {
        ViewportMapping::AdjustCamera => {}
        ViewportMapping::CropViewport => text.word("viewportMapping", "CROP_VIEWPORT_FILL_FRAME"),
        ViewportMapping::LeaveAlone => text.word("viewportMapping", "LEAVE_ALONE"),
    }
    let position = rotation * camera.position + translation;
    // Inventor's default is one unit before the origin.
    text.exact_numbers("position", &position.to_array());
    let orientation = rotation * camera.orientation;
    if orientation != DQuat::IDENTITY && orientation.is_finite() {
        let (axis, angle_rad) = orientation.normalize().to_axis_angle();
        text.exact_numbers("orientation", &[axis.x, axis.y, axis.z, angle_rad]);
    }
    text.numbers("nearDistance", [camera.near_distance]);
    text.numbers("farDistance", [camera.far_distance]);
    text.numbers("focalDistance", [camera.focal_distance]);
    if camera.aspect_ratio != 1.0 {
        text.numbers("aspectRatio", [camera.aspect_ratio]);
    }
    match camera.projection {
        Projection::Perspective { height_angle_rad } => {
            text.numbers("heightAngle", [height_angle_rad]);
        }
        Projection::Orthographic { height } => text.numbers("height", [height]),
    }
    text.close();
}

/// A light whose own frame is `frame` in that of the group it stands in.
pub(super) fn light(text: &mut Text, def: Option<&str>, light: &Light, frame: &DAffine3) {
    let place = |p: DVec3| frame.transform_point3(p).to_array();
    let along = |v: DVec3| {
        let turned = frame.transform_vector3(v);
        let largest = turned.abs().max_element();
        let unit = (turned / largest).normalize_or(DVec3::NEG_Z);
        // What is not turned keeps its digits.
        if turned == v {
            v.to_array()
        } else {
            unit.to_array()
        }
    };
    match light.kind {
        LightKind::Directional { direction } => {
            text.open(def, "DirectionalLight");
            text.exact_numbers("direction", &along(direction));
        }
        LightKind::Point { location } => {
            text.open(def, "PointLight");
            text.exact_numbers("location", &place(location));
        }
        LightKind::Spot {
            location,
            direction,
            drop_off_rate,
            cut_off_angle_rad,
        } => {
            text.open(def, "SpotLight");
            text.exact_numbers("location", &place(location));
            text.exact_numbers("direction", &along(direction));
            text.numbers("dropOffRate", [drop_off_rate]);
            text.numbers("cutOffAngle", [cut_off_angle_rad]);
        }
    }
    if light.color_srgb != [1.0; 3] {
        text.numbers("color", light.color_srgb);
    }
    if light.intensity != 1.0 {
        text.numbers("intensity", [light.intensity]);
    }
    text.close();
}

/// An `Environment` that states all its fields.
pub(super) fn environment(text: &mut Text, environment: &Environment) {
    text.open(None, "Environment");
    text.numbers("ambientIntensity", [environment.ambient_intensity]);
    text.numbers("ambientColor", environment.ambient_color_srgb);
    text.numbers("attenuation", environment.attenuation);
    if let Some(fog) = &environment.fog {
        text.word(
            "fogType",
            match fog.fog_type {
                FogType::Haze => "HAZE",
                FogType::Fog => "FOG",
                FogType::Smoke => "SMOKE",
            },
        );
        text.numbers("fogColor", fog.color_srgb);
        text.numbers("fogVisibility", [fog.visibility]);
    }
    text.close();
}
