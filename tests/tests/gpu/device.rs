//! The one device of this binary, and pictures drawn by it.

use std::path::Path;
use std::sync::{Arc, LazyLock, Mutex};

use convert::TextureLoader;
use glam::{DMat3, DQuat};
use scenegraph::scene::Scene;
use tests::reference::{RefCamera, RefLens};
use viewer::frame::{Plan, Settings};
use viewer::gpu::{AdapterChoice, FrameReport, Gpu, Renderer};
use viewer::texture::Images;
use viewer::view::{Lens, Region, View};

/// A device, or the words on what to install. Drawing takes all processors, so one test draws at a
/// time.
static DEVICE: LazyLock<Mutex<Result<Gpu, String>>> = LazyLock::new(|| {
    Mutex::new(
        Gpu::new(AdapterChoice::Software)
            .map_err(|error| format!("these tests need a software adapter (lavapipe); {error}")),
    )
});

/// A scene on the device.
pub struct Stage {
    renderer: Renderer,
}

/// A picture, and how it came about.
pub struct Shot {
    /// RGBA, rows from top to bottom.
    pub rgba: Vec<u8>,
    /// What was planned.
    pub plan: Plan,
    /// What it took.
    pub report: FrameReport,
}

impl Stage {
    /// Uploads a scene, with the textures that stand in its text.
    pub fn new(scene: Scene) -> Self {
        Self::with_images(scene, &NoFiles)
    }

    /// Uploads a scene and its textures.
    pub fn with_images(scene: Scene, loader: &dyn TextureLoader) -> Self {
        let gpu = match &*DEVICE
            .lock()
            .expect("a test panicked while it made the device")
        {
            Ok(gpu) => gpu.clone(),
            Err(words) => panic!("{words}"),
        };
        let images = Images::load(&scene, loader);
        assert_eq!(images.problems, Vec::new());
        let renderer = Renderer::new(gpu, Arc::new(scene), &images).expect("uploads");
        Self { renderer }
    }

    /// Draws a picture.
    pub fn shoot(
        &mut self,
        camera: &RefCamera,
        [width, height]: [u32; 2],
        settings: &Settings,
    ) -> Shot {
        let region = Region::whole(width, height);
        let drawn = self
            .renderer
            .draw(&view_of(camera), &region, (width, height), settings);
        let (plan, report) = drawn.expect("draws");
        let rgba = self.renderer.read().expect("reads");
        assert_eq!(rgba.len(), width as usize * height as usize * 4);
        Shot { rgba, plan, report }
    }

    /// The renderer itself.
    pub fn renderer(&self) -> &Renderer {
        &self.renderer
    }
}

/// The reference's camera as the renderer's view.
pub fn view_of(camera: &RefCamera) -> View {
    let axes = DMat3::from_cols(camera.right, camera.up, -camera.forward);
    View {
        eye: camera.eye,
        orientation: DQuat::from_mat3(&axes).normalize(),
        lens: match camera.lens {
            RefLens::Perspective { tan_half_height } => Lens::Perspective { tan_half_height },
            RefLens::Orthographic { half_height } => Lens::Orthographic { half_height },
        },
    }
}

struct NoFiles;

impl TextureLoader for NoFiles {
    fn load(&self, _: &Path, name: &str) -> Result<Vec<u8>, String> {
        Err(format!("{name}: these scenes have no files"))
    }
}
