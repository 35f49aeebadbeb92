//! Moving the eye: what a mouse, a wheel or keys do to a view. Pure numbers in f64.
//!
//! Knows neither devices nor windows: callers turn pixels into angles and parts of the image's
//! height. The *pivot* is the point that one turns around: it lies in the view direction, at
//! [`Navigator::distance`].

mod standard;
#[cfg(test)]
mod tests;

pub use standard::Standard;

use std::f64::consts::FRAC_PI_2;

use geometry::bounds::Aabb;
use glam::{DQuat, DVec2, DVec3};

use crate::view::framing::Up;
use crate::view::{Lens, View};

/// How dragging turns the view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Turning {
    /// Around the vertical and across it: the horizon stays level, as on a turntable.
    #[default]
    Turntable,
    /// Around any axis, as a ball that is rolled (SGI's examiner).
    Ball,
}

/// Steepest turntable view, short of the vertical by what f64 needs to know left from right.
const STEEPEST_RAD: f64 = FRAC_PI_2 - 1e-6;
/// Pivots are kept within these distances; their squares stay in range.
const DISTANCE_RANGE: (f64, f64) = (1e-30, 1e30);

/// A view that is being moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Navigator {
    /// What is seen.
    pub view: View,
    /// From the eye to the pivot; positive and finite.
    pub distance: f64,
    /// The vertical.
    pub up: Up,
    /// How dragging turns.
    pub turning: Turning,
}

impl Navigator {
    /// With the pivot in the middle of `bounds`, as far as that is in front of the eye.
    #[must_use]
    pub fn new(view: View, bounds: &Aabb, up: Up) -> Self {
        let distance = if bounds.is_empty() {
            1.0
        } else {
            let depth = (bounds.center() - view.eye).dot(view.forward());
            let radius = bounds.size().length() * 0.5;
            if depth > 0.0 { depth } else { radius.max(1.0) }
        };
        Self {
            view,
            distance: clamped(distance),
            up,
            turning: Turning::default(),
        }
    }

    /// The point that one turns around.
    #[must_use]
    pub fn pivot(&self) -> DVec3 {
        self.view.eye + self.view.forward() * self.distance
    }

    /// Half the height of what is seen at the pivot, world units.
    #[must_use]
    pub fn half_height(&self) -> f64 {
        match self.view.lens {
            Lens::Perspective { tan_half_height } => tan_half_height * self.distance,
            Lens::Orthographic { half_height } => half_height,
        }
    }

    /// Makes a point the pivot: the one at its depth in the middle of the image.
    pub fn set_pivot_depth(&mut self, p_in_world: DVec3) {
        let depth = (p_in_world - self.view.eye).dot(self.view.forward());
        if depth > 0.0 && depth.is_finite() {
            self.distance = clamped(depth);
        }
    }

    /// Turns the view around a point, which keeps its place in the image's depth: to the left by
    /// `angles_rad.x`, upwards by `angles_rad.y` (the scene turns the other way).
    pub fn orbit(&mut self, angles_rad: DVec2, around: DVec3) {
        let turn = self.turn(angles_rad);
        self.view.orientation = (turn * self.view.orientation).normalize();
        self.view.eye = around + turn * (self.view.eye - around);
    }

    /// Turns the view around the eye, as [`Self::orbit`] does around the pivot.
    pub fn look_around(&mut self, angles_rad: DVec2) {
        let turn = self.turn(-angles_rad);
        self.view.orientation = (turn * self.view.orientation).normalize();
    }

    /// The rotation in the world for a drag.
    fn turn(&self, angles_rad: DVec2) -> DQuat {
        let (right, up) = (self.view.right(), self.view.up());
        match self.turning {
            Turning::Ball => {
                let axis = up * -angles_rad.x + right * -angles_rad.y;
                DQuat::from_scaled_axis(axis)
            }
            Turning::Turntable => {
                let vertical = self.up.axis();
                let elevation = self.view.forward().dot(vertical).clamp(-1.0, 1.0).asin();
                let wanted = (elevation - angles_rad.y).clamp(-STEEPEST_RAD, STEEPEST_RAD);
                // A view that is steeper already is not pulled back by turning alone.
                let tilt = if angles_rad.y == 0.0 {
                    0.0
                } else {
                    wanted - elevation
                };
                DQuat::from_axis_angle(vertical, -angles_rad.x)
                    * DQuat::from_axis_angle(right, tilt)
            }
        }
    }

