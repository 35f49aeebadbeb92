//! A scene on the device, and the one way to draw it: plan, prepare what the plan needs, record,
//! submit, wait.

use std::ops::Range;
use std::time::{Duration, Instant};

use scenegraph::scene::Scene;

use super::binding::{self, Layouts};
use super::device::{Gpu, GpuError};
use super::frame_data::{self, FrameData, PASS_STRIDE};
use super::geometry::{Geometry, MeshRange, TriangleRange};
use super::pipelines::{Cull, PipelineCounts, PipelineKey, Pipelines, Stage, VolumePart};
use super::readback;
use super::targets::Targets;
use super::textures::Textures;
use super::volumes::{Casters, VolumeCache, VolumeRanges};
use crate::content::{Content, LightShape, Object, Primitive};
use crate::frame::{self, Pass, PassKind, Plan, Settings, Shadows};
use crate::texture::Images;
use crate::view::{DepthRange, Region, View};

/// What a frame took.
#[derive(Clone, Debug, Default)]
pub struct FrameReport {
    /// Planning.
    pub plan: Duration,
    /// Making shadow volumes.
    pub volumes: Duration,
    /// Writing numbers and recording commands.
    pub encode: Duration,
    /// Waiting for the device.
    pub draw: Duration,
    /// Shaders, pipelines and hits of this frame alone.
    pub pipelines: PipelineCounts,
    /// Lights whose volumes were made anew, and kept.
    pub volumes_made: u32,
    /// Lights whose volumes were kept.
    pub volumes_kept: u32,
    /// For each pass of the plan: draw calls, and primitives drawn.
    pub passes: Vec<PassReport>,
}

/// What a pass drew.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PassReport {
    /// Draw calls.
    pub draw_calls: u64,
    /// Triangles, segments and points; sides count as two triangles.
    pub primitives: u64,
}

/// A scene on the device, ready to be drawn from any view.
pub struct Renderer {
    /// The device.
    pub gpu: Gpu,
    layouts: Layouts,
    pipelines: Pipelines,
    frame_data: FrameData,
    targets: Option<Targets>,
    content: Content,
    geometry: Geometry,
    textures: Textures,
    strokes: [wgpu::BindGroup; 2],
    casters: Option<Casters>,
    volumes: VolumeCache,
    scene: std::sync::Arc<Scene>,
    /// Time taken to upload the scene.
    pub upload_time: Duration,
}

impl Renderer {
    /// Uploads a scene.
    ///
    /// # Errors
    ///
    /// [`GpuError::Device`] if it does not fit.
    pub fn new(gpu: Gpu, scene: std::sync::Arc<Scene>, images: &Images) -> Result<Self, GpuError> {
        let start = Instant::now();
        let layouts = Layouts::new(&gpu.device);
        let frame_data = FrameData::new(&gpu, &layouts);
        let content = Content::new(&scene, images);
        let geometry = Geometry::upload(&gpu.device, &scene, &content);
        let textures = Textures::upload(&gpu, &layouts, &scene, &content, images);
        let strokes = [&geometry.line_ends, &geometry.points].map(|buffer| {
            binding::group(
                &gpu.device,
                "strokes",
                &layouts.strokes,
                vec![buffer.as_entire_binding()],
            )
        });
        gpu.check()?;
        Ok(Self {
            gpu,
            layouts,
            pipelines: Pipelines::default(),
            frame_data,
            targets: None,
            content,
            geometry,
            textures,
            strokes,
            casters: None,
            volumes: VolumeCache::default(),
            scene,
            upload_time: start.elapsed(),
        })
    }

    /// The scene as it is drawn.
    pub fn content(&self) -> &Content {
        &self.content
    }

    /// Bytes on the device: meshes, textures, casters, images of the frame.
    pub fn bytes(&self) -> [u64; 4] {
        [
            self.geometry.bytes,
            self.textures.bytes,
            self.casters.as_ref().map_or(0, |casters| casters.bytes),
            self.targets.as_ref().map_or(0, |targets| targets.bytes),
        ]
    }

    /// Images on the device.
    pub fn texture_count(&self) -> usize {
        self.textures.len()
    }

    /// Surface shaders that sample a texture.
    pub fn textured_shaders(&self) -> usize {
        self.pipelines.textured_shaders()
    }

