//! Lengths as the user writes them: `0.1mm`, `2in`, or a number in the model's own unit.

use std::str::FromStr;

use clap::ValueEnum;

/// A unit of length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Unit {
    /// Micrometres
    Um,
    /// Millimetres
    Mm,
    /// Centimetres
    Cm,
    /// Metres
    M,
    /// Kilometres
    Km,
    /// Inches, 25.4 mm
    In,
    /// Feet, 12 inches
    Ft,
}

impl Unit {
    /// How many metres it has.
    pub fn metres(self) -> f64 {
        match self {
            Self::Um => 1e-6,
            Self::Mm => 1e-3,
            Self::Cm => 1e-2,
            Self::M => 1.0,
            Self::Km => 1e3,
            Self::In => 0.0254,
            Self::Ft => 0.3048,
        }
    }

    fn of(name: &str) -> Option<Self> {
        <Self as ValueEnum>::from_str(name, true).ok()
    }
}

/// A length above 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Length {
    value: f64,
    /// `None`: the model's own.
    unit: Option<Unit>,
}

impl Length {
    /// In metres, if that is what the model's unit is `metres` of.
    pub fn metres(self, model_unit_metres: f64) -> f64 {
        self.value * self.unit.map_or(model_unit_metres, Unit::metres)
    }
}

impl FromStr for Length {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
        let name = &text[digits.len()..];
        let unit = Unit::of(name);
        let value: f64 = digits.trim_end().parse().unwrap_or(f64::NAN);
        if !(value > 0.0 && value.is_finite()) || (unit.is_none() && !name.is_empty()) {
            return Err(
                "it is a length above 0 such as 0.1mm; the units are um, mm, cm, m, km, in \
                 and ft, and without one it is in the model's own"
                    .to_owned(),
            );
        }
        Ok(Self { value, unit })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_with_and_without_units() {
        for (text, want) in [
            ("0.1mm", Some(1e-4)),
            ("0.1 MM", Some(1e-4)),
            ("2in", Some(0.0508)),
            ("1ft", Some(0.3048)),
            ("1e-3m", Some(1e-3)),
            ("3", Some(30.0)),
            ("1e1", Some(100.0)),
            ("5km", Some(5000.0)),
            ("7um", Some(7e-6)),
            ("0", None),
            ("-1mm", None),
            ("inf", None),
            ("nan", None),
            ("mm", None),
            ("1 yard", None),
            ("", None),
        ] {
            let got = text
                .parse::<Length>()
                .ok()
                .map(|length| length.metres(10.0));
            match (got, want) {
                (Some(got), Some(want)) => assert!((got - want).abs() <= 1e-15 * want, "{text}"),
                (got, want) => assert_eq!(got, want, "{text}"),
            }
        }
    }
}
