//! The forms that a mesh's numbers are stored in, and each number in its form.
//!
//! Bounds of what a form is off by, for values that it can hold:
//!
//! - positions as multiples of a step: what `prepare/grid.rs` says;
//! - normals in eight or sixteen bits: each component is off by half a step, so the vector by
//!   √3/254 or √3/65534, which is the sine of the widest angle;
//! - texture coordinates: 1/131070 of the image's side;
//! - colours in eight bits: taken only where the level of an 8-bit display stays what it was;
//!   alpha is off by 1/510.

use crate::color::{linear_from_srgb, srgb_from_linear, u16_from_unit, unit};

/// How the numbers of one mesh are stored.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Formats {
    pub(crate) positions: Positions,
    pub(crate) normals: Normals,
    pub(crate) texcoords: Texcoords,
    pub(crate) colors: Colors,
}

/// Three numbers a vertex. Steps are exact in f32, and so are their multiples as the mesh has them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum Positions {
    #[default]
    F32,
    /// Multiples of `step`, 0 to 65535.
    U16 { step: f32 },
    /// Multiples of `step`, 0 to 255.
    U8 { step: f32 },
}

/// Three numbers a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Normals {
    #[default]
    F32,
    I16,
    I8,
    /// [`Normals::I16`] made from points on an octahedron, as compression likes them.
    Oct16 {
        bits: u8,
    },
    /// [`Normals::I8`], likewise.
    Oct8 {
        bits: u8,
    },
}

/// Two numbers a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Texcoords {
    #[default]
    F32,
    /// Shares of 0 to 1.
    U16,
}

/// Four shares of 0 to 1 a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Colors {
    #[default]
    U16,
    U8,
}

impl Positions {
    /// The distance between neighbouring values; `None` for floats.
    pub(crate) fn step(self) -> Option<f32> {
        match self {
            Self::F32 => None,
            Self::U16 { step } | Self::U8 { step } => Some(step),
        }
    }
}

const I8_STEPS: f64 = 127.0;
const I16_STEPS: f64 = 32767.0;

/// Widest angle that a unit vector turns by when its components are rounded.
fn angle_of_rounding(steps: f64) -> f64 {
    (3.0_f64.sqrt() / (2.0 * steps)).asin()
}

/// Widest angle that a point on the octahedron |x| + |y| + |z| = 1 turns by when x and y are
/// rounded to steps of this many bits: z changes by as much as both, and the octahedron is
/// nowhere nearer than 1/√3.
fn angle_of_octahedron(bits: u8) -> f64 {
    let half_step = 0.5 / f64::from((1_u32 << (bits - 1)) - 1);
    (18.0_f64.sqrt() * half_step).asin()
}

impl Normals {
    /// The shortest form within an angle.
    pub(crate) fn within(tolerance_rad: f64) -> Self {
        if tolerance_rad >= angle_of_rounding(I8_STEPS) {
            Self::I8
        } else if tolerance_rad >= angle_of_rounding(I16_STEPS) {
            Self::I16
        } else {
            Self::F32
        }
    }

    /// The form within an angle that compresses best.
    pub(crate) fn compressed_within(tolerance_rad: f64) -> Self {
        let fits = |bits: &u8, steps| {
            tolerance_rad >= angle_of_octahedron(*bits) + angle_of_rounding(steps)
        };
        if let Some(bits) = (4..=8).find(|bits| fits(bits, I8_STEPS)) {
            Self::Oct8 { bits }
        } else if let Some(bits) = (8..=16).find(|bits| fits(bits, I16_STEPS)) {
            Self::Oct16 { bits }
        } else {
            Self::F32
        }
    }
}

impl Texcoords {
    /// The shortest form that holds all of these.
    pub(crate) fn holding(texcoords: &[[f32; 2]]) -> Self {
        let is_share = |v: f32| (0.0..=1.0).contains(&v);
        if texcoords.iter().all(|&[s, t]| is_share(s) && is_share(t)) {
            Self::U16
        } else {
            Self::F32
        }
    }
}

impl Colors {
    /// Eight bits where no level of an 8-bit display changes.
    pub(crate) fn holding(colors_srgb: &[[f32; 4]]) -> Self {
        let level = |v_srgb: f64| (unit(v_srgb) * 255.0).round();
        let survives = |&v_srgb: &f32| {
            let stored = u8_from_unit(linear_from_srgb(v_srgb.into()));
            let shown = srgb_from_linear(f64::from(stored) / 255.0);
            level(shown) == level(v_srgb.into())
        };
        let mut last = None;
        for [r, g, b, _] in colors_srgb {
            let color = [r, g, b];
            // Neighbouring vertices mostly share their colour, and the transfer function is slow.
            if last != Some(color) {
                if !color.into_iter().all(survives) {
                    return Self::U16;
                }
                last = Some(color);
            }
        }
        Self::U8
    }
}

