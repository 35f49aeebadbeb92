//! Records the passes that make shadows: volumes into the stencil, depth maps, rays.

use std::ops::Range;

use glam::DVec3;

use super::compute::ComputedVolumes;
use super::frame_data::PASS_STRIDE;
use super::geometry::MeshRange;
use super::pipeline_key::{LAYER_FLAG, PipelineKey, VolumePart};
use super::record::{Recorder, WHOLE, cut};
use super::renderer::PassReport;
use super::shadow_map::VIEW_STRIDE;
use super::volumes::{LightVolumes, VolumeRanges};
use crate::content::LightShape;
use crate::frame::{Pass, PassKind, Plan, VolumeDraw};
use crate::view::{Lens, View};

/// The parts of volumes that a pass draws. A directional light needs no dark caps: at infinity
/// they are one point. `is_one_list`: the volumes of all casters stand in one list, also of those
/// that the plan left out, for which nothing proves z-pass safe.
pub(super) fn volume_parts(
    pass: &Pass,
    plan: &Plan,
    view: &View,
    is_one_list: bool,
) -> Vec<VolumePart> {
    let PassKind::Volumes { light } = pass.kind else {
        return Vec::new();
    };
    let is_parallel = matches!(view.lens, Lens::Orthographic { .. });
    let forces_z_fail = is_one_list && !is_parallel;
    let mut parts = Vec::new();
    let z_pass = || {
        pass.volumes
            .iter()
            .filter(|v| !forces_z_fail && v.is_z_pass)
    };
    if z_pass().any(|volume| volume.has_sides) {
        parts.push(VolumePart::ZPassSides);
    }
    if z_pass().any(|volume| volume.has_light_caps) {
        parts.extend([true, false].map(|is_pos| VolumePart::ZPassLightCap { is_pos }));
    }
    if forces_z_fail || pass.volumes.iter().any(|volume| !volume.is_z_pass) {
        parts.push(VolumePart::ZFailSides);
        parts.extend([true, false].map(|is_pos| VolumePart::LightCap { is_pos }));
        let shape = &plan.lights[light as usize].shape;
        if !matches!(shape, LightShape::Directional { .. }) {
            parts.extend([true, false].map(|is_pos| VolumePart::DarkCap { is_pos }));
        }
    }
    parts
}

/// The parts that are sides: caps are the scene itself, and infinity.
pub(super) fn sides(pass: &Pass, plan: &Plan, view: &View) -> Vec<VolumePart> {
    let mut parts = volume_parts(pass, plan, view, false);
    parts.retain(|part| matches!(part, VolumePart::ZPassSides | VolumePart::ZFailSides));
    parts
}

