//! `KHR_lights_punctual` as Inventor's lights.
//!
//! Where the file has Inventor's own values, those. Else a viewer's reflection of albedo / pi is
//! undone: the intensity is lux / pi of a directional light, and candela / pi of the others, which
//! get the attenuation 1 / d^2; so they are as bright as in glTF at any distance.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4, PI};

use glam::DVec3;
use gltf::json::extensions::scene::khr_lights_punctual::{Light as JsonLight, Spot, Type};
use gltf::json::validation::Checked;
use scenegraph::scene::{Beam, Environment, EnvironmentId, Light, LightKind, Placement};

use super::iv::Iv;
use crate::color::{srgb_from_linear, unit};

/// What the attenuation of glTF's light is in an `Environment`.
const INVERSE_SQUARE: [f64; 3] = [1.0, 0.0, 0.0];
/// Brightness that the writer takes for the edge of the inner cone.
const INNER_CONE_BRIGHTNESS: f64 = 0.9;
/// From this share of the outer cone on, the inner one is what the writer makes (0.999) of a light
/// that does not fall off.
const NO_DROP_OFF_SHARE: f64 = 0.9989;
/// The writer's narrowest inner cone, radians: that of the drop-off rate 1.
const MIN_INNER_CONE_RAD: f64 = 0.0405;

/// A light before it knows its environment's number.
pub(crate) struct Lamp {
    kind: LightKind,
    color_srgb: [f64; 3],
    intensity: f64,
    attenuation: [f64; 3],
    beam: Option<Beam>,
    radius_in_world: Option<f64>,
    /// Its environment, if the file says.
    pub(crate) environment: Option<usize>,
}

impl Lamp {
    /// `None` for a light of an unknown type, or one that is off.
    pub(crate) fn new(source: &JsonLight, by_ivory: bool) -> Option<Self> {
        let iv = Iv::of(&source.extras).or_else(|| by_ivory.then(Iv::default));
        let spot = source.spot.clone().unwrap_or_default();
        let direction = DVec3::NEG_Z;
        let location = DVec3::ZERO;
        let Checked::Valid(light_type) = source.type_ else {
            return None;
        };
        let kind = match light_type {
            Type::Directional => LightKind::Directional { direction },
            Type::Point => LightKind::Point { location },
            Type::Spot => {
                let (drop_off_rate, cut_off_angle_rad) = match &iv {
                    Some(iv) => (
                        iv.number("dropOffRate", 0.0),
                        iv.number("cutOffAngle", FRAC_PI_4),
                    ),
                    None => cone(&spot),
                };
                LightKind::Spot {
                    location,
                    direction,
                    drop_off_rate,
                    cut_off_angle_rad,
                }
            }
        };
        let directional = matches!(kind, LightKind::Directional { .. });
        let default = Environment::default().attenuation;
        let range = source.range.map(f64::from).filter(|_| !directional);
        let radius_in_world = range.filter(|r| *r > 0.0 && r.is_finite());
        Some(match iv {
            Some(iv) => Self {
                kind,
                color_srgb: iv.triple("color", [1.0; 3]),
                intensity: iv.number("intensity", 1.0),
                attenuation: iv.triple("attenuation", default),
                beam: iv.beam(),
                radius_in_world,
                environment: iv.index("environment"),
            },
            None => Self {
                kind,
                color_srgb: source.color.map(|v| srgb_from_linear(v.into())),
                intensity: f64::from(source.intensity.clamp(0.0, f32::MAX)) / PI,
                attenuation: if directional { default } else { INVERSE_SQUARE },
                beam: None,
                radius_in_world,
                environment: None,
            },
        })
    }

    /// The light, in the environment of its own if the file says, else in one with its attenuation,
    /// which is added where it is not there.
    pub(crate) fn placed(self, placement: Placement, environments: &mut Vec<Environment>) -> Light {
        let stated = self.environment.filter(|&i| i < environments.len());
        let directional = matches!(self.kind, LightKind::Directional { .. });
        let suits = |e: &Environment| directional || e.attenuation == self.attenuation;
        let environment = stated.or_else(|| environments.iter().position(suits));
        let environment = environment.unwrap_or_else(|| {
            environments.push(Environment {
                attenuation: self.attenuation,
                ..Environment::default()
            });
            environments.len() - 1
        });
        Light {
            placement,
            kind: self.kind,
            color_srgb: self.color_srgb,
            intensity: self.intensity,
            beam: self.beam,
            radius_in_world: self.radius_in_world,
            environment: EnvironmentId(environment as u32),
        }
    }
}

/// Drop-off rate and cut-off angle: the inverse of what the writer makes of them. Where the inner
/// cone is narrower than it makes any, Inventor's light is half as bright where glTF's is.
fn cone(spot: &Spot) -> (f64, f64) {
    let outer = f64::from(spot.outer_cone_angle);
    let outer = if outer > 0.0 {
        outer.min(FRAC_PI_2)
    } else {
        FRAC_PI_4
    };
    let inner = f64::from(spot.inner_cone_angle).max(0.0);
    let exponent = if inner >= outer * NO_DROP_OFF_SHARE {
        0.0
    } else if inner >= MIN_INNER_CONE_RAD {
        INNER_CONE_BRIGHTNESS.ln() / inner.cos().ln()
    } else {
        // glTF's brightness is the square of a share that runs with the cosine.
        let cos_half = outer.cos() + (inner.cos() - outer.cos()) * FRAC_1_SQRT_2;
        0.5_f64.ln() / cos_half.ln()
    };
    (unit(exponent / 128.0), outer)
}
