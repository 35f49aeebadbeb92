//! Shadow volumes by compute shaders: the same entries as on the CPU, in any order, with draws
//! that the device itself counts.
//!
//! Facing is decided in f32 here, once for each triangle and stored, so sides and caps agree
//! whatever the rounding. Which signs cast is decided on the CPU, once for each component.

use bytemuck::{Pod, Zeroable};

use super::binding::{self, STORAGE, UNIFORM};
use super::casters::{Casters, storage};
use super::device::Gpu;
use super::volumes::light_in_mesh;
use crate::content::{Content, WorldLight};
use crate::shader;
use crate::volume::{CastRule, component_signs};

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Job {
    light: [f32; 4],
    triangles: [u32; 4],
    edges: [u32; 4],
}

/// Threads of a workgroup.
const GROUP: u32 = 64;
/// Bytes of the counts of one draw.
const DRAW_BYTES: u64 = 16;
/// Workgroups along one axis at most.
const MAX_ROW: u32 = 32_768;

/// The two kernels.
pub struct Extractor {
    layouts: [wgpu::BindGroupLayout; 2],
    face: wgpu::ComputePipeline,
    side: wgpu::ComputePipeline,
}

/// The volumes of one light, as the device made them.
pub struct ComputedVolumes {
    /// Group 2 while drawing.
    pub group: wgpu::BindGroup,
    /// Counts of sides, caps that face the light, caps that face away.
    pub draws: wgpu::Buffer,
}

impl ComputedVolumes {
    /// Offset of the counts of a part: 0 sides, 1 and 2 caps.
    pub fn offset(part: u64) -> u64 {
        part * DRAW_BYTES
    }
}

impl Extractor {
    /// Makes the kernels.
    pub fn new(gpu: &Gpu) -> Self {
        let compute = wgpu::ShaderStages::COMPUTE;
        let written = wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: false },
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let mut bindings = vec![(compute, STORAGE); 7];
        bindings.extend([(compute, written); 3]);
        let layouts = [
            binding::layout(&gpu.device, "extract", &bindings),
            binding::layout(&gpu.device, "places", &[(compute, UNIFORM)]),
        ];
        let module = gpu
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("extract"),
                source: wgpu::ShaderSource::Wgsl(shader::EXTRACT.into()),
            });
        let layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("extract"),
                bind_group_layouts: &[Some(&layouts[0]), Some(&layouts[1])],
                immediate_size: 0,
            });
        let pipeline = |entry_point| {
            gpu.device
                .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(entry_point),
                    layout: Some(&layout),
                    module: &module,
                    entry_point: Some(entry_point),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    cache: None,
                })
        };
        Self {
            face: pipeline("face"),
            side: pipeline("side"),
            layouts,
        }
    }

    /// Records and submits the extraction of a light's volumes.
    pub fn extract(
        &self,
        gpu: &Gpu,
        volumes: &wgpu::BindGroupLayout,
        content: &Content,
        casters: &Casters,
        light: &WorldLight,
    ) -> ComputedVolumes {
        let work = Work::new(content, casters, light);
        let [positions, edges, triangles, refs] = casters.buffers();
        let written = |label, size: u64, usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: size.max(16),
                usage: usage | wgpu::BufferUsages::STORAGE,
                mapped_at_creation: false,
            })
        };
        // A triangle gives at most three sides and one cap.
        let most = u64::from(work.triangle_count);
        let facings = written("facings", most * 4, wgpu::BufferUsages::empty());
        let entries = written("entries", most * 5 * 8, wgpu::BufferUsages::empty());
        use wgpu::util::DeviceExt;
        let count = work.triangle_count;
        let first = [0, 3 * count, 4 * count];
        let counts: Vec<u32> = [6, 3, 3]
            .into_iter()
            .zip(first)
            .flat_map(|(corners, first)| [0, 1, corners * first, 0])
            .collect();
        let draws = gpu
            .device
            .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("volume draws"),
                contents: bytemuck::cast_slice(&counts),
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::INDIRECT,
            });
        let places = gpu
            .device
            .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("places"),
                contents: bytemuck::cast_slice(&[3 * count, 4 * count, work.side_groups_at, 0]),
                usage: wgpu::BufferUsages::UNIFORM,
            });
        let jobs = storage(gpu, "jobs", bytemuck::cast_slice(&work.jobs));
        let groups = storage(gpu, "groups", bytemuck::cast_slice(&work.groups));
        let casting = storage(gpu, "casting", bytemuck::cast_slice(&work.casting));
        let buffers = [
            positions, edges, triangles, refs, &jobs, &groups, &casting, &facings, &entries, &draws,
        ];
        let group = binding::group(
            &gpu.device,
            "extract",
            &self.layouts[0],
            buffers.map(wgpu::Buffer::as_entire_binding).into(),
        );
        let places_group = binding::group(
            &gpu.device,
            "places",
            &self.layouts[1],
            vec![places.as_entire_binding()],
        );
        let mut encoder = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_bind_group(0, &group, &[]);
            pass.set_bind_group(1, &places_group, &[]);
            let face_groups = work.side_groups_at;
            let side_groups = work.groups.len() as u32 - face_groups;
            for (pipeline, count) in [(&self.face, face_groups), (&self.side, side_groups)] {
                if count > 0 {
                    pass.set_pipeline(pipeline);
                    pass.dispatch_workgroups(count.min(MAX_ROW), count.div_ceil(MAX_ROW), 1);
                }
            }
        }
        gpu.queue.submit([encoder.finish()]);
        ComputedVolumes {
            group: binding::group(
                &gpu.device,
                "computed volumes",
                volumes,
                [positions, edges, triangles, &entries]
                    .map(wgpu::Buffer::as_entire_binding)
                    .into(),
            ),
            draws,
        }
    }
}