    /// Draws a view into an image of this size, and waits until it is there.
    ///
    /// # Errors
    ///
    /// [`GpuError::Device`] if the device refuses something or is lost.
    pub fn draw(
        &mut self,
        view: &View,
        region: &Region,
        (width, height): (u32, u32),
        settings: &Settings,
    ) -> Result<(Plan, FrameReport), GpuError> {
        let mut report = FrameReport::default();
        let start = Instant::now();
        let boxes: Vec<_> = self.content.objects.iter().map(|o| o.bounds).collect();
        let range = DepthRange::of(view, region.aspect, &boxes);
        let plan = frame::plan(&self.content, view, region, range.near, settings);
        report.plan = start.elapsed();

        let start = Instant::now();
        let (made, kept) = (self.volumes.made, self.volumes.kept);
        self.prepare_volumes(&plan, settings);
        report.volumes = start.elapsed();
        report.volumes_made = self.volumes.made - made;
        report.volumes_kept = self.volumes.kept - kept;

        let start = Instant::now();
        let before = self.pipelines.counts;
        self.fit_targets(width, height, settings.samples);
        self.prepare_pipelines(&plan, settings);
        report.pipelines = difference(self.pipelines.counts, before);
        let numbers = frame_data::frame(
            view,
            view.clip_from_view(region.aspect, range),
            region,
            self.content.bounds.center(),
        );
        self.frame_data.write(
            &self.gpu,
            &self.layouts,
            &self.content,
            &plan,
            &numbers,
            view,
        );
        let commands = self.record(&plan, region, settings, &mut report);
        self.gpu.queue.submit([commands]);
        report.encode = start.elapsed();

        let start = Instant::now();
        self.gpu
            .device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| GpuError::Device(error.to_string()))?;
        report.draw = start.elapsed();
        self.gpu.check()?;
        Ok((plan, report))
    }

    /// The image of the last frame: RGBA, rows from top to bottom.
    ///
    /// # Errors
    ///
    /// [`GpuError::Device`] if nothing was drawn yet or the device refuses.
    pub fn read(&self) -> Result<Vec<u8>, GpuError> {
        match &self.targets {
            Some(targets) => readback::read(&self.gpu, targets),
            None => Err(GpuError::Device("nothing was drawn".to_owned())),
        }
    }

    fn fit_targets(&mut self, width: u32, height: u32, samples: u32) {
        let fits = self.targets.as_ref().is_some_and(|targets| {
            (targets.width, targets.height, targets.samples) == (width, height, samples)
        });
        if !fits {
            self.targets = Some(Targets::new(&self.gpu, width, height, samples));
        }
    }

    fn prepare_volumes(&mut self, plan: &Plan, settings: &Settings) {
        let Shadows::Volumes { method, .. } = settings.shadows else {
            return;
        };
        for pass in &plan.passes {
            let PassKind::Volumes { light } = pass.kind else {
                continue;
            };
            let casters = self
                .casters
                .get_or_insert_with(|| Casters::upload(&self.gpu, &self.scene, &self.content));
            self.volumes.prepare(
                &self.gpu,
                &self.layouts,
                &self.content,
                casters,
                (light, &plan.lights[light as usize]),
                method,
            );
        }
    }

    fn prepare_pipelines(&mut self, plan: &Plan, settings: &Settings) {
        let samples = settings.samples;
        let mut keys = vec![PipelineKey::Present { samples }];
        if settings.background_srgb[0] != settings.background_srgb[1] {
            keys.push(PipelineKey::Background { samples });
        }
        for pass in &plan.passes {
            for draw in &pass.draws {
                let object = &self.content.objects[draw.objects.start as usize];
                for &cull in culls(pass, object) {
                    keys.push(surface_key(pass, object, draw, cull, samples));
                }
            }
            for part in volume_parts(pass, plan) {
                keys.push(self.volume_key(part, samples));
            }
        }
        for key in keys {
            self.pipelines.prepare(&self.gpu, &self.layouts, key);
        }
    }

    fn volume_key(&self, part: VolumePart, samples: u32) -> PipelineKey {
        PipelineKey::Volume {
            part,
            is_unclipped: part == VolumePart::ZPassSides && self.gpu.has_depth_clip_control,
            samples,
        }
    }

    fn record(
        &self,
        plan: &Plan,
        region: &Region,
        settings: &Settings,
        report: &mut FrameReport,
    ) -> wgpu::CommandBuffer {
        let mut encoder = self
            .gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        if let Some(targets) = &self.targets {
            let recorder = Recorder {
                renderer: self,
                targets,
                region,
                settings,
                plan,
            };
            recorder.background(&mut encoder);
            for pass in &plan.passes {
                report.passes.push(recorder.pass(&mut encoder, pass));
            }
            recorder.present(&mut encoder);
        }
        encoder.finish()
    }
}

fn difference(now: PipelineCounts, before: PipelineCounts) -> PipelineCounts {
    PipelineCounts {
        shaders: now.shaders - before.shaders,
        pipelines: now.pipelines - before.pipelines,
        hits: now.hits - before.hits,
        time: now.time.saturating_sub(before.time),
    }
}

