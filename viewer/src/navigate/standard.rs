//! The directions that a cube's faces and corner name.

use std::f64::consts::FRAC_PI_2;

use glam::{DQuat, DVec3};

use crate::view::framing::{Up, three_quarter};
use crate::view::looking;

/// A direction to look from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standard {
    /// Towards the back: along +Y if +Z is up, along -Z if +Y is.
    Front,
    /// From behind.
    Back,
    /// From the left side.
    Left,
    /// From the right side.
    Right,
    /// From above, the back at the top.
    Top,
    /// From below, the front at the top.
    Bottom,
    /// From the front, the right and above, as models without a camera are shown.
    ThreeQuarter,
}

impl Standard {
    /// All of them, in the order of menus.
    pub const ALL: [Self; 7] = [
        Self::Front,
        Self::Back,
        Self::Left,
        Self::Right,
        Self::Top,
        Self::Bottom,
        Self::ThreeQuarter,
    ];

    /// Its English name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Front => "Front",
            Self::Back => "Back",
            Self::Left => "Left",
            Self::Right => "Right",
            Self::Top => "Top",
            Self::Bottom => "Bottom",
            Self::ThreeQuarter => "Three-quarter",
        }
    }

    /// The orientation of a view from there.
    #[must_use]
    pub fn orientation(self, up: Up) -> DQuat {
        // With +Z up and the front towards -Y.
        let (forward, top) = match self {
            Self::Front => (DVec3::Y, DVec3::Z),
            Self::Back => (DVec3::NEG_Y, DVec3::Z),
            Self::Left => (DVec3::X, DVec3::Z),
            Self::Right => (DVec3::NEG_X, DVec3::Z),
            Self::Top => (DVec3::NEG_Z, DVec3::Y),
            Self::Bottom => (DVec3::Z, DVec3::NEG_Y),
            Self::ThreeQuarter => return three_quarter(up),
        };
        let z_up = looking(forward, top).unwrap_or(DQuat::IDENTITY);
        match up {
            Up::Z => z_up,
            Up::Y => DQuat::from_rotation_x(-FRAC_PI_2) * z_up,
        }
    }
}
