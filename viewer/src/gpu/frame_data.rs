//! The numbers of a frame: what f64 knows of the world, as f32 around the eye.

use glam::{DAffine3, DMat4, DVec3, DVec4};

use super::binding::{self, Layouts};
use super::device::Gpu;
use crate::content::{Content, LightShape, SpotFade, Surface, WorldLight};
use crate::frame::{Plan, rel_plane};
use crate::overlay;
use crate::shader;
use crate::view::{Lens, Region, View};

/// Distance between the values of two passes in their buffer: the largest alignment that any
/// device asks for.
pub const PASS_STRIDE: u32 = 256;

/// Buffers of a frame. They grow and are never shrunk, so that a second frame allocates nothing.
pub struct FrameData {
    frame: Grown,
    instances: Grown,
    surfaces: Grown,
    lights: Grown,
    light_lists: Grown,
    passes: Grown,
    /// Group 0.
    pub scene_group: wgpu::BindGroup,
    /// Group 1, with an offset of [`PASS_STRIDE`] a light.
    pub pass_group: wgpu::BindGroup,
}

/// A buffer that is made anew when it is too small.
struct Grown {
    buffer: wgpu::Buffer,
    label: &'static str,
}

impl Grown {
    fn new(gpu: &Gpu, label: &'static str, usage: wgpu::BufferUsages) -> Self {
        Self {
            buffer: buffer(gpu, label, 512, usage | wgpu::BufferUsages::COPY_DST),
            label,
        }
    }

    /// Writes the contents; true if the buffer is another one now.
    fn write(&mut self, gpu: &Gpu, contents: &[u8]) -> bool {
        let size = contents.len() as u64;
        let is_small = size > self.buffer.size();
        if is_small {
            self.buffer = buffer(
                gpu,
                self.label,
                size.next_multiple_of(256),
                self.buffer.usage(),
            );
        }
        gpu.queue.write_buffer(&self.buffer, 0, contents);
        is_small
    }
}

fn buffer(gpu: &Gpu, label: &str, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage,
        mapped_at_creation: false,
    })
}

impl FrameData {
    /// Empty buffers.
    pub fn new(gpu: &Gpu, layouts: &Layouts) -> Self {
        let storage = wgpu::BufferUsages::STORAGE;
        let uniform = wgpu::BufferUsages::UNIFORM;
        let frame = Grown::new(gpu, "frame", uniform);
        let instances = Grown::new(gpu, "instances", storage);
        let surfaces = Grown::new(gpu, "surfaces", storage);
        let lights = Grown::new(gpu, "lights", storage);
        let light_lists = Grown::new(gpu, "light lists", storage);
        let passes = Grown::new(gpu, "passes", uniform);
        let scene_group = scene_group(
            gpu,
            layouts,
            [&frame, &instances, &surfaces, &lights, &light_lists],
        );
        let pass_group = pass_group(gpu, layouts, &passes);
        Self {
            frame,
            instances,
            surfaces,
            lights,
            light_lists,
            passes,
            scene_group,
            pass_group,
        }
    }

