//! From a pixel to a ray, and to the frame in which that ray is looked along.

use glam::{DMat3, DVec3};

use crate::view::{DepthRange, Lens, Region, View, direction};

/// A half line in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// The eye; in a parallel view the pixel's place in the plane through the eye.
    pub origin: DVec3,
    /// Unit length.
    pub direction: DVec3,
}

impl Ray {
    /// The ray through a place of the image, in pixels from its top left corner: the centre of the
    /// first pixel is (0.5, 0.5). Places outside of the region have rays too. `None` if a number of
    /// the view or the place is not finite.
    #[must_use]
    pub fn through_pixel(view: &View, region: &Region, pixel: [f64; 2]) -> Option<Self> {
        Lines::through(view, region, pixel).map(|lines| lines.ray)
    }
}

/// Where a point of the world is in the image, in pixels from its top left corner. `None` if a
/// perspective view has it behind the eye.
#[must_use]
pub fn pixel_of(view: &View, region: &Region, p_in_world: DVec3) -> Option<[f64; 2]> {
    let center = center_of(region);
    let lines = Lines::through(view, region, center)?;
    let p = lines.aim_from_world * (p_in_world - lines.ray.origin);
    let [x, y] = offset_px(p, lines.is_perspective)?;
    Some([center[0] + x, center[1] + y])
}

/// Where a point of an aim's frame is in the image, in pixels from the aim.
pub(super) fn offset_px(p: DVec3, is_perspective: bool) -> Option<[f64; 2]> {
    let offset = match is_perspective {
        true if p.z > 0.0 => [p.x / p.z, p.y / p.z],
        true => return None,
        false => [p.x, p.y],
    };
    offset.iter().all(|x| x.is_finite()).then_some(offset)
}

/// What is aimed at. See [`Aim::through_pixel`] for the frame.
#[derive(Clone, Copy, Debug)]
pub struct Aim {
    pub(super) lines: Lines,
    /// Least depth that is drawn.
    pub(super) near: f64,
    /// The view it comes from.
    pub(super) source: Option<Source>,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Source {
    view: View,
    region: Region,
    range: DepthRange,
    pixel: [f64; 2],
}

/// A ray and the frame around it.
///
/// The frame is linear in `p - ray.origin`. Z is the depth, in world units. X points right and Y down
/// in the image, both 0 on the ray. In a parallel view they are pixels, in a perspective view pixels
/// times depth. So whether a triangle holds the pixel is a question of X and Y alone, in both, and
/// what a screen's stretch or a mirror does to it is in the matrix.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lines {
    pub ray: Ray,
    pub aim_from_world: DMat3,
    pub is_perspective: bool,
    /// Distance along the ray that a unit of depth takes.
    pub distance_of_depth: f64,
}

impl Lines {
    pub fn through(view: &View, region: &Region, pixel: [f64; 2]) -> Option<Self> {
        let center = center_of(region);
        let (width, height) = (f64::from(region.width), f64::from(region.height));
        let (x, y) = (pixel[0] - center[0], pixel[1] - center[1]);
        let (right, down, forward) = (view.right(), -view.up(), view.forward());
        let half_height = match view.lens {
            Lens::Perspective { tan_half_height } => tan_half_height,
            Lens::Orthographic { half_height } => half_height,
        };
        // Pixels that a unit is long: of slope, or of the world.
        let across = width / (2.0 * half_height * region.aspect);
        let along = height / (2.0 * half_height);
        let offset = right * (x / across) + down * (y / along);
        let (origin, towards, rows) = match view.lens {
            Lens::Perspective { .. } => (
                view.eye,
                forward + offset,
                [
                    right * across - forward * x,
                    down * along - forward * y,
                    forward,
                ],
            ),
            Lens::Orthographic { .. } => (
                view.eye + offset,
                forward,
                [right * across, down * along, forward],
            ),
        };
        let lines = Self {
            ray: Ray {
                origin,
                direction: direction(towards)?,
            },
            aim_from_world: DMat3::from_cols(rows[0], rows[1], rows[2]).transpose(),
            is_perspective: matches!(view.lens, Lens::Perspective { .. }),
            distance_of_depth: towards.length(),
        };
        (origin.is_finite() && lines.aim_from_world.is_finite()).then_some(lines)
    }
}

fn center_of(region: &Region) -> [f64; 2] {
    [
        f64::from(region.x) + 0.5 * f64::from(region.width),
        f64::from(region.y) + 0.5 * f64::from(region.height),
    ]
}

/// How much nearer lines and points are drawn: the share of their depth in the depth buffer that
/// is added to it, as in `shader/emit_place.rs`.
const STROKE_SHARE: f64 = 1.0 / 8192.0;

impl Aim {
    /// At a place of the image, in pixels from its top left corner. `range` is what the renderer
    /// draws: see [`DepthRange::of`]. `None` outside of the region, and if a number is not finite.
    #[must_use]
    pub fn through_pixel(
        view: &View,
        region: &Region,
        range: DepthRange,
        pixel: [f64; 2],
    ) -> Option<Self> {
        let [x, y, width, height] = region.rectangle().map(f64::from);
        let is_inside = (x..=x + width).contains(&pixel[0]) && (y..=y + height).contains(&pixel[1]);
        if !is_inside {
            return None;
        }
        let lines = Lines::through(view, region, pixel)?;
        Some(Self {
            lines,
            near: if lines.is_perspective {
                range.near.max(f64::MIN_POSITIVE)
            } else {
                f64::NEG_INFINITY
            },
            source: Some(Source {
                view: *view,
                region: *region,
                range,
                pixel,
            }),
        })
    }

    /// Along a ray that comes from no image. It meets triangles only: lines and points have no
    /// width but in pixels. `direction` need not have unit length; `None` if it is zero or a number
    /// is not finite.
    #[must_use]
    pub fn along(origin: DVec3, towards: DVec3) -> Option<Self> {
        let forward = direction(towards).filter(|_| origin.is_finite())?;
        let (right, up) = forward.any_orthonormal_pair();
        // Right-handed with the way forward, as right and down are.
        let down = if right.cross(up).dot(forward) > 0.0 {
            up
        } else {
            -up
        };
        Some(Self {
            lines: Lines {
                ray: Ray {
                    origin,
                    direction: forward,
                },
                aim_from_world: DMat3::from_cols(right, down, forward).transpose(),
                is_perspective: false,
                distance_of_depth: 1.0,
            },
            near: 0.0,
            source: None,
        })
    }

    /// The ray.
    #[must_use]
    pub fn ray(&self) -> Ray {
        self.lines.ray
    }

    /// The same view at a place some pixels to the right and down, if that is in the region.
    pub(super) fn moved(&self, [right, down]: [f64; 2]) -> Option<Self> {
        let source = self.source?;
        let [x, y] = source.pixel;
        Self::through_pixel(
            &source.view,
            &source.region,
            source.range,
            [x + right, y + down],
        )
    }

    /// The view direction.
    pub(super) fn forward(&self) -> DVec3 {
        self.lines.aim_from_world.row(2)
    }

    /// The depth that the depth buffer holds for lines and points at `depth`. Grows with it.
    pub(super) fn stroke_depth(&self, depth: f64) -> f64 {
        match &self.source {
            Some(_) if self.lines.is_perspective => depth / (1.0 + STROKE_SHARE),
            Some(source) => depth - (source.range.far - depth) * STROKE_SHARE,
            None => depth,
        }
    }
}
