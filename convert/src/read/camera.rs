//! glTF's cameras as Inventor's: at the origin of their frame, along -Z.

use std::f64::consts::{FRAC_PI_4, PI};

use glam::{DQuat, DVec3};
use gltf::json::Camera as JsonCamera;
use scenegraph::scene::{Camera, Placement, Projection, ViewportMapping};

use super::document::ExactCamera;
use super::iv::Iv;
use super::made_by::MadeBy;
use crate::alike::alike_in_size;
use crate::camera::{positive_or, written_range};

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
    made_by: MadeBy,
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
    Some(match made_by.values(&source.extras) {
        Some(iv) => settled(&camera, &iv, (near, far)),
        None => camera,
    })
}

/// With Inventor's own values, but for what was edited since. Distances are in units of the camera's
/// first frame, which the writer measures. `range` is the file's.
fn settled(shown: &Camera, iv: &Iv, (near, far): (f64, Option<f64>)) -> Camera {
    let unit = iv.number("unitLength", 1.0);
    let mut camera = shown.clone();
    camera.aspect_ratio = iv.number("aspectRatio", 1.0);
    camera.near_distance = iv.number("nearDistance", DEFAULT_NEAR);
    camera.far_distance = iv.number("farDistance", DEFAULT_FAR);
    camera.viewport_mapping = match iv.word("viewportMapping") {
        Some("CROP_VIEWPORT_FILL_FRAME") => ViewportMapping::CropViewport,
        Some("LEAVE_ALONE") => ViewportMapping::LeaveAlone,
        _ => ViewportMapping::AdjustCamera,
    };
    let is_perspective = matches!(camera.projection, Projection::Perspective { .. });
    let says_none = is_perspective && camera.viewport_mapping == ViewportMapping::AdjustCamera;
    let aspect = match says_none {
        true => 1.0,
        false => positive_or(camera.aspect_ratio, 1.0),
    };
    if !alike_in_size(aspect, shown.aspect_ratio) {
        camera.aspect_ratio = shown.aspect_ratio;
    }
    let same_range = match (written_range(&camera, unit), far) {
        (Some((n, f)), Some(far)) => alike_in_size(n, near) && alike_in_size(f, far),
        (Some(_), None) => false,
        // Made of the scene's bounds. Inventor has no near plane without a far one.
        (None, None) => true,
        (None, Some(far)) => {
            let made = iv.number("zfar", f64::NAN);
            !is_perspective && near == 0.0 && alike_in_size(far, made)
        }
    };
    let distance = |own: f64, default| finite_or(own * unit, default);
    if same_range {
        camera.near_distance = distance(camera.near_distance, DEFAULT_NEAR);
        camera.far_distance = distance(camera.far_distance, DEFAULT_FAR);
    } else {
        (camera.near_distance, camera.far_distance) = (shown.near_distance, shown.far_distance);
    }
    camera.focal_distance = distance(iv.number("focalDistance", DEFAULT_FOCAL), DEFAULT_FOCAL);
    camera
}

fn finite_or(value: f64, otherwise: f64) -> f64 {
    if value.is_finite() { value } else { otherwise }
}
