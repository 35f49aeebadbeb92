//! A view of the whole scene, for models without a camera.
//!
//! It looks from the front, 30 degrees to the right and 25 degrees from above: the front stays the
//! main side, the right side and the top are seen as well, and no two of the three at the same
//! angle, so the edges of boxes do not fall onto each other as they do in an isometric view.
//!
//! Up is +Z and the front is the side towards -Y, as in Lexolights and in CAD: that is what its
//! models are made for. Inventor itself has no such rule; its default camera looks along -Z with
//! +Y up, and models made for that stand upright with [`Up::Y`] (front towards +Z).

use geometry::bounds::Aabb;
use glam::{DQuat, DVec2, DVec3};

use super::look_at::upright;
use super::{Lens, View};

/// Which way is up in a model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Up {
    /// Inventor's and glTF's habit.
    Y,
    /// Lexolights' and CAD's.
    #[default]
    Z,
}

/// Inventor's default `heightAngle` of 45 degrees: tan(pi / 8).
const TAN_HALF_HEIGHT: f64 = std::f64::consts::SQRT_2 - 1.0;
/// Part of the image's width and height that the scene may take.
const FILL: f64 = 0.9;
/// Azimuth and elevation of the eye as seen from the scene.
const AZIMUTH_DEG: f64 = 30.0;
const ELEVATION_DEG: f64 = 25.0;
/// Corners of boxes are cut to this before anything is computed: far beyond f32, and its squares
/// stay within f64.
const LARGEST: f64 = 1e100;
/// A box smaller than this share of its distance from the origin is a point: f64 itself holds no
/// more than 2^-53 of it.
const POINT_SHARE: f64 = 1.0 / (1_u64 << 40) as f64;

impl Up {
    /// The vertical, upwards.
    #[must_use]
    pub fn axis(self) -> DVec3 {
        match self {
            Self::Y => DVec3::Y,
            Self::Z => DVec3::Z,
        }
    }
}

impl View {
    /// A perspective view that shows the whole of `bounds` in an image of this aspect ratio, as
    /// large as Inventor's default angle allows; `aspect` is positive and finite. An empty box is taken as a cube of side 2 around the
    /// origin, a point as one around the point. Finite for any box.
    #[must_use]
    pub fn of_whole(bounds: &Aabb, up: Up, aspect: f64) -> Self {
        let lens = Lens::Perspective {
            tan_half_height: TAN_HALF_HEIGHT,
        };
        Self::around(bounds, three_quarter(up), lens, aspect).0
    }

    /// The same from a direction and with a lens of the caller's, of which a parallel one is made
    /// as wide as it must be; and the depth of the box's middle, which is positive.
    #[must_use]
    pub fn around(bounds: &Aabb, orientation: DQuat, lens: Lens, aspect: f64) -> (Self, f64) {
        let bounds = presentable(bounds);
        let to_view = orientation.conjugate();
        let corners = bounds.corners().map(|p| to_view * (p - bounds.center()));
        let (in_view, lens) = match lens {
            Lens::Perspective { tan_half_height } => {
                let tan = DVec2::new(tan_half_height * aspect, tan_half_height);
                (eye_around(&corners, tan * FILL), lens)
            }
            Lens::Orthographic { .. } => {
                let reach = corners
                    .iter()
                    .fold(DVec3::ZERO, |reach, p| reach.max(p.abs()));
                let half_height = reach.y.max(reach.x / aspect) / FILL;
                // A scene seen edge on has no height.
                let half_height = half_height.max(reach.z * f64::EPSILON);
                (
                    DVec3::Z * (2.0 * reach.z + half_height),
                    Lens::Orthographic { half_height },
                )
            }
        };
        let eye = bounds.center() + orientation * in_view;
        let view = Self {
            eye,
            orientation,
            lens,
        };
        (view, in_view.z)
    }
}

fn presentable(bounds: &Aabb) -> Aabb {
    let around = |center: DVec3, half: f64| Aabb {
        min: center - half,
        max: center + half,
    };
    if bounds.is_empty() {
        return around(DVec3::ZERO, 1.0);
    }
    let limit = DVec3::splat(LARGEST);
    let cut = Aabb {
        min: bounds.min.clamp(-limit, limit),
        max: bounds.max.clamp(-limit, limit),
    };
    let distance = cut.center().abs().max_element();
    if cut.size().max_element() <= distance * POINT_SHARE {
        around(cut.center(), (distance * POINT_SHARE).max(1.0))
    } else {
        cut
    }
}

/// From the front, the right and above.
pub(crate) fn three_quarter(up: Up) -> DQuat {
    let (sin, cos) = AZIMUTH_DEG.to_radians().sin_cos();
    let (rise, run) = ELEVATION_DEG.to_radians().sin_cos();
    let forward_z_up = DVec3::new(-sin * run, cos * run, -rise);
    let z_up = upright(forward_z_up).unwrap_or(DQuat::IDENTITY);
    match up {
        Up::Z => z_up,
        // Turns +Z into +Y and the front from -Y to +Z.
        Up::Y => DQuat::from_rotation_x(-std::f64::consts::FRAC_PI_2) * z_up,
    }
}

