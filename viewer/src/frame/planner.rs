//! From a scene and a view to the passes of a frame, leaving out what the view does not need.
//!
//! Pass 1 draws emission, ambient light and the first light together: one without shadows in view
//! if there is one, else behind a pass for the depth and a pass that makes its shadows. Each
//! further light is a pass that adds, behind its shadows. Transparent objects come last, each with
//! all its lights at once.

use std::ops::Range;

use glam::DVec3;

use super::cull::{self, Frustum};
use super::lists::{Counts, Draws};
use super::plan::{Draw, Pass, PassKind, Pixels, Plan, Skip, SkipReason, VolumeDraw};
use super::scissor::scissor;
use super::settings::{Settings, Shadows};
use crate::content::{Content, LightShape, Object, WorldLight};
use crate::shader::{Contribution, LightKey, ShaderKey, ShadowLookup};
use crate::view::{Lens, Region, View};
use crate::volume::{volume_may_touch, zpass_is_safe};

struct Planner<'a> {
    content: &'a Content,
    view: &'a View,
    region: &'a Region,
    settings: &'a Settings,
    near: f64,
    frustum: Frustum,
    is_visible: Vec<bool>,
    lights: Vec<WorldLight>,
    headlight: Option<u32>,
}

/// Plans a frame. `near` is the distance of the near plane of a perspective.
pub fn plan(
    content: &Content,
    view: &View,
    region: &Region,
    near: f64,
    settings: &Settings,
) -> Plan {
    let frustum = Frustum::new(view, region.aspect);
    let mut lights = content.lights.clone();
    let headlight = (lights.is_empty() && settings.has_headlight).then(|| {
        lights.push(headlight(view));
        0
    });
    let planner = Planner {
        content,
        view,
        region,
        settings,
        near,
        is_visible: content
            .objects
            .iter()
            .map(|object| frustum.may_see(&object.bounds))
            .collect(),
        frustum,
        lights,
        headlight,
    };
    planner.plan()
}

/// What shines when nothing else does: along the view, without shadows.
fn headlight(view: &View) -> WorldLight {
    WorldLight {
        name: None,
        shape: LightShape::Directional {
            towards: -view.forward(),
        },
        color_srgb: [1.0; 3],
        attenuation: None,
        casts_shadows: false,
    }
}

/// A light that a pass is needed for.
struct Needed {
    light: u32,
    scissor: Option<[u32; 4]>,
    volumes: Vec<VolumeDraw>,
    casts: bool,
    skipped: Vec<Skip>,
}

/// How a view looks along a light.
enum Along {
    /// The way it shines: nothing seen is in shadow.
    WithLight,
    /// Towards it: everything seen has its own back to the light.
    AgainstLight,
}

