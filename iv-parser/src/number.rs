//! One number: Inventor's grammar, correctly rounded to f64.
//!
//! Integers are decimal, octal (`010`) or hexadecimal (`0xff`); which of octal and decimal a token
//! with a leading zero is depends on the field's type, which is not known here: such tokens are
//! read as decimal and marked.

/// A number token.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// No point, no exponent, fits 32 bits signed.
    Int(i32),
    /// All others.
    Float(f64),
}

/// What is notable about a token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remark {
    /// Nothing.
    None,
    /// Decimal digits behind a leading zero: octal if the field holds integers.
    Octal,
    /// `1.#QNAN` and its kin, read as 0.
    NotANumber,
    /// Beyond f32, as `1e40`; kept at the largest f32.
    Overflow,
    /// `1e` without digits; the mantissa was taken.
    NoExponent,
}

pub(crate) const POWERS_OF_TEN: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Largest magnitude a field holds: the largest f32.
const LARGEST: f64 = f32::MAX as f64;

#[inline(always)]
pub(crate) fn byte(bytes: &[u8], at: usize) -> u8 {
    bytes.get(at).copied().unwrap_or(0)
}

#[inline(always)]
fn digits(bytes: &[u8], mut at: usize, mantissa: &mut u64) -> usize {
    loop {
        let d = byte(bytes, at).wrapping_sub(b'0');
        if d > 9 {
            return at;
        }
        *mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(d));
        at += 1;
    }
}

/// The number at `at`, the position after it, and a remark; `None` if there is none.
pub fn number(bytes: &[u8], start: usize) -> Option<(Number, usize, Remark)> {
    let sign = byte(bytes, start);
    let negative = sign == b'-';
    let at = start + usize::from(negative || sign == b'+');
    let mut mantissa = 0;
    let whole_end = digits(bytes, at, &mut mantissa);
    let whole = whole_end - at;
    let next = byte(bytes, whole_end);
    if next != b'.' && next != b'e' && next != b'E' {
        if whole == 0 {
            return None;
        }
        if whole <= 9 && (next | 0x20) != b'x' {
            let magnitude = mantissa as i32;
            let remark = if whole > 1 && byte(bytes, at) == b'0' {
                Remark::Octal
            } else {
                Remark::None
            };
            let value = if negative { -magnitude } else { magnitude };
            return Some((Number::Int(value), whole_end, remark));
        }
        return long_integer(bytes, start, at, whole_end, negative);
    }
    let mut end = whole_end;
    let mut fraction = 0;
    if next == b'.' {
        end = digits(bytes, whole_end + 1, &mut mantissa);
        fraction = end - whole_end - 1;
    }
    if whole + fraction == 0 {
        return None;
    }
    let mut exponent = 0i32;
    let mut remark = Remark::None;
    if (byte(bytes, end) | 0x20) == b'e' {
        match exponent_part(bytes, end) {
            Some((value, after)) => {
                exponent = value;
                end = after;
            }
            None => {
                return Some((
                    Number::Float(exact(bytes, start, end)),
                    end + 1,
                    Remark::NoExponent,
                ));
            }
        }
    } else if fraction == 0
        && byte(bytes, end) == b'#'
        && let Some(after) = windows_nan(bytes, end)
    {
        return Some((Number::Float(0.0), after, Remark::NotANumber));
    }
    let scale = exponent - fraction as i32;
    // Clinger's fast path: mantissa and power of ten are exact, so one rounding gives the result.
    let value = if whole + fraction <= 19 && mantissa <= 1 << 53 && (-22..=22).contains(&scale) {
        let m = mantissa as f64;
        let power = POWERS_OF_TEN[scale.unsigned_abs() as usize];
        let magnitude = if scale < 0 { m / power } else { m * power };
        if negative { -magnitude } else { magnitude }
    } else {
        exact(bytes, start, end)
    };
    let value = if value.abs() > LARGEST {
        remark = Remark::Overflow;
        LARGEST.copysign(value)
    } else {
        value
    };
    Some((Number::Float(value), end, remark))
}

#[cold]
fn exact(bytes: &[u8], start: usize, end: usize) -> f64 {
    let token = &bytes[start..end];
    let token = token.strip_prefix(b"+").unwrap_or(token);
    fast_float2::parse::<f64, _>(token).unwrap_or(0.0)
}

/// `e`, a sign, digits. The value saturates far beyond any float's range.
fn exponent_part(bytes: &[u8], at: usize) -> Option<(i32, usize)> {
    let sign = byte(bytes, at + 1);
    let mut i = at + 1 + usize::from(sign == b'-' || sign == b'+');
    let first = i;
    let mut value = 0i32;
    while byte(bytes, i).is_ascii_digit() {
        value = (value * 10 + i32::from(bytes[i] - b'0')).min(99_999);
        i += 1;
    }
    (i > first).then_some((if sign == b'-' { -value } else { value }, i))
}

