//! Draws what is over the picture: buffers of segments and caps, kept as long as their lists are
//! the same, and the commands. What there is to draw is decided by `overlay`.

use wgpu::util::DeviceExt;

use super::device::Gpu;
use super::geometry::MeshRange;
use super::pipeline_key::{FlatKind, PipelineKey};
use super::record::Recorder;
use super::record_shadows::sides;
use crate::content::Primitive;
use crate::frame::{PassKind, Plan, Settings};
use crate::overlay::{Corner, Overlay, Segment, Shared};
use crate::view::View;

/// A list on the device.
struct Uploaded<T> {
    list: Shared<T>,
    buffer: wgpu::Buffer,
}

impl<T: bytemuck::Pod> Uploaded<T> {
    fn new(gpu: &Gpu, list: &Shared<T>) -> Self {
        let descriptor = wgpu::util::BufferInitDescriptor {
            label: Some("overlay"),
            contents: bytemuck::cast_slice(&list.0),
            usage: wgpu::BufferUsages::VERTEX,
        };
        Self {
            list: list.clone(),
            buffer: gpu.device.create_buffer_init(&descriptor),
        }
    }

    fn keep(slot: &mut Option<Self>, gpu: &Gpu, list: &Shared<T>) {
        if list.0.is_empty() {
            *slot = None;
        } else if slot.as_ref().is_none_or(|there| there.list != *list) {
            *slot = Some(Self::new(gpu, list));
        }
    }
}

/// Lists on the device.
#[derive(Default)]
pub struct OverlayBuffers {
    segments: Option<Uploaded<Segment>>,
    caps: Option<Uploaded<Corner>>,
}

impl OverlayBuffers {
    /// Brings the lists of an overlay to the device, unless they are there.
    pub fn prepare(&mut self, gpu: &Gpu, overlay: &Overlay) {
        Uploaded::keep(&mut self.segments, gpu, &overlay.segments);
        Uploaded::keep(&mut self.caps, gpu, &overlay.caps);
    }
}

/// The kinds of drawing that an overlay needs, in their order: what hides first.
fn kinds(overlay: &Overlay, gpu: &Gpu) -> Vec<FlatKind> {
    let has_selection = !overlay.selected.is_empty();
    let kinds = [
        (!overlay.caps.0.is_empty(), FlatKind::Cap),
        (has_selection, FlatKind::TintBehind),
        (has_selection, FlatKind::Tint),
        (overlay.has_wireframe && gpu.has_wireframe, FlatKind::Wire),
        (overlay.has_corners && gpu.has_points, FlatKind::Point),
        (!overlay.segments.0.is_empty(), FlatKind::Segment),
    ];
    let kinds = kinds.into_iter().filter(|(is_needed, _)| *is_needed);
    kinds.map(|(_, kind)| kind).collect()
}

/// The pipelines that the overlay of a frame needs.
pub fn keys(plan: &Plan, view: &View, settings: &Settings, gpu: &Gpu) -> Vec<PipelineKey> {
    let samples = settings.samples;
    let mut keys: Vec<PipelineKey> = kinds(&settings.overlay, gpu)
        .into_iter()
        .map(|kind| PipelineKey::Flat { kind, samples })
        .collect();
    if settings.overlay.has_volumes {
        for pass in &plan.passes {
            for part in sides(pass, plan, view) {
                keys.push(PipelineKey::ShownVolume { part, samples });
            }
        }
    }
    keys
}

impl Recorder<'_> {
    /// Draws everything over the picture.
    pub fn overlay(&self, encoder: &mut wgpu::CommandEncoder) {
        let overlay = &self.settings.overlay;
        if overlay.is_empty() {
            return;
        }
        if overlay.has_volumes {
            for pass in &self.plan.passes {
                if let PassKind::Volumes { light } = pass.kind {
                    self.show_volumes(encoder, pass, light);
                }
            }
        }
        let depth = Some(wgpu::Operations {
            load: wgpu::LoadOp::Load,
            store: wgpu::StoreOp::Store,
        });
        let stencil = Some(wgpu::Operations {
            load: wgpu::LoadOp::Load,
            store: wgpu::StoreOp::Store,
        });
        let mut pass = self.begin(encoder, "overlay", true, depth, stencil, 0);
        for kind in kinds(overlay, &self.renderer.gpu) {
            let samples = self.targets.samples;
            let Some(pipeline) = self
                .renderer
                .pipelines
                .get(&PipelineKey::Flat { kind, samples })
            else {
                continue;
            };
            pass.set_pipeline(pipeline);
            let buffers = &self.renderer.overlay;
            match kind {
                FlatKind::Segment => {
                    if let Some(segments) = &buffers.segments {
                        pass.set_vertex_buffer(0, segments.buffer.slice(..));
                        pass.draw(0..6, 0..segments.list.0.len() as u32);
                    }
                }
                FlatKind::Cap => {
                    if let Some(caps) = &buffers.caps {
                        pass.set_vertex_buffer(0, caps.buffer.slice(..));
                        pass.draw(0..caps.list.0.len() as u32, 0..1);
                    }
                }
                FlatKind::Tint | FlatKind::TintBehind => self.flat(&mut pass, true),
                FlatKind::Wire | FlatKind::Point => self.flat(&mut pass, false),
            }
        }
    }

    /// The triangles of objects, of all that are shown or of those that are selected.
    fn flat(&self, pass: &mut wgpu::RenderPass<'_>, only_selected: bool) {
        let selected = &self.settings.overlay.selected;
        let mut group = None;
        for (index, object) in (0..).zip(&self.renderer.content.objects) {
            let is_wanted = !only_selected || selected.binary_search(&object.instance).is_ok();
            if object.is_hidden || !is_wanted || object.look.primitive != Primitive::Triangles {
                continue;
            }
            let Some(MeshRange::Triangles(range)) = self.renderer.geometry.range(object.mesh)
            else {
                continue;
            };
            if group != Some(range.group) {
                let buffers = &self.renderer.geometry.groups[range.group];
                pass.set_vertex_buffer(0, buffers.positions.slice(..));
                pass.set_index_buffer(buffers.indices.slice(..), wgpu::IndexFormat::Uint32);
                group = Some(range.group);
            }
            pass.draw_indexed(
                range.first_index..range.first_index + range.index_count,
                range.base_vertex,
                index..index + 1,
            );
        }
    }
}