/// What the kernels are told.
#[derive(Default)]
struct Work {
    jobs: Vec<Job>,
    /// For triangles, then for edges.
    groups: Vec<[u32; 2]>,
    side_groups_at: u32,
    casting: Vec<u32>,
    triangle_count: u32,
}

impl Work {
    fn new(content: &Content, casters: &Casters, light: &WorldLight) -> Self {
        let mut work = Self::default();
        for (index, object) in (0..).zip(&content.objects) {
            if !object.is_caster() {
                continue;
            }
            let Some((mesh, base)) = casters.mesh(object.mesh) else {
                continue;
            };
            let light = light_in_mesh(&light.shape, &object.world_from_mesh);
            let signs = component_signs(mesh, light, object.is_mirrored, CastRule::default());
            let count = mesh.triangles.len() as u32;
            work.jobs.push(Job {
                light: light.as_vec4().to_array(),
                triangles: [base.triangle, count, work.triangle_count, index],
                edges: [
                    base.edge,
                    mesh.edges.len() as u32,
                    work.casting.len() as u32,
                    u32::from(object.is_mirrored),
                ],
            });
            work.casting.extend(signs.into_iter().map(u32::from));
            work.triangle_count += count;
        }
        let jobs = std::mem::take(&mut work.jobs);
        work.add_groups(jobs.iter().map(|job| job.triangles[1]));
        work.side_groups_at = work.groups.len() as u32;
        work.add_groups(jobs.iter().map(|job| job.edges[1]));
        work.jobs = jobs;
        work
    }

    /// Workgroups for each job's items; filled up so that the rows of a dispatch are full.
    fn add_groups(&mut self, counts: impl Iterator<Item = u32>) {
        let start = self.groups.len();
        for (job, count) in (0..).zip(counts) {
            let firsts = (0..count).step_by(GROUP as usize);
            self.groups.extend(firsts.map(|first| [job, first]));
        }
        let made = (self.groups.len() - start) as u32;
        let full = made.div_ceil(MAX_ROW) * made.min(MAX_ROW);
        // Beyond the last item of a job nothing is done.
        self.groups
            .extend((made..full).map(|_| [0, u32::MAX - GROUP]));
    }
}
