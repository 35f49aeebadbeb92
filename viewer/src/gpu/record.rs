//! From a plan to commands. Decides nothing: what is drawn, and in which order, is in the plan.

use std::ops::Range;

use glam::DVec3;
use wgpu::util::DeviceExt;

use super::binding;
use super::compute::ComputedVolumes;
use super::frame_data::PASS_STRIDE;
use super::geometry::{MeshRange, TriangleRange};
use super::pipelines::{Cull, LAYER_FLAG, PipelineKey, Stage, VolumePart};
use super::renderer::{PassReport, Renderer};
use super::shadow_map::VIEW_STRIDE;
use super::targets::Targets;
use super::volumes::{LightVolumes, VolumeRanges};
use crate::content::{LightShape, Object, Primitive};
use crate::frame::{self, Pass, PassKind, Plan, Settings};
use crate::shader::ShadowLookup;
use crate::view::{Lens, Region, View};

/// The times an object is drawn in a pass, by the faces left out: a transparent one is drawn back
/// faces first.
pub(super) fn culls(pass: &Pass, object: &Object) -> &'static [Cull] {
    let is_stroke = object.look.primitive != Primitive::Triangles;
    match (object.is_culled, pass.kind) {
        (true, _) => &[Cull::Back],
        (false, PassKind::Transparent) if !is_stroke => &[Cull::Front, Cull::Back],
        _ => &[Cull::None],
    }
}

pub(super) fn surface_key(
    pass: &Pass,
    object: &Object,
    draw: &frame::Draw,
    cull: Cull,
    samples: u32,
) -> PipelineKey {
    let stage = match pass.kind {
        PassKind::Light { tests_stencil, .. } => Stage::Add { tests_stencil },
        PassKind::Transparent => Stage::Blend,
        _ => Stage::First,
    };
    let is_stroke = object.look.primitive != Primitive::Triangles;
    PipelineKey::Surface {
        shader: draw.shader,
        stage,
        cull,
        is_mirrored: object.is_mirrored && !is_stroke,
        samples,
    }
}

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
    if !forces_z_fail && pass.volumes.iter().any(|volume| volume.is_z_pass) {
        parts.push(VolumePart::ZPassSides);
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

/// What recording a frame needs.
pub(super) struct Recorder<'a> {
    pub renderer: &'a Renderer,
    pub targets: &'a Targets,
    pub view: &'a View,
    pub region: &'a Region,
    pub settings: &'a Settings,
    pub plan: &'a Plan,
}

/// What is bound already, so that it is not bound again.
#[derive(Default)]
struct Bound<'a> {
    shadow: Option<&'a wgpu::BindGroup>,
    pipeline: Option<PipelineKey>,
    buffers: Option<(usize, [bool; 3])>,
    texture: Option<scenegraph::scene::TextureId>,
    strokes: Option<Primitive>,
}

const WHOLE: Range<u32> = 0..3;

