//! Shadows by rays: a hierarchy of boxes over all casters, and a mask with a bit a sample.

use glam::{DVec3, Vec3};
use scenegraph::scene::Scene;

use super::binding::{self, STORAGE};
use super::casters::storage;
use super::device::Gpu;
use super::targets::Targets;
use crate::content::Content;
use crate::content::positions::positions;
use crate::hierarchy::{self, Bounds};
use crate::shader;

/// Triangles in a leaf at most.
const LEAF: usize = 4;

/// Boxes and triangles of all casters, around the middle of the scene.
pub struct Hierarchy {
    nodes: Vec<hierarchy::Node>,
    corners: Vec<[f32; 4]>,
}

impl Hierarchy {
    /// Over the casters of `content`, relative to `origin`. The median splits keep its depth below
    /// the shader's stack of 64.
    pub fn new(scene: &Scene, content: &Content, origin: DVec3) -> Self {
        let mut triangles: Vec<[Vec3; 3]> = Vec::new();
        for object in content.objects.iter().filter(|object| object.is_caster()) {
            let mesh = &scene.meshes[object.mesh.index()];
            let places = positions(mesh);
            let mut rel = object.world_from_mesh;
            rel.translation -= origin;
            let at = |i: u32| {
                let p = Vec3::from_array(places[i as usize]).as_dvec3();
                rel.transform_point3(p).as_vec3()
            };
            let corners = mesh.indices.chunks_exact(3);
            triangles.extend(corners.map(|of| [at(of[0]), at(of[1]), at(of[2])]));
        }
        let boxes = triangles.iter().map(|corners| {
            let mut bounds = Bounds::EMPTY;
            corners.iter().for_each(|&p| bounds.add(p));
            bounds
        });
        let boxes = hierarchy::Hierarchy::new(boxes, LEAF);
        let corners = boxes
            .order
            .iter()
            .flat_map(|&i| {
                let [a, b, c] = triangles[i as usize];
                [a, b - a, c - a].map(|v| v.extend(0.0).to_array())
            })
            .collect();
        Self {
            nodes: boxes.nodes,
            corners,
        }
    }
}

/// What casting rays needs on the device.
pub struct Rays {
    nodes: wgpu::Buffer,
    corners: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    /// Group 3 while shading.
    pub mask_group: wgpu::BindGroup,
    size: (u32, u32, u32),
}

impl Rays {
    /// Uploads a hierarchy, and makes a mask for images like `targets`.
    pub fn new(
        gpu: &Gpu,
        layouts: &binding::Layouts,
        hierarchy: &Hierarchy,
        targets: &Targets,
    ) -> Self {
        let nodes = storage(gpu, "ray boxes", bytemuck::cast_slice(&hierarchy.nodes));
        let corners = storage(
            gpu,
            "ray triangles",
            bytemuck::cast_slice(&hierarchy.corners),
        );
        let compute = wgpu::ShaderStages::COMPUTE;
        let layout = binding::layout(
            &gpu.device,
            "rays",
            &[
                (compute, STORAGE),
                (compute, STORAGE),
                (
                    compute,
                    wgpu::BindingType::Texture {
                        sample_type: wgpu::TextureSampleType::Depth,
                        view_dimension: wgpu::TextureViewDimension::D2,
                        multisampled: targets.samples > 1,
                    },
                ),
                (
                    compute,
                    wgpu::BindingType::StorageTexture {
                        access: wgpu::StorageTextureAccess::WriteOnly,
                        format: wgpu::TextureFormat::R32Uint,
                        view_dimension: wgpu::TextureViewDimension::D2,
                    },
                ),
            ],
        );
        let module = gpu
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("rays"),
                source: wgpu::ShaderSource::Wgsl(shader::emit_rays(targets.samples).into()),
            });
        let pipeline_layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("rays"),
                bind_group_layouts: &[Some(&layouts.scene), Some(&layouts.pass), Some(&layout)],
                immediate_size: 0,
            });
        let pipeline = gpu
            .device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("rays"),
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some("cast_rays"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            });
        let (group, mask_group) = groups(gpu, layouts, &layout, [&nodes, &corners], targets);
        Self {
            nodes,
            corners,
            layout,
            pipeline,
            group,
            mask_group,
            size: (targets.width, targets.height, targets.samples),
        }
    }

    /// Whether these rays can be used for images like `targets`.
    pub fn fits(&self, targets: &Targets) -> bool {
        self.size == (targets.width, targets.height, targets.samples)
    }

    /// Samples a pixel.
    pub fn samples(&self) -> u32 {
        self.size.2
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        self.nodes.size() + self.corners.size()
    }

    /// Makes anew what depends on the images.
    pub fn refit(&mut self, gpu: &Gpu, layouts: &binding::Layouts, targets: &Targets) {
        let buffers = [&self.nodes, &self.corners];
        (self.group, self.mask_group) = groups(gpu, layouts, &self.layout, buffers, targets);
        self.size = (targets.width, targets.height, targets.samples);
    }

    /// Records the rays of one light.
    pub fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        scene_group: &wgpu::BindGroup,
        pass_group: &wgpu::BindGroup,
        pass_offset: u32,
        (width, height): (u32, u32),
    ) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, scene_group, &[]);
        pass.set_bind_group(1, pass_group, &[pass_offset]);
        pass.set_bind_group(2, &self.group, &[]);
        pass.dispatch_workgroups(width.div_ceil(8), height.div_ceil(8), 1);
    }
}

fn groups(
    gpu: &Gpu,
    layouts: &binding::Layouts,
    layout: &wgpu::BindGroupLayout,
    [nodes, corners]: [&wgpu::Buffer; 2],
    targets: &Targets,
) -> (wgpu::BindGroup, wgpu::BindGroup) {
    let mask = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("shadow mask"),
        size: wgpu::Extent3d {
            width: targets.width,
            height: targets.height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::R32Uint,
        usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    let mask = mask.create_view(&wgpu::TextureViewDescriptor::default());
    let group = binding::group(
        &gpu.device,
        "rays",
        layout,
        vec![
            nodes.as_entire_binding(),
            corners.as_entire_binding(),
            wgpu::BindingResource::TextureView(&targets.depth_only),
            wgpu::BindingResource::TextureView(&mask),
        ],
    );
    let mask_group = binding::group(
        &gpu.device,
        "shadow mask",
        &layouts.shadow_mask,
        vec![wgpu::BindingResource::TextureView(&mask)],
    );
    (group, mask_group)
}
