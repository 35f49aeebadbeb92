//! What a plan needs on the device before it is recorded: shadows, and pipelines.

use glam::DVec4;

use super::casters::Casters;
use super::compute::{ComputedVolumes, Extractor};
use super::overlay;
use super::pipeline_key::{PipelineKey, VolumePart};
use super::rays::{Hierarchy, Rays};
use super::record::{culls, surface_key};
use super::record_shadows::volume_parts;
use super::renderer::Renderer;
use super::shadow_map::ShadowMap;
use crate::content::WorldLight;
use crate::frame::{Extraction, PassKind, Plan, Settings, Shadows, VolumeMethod};
use crate::view::View;

impl Renderer {
    pub(super) fn prepare_shadows(&mut self, plan: &Plan, view: &View, settings: &Settings) {
        self.maps.clear();
        for pass in &plan.passes {
            match (pass.kind, settings.shadows) {
                (PassKind::Volumes { light }, Shadows::Volumes { method, extraction }) => {
                    let world_light = &plan.lights[light as usize];
                    self.prepare_volumes(light, world_light, method, extraction);
                }
                (PassKind::Map { light }, Shadows::Map { size }) => {
                    let map = ShadowMap::new(
                        &self.gpu,
                        &self.layouts,
                        &self.content,
                        &plan.lights[light as usize],
                        view.eye,
                        size,
                    );
                    self.maps.insert(light, map);
                }
                (PassKind::Rays { .. }, _) => self.prepare_rays(),
                _ => {}
            }
        }
    }

    fn prepare_volumes(
        &mut self,
        light: u32,
        world_light: &WorldLight,
        method: VolumeMethod,
        extraction: Extraction,
    ) {
        let (gpu, content) = (&self.gpu, &self.content);
        let casters = self
            .casters
            .get_or_insert_with(|| Casters::upload(gpu, &self.scene, content));
        let indexed = (light, world_light);
        self.volumes
            .prepare(gpu, &self.layouts, content, casters, indexed, method);
        let computes = method == VolumeMethod::Silhouette
            && match extraction {
                Extraction::Auto => !gpu.is_software(),
                Extraction::Cpu => false,
                Extraction::Compute => true,
            };
        let is_layered = self
            .volumes
            .of(light)
            .is_some_and(|volumes| volumes.layer_count() > 1);
        if !computes || is_layered {
            self.computed.remove(&light);
            return;
        }
        let is_kept = self
            .computed
            .get(&light)
            .is_some_and(|(shape, _)| *shape == world_light.shape);
        if !is_kept {
            let extractor = self.extractor.get_or_insert_with(|| Extractor::new(gpu));
            let made = extractor.extract(gpu, &self.layouts.volumes, content, casters, world_light);
            self.computed.insert(light, (world_light.shape, made));
        }
    }

    fn prepare_rays(&mut self) {
        let Some(targets) = &self.targets else {
            return;
        };
        match &mut self.rays {
            Some(rays) if rays.fits(targets) => {}
            Some(rays) if rays.samples() == targets.samples => {
                rays.refit(&self.gpu, &self.layouts, targets);
            }
            _ => {
                let origin = self.content.bounds.center();
                let hierarchy = Hierarchy::new(&self.scene, &self.content, origin);
                self.rays = Some(Rays::new(&self.gpu, &self.layouts, &hierarchy, targets));
            }
        }
    }

    /// Where the volumes of each light end; zero where they do not.
    pub(super) fn far_planes(&self, plan: &Plan) -> Vec<DVec4> {
        (0..plan.lights.len() as u32)
            .map(|light| {
                let volumes = self.volumes.of(light);
                volumes
                    .and_then(|volumes| volumes.far_plane)
                    .unwrap_or_default()
            })
            .collect()
    }

    /// The volumes of a light that the device made, if it did.
    pub(super) fn computed(&self, light: u32) -> Option<&ComputedVolumes> {
        self.computed.get(&light).map(|(_, volumes)| volumes)
    }

    pub(super) fn prepare_pipelines(&mut self, plan: &Plan, view: &View, settings: &Settings) {
        let samples = settings.samples;
        let mut keys = vec![PipelineKey::Present { samples }];
        if settings.background_srgb[0] != settings.background_srgb[1] {
            keys.push(PipelineKey::Background { samples });
        }
        for pass in &plan.passes {
            for draw in &pass.draws {
                let object = &self.content.objects[draw.objects.start as usize];
                for &cull in culls(pass, object) {
                    keys.push(surface_key(pass, object, draw, cull, samples));
                }
            }
            let PassKind::Volumes { light } = pass.kind else {
                if let PassKind::Map { .. } = pass.kind {
                    keys.push(PipelineKey::Map);
                }
                continue;
            };
            let layers = self.volumes.of(light).map_or(1, |v| v.layer_count());
            for part in volume_parts(pass, plan, view, self.computed(light).is_some()) {
                keys.push(self.volume_key(part, layers > 1, samples));
            }
            if layers > 1 {
                keys.push(PipelineKey::EndLayer { samples });
                keys.push(PipelineKey::BeginLayer { samples });
            }
        }
        keys.extend(overlay::keys(plan, view, settings, &self.gpu));
        for key in keys {
            self.pipelines.prepare(&self.gpu, &self.layouts, key);
        }
    }

    pub(super) fn volume_key(
        &self,
        part: VolumePart,
        is_layered: bool,
        samples: u32,
    ) -> PipelineKey {
        PipelineKey::Volume {
            part,
            is_unclipped: part == VolumePart::ZPassSides && self.gpu.has_depth_clip_control,
            is_layered,
            samples,
        }
    }
}
