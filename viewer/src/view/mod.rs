//! What is looked at, from where, and how it falls onto the image; all in f64.
//!
//! A [`View`] is an eye, a direction and a lens. It comes from a camera of the scene
//! ([`camera`]), from numbers that a user types ([`look_at`]), from a saved view ([`ivv`]) or from
//! the scene's box ([`framing`]). [`region`] is the part of the image it fills, [`projection`]
//! makes matrices and planes of it. Nothing here draws, and nothing here knows of the mouse.
//!
//! Conventions: the world is right-handed. In view coordinates the eye is the origin, +X points
//! right, +Y up, and the view goes along -Z. *Depth* is the distance along the view direction, so
//! it is positive in front of the eye. The aspect ratio is width over height.

pub mod camera;
pub mod framing;
pub mod ivv;
pub mod look_at;
pub mod projection;
pub mod region;

pub use camera::{NoSuchCamera, find_camera};
pub use look_at::{LookAtError, parse_look_at};
pub use projection::DepthRange;
pub use region::Region;

use geometry::bounds::Aabb;
use glam::{DAffine3, DMat3, DQuat, DVec3};

/// How wide the view is. Only the height is kept; the width is the height times the aspect ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// Rays through the eye.
    Perspective {
        /// Tangent of half the vertical field of view; positive and finite.
        tan_half_height: f64,
    },
    /// Parallel rays.
    Orthographic {
        /// Half the height of what is seen, world units; positive and finite.
        half_height: f64,
    },
}

/// Tangents of half a field of view are kept in this range: at its ends an image of 1000 pixels
/// shows a pixel's width at a thousand times that distance, or all but 0.1 degrees of a half space.
pub(crate) const TAN_RANGE: (f64, f64) = (1e-6, 1e3);

/// An eye, where it looks, and its lens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The eye in the world.
    pub eye: DVec3,
    /// Turns -Z into the view direction and +Y into up, both in the world; unit length.
    pub orientation: DQuat,
    /// How wide the view is.
    pub lens: Lens,
}

impl View {
    /// The view direction; unit length.
    #[must_use]
    pub fn forward(&self) -> DVec3 {
        self.orientation * DVec3::NEG_Z
    }

    /// Upwards in the image; unit length.
    #[must_use]
    pub fn up(&self) -> DVec3 {
        self.orientation * DVec3::Y
    }

    /// Rightwards in the image; unit length.
    #[must_use]
    pub fn right(&self) -> DVec3 {
        self.orientation * DVec3::X
    }

    /// The view's frame in the world.
    #[must_use]
    pub fn world_from_view(&self) -> DAffine3 {
        DAffine3::from_rotation_translation(self.orientation, self.eye)
    }

    /// The inverse of [`View::world_from_view`]. Far from the origin its translation cancels
    /// against that of points; [`View::p_in_view`] does not lose those digits.
    #[must_use]
    pub fn view_from_world(&self) -> DAffine3 {
        let view_from_world = DMat3::from_quat(self.orientation).transpose();
        DAffine3::from_mat3_translation(view_from_world, -(view_from_world * self.eye))
    }

    /// A point of the world in view coordinates; exact to a few roundings of `p - eye`, wherever
    /// the two are.
    #[must_use]
    pub fn p_in_view(&self, p_in_world: DVec3) -> DVec3 {
        self.orientation.conjugate() * (p_in_world - self.eye)
    }

    /// Smallest and largest depth of a box; negative behind the eye. `None` for an empty box.
    #[must_use]
    pub fn depth_bounds(&self, bounds: &Aabb) -> Option<(f64, f64)> {
        if bounds.is_empty() {
            return None;
        }
        // The extent of a box along a direction is the dot product of absolute values (Arvo,
        // Graphics Gems, 1990), so no corner needs to be visited.
        let forward = self.forward();
        let (center, half) = (bounds.center(), bounds.size() * 0.5);
        let depth = forward.dot(center - self.eye);
        let reach = forward.abs().dot(half);
        Some((depth - reach, depth + reach))
    }
}

/// The direction of `v`, whatever its magnitude; `None` if it is zero or not finite.
pub(crate) fn direction(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    if largest > 0.0 && v.is_finite() {
        // Dividing first keeps the squares in range.
        (v / largest).try_normalize()
    } else {
        None
    }
}

