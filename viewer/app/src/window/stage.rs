//! What a window is painted with: a surface, and the interface's triangles on it.

use std::collections::HashMap;
use std::sync::Arc;

use egui::epaint::ImageDelta;
use egui::{ClippedPrimitive, TextureId, TexturesDelta};
use egui_wgpu::{Renderer, RendererOptions, ScreenDescriptor};
use viewer::gpu::Gpu;
use winit::window::Window;

/// A surface and what paints on it.
pub struct Stage {
    gpu: Gpu,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    painter: Renderer,
    picture: TextureId,
    /// The view that `picture` stands for.
    shown: Option<wgpu::TextureView>,
    textures: Textures,
}

/// How each texture came to be what it is, for another device; images are shared.
pub type Textures = HashMap<TextureId, Steps>;

/// A whole image, and what was changed of it.
#[derive(Default)]
pub struct Steps(Vec<ImageDelta>);

impl Steps {
    fn add(&mut self, delta: ImageDelta) {
        if delta.is_whole() {
            self.0.clear();
        }
        self.0.push(delta);
    }
}

impl Stage {
    /// On a window.
    ///
    /// # Errors
    ///
    /// In words, when the device cannot paint on it.
    pub fn new(gpu: Gpu, window: Arc<Window>) -> Result<Self, String> {
        let size = window.inner_size();
        let surface = gpu
            .instance
            .create_surface(window)
            .map_err(|error| format!("nothing can be painted on the window: {error}"))?;
        let mut config = surface
            .get_default_config(&gpu.adapter, size.width.max(1), size.height.max(1))
            .ok_or_else(|| format!("{} cannot paint on this display", gpu.info.name))?;
        // Colours are display-referred throughout: a format that converts them would do so twice.
        let formats = surface.get_capabilities(&gpu.adapter).formats;
        let plain = [
            wgpu::TextureFormat::Rgba8Unorm,
            wgpu::TextureFormat::Bgra8Unorm,
        ];
        if let Some(format) = formats.into_iter().find(|format| plain.contains(format)) {
            config.format = format;
        }
        config.present_mode = wgpu::PresentMode::AutoVsync;
        config.desired_maximum_frame_latency = 1;
        surface.configure(&gpu.device, &config);
        let mut painter = Renderer::new(&gpu.device, config.format, RendererOptions::default());
        let nothing = nothing(&gpu);
        let picture =
            painter.register_native_texture(&gpu.device, &nothing, wgpu::FilterMode::Linear);
        Ok(Self {
            gpu,
            surface,
            config,
            painter,
            picture,
            shown: None,
            textures: Textures::new(),
        })
    }

    /// The longest side of a texture.
    pub fn largest_texture(&self) -> usize {
        self.gpu.device.limits().max_texture_dimension_2d as usize
    }

    /// The name of the scene's picture.
    pub fn picture_id(&self) -> TextureId {
        self.picture
    }

    /// The window has another size.
    pub fn resize(&mut self, width: u32, height: u32) {
        let most = self.gpu.device.limits().max_texture_dimension_2d;
        let (width, height) = (width.clamp(1, most), height.clamp(1, most));
        if (width, height) != (self.config.width, self.config.height) {
            (self.config.width, self.config.height) = (width, height);
            self.surface.configure(&self.gpu.device, &self.config);
        }
    }

    /// Paints the interface; `picture` is the scene's. False if the window could not be painted on
    /// this time.
    pub fn paint(
        &mut self,
        primitives: &[ClippedPrimitive],
        textures: &mut TexturesDelta,
        pixels_per_point: f32,
        picture: Option<&wgpu::TextureView>,
    ) -> bool {
        let (device, queue) = (&self.gpu.device, &self.gpu.queue);
        if let Some(picture) = picture
            && self.shown.as_ref() != Some(picture)
        {
            let filter = wgpu::FilterMode::Linear;
            self.painter.update_egui_texture_from_wgpu_texture(
                device,
                picture,
                filter,
                self.picture,
            );
            self.shown = Some(picture.clone());
        }
        for (id, deltas) in textures.set.drain() {
            for delta in deltas {
                self.painter.update_texture(device, queue, id, &delta);
                self.textures.entry(id).or_default().add(delta);
            }
        }
        let free: Vec<TextureId> = textures.free.drain().collect();
        let target = match self.surface.get_current_texture() {
            wgpu::CurrentSurfaceTexture::Success(target)
            | wgpu::CurrentSurfaceTexture::Suboptimal(target) => target,
            _ => {
                self.surface.configure(device, &self.config);
                self.free(&free);
                return false;
            }
        };
        let screen = ScreenDescriptor {
            size_in_pixels: [self.config.width, self.config.height],
            pixels_per_point,
        };
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut commands =
            self.painter
                .update_buffers(device, queue, &mut encoder, primitives, &screen);
        let view = target
            .texture
            .create_view(&wgpu::TextureViewDescriptor::default());
        let mut pass = encoder
            .begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("window"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                ..wgpu::RenderPassDescriptor::default()
            })
            .forget_lifetime();
        self.painter.render(&mut pass, primitives, &screen);
        drop(pass);
        commands.push(encoder.finish());
        queue.submit(commands);
        queue.present(target);
        self.free(&free);
        true
    }

    fn free(&mut self, ids: &[TextureId]) {
        for id in ids {
            self.painter.free_texture(id);
            self.textures.remove(id);
        }
    }

    /// The interface's own textures, for a stage on another device.
    pub fn take_textures(&mut self) -> Textures {
        std::mem::take(&mut self.textures)
    }

    /// Takes over the textures of another stage.
    pub fn put_textures(&mut self, textures: Textures) {
        for (id, steps) in &textures {
            for delta in &steps.0 {
                self.painter
                    .update_texture(&self.gpu.device, &self.gpu.queue, *id, delta);
            }
        }
        self.textures = textures;
    }
}

/// A pixel, until there is a picture.
fn nothing(gpu: &Gpu) -> wgpu::TextureView {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("no picture"),
        size: wgpu::Extent3d::default(),
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
