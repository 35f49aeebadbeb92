//! Inventor's cameras as glTF's.
//!
//! Lengths go into world units, because glTF ignores the scale of a camera's node. A clipping
//! range that says nothing is made anew, as Inventor's viewers do.

use std::f64::consts::PI;

use glam::{DAffine3, DQuat, DVec3};
use scenegraph::scene::{Camera, Projection, ViewportMapping};

use crate::bounds::Bounds;
use crate::extras;
use crate::frame::{looking, unit_or};
use crate::json::Json;

/// `nearDistance` and `farDistance` of a camera that does not give them.
const INVENTOR_DEFAULT_RANGE: (f64, f64) = (1.0, 10.0);
/// Least near plane as a share of the far one: what a 24-bit depth buffer stands.
const MIN_NEAR_SHARE: f64 = 1e-4;
/// Room left before and behind the scene's bounds.
const RANGE_MARGIN: f64 = 0.1;
/// Narrowest angle, and how far the widest is from a half turn; radians.
const MIN_ANGLE_RAD: f64 = 1e-3;

/// Where a camera stands and looks.
struct Pose {
    position: DVec3,
    /// As long as the frame makes a unit of depth.
    forward: DVec3,
    /// As long as the frame makes a unit of height.
    up: DVec3,
}

impl Pose {
    fn new(camera: &Camera, frame: &DAffine3) -> Self {
        let orientation = if camera.orientation.is_finite() && camera.orientation.length() > 0.0 {
            camera.orientation.normalize()
        } else {
            DQuat::IDENTITY
        };
        Self {
            position: frame.transform_point3(camera.position),
            forward: frame.transform_vector3(orientation * DVec3::NEG_Z),
            up: frame.transform_vector3(orientation * DVec3::Y),
        }
    }
}

/// The camera's frame in that of its group: a rotation and a translation.
pub(crate) fn frame(camera: &Camera, parent_from_local: &DAffine3) -> DAffine3 {
    let pose = Pose::new(camera, parent_from_local);
    let forward = unit_or(pose.forward, DVec3::NEG_Z);
    looking(pose.position, forward, unit_or(pose.up, DVec3::Y))
}

pub(crate) fn write(json: &mut Json, camera: &Camera, bounds: Option<&Bounds>, with_extras: bool) {
    let pose = Pose::new(camera, &camera.placement.world_from_local);
    let aspect = positive_or(camera.aspect_ratio, 1.0);
    let mut made_far = None;
    json.object(|json| {
        match camera.projection {
            Projection::Perspective { height_angle_rad } => {
                json.key("type").str("perspective");
                json.key("perspective").object(|json| {
                    let yfov = positive_or(height_angle_rad, MIN_ANGLE_RAD);
                    json.key("yfov")
                        .f64(yfov.clamp(MIN_ANGLE_RAD, PI - MIN_ANGLE_RAD));
                    if camera.viewport_mapping != ViewportMapping::AdjustCamera {
                        json.key("aspectRatio").f64(aspect);
                    }
                    let (near, far) = perspective_range(camera, &pose, bounds);
                    json.key("znear").f64(near);
                    if let Some(far) = far {
                        json.key("zfar").f64(far);
                    }
                });
            }
            Projection::Orthographic { height } => {
                json.key("type").str("orthographic");
                json.key("orthographic").object(|json| {
                    let ymag = positive_or(height * pose.up.length() * 0.5, 1.0);
                    let (near, far) = orthographic_range(camera, &pose, bounds);
                    let is_made = written_range(camera, pose.forward.length()).is_none();
                    made_far = is_made.then_some(far);
                    json.key("xmag").f64(positive_or(ymag * aspect, ymag));
                    json.key("ymag").f64(ymag);
                    json.key("znear").f64(near);
                    json.key("zfar").f64(far);
                });
            }
        }
        if with_extras {
            extras::camera(json, camera, pose.forward.length(), made_far);
        }
    });
}

pub(crate) fn positive_or(value: f64, otherwise: f64) -> f64 {
    if value > 0.0 && value.is_finite() {
        value
    } else {
        otherwise
    }
}

fn is_orthographic(camera: &Camera) -> bool {
    matches!(camera.projection, Projection::Orthographic { .. })
}

/// The range as written, in world units, if it is one that someone has chosen.
pub(crate) fn written_range(camera: &Camera, unit_length: f64) -> Option<(f64, f64)> {
    let (near, far) = (camera.near_distance, camera.far_distance);
    let chosen = (near, far) != INVENTOR_DEFAULT_RANGE;
    let (near, far) = (near * unit_length, far * unit_length);
    // A perspective has no near plane at the eye.
    let sound = near > 0.0 || near == 0.0 && is_orthographic(camera);
    (chosen && sound && near < far && far.is_finite()).then_some((near, far))
}

/// Depth of the scene's bounds: nearest and farthest; `None` if all of it is behind the camera.
fn depths(pose: &Pose, bounds: Option<&Bounds>) -> Option<(f64, f64)> {
    let forward = unit_or(pose.forward, DVec3::NEG_Z);
    let depths = bounds?.corners().map(|p| (p - pose.position).dot(forward));
    let near = depths.into_iter().fold(f64::INFINITY, f64::min);
    let far = depths.into_iter().fold(f64::NEG_INFINITY, f64::max);
    (far > 0.0 && far.is_finite()).then_some((near, far))
}

/// Near plane, and the far one unless it is infinitely far.
fn perspective_range(camera: &Camera, pose: &Pose, bounds: Option<&Bounds>) -> (f64, Option<f64>) {
    if let Some((near, far)) = written_range(camera, pose.forward.length()) {
        return (near, Some(far));
    }
    let near = match depths(pose, bounds) {
        Some((near, far)) => (near * (1.0 - RANGE_MARGIN)).max(far * MIN_NEAR_SHARE),
        None => camera.focal_distance * pose.forward.length() * MIN_NEAR_SHARE,
    };
    (positive_or(near, INVENTOR_DEFAULT_RANGE.0), None)
}

fn orthographic_range(camera: &Camera, pose: &Pose, bounds: Option<&Bounds>) -> (f64, f64) {
    if let Some(range) = written_range(camera, pose.forward.length()) {
        return range;
    }
    let far = match depths(pose, bounds) {
        Some((_, far)) => far * (1.0 + RANGE_MARGIN),
        None => camera.focal_distance * pose.forward.length() * 2.0,
    };
    (0.0, positive_or(far, INVENTOR_DEFAULT_RANGE.1))
}