    /// Writes all numbers of a frame.
    pub fn write(
        &mut self,
        (gpu, layouts): (&Gpu, &Layouts),
        content: &Content,
        plan: &Plan,
        frame: &shader::Frame,
        view: &View,
        far_planes: &[DVec4],
    ) {
        let has_headlight = plan.lights.len() > content.lights.len();
        let (lists, spans) = light_lists(content, has_headlight);
        let mut instances: Vec<shader::Instance> = content
            .objects
            .iter()
            .map(|object| {
                let span = spans[object.light_set as usize];
                instance(
                    &rel_from(view, &object.world_from_mesh),
                    [object.surface, span[0], span[1], 0],
                )
            })
            .collect();
        let anchor = DAffine3::from_translation(overlay::anchor(content));
        instances.push(instance(&rel_from(view, &anchor), [0; 4]));
        let far = view
            .depth_bounds(&content.bounds)
            .map_or(0.0, |(_, far)| far);
        let surfaces: Vec<shader::Surface> =
            content.surfaces.iter().map(|s| surface(s, far)).collect();
        let lights: Vec<shader::Light> = plan.lights.iter().map(|l| light(l, view.eye)).collect();
        let passes: Vec<u8> = (0..plan.lights.len().max(1) as u32)
            .flat_map(|i| {
                let plane = far_planes.get(i as usize).copied().unwrap_or_default();
                let values = shader::PassValues {
                    light: [i, 0, 0, 0],
                    far_plane: rel_plane(plane, view).as_vec4().to_array(),
                };
                let mut bytes = [0; PASS_STRIDE as usize];
                bytes[..size_of::<shader::PassValues>()]
                    .copy_from_slice(bytemuck::bytes_of(&values));
                bytes
            })
            .collect();
        let grown = [
            self.frame.write(gpu, bytemuck::bytes_of(frame)),
            self.instances.write(gpu, bytemuck::cast_slice(&instances)),
            self.surfaces.write(gpu, bytemuck::cast_slice(&surfaces)),
            self.lights.write(gpu, bytemuck::cast_slice(&lights)),
            self.light_lists.write(gpu, bytemuck::cast_slice(&lists)),
        ];
        if grown.contains(&true) {
            self.scene_group = scene_group(
                gpu,
                layouts,
                [
                    &self.frame,
                    &self.instances,
                    &self.surfaces,
                    &self.lights,
                    &self.light_lists,
                ],
            );
        }
        if self.passes.write(gpu, &passes) {
            self.pass_group = pass_group(gpu, layouts, &self.passes);
        }
    }
}

fn scene_group(gpu: &Gpu, layouts: &Layouts, buffers: [&Grown; 5]) -> wgpu::BindGroup {
    let resources = buffers.map(|b| b.buffer.as_entire_binding());
    binding::group(&gpu.device, "scene", &layouts.scene, resources.into())
}

fn pass_group(gpu: &Gpu, layouts: &Layouts, passes: &Grown) -> wgpu::BindGroup {
    let binding = wgpu::BindingResource::Buffer(wgpu::BufferBinding {
        buffer: &passes.buffer,
        offset: 0,
        size: wgpu::BufferSize::new(size_of::<shader::PassValues>() as u64),
    });
    binding::group(&gpu.device, "pass", &layouts.pass, vec![binding])
}

/// The lists one after the other, and for each set its first entry and length.
fn light_lists(content: &Content, has_headlight: bool) -> (Vec<u32>, Vec<[u32; 2]>) {
    let headlight = has_headlight.then_some(content.lights.len() as u32);
    let mut lists = Vec::new();
    let mut spans = Vec::new();
    for set in &content.light_sets {
        let first = lists.len() as u32;
        lists.extend(set.iter().copied().chain(headlight));
        spans.push([first, lists.len() as u32 - first]);
    }
    if lists.is_empty() {
        lists.push(0);
    }
    (lists, spans)
}

/// The world moved so that the eye is the origin: subtracted in f64, where it is exact enough at
/// any distance from the world's origin.
fn rel_from(view: &View, world_from_mesh: &DAffine3) -> DAffine3 {
    DAffine3 {
        matrix3: world_from_mesh.matrix3,
        translation: world_from_mesh.translation - view.eye,
    }
}

/// The numbers of a frame that do not depend on objects.
pub fn frame(
    view: &View,
    clip_from_view: DMat4,
    region: &Region,
    rays_origin: DVec3,
    section: Option<DVec4>,
) -> shader::Frame {
    let view_from_rel = DMat4::from_quat(view.orientation.conjugate());
    let is_parallel = matches!(view.lens, Lens::Orthographic { .. });
    let (width, height) = (region.width as f32, region.height as f32);
    let clip_from_rel = clip_from_view * view_from_rel;
    shader::Frame {
        clip_from_rel: (clip_from_view * view_from_rel)
            .as_mat4()
            .to_cols_array_2d(),
        view_axis: xyzw(view.forward(), if is_parallel { 1.0 } else { 0.0 }),
        viewport: [width, height, 1.0 / width, 1.0 / height],
        eye_in_rays: xyzw(view.eye - rays_origin, 0.0),
        rel_from_clip: clip_from_rel.inverse().as_mat4().to_cols_array_2d(),
        region: [region.x, region.y, region.width, region.height],
        section: section.map_or([0.0; 4], |plane| {
            let n = plane.truncate();
            xyzw(n, n.dot(view.eye) + plane.w)
        }),
    }
}