/// The number of steps in a coordinate that is a multiple of the step.
pub(crate) fn steps(v: f32, step: f32) -> u16 {
    // Half a step up, then cut off, is the nearest.
    (v / step + 0.5) as u16
}

/// A component of a unit vector in eight bits.
pub(crate) fn i8_from_signed(v: f32) -> i8 {
    (v * 127.0 + 0.5_f32.copysign(v)) as i8
}

/// A component of a unit vector in sixteen bits.
pub(crate) fn i16_from_signed(v: f32) -> i16 {
    (f64::from(v) * 32767.0 + 0.5_f64.copysign(f64::from(v))) as i16
}

/// A texture coordinate in sixteen bits.
pub(crate) fn u16_from_share(v: f32) -> u16 {
    u16_from_unit(v.into())
}

/// A value of 0 to 1 in eight bits.
pub(crate) fn u8_from_unit(value: f64) -> u8 {
    (unit(value) * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_form_of_normals_within_an_angle() {
        for (degrees, want) in [
            (90.0, Normals::I8),
            (0.4, Normals::I8),
            (0.39, Normals::I16),
            (0.0016, Normals::I16),
            (0.0015, Normals::F32),
            (0.0, Normals::F32),
            (f64::NAN, Normals::F32),
        ] {
            assert_eq!(Normals::within(f64::to_radians(degrees)), want, "{degrees}");
        }
    }

    #[test]
    fn normals_turn_by_no_more_than_their_form_says() {
        let mut widest = [0.0_f64; 2];
        for i in 0..200_000 {
            // Points of a spiral over the sphere.
            let z = 1.0 - (f64::from(i) + 0.5) / 100_000.0;
            let (sin, cos) = (f64::from(i) * 2.399_963_229_728_653).sin_cos();
            let rim = (1.0 - z * z).sqrt();
            let n = glam::DVec3::new(rim * cos, rim * sin, z);
            let f = n.as_vec3().to_array();
            let eight = glam::DVec3::from(f.map(|v| f64::from(i8_from_signed(v))));
            let sixteen = glam::DVec3::from(f.map(|v| f64::from(i16_from_signed(v))));
            for (widest, stored) in widest.iter_mut().zip([eight, sixteen]) {
                let stored = stored.normalize();
                *widest = widest.max(2.0 * ((stored - n).length() * 0.5).asin());
            }
        }
        // Near the bounds, and not beyond them; f32 adds 1e-7.
        assert!(
            (0.37..=0.3908).contains(&widest[0].to_degrees()),
            "{widest:?}"
        );
        assert!(
            (0.0014..=0.00153).contains(&widest[1].to_degrees()),
            "{widest:?}"
        );
    }

    #[test]
    fn points_on_the_octahedron_keep_their_bound() {
        let normals: Vec<[f32; 4]> = (0..50_000)
            .map(|i| {
                let z = 1.0 - (f64::from(i) + 0.5) / 25_000.0;
                let (sin, cos) = (f64::from(i) * 2.399_963_229_728_653).sin_cos();
                let rim = (1.0 - z * z).sqrt();
                [rim * cos, rim * sin, z, 0.0].map(|v| v as f32)
            })
            .collect();
        for bits in 4..=16_u8 {
            let points = meshopt::encode_filter_oct::<i16>(&normals, bits.into());
            let mut widest = 0.0_f64;
            for ([x, y, one, _], n) in points.into_iter().zip(&normals) {
                // The definition of the filter, in f64 and without its last rounding.
                let [x, y] = [x, y].map(|v| f64::from(v) / f64::from(one));
                let z = 1.0 - x.abs() - y.abs();
                let below = (-z).max(0.0);
                let v = glam::DVec3::new(x - below.copysign(x), y - below.copysign(y), z);
                let n = glam::DVec3::new(n[0].into(), n[1].into(), n[2].into());
                widest = widest.max(v.angle_between(n));
            }
            let bound = angle_of_octahedron(bits);
            assert!(
                (0.8 * bound..=bound + 1e-6).contains(&widest),
                "{bits}: {widest} {bound}"
            );
        }
    }

    #[test]
    fn colours_take_eight_bits_only_where_no_level_changes() {
        for (level, want) in [
            (0, Colors::U8),
            (255, Colors::U8),
            (204, Colors::U8),
            (1, Colors::U16),
        ] {
            let v = level as f32 / 255.0;
            assert_eq!(Colors::holding(&[[1.0, v, 0.0, 0.5]]), want, "{level}");
        }
    }
}
