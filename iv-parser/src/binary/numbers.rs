//! Runs of big-endian numbers in bulk.

/// Number of 32-bit floats that binary exponents tell apart.
const EXPONENTS: usize = 256;

/// Largest power of ten that is exact in f64.
const LARGEST_EXACT: i32 = 22;

/// For one binary exponent, the power of ten that makes a number of six digits whole.
#[derive(Clone, Copy)]
struct Scale {
    /// Where the decade changes within the binade.
    decade: f64,
    /// Below it.
    below: f64,
    /// From it on.
    above: f64,
}

/// Scales by biased exponent. 0, which makes every quotient NaN, where six digits are out of reach.
static SCALES: [Scale; EXPONENTS] = scales();

const fn power_of_ten(exponent: i32) -> f64 {
    // Products of powers up to 10^22 are exact.
    let mut power = 1.0;
    let mut i = 0;
    while i < exponent {
        power *= 10.0;
        i += 1;
    }
    power
}

/// The scale for numbers of the decade `10^decade`.
const fn scale(decade: i32) -> f64 {
    let exponent = 5 - decade;
    if exponent > LARGEST_EXACT {
        0.0
    } else if exponent < 0 {
        1.0
    } else {
        power_of_ten(exponent)
    }
}

const fn scales() -> [Scale; EXPONENTS] {
    let none = Scale {
        decade: f64::INFINITY,
        below: 0.0,
        above: 0.0,
    };
    let mut scales = [none; EXPONENTS];
    // From 2^-56, about 1e-17, to 2^50: whole numbers beyond are exact anyway.
    let mut low = 1.0_f64 / (1_u64 << 56) as f64;
    let mut decade = -17;
    let mut exponent: i32 = -56;
    while exponent <= 50 {
        // `low` is in the decade or has just left it.
        let next = if decade + 1 >= 0 {
            power_of_ten(decade + 1)
        } else {
            1.0 / power_of_ten(-(decade + 1))
        };
        if next <= low {
            decade += 1;
            continue;
        }
        scales[(exponent + 127) as usize] = Scale {
            decade: next,
            below: scale(decade),
            above: scale(decade + 1),
        };
        low *= 2.0;
        exponent += 1;
    }
    scales
}

/// The number that a stored float stands for: the decimal of six significant digits that it is
/// nearest to, if it is the nearest float to that decimal, else its exact value.
///
/// Six digits are what every decimal keeps on its way through 32 bits (C's `FLT_DIG`), so that a
/// `0.1` written to a binary file is `0.1` again and not 0.10000000149. Either value is within
/// half a step of the other: all that 32 bits tell.
#[inline(always)]
pub fn decimal(stored: f32) -> f64 {
    // Adding and taking away 1.5 · 2^52 rounds to a whole number.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    let exact = f64::from(stored);
    let scales = &SCALES[((stored.to_bits() >> 23) & 0xff) as usize];
    let scale = if exact.abs() < scales.decade {
        scales.below
    } else {
        scales.above
    };
    // Both are exact in f64, so the quotient is the f64 nearest to the decimal.
    let decimal = ((exact * scale + ROUND) - ROUND) / scale;
    if (decimal as f32).to_bits() == stored.to_bits() {
        decimal
    } else {
        exact
    }
}

/// Appends floats of four bytes; true if some are not finite, which become 0.
pub fn floats(bytes: &[u8], out: &mut Vec<f64>) -> bool {
    let start = out.len();
    let (words, _) = bytes.as_chunks::<4>();
    let mut finite = true;
    out.extend(words.iter().map(|word| {
        let value = f32::from_be_bytes(*word);
        finite &= value.is_finite();
        decimal(value)
    }));
    end_not_finite(&mut out[start..], finite)
}

/// Appends floats of eight bytes; true if some are not finite, which become 0.
pub fn doubles(bytes: &[u8], out: &mut Vec<f64>) -> bool {
    let start = out.len();
    let (words, _) = bytes.as_chunks::<8>();
    out.extend(words.iter().map(|word| f64::from_be_bytes(*word)));
    let finite = out[start..].iter().all(|value| value.is_finite());
    end_not_finite(&mut out[start..], finite)
}

fn end_not_finite(values: &mut [f64], finite: bool) -> bool {
    if !finite {
        for value in values.iter_mut().filter(|value| !value.is_finite()) {
            *value = 0.0;
        }
    }
    !finite
}

/// Appends signed words.
pub fn ints(bytes: &[u8], out: &mut Vec<i32>) {
    let (words, _) = bytes.as_chunks::<4>();
    out.extend(words.iter().map(|word| i32::from_be_bytes(*word)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_digits_come_back_and_all_else_is_exact() {
        let decimals = [
            0.1,
            0.2,
            0.8,
            0.9,
            1.0,
            3.3,
            7.99999,
            8.00001,
            9.99999,
            10.0001,
            12.3456,
            99.9999,
            100.001,
            1023.99,
            1024.01,
            123_456.0,
            999_999.0,
            0.000_123_456,
            1e-9,
            9.876_54e-12,
            1.5e-16,
            0.0,
        ];
        for wanted in decimals.into_iter().flat_map(|v| [v, -v]) {
            assert_eq!(
                decimal(wanted as f32).to_bits(),
                f64::to_bits(wanted),
                "{wanted}"
            );
        }
        let exact = [
            0.707_312_34,
            2_600_000.2,
            1e7,
            16_777_217.0,
            3.4e38,
            1e-30,
            1e-44,
            1.234_567_8,
            f32::MIN_POSITIVE,
            f32::MAX,
        ];
        for stored in exact {
            assert_eq!(decimal(stored), f64::from(stored));
        }
    }

    /// Formatting with six digits is the oracle.
    #[test]
    fn agrees_with_printing_and_reading() {
        let mut state = 1_u32;
        for _ in 0..200_000 {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            // Exponents from 2^-50 to 2^25.
            let exponent = 77 + (state >> 3) % 75;
            let stored = f32::from_bits((state & 0x807f_ffff) | exponent << 23);
            let text: f64 = format!("{stored:.5e}").parse().unwrap();
            let wanted = if text as f32 == stored {
                text
            } else {
                stored.into()
            };
            assert_eq!(decimal(stored), wanted, "{stored:e}");
        }
    }

    #[test]
    fn what_is_not_finite_becomes_zero() {
        for (value, wanted) in [(f32::NAN, 0.0), (f32::INFINITY, 0.0), (1.5, 1.5)] {
            let mut out = vec![7.0];
            let bytes = [1.0_f32.to_be_bytes(), value.to_be_bytes()].concat();
            assert_eq!(floats(&bytes, &mut out), !value.is_finite());
            assert_eq!(out, [7.0, 1.0, wanted]);
        }
    }
}
