//! One scene on the device: its frame times, and its pixels beside those of the f64 reference.

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::{DMat3, DQuat};
use tests::reference::{RefImage, RefLens, RefOptions, render};
use tests::shadow_scenes::scene_of;
use tests::shadow_scenes::{GridLight, GridSize, sphere_grid};
use viewer::frame::Settings;
use viewer::gpu::{Gpu, GpuError, Renderer};
use viewer::texture::Images;
use viewer::view::{Lens, Region, View};

/// Frames are drawn until this is over, at least [`LEAST_FRAMES`]; the fastest counts.
const PATIENCE: Duration = Duration::from_secs(1);
const LEAST_FRAMES: u32 = 2;
/// Lit and shadowed pixels differ by far more steps of 8 bits than this, equal ones by less.
const STEPS: f64 = 8.0 / 255.0;

/// A scene, its view, and how it should look.
pub struct Subject {
    renderer: Renderer,
    view: View,
    image: [u32; 2],
    reference: RefImage,
    near_edge: Vec<bool>,
}

/// What was measured.
pub struct Figures {
    /// The fastest frame, without making volumes or pipelines.
    pub ms: f64,
    /// Pixels of geometry that differ from the reference.
    pub wrong: usize,
    /// Of them, those with no edge of an object or a shadow in the eight pixels around.
    pub away: usize,
}

impl Subject {
    /// Makes and uploads the grid, and traces it.
    pub fn new(
        gpu: &Gpu,
        size: GridSize,
        light: GridLight,
        image: [u32; 2],
    ) -> Result<Self, GpuError> {
        let made = sphere_grid(size, light);
        let scene = scene_of(&made.text);
        let camera = made.cameras[0].1;
        let reference = render(&scene, &camera, image, [0.0; 3], &RefOptions::of(&scene));
        let near_edge = reference.near_edge(1);
        let axes = DMat3::from_cols(camera.right, camera.up, -camera.forward);
        let view = View {
            eye: camera.eye,
            orientation: DQuat::from_mat3(&axes).normalize(),
            lens: match camera.lens {
                RefLens::Perspective { tan_half_height } => Lens::Perspective { tan_half_height },
                RefLens::Orthographic { half_height } => Lens::Orthographic { half_height },
            },
        };
        let renderer = Renderer::new(gpu.clone(), Arc::new(scene), &Images::none())?;
        Ok(Self {
            renderer,
            view,
            image,
            reference,
            near_edge,
        })
    }

    /// Draws with these settings.
    pub fn measure(&mut self, settings: &Settings) -> Result<Figures, GpuError> {
        let [width, height] = self.image;
        let region = Region::whole(width, height);
        let start = Instant::now();
        let mut fastest = Duration::MAX;
        let mut frames = 0;
        // The first frame makes volumes and compiles.
        self.renderer
            .draw(&self.view, &region, (width, height), settings)?;
        while frames < LEAST_FRAMES || start.elapsed() < PATIENCE {
            let frame = Instant::now();
            self.renderer
                .draw(&self.view, &region, (width, height), settings)?;
            fastest = fastest.min(frame.elapsed());
            frames += 1;
        }
        let rgba = self.renderer.read()?;
        let (mut wrong, mut away) = (0, 0);
        for (i, pixel) in rgba.chunks_exact(4).enumerate() {
            if self.reference.object[i].is_none() {
                continue;
            }
            let differs = (0..3).any(|channel| {
                let drawn = f64::from(pixel[channel]) / 255.0;
                (drawn - self.reference.color[i][channel]).abs() > STEPS
            });
            wrong += usize::from(differs);
            away += usize::from(differs && !self.near_edge[i]);
        }
        Ok(Figures {
            ms: fastest.as_secs_f64() * 1e3,
            wrong,
            away,
        })
    }
}