impl Recorder<'_> {
    pub fn background(&self, encoder: &mut wgpu::CommandEncoder) {
        let [top, bottom] = self.settings.background_srgb;
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("background"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.targets.color,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color {
                        r: bottom[0],
                        g: bottom[1],
                        b: bottom[2],
                        a: 1.0,
                    }),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..wgpu::RenderPassDescriptor::default()
        });
        if top == bottom {
            return;
        }
        let key = PipelineKey::Background {
            samples: self.targets.samples,
        };
        let Some(pipeline) = self.renderer.pipelines.get(&key) else {
            return;
        };
        let mut colors = [[1.0_f32; 4]; 2];
        for (to, from) in colors.iter_mut().zip([top, bottom]) {
            for (to, from) in to.iter_mut().zip(from) {
                *to = from as f32;
            }
        }
        let device = &self.renderer.gpu.device;
        let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("gradient"),
            contents: bytemuck::cast_slice(&colors),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let group = binding::group(
            device,
            "gradient",
            &pipeline.get_bind_group_layout(0),
            vec![buffer.as_entire_binding()],
        );
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(WHOLE, 0..1);
    }

    pub fn present(&self, encoder: &mut wgpu::CommandEncoder) {
        let key = PipelineKey::Present {
            samples: self.targets.samples,
        };
        let Some(pipeline) = self.renderer.pipelines.get(&key) else {
            return;
        };
        let group = binding::group(
            &self.renderer.gpu.device,
            "present",
            &pipeline.get_bind_group_layout(0),
            vec![wgpu::BindingResource::TextureView(&self.targets.color)],
        );
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("present"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.targets.output_view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(WHOLE, 0..1);
    }

    pub fn pass(&self, encoder: &mut wgpu::CommandEncoder, pass: &Pass) -> PassReport {
        match pass.kind {
            PassKind::Volumes { light } => self.volumes(encoder, pass, light),
            PassKind::Map { light } => self.map(encoder, pass, light),
            PassKind::Rays { light } => self.rays(encoder, light),
            PassKind::First { light } => self.surfaces(encoder, pass, light.unwrap_or(0), true),
            PassKind::Light { light, .. } => self.surfaces(encoder, pass, light, false),
            PassKind::Transparent => self.surfaces(encoder, pass, 0, false),
        }
    }

    fn begin<'e>(
        &self,
        encoder: &'e mut wgpu::CommandEncoder,
        label: &str,
        has_color: bool,
        depth: Option<wgpu::Operations<f32>>,
        stencil: Option<wgpu::Operations<u32>>,
        light: u32,
    ) -> wgpu::RenderPass<'e> {
        let color = wgpu::RenderPassColorAttachment {
            view: &self.targets.color,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Load,
                store: wgpu::StoreOp::Store,
            },
        };
        let attachments = [Some(color)];
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(label),
            color_attachments: if has_color { &attachments } else { &[] },
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.targets.depth,
                depth_ops: depth,
                stencil_ops: stencil,
            }),
            ..wgpu::RenderPassDescriptor::default()
        });
        let r = self.region;
        pass.set_viewport(
            r.x as f32,
            r.y as f32,
            r.width as f32,
            r.height as f32,
            0.0,
            1.0,
        );
        pass.set_scissor_rect(r.x, r.y, r.width, r.height);
        pass.set_bind_group(0, &self.renderer.frame_data.scene_group, &[]);
        pass.set_bind_group(
            1,
            &self.renderer.frame_data.pass_group,
            &[light * PASS_STRIDE],
        );
        pass
    }

    fn surfaces(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pass: &Pass,
        light: u32,
        clears: bool,
    ) -> PassReport {
        let store = wgpu::StoreOp::Store;
        let depth = clears.then_some(wgpu::Operations {
            load: wgpu::LoadOp::Clear(0.0),
            store,
        });
        let stencil = clears.then_some(wgpu::Operations {
            load: wgpu::LoadOp::Clear(0),
            store,
        });
        let mut render_pass = self.begin(encoder, "surfaces", true, depth, stencil, light);
        let mut bound = Bound::default();
        let mut report = PassReport::default();
        if let PassKind::Light { shadow, .. } = pass.kind {
            bound.shadow = self.shadow_group(shadow, light);
        }
        cut(&mut render_pass, pass.scissor);
        for draw in &pass.draws {
            let object = &self.renderer.content.objects[draw.objects.start as usize];
            let Some(range) = self.renderer.geometry.range(object.mesh) else {
                continue;
            };
            for &cull in culls(pass, object) {
                let key = surface_key(pass, object, draw, cull, self.targets.samples);
                if !self.bind(&mut render_pass, &mut bound, key) {
                    continue;
                }
                let primitives = match range {
                    MeshRange::Triangles(range) => {
                        self.bind_triangles(&mut render_pass, &mut bound, draw, object, &range);
                        let end = range.first_index + range.index_count;
                        render_pass.draw_indexed(
                            range.first_index..end,
                            range.base_vertex,
                            draw.objects.clone(),
                        );
                        range.index_count / 3
                    }
                    MeshRange::Strokes { first, count } => {
                        let primitive = object.look.primitive;
                        if bound.strokes != Some(primitive) {
                            let at = usize::from(primitive == Primitive::Points);
                            render_pass.set_bind_group(2, &self.renderer.strokes[at], &[]);
                            bound.strokes = Some(primitive);
                            bound.texture = None;
                        }
                        render_pass.draw(6 * first..6 * (first + count), draw.objects.clone());
                        count
                    }
                };
                report.draw_calls += 1;
                report.primitives += u64::from(primitives) * draw.objects.len() as u64;
            }
        }
        report
    }

    /// False if there is no such pipeline.
    fn bind(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        bound: &mut Bound<'_>,
        key: PipelineKey,
    ) -> bool {
        if bound.pipeline == Some(key) {
            return true;
        }
        let Some(pipeline) = self.renderer.pipelines.get(&key) else {
            return false;
        };
        pass.set_pipeline(pipeline);
        if let (Some(group), PipelineKey::Surface { shader, .. }) = (bound.shadow, key) {
            if shader.texture.is_none() && shader.primitive == Primitive::Triangles {
                pass.set_bind_group(2, &self.renderer.nothing, &[]);
                bound.texture = None;
                bound.strokes = None;
            }
            pass.set_bind_group(3, group, &[]);
        }
        bound.pipeline = Some(key);
        true
    }

    fn bind_triangles(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        bound: &mut Bound<'_>,
        draw: &frame::Draw,
        object: &Object,
        range: &TriangleRange,
    ) {
        let shader = &draw.shader;
        let wanted = [
            shader.has_normals(),
            shader.texture.is_some(),
            shader.has_colors,
        ];
        if bound.buffers != Some((range.group, wanted)) {
            let group = &self.renderer.geometry.groups[range.group];
            pass.set_vertex_buffer(0, group.positions.slice(..));
            let optional = [&group.normals, &group.texcoords, &group.colors];
            for ((slot, buffer), wanted) in (1..).zip(optional).zip(wanted) {
                if let Some(buffer) = buffer.as_ref().filter(|_| wanted) {
                    pass.set_vertex_buffer(slot, buffer.slice(..));
                }
            }
            pass.set_index_buffer(group.indices.slice(..), wgpu::IndexFormat::Uint32);
            bound.buffers = Some((range.group, wanted));
        }
        if let Some(id) = object.texture
            && bound.texture != Some(id)
            && let Some(group) = self.renderer.textures.group(id)
        {
            pass.set_bind_group(2, group, &[]);
            bound.texture = Some(id);
            bound.strokes = None;
        }
    }

    fn shadow_group(&self, shadow: ShadowLookup, light: u32) -> Option<&wgpu::BindGroup> {
        match shadow {
            ShadowLookup::None => None,
            ShadowLookup::Map | ShadowLookup::CubeMap => {
                self.renderer.maps.get(&light).map(|map| &map.group)
            }
            ShadowLookup::Mask => self.renderer.rays.as_ref().map(|rays| &rays.mask_group),
        }
    }

    fn rays(&self, encoder: &mut wgpu::CommandEncoder, light: u32) -> PassReport {
        if let Some(rays) = &self.renderer.rays {
            let data = &self.renderer.frame_data;
            let size = (self.region.width, self.region.height);
            let offset = light * PASS_STRIDE;
            rays.record(encoder, &data.scene_group, &data.pass_group, offset, size);
        }
        PassReport::default()
    }

    fn map(&self, encoder: &mut wgpu::CommandEncoder, pass: &Pass, light: u32) -> PassReport {
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

    fn volumes(&self, encoder: &mut wgpu::CommandEncoder, pass: &Pass, light: u32) -> PassReport {
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

/// Leaves pixels outside of a rectangle alone.
fn cut(pass: &mut wgpu::RenderPass<'_>, rectangle: Option<[u32; 4]>) {
    if let Some([x, y, width, height]) = rectangle {
        pass.set_scissor_rect(x, y, width, height);
    }
}

/// Index of the counts of a part among those that the device made.
fn part_index(part: VolumePart) -> u64 {
    match part {
        VolumePart::ZPassSides | VolumePart::ZFailSides => 0,
        VolumePart::LightCap { is_pos } | VolumePart::DarkCap { is_pos } => {
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
        VolumePart::ZFailSides => (&ranges.z_fail_sides, 6),
        VolumePart::LightCap { is_pos: true } | VolumePart::DarkCap { is_pos: true } => {
            (&ranges.cap_pos, 3)
        }
        VolumePart::LightCap { is_pos: false } | VolumePart::DarkCap { is_pos: false } => {
            (&ranges.cap_neg, 3)
        }
    }
}