/// The eye from which points in view axes fit between rays of slope `tan`, as near as can be, with
/// equal room left and right, and above and below.
///
/// With depth d = -z, the ray plane on the right passes an eye e where x - e.x = tan (d - e.d). The
/// point that needs most is the one with the largest x - tan d, and so for each side; the eye's
/// place across is then the middle, and its depth the least that the narrower axis allows. Being
/// between two opposite ray planes, every point is in front of the eye.
fn eye_around(points: &[DVec3], tan: DVec2) -> DVec3 {
    let mut most = DVec2::NEG_INFINITY;
    let mut least = DVec2::INFINITY;
    for p in points {
        let across = p.truncate();
        let reach = tan * -p.z;
        most = most.max(across - reach);
        least = least.min(across + reach);
    }
    let by_axis = (most - least) / (tan * -2.0);
    let eye_depth = by_axis.min_element();
    ((most + least) * 0.5).extend(-eye_depth)
}

#[cfg(test)]
mod tests {
    use super::super::tests::v;
    use super::*;

    /// Largest |x| and |y| of the corners in the image, and the smallest depth.
    fn extent(view: &View, aspect: f64, bounds: &Aabb) -> (f64, f64, f64) {
        let corners = bounds.corners().map(|p| {
            let p = view.p_in_view(p);
            let (x, y) = (p.x / -p.z, p.y / -p.z);
            (
                x.abs() / TAN_HALF_HEIGHT / aspect,
                y.abs() / TAN_HALF_HEIGHT,
                -p.z,
            )
        });
        corners.into_iter().fold((0.0, 0.0, f64::INFINITY), |m, c| {
            (f64::max(m.0, c.0), f64::max(m.1, c.1), f64::min(m.2, c.2))
        })
    }

    #[test]
    fn the_whole_box_fills_the_image() {
        let far = v(2_600_000.0, 1_200_000.0, 450.0);
        let boxes = [
            (v(-1.0, -1.0, -1.0), v(1.0, 1.0, 1.0)),
            (far, far + v(30.0, 12.0, 9.0)),
            (v(0.0, 0.0, 0.0), v(100.0, 80.0, 0.0)),
            (v(0.0, 5.0, 0.0), v(0.0, 9.0, 7.0)),
            (v(3.0, 3.0, -2.0), v(3.0, 3.0, 8.0)),
            (v(0.0, -50.0, 0.0), v(0.0, 50.0, 0.0)),
            (v(1e-9, 1e-9, 0.0), v(2e-9, 2e-9, 1e-9)),
            (v(-1e30, -1e30, 0.0), v(1e30, 1e30, 1e30)),
        ];
        for (min, max) in boxes {
            let bounds = Aabb { min, max };
            for (up, aspect) in [(Up::Z, 1.0), (Up::Z, 2.5), (Up::Y, 0.4), (Up::Y, 1.6)] {
                let view = View::of_whole(&bounds, up, aspect);
                let (x, y, depth) = extent(&view, aspect, &bounds);
                let fill = x.max(y);
                assert!(depth > 0.0, "{bounds:?} {up:?} {aspect}: behind the eye");
                assert!(
                    (fill - 0.9).abs() < 1e-6,
                    "{bounds:?} {up:?} {aspect}: {fill}"
                );
            }
        }
    }

    #[test]
    fn looks_from_the_front_right_above() {
        let bounds = Aabb {
            min: v(4.0, 4.0, 4.0),
            max: v(6.0, 6.0, 6.0),
        };
        // The unit vector towards the eye: cos 25 sin 30, cos 25 cos 30, sin 25.
        let (side, front, above) = (0.453_153_893, 0.784_885_566_6, 0.422_618_261_7);
        for (up, towards_eye, top) in [
            (Up::Z, v(side, -front, above), DVec3::Z),
            (Up::Y, v(side, above, front), DVec3::Y),
        ] {
            let view = View::of_whole(&bounds, up, 1.0);
            assert!((view.forward() + towards_eye).length() < 1e-8, "{up:?}");
            assert!(view.right().dot(top).abs() < 1e-15, "{up:?}: not level");
            assert!(view.up().dot(top) > 0.0, "{up:?}");
        }
    }

    #[test]
    fn degenerate_boxes_give_finite_views_that_show_their_middle() {
        let point = |p: DVec3| Aabb { min: p, max: p };
        let all = Aabb {
            min: DVec3::splat(f64::MIN),
            max: DVec3::splat(f64::MAX),
        };
        let infinite = Aabb {
            min: DVec3::NEG_INFINITY,
            max: DVec3::INFINITY,
        };
        let nan = Aabb {
            min: DVec3::NAN,
            max: DVec3::NAN,
        };
        let rows = [
            (Aabb::EMPTY, DVec3::ZERO),
            (nan, DVec3::ZERO),
            (point(DVec3::ZERO), DVec3::ZERO),
            (point(v(7.0, -3.0, 2.0)), v(7.0, -3.0, 2.0)),
            (point(v(2.6e6, 1.2e6, 0.0)), v(2.6e6, 1.2e6, 0.0)),
            (point(v(1e30, 0.0, 0.0)), v(1e30, 0.0, 0.0)),
            (all, DVec3::ZERO),
            (infinite, DVec3::ZERO),
        ];
        for (bounds, middle) in rows {
            for aspect in [0.25, 1.0, 4.0] {
                let view = View::of_whole(&bounds, Up::Z, aspect);
                assert!(
                    view.eye.is_finite() && view.orientation.is_finite(),
                    "{bounds:?}"
                );
                let p = view.p_in_view(middle);
                assert!(p.z < 0.0, "{bounds:?}: the middle is behind the eye");
                let slope = p.truncate().length() / -p.z;
                assert!(slope < 0.5 * TAN_HALF_HEIGHT, "{bounds:?}: {slope}");
            }
        }
    }
}
