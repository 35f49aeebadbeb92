//! Inventor's cameras as views, by the rules of `SoCamera` (SGI's and Coin's, which agree).
//!
//! **Viewport mapping.** `ADJUST_CAMERA` takes the image's aspect ratio; in an image higher than
//! wide the whole view volume is widened by 1 / aspect, so that `heightAngle` or `height` then
//! spans the *width* (`SoCamera::computeView`). `CROP_VIEWPORT_*` draws with the camera's
//! `aspectRatio` into the largest such rectangle; the frame that Inventor can draw around it is
//! left out. `LEAVE_ALONE` stretches a view of the camera's `aspectRatio` over the whole image.
//!
//! **The camera's frame.** Inventor's viewing matrix is `view volume * inverse(model matrix)`, so a
//! camera under a scale measures in scaled units: the eye moves as a point, an orthographic
//! `height` grows with the frame, and a perspective view does not change under a uniform scale.
//! An unequal scale along the camera's own axes stretches the picture; it is carried exactly by
//! the lens and the aspect ratio. What is left is not carried: the axes are made orthonormal with
//! the view direction kept first and up second, so shear is dropped and a mirroring frame shows
//! its picture unmirrored.
//!
//! `nearDistance` and `farDistance` are not used: files seldom hold useful ones, and Inventor's
//! viewers replace them as well (`auto clipping`). See [`super::DepthRange`].

use std::fmt;

use glam::{DAffine3, DQuat, DVec3};
use scenegraph::scene::{Camera, Projection, Scene, ViewportMapping};

use super::{Lens, Region, TAN_RANGE, View, direction, looking};

/// Defaults of `heightAngle` and `height`, for values that are not positive and finite.
const DEFAULT_HEIGHT_ANGLE_RAD: f64 = std::f64::consts::FRAC_PI_4;
const DEFAULT_HEIGHT: f64 = 2.0;
/// An aspect ratio beyond these shows less than a pixel across in any image.
const ASPECT_RANGE: (f64, f64) = (1e-6, 1e6);

impl View {
    /// The view of a camera onto an image of `width` by `height` pixels, and the region that it
    /// fills. Finite for any camera.
    #[must_use]
    pub fn from_scene_camera(camera: &Camera, width: u32, height: u32) -> (Self, Region) {
        let frame = CameraFrame::new(camera);
        let whole = Region::whole(width, height);
        let camera_aspect = in_range(camera.aspect_ratio, 1.0, ASPECT_RANGE);
        let (mut region, widened) = match camera.viewport_mapping {
            ViewportMapping::AdjustCamera => (whole, (1.0 / whole.aspect).max(1.0)),
            ViewportMapping::CropViewport => (Region::cropped(width, height, camera_aspect), 1.0),
            ViewportMapping::LeaveAlone => {
                let stretched = Region {
                    aspect: camera_aspect,
                    ..whole
                };
                (stretched, 1.0)
            }
        };
        region.aspect = in_range(
            region.aspect * frame.right_over_up,
            region.aspect,
            ASPECT_RANGE,
        );
        let lens = match camera.projection {
            Projection::Perspective { height_angle_rad } => {
                let tan = (positive_or(height_angle_rad, DEFAULT_HEIGHT_ANGLE_RAD)
                    .min(std::f64::consts::PI)
                    * 0.5)
                    .tan();
                Lens::Perspective {
                    tan_half_height: in_range(
                        tan * frame.up_over_forward * widened,
                        tan,
                        TAN_RANGE,
                    ),
                }
            }
            Projection::Orthographic { height } => {
                let half = positive_or(height, DEFAULT_HEIGHT) * 0.5;
                Lens::Orthographic {
                    half_height: positive_or(half * frame.up_length * widened, half),
                }
            }
        };
        let view = Self {
            eye: frame.eye,
            orientation: frame.orientation,
            lens,
        };
        (view, region)
    }
}

/// What the transforms above a camera make of its eye and axes.
struct CameraFrame {
    eye: DVec3,
    orientation: DQuat,
    /// Length that a unit of height has in the world.
    up_length: f64,
    /// Ratios of the lengths of the three axes; 1 in a frame of uniform scale.
    up_over_forward: f64,
    right_over_up: f64,
}

