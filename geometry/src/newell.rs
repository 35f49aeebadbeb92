//! Newell's area vector of a closed loop, with the bound of its rounding error.
//! It knows nothing of what a zero area means to a caller.

use crate::num::{exponent, gamma_of_len, pow2};
use glam::DVec3;

/// The area vector of the loop: its direction is the normal by the right-hand rule, its
/// length twice the area. Unnormalised.
///
/// It is the sum of `(p[i] - p[0]) x (p[i+1] - p[0])`, which equals Newell's formula
/// (Sutherland, Sproull and Schumacker 1974) but keeps its digits far from the origin.
/// Loops that are not planar get the normal of the plane in which their projected area is
/// largest. Fewer than three points give zero; coordinates beyond about 1e150 overflow to a
/// non-finite vector ([`face_normal`](crate::normal::face_normal) does not).
#[must_use]
pub fn newell_normal(points: &[DVec3]) -> DVec3 {
    let Some((&first, rest)) = points.split_first() else {
        return DVec3::ZERO;
    };
    let mut sum = DVec3::ZERO;
    for pair in rest.windows(2) {
        sum += (pair[0] - first).cross(pair[1] - first);
    }
    sum
}

/// An area vector of points multiplied by some power of two, and a bound of its error.
pub(crate) struct AreaVector {
    pub(crate) vector: DVec3,
    /// For each component, the largest error that rounding can have caused.
    pub(crate) error: DVec3,
}

impl AreaVector {
    /// Whether the direction is more than rounding noise.
    pub(crate) fn is_significant(&self) -> bool {
        self.vector.abs().cmpgt(self.error).any()
    }
}

/// [`newell_normal`] of the points times `factor`, a power of two from [`range_factor`].
///
/// Each summand takes at most four roundings (difference, product, difference, and the
/// running sum's first), each further addition one: with `n` points the error is below
/// `gamma(n + 4)` times the sum of the absolute products.
#[inline]
pub(crate) fn area_vector(points: &[DVec3], factor: f64) -> AreaVector {
    let first = points.first().map_or(DVec3::ZERO, |&p| p * factor);
    let mut vector = DVec3::ZERO;
    let mut magnitude = DVec3::ZERO;
    for pair in points.get(1..).unwrap_or_default().windows(2) {
        let (a, b) = (pair[0] * factor - first, pair[1] * factor - first);
        vector += a.cross(b);
        let (a, b) = (a.abs(), b.abs());
        magnitude += DVec3::new(
            a.y * b.z + a.z * b.y,
            a.z * b.x + a.x * b.z,
            a.x * b.y + a.y * b.x,
        );
    }
    let error = magnitude * gamma_of_len(points.len().saturating_add(4));
    AreaVector { vector, error }
}

/// The power of two by which coordinates must be multiplied so that their products neither
/// overflow nor vanish; 1 for all but extreme coordinates. `None` if one is not finite.
#[inline]
pub(crate) fn range_factor(points: &[DVec3]) -> Option<f64> {
    const PLAIN: std::ops::RangeInclusive<f64> = 1e-60..=1e60;
    // The bits of positive numbers are in order of size, with infinity and NaNs above all.
    let mut top = 0;
    for p in points {
        let [x, y, z] = p.abs().to_array().map(f64::to_bits);
        top = top.max(x).max(y).max(z);
    }
    let max = f64::from_bits(top);
    let finite = max.is_finite();
    let factor = if max == 0.0 || PLAIN.contains(&max) {
        1.0
    } else {
        pow2(-exponent(max))
    };
    finite.then_some(factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(offset: DVec3, edge: f64) -> Vec<DVec3> {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
            .map(|(x, y)| offset + DVec3::new(x, y, 0.0) * edge)
            .to_vec()
    }

    #[test]
    fn area_vector_of_loops() {
        let far = DVec3::new(2_600_000.0, 1_200_000.0, 400.0);
        let mut reversed = square(DVec3::ZERO, 1.0);
        reversed.reverse();
        let concave = [(0., 0.), (2., 0.), (2., 2.), (1., 0.5), (0., 2.)]
            .map(|(y, z)| DVec3::new(7.0, y, z))
            .to_vec();
        for (points, expected) in [
            (vec![], DVec3::ZERO),
            (vec![DVec3::ONE], DVec3::ZERO),
            (vec![DVec3::ONE, DVec3::ZERO], DVec3::ZERO),
            (square(DVec3::ZERO, 1.0), 2.0 * DVec3::Z),
            (square(far, 0.5), 0.5 * DVec3::Z),
            (reversed, -2.0 * DVec3::Z),
            (concave, 5.0 * DVec3::X),
        ] {
            assert_eq!(newell_normal(&points), expected, "{points:?}");
            let area = area_vector(&points, 1.0);
            assert_eq!(area.vector, expected, "{points:?}");
            assert_eq!(area.is_significant(), expected != DVec3::ZERO);
        }
    }

    #[test]
    fn noise_is_not_significant() {
        // Multiples of a direction that f64 cannot hold exactly.
        let line: Vec<DVec3> = (0..50)
            .map(|i| DVec3::new(0.1, 0.7, 0.3) * f64::from((i * 7) % 50))
            .collect();
        let area = area_vector(&line, 1.0);
        assert!(
            area.vector != DVec3::ZERO,
            "the case must have noise to be one"
        );
        assert!(!area.is_significant(), "{:?}", area.vector);
    }

    #[test]
    fn range_factor_is_one_unless_needed() {
        for (x, expected) in [
            (0.0, Some(1.0)),
            (1e6, Some(1.0)),
            (f64::NAN, None),
            (f64::NEG_INFINITY, None),
        ] {
            assert_eq!(range_factor(&[DVec3::new(0.0, x, 0.0)]), expected, "{x}");
        }
        for x in [1e-200, 1e200, f64::MAX, 1e-300] {
            let scaled = range_factor(&[DVec3::new(0.0, x, 0.0)]).unwrap() * x;
            assert!((1.0..4.0).contains(&scaled), "{x:e}");
        }
    }
}
