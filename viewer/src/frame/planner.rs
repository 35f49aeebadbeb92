//! From a scene and a view to the passes of a frame, leaving out what the view does not need.
//!
//! Pass 1 draws emission, ambient light and the first light together: one without shadows in view
//! if there is one, else behind a pass for the depth and a pass that makes its shadows. A pass for
//! the depth also comes first where it is asked what lies behind (`occlusion.rs`). Each
//! further light is a pass that adds, behind its shadows. Transparent objects come last, each with
//! all its lights at once.

use std::ops::Range;

use super::cull::{self, Frustum};
use super::lists::{Counts, Draws};
use super::needs::Needed;
use super::plan::{Draw, Pass, PassKind, Pixels, Plan, SkipReason};
use super::settings::{Headlight, Settings, Shadows};
use crate::content::{Content, LightShape, Look, Object, WorldLight};
use crate::shader::{Contribution, LightKey, ShaderKey, ShadowLookup};
use crate::view::{Lens, Region, View};

/// What passes are planned from.
pub struct Planner<'a> {
    pub(super) content: &'a Content,
    pub(super) view: &'a View,
    pub(super) region: &'a Region,
    pub(super) settings: &'a Settings,
    pub(super) near: f64,
    pub(super) frustum: Frustum,
    is_visible: Vec<bool>,
    pub(super) lights: Vec<WorldLight>,
    headlight: Option<u32>,
    tests_occlusion: bool,
}

/// Plans a frame. `near` is the distance of the near plane of a perspective. With
/// `tests_occlusion` it begins with a pass for the depth in any case; pass 1 begins anew where it
/// needs none, so that it draws surfaces in one place in the same order.
pub fn plan(
    content: &Content,
    view: &View,
    region: &Region,
    near: f64,
    settings: &Settings,
    tests_occlusion: bool,
) -> Plan {
    let frustum = Frustum::new(view, region.aspect);
    let mut lights = content.lights.clone();
    let has_headlight = match settings.headlight {
        Headlight::Off => false,
        Headlight::WhenAlone => lights.is_empty(),
        Headlight::On => true,
    };
    let headlight = has_headlight.then(|| {
        lights.push(headlight(view));
        lights.len() as u32 - 1
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
            .map(|object| !object.is_hidden && frustum.may_see(&object.bounds))
            .collect(),
        frustum,
        lights,
        headlight,
        tests_occlusion,
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
            if self.tests_occlusion {
                passes.push(self.depth());
            }
            passes.push(self.first(None, ShadowLookup::None, false, false));
        } else {
            self.first_passes(needed.remove(first), &mut passes);
        }
        for need in needed {
            self.light_passes(need, &mut passes);
        }
        passes.extend(self.transparent());
        // Pass 1 clears the depth for what follows, also where it draws nothing.
        passes.retain(|pass| {
            let is_first = matches!(pass.kind, PassKind::First { .. });
            is_first || !pass.draws.is_empty() || !pass.volumes.is_empty()
        });
        Plan {
            passes,
            lights: self.lights,
            skipped_lights,
        }
    }

    pub(super) fn opaque(&self) -> Range<u32> {
        0..self.content.opaque_count() as u32
    }

    pub(super) fn object(&self, index: u32) -> &Object {
        &self.content.objects[index as usize]
    }

    fn is_in_scope(&self, light: u32, object: &Object) -> bool {
        self.headlight == Some(light)
            || self.content.light_sets[object.light_set as usize]
                .binary_search(&light)
                .is_ok()
    }

    /// Why an object is not in the pass of a light.
    pub(super) fn unlit_reason(&self, light: u32, index: u32) -> Option<SkipReason> {
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

    fn key(&self, look: &Look, contribution: Contribution) -> ShaderKey {
        let is_cut = self.settings.section.is_some();
        ShaderKey::new(look, contribution, self.is_parallel()).cut(is_cut)
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
        if has_depth || self.tests_occlusion {
            passes.push(self.depth());
        }
        passes.extend(shadow_pass);
        // A shader can ask the stencil for one sample a pixel; else the stencil test parts the
        // pixels, and what is lit is drawn twice.
        let asks = has_volumes && self.settings.samples == 1;
        let shadow = if asks { ShadowLookup::Stencil } else { shadow };
        passes.push(self.first(Some(need.light), shadow, has_depth, has_volumes && !asks));
    }

    fn depth(&self) -> Pass {
        let mut draws = Draws::default();
        for index in self.opaque().filter(|&i| self.is_visible[i as usize]) {
            let object = self.object(index);
            let key = self.key(&object.look, Contribution::Depth);
            draws.add(index, object, key, Pixels::All);
        }
        Pass {
            kind: PassKind::Depth { begins: true },
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
        parts_pixels: bool,
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
            let key = |light| self.key(&object.look, Contribution::First(light));
            let light = light
                .filter(|&light| self.unlit_reason(light, index).is_none())
                .map(|light| LightKey::of(&self.lights[light as usize], shadow));
            if light.is_some() && parts_pixels {
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
            let key = self.key(&object.look, Contribution::Light(key));
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
                shader: self.key(&self.object(index).look, Contribution::All),
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
