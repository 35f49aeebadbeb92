//! Images on the device, with all their mip levels.

use rustc_hash::FxHashMap;
use scenegraph::scene::{Scene, TextureId, Wrap};
use wgpu::util::DeviceExt;

use super::binding::{self, Layouts};
use super::device::Gpu;
use crate::content::Content;
use crate::texture::Images;

/// The images that some object shows.
#[derive(Default)]
pub struct Textures {
    groups: FxHashMap<TextureId, wgpu::BindGroup>,
    /// Bytes uploaded.
    pub bytes: u64,
}

impl Textures {
    /// Uploads them.
    pub fn upload(
        gpu: &Gpu,
        layouts: &Layouts,
        scene: &Scene,
        content: &Content,
        images: &Images,
    ) -> Self {
        let mut textures = Self::default();
        for object in &content.objects {
            let Some(id) = object.texture else {
                continue;
            };
            if textures.groups.contains_key(&id) {
                continue;
            }
            let Some(pixels) = images.get(id) else {
                continue;
            };
            let texture = &scene.textures[id.index()];
            let most = gpu.device.limits().max_texture_dimension_2d;
            let levels = levels(pixels.width, pixels.height, &pixels.rgba, most);
            textures.bytes += levels.iter().map(|l| l.rgba.len() as u64).sum::<u64>();
            let view = upload(gpu, &levels);
            let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                address_mode_u: address(texture.wrap_s),
                address_mode_v: address(texture.wrap_t),
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                mipmap_filter: wgpu::MipmapFilterMode::Linear,
                // Mesa 22's llvmpipe can loop without end over anisotropic samples.
                anisotropy_clamp: if gpu.is_software() { 1 } else { 8 },
                ..wgpu::SamplerDescriptor::default()
            });
            let group = binding::group(
                &gpu.device,
                "image",
                &layouts.image,
                vec![
                    wgpu::BindingResource::TextureView(&view),
                    wgpu::BindingResource::Sampler(&sampler),
                ],
            );
            textures.groups.insert(id, group);
        }
        textures
    }

    /// Group 2 for a texture.
    pub fn group(&self, id: TextureId) -> Option<&wgpu::BindGroup> {
        self.groups.get(&id)
    }

    /// How many images there are.
    pub fn len(&self) -> usize {
        self.groups.len()
    }
}

fn address(wrap: Wrap) -> wgpu::AddressMode {
    match wrap {
        Wrap::Repeat => wgpu::AddressMode::Repeat,
        Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
    }
}

struct Level {
    width: u32,
    height: u32,
    rgba: Vec<u8>,
}

/// All levels from the largest that the device takes down to one texel, each the mean of the one
/// above.
fn levels(width: u32, height: u32, rgba: &[u8], most: u32) -> Vec<Level> {
    let mut levels = vec![Level {
        width,
        height,
        rgba: rgba.to_vec(),
    }];
    while let Some(last) = levels.last()
        && (last.width > 1 || last.height > 1)
    {
        let next = halved(last);
        if last.width > most || last.height > most {
            levels.pop();
        }
        levels.push(next);
    }
    levels
}

/// Half as wide and high, at least 1; the mean of the texels that each texel covers. An odd side
/// gives its last texel to the last pair.
fn halved(level: &Level) -> Level {
    let width = (level.width / 2).max(1);
    let height = (level.height / 2).max(1);
    let mut rgba = Vec::with_capacity(width as usize * height as usize * 4);
    for y in 0..height {
        let rows = covered(y, height, level.height);
        for x in 0..width {
            let columns = covered(x, width, level.width);
            let mut sum = [0_u32; 4];
            for row in rows.clone() {
                for column in columns.clone() {
                    let at = (row as usize * level.width as usize + column as usize) * 4;
                    for (sum, &byte) in sum.iter_mut().zip(&level.rgba[at..at + 4]) {
                        *sum += u32::from(byte);
                    }
                }
            }
            let count = rows.len() as u32 * columns.len() as u32;
            rgba.extend(sum.map(|s| ((s + count / 2) / count) as u8));
        }
    }
    Level {
        width,
        height,
        rgba,
    }
}

fn covered(i: u32, small: u32, large: u32) -> std::ops::Range<u32> {
    let end = if i + 1 == small { large } else { 2 * i + 2 };
    2 * i..end
}

fn upload(gpu: &Gpu, levels: &[Level]) -> wgpu::TextureView {
    let bytes: Vec<u8> = levels.iter().flat_map(|l| &l.rgba).copied().collect();
    let texture = gpu.device.create_texture_with_data(
        &gpu.queue,
        &wgpu::TextureDescriptor {
            label: Some("image"),
            size: wgpu::Extent3d {
                width: levels[0].width,
                height: levels[0].height,
                depth_or_array_layers: 1,
            },
            mip_level_count: levels.len() as u32,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        &bytes,
    );
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
