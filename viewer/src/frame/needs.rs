//! What a light needs in a view: its volumes and the pixels it may reach. Not which passes that
//! makes.

use glam::DVec3;

use super::cull;
use super::lists::Counts;
use super::plan::{Skip, SkipReason, VolumeDraw};
use super::planner::Planner;
use super::scissor::scissor;
use super::settings::Shadows;
use crate::content::{LightShape, WorldLight};
use crate::view::Lens;
use crate::volume::{volume_may_touch, zpass_is_safe};

/// A light that a pass is needed for.
pub struct Needed {
    /// Index of the light.
    pub light: u32,
    /// Pixels it may reach; `None`: all.
    pub scissor: Option<[u32; 4]>,
    /// The shadows that may be seen.
    pub volumes: Vec<VolumeDraw>,
    /// There are some.
    pub casts: bool,
    /// What throws none.
    pub skipped: Vec<Skip>,
}

/// How a view looks along a light.
enum Along {
    /// The way it shines: nothing seen is in shadow.
    WithLight,
    /// Towards it: everything seen has its own back to the light.
    AgainstLight,
}

impl Planner<'_> {
    /// What a light needs, or why no pass has it.
    pub fn needs(&self, light: u32) -> Result<Needed, SkipReason> {
        let world_light = &self.lights[light as usize];
        if world_light.is_black() {
            return Err(SkipReason::BlackLight);
        }
        if !self.opaque().any(|i| self.unlit_reason(light, i).is_none()) {
            return Err(SkipReason::LightReachesNothing);
        }
        let (volumes, skipped) = match self.settings.shadows {
            Shadows::None => (Vec::new(), Vec::new()),
            _ if !world_light.casts_shadows => (Vec::new(), Vec::new()),
            _ => match self.along(world_light) {
                // What is seen is what the light meets first, or lies behind faces not drawn.
                Some(Along::WithLight) => self.volumes_face_on(world_light),
                Some(Along::AgainstLight) => return Err(SkipReason::LightReachesNothing),
                None => self.volumes(world_light),
            },
        };
        let reach = world_light.reach();
        let scissor = match world_light.p_in_world() {
            Some(p_in_world) if reach.is_finite() => {
                scissor(self.view, self.region, p_in_world, reach)
            }
            _ => Some(self.region.rectangle()),
        };
        let Some(rectangle) = scissor else {
            return Err(SkipReason::LightReachesNothing);
        };
        Ok(Needed {
            light,
            scissor: (rectangle != self.region.rectangle()).then_some(rectangle),
            casts: !volumes.is_empty(),
            volumes,
            skipped,
        })
    }

    /// Whether a parallel view looks so nearly along a directional light that no shadow comes to
    /// lie beside its caster: over the whole depth of the scene, by less than a quarter of a pixel.
    /// The sides of volumes are then seen edge-on, where a device cannot tell which way they face.
    fn along(&self, light: &WorldLight) -> Option<Along> {
        let (Lens::Orthographic { half_height }, LightShape::Directional { towards }) =
            (self.view.lens, light.shape)
        else {
            return None;
        };
        let forward = self.view.forward();
        let across = towards.cross(forward).length();
        let (nearest, farthest) = self.view.depth_bounds(&self.content.bounds)?;
        let pixel = 2.0 * half_height / f64::from(self.region.height);
        if across * (farthest - nearest) > 0.25 * pixel {
            return None;
        }
        Some(if towards.dot(forward) < 0.0 {
            Along::WithLight
        } else {
            Along::AgainstLight
        })
    }

    /// The casters whose shadows may be seen by a view along the light: those with faces that are
    /// not drawn.
    fn volumes_face_on(&self, light: &WorldLight) -> (Vec<VolumeDraw>, Vec<Skip>) {
        let (mut volumes, mut skipped) = self.volumes(light);
        volumes.retain(|volume| volume.has_light_caps);
        skipped.retain(|skip| skip.reason != SkipReason::CapsNotNeeded);
        for volume in &mut volumes {
            volume.has_sides = false;
        }
        (volumes, skipped)
    }

    /// The casters whose shadows may be seen.
    fn volumes(&self, light: &WorldLight) -> (Vec<VolumeDraw>, Vec<Skip>) {
        let planes = self.frustum.planes_in_world();
        let light_in_world = match light.shape {
            LightShape::Directional { towards } => towards.extend(0.0),
            LightShape::Point { p_in_world } | LightShape::Spot { p_in_world, .. } => {
                p_in_world.extend(1.0)
            }
        };
        let near_corners = self.near_corners();
        let mut volumes = Vec::new();
        let mut counts = Counts::default();
        for index in self.opaque() {
            let object = self.object(index);
            if !object.is_caster() {
                continue;
            }
            if !cull::may_light(light, &object.bounds) {
                counts.add(SkipReason::CasterOutOfReach);
                continue;
            }
            if !volume_may_touch(&object.bounds, light_in_world, &planes) {
                counts.add(SkipReason::ShadowOutOfView);
                continue;
            }
            let is_z_pass = match near_corners {
                // A parallel projection has its eye at infinity, where z-fail has no end to
                // count to.
                None => true,
                Some(corners) => {
                    self.settings.allows_z_pass
                        && zpass_is_safe(&object.bounds, self.view.eye, corners, light_in_world)
                }
            };
            let has_light_caps = is_z_pass && object.is_culled;
            if is_z_pass && !has_light_caps {
                counts.add(SkipReason::CapsNotNeeded);
            }
            volumes.push(VolumeDraw {
                object: index,
                is_z_pass,
                has_light_caps,
                has_sides: true,
            });
        }
        (volumes, counts.list())
    }

    /// Corners of the near rectangle; `None` for a parallel projection.
    fn near_corners(&self) -> Option<[DVec3; 4]> {
        let Lens::Perspective { tan_half_height } = self.view.lens else {
            return None;
        };
        let up = self.view.up() * tan_half_height * self.near;
        let right = self.view.right() * tan_half_height * self.region.aspect * self.near;
        let center = self.view.eye + self.view.forward() * self.near;
        Some([
            center - right - up,
            center + right - up,
            center + right + up,
            center - right + up,
        ])
    }
}
