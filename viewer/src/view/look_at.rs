//! A view by eye, point looked at and field of view, as users type it. Up is +Z, as in Lexolights.

use std::fmt;

use glam::{DQuat, DVec3};

use super::{Lens, TAN_RANGE, View, direction, looking};

/// Sine of the angle to the vertical below which a direction counts as vertical: the horizontal
/// part of a direction between points that are typed with ten digits is then noise.
const VERTICAL_SINE: f64 = 1e-9;

impl View {
    /// From `eye` towards `look_at`, with +Z up; a view straight down or up has +Y at the top.
    /// `None` if the points are equal or not finite, or `fovy_deg` is not between 0 and 180.
    #[must_use]
    pub fn look_at(eye: DVec3, look_at: DVec3, fovy_deg: f64) -> Option<Self> {
        if !(eye.is_finite() && fovy_deg > 0.0 && fovy_deg < 180.0) {
            return None;
        }
        Some(Self {
            eye,
            orientation: upright(look_at - eye)?,
            lens: Lens::Perspective {
                tan_half_height: (fovy_deg * 0.5)
                    .to_radians()
                    .tan()
                    .clamp(TAN_RANGE.0, TAN_RANGE.1),
            },
        })
    }
}

/// The orientation of a view along `forward` with +Z up, or +Y where +Z is the direction itself.
/// `None` if `forward` is zero or not finite.
pub(crate) fn upright(forward: DVec3) -> Option<DQuat> {
    let forward = direction(forward)?;
    let is_vertical = forward.truncate().length() < VERTICAL_SINE;
    looking(forward, if is_vertical { DVec3::Y } else { DVec3::Z })
}

/// Why a text is not a view.
#[derive(Clone, Debug, PartialEq)]
pub enum LookAtError {
    /// Another count of numbers than seven.
    Count(usize),
    /// A word that is no finite number.
    NotANumber(String),
    /// Eye and point looked at are equal, or too far apart for f64.
    NoDirection,
    /// The field of view, which is not between 0 and 180 degrees.
    FieldOfView(f64),
}

impl fmt::Display for LookAtError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count(n) => write!(
                f,
                "a view is 7 numbers, not {n}: eye `x y z`, point looked at `x y z`, vertical field of view in degrees"
            ),
            Self::NotANumber(word) => write!(f, "`{word}` is not a number"),
            Self::NoDirection => write!(f, "the eye and the point looked at are the same"),
            Self::FieldOfView(degrees) => write!(
                f,
                "a field of view of {degrees} degrees is not between 0 and 180"
            ),
        }
    }
}

impl std::error::Error for LookAtError {}

/// Reads `x y z  x y z  fovy_degrees`: the eye, the point looked at, the vertical field of view.
/// Numbers are separated by blanks or commas.
///
/// # Errors
///
/// [`LookAtError`] says which number is wrong.
pub fn parse_look_at(text: &str) -> Result<View, LookAtError> {
    let words = text
        .split(|c: char| c.is_whitespace() || c == ',')
        .filter(|word| !word.is_empty());
    let mut numbers = [0.0; 7];
    let mut count = 0;
    for word in words {
        let number = finite(word).ok_or_else(|| LookAtError::NotANumber(word.to_owned()))?;
        if let Some(place) = numbers.get_mut(count) {
            *place = number;
        }
        count += 1;
    }
    if count != numbers.len() {
        return Err(LookAtError::Count(count));
    }
    let [ex, ey, ez, x, y, z, fovy_deg] = numbers;
    if !(fovy_deg > 0.0 && fovy_deg < 180.0) {
        return Err(LookAtError::FieldOfView(fovy_deg));
    }
    View::look_at(DVec3::new(ex, ey, ez), DVec3::new(x, y, z), fovy_deg)
        .ok_or(LookAtError::NoDirection)
}

/// A finite number; Rust's own names for infinities are refused.
pub(super) fn finite(word: &str) -> Option<f64> {
    word.parse::<f64>().ok().filter(|x| x.is_finite())
}

#[cfg(test)]
mod tests {
    use super::super::tests::{near, v};
    use super::*;

    #[test]
    fn reads_views() {
        // Text, eye, forward, up, tan of half the field of view.
        let rows = [
            (
                "0 -5 0  0 0 0  90",
                v(0.0, -5.0, 0.0),
                DVec3::Y,
                DVec3::Z,
                1.0,
            ),
            (
                "5,0,2,4,0,2,90",
                v(5.0, 0.0, 2.0),
                DVec3::NEG_X,
                DVec3::Z,
                1.0,
            ),
            (
                " 0 0 9 \n 0 0 1e0 90 ",
                v(0.0, 0.0, 9.0),
                DVec3::NEG_Z,
                DVec3::Y,
                1.0,
            ),
            (
                "0 0 -9 0 0 0 90",
                v(0.0, 0.0, -9.0),
                DVec3::Z,
                DVec3::Y,
                1.0,
            ),
            (
                "2600000.25 1200000 400 2600000.25 1200003 404 53.13010235415598",
                v(2_600_000.25, 1_200_000.0, 400.0),
                v(0.0, 0.6, 0.8),
                v(0.0, -0.8, 0.6),
                0.5,
            ),
        ];
        for (text, eye, forward, up, tan) in rows {
            let view = parse_look_at(text).unwrap();
            assert_eq!(view.eye, eye, "{text}");
            assert!(near(view.forward(), forward, 1e-15), "{text}");
            assert!(near(view.up(), up, 1e-15), "{text}");
            let Lens::Perspective { tan_half_height } = view.lens else {
                panic!("{text}: not a perspective view");
            };
            assert!((tan_half_height - tan).abs() < 1e-14, "{text}");
        }
    }

    #[test]
    fn extreme_fields_of_view_stay_in_range() {
        for (text, tan) in [
            ("0 0 5 0 0 0 4e-324", TAN_RANGE.0),
            ("0 0 5 0 0 0 179.9999999", TAN_RANGE.1),
        ] {
            let Lens::Perspective { tan_half_height } = parse_look_at(text).unwrap().lens else {
                panic!("{text}: not a perspective view");
            };
            assert_eq!(tan_half_height, tan, "{text}");
        }
    }

    #[test]
    fn says_what_is_wrong() {
        let rows = [
            ("", LookAtError::Count(0)),
            ("0 0 5 0 0 0", LookAtError::Count(6)),
            ("0 0 5 0 0 0 45 1", LookAtError::Count(8)),
            (
                "0 0 5 0 0 zero 45",
                LookAtError::NotANumber("zero".to_owned()),
            ),
            (
                "0 0 inf 0 0 0 45",
                LookAtError::NotANumber("inf".to_owned()),
            ),
            ("1 2 3 1 2 3 45", LookAtError::NoDirection),
            ("1e308 0 0 -1e308 0 0 45", LookAtError::NoDirection),
            ("0 0 5 0 0 0 180", LookAtError::FieldOfView(180.0)),
            ("0 0 5 0 0 0 0", LookAtError::FieldOfView(0.0)),
        ];
        for (text, expected) in rows {
            assert_eq!(parse_look_at(text), Err(expected), "{text}");
        }
    }
}
