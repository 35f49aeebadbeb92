//! Asks the device which objects lie behind what is drawn: the farthest depth of each tile of the
//! image is compared with the nearest one of each box. Conservative in all roundings.
//!
//! Not asked where it cannot pay: in small scenes, and for some pictures after one in which little
//! was hidden.

use bytemuck::{Pod, Zeroable};

use super::binding::{self, STORAGE, UNIFORM};
use super::device::{Gpu, GpuError};
use super::targets::Targets;
use crate::content::{Content, Object, Primitive};
use crate::frame::{Occlusion, Settings};
use crate::shader::{self, Frame};
use crate::view::{Lens, Region, View};

/// Fewer primitives are drawn in less time than the device takes to answer.
const LEAST_PRIMITIVES: u64 = 400_000;
/// In fewer objects little can be left out.
const LEAST_OBJECTS: usize = 64;
/// Where less of all primitives is hidden, asking costs more than it saves.
const LEAST_SHARE: f64 = 0.1;
/// Pictures drawn then before it is asked again.
const PAUSE: u32 = 30;
/// Pixels along an edge of a tile, as in the shader.
const TILE: u32 = 8;
/// Workgroups along one axis at most.
const MAX_ROW: u32 = 32_768;
/// Roundings of places in f32, of boxes and of the vertices in them, as a share of the lengths that
/// are added up: each sum is of a few.
const BOX_SHARE: f64 = 6.0 * f32::EPSILON as f64;
/// A share of the depth: lines and points are drawn 2^-13 nearer than they are, and as much again is
/// far more than the roundings of a product with a matrix and of an interpolated depth.
const DEPTH_SHARE: f32 = 1.0 / 4096.0;
/// The same for parallel views, whose depth is a difference of numbers of up to some hundreds.
const PARALLEL_DEPTH: f32 = 2e-4;

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Test {
    clip_from_rel: [[f32; 4]; 4],
    sizes: [u32; 4],
    margins: [f32; 4],
    count: [u32; 4],
}

/// What asks, and what it was told last.
#[derive(Default)]
pub struct OcclusionTest {
    kernels: Option<Kernels>,
    /// By object, from the last picture: where to begin. Empty at first.
    hidden: Vec<bool>,
    pause: u32,
    /// A picture of these objects was drawn. The first is not kept waiting.
    has_begun: bool,
}

struct Kernels {
    samples: u32,
    layout: wgpu::BindGroupLayout,
    farthest: wgpu::ComputePipeline,
    ask: wgpu::ComputePipeline,
}

impl OcclusionTest {
    /// Objects may have other numbers, or be others.
    pub fn forget(&mut self) {
        self.hidden.clear();
        self.pause = 0;
        self.has_begun = false;
    }

    /// Whether to ask for this picture.
    pub fn is_wanted(
        &mut self,
        content: &Content,
        settings: &Settings,
        region: &Region,
        size: (u32, u32),
    ) -> bool {
        // Parts of a larger picture are drawn once. Volumes are shown of all lights, also of those
        // that reach nothing in sight.
        let is_whole = (region.x, region.y) == (0, 0) && (region.width, region.height) == size;
        if !is_whole || settings.overlay.has_volumes {
            return false;
        }
        match settings.occlusion {
            Occlusion::Off => false,
            Occlusion::On => true,
            Occlusion::Auto => {
                let is_first = !std::mem::replace(&mut self.has_begun, true);
                if is_first || self.pause > 0 {
                    self.pause = self.pause.saturating_sub(1);
                    return false;
                }
                let primitives = content.objects.iter().map(|o| u64::from(o.primitives));
                content.objects.len() >= LEAST_OBJECTS
                    && primitives.sum::<u64>() >= LEAST_PRIMITIVES
            }
        }
    }

    /// The objects that the last answer hid.
    pub fn hidden(&self) -> &[bool] {
        &self.hidden
    }

