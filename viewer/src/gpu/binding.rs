//! Layouts of bind groups: the device's side of the bindings in `shader/wgsl`.

use wgpu::{
    BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry, BindingType,
    BufferBindingType, Device, ShaderStages, TextureSampleType, TextureViewDimension,
};

/// All layouts.
pub struct Layouts {
    /// Group 0: frame, instances, surfaces, lights, light lists.
    pub scene: BindGroupLayout,
    /// Group 1: the values of a pass, at an offset.
    pub pass: BindGroupLayout,
    /// Group 2: an image and its sampler.
    pub image: BindGroupLayout,
    /// Group 2 where a group 3 follows and nothing else is there: Mesa 22's lavapipe reads group 3
    /// wrongly behind a gap.
    pub nothing: BindGroupLayout,
    /// Group 2: ends of lines, or points.
    pub strokes: BindGroupLayout,
    /// Group 2: positions, edges, triangles, entries.
    pub volumes: BindGroupLayout,
    /// Group 2: one view of a light, at an offset.
    pub map_view: BindGroupLayout,
    /// Group 3: depth maps, their sampler, their views.
    pub shadow_map: BindGroupLayout,
    /// Group 3: the mask of rays, or the stencil.
    pub shadow_mask: BindGroupLayout,
}

impl Layouts {
    /// Makes them.
    pub fn new(device: &Device) -> Self {
        let both = ShaderStages::VERTEX_FRAGMENT | ShaderStages::COMPUTE;
        let vertex = ShaderStages::VERTEX;
        let fragment = ShaderStages::FRAGMENT;
        Self {
            scene: layout(
                device,
                "scene",
                &[
                    (both, UNIFORM),
                    (both, STORAGE),
                    (both, STORAGE),
                    (both, STORAGE),
                    (both, STORAGE),
                ],
            ),
            pass: layout(device, "pass", &[(both, DYNAMIC_UNIFORM)]),
            image: layout(
                device,
                "image",
                &[
                    (
                        fragment,
                        texture(
                            TextureSampleType::Float { filterable: true },
                            TextureViewDimension::D2,
                        ),
                    ),
                    (
                        fragment,
                        BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
                    ),
                ],
            ),
            nothing: layout(device, "nothing", &[]),
            strokes: layout(device, "strokes", &[(vertex, STORAGE)]),
            volumes: layout(device, "volumes", &[(vertex, STORAGE); 4]),
            map_view: layout(device, "map view", &[(vertex, DYNAMIC_UNIFORM)]),
            shadow_map: layout(
                device,
                "shadow map",
                &[
                    (
                        fragment,
                        texture(TextureSampleType::Depth, TextureViewDimension::D2Array),
                    ),
                    (
                        fragment,
                        BindingType::Sampler(wgpu::SamplerBindingType::Comparison),
                    ),
                    (fragment, UNIFORM),
                ],
            ),
            shadow_mask: layout(
                device,
                "shadow mask",
                &[(
                    fragment,
                    texture(TextureSampleType::Uint, TextureViewDimension::D2),
                )],
            ),
        }
    }
}

/// A uniform buffer.
pub const UNIFORM: BindingType = BindingType::Buffer {
    ty: BufferBindingType::Uniform,
    has_dynamic_offset: false,
    min_binding_size: None,
};

/// A uniform buffer at an offset.
pub const DYNAMIC_UNIFORM: BindingType = BindingType::Buffer {
    ty: BufferBindingType::Uniform,
    has_dynamic_offset: true,
    min_binding_size: None,
};

/// A storage buffer that is read.
pub const STORAGE: BindingType = BindingType::Buffer {
    ty: BufferBindingType::Storage { read_only: true },
    has_dynamic_offset: false,
    min_binding_size: None,
};

/// A texture of one sample.
pub fn texture(
    sample_type: TextureSampleType,
    view_dimension: TextureViewDimension,
) -> BindingType {
    BindingType::Texture {
        sample_type,
        view_dimension,
        multisampled: false,
    }
}

/// A layout of consecutive bindings.
pub fn layout(
    device: &Device,
    label: &str,
    bindings: &[(ShaderStages, BindingType)],
) -> BindGroupLayout {
    let entries: Vec<BindGroupLayoutEntry> = (0..)
        .zip(bindings)
        .map(|(binding, &(visibility, ty))| BindGroupLayoutEntry {
            binding,
            visibility,
            ty,
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&BindGroupLayoutDescriptor {
        label: Some(label),
        entries: &entries,
    })
}

/// A bind group of consecutive bindings.
pub fn group(
    device: &Device,
    label: &str,
    layout: &BindGroupLayout,
    resources: Vec<wgpu::BindingResource<'_>>,
) -> wgpu::BindGroup {
    let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(label),
        layout,
        entries: &entries,
    })
}