impl Recorder<'_> {
    pub(super) fn rays(&self, encoder: &mut wgpu::CommandEncoder, light: u32) -> PassReport {
        if let Some(rays) = &self.renderer.rays {
            let data = &self.renderer.frame_data;
            let size = (self.region.width, self.region.height);
            let offset = light * PASS_STRIDE;
            rays.record(encoder, &data.scene_group, &data.pass_group, offset, size);
        }
        PassReport::default()
    }

    pub(super) fn map(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pass: &Pass,
        light: u32,
    ) -> PassReport {
        let mut report = PassReport::default();
        let renderer = self.renderer;
        let pipeline = renderer.pipelines.get(&PipelineKey::Map);
        let (Some(map), Some(pipeline)) = (renderer.maps.get(&light), pipeline) else {
            return report;
        };
        for (face, view) in (0..).zip(&map.faces) {
            let mut render_pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("map"),
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(1.0),
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: None,
                }),
                ..wgpu::RenderPassDescriptor::default()
            });
            render_pass.set_pipeline(pipeline);
            render_pass.set_bind_group(0, &renderer.frame_data.scene_group, &[]);
            render_pass.set_bind_group(1, &renderer.frame_data.pass_group, &[light * PASS_STRIDE]);
            render_pass.set_bind_group(2, &map.view_group, &[face * VIEW_STRIDE]);
            let mut group = None;
            for volume in &pass.volumes {
                let object = &renderer.content.objects[volume.object as usize];
                let Some(MeshRange::Triangles(range)) = renderer.geometry.range(object.mesh) else {
                    continue;
                };
                if group != Some(range.group) {
                    let buffers = &renderer.geometry.groups[range.group];
                    render_pass.set_vertex_buffer(0, buffers.positions.slice(..));
                    let indices = buffers.indices.slice(..);
                    render_pass.set_index_buffer(indices, wgpu::IndexFormat::Uint32);
                    group = Some(range.group);
                }
                render_pass.draw_indexed(
                    range.first_index..range.first_index + range.index_count,
                    range.base_vertex,
                    volume.object..volume.object + 1,
                );
                report.draw_calls += 1;
                report.primitives += u64::from(range.index_count / 3);
            }
        }
        report
    }

    pub(super) fn volumes(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pass: &Pass,
        light: u32,
    ) -> PassReport {
        let mut report = PassReport::default();
        let Some(volumes) = self.renderer.volumes.of(light) else {
            return report;
        };
        let layers = volumes.layer_count();
        let start = self.start_of_layer(volumes, 0, pass);
        let stencil = Some(wgpu::Operations {
            load: wgpu::LoadOp::Clear(start),
            store: wgpu::StoreOp::Store,
        });
        let mut render_pass = self.begin(encoder, "volumes", false, None, stencil, light);
        cut(&mut render_pass, pass.scissor);
        let computed = self.renderer.computed(light);
        let group = computed.map_or(&volumes.group, |computed| &computed.group);
        render_pass.set_bind_group(2, group, &[]);
        for layer in 0..layers {
            if layer > 0 {
                self.next_layer(&mut render_pass, self.start_of_layer(volumes, layer, pass));
            }
            let ranges = volumes.ranges(layer, &pass.volumes);
            for part in volume_parts(pass, self.plan, self.view, computed.is_some()) {
                let key = self
                    .renderer
                    .volume_key(part, layers > 1, self.targets.samples);
                let Some(pipeline) = self.renderer.pipelines.get(&key) else {
                    continue;
                };
                render_pass.set_pipeline(pipeline);
                if let Some(computed) = computed {
                    let offset = ComputedVolumes::offset(part_index(part));
                    render_pass.draw_indirect(&computed.draws, offset);
                    report.draw_calls += 1;
                    continue;
                }
                let (list, corners) = part_ranges(&ranges, part);
                for range in list {
                    render_pass.draw(range.start * corners..range.end * corners, 0..1);
                    report.draw_calls += 1;
                    report.primitives += u64::from(corners / 3) * range.len() as u64;
                }
            }
        }
        if layers > 1 {
            self.next_layer(&mut render_pass, 0);
        }
        report
    }

    /// Draws the volumes of a light for the eye, as they were counted.
    pub(super) fn show_volumes(&self, encoder: &mut wgpu::CommandEncoder, pass: &Pass, light: u32) {
        let Some(volumes) = self.renderer.volumes.of(light) else {
            return;
        };
        let load = wgpu::LoadOp::Load;
        let store = wgpu::StoreOp::Store;
        let depth = Some(wgpu::Operations { load, store });
        let stencil = Some(wgpu::Operations {
            load: wgpu::LoadOp::Load,
            store,
        });
        let mut render_pass = self.begin(encoder, "shown volumes", true, depth, stencil, light);
        render_pass.set_bind_group(2, &volumes.group, &[]);
        // Of what is selected, or of everything.
        let selected = &self.settings.overlay.selected;
        let objects = &self.renderer.content.objects;
        let is_shown = |volume: &&VolumeDraw| {
            let instance = objects[volume.object as usize].instance;
            selected.is_empty() || selected.binary_search(&instance).is_ok()
        };
        let shown: Vec<VolumeDraw> = pass.volumes.iter().filter(is_shown).cloned().collect();
        for layer in 0..volumes.layer_count() {
            let ranges = volumes.ranges(layer, &shown);
            for part in sides(pass, self.plan, self.view) {
                let samples = self.targets.samples;
                let key = PipelineKey::ShownVolume { part, samples };
                let Some(pipeline) = self.renderer.pipelines.get(&key) else {
                    continue;
                };
                render_pass.set_pipeline(pipeline);
                let (list, corners) = part_ranges(&ranges, part);
                for range in list {
                    render_pass.draw(range.start * corners..range.end * corners, 0..1);
                }
            }
        }
    }

    /// What the stencil counts from: zero, or for a parallel projection the number of volumes that
    /// hold the point at infinity from where it looks.
    fn start_of_layer(&self, volumes: &LightVolumes, layer: usize, pass: &Pass) -> u32 {
        let (Lens::Orthographic { .. }, Some(casters)) = (self.view.lens, &self.renderer.casters)
        else {
            return 0;
        };
        let towards_viewer: DVec3 = -self.view.forward();
        let content = &self.renderer.content;
        volumes.count_at_infinity(layer, content, casters, &pass.volumes, towards_viewer)
    }

    /// Ends a layer and begins the next.
    fn next_layer(&self, pass: &mut wgpu::RenderPass<'_>, start: u32) {
        let samples = self.targets.samples;
        for (key, reference) in [
            (PipelineKey::EndLayer { samples }, LAYER_FLAG),
            (PipelineKey::BeginLayer { samples }, start),
        ] {
            // What begins at zero has ended at zero.
            let is_needed = reference != 0;
            if let Some(pipeline) = self.renderer.pipelines.get(&key).filter(|_| is_needed) {
                pass.set_pipeline(pipeline);
                pass.set_stencil_reference(reference);
                pass.draw(WHOLE, 0..1);
            }
        }
        pass.set_stencil_reference(0);
    }
}

/// Index of the counts of a part among those that the device made.
fn part_index(part: VolumePart) -> u64 {
    match part {
        VolumePart::ZPassSides | VolumePart::ZFailSides => 0,
        VolumePart::ZPassLightCap { is_pos }
        | VolumePart::LightCap { is_pos }
        | VolumePart::DarkCap { is_pos } => {
            if is_pos {
                1
            } else {
                2
            }
        }
    }
}

fn part_ranges(ranges: &VolumeRanges, part: VolumePart) -> (&[Range<u32>], u32) {
    match part {
        VolumePart::ZPassSides => (&ranges.z_pass_sides, 6),
        VolumePart::ZPassLightCap { is_pos: true } => (&ranges.z_pass_cap_pos, 3),
        VolumePart::ZPassLightCap { is_pos: false } => (&ranges.z_pass_cap_neg, 3),
        VolumePart::ZFailSides => (&ranges.z_fail_sides, 6),
        VolumePart::LightCap { is_pos: true } | VolumePart::DarkCap { is_pos: true } => {
            (&ranges.cap_pos, 3)
        }
        VolumePart::LightCap { is_pos: false } | VolumePart::DarkCap { is_pos: false } => {
            (&ranges.cap_neg, 3)
        }
    }
}
