//! Display-referred (sRGB) colours to glTF's linear ones. Inventor draws without an sRGB
//! framebuffer, so its colours are what the display gets; glTF's factors are linear light.

/// The sRGB transfer function (IEC 61966-2-1) of a value clamped to 0 to 1; 0 for NaN.
pub(crate) fn linear_from_srgb(value_srgb: f64) -> f64 {
    let v = unit(value_srgb);
    if v <= 0.04045 {
        v / 12.92
    } else {
        ((v + 0.055) / 1.055).powf(2.4)
    }
}

/// Inverse of [`linear_from_srgb`], with the same clamping.
pub(crate) fn srgb_from_linear(value_linear: f64) -> f64 {
    let v = unit(value_linear);
    if v <= 0.003_130_8 {
        v * 12.92
    } else if v < 1.0 {
        1.055 * v.powf(1.0 / 2.4) - 0.055
    } else {
        // 1.055 - 0.055 is not 1 in f64.
        1.0
    }
}

pub(crate) fn linear_rgb_from_srgb(color_srgb: [f64; 3]) -> [f64; 3] {
    color_srgb.map(linear_from_srgb)
}

/// `value` clamped to 0 to 1; 0 for NaN.
pub(crate) fn unit(value: f64) -> f64 {
    if value > 0.0 { value.min(1.0) } else { 0.0 }
}

/// A value of 0 to 1 as a normalized unsigned short.
pub(crate) fn u16_from_unit(value: f64) -> u16 {
    (unit(value) * 65535.0).round() as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Inverse of the transfer function, from the standard.
    fn srgb_from_linear(v: f64) -> f64 {
        if v <= 0.003_130_8 {
            v * 12.92
        } else {
            1.055 * v.powf(1.0 / 2.4) - 0.055
        }
    }

    #[test]
    fn all_display_levels_survive_sixteen_bit_linear() {
        for level in 0..=255_u8 {
            let linear = u16_from_unit(linear_from_srgb(f64::from(level) / 255.0));
            let back = srgb_from_linear(f64::from(linear) / 65535.0) * 255.0;
            assert_eq!(back.round() as u8, level);
        }
    }

    #[test]
    fn values_out_of_range_are_clamped() {
        for (value, want) in [
            (-1.0, 0.0),
            (2.0, 1.0),
            (f64::NAN, 0.0),
            (f64::INFINITY, 1.0),
        ] {
            assert_eq!(linear_from_srgb(value), want);
            assert_eq!(f64::from(u16_from_unit(value)) / 65535.0, want);
        }
    }
}
