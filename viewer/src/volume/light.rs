//! A homogeneous light, read once. Not a light of the scene: it has no colour or range.

use glam::{DVec3, DVec4, Vec4Swizzles};

/// Where a light is, in the frame of the mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Light {
    /// At a finite point.
    Point(DVec3),
    /// Infinitely far in this direction, which has no particular length.
    Towards(DVec3),
}

/// A point further off than this is at infinity for every `f32` position: the largest of them
/// is below 2^128, so it moves the direction by less than half the last place.
const INFINITELY_FAR: f64 = 1.0e60;

/// Directions whose largest component is within these bounds are used as they are. Outside,
/// exact products could overflow or be subnormal, and the direction is scaled, with rounding.
const DIRECTION_RANGE: std::ops::Range<f64> = 1.0e-60..1.0e60;

impl Light {
    /// `None` for a vector that is not finite or has no direction.
    pub(crate) fn new(homogeneous: DVec4) -> Option<Self> {
        if !homogeneous.is_finite() {
            return None;
        }
        let point = homogeneous.xyz() / homogeneous.w;
        if homogeneous.w != 0.0 && point.abs().max_element() < INFINITELY_FAR {
            return Some(Self::Point(point));
        }
        let towards = homogeneous.xyz() * if homogeneous.w < 0.0 { -1.0 } else { 1.0 };
        let size = towards.abs().max_element();
        if DIRECTION_RANGE.contains(&size) {
            return Some(Self::Towards(towards));
        }
        let scaled = towards / size;
        scaled.is_finite().then_some(Self::Towards(scaled))
    }
}
