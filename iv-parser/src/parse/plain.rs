//! The hot loops: runs of plain numbers.
//!
//! A plain number has digits, perhaps a sign and a point, and no more digits than are exact; all
//! else (exponents, octal, hexadecimal, comments, errors) ends the loop and is left to the
//! grammar in `numbers`, which then comes back here.

use crate::lex::{is_blank, skip_indent};
use crate::number::{POWERS_OF_TEN, byte, digits};

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

/// The position of the next token, past blanks and at most one comma.
#[inline(always)]
fn next_token(bytes: &[u8], stop: &mut Stop, commas: bool) -> u8 {
    loop {
        let b = byte(bytes, stop.at);
        if b == b'\n' {
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

/// Reads integers of at most nine digits.
pub(super) fn ints(bytes: &[u8], mut stop: Stop, commas: bool, out: &mut Vec<i32>) -> Stop {
    loop {
        let b = next_token(bytes, &mut stop, commas);
        let negative = b == b'-';
        let start = stop.at + usize::from(negative);
        let mut magnitude = 0;
        let end = digits(bytes, start, &mut magnitude);
        let count = end - start;
        let leading_zero = count > 1 && byte(bytes, start) == b'0';
        let more = matches!(byte(bytes, end), b'.' | b'e' | b'E' | b'x' | b'X');
        if count == 0 || count > 9 || leading_zero || more {
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

/// Reads numbers whose digits, taken together, are exact in f64: one division then rounds
/// correctly (Clinger's fast path).
pub(super) fn floats(bytes: &[u8], mut stop: Stop, commas: bool, out: &mut Vec<f64>) -> Stop {
    loop {
        let b = next_token(bytes, &mut stop, commas);
        let negative = b == b'-';
        let start = stop.at + usize::from(negative);
        let mut mantissa = 0;
        let whole_end = digits(bytes, start, &mut mantissa);
        let mut end = whole_end;
        let mut fraction = 0;
        if byte(bytes, whole_end) == b'.' {
            end = digits(bytes, whole_end + 1, &mut mantissa);
            fraction = end - whole_end - 1;
        } else if whole_end - start > 1 && byte(bytes, start) == b'0' {
            return stop;
        }
        let count = whole_end - start + fraction;
        let more = matches!(byte(bytes, end), b'e' | b'E' | b'x' | b'X' | b'#');
        if count == 0 || count > 19 || mantissa > 1 << 53 || more {
            return stop;
        }
        let magnitude = mantissa as f64 / POWERS_OF_TEN[fraction];
        out.push(if negative { -magnitude } else { magnitude });
        stop = Stop {
            at: end,
            end: Some(end),
            comma: false,
        };
    }
}
