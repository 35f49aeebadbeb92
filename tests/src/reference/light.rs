//! Lights in the world: which way they are, and how much of them arrives.

use glam::DVec3;
use scenegraph::scene::{Light, LightKind, Scene};

/// Where light comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// From infinitely far along this unit vector.
    Direction(DVec3),
    /// From this point.
    Point(DVec3),
}

/// A light, ready for shading.
#[derive(Clone, Copy, Debug)]
pub struct WorldLight {
    /// Where it comes from.
    pub source: Source,
    /// Intensity times colour.
    color: DVec3,
    /// Quadratic, linear, constant.
    attenuation: [f64; 3],
    cone: Option<Cone>,
}

#[derive(Clone, Copy, Debug)]
struct Cone {
    axis: DVec3,
    cos_cut_off: f64,
    exponent: f64,
    /// Half angle of the inner cone and the power of the seam around it.
    beam: Option<(f64, f64)>,
}

impl WorldLight {
    /// A light of the scene.
    pub fn new(scene: &Scene, light: &Light) -> Self {
        let world = &light.placement.world_from_local;
        let axis = |direction| world.transform_vector3(direction).normalize_or_zero();
        let (source, cone) = match light.kind {
            LightKind::Directional { direction } => (Source::Direction(-axis(direction)), None),
            LightKind::Point { location } => {
                (Source::Point(world.transform_point3(location)), None)
            }
            LightKind::Spot {
                location,
                direction,
                drop_off_rate,
                cut_off_angle_rad,
            } => {
                let cone = Cone {
                    axis: axis(direction),
                    cos_cut_off: cut_off_angle_rad.cos(),
                    exponent: 128.0 * drop_off_rate,
                    beam: light.beam.map(|beam| (beam.inner_angle_rad, beam.exponent)),
                };
                (Source::Point(world.transform_point3(location)), Some(cone))
            }
        };
        Self {
            source,
            color: DVec3::from(light.color_srgb) * light.intensity,
            attenuation: scene.environments[light.environment.index()].attenuation,
            cone,
        }
    }

    /// White, along the view.
    pub fn headlight(forward: DVec3) -> Self {
        Self {
            source: Source::Direction(-forward),
            color: DVec3::ONE,
            attenuation: [0.0, 0.0, 1.0],
            cone: None,
        }
    }

    /// Unit vector from `p` to the light, and what arrives there if nothing is between.
    pub fn at(&self, p: DVec3) -> (DVec3, DVec3) {
        let location = match self.source {
            Source::Direction(to_light) => return (to_light, self.color),
            Source::Point(location) => location,
        };
        let distance = p.distance(location);
        let to_light = (location - p).normalize_or_zero();
        let [quadratic, linear, constant] = self.attenuation;
        let divisor = constant + linear * distance + quadratic * distance * distance;
        let attenuation = if divisor > 0.0 { 1.0 / divisor } else { 1.0 };
        let spot = self.cone.map_or(1.0, |cone| cone.share(-to_light));
        (to_light, self.color * (attenuation * spot))
    }
}

impl Cone {
    fn share(&self, away: DVec3) -> f64 {
        let cosine = away.dot(self.axis);
        if cosine < self.cos_cut_off {
            return 0.0;
        }
        let Some((inner_angle_rad, exponent)) = self.beam else {
            return cosine.max(0.0).powf(self.exponent);
        };
        let inner = inner_angle_rad.cos();
        if cosine >= inner {
            return 1.0;
        }
        ((cosine - self.cos_cut_off) / (inner - self.cos_cut_off)).powf(exponent)
    }
}
