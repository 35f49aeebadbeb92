//! Where the picture is seen from.

use glam::DVec3;

use super::ray::Ray;

/// What of the space is seen. The width follows from the image's aspect ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RefLens {
    /// All rays start at the eye.
    Perspective {
        /// Tangent of half the vertical field of view.
        tan_half_height: f64,
    },
    /// All rays are parallel.
    Orthographic {
        /// Half the height seen, in world units.
        half_height: f64,
    },
}

/// A camera in the world. Nothing is cut at a near or far plane; what lies behind the plane through
/// the eye is not seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RefCamera {
    /// Centre of projection; with [`RefLens::Orthographic`] the centre of the image plane.
    pub eye: DVec3,
    /// Unit vector towards the right of the image.
    pub right: DVec3,
    /// Unit vector towards the top of the image.
    pub up: DVec3,
    /// Unit vector into the image.
    pub forward: DVec3,
    /// Field of view.
    pub lens: RefLens,
}

impl RefCamera {
    /// At `eye`, looking at `target`; `up` need only not be parallel to the view.
    pub fn look_at(eye: DVec3, target: DVec3, up: DVec3, lens: RefLens) -> Self {
        let forward = (target - eye).normalize();
        let right = forward.cross(up).normalize();
        Self {
            eye,
            right,
            up: right.cross(forward),
            forward,
            lens,
        }
    }

    /// The same view from elsewhere.
    pub fn moved(self, by: DVec3) -> Self {
        Self {
            eye: self.eye + by,
            ..self
        }
    }

    /// Distance of `p` along the view direction.
    pub fn view_depth(&self, p: DVec3) -> f64 {
        (p - self.eye).dot(self.forward)
    }

    /// Unit vector from `p` to the viewer.
    pub fn towards_viewer(&self, p: DVec3) -> DVec3 {
        match self.lens {
            RefLens::Perspective { .. } => (self.eye - p).normalize_or_zero(),
            RefLens::Orthographic { .. } => -self.forward,
        }
    }

    /// The ray through `x` to the right and `y` down in pixels from the upper left corner of an
    /// image of `size` pixels. Its `t` is the view depth.
    pub fn ray(&self, [x, y]: [f64; 2], size: [u32; 2]) -> Ray {
        let [width, height] = size.map(f64::from);
        let across = (2.0 * x - width) / height;
        let upwards = (height - 2.0 * y) / height;
        let offset = self.right * across + self.up * upwards;
        match self.lens {
            RefLens::Perspective { tan_half_height } => {
                Ray::new(self.eye, self.forward + offset * tan_half_height)
            }
            RefLens::Orthographic { half_height } => {
                Ray::new(self.eye + offset * half_height, self.forward)
            }
        }
    }
}
