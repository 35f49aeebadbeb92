//! Rounding bounds and exact powers of two: the source of every tolerance in this crate.
//! Not a general maths library.

use glam::DVec3;

/// The largest relative error of one `f64` rounding, 2^-53.
pub const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// The relative error bound of `n` roundings in a row: `n*u / (1 - n*u)` with
/// `u = UNIT_ROUNDOFF`.
///
/// Source: Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., lemma 3.1;
/// the same function as `gamma` of Pharr, Jakob and Humphreys, *Physically Based
/// Rendering*, section 6.8 (errors of ray intersections).
#[must_use]
pub const fn gamma(n: u32) -> f64 {
    let nu = n as f64 * UNIT_ROUNDOFF;
    nu / (1.0 - nu)
}

/// [`gamma`] for a count that is a length; a count beyond `u32` is taken as `u32::MAX`.
pub(crate) fn gamma_of_len(n: usize) -> f64 {
    gamma(u32::try_from(n).unwrap_or(u32::MAX))
}

/// `floor(log2(|x|))` of a finite `x`, exactly, subnormals included; 0 for `x == 0`.
pub(crate) fn exponent(x: f64) -> i32 {
    const SUBNORMAL_LIFT: i32 = 64;
    if x == 0.0 {
        return 0;
    }
    let biased = |v: f64| ((v.to_bits() >> 52) & 0x7ff) as i32;
    match biased(x) {
        0 => biased(x * pow2(SUBNORMAL_LIFT)) - 1023 - SUBNORMAL_LIFT,
        e => e - 1023,
    }
}

/// 2^e; `e` is clamped to the exponents of normal numbers.
pub(crate) fn pow2(e: i32) -> f64 {
    f64::from_bits(((e.clamp(-1022, 1023) + 1023) as u64) << 52)
}

/// `x * 2^e`, exact unless the result overflows or is subnormal.
pub(crate) fn scale_pow2(x: f64, e: i32) -> f64 {
    // Three factors span the whole range from the smallest subnormal to the largest number.
    let e = e.clamp(-3000, 3000);
    let first = e / 3;
    let second = (e - first) / 2;
    x * pow2(first) * pow2(second) * pow2(e - first - second)
}

/// [`scale_pow2`] of each component.
pub(crate) fn scale_pow2_vec(v: DVec3, e: i32) -> DVec3 {
    DVec3::new(scale_pow2(v.x, e), scale_pow2(v.y, e), scale_pow2(v.z, e))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gamma_bounds_repeated_rounding() {
        for n in [1_u32, 10, 1000] {
            // Adding 0.1 rounds once per step; the exact sum is n * (the f64 nearest 0.1).
            let sum = (0..n).fold(0.0_f64, |sum, _| sum + 0.1);
            let exact_times_2_55 = i128::from(n) * 3_602_879_701_896_397;
            let sum_times_2_55 = (sum * 2.0_f64.powi(55)) as i128;
            let error = (sum_times_2_55 - exact_times_2_55).unsigned_abs() as f64;
            assert!(error <= gamma(n) * exact_times_2_55 as f64, "n = {n}");
        }
        assert!(gamma(1) >= UNIT_ROUNDOFF && gamma(1) < 1.001 * UNIT_ROUNDOFF);
        assert!(gamma(u32::MAX) < 1e-6);
    }

    #[test]
    fn exponent_is_floor_of_log2() {
        for (x, expected) in [
            (1.0, 0),
            (-1.99, 0),
            (2.0, 1),
            (0.75, -1),
            (f64::MAX, 1023),
            (f64::MIN_POSITIVE, -1022),
            (5e-324, -1074),
            (0.0, 0),
        ] {
            assert_eq!(exponent(x), expected, "{x:e}");
        }
    }

    #[test]
    fn scaling_by_powers_of_two_is_exact() {
        for (x, e, expected) in [
            (3.0, 4, 48.0),
            (-5.0, -1, -2.5),
            (5e-324, 1074, 1.0),
            (1.0, -1074, 5e-324),
            (f64::MAX, -1023, f64::MAX / 2.0 / 2.0_f64.powi(1022)),
            (1.0, i32::MAX, f64::INFINITY),
            (1.0, i32::MIN, 0.0),
        ] {
            assert_eq!(scale_pow2(x, e), expected, "{x:e} * 2^{e}");
        }
    }
}