impl Planner<'_> {
    fn plan(self) -> Plan {
        let mut skipped_lights = Vec::new();
        let mut needed = Vec::new();
        for light in 0..self.lights.len() as u32 {
            match self.needs(light) {
                Ok(need) => needed.push(need),
                Err(reason) => skipped_lights.push((light, reason)),
            }
        }
        // A light without shadows needs nothing before it.
        let first = needed.iter().position(|need| !need.casts).unwrap_or(0);
        let mut passes = Vec::new();
        if needed.is_empty() {
            passes.push(self.first(None, ShadowLookup::None, false, false));
        } else {
            self.first_passes(needed.remove(first), &mut passes);
        }
        for need in needed {
            self.light_passes(need, &mut passes);
        }
        passes.extend(self.transparent());
        passes.retain(|pass| !pass.draws.is_empty() || !pass.volumes.is_empty());
        Plan {
            passes,
            lights: self.lights,
            skipped_lights,
        }
    }

    fn opaque(&self) -> Range<u32> {
        0..self.content.opaque_count() as u32
    }

    fn object(&self, index: u32) -> &Object {
        &self.content.objects[index as usize]
    }

    fn is_in_scope(&self, light: u32, object: &Object) -> bool {
        self.headlight == Some(light)
            || self.content.light_sets[object.light_set as usize]
                .binary_search(&light)
                .is_ok()
    }

    /// Why an object is not in the pass of a light.
    fn unlit_reason(&self, light: u32, index: u32) -> Option<SkipReason> {
        let object = self.object(index);
        if !self.is_visible[index as usize] {
            Some(SkipReason::OutOfView)
        } else if !object.look.is_lit {
            Some(SkipReason::Unlit)
        } else if !self.is_in_scope(light, object) {
            Some(SkipReason::OutOfScope)
        } else if !cull::may_light(&self.lights[light as usize], &object.bounds) {
            Some(SkipReason::OutOfReach)
        } else {
            None
        }
    }

    fn needs(&self, light: u32) -> Result<Needed, SkipReason> {
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

    fn is_parallel(&self) -> bool {
        matches!(self.view.lens, Lens::Orthographic { .. })
    }

    /// The pass that makes the shadows of a light, if they can be seen, and how a shader asks.
    fn shadow_pass(&self, need: &mut Needed) -> (Option<Pass>, ShadowLookup) {
        let light = need.light;
        let shape = &self.lights[light as usize].shape;
        let is_directional = matches!(shape, LightShape::Directional { .. });
        let (kind, shadow) = match self.settings.shadows {
            _ if !need.casts => return (None, ShadowLookup::None),
            Shadows::None => return (None, ShadowLookup::None),
            Shadows::Volumes { .. } => (PassKind::Volumes { light }, ShadowLookup::None),
            Shadows::Map { .. } if is_directional => (PassKind::Map { light }, ShadowLookup::Map),
            Shadows::Map { .. } => (PassKind::Map { light }, ShadowLookup::CubeMap),
            Shadows::Rays => (PassKind::Rays { light }, ShadowLookup::Mask),
        };
        let pass = Pass {
            kind,
            draws: Vec::new(),
            volumes: std::mem::take(&mut need.volumes),
            scissor: need.scissor,
            skipped: std::mem::take(&mut need.skipped),
        };
        (Some(pass), shadow)
    }

    /// Pass 1 and what must come before it.
    fn first_passes(&self, mut need: Needed, passes: &mut Vec<Pass>) {
        let (shadow_pass, shadow) = self.shadow_pass(&mut need);
        let kind = shadow_pass.as_ref().map(|pass| pass.kind);
        let has_volumes = matches!(kind, Some(PassKind::Volumes { .. }));
        // A map is made from the scene; volumes and rays ask what is seen.
        let has_depth = has_volumes || matches!(kind, Some(PassKind::Rays { .. }));
        if has_depth {
            passes.push(self.depth());
        }
        passes.extend(shadow_pass);
        passes.push(self.first(Some(need.light), shadow, has_depth, has_volumes));
    }

    fn depth(&self) -> Pass {
        let mut draws = Draws::default();
        for index in self.opaque().filter(|&i| self.is_visible[i as usize]) {
            let object = self.object(index);
            let key = ShaderKey::new(&object.look, Contribution::Depth, self.is_parallel());
            draws.add(index, object, key, Pixels::All);
        }
        Pass {
            kind: PassKind::Depth,
            draws: draws.list,
            volumes: Vec::new(),
            scissor: None,
            skipped: Vec::new(),
        }
    }

    fn first(
        &self,
        light: Option<u32>,
        shadow: ShadowLookup,
        has_depth: bool,
        has_volumes: bool,
    ) -> Pass {
        let mut draws = Draws::default();
        let mut shadowed = Draws::default();
        let mut counts = Counts::default();
        for index in self.opaque() {
            let object = self.object(index);
            if !self.is_visible[index as usize] {
                counts.add(SkipReason::OutOfView);
                continue;
            }
            let key = |light| {
                ShaderKey::new(&object.look, Contribution::First(light), self.is_parallel())
            };
            let light = light
                .filter(|&light| self.unlit_reason(light, index).is_none())
                .map(|light| LightKey::of(&self.lights[light as usize], shadow));
            if light.is_some() && has_volumes {
                draws.add(index, object, key(light), Pixels::Lit);
                shadowed.add(index, object, key(None), Pixels::Shadowed);
            } else {
                draws.add(index, object, key(light), Pixels::All);
            }
        }
        let mut draws = draws.list;
        draws.extend(shadowed.list);
        if has_depth {
            // Of surfaces in one place the first is seen, whether nearest wins or last.
            draws.reverse();
        }
        Pass {
            kind: PassKind::First {
                light,
                shadow,
                has_depth,
            },
            draws,
            volumes: Vec::new(),
            scissor: None,
            skipped: counts.list(),
        }
    }

    fn light_passes(&self, mut need: Needed, passes: &mut Vec<Pass>) {
        let light = need.light;
        let (shadow_pass, shadow) = self.shadow_pass(&mut need);
        let kind = shadow_pass.as_ref().map(|pass| pass.kind);
        let has_volumes = matches!(kind, Some(PassKind::Volumes { .. }));
        passes.extend(shadow_pass);
        let key = LightKey::of(&self.lights[light as usize], shadow);
        let mut draws = Draws::default();
        let mut counts = Counts::default();
        for index in self.opaque() {
            if let Some(reason) = self.unlit_reason(light, index) {
                counts.add(reason);
                continue;
            }
            let object = self.object(index);
            let key = ShaderKey::new(&object.look, Contribution::Light(key), self.is_parallel());
            draws.add(index, object, key, Pixels::Lit);
        }
        passes.push(Pass {
            kind: PassKind::Light {
                light,
                shadow,
                has_volumes,
            },
            draws: draws.list,
            volumes: Vec::new(),
            scissor: need.scissor,
            skipped: counts.list(),
        });
    }

    fn transparent(&self) -> Option<Pass> {
        let first = self.content.opaque_count() as u32;
        let mut counts = Counts::default();
        let mut visible: Vec<(f64, u32)> = Vec::new();
        for index in first..self.content.objects.len() as u32 {
            if self.is_visible[index as usize] {
                let center = self.object(index).bounds.center();
                visible.push((self.view.forward().dot(center - self.view.eye), index));
            } else {
                counts.add(SkipReason::OutOfView);
            }
        }
        // Farthest first; equal distances in the order of the scene.
        visible.sort_by(|a, b| {
            b.0.total_cmp(&a.0)
                .then(self.object(a.1).instance.cmp(&self.object(b.1).instance))
        });
        let draws: Vec<Draw> = visible
            .into_iter()
            .map(|(_, index)| Draw {
                objects: index..index + 1,
                shader: ShaderKey::new(
                    &self.object(index).look,
                    Contribution::All,
                    self.is_parallel(),
                ),
                pixels: Pixels::All,
            })
            .collect();
        (!draws.is_empty()).then(|| Pass {
            kind: PassKind::Transparent,
            draws,
            volumes: Vec::new(),
            scissor: None,
            skipped: counts.list(),
        })
    }
}
