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

use serde_json::Value;

use super::iv::Iv;
use super::made_by::MadeBy;
use crate::Lights;
use crate::alike::{alike_in_size, all_alike};
use crate::color::{linear_rgb_from_srgb, srgb_from_linear, unit};
use crate::light::{LUMEN_PER_WATT, cone as written_cone, strength};

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
    /// By which number light sets call it, if not by that in the file; `None` for a light that came
    /// after them.
    pub(crate) is_in_sets: Option<Option<usize>>,
    radius_in_world: Option<f64>,
    /// Its environment, if the file says.
    pub(crate) environment: Option<usize>,
}

impl Lamp {
    /// `None` for a light of an unknown type, or one that is off.
    pub(crate) fn new(source: &JsonLight, made_by: MadeBy) -> Option<Self> {
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
                let (drop_off_rate, cut_off_angle_rad) = cone(&spot);
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
        let mut lamp = Self {
            kind,
            color_srgb: source.color.map(|v| srgb_from_linear(v.into())),
            intensity: f64::from(source.intensity.clamp(0.0, f32::MAX)) / PI,
            attenuation: if directional { default } else { INVERSE_SQUARE },
            beam: None,
            radius_in_world: range.filter(|r| *r > 0.0 && r.is_finite()),
            environment: None,
            is_in_sets: Iv::of(&source.extras).map(|iv| iv.index("number")),
        };
        if let Some(iv) = made_by.values(&source.extras) {
            lamp.settle(&iv, source, &spot, made_by.lights);
        }
        Some(lamp)
    }

    /// Takes Inventor's own values, but for those that were edited since.
    fn settle(&mut self, iv: &Iv, source: &JsonLight, spot: &Spot, unit: Lights) {
        let color_srgb = iv.triple("color", [1.0; 3]);
        let written = linear_rgb_from_srgb(color_srgb).map(srgb_from_linear);
        if all_alike(&written, &self.color_srgb) {
            self.color_srgb = color_srgb;
        }
        let directional = matches!(self.kind, LightKind::Directional { .. });
        let distance = iv.value("referenceDistance").and_then(Value::as_f64);
        // Else it was of another type.
        if directional == distance.is_none() {
            self.attenuation = iv.triple("attenuation", Environment::default().attenuation);
            self.environment = iv.index("environment");
            let strength = |intensity| strength(intensity, self.attenuation, distance, unit);
            let (own, shown) = (iv.number("intensity", 1.0), f64::from(source.intensity));
            self.intensity = if alike_in_size(strength(own), shown) {
                own
            } else {
                finite_or_zero(shown.max(0.0) / strength(1.0))
            };
        } else if unit == Lights::Physical {
            self.intensity /= LUMEN_PER_WATT;
        }
        if let LightKind::Spot {
            drop_off_rate,
            cut_off_angle_rad,
            ..
        } = &mut self.kind
        {
            let rate = iv.number("dropOffRate", 0.0);
            let cut_off_rad = iv.number("cutOffAngle", FRAC_PI_4);
            let beam = iv.beam();
            let (inner_rad, outer_rad) = written_cone(rate, cut_off_rad, beam);
            let shown = [spot.inner_cone_angle, spot.outer_cone_angle].map(f64::from);
            if alike_in_size(inner_rad, shown[0]) && alike_in_size(outer_rad, shown[1]) {
                (*drop_off_rate, *cut_off_angle_rad) = (rate, cut_off_rad);
                self.beam = beam;
            } else {
                self.beam = beam.map(|beam| Beam {
                    inner_angle_rad: shown[0].clamp(0.0, FRAC_PI_2),
                    ..beam
                });
            }
        }
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

fn finite_or_zero(value: f64) -> f64 {
    if value.is_finite() { value } else { 0.0 }
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