/// Visual C's texts for NaN and infinity: `1.#QNAN`, `-1.#IND00`, `1.#INF`.
fn windows_nan(bytes: &[u8], at: usize) -> Option<usize> {
    let names: [&[u8]; 4] = [b"#QNAN", b"#SNAN", b"#IND", b"#INF"];
    let name = names.iter().find(|n| bytes[at..].starts_with(n))?;
    let tail = &bytes[at + name.len()..];
    let zeros = tail.iter().take_while(|b| b.is_ascii_digit()).count();
    // `1.#INFORMATION` is a number and a comment.
    let ends = tail.get(zeros).is_none_or(|b| !b.is_ascii_alphanumeric());
    ends.then_some(at + name.len() + zeros)
}

#[cold]
fn long_integer(
    bytes: &[u8],
    start: usize,
    at: usize,
    end: usize,
    negative: bool,
) -> Option<(Number, usize, Remark)> {
    if byte(bytes, end) | 0x20 == b'x' && end == at + 1 && bytes[at] == b'0' {
        let digits = &bytes[end + 1..];
        let count = digits.iter().take_while(|b| b.is_ascii_hexdigit()).count();
        if count > 0 {
            let value = digits[..count].iter().fold(0u64, |v, &b| {
                v.wrapping_mul(16) + u64::from(char::from(b).to_digit(16).unwrap_or(0))
            }) & 0xffff_ffff;
            let value = if negative {
                -(value as f64)
            } else {
                value as f64
            };
            let number = if value <= f64::from(i32::MAX) && value >= f64::from(i32::MIN) {
                Number::Int(value as i32)
            } else {
                Number::Float(value)
            };
            return Some((number, end + 1 + count, Remark::None));
        }
    }
    if end - at <= 9 {
        let mut magnitude = 0;
        digits(bytes, at, &mut magnitude);
        let value = if negative {
            -(magnitude as i32)
        } else {
            magnitude as i32
        };
        return Some((Number::Int(value), end, Remark::None));
    }
    let value = exact(bytes, start, end);
    let remark = if bytes[at] == b'0' {
        Remark::Octal
    } else {
        Remark::None
    };
    if value >= f64::from(i32::MIN) && value <= f64::from(i32::MAX) {
        return Some((Number::Int(value as i32), end, remark));
    }
    if value.abs() > LARGEST {
        return Some((
            Number::Float(LARGEST.copysign(value)),
            end,
            Remark::Overflow,
        ));
    }
    Some((Number::Float(value), end, remark))
}

/// An integer token read by C's rules, where a leading zero means octal.
pub fn octal_aware(token: &[u8]) -> i64 {
    let (negative, digits) = match token {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        all => (false, all),
    };
    let base = match digits {
        [b'0', b'x' | b'X', ..] => 16,
        [b'0', _, ..] => 8,
        _ => 10,
    };
    let digits = if base == 16 { &digits[2..] } else { digits };
    let value = digits
        .iter()
        .map_while(|&b| char::from(b).to_digit(base))
        .fold(0i64, |v, d| {
            v.wrapping_mul(i64::from(base)).wrapping_add(i64::from(d))
        });
    if negative {
        value.wrapping_neg()
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The standard library's parser is the judge of rounding.
    #[test]
    fn rounds_like_the_standard_library() {
        let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
        let mut random = || {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            seed
        };
        for i in 0..200_000 {
            let bits = random();
            let text = match i % 4 {
                0 => format!("{}", f32::from_bits(bits as u32)),
                1 => format!("{:.6}", (bits >> 20) as f64 / 1e6),
                2 => format!("{:e}", f64::from_bits(bits) % 1e30),
                _ => format!("{}.{}", bits % 10_000_000, random()),
            };
            let expected: f64 = text.parse().unwrap();
            if !expected.is_finite() || expected.abs() > LARGEST {
                continue;
            }
            let Some((found, end, _)) = number(text.as_bytes(), 0) else {
                panic!("{text}");
            };
            let found = match found {
                Number::Int(v) => f64::from(v),
                Number::Float(v) => v,
            };
            assert_eq!(end, text.len(), "{text}");
            assert_eq!(found.to_bits(), expected.to_bits(), "{text}");
        }
    }

    #[test]
    fn tokens() {
        use Remark as R;
        let rows = [
            ("12", Some((Number::Int(12), 2, R::None))),
            ("-0", Some((Number::Int(0), 2, R::None))),
            ("010", Some((Number::Int(10), 3, R::Octal))),
            ("0x1Fg", Some((Number::Int(31), 4, R::None))),
            (
                "2147483648",
                Some((Number::Float(2_147_483_648.0), 10, R::None)),
            ),
            ("1.5.5", Some((Number::Float(1.5), 3, R::None))),
            ("1.#IND00 ", Some((Number::Float(0.0), 8, R::NotANumber))),
            ("1.#INFORM", Some((Number::Float(1.0), 2, R::None))),
            ("1e+", Some((Number::Float(1.0), 2, R::NoExponent))),
            ("-1e999", Some((Number::Float(-LARGEST), 6, R::Overflow))),
            ("-", None),
            (".", None),
            (".e1", None),
            ("", None),
        ];
        for (text, expected) in rows {
            assert_eq!(number(text.as_bytes(), 0), expected, "{text}");
        }
        assert_eq!(octal_aware(b"010"), 8);
        assert_eq!(octal_aware(b"-0x10"), -16);
        assert_eq!(octal_aware(b"10"), 10);
    }
}
