//! Which volumes cannot touch a convex region. Not a scene traversal, and not a test of the
//! caster itself: a caster out of sight can have a volume in sight.

use geometry::bounds::Aabb;
use glam::{DVec3, DVec4, Vec4Swizzles};

use crate::volume::exact::{ExactSum, UNIT_ROUNDOFF, sign};
use crate::volume::light::Light;

/// Whether the shadow volume of a box (the box, and all that is behind it seen from the
/// light) may touch the intersection of half-spaces: false only if all of it is strictly
/// outside one of them.
///
/// A plane `(n, d)` has the half-space `n . x + d >= 0`. All are in the frame of the box and
/// the light. The signs are exact, so a plane parallel to the light's direction culls as well
/// as any other. Planes that are not finite cull nothing; the empty box, and a light that is
/// not finite, have no volume.
#[must_use]
pub fn volume_may_touch(bounds: &Aabb, light: DVec4, planes: &[DVec4]) -> bool {
    let Some(light) = Light::new(light) else {
        return false;
    };
    !bounds.is_empty() && !planes.iter().any(|&plane| is_outside(bounds, light, plane))
}

/// The box and the directions away from the light are hulls of what they are at the corners,
/// so looking at corners is enough.
fn is_outside(bounds: &Aabb, light: Light, plane: DVec4) -> bool {
    let leaves = |corner: DVec3| match light {
        Light::Point(point) => dot_sign(plane.xyz(), corner, -point),
        Light::Towards(direction) => dot_sign(plane.xyz(), -direction, DVec3::ZERO),
    };
    plane.is_finite()
        && bounds.corners().into_iter().all(|corner| {
            let height = sum_sign([plane.xyz(), plane.www()], [corner, DVec3::X]);
            height < 0 && leaves(corner) <= 0
        })
}

/// The exact sign of `n . (u + v)`.
fn dot_sign(n: DVec3, u: DVec3, v: DVec3) -> i8 {
    sum_sign([n, n], [u, v])
}

/// The exact sign of `a0 . b0 + a1 . b1`.
fn sum_sign(a: [DVec3; 2], b: [DVec3; 2]) -> i8 {
    let products = [a[0] * b[0], a[1] * b[1]];
    let sum = products[0].element_sum() + products[1].element_sum();
    // Each product passes its own rounding and up to three additions.
    let size = products[0].abs().element_sum() + products[1].abs().element_sum();
    if sum.abs() > 8.0 * UNIT_ROUNDOFF * size {
        return sign(sum);
    }
    let mut exact = ExactSum::default();
    for (a, b) in a.into_iter().zip(b) {
        for axis in 0..3 {
            exact.add_product(a[axis], b[axis]);
        }
    }
    exact.sign()
}
