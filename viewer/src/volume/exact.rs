//! Exact signs of sums of products, for what the crate `robust` has no predicate for.
//! Not an arithmetic library: it can add and say the sign.
//!
//! The results are exact as long as no product of two inputs overflows or is subnormal. A
//! result that is not a number has the sign 0.

pub(crate) use geometry::num::UNIT_ROUNDOFF;
use glam::DVec3;
use robust::Coord3D;

/// Shewchuk's bound for a 3x3 determinant whose rows are rounded differences, relative to its
/// permanent: *Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
/// Predicates* (1997), theorem 23. Exact rows only make the error smaller.
pub(crate) const DETERMINANT_BOUND: f64 = (7.0 + 56.0 * UNIT_ROUNDOFF) * UNIT_ROUNDOFF;

/// A sum without rounding: a nonoverlapping expansion in increasing order without zeros
/// (Shewchuk 1997, section 2.4).
#[derive(Default)]
pub(crate) struct ExactSum {
    parts: Vec<f64>,
}

impl ExactSum {
    pub(crate) fn add(&mut self, x: f64) {
        let mut carry = x;
        let mut kept = 0;
        for i in 0..self.parts.len() {
            let (sum, error) = two_sum(carry, self.parts[i]);
            if error != 0.0 {
                self.parts[kept] = error;
                kept += 1;
            }
            carry = sum;
        }
        self.parts.truncate(kept);
        if carry != 0.0 {
            self.parts.push(carry);
        }
    }

    /// Adds `x * y`.
    pub(crate) fn add_product(&mut self, x: f64, y: f64) {
        let (product, error) = two_product(x, y);
        self.add(error);
        self.add(product);
    }

    /// Adds `x * y * z`.
    fn add_product3(&mut self, x: f64, y: f64, z: f64) {
        if z != 0.0 {
            let (product, error) = two_product(x, y);
            self.add_product(error, z);
            self.add_product(product, z);
        }
    }

    /// The sign of the sum: that of its largest part.
    pub(crate) fn sign(&self) -> i8 {
        self.parts.last().map_or(0, |&x| sign(x))
    }
}

/// -1, 0 or +1; 0 for NaN.
pub(crate) fn sign(x: f64) -> i8 {
    i8::from(x > 0.0) - i8::from(x < 0.0)
}

fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_virtual = sum - a;
    let a_virtual = sum - b_virtual;
    (sum, (a - a_virtual) + (b - b_virtual))
}

fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

/// A determinant and a bound of its rounding error, the rows being exact, or rounded
/// differences of exact numbers.
#[inline]
fn bounded_determinant(u: DVec3, v: DVec3, w: DVec3) -> (f64, f64) {
    let (yz, zy) = (v.y * w.z, v.z * w.y);
    let (zx, xz) = (v.z * w.x, v.x * w.z);
    let (xy, yx) = (v.x * w.y, v.y * w.x);
    let determinant = u.x * (yz - zy) + u.y * (zx - xz) + u.z * (xy - yx);
    let permanent = u.x.abs() * (yz.abs() + zy.abs())
        + u.y.abs() * (zx.abs() + xz.abs())
        + u.z.abs() * (xy.abs() + yx.abs());
    (determinant, DETERMINANT_BOUND * permanent)
}

/// The exact sign of the volume of `(a - p, b - p, c - p)`: -1 if the triangle `(a, b, c)`
/// runs counter-clockwise seen from `p`, +1 if clockwise.
#[inline]
pub(crate) fn volume_sign(a: DVec3, b: DVec3, c: DVec3, p: DVec3) -> i8 {
    let (determinant, bound) = bounded_determinant(a - p, b - p, c - p);
    if determinant.abs() > bound {
        return sign(determinant);
    }
    let [a, b, c, p] = [a, b, c, p].map(|v| Coord3D {
        x: v.x,
        y: v.y,
        z: v.z,
    });
    sign(robust::orient3d(a, b, c, p))
}

/// The exact sign of `d . ((b - a) x (c - a))`: +1 if the triangle `(a, b, c)` runs
/// counter-clockwise seen from infinitely far in the direction `d`.
#[inline]
pub(crate) fn direction_sign(d: DVec3, a: DVec3, b: DVec3, c: DVec3) -> i8 {
    let (determinant, bound) = bounded_determinant(d, b - a, c - a);
    if determinant.abs() > bound {
        return sign(determinant);
    }
    direction_sign_exact(d, a, b, c)
}

/// [`direction_sign`] as `d . (a x b + b x c + c x a)`, which has no differences to round.
#[cold]
fn direction_sign_exact(d: DVec3, a: DVec3, b: DVec3, c: DVec3) -> i8 {
    let mut sum = ExactSum::default();
    for (u, v) in [(a, b), (b, c), (c, a)] {
        sum.add_product3(u.y, v.z, d.x);
        sum.add_product3(-u.z, v.y, d.x);
        sum.add_product3(u.z, v.x, d.y);
        sum.add_product3(-u.x, v.z, d.y);
        sum.add_product3(u.x, v.y, d.z);
        sum.add_product3(-u.y, v.x, d.z);
    }
    sum.sign()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// Directions that leave a plane by less than rounding can see.
        #[test]
        fn directions_near_a_plane_have_exact_signs(
            corners in prop::array::uniform3(prop::array::uniform3(-1_i64 << 18..=1 << 18)),
            (i, j) in (-3_i64..=3, -3_i64..=3),
            offset in prop::array::uniform3(-1_i64..=1),
        ) {
            let [a, b, c] = corners;
            let span = |x: usize| i * (b[x] - a[x]) + j * (c[x] - a[x]);
            let d = [0, 1, 2].map(|x| (span(x) << 30) + offset[x]);
            let n = [(1, 2), (2, 0), (0, 1)].map(|(x, y)| {
                let minor = (b[x] - a[x]) * (c[y] - a[y]) - (b[y] - a[y]) * (c[x] - a[x]);
                i128::from(minor)
            });
            let expected: i128 = (0..3).map(|x| i128::from(d[x]) * n[x]).sum();
            let vector = |v: [i64; 3]| DVec3::from(v.map(|x| x as f64));
            let found = direction_sign(vector(d), vector(a), vector(b), vector(c));
            prop_assert_eq!(i128::from(found), expected.signum());
        }
    }
}
