//! From a plan to commands. Decides nothing: what is drawn, and in which order, is in the plan.

use std::ops::Range;

use wgpu::util::DeviceExt;

use super::binding;
use super::frame_data::PASS_STRIDE;
use super::geometry::{MeshRange, TriangleRange};
use super::pipeline_key::{Cull, PipelineKey, Stage};
use super::renderer::{PassReport, Renderer};
use super::targets::Targets;
use crate::content::{Object, Primitive};
use crate::frame::{self, Pass, PassKind, Plan, Settings};
use crate::shader::ShadowLookup;
use crate::view::{Region, View};

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
        PassKind::Depth { .. } => Stage::Depth,
        PassKind::First {
            has_depth: true, ..
        } => Stage::FirstAtDepth,
        PassKind::Light { .. } => Stage::Add,
        PassKind::Transparent => Stage::Blend,
        _ => Stage::First,
    };
    let is_stroke = object.look.primitive != Primitive::Triangles;
    PipelineKey::Surface {
        shader: draw.shader,
        stage,
        pixels: draw.pixels,
        cull,
        is_mirrored: object.is_mirrored && !is_stroke,
        samples,
    }
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

/// The vertices of a triangle over the whole image.
pub(super) const WHOLE: Range<u32> = 0..3;

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
            PassKind::First { light, .. } => self.surfaces(encoder, pass, light.unwrap_or(0)),
            PassKind::Light { light, .. } => self.surfaces(encoder, pass, light),
            PassKind::Depth { .. } | PassKind::Transparent => self.surfaces(encoder, pass, 0),
        }
    }

    pub(super) fn begin<'e>(
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

    fn surfaces(&self, encoder: &mut wgpu::CommandEncoder, pass: &Pass, light: u32) -> PassReport {
        let store = wgpu::StoreOp::Store;
        let begins = matches!(
            pass.kind,
            PassKind::Depth { begins: true }
                | PassKind::First {
                    has_depth: false,
                    ..
                }
        );
        let goes_on = pass.kind == PassKind::Depth { begins: false };
        let depth = (begins || goes_on).then_some(wgpu::Operations {
            load: if begins {
                wgpu::LoadOp::Clear(0.0)
            } else {
                wgpu::LoadOp::Load
            },
            store,
        });
        let load = match pass.kind {
            PassKind::Light {
                has_volumes: false, ..
            } => wgpu::LoadOp::Clear(0),
            _ if begins => wgpu::LoadOp::Clear(0),
            _ => wgpu::LoadOp::Load,
        };
        let writes_stencil = begins || goes_on || matches!(pass.kind, PassKind::Light { .. });
        let stencil = writes_stencil.then_some(wgpu::Operations { load, store });
        let has_color = !matches!(pass.kind, PassKind::Depth { .. });
        let mut render_pass = self.begin(encoder, "surfaces", has_color, depth, stencil, light);
        let mut bound = Bound::default();
        let mut report = PassReport::default();
        if let PassKind::First { shadow, .. } | PassKind::Light { shadow, .. } = pass.kind {
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
            ShadowLookup::Stencil => self.renderer.stencil.as_ref(),
        }
    }
}

/// Leaves pixels outside of a rectangle alone.
pub(super) fn cut(pass: &mut wgpu::RenderPass<'_>, rectangle: Option<[u32; 4]>) {
    if let Some([x, y, width, height]) = rectangle {
        pass.set_scissor_rect(x, y, width, height);
    }
}
