//! Inventor's lights as `KHR_lights_punctual`.
//!
//! glTF viewers reflect albedo / pi, Inventor's model reflects albedo; so a directional light has
//! pi * intensity lux. Point and spot lights fall with the square of the distance in glTF and by
//! 1 / (a d^2 + b d + c) in Inventor; the candela make both agree at one distance, d_ref. Nearer,
//! glTF is brighter, without bound; farther away it is darker. So d_ref is where Inventor's light
//! has fallen to half, a d^2 + b d + c = 2 c, as long as that is between the light and the scene's
//! centre: what a fading light lights is around there. A light that does not fade, or hardly,
//! is made for the whole scene, and agrees at the scene's centre.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DAffine3, DVec3};
use scenegraph::scene::{Beam, Environment, Light, LightKind};

use crate::bounds::Bounds;
use crate::color::{linear_rgb_from_srgb, unit};
use crate::extras;
use crate::frame::{looking, unit_or};
use crate::json::Json;
use crate::options::Lights;

/// Share of the scene's radius within which a light counts as at its centre, where it lights
/// what is around it: at the distance of the radius.
const CENTER_SHARE: f64 = 1e-3;
/// Share of the way to the scene's centre that d_ref is at the least. It bounds the error of a
/// light whose brightness grows without bound at the light itself (c = 0).
const NEAREST_SHARE: f64 = 0.25;
/// Brightness at which the cosine power counts as falling.
const INNER_CONE_BRIGHTNESS: f64 = 0.9;
/// The inner cone must be smaller than the outer one; this much of it, at most.
const INNER_CONE_SHARE: f64 = 0.999;
/// Narrowest cone, radians.
const MIN_CONE_RAD: f64 = 1e-4;
/// Of green light (SI, `K_cd`), as converters take it for all light.
pub(crate) const LUMEN_PER_WATT: f64 = 683.0;
/// Viewers hold f32.
const MAX_INTENSITY: f64 = 1e30;

/// The light's frame in that of its group: along -Z, at the location of a point or spot light.
pub(crate) fn frame(kind: &LightKind, parent_from_local: &DAffine3) -> DAffine3 {
    let along =
        |direction: DVec3| unit_or(parent_from_local.transform_vector3(direction), DVec3::NEG_Z);
    match *kind {
        LightKind::Directional { direction } => looking(DVec3::ZERO, along(direction), DVec3::Y),
        LightKind::Point { location } => {
            DAffine3::from_translation(parent_from_local.transform_point3(location))
        }
        LightKind::Spot {
            location,
            direction,
            ..
        } => {
            let location = parent_from_local.transform_point3(location);
            looking(location, along(direction), DVec3::Y)
        }
    }
}

/// With `extras`, Inventor's own values are in it, and the light's number if sets call it by that.
pub(crate) fn write(
    json: &mut Json,
    light: &Light,
    environment: &Environment,
    bounds: Option<&Bounds>,
    unit: Lights,
    extras: Option<Option<usize>>,
) {
    json.object(|json| {
        json.key("type").str(match light.kind {
            LightKind::Directional { .. } => "directional",
            LightKind::Point { .. } => "point",
            LightKind::Spot { .. } => "spot",
        });
        let color_linear = linear_rgb_from_srgb(light.color_srgb);
        if color_linear != [1.0; 3] {
            json.key("color").f32s(&color_linear.map(|v| v as f32));
        }
        let distance = reference_distance(light, environment.attenuation, bounds);
        let strength = strength(light.intensity, environment.attenuation, distance, unit);
        if strength != 1.0 {
            json.key("intensity").f32(strength as f32);
        }
        if let Some(range) = range(light, bounds) {
            json.key("range").f32(range as f32);
        }
        if let LightKind::Spot {
            drop_off_rate,
            cut_off_angle_rad,
            ..
        } = light.kind
        {
            let (inner, outer) = cone(drop_off_rate, cut_off_angle_rad, light.beam);
            json.key("spot").object(|json| {
                json.key("innerConeAngle").f64(inner);
                json.key("outerConeAngle").f64(outer);
            });
        }
        if let Some(number) = extras {
            extras::light(json, light, environment, number, distance);
        }
    });
}