impl CameraFrame {
    fn new(camera: &Camera) -> Self {
        let world_from_local = &camera.placement.world_from_local;
        // Squares of extreme components leave the range, and their length is then no number.
        let length = camera.orientation.length();
        let local = if length.is_normal() {
            (camera.orientation / length).normalize()
        } else {
            DQuat::IDENTITY
        };
        let eye = world_from_local.transform_point3(camera.position);
        let eye = if eye.is_finite() { eye } else { DVec3::ZERO };
        Self::turned(world_from_local, local, eye).unwrap_or(Self {
            eye,
            orientation: local,
            up_length: 1.0,
            up_over_forward: 1.0,
            right_over_up: 1.0,
        })
    }

    /// `None` if the frame flattens the view direction away.
    fn turned(world_from_local: &DAffine3, local: DQuat, eye: DVec3) -> Option<Self> {
        let axis = |axis: DVec3| world_from_local.transform_vector3(local * axis);
        let (right, up, forward) = (axis(DVec3::X), axis(DVec3::Y), axis(DVec3::NEG_Z));
        let unit_forward = direction(forward)?;
        let orientation = looking(unit_forward, up)
            .or_else(|| looking(unit_forward, right.cross(unit_forward)))
            .or_else(|| looking(unit_forward, unit_forward.any_orthonormal_vector()))?;
        // Only the part across the other axes is seen; for orthogonal axes it is their length.
        let up_length = positive_or(up.dot(orientation * DVec3::Y).abs(), 1.0);
        let right_length = positive_or(right.dot(orientation * DVec3::X).abs(), up_length);
        let forward_length = positive_or(forward.dot(unit_forward), up_length);
        Some(Self {
            eye,
            orientation,
            up_length,
            up_over_forward: up_length / forward_length,
            right_over_up: right_length / up_length,
        })
    }
}

fn positive_or(value: f64, otherwise: f64) -> f64 {
    if value > 0.0 && value.is_finite() {
        value
    } else {
        otherwise
    }
}

fn in_range(value: f64, otherwise: f64, (least, most): (f64, f64)) -> f64 {
    positive_or(value, otherwise).clamp(least, most)
}

/// No camera answers to what the user asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoSuchCamera {
    /// What was asked for.
    pub wanted: String,
    /// The names of the scene's cameras, in order; those without are `None`.
    pub names: Vec<Option<String>>,
}

/// Names listed in a message before the rest is counted only.
const LISTED: usize = 10;

impl fmt::Display for NoSuchCamera {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no camera `{}`; ", self.wanted)?;
        if self.names.is_empty() {
            return write!(f, "the model has none");
        }
        write!(f, "the model has")?;
        for (i, name) in self.names.iter().enumerate().take(LISTED) {
            let comma = if i == 0 { "" } else { "," };
            match name {
                Some(name) => write!(f, "{comma} {i} `{name}`")?,
                None => write!(f, "{comma} {i} (no name)")?,
            }
        }
        match self.names.len().saturating_sub(LISTED) {
            0 => Ok(()),
            more => write!(f, " and {more} more"),
        }
    }
}

impl std::error::Error for NoSuchCamera {}

/// The camera that a user means: the first of this DEF name, else the one of this index, counted
/// from 0. `Ok(None)` if nothing is asked for and the scene has no camera; else the first.
///
/// # Errors
///
/// [`NoSuchCamera`] if `wanted` names none.
pub fn find_camera<'a>(
    scene: &'a Scene,
    wanted: Option<&str>,
) -> Result<Option<&'a Camera>, NoSuchCamera> {
    let Some(wanted) = wanted else {
        return Ok(scene.cameras.first());
    };
    let by_name = (scene.cameras.iter()).find(|c| c.placement.name.as_deref() == Some(wanted));
    let by_index = || {
        let index: usize = wanted.trim().parse().ok()?;
        scene.cameras.get(index)
    };
    match by_name.or_else(by_index) {
        Some(camera) => Ok(Some(camera)),
        None => Err(NoSuchCamera {
            wanted: wanted.to_owned(),
            names: (scene.cameras.iter())
                .map(|c| c.placement.name.as_deref().map(str::to_owned))
                .collect(),
        }),
    }
}

#[cfg(test)]
#[path = "camera_tests.rs"]
mod tests;
