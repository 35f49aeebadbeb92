//! The choice of a mesh's local origin, so that `f32` positions keep the detail of `f64`
//! ones ("relative to centre"). It moves nothing itself: the caller subtracts the origin
//! from each point in `f64` and puts it into the mesh's translation.

use crate::bounds::Aabb;
use crate::num::{exponent, scale_pow2};
use glam::DVec3;

/// How many times worse storing a coordinate directly may be than storing it relative to
/// the centre before an origin is worth having: two of the 24 bits of an `f32`.
pub const DIRECT_STORAGE_FACTOR: f64 = 4.0;

/// The origin is a multiple of the largest power of two that is at most this part of half
/// the extent.
const GRID_BITS: i32 = 3;

/// The origin for a mesh with the given bounds, decided per axis.
///
/// Let `h` be half the longest edge of the box. `f32` storage of a coordinate `x` errs by at
/// most `ulp(x) / 2`, so on an axis whose coordinates satisfy `|x| <= 4h` direct storage is
/// at most [`DIRECT_STORAGE_FACTOR`] times worse than centred storage of the box's longest
/// axis, and the origin is exactly 0 there. So it is on an axis with a single coordinate
/// that an `f32` holds exactly. Elsewhere it is the centre rounded to a multiple of the
/// largest power of two `q <= h/8`; a box that is one point keeps its centre unrounded.
///
/// Bound: what is left is at most `h + q/2 <= 17/16 h`, hence its `f32` error is at most
/// `ulp(h)`. The subtraction is exact in `f64` because the origin has no bits below `q` and
/// is within a factor two of each coordinate it is subtracted from (Sterbenz).
///
/// An empty or non-finite box has the origin zero.
#[must_use]
pub fn local_origin(bounds: &Aabb) -> DVec3 {
    if bounds.is_empty() || !bounds.min.is_finite() || !bounds.max.is_finite() {
        return DVec3::ZERO;
    }
    // Infinite if it overflows; then everything fits directly.
    let half_extent = bounds.size().max_element() * 0.5;
    let center = bounds.center();
    DVec3::new(
        axis_origin(bounds.min.x, bounds.max.x, center.x, half_extent),
        axis_origin(bounds.min.y, bounds.max.y, center.y, half_extent),
        axis_origin(bounds.min.z, bounds.max.z, center.z, half_extent),
    )
}

fn axis_origin(min: f64, max: f64, center: f64, half_extent: f64) -> f64 {
    let fits_directly = min.abs().max(max.abs()) <= DIRECT_STORAGE_FACTOR * half_extent;
    let is_one_f32 = min == max && f64::from(min as f32) == min;
    if fits_directly || is_one_f32 {
        return 0.0;
    }
    if half_extent == 0.0 {
        return center;
    }
    let grid_exponent = exponent(half_extent) - GRID_BITS;
    let rounded = scale_pow2(scale_pow2(center, -grid_exponent).round(), grid_exponent);
    // Out of range only if the box is smaller than the coordinate's last bit.
    if rounded.is_finite() { rounded } else { center }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boxed(min: [f64; 3], max: [f64; 3]) -> Aabb {
        Aabb {
            min: min.into(),
            max: max.into(),
        }
    }

    #[test]
    fn origin_of_boxes() {
        let rows = [
            // Around the origin, and off it by less than the factor.
            (boxed([-1.0; 3], [1.0; 3]), [0.0; 3]),
            (boxed([6.0; 3], [8.0; 3]), [7.0; 3]),
            (boxed([2.0; 3], [4.0; 3]), [0.0; 3]),
            // Per axis: only x is far away; the flat z is measured against the longest edge.
            (
                boxed([1000.0, -1.0, 3.9], [1002.0, 1.0, 3.9]),
                [1001.0, 0.0, 0.0],
            ),
            (
                boxed([0.0, 0.0, 1000.3], [2.0, 2.0, 1000.3]),
                [0.0, 0.0, 1000.25],
            ),
            // One coordinate: kept whole, or needless because an f32 holds it.
            (
                boxed([1e6 + 0.1, 2.5, 0.1], [1e6 + 0.1, 2.5, 0.1]),
                [1e6 + 0.1, 0.0, 0.1],
            ),
            // Swiss LV95: a multiple of two metres for a 50 m part.
            (
                boxed(
                    [2_599_975.3, 1_199_975.2, 412.0],
                    [2_600_025.3, 1_200_025.2, 420.0],
                ),
                [2_600_000.0, 1_200_000.0, 416.0],
            ),
            (Aabb::EMPTY, [0.0; 3]),
            (boxed([f64::NAN; 3], [f64::NAN; 3]), [0.0; 3]),
            (
                boxed([1e300, 0.0, 0.0], [1e300, 1e-300, 0.0]),
                [1e300, 0.0, 0.0],
            ),
            (boxed([-f64::MAX; 3], [f64::MAX; 3]), [0.0; 3]),
        ];
        for (bounds, expected) in rows {
            assert_eq!(local_origin(&bounds).to_array(), expected, "{bounds:?}");
        }
    }

    /// The gap between neighbouring `f32` at `x`.
    fn ulp_f32(x: f64) -> f64 {
        let x = x.abs() as f32;
        f64::from(x.next_up()) - f64::from(x)
    }

    #[test]
    fn f32_error_stays_below_an_ulp_of_half_the_extent() {
        let easting_northing = DVec3::new(2_600_000.0, 1_200_000.0, 431.0);
        for (extent, offset, limit) in [
            (50.0, easting_northing, 2e-6),
            (0.004, easting_northing, 1.2e-10),
            (3.0, -easting_northing * 100.0, 1.2e-7),
        ] {
            let min = offset + DVec3::new(0.123, 0.456, 0.789);
            let bounds = Aabb {
                min,
                max: min + DVec3::splat(extent),
            };
            let origin = local_origin(&bounds);
            // Millimetre detail, or a thousand steps across a smaller part.
            let step = extent.min(1.0) / 1000.0;
            let count = (extent / step) as u32;
            for i in 0..=count {
                let p = (min + DVec3::splat(f64::from(i) * step)).min(bounds.max);
                let stored = (p - origin).as_vec3();
                let error = (stored.as_dvec3() - (p - origin)).abs().max_element();
                assert!(error <= ulp_f32(extent / 2.0), "{extent} {error:e}");
                assert!(error <= limit, "{extent} {error:e}");
                assert_eq!((p - origin) + origin, p, "the subtraction is exact");
            }
        }
    }
}
