//! Lights in the world, with the reach of their light.

use glam::DVec3;
use scenegraph::scene::{Light, LightKind, Scene};

/// A light's shape in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightShape {
    /// Parallel rays.
    Directional {
        /// Towards the light; unit length.
        towards: DVec3,
    },
    /// All ways from a point.
    Point {
        /// Where it is.
        p_in_world: DVec3,
    },
    /// A cone.
    Spot {
        /// The apex.
        p_in_world: DVec3,
        /// The way the light travels; unit length.
        axis: DVec3,
        /// Cosine of the half angle; -1 and below: all ways.
        cos_cut_off: f64,
        /// How it weakens towards the edge.
        fade: SpotFade,
    },
}

/// How a spot light weakens towards the edge of its cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpotFade {
    /// By the cosine of the angle to the axis, to the power of 128 times `dropOffRate`.
    Cosine {
        /// The power.
        exponent: f64,
    },
    /// From full strength in an inner cone to none at the edge (Lexolights' photorealism).
    Beam {
        /// Cosine of the inner cone's half angle.
        cos_inner: f64,
        /// The power of what is left.
        exponent: f64,
    },
}

/// A light in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct WorldLight {
    /// DEF name.
    pub name: Option<std::sync::Arc<str>>,
    /// Its shape.
    pub shape: LightShape,
    /// Colour times intensity.
    pub color_srgb: [f64; 3],
    /// Quadratic, linear, constant; `None` if it does not weaken with distance.
    pub attenuation: Option<[f64; 3]>,
    /// It throws shadows.
    pub casts_shadows: bool,
}

/// Half a step of an 8-bit channel, halved again for rounding: light below it changes no pixel.
pub const DARKEST_VISIBLE: f64 = 1.0 / 1024.0;

impl WorldLight {
    /// Where it is, unless it is directional.
    pub fn p_in_world(&self) -> Option<DVec3> {
        match self.shape {
            LightShape::Directional { .. } => None,
            LightShape::Point { p_in_world } | LightShape::Spot { p_in_world, .. } => {
                Some(p_in_world)
            }
        }
    }

    /// Whether it adds anything at all.
    pub fn is_black(&self) -> bool {
        self.color_srgb.iter().all(|&c| c <= 0.0)
    }

    /// Beyond this distance its light is below `DARKEST_VISIBLE` on the brightest material
    /// (diffuse and specular one); infinite if it does not weaken.
    pub fn reach(&self) -> f64 {
        let Some([quadratic, linear, constant]) = self.attenuation else {
            return f64::INFINITY;
        };
        let brightest = self.color_srgb.iter().fold(0.0_f64, |a, &b| a.max(b)) * 2.0;
        // q d^2 + l d + c = brightest / darkest, solved for the positive d.
        let rest = brightest / DARKEST_VISIBLE - constant;
        if rest <= 0.0 {
            return 0.0;
        }
        let discriminant = linear * linear + 4.0 * quadratic * rest;
        let denominator = linear + discriminant.max(0.0).sqrt();
        if quadratic < 0.0 || linear < 0.0 || denominator <= 0.0 {
            return f64::INFINITY;
        }
        2.0 * rest / denominator
    }
}

/// All lights of `scene`, in its order.
pub fn world_lights(scene: &Scene) -> Vec<WorldLight> {
    scene
        .lights
        .iter()
        .map(|light| world_light(scene, light))
        .collect()
}

fn world_light(scene: &Scene, light: &Light) -> WorldLight {
    let world_from_local = light.placement.world_from_local;
    let axis_in_world = |direction: DVec3| {
        world_from_local
            .transform_vector3(direction)
            .try_normalize()
            .unwrap_or(DVec3::NEG_Z)
    };
    let shape = match light.kind {
        LightKind::Directional { direction } => LightShape::Directional {
            towards: -axis_in_world(direction),
        },
        LightKind::Point { location } => LightShape::Point {
            p_in_world: world_from_local.transform_point3(location),
        },
        LightKind::Spot {
            location,
            direction,
            drop_off_rate,
            cut_off_angle_rad,
        } => LightShape::Spot {
            p_in_world: world_from_local.transform_point3(location),
            axis: axis_in_world(direction),
            cos_cut_off: cut_off_angle_rad.clamp(0.0, std::f64::consts::PI).cos(),
            fade: match light.beam {
                Some(beam) => SpotFade::Beam {
                    cos_inner: beam.inner_angle_rad.cos(),
                    exponent: beam.exponent.max(0.0),
                },
                None => SpotFade::Cosine {
                    exponent: 128.0 * drop_off_rate.max(0.0),
                },
            },
        },
    };
    let weakens = !matches!(shape, LightShape::Directional { .. });
    let attenuation = scene.environments[light.environment.index()].attenuation;
    WorldLight {
        name: light.placement.name.clone(),
        shape,
        color_srgb: light.color_srgb.map(|c| c * light.intensity),
        attenuation: (weakens && attenuation != [0.0, 0.0, 1.0]).then_some(attenuation),
        casts_shadows: true,
    }
}
