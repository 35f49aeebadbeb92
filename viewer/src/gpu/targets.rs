//! The images that a frame is drawn into.

use super::device::Gpu;

/// Light is summed in half floats: sixteen bits leave an eighth of an 8-bit step of error a pass
/// near one, and do not stop at one.
pub const COLOR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Reverse-Z in floats, and eight bits of stencil.
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32FloatStencil8;
/// Depth as a light sees it.
pub const MAP_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// What comes out: display-referred, as Inventor's colours are.
pub const OUTPUT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// The images of one size.
pub struct Targets {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Samples a pixel.
    pub samples: u32,
    /// Summed light.
    pub color: wgpu::TextureView,
    /// Depth and stencil, to draw with.
    pub depth: wgpu::TextureView,
    /// Depth, to read.
    pub depth_only: wgpu::TextureView,
    /// Stencil, to read.
    pub stencil_only: wgpu::TextureView,
    /// The final image.
    pub output: wgpu::Texture,
    /// The same, to draw into.
    pub output_view: wgpu::TextureView,
    /// Bytes of all of them.
    pub bytes: u64,
}

impl Targets {
    /// Makes the images. Sides are clamped to what the device can do.
    pub fn new(gpu: &Gpu, width: u32, height: u32, samples: u32) -> Self {
        let most = gpu.device.limits().max_texture_dimension_2d;
        let (width, height) = (width.clamp(1, most), height.clamp(1, most));
        let texture = |label, format, samples, usage| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d {
                    width,
                    height,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: samples,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        };
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let bound = wgpu::TextureUsages::TEXTURE_BINDING;
        let color = texture("light", COLOR_FORMAT, samples, attachment | bound);
        let depth = texture(
            "depth and stencil",
            DEPTH_FORMAT,
            samples,
            attachment | bound,
        );
        let output = texture(
            "image",
            OUTPUT_FORMAT,
            1,
            attachment | bound | wgpu::TextureUsages::COPY_SRC,
        );
        let view =
            |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let pixels = u64::from(width) * u64::from(height);
        Self {
            width,
            height,
            samples,
            color: view(&color),
            depth: view(&depth),
            depth_only: depth.create_view(&wgpu::TextureViewDescriptor {
                aspect: wgpu::TextureAspect::DepthOnly,
                ..wgpu::TextureViewDescriptor::default()
            }),
            stencil_only: depth.create_view(&wgpu::TextureViewDescriptor {
                aspect: wgpu::TextureAspect::StencilOnly,
                ..wgpu::TextureViewDescriptor::default()
            }),
            output_view: view(&output),
            output,
            // 8 bytes of light; 4 of depth and 1 of stencil, which drivers keep as 8; 4 out.
            bytes: pixels * (16 * u64::from(samples) + 4),
        }
    }
}
