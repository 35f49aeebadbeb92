//! Shadow maps: depth as a light sees it. A method to compare with; it is made anew each frame.

use glam::{DMat3, DMat4, DVec3, DVec4};

use super::binding::{self, Layouts};
use super::device::Gpu;
use super::targets::MAP_FORMAT;
use crate::content::{Content, LightShape, WorldLight};
use geometry::bounds::Aabb;

/// The layers of a light's map, and the matrices to them.
pub struct ShadowMap {
    /// Depth to draw into, one view a face.
    pub faces: Vec<wgpu::TextureView>,
    /// Group 2 while drawing, with an offset of [`VIEW_STRIDE`] a face.
    pub view_group: wgpu::BindGroup,
    /// Group 3 while shading.
    pub group: wgpu::BindGroup,
    /// Texels along a side.
    size: u32,
}

/// Distance between the matrices of two faces in their buffer.
pub const VIEW_STRIDE: u32 = 256;

/// The longest side of a face of a cube: six faces of it take 400 MB.
const MAX_CUBE_SIZE: u32 = 4096;

impl ShadowMap {
    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        4 * u64::from(self.size) * u64::from(self.size) * self.faces.len() as u64
    }

    /// Makes the textures and matrices of a light.
    pub fn new(
        gpu: &Gpu,
        layouts: &Layouts,
        content: &Content,
        light: &WorldLight,
        eye: DVec3,
        size: u32,
    ) -> Self {
        let views = map_views(&content.bounds, &light.shape, eye);
        let most = gpu.device.limits().max_texture_dimension_2d;
        let most = if views.len() > 1 {
            most.min(MAX_CUBE_SIZE)
        } else {
            most
        };
        let size = size.clamp(1, most);
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("shadow map"),
            size: wgpu::Extent3d {
                width: size,
                height: size,
                depth_or_array_layers: views.len() as u32,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: MAP_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let faces = (0..views.len() as u32)
            .map(|face| {
                texture.create_view(&wgpu::TextureViewDescriptor {
                    dimension: Some(wgpu::TextureViewDimension::D2),
                    base_array_layer: face,
                    array_layer_count: Some(1),
                    ..wgpu::TextureViewDescriptor::default()
                })
            })
            .collect();
        let matrices: Vec<[[f32; 4]; 4]> = (0..6)
            .map(|face| {
                let view = views.get(face).or(views.first());
                view.copied()
                    .unwrap_or_default()
                    .as_mat4()
                    .to_cols_array_2d()
            })
            .collect();
        let spaced: Vec<u8> = matrices
            .iter()
            .flat_map(|matrix| {
                let mut bytes = [0; VIEW_STRIDE as usize];
                bytes[..64].copy_from_slice(bytemuck::bytes_of(matrix));
                bytes
            })
            .collect();
        let packed = uniform(gpu, bytemuck::cast_slice(&matrices));
        let spaced = uniform(gpu, &spaced);
        let view_group = binding::group(
            &gpu.device,
            "map view",
            &layouts.map_view,
            vec![wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: &spaced,
                offset: 0,
                size: wgpu::BufferSize::new(64),
            })],
        );
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::LessEqual),
            ..wgpu::SamplerDescriptor::default()
        });
        let all = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..wgpu::TextureViewDescriptor::default()
        });
        let group = binding::group(
            &gpu.device,
            "shadow map",
            &layouts.shadow_map,
            vec![
                wgpu::BindingResource::TextureView(&all),
                wgpu::BindingResource::Sampler(&sampler),
                packed.as_entire_binding(),
            ],
        );
        Self {
            faces,
            view_group,
            group,
            size,
        }
    }
}

fn uniform(gpu: &Gpu, contents: &[u8]) -> wgpu::Buffer {
    use wgpu::util::DeviceExt;
    gpu.device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("map views"),
            contents,
            usage: wgpu::BufferUsages::UNIFORM,
        })
}

/// From the world around the eye to the clip space of each face; depth 0 at the light.
fn map_views(bounds: &Aabb, shape: &LightShape, eye: DVec3) -> Vec<DMat4> {
    match *shape {
        LightShape::Directional { towards } => vec![directional(bounds, towards, eye)],
        LightShape::Point { p_in_world } | LightShape::Spot { p_in_world, .. } => {
            let far = bounds
                .corners()
                .iter()
                .map(|corner| corner.distance(p_in_world))
                .fold(0.0, f64::max);
            // What is nearer to the light than a thousandth of the scene throws no shadow.
            let far = if far > 0.0 { far * 1.01 } else { 1.0 };
            let projection = right_angle(far / 1000.0, far);
            let to_light = DMat4::from_translation(eye - p_in_world);
            FACES
                .map(|(forward, up)| projection * look(forward, up) * to_light)
                .into()
        }
    }
}

/// In the order in which the shader numbers them: +x, -x, +y, -y, +z, -z.
const FACES: [(DVec3, DVec3); 6] = [
    (DVec3::X, DVec3::Y),
    (DVec3::NEG_X, DVec3::Y),
    (DVec3::Y, DVec3::Z),
    (DVec3::NEG_Y, DVec3::Z),
    (DVec3::Z, DVec3::Y),
    (DVec3::NEG_Z, DVec3::Y),
];

fn directional(bounds: &Aabb, towards: DVec3, eye: DVec3) -> DMat4 {
    let center = bounds.center();
    let up = if towards.z.abs() < 0.9 {
        DVec3::Z
    } else {
        DVec3::X
    };
    let turn = look(-towards, up);
    let half = bounds
        .corners()
        .iter()
        .map(|corner| turn.transform_vector3(corner - center).abs())
        .fold(DVec3::ZERO, DVec3::max)
        * 1.01
        + DVec3::splat(f64::MIN_POSITIVE);
    let projection = parallel(half);
    projection * turn * DMat4::from_translation(eye - center)
}

/// Turns a direction into -Z, and another towards +Y.
fn look(forward: DVec3, up: DVec3) -> DMat4 {
    let right = forward.cross(up).normalize_or_zero();
    let up = right.cross(forward);
    DMat4::from_mat3(DMat3::from_cols(right, up, -forward).transpose())
}

/// A field of view of 90 degrees; depth 0 at `near`, 1 at `far`.
fn right_angle(near: f64, far: f64) -> DMat4 {
    DMat4::from_cols(
        DVec4::X,
        DVec4::Y,
        DVec4::new(0.0, 0.0, far / (near - far), -1.0),
        DVec4::new(0.0, 0.0, near * far / (near - far), 0.0),
    )
}

/// A box around the origin; depth 0 at its +Z side, 1 at its -Z side.
fn parallel(half: DVec3) -> DMat4 {
    DMat4::from_cols(
        DVec4::X / half.x,
        DVec4::Y / half.y,
        DVec4::Z * (-0.5 / half.z),
        DVec4::new(0.0, 0.0, 0.5, 1.0),
    )
}