/// The rotation that turns -Z into `forward` and +Y into the part of `up` across it; `None` if
/// the two do not span a plane. Neither needs unit length.
pub(crate) fn looking(forward: DVec3, up: DVec3) -> Option<DQuat> {
    let forward = direction(forward)?;
    let right = direction(forward.cross(direction(up)?))?;
    let up = right.cross(forward);
    Some(DQuat::from_mat3(&DMat3::from_cols(right, up, -forward)).normalize())
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use std::f64::consts::FRAC_1_SQRT_2;

    pub(crate) fn v(x: f64, y: f64, z: f64) -> DVec3 {
        DVec3::new(x, y, z)
    }

    pub(crate) fn near(a: DVec3, b: DVec3, tolerance: f64) -> bool {
        (a - b).length() <= tolerance
    }

    /// An eye at (10, 0, 0) that looks along -X with +Z up sees +Y to its right.
    pub(crate) fn from_plus_x() -> View {
        View {
            eye: v(10.0, 0.0, 0.0),
            orientation: looking(v(-1.0, 0.0, 0.0), v(0.0, 0.0, 1.0)).unwrap(),
            lens: Lens::Perspective {
                tan_half_height: 0.5,
            },
        }
    }

    #[test]
    fn view_coordinates_of_points() {
        let far = v(2_600_000.0, 1_200_000.0, 400.0);
        let moved = View {
            eye: far + v(10.0, 0.0, 0.0),
            ..from_plus_x()
        };
        let rows = [
            (from_plus_x(), v(10.0, 0.0, 0.0), v(0.0, 0.0, 0.0)),
            (from_plus_x(), v(0.0, 0.0, 0.0), v(0.0, 0.0, -10.0)),
            (from_plus_x(), v(7.0, 2.0, 0.0), v(2.0, 0.0, -3.0)),
            (from_plus_x(), v(12.0, -1.0, 5.0), v(-1.0, 5.0, 2.0)),
            (moved, far + v(7.0, 2.0, 1.0), v(2.0, 1.0, -3.0)),
        ];
        for (view, p, expected) in rows {
            let p_in_view = view.p_in_view(p);
            assert!(near(p_in_view, expected, 1e-14), "{p}: {p_in_view}");
            // The matrix cancels p against the eye: 1e7 times a rounding is the best it can do.
            let by_matrix = view.view_from_world().transform_point3(p);
            assert!(near(by_matrix, expected, 4e-9), "{p}: {by_matrix}");
            let back = view.world_from_view().transform_point3(expected);
            assert!(near(back, p, 4e-9), "{p}: {back}");
        }
    }

    #[test]
    fn axes_of_a_view() {
        let view = from_plus_x();
        assert!(near(view.forward(), DVec3::NEG_X, 1e-15));
        assert!(near(view.up(), DVec3::Z, 1e-15));
        assert!(near(view.right(), DVec3::Y, 1e-15));
    }

    #[test]
    fn looking_needs_two_directions() {
        let c = FRAC_1_SQRT_2;
        let rows = [
            (DVec3::NEG_Z, DVec3::Y, Some((DVec3::NEG_Z, DVec3::Y))),
            (
                v(0.0, 3e-200, 0.0),
                v(0.0, 9e99, 9e99),
                Some((DVec3::Y, DVec3::Z)),
            ),
            (
                v(1.0, 0.0, -1.0),
                DVec3::Z,
                Some((v(c, 0.0, -c), v(c, 0.0, c))),
            ),
            (DVec3::X, v(-2.0, 0.0, 0.0), None),
            (DVec3::ZERO, DVec3::Y, None),
            (DVec3::NAN, DVec3::Y, None),
            (DVec3::X, v(f64::INFINITY, 0.0, 0.0), None),
        ];
        for (forward, up, expected) in rows {
            let axes = looking(forward, up).map(|q| (q * DVec3::NEG_Z, q * DVec3::Y));
            match (axes, expected) {
                (None, None) => {}
                (Some((f, u)), Some((ef, eu))) => {
                    assert!(near(f, ef, 1e-15) && near(u, eu, 1e-15), "{forward} {up}");
                }
                _ => panic!("{forward} {up}: {axes:?}"),
            }
        }
    }

    #[test]
    fn depths_of_boxes() {
        let view = from_plus_x();
        let oblique = View {
            orientation: looking(v(-1.0, 0.0, -1.0), DVec3::Z).unwrap(),
            ..view
        };
        let upwards = View {
            orientation: looking(v(-1.0, 0.0, 1.0), DVec3::Z).unwrap(),
            ..view
        };
        let unit = Aabb {
            min: v(-1.0, -2.0, -3.0),
            max: v(1.0, 2.0, 3.0),
        };
        let c = FRAC_1_SQRT_2;
        let rows = [
            (view, unit, Some((9.0, 11.0))),
            (oblique, unit, Some((6.0 * c, 14.0 * c))),
            (upwards, unit, Some((6.0 * c, 14.0 * c))),
            (view, Aabb::EMPTY, None),
            (
                view,
                Aabb {
                    min: v(20.0, 0.0, 0.0),
                    max: v(30.0, 0.0, 0.0),
                },
                Some((-20.0, -10.0)),
            ),
        ];
        for (view, bounds, expected) in rows {
            match (view.depth_bounds(&bounds), expected) {
                (None, None) => {}
                (Some((a, b)), Some((ea, eb))) => {
                    assert!((a - ea).abs() < 1e-13 && (b - eb).abs() < 1e-13, "{a} {b}");
                }
                (got, _) => panic!("{got:?} for {expected:?}"),
            }
        }
    }
}