    /// Submits what was recorded, asks about objects, waits, and keeps the answer.
    pub fn ask(
        &mut self,
        gpu: &Gpu,
        targets: &Targets,
        content: &Content,
        objects: &[u32],
        (view, frame): (&View, &Frame),
        mut encoder: wgpu::CommandEncoder,
    ) -> Result<(), GpuError> {
        if objects.is_empty() {
            gpu.queue.submit([encoder.finish()]);
            return Ok(());
        }
        let boxes: Vec<[[f32; 4]; 2]> = objects
            .iter()
            .map(|&i| rel_box(&content.objects[i as usize], view))
            .collect();
        let test = test(content, targets, view, frame, boxes.len() as u32);
        let stored = |label, size: u64, usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let bytes = 4 * boxes.len() as u64;
        let [_, _, columns, rows] = test.sizes;
        let storage = wgpu::BufferUsages::STORAGE;
        let copied = wgpu::BufferUsages::COPY_DST;
        let values = stored(
            "occlusion test",
            size_of::<Test>() as u64,
            wgpu::BufferUsages::UNIFORM | copied,
        );
        let tiles = stored(
            "farthest depths",
            4 * u64::from(columns) * u64::from(rows),
            storage,
        );
        let asked = stored("boxes", 32 * boxes.len() as u64, storage | copied);
        let seen = stored("seen", bytes, storage | wgpu::BufferUsages::COPY_SRC);
        let answer = stored("answer", bytes, wgpu::BufferUsages::MAP_READ | copied);
        gpu.queue
            .write_buffer(&values, 0, bytemuck::bytes_of(&test));
        gpu.queue
            .write_buffer(&asked, 0, bytemuck::cast_slice(&boxes));
        let kernels = match self.kernels.take() {
            Some(kernels) if kernels.samples == targets.samples => kernels,
            _ => Kernels::new(gpu, targets.samples),
        };
        let kernels = self.kernels.insert(kernels);
        let group = binding::group(
            &gpu.device,
            "occlusion",
            &kernels.layout,
            vec![
                values.as_entire_binding(),
                wgpu::BindingResource::TextureView(&targets.depth_only),
                tiles.as_entire_binding(),
                asked.as_entire_binding(),
                seen.as_entire_binding(),
            ],
        );
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_bind_group(0, &group, &[]);
            pass.set_pipeline(&kernels.farthest);
            pass.dispatch_workgroups(columns.div_ceil(8), rows.div_ceil(8), 1);
            let count = test.count[0];
            pass.set_pipeline(&kernels.ask);
            pass.dispatch_workgroups(count.min(MAX_ROW), count.div_ceil(MAX_ROW), 1);
        }
        encoder.copy_buffer_to_buffer(&seen, 0, &answer, 0, bytes);
        gpu.queue.submit([encoder.finish()]);
        answer.map_async(wgpu::MapMode::Read, .., |_| {});
        let failed = |error: &dyn std::fmt::Display| GpuError::Device(error.to_string());
        gpu.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| failed(&error))?;
        gpu.check()?;
        let mapped = answer
            .get_mapped_range(..)
            .map_err(|error| failed(&error))?;
        self.keep(content, objects, bytemuck::cast_slice(&mapped));
        Ok(())
    }

    fn keep(&mut self, content: &Content, objects: &[u32], seen: &[u32]) {
        self.hidden.clear();
        self.hidden.resize(content.objects.len(), false);
        let (mut all, mut saved) = (0, 0);
        for (&object, &seen) in objects.iter().zip(seen) {
            let primitives = u64::from(content.objects[object as usize].primitives);
            all += primitives;
            if seen == 0 {
                self.hidden[object as usize] = true;
                saved += primitives;
            }
        }
        if (saved as f64) < LEAST_SHARE * all as f64 {
            self.pause = PAUSE;
        }
    }
}

impl Kernels {
    fn new(gpu: &Gpu, samples: u32) -> Self {
        let compute = wgpu::ShaderStages::COMPUTE;
        let written = wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: false },
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let depth = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Depth,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: samples > 1,
        };
        let bindings = [UNIFORM, depth, written, STORAGE, written].map(|kind| (compute, kind));
        let layout = binding::layout(&gpu.device, "occlusion", &bindings);
        let module = gpu
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("occlusion"),
                source: wgpu::ShaderSource::Wgsl(shader::emit_occlusion(samples).into()),
            });
        let pipeline_layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("occlusion"),
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            });
        let pipeline = |entry_point| {
            gpu.device
                .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(entry_point),
                    layout: Some(&pipeline_layout),
                    module: &module,
                    entry_point: Some(entry_point),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    cache: None,
                })
        };
        Self {
            samples,
            farthest: pipeline("farthest"),
            ask: pipeline("ask"),
            layout,
        }
    }
}

/// A box around the box, in f32 relative to the eye: centre and half size.
fn rel_box(object: &Object, view: &View) -> [[f32; 4]; 2] {
    let center = object.bounds.center() - view.eye;
    let half = object.bounds.size() * 0.5;
    // Vertices are turned around the mesh's own origin, which may be far from them.
    let origin = object.world_from_mesh.translation - view.eye;
    let reach = center.abs().max_element() + half.max_element();
    let margin = BOX_SHARE * (reach + origin.abs().max_element());
    [
        center.extend(0.0).as_vec4().to_array(),
        (half + margin).extend(0.0).as_vec4().to_array(),
    ]
}

fn test(content: &Content, targets: &Targets, view: &View, frame: &Frame, count: u32) -> Test {
    let strokes = content
        .objects
        .iter()
        .filter(|object| object.look.primitive != Primitive::Triangles)
        .map(|object| &content.surfaces[object.surface as usize])
        .map(|surface| surface.line_width_px.max(surface.point_size_px));
    let widest_px = strokes.fold(0.0, f64::max) as f32;
    let is_parallel = matches!(view.lens, Lens::Orthographic { .. });
    Test {
        clip_from_rel: frame.clip_from_rel,
        sizes: [
            targets.width,
            targets.height,
            targets.width.div_ceil(TILE),
            targets.height.div_ceil(TILE),
        ],
        margins: [
            widest_px + 1.0,
            DEPTH_SHARE,
            if is_parallel { PARALLEL_DEPTH } else { 0.0 },
            0.0,
        ],
        count: [count, 0, 0, 0],
    }
}
