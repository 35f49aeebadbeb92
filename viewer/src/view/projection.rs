//! Matrices and planes of a view, for wgpu's clip space: x and y from -1 to 1 with y up, depth from
//! 0 to 1, reversed: 1 is nearest, 0 farthest.
//!
//! A perspective view has no far end: its depth is `near / depth`, 0 at infinity, so shadow volumes
//! that reach to infinity are not cut. In an f32 depth buffer this has the same relative precision
//! at every distance (Upchurch and Desbrun, "Tightening the Precision of Perspective Rendering",
//! 2012), so near need not be chosen to save bits of the buffer. It must not be tiny either: a
//! triangle or a shadow volume that crosses the near plane spans depths up to 1, and rasterisers
//! interpolate with an error of a rounding of the largest of them.

use geometry::bounds::Aabb;
use glam::{DMat4, DVec3, DVec4};

use super::{Lens, View};

/// Where a view begins and ends, as depths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthRange {
    /// Drawn at depth 1. Positive for a perspective view.
    pub near: f64,
    /// Drawn at depth 0; infinity for a perspective view.
    pub far: f64,
}

/// Room for the roundings of f32 vertices in front of the nearest point.
const NEAR_ROOM: f64 = 15.0 / 16.0;
/// Least near plane as a share of the farthest depth of an object around the eye. A pixel is about
/// 2^-10 of its depth wide (45 degrees over a thousand pixels); an f32 depth of 1 is off by up to
/// 2^-24. At this share the error of a triangle through the near plane is a pixel's width at the
/// object's far end, and less before it.
const LEAST_SHARE_OF_OBJECT: f64 = 1.0 / 16_384.0; // 2^-24 / 2^-10
/// Least near plane as a share of the farthest depth of all: where the scene's far end meets the
/// rounding of a depth of 1. So little that a stray part 1000 km away leaves 6 cm.
const LEAST_SHARE_OF_SCENE: f64 = 1.0 / 16_777_216.0; // 2^-24
/// Near plane of a view with nothing in front of it.
const NEAR_OF_NOTHING: f64 = 1.0;
/// Room before and behind the scene in an orthographic view, as a share of the largest depth: f32
/// vertices round to 2^-24 of it, a few times.
const ORTHOGRAPHIC_ROOM: f64 = 1.0 / 1024.0;

impl DepthRange {
    /// The range in which a view of this aspect ratio shows boxes in the world.
    ///
    /// *Perspective:* near lies before all that can be seen, as close to it as is safe. Nothing
    /// is cut but what an object around the eye has within 1/16384 of its own farthest depth
    /// (0.6 m of 10 km), or 2^-24 of that of the scene.
    ///
    /// *Orthographic:* the whole of all boxes, also behind the eye, whose place along the view
    /// direction means nothing there; near may be negative.
    ///
    /// Boxes that are empty count for nothing. Time is linear in their number.
    #[must_use]
    pub fn of(view: &View, aspect: f64, boxes: &[Aabb]) -> Self {
        match view.lens {
            Lens::Perspective { tan_half_height } => {
                let corner = tan_half_height.hypot(tan_half_height * aspect);
                Self {
                    near: nearest(view, 1.0 / corner.hypot(1.0), boxes),
                    far: f64::INFINITY,
                }
            }
            Lens::Orthographic { half_height } => orthographic(view, half_height, boxes),
        }
    }
}

/// `cos_corner`: cosine of the angle between the view direction and the image's corners; what is
/// seen at distance d has a depth of at least d times this.
fn nearest(view: &View, cos_corner: f64, boxes: &[Aabb]) -> f64 {
    let mut near = f64::INFINITY;
    let mut farthest = 0.0_f64;
    for bounds in boxes {
        let Some((from, to)) = view.depth_bounds(bounds) else {
            continue;
        };
        if !(to > 0.0 && to.is_finite()) {
            continue;
        }
        let outside = view.eye - view.eye.clamp(bounds.min, bounds.max);
        let seen_from = from.max(outside.length() * cos_corner);
        near = near.min((seen_from * NEAR_ROOM).max(to * LEAST_SHARE_OF_OBJECT));
        farthest = farthest.max(to);
    }
    let near = near.max(farthest * LEAST_SHARE_OF_SCENE);
    if near > 0.0 && near.is_finite() {
        near
    } else {
        NEAR_OF_NOTHING
    }
}

