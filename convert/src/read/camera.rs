//! glTF's cameras as Inventor's: at the origin of their frame, along -Z.

use std::f64::consts::{FRAC_PI_4, PI};

use glam::{DQuat, DVec3};
use gltf::json::Camera as JsonCamera;
use scenegraph::scene::{Camera, Placement, Projection, ViewportMapping};

use super::document::ExactCamera;
use super::iv::Iv;

/// Inventor's `nearDistance`, `farDistance` and `focalDistance`: ones that nobody has chosen.
const DEFAULT_NEAR: f64 = 1.0;
const DEFAULT_FAR: f64 = 10.0;
const DEFAULT_FOCAL: f64 = 5.0;
/// Inventor's `height`.
const DEFAULT_HEIGHT: f64 = 2.0;

/// `None` for a camera of neither kind.
pub(crate) fn camera(
    source: &JsonCamera,
    exact: &ExactCamera,
    by_ivory: bool,
    placement: Placement,
) -> Option<Camera> {
    let (projection, aspect, near, far) = match (&exact.perspective, &exact.orthographic) {
        (Some(view), _) => {
            let usual = view.yfov > 0.0 && view.yfov < PI;
            let height_angle_rad = if usual { view.yfov } else { FRAC_PI_4 };
            let projection = Projection::Perspective { height_angle_rad };
            (projection, view.aspect_ratio, view.znear, view.zfar)
        }
        (None, Some(view)) => {
            let height = finite_or(2.0 * view.ymag, DEFAULT_HEIGHT);
            let height = if height > 0.0 { height } else { DEFAULT_HEIGHT };
            let aspect = (view.ymag > 0.0).then(|| view.xmag / view.ymag);
            let projection = Projection::Orthographic { height };
            (projection, aspect, view.znear, Some(view.zfar))
        }
        (None, None) => return None,
    };
    let mut camera = Camera {
        placement,
        position: DVec3::ZERO,
        orientation: DQuat::IDENTITY,
        aspect_ratio: aspect.filter(|&a| a > 0.0 && a.is_finite()).unwrap_or(1.0),
        near_distance: DEFAULT_NEAR,
        far_distance: DEFAULT_FAR,
        focal_distance: DEFAULT_FOCAL,
        projection,
        viewport_mapping: ViewportMapping::AdjustCamera,
    };
    if let Some(far) = far {
        (camera.near_distance, camera.far_distance) = (near, far);
    }
    let iv = Iv::of(&source.extras).or_else(|| by_ivory.then(Iv::default));
    if let Some(iv) = iv {
        take_values(&mut camera, &iv);
    }
    Some(camera)
}

/// Inventor's own values. Distances are in units of the camera's first frame, which the writer
/// measures.
fn take_values(camera: &mut Camera, iv: &Iv) {
    let unit = iv.number("unitLength", 1.0);
    camera.aspect_ratio = iv.number("aspectRatio", 1.0);
    let distance = |key, default| finite_or(iv.number(key, default) * unit, default);
    camera.near_distance = distance("nearDistance", DEFAULT_NEAR);
    camera.far_distance = distance("farDistance", DEFAULT_FAR);
    camera.focal_distance = distance("focalDistance", DEFAULT_FOCAL);
    camera.viewport_mapping = match iv.word("viewportMapping") {
        Some("CROP_VIEWPORT_FILL_FRAME") => ViewportMapping::CropViewport,
        Some("LEAVE_ALONE") => ViewportMapping::LeaveAlone,
        _ => ViewportMapping::AdjustCamera,
    };
}

fn finite_or(value: f64, otherwise: f64) -> f64 {
    if value.is_finite() { value } else { otherwise }
}
