//! What lies outside of a view, or beyond a light. Conservative: what is kept may still be
//! invisible, what is dropped never is.

use geometry::bounds::Aabb;
use glam::{DVec3, DVec4};

use crate::content::{LightShape, WorldLight};
use crate::view::{Lens, View};

/// Half-spaces `n . (p - eye) + d >= 0` that together hold all that a view can see.
#[derive(Clone, Debug)]
pub struct Frustum {
    eye: DVec3,
    /// Normals point inwards; relative to the eye.
    planes: Vec<DVec4>,
}

impl Frustum {
    /// The sides of a view, and the plane through the eye for a perspective.
    pub fn new(view: &View, aspect: f64) -> Self {
        let (right, up, forward) = (view.right(), view.up(), view.forward());
        let planes = match view.lens {
            Lens::Perspective { tan_half_height } => {
                let tan_half_width = tan_half_height * aspect;
                vec![
                    (forward * tan_half_width + right).extend(0.0),
                    (forward * tan_half_width - right).extend(0.0),
                    (forward * tan_half_height + up).extend(0.0),
                    (forward * tan_half_height - up).extend(0.0),
                    forward.extend(0.0),
                ]
            }
            Lens::Orthographic { half_height } => {
                let half_width = half_height * aspect;
                vec![
                    right.extend(half_width),
                    (-right).extend(half_width),
                    up.extend(half_height),
                    (-up).extend(half_height),
                ]
            }
        };
        Self {
            eye: view.eye,
            planes,
        }
    }

    /// Whether something of a box may be seen.
    pub fn may_see(&self, bounds: &Aabb) -> bool {
        if bounds.is_empty() {
            return false;
        }
        let (center, half) = (bounds.center() - self.eye, bounds.size() * 0.5);
        self.planes.iter().all(|plane| {
            let n = plane.truncate();
            n.dot(center) + plane.w + n.abs().dot(half) >= 0.0
        })
    }

    /// The planes in the world: `n . p + d >= 0`.
    pub fn planes_in_world(&self) -> Vec<DVec4> {
        self.planes
            .iter()
            .map(|plane| {
                let n = plane.truncate();
                n.extend(plane.w - n.dot(self.eye))
            })
            .collect()
    }
}

/// Whether light may reach something of a box: by distance, and by the cone of a spot.
pub fn may_light(light: &WorldLight, bounds: &Aabb) -> bool {
    let Some(p) = light.p_in_world() else {
        return true;
    };
    let nearest = p.clamp(bounds.min, bounds.max);
    if p.distance(nearest) > light.reach() {
        return false;
    }
    let LightShape::Spot {
        axis, cos_cut_off, ..
    } = light.shape
    else {
        return true;
    };
    sphere_meets_cone(
        bounds.center() - p,
        bounds.size().length() * 0.5,
        axis,
        cos_cut_off,
    )
}

/// Whether a sphere (its centre seen from the apex) meets a cone: the angle to the centre is at
/// most the half angle plus the angular radius of the sphere.
fn sphere_meets_cone(center: DVec3, radius: f64, axis: DVec3, cos_half_angle: f64) -> bool {
    let distance = center.length();
    if distance <= radius {
        return true;
    }
    let angle = (center.dot(axis) / distance).clamp(-1.0, 1.0).acos();
    let half_angle = cos_half_angle.clamp(-1.0, 1.0).acos();
    // Boxes are conservative already; the margin covers the roundings of the two arc cosines.
    angle <= half_angle + (radius / distance).clamp(0.0, 1.0).asin() + 1e-6
}
