//! Floats of 32 bits, and whether a number is still the same in one.

use crate::binary::numbers::decimal;
use crate::diagnostic::Severity;
use crate::source::{Problem, Span};

/// What rounding has done so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rounding {
    /// The largest error, and the field it is in.
    largest: f64,
    largest_at: Span,
    /// A number does not come back with the digits it had.
    is_lost: bool,
}

impl Rounding {
    /// Appends numbers as floats of 32 bits.
    pub(super) fn put(&mut self, values: &[f64], span: Span, out: &mut Vec<u8>) {
        out.reserve(4 * values.len());
        for &value in values {
            // Text may say 1e40; what is not finite no reader takes.
            let stored = (value as f32).clamp(-f32::MAX, f32::MAX);
            out.extend_from_slice(&stored.to_be_bytes());
            if decimal(stored) == value {
                continue;
            }
            let error = (f64::from(stored) - value).abs();
            if error > 0.0 {
                self.is_lost = self.is_lost || !survives(value, stored);
                if error > self.largest {
                    (self.largest, self.largest_at) = (error, span);
                }
            }
        }
    }

    /// What to tell about it, once for all.
    pub(super) fn problem(&self) -> Option<Problem> {
        self.is_lost.then(|| Problem {
            severity: Severity::Warning,
            code: "rounded",
            message: format!(
                "numbers have more digits than the 32 bits of a binary file keep; the largest \
                 error is {:.1e}",
                self.largest
            ),
            hint: "write the model as text to keep all digits".to_owned(),
            span: self.largest_at,
        })
    }
}

/// Whether the digits of `value` can be told from what is stored: rounded to as many, it has them.
fn survives(value: f64, stored: f32) -> bool {
    let text = format!("{value:e}");
    let mantissa = text.split('e').next().unwrap_or_default();
    let digits = mantissa.bytes().filter(u8::is_ascii_digit).count();
    format!("{:.*e}", digits - 1, f64::from(stored)) == text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loss_is_told_only_of_digits_that_do_not_come_back() {
        for (value, is_lost) in [
            (0.1, false),
            (0.7312345, false),
            (0.100000001, false),
            (0.100_000_001_490_116_12, false),
            (1e9, false),
            (16_777_217.0, true),
            (2_600_123.5, false),
            (2_600_123.456, true),
            (0.707_312_34, true),
            (1e40, true),
        ] {
            let mut rounding = Rounding::default();
            let mut out = Vec::new();
            rounding.put(&[1.0, value, -value], Span::new(3, 7), &mut out);
            let told = rounding.problem();
            assert_eq!(told.is_some(), is_lost, "{value}");
            assert_eq!(out.len(), 12);
            assert!(told.is_none_or(|told| told.span == Span::new(3, 7)));
        }
    }
}