fn xyzw(v: DVec3, w: f64) -> [f32; 4] {
    v.extend(w).as_vec4().to_array()
}

fn rgbw(rgb: [f64; 3], w: f64) -> [f32; 4] {
    xyzw(DVec3::from_array(rgb), w)
}

fn instance(rel_from_mesh: &DAffine3, ids: [u32; 4]) -> shader::Instance {
    let m = rel_from_mesh.matrix3.transpose();
    let t = rel_from_mesh.translation;
    // The cofactor matrix turns normals whatever the scale. Its sign follows the determinant, and
    // a mirror must not turn them inside out.
    let sign = if m.determinant() < 0.0 { -1.0 } else { 1.0 };
    let cofactor = [
        m.y_axis.cross(m.z_axis),
        m.z_axis.cross(m.x_axis),
        m.x_axis.cross(m.y_axis),
    ];
    // Scaled to about one, so that squares of lengths stay in f32 whatever the unit.
    let largest = cofactor
        .iter()
        .map(|row| row.abs().max_element())
        .fold(0.0, f64::max);
    let scale = if largest > 0.0 { sign / largest } else { 0.0 };
    let [normal_x, normal_y, normal_z] = cofactor.map(|row| xyzw(row * scale, 0.0));
    shader::Instance {
        rel_from_mesh_x: xyzw(m.x_axis, t.x),
        rel_from_mesh_y: xyzw(m.y_axis, t.y),
        rel_from_mesh_z: xyzw(m.z_axis, t.z),
        normal_x,
        normal_y,
        normal_z,
        ids,
    }
}

fn surface(surface: &Surface, far: f64) -> shader::Surface {
    let fog = surface.fog.map_or([0.0; 4], |fog| {
        let visibility = if fog.visibility > 0.0 {
            fog.visibility
        } else {
            far
        };
        let inverse = if visibility > 0.0 {
            1.0 / visibility
        } else {
            0.0
        };
        rgbw(fog.color_srgb, inverse)
    });
    shader::Surface {
        constant: rgbw(surface.constant_srgb, surface.alpha),
        diffuse: rgbw(surface.diffuse_srgb, surface.exponent),
        specular: rgbw(surface.specular_srgb, surface.line_width_px),
        blend: rgbw(surface.blend_srgb, surface.point_size_px),
        fog,
    }
}

fn light(light: &WorldLight, eye: DVec3) -> shader::Light {
    const ALL_WAYS: [f32; 4] = [0.0, 0.0, 0.0, -2.0];
    let (position, axis, exponent, steepness) = match light.shape {
        LightShape::Directional { towards } => (xyzw(towards, 0.0), ALL_WAYS, 0.0, 0.0),
        LightShape::Point { p_in_world } => (xyzw(p_in_world - eye, 1.0), ALL_WAYS, 0.0, 0.0),
        LightShape::Spot {
            p_in_world,
            axis,
            cos_cut_off,
            fade,
        } => {
            let (exponent, steepness) = match fade {
                SpotFade::Cosine { exponent } => (exponent, 0.0),
                // Without a seam the light is cut off: a step that f32 can hold.
                SpotFade::Beam {
                    cos_inner,
                    exponent,
                } => (exponent, 1.0 / (cos_inner - cos_cut_off).max(1e-30)),
            };
            let position = xyzw(p_in_world - eye, 1.0);
            (position, xyzw(axis, cos_cut_off), exponent, steepness)
        }
    };
    let [quadratic, linear, constant] = light.attenuation.unwrap_or([0.0, 0.0, 1.0]);
    shader::Light {
        position,
        axis,
        color: rgbw(light.color_srgb, exponent),
        attenuation: [
            quadratic as f32,
            linear as f32,
            constant as f32,
            steepness as f32,
        ],
    }
}
