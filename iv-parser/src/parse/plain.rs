//! The hot loops: runs of plain numbers.
//!
//! A plain number has digits, perhaps a sign and a point, and no more digits than are exact; all
//! else (exponents, octal, hexadecimal, comments, errors, the last bytes of the text) ends the
//! loop and is left to the grammar in `numbers`, which then comes back here. Digits are read eight
//! at a time.

use crate::lex::{is_blank, skip_indent};
use crate::number::{POWERS_OF_TEN, byte};

/// Where a loop stopped.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop {
    /// At the first byte that is not part of the run.
    pub at: usize,
    /// Behind the last number, if there was one.
    pub end: Option<usize>,
    /// Whether a comma has been passed since.
    pub comma: bool,
}

/// Powers of ten by which up to eight digits move up.
const SHIFTS: [u64; 9] = [
    1,
    10,
    100,
    1000,
    10_000,
    100_000,
    1_000_000,
    10_000_000,
    100_000_000,
];

/// The value and the number of the digits at `at`, eight at most; `None` within eight bytes of
/// the end.
///
/// Each byte less `0` is a digit if it is below ten. Digits are moved to the word's end, so that
/// zeros stand before them; then neighbours are joined three times: pairs, fours, eight.
#[inline(always)]
fn eight_digits(bytes: &[u8], at: usize) -> Option<(u64, usize)> {
    let chunk: [u8; 8] = *bytes.get(at..)?.first_chunk()?;
    let values = u64::from_le_bytes(chunk) ^ 0x3030_3030_3030_3030;
    let above_nine = (values.wrapping_add(0x0606_0606_0606_0606) | values) & 0xf0f0_f0f0_f0f0_f0f0;
    let count = (above_nine.trailing_zeros() / 8) as usize;
    if count == 0 {
        return Some((0, 0));
    }
    let v = values << (64 - 8 * count);
    let v = v.wrapping_mul(10).wrapping_add(v >> 8) & 0x00ff_00ff_00ff_00ff;
    let v = v.wrapping_mul(100).wrapping_add(v >> 16) & 0x0000_ffff_0000_ffff;
    let v = v.wrapping_mul(10_000).wrapping_add(v >> 32) & 0xffff_ffff;
    Some((v, count))
}

/// The position of the next token, past blanks and at most one comma.
#[inline(always)]
fn next_token(bytes: &[u8], stop: &mut Stop, commas: bool) -> u8 {
    loop {
        let b = byte(bytes, stop.at);
        if b > b',' {
            return b;
        } else if b == b'\n' {
            stop.at = skip_indent(bytes, stop.at + 1);
        } else if is_blank(b) {
            stop.at += 1;
        } else if b == b',' && commas && !stop.comma {
            stop.comma = true;
            stop.at += 1;
        } else {
            return b;
        }
    }
}

/// Reads integers of at most seven digits.
pub(super) fn ints(bytes: &[u8], mut stop: Stop, commas: bool, out: &mut Vec<i32>) -> Stop {
    loop {
        let b = next_token(bytes, &mut stop, commas);
        let negative = b == b'-';
        let start = stop.at + usize::from(negative);
        let Some((magnitude, count)) = eight_digits(bytes, start) else {
            return stop;
        };
        let end = start + count;
        let leading_zero = count > 1 && byte(bytes, start) == b'0';
        let more = matches!(byte(bytes, end), b'.' | b'e' | b'E' | b'x' | b'X');
        if count == 0 || count == 8 || leading_zero || more {
            return stop;
        }
        let value = magnitude as i32;
        out.push(if negative { -value } else { value });
        stop = Stop {
            at: end,
            end: Some(end),
            comma: false,
        };
    }
}

/// Reads numbers of at most seven digits before and seven behind the point: all together they are
/// exact in f64, and one division then rounds correctly (Clinger's fast path).
pub(super) fn floats(bytes: &[u8], mut stop: Stop, commas: bool, out: &mut Vec<f64>) -> Stop {
    loop {
        let b = next_token(bytes, &mut stop, commas);
        let negative = b == b'-';
        let start = stop.at + usize::from(negative);
        let Some((whole, whole_count)) = eight_digits(bytes, start) else {
            return stop;
        };
        let mut end = start + whole_count;
        let mut magnitude = whole as f64;
        let mut count = whole_count;
        if byte(bytes, end) == b'.' {
            let Some((part, part_count)) = eight_digits(bytes, end + 1) else {
                return stop;
            };
            if part_count == 8 {
                return stop;
            }
            end += 1 + part_count;
            count += part_count;
            let mantissa = whole * SHIFTS[part_count] + part;
            magnitude = mantissa as f64 / POWERS_OF_TEN[part_count];
        } else if whole_count > 1 && byte(bytes, start) == b'0' {
            return stop;
        }
        let more = matches!(byte(bytes, end), b'e' | b'E' | b'x' | b'X' | b'#');
        if count == 0 || whole_count == 8 || more {
            return stop;
        }
        // `-0` without a point is the integer 0.
        let is_whole = end == start + whole_count;
        out.push(match negative {
            true if is_whole => 0.0 - magnitude,
            true => -magnitude,
            false => magnitude,
        });
        stop = Stop {
            at: end,
            end: Some(end),
            comma: false,
        };
    }
}