/// glTF's strength of a light of Inventor's: lux of a directional light, candela of one that agrees
/// with Inventor's at a distance.
pub(crate) fn strength(
    intensity: f64,
    [a, b, c]: [f64; 3],
    reference_distance: Option<f64>,
    unit: Lights,
) -> f64 {
    let at_reference = reference_distance.map_or(1.0, |d| {
        let divisor = a * d * d + b * d + c;
        if divisor > 0.0 {
            d * d / divisor
        } else {
            d * d
        }
    });
    let factor = match unit {
        Lights::Unitless => 1.0,
        Lights::Physical => LUMEN_PER_WATT,
    };
    let strength = PI * intensity.max(0.0) * at_reference * factor;
    if strength.is_nan() {
        0.0
    } else {
        strength.min(MAX_INTENSITY)
    }
}

/// How far a light reaches, if that is not as far as the scene. Up to there VRML's light is as
/// without an end; glTF's is multiplied by 1 - (d / range)^4, so it ends softly, and is darker by
/// 6 % at half the way and by 41 % at four fifths.
fn range(light: &Light, bounds: Option<&Bounds>) -> Option<f64> {
    let p_in_world = p_in_world(light)?;
    let bounds = bounds?;
    let farthest = p_in_world.distance(bounds.center()) + bounds.radius();
    // f32 holds it as a number above 0.
    let in_f32 = |r: &f64| (f64::from(f32::MIN_POSITIVE)..f64::from(f32::MAX)).contains(r);
    light
        .radius_in_world
        .filter(|radius| in_f32(radius) && *radius < farthest)
}

/// Where a light is; `None` for a directional one.
fn p_in_world(light: &Light) -> Option<DVec3> {
    let location = match light.kind {
        LightKind::Directional { .. } => return None,
        LightKind::Point { location } | LightKind::Spot { location, .. } => location,
    };
    Some(light.placement.world_from_local.transform_point3(location))
}

/// d_ref, in the world; `None` for a directional light.
fn reference_distance(light: &Light, [a, b, c]: [f64; 3], bounds: Option<&Bounds>) -> Option<f64> {
    let p_in_world = p_in_world(light)?;
    let centre = distance_to_centre(p_in_world, bounds);
    // The positive root of a d^2 + b d - c, in the form that does not cancel.
    let half = 2.0 * c / (b + (b * b + 4.0 * a * c).sqrt());
    Some(if half >= 0.0 {
        half.clamp(NEAREST_SHARE * centre, centre)
    } else {
        // Factors that are no attenuation.
        centre
    })
}

fn distance_to_centre(p_in_world: DVec3, bounds: Option<&Bounds>) -> f64 {
    let Some(bounds) = bounds else { return 1.0 };
    let (distance, radius) = (p_in_world.distance(bounds.center()), bounds.radius());
    let distance = if distance > CENTER_SHARE * radius {
        distance
    } else {
        radius
    };
    if distance > 0.0 && distance.is_finite() {
        distance
    } else {
        1.0
    }
}

/// Inner and outer half angles: where cos^e has fallen to nine tenths, and the cut-off. The inner
/// cone is of full strength in glTF, as that of a beam is.
pub(crate) fn cone(drop_off_rate: f64, cut_off_angle_rad: f64, beam: Option<Beam>) -> (f64, f64) {
    let outer = if cut_off_angle_rad > MIN_CONE_RAD {
        cut_off_angle_rad.min(FRAC_PI_2)
    } else {
        MIN_CONE_RAD
    };
    let exponent = 128.0 * unit(drop_off_rate);
    let inner = if exponent > 0.0 {
        INNER_CONE_BRIGHTNESS.powf(1.0 / exponent).acos()
    } else {
        FRAC_PI_2
    };
    let widest = outer * INNER_CONE_SHARE;
    let inner = beam.map_or(inner.min(widest), |beam| {
        beam.inner_angle_rad.clamp(0.0, widest)
    });
    (inner, outer)
}
