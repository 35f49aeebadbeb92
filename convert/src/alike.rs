//! Whether a value is still what it was, after other tools had it in f32.

/// Values that went through linear light, a quotient and f32. Half a step of 8-bit colours is a
/// hundred times as much.
const TOLERANCE: f64 = 2e-5;

/// Of shares, 0 to 1.
pub(crate) fn alike(a: f64, b: f64) -> bool {
    (a - b).abs() <= TOLERANCE
}

/// As [`alike`], of colours and the like.
pub(crate) fn all_alike(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| alike(*a, *b))
}

/// Of lengths, strengths and angles, whatever their unit.
pub(crate) fn alike_in_size(a: f64, b: f64) -> bool {
    (a - b).abs() <= TOLERANCE * a.abs().max(b.abs())
}