    /// Moves the picture by parts of its height, to the right and upwards: what lies at the
    /// pivot's depth goes along exactly.
    pub fn pan(&mut self, parts: DVec2) {
        let height = 2.0 * self.half_height();
        let shift = (self.view.right() * parts.x + self.view.up() * parts.y) * height;
        self.view.eye -= shift;
    }

    /// Makes what is around a point appear `1 / factor` times as large; the point stays where it
    /// is in the image. A perspective eye comes nearer, a parallel one sees less.
    pub fn zoom(&mut self, factor: f64, towards: DVec3) {
        if !(factor > 0.0 && factor.is_finite() && towards.is_finite()) {
            return;
        }
        let eye = self.view.eye;
        match &mut self.view.lens {
            Lens::Perspective { .. } => {
                let depth = (towards - eye).dot(self.view.forward());
                self.view.eye = towards + (eye - towards) * factor;
                // The pivot comes to the depth of what is approached, or keeps its share.
                let pivot = if depth > 0.0 { depth } else { self.distance };
                self.distance = clamped(pivot * factor);
            }
            Lens::Orthographic { half_height } => {
                *half_height = clamped(*half_height * factor);
                let offset = eye - towards;
                let forward = self.view.orientation * DVec3::NEG_Z;
                let across = offset - forward * offset.dot(forward);
                self.view.eye = eye + across * (factor - 1.0);
            }
        }
    }

    /// Moves the eye along its own axes: to the right, upwards, forwards; world units. In a
    /// parallel view, going forwards is seeing less.
    pub fn fly(&mut self, by: DVec3) {
        let view = &mut self.view;
        let (right, up, forward) = (view.right(), view.up(), view.forward());
        view.eye += right * by.x + up * by.y + forward * by.z;
        if let Lens::Orthographic { half_height } = &mut view.lens {
            *half_height = clamped(*half_height * (-by.z / self.distance).clamp(-1.0, 1.0).exp());
        }
    }

    /// Looks at a point from half as far away (Inventor's *seek*); the point becomes the pivot.
    pub fn seek(&mut self, p_in_world: DVec3) {
        let to_point = p_in_world - self.view.eye;
        let distance = to_point.length();
        if !(distance > 0.0 && distance.is_finite()) {
            return;
        }
        let mut turned = *self;
        turned.face(to_point / distance);
        self.view.orientation = turned.view.orientation;
        self.view.eye = p_in_world - to_point * 0.5;
        self.distance = clamped(distance * 0.5);
        if let Lens::Orthographic { half_height } = &mut self.view.lens {
            *half_height = clamped(*half_height * 0.5);
        }
    }

    /// Shows the whole of a box from the same direction.
    pub fn show_all(&mut self, bounds: &Aabb, aspect: f64) {
        let (view, distance) = View::around(bounds, self.view.orientation, self.view.lens, aspect);
        self.view = view;
        self.distance = clamped(distance);
    }

    /// Shows the whole of a box from one of the standard directions.
    pub fn show_from(&mut self, standard: Standard, bounds: &Aabb, aspect: f64) {
        self.view.orientation = standard.orientation(self.up);
        self.show_all(bounds, aspect);
    }

    /// Changes between perspective and parallel; what lies at the pivot keeps its size.
    pub fn change_lens(&mut self, tan_half_height: f64) {
        let half_height = self.half_height();
        self.view.lens = match self.view.lens {
            Lens::Perspective { .. } => Lens::Orthographic {
                half_height: clamped(half_height),
            },
            Lens::Orthographic { .. } => {
                let pivot = self.pivot();
                self.distance = clamped(half_height / tan_half_height);
                self.view.eye = pivot - self.view.forward() * self.distance;
                Lens::Perspective { tan_half_height }
            }
        };
    }

    /// Makes the vertical upright in the image again, without another direction.
    pub fn level(&mut self) {
        self.face(self.view.forward());
    }

    fn face(&mut self, forward: DVec3) {
        let orientation = crate::view::looking(forward, self.up.axis())
            .or_else(|| crate::view::looking(forward, self.view.up()));
        if let Some(orientation) = orientation {
            self.view.orientation = orientation;
        }
    }
}

fn clamped(distance: f64) -> f64 {
    // `max` also replaces NaN.
    distance.max(DISTANCE_RANGE.0).min(DISTANCE_RANGE.1)
}