fn orthographic(view: &View, half_height: f64, boxes: &[Aabb]) -> DepthRange {
    let (near, far) = (boxes.iter().filter_map(|b| view.depth_bounds(b)))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(near, far), (a, b)| {
            (near.min(a), far.max(b))
        });
    let (near, far) = if near <= far && near.is_finite() && far.is_finite() {
        (near, far)
    } else {
        (0.0, 0.0)
    };
    // The lens gives a flat scene at the eye some depth.
    let room = near.abs().max(far.abs()).max(half_height) * ORTHOGRAPHIC_ROOM;
    DepthRange {
        near: near - room,
        far: far + room,
    }
}

impl View {
    /// The projection: from view coordinates to clip space.
    #[must_use]
    pub fn clip_from_view(&self, aspect: f64, range: DepthRange) -> DMat4 {
        match self.lens {
            Lens::Perspective { tan_half_height } => DMat4::from_cols(
                DVec4::new(1.0 / (tan_half_height * aspect), 0.0, 0.0, 0.0),
                DVec4::new(0.0, 1.0 / tan_half_height, 0.0, 0.0),
                DVec4::new(0.0, 0.0, 0.0, -1.0),
                DVec4::new(0.0, 0.0, range.near, 0.0),
            ),
            Lens::Orthographic { half_height } => {
                let span = range.far - range.near;
                DMat4::from_cols(
                    DVec4::new(1.0 / (half_height * aspect), 0.0, 0.0, 0.0),
                    DVec4::new(0.0, 1.0 / half_height, 0.0, 0.0),
                    DVec4::new(0.0, 0.0, 1.0 / span, 0.0),
                    DVec4::new(0.0, 0.0, range.far / span, 1.0),
                )
            }
        }
    }

    /// The planes around what is seen, in the world: left, right, bottom, top, near, far. `xyz` is
    /// of unit length and points inwards; a point p is inside where `xyz . p + w >= 0`. The far
    /// plane of a perspective view is `(0, 0, 0, 1)`: all is before it.
    #[must_use]
    pub fn frustum_planes(&self, aspect: f64, range: DepthRange) -> [DVec4; 6] {
        let plane = |normal_in_view: DVec3, offset: f64| {
            let length = normal_in_view.length();
            let normal = self.orientation * (normal_in_view / length);
            normal.extend(offset / length - normal.dot(self.eye))
        };
        let near = plane(DVec3::NEG_Z, -range.near);
        match self.lens {
            Lens::Perspective { tan_half_height } => {
                let tan_half_width = tan_half_height * aspect;
                [
                    plane(DVec3::new(1.0, 0.0, -tan_half_width), 0.0),
                    plane(DVec3::new(-1.0, 0.0, -tan_half_width), 0.0),
                    plane(DVec3::new(0.0, 1.0, -tan_half_height), 0.0),
                    plane(DVec3::new(0.0, -1.0, -tan_half_height), 0.0),
                    near,
                    DVec4::W,
                ]
            }
            Lens::Orthographic { half_height } => {
                let half_width = half_height * aspect;
                [
                    plane(DVec3::X, half_width),
                    plane(DVec3::NEG_X, half_width),
                    plane(DVec3::Y, half_height),
                    plane(DVec3::NEG_Y, half_height),
                    near,
                    plane(DVec3::Z, range.far),
                ]
            }
        }
    }
}

#[cfg(test)]
#[path = "projection_tests.rs"]
mod tests;
