//! A scene on the device, and the one way to draw it: plan, prepare what the plan needs, record,
//! submit, wait; in large scenes what lies behind is asked in between.

use std::sync::Arc;
use std::time::{Duration, Instant};

use rustc_hash::FxHashMap;
use scenegraph::scene::Scene;

use super::binding::{self, Layouts};
use super::casters::Casters;
use super::compute::{ComputedVolumes, Extractor};
use super::device::{Gpu, GpuError};
use super::frame_data::{self, FrameData};
use super::geometry::Geometry;
use super::occlusion::OcclusionTest;
use super::overlay::OverlayBuffers;
use super::pipelines::{PipelineCounts, Pipelines};
use super::rays::Rays;
use super::readback;
use super::record::Recorder;
use super::shadow_map::ShadowMap;
use super::targets::Targets;
use super::textures::Textures;
use super::volumes::VolumeCache;
use crate::content::{Content, Edits, LightShape};
use crate::frame::{self, Plan, Settings};
use crate::shader::Frame;
use crate::texture::Images;
use crate::view::{DepthRange, Region, View};

/// What a frame took.
#[derive(Clone, Debug, Default)]
pub struct FrameReport {
    /// Planning.
    pub plan: Duration,
    /// Making shadow volumes, maps or ray structures.
    pub shadows: Duration,
    /// Making shaders and pipelines.
    pub compile: Duration,
    /// Writing numbers and recording commands.
    pub encode: Duration,
    /// Drawing what was seen last, and finding out what lies behind it.
    pub occlusion: Duration,
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
    pub(super) layouts: Layouts,
    pub(super) pipelines: Pipelines,
    pub(super) frame_data: FrameData,
    pub(super) targets: Option<Targets>,
    pub(super) content: Content,
    pub(super) geometry: Geometry,
    pub(super) textures: Textures,
    pub(super) strokes: [wgpu::BindGroup; 2],
    pub(super) nothing: wgpu::BindGroup,
    pub(super) casters: Option<Casters>,
    pub(super) volumes: VolumeCache,
    pub(super) extractor: Option<Extractor>,
    /// By light, with the shape it had.
    pub(super) computed: FxHashMap<u32, (LightShape, ComputedVolumes)>,
    pub(super) maps: FxHashMap<u32, ShadowMap>,
    pub(super) rays: Option<Rays>,
    /// The stencil of one sample a pixel, to read.
    pub(super) stencil: Option<wgpu::BindGroup>,
    pub(super) overlay: OverlayBuffers,
    occlusion: OcclusionTest,
    pub(super) scene: Arc<Scene>,
    /// Time taken to upload the scene.
    pub upload_time: Duration,
}

impl Renderer {
    /// Uploads a scene.
    ///
    /// # Errors
    ///
    /// [`GpuError::Device`] if it does not fit.
    pub fn new(gpu: Gpu, scene: Arc<Scene>, images: &Images) -> Result<Self, GpuError> {
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
        let nothing = binding::group(&gpu.device, "nothing", &layouts.nothing, Vec::new());
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
            nothing,
            casters: None,
            volumes: VolumeCache::default(),
            extractor: None,
            computed: FxHashMap::default(),
            maps: FxHashMap::default(),
            rays: None,
            stencil: None,
            overlay: OverlayBuffers::default(),
            occlusion: OcclusionTest::default(),
            scene,
            upload_time: start.elapsed(),
        })
    }

    /// The scene as it is drawn.
    pub fn content(&self) -> &Content {
        &self.content
    }

    /// Shows the scene as a user wants it from the next frame on.
    pub fn apply(&mut self, edits: &Edits) {
        self.content.apply(&self.scene, edits);
        // All that was made of the casters, which may be others now.
        self.casters = None;
        self.volumes = VolumeCache::default();
        self.computed.clear();
        self.rays = None;
        self.occlusion.forget();
    }

    /// Shows textures from the next frame on: those that `images` has.
    pub fn set_images(&mut self, images: &Images, edits: &Edits) {
        self.content = Content::new(&self.scene, images);
        self.textures =
            Textures::upload(&self.gpu, &self.layouts, &self.scene, &self.content, images);
        self.apply(edits);
    }

    /// Bytes on the device: meshes, textures, casters, shadows of lights, images of the frame.
    pub fn bytes(&self) -> [u64; 5] {
        let maps: u64 = self.maps.values().map(ShadowMap::bytes).sum();
        let rays = self.rays.as_ref().map_or(0, Rays::bytes);
        [
            self.geometry.bytes,
            self.textures.bytes,
            self.casters.as_ref().map_or(0, |casters| casters.bytes),
            self.volumes.bytes() + maps + rays,
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
        let shown = self.content.objects.iter().filter(|o| !o.is_hidden);
        let boxes: Vec<_> = shown.map(|o| o.bounds).collect();
        let range = DepthRange::of(view, region.aspect, &boxes);
        let content = &self.content;
        let size = (width, height);
        let tests_occlusion = self.occlusion.is_wanted(content, settings, region, size);
        let near = range.near;
        let mut plan = frame::plan(content, view, region, near, settings, tests_occlusion);
        report.plan = start.elapsed();

        let start = Instant::now();
        let (made, kept) = (self.volumes.made, self.volumes.kept);
        self.fit_targets(width, height, settings.samples);
        self.prepare_shadows(&plan, view, settings);
        self.overlay.prepare(&self.gpu, &settings.overlay);
        report.shadows = start.elapsed();
        report.volumes_made = self.volumes.made - made;
        report.volumes_kept = self.volumes.kept - kept;

        let start = Instant::now();
        let before = self.pipelines.counts;
        self.prepare_pipelines(&plan, view, settings);
        report.pipelines = difference(self.pipelines.counts, before);
        report.compile = start.elapsed();

        let start = Instant::now();
        let numbers = frame_data::frame(
            view,
            view.clip_from_view(region.aspect, range),
            region,
            self.content.bounds.center(),
            settings.section,
        );
        self.frame_data.write(
            (&self.gpu, &self.layouts),
            &self.content,
            &plan,
            &numbers,
            view,
            &self.far_planes(&plan),
        );
        report.encode = start.elapsed();
        let scenery = (view, region, settings);
        if tests_occlusion {
            let start = Instant::now();
            self.leave_out_hidden(&mut plan, scenery, &numbers, &mut report)?;
            report.occlusion = start.elapsed();
        }

        let start = Instant::now();
        let commands = self.record(&plan, scenery, &mut report);
        self.gpu.queue.submit([commands]);
        report.encode += start.elapsed();

        let start = Instant::now();
        self.gpu
            .device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| GpuError::Device(error.to_string()))?;
        report.draw = start.elapsed();
        self.gpu.check()?;
        Ok((plan, report))
    }

    /// The image of the last frame, on the device.
    pub fn picture(&self) -> Option<&wgpu::TextureView> {
        self.targets.as_ref().map(|targets| &targets.output_view)
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
        if fits {
            return;
        }
        let targets = Targets::new(&self.gpu, width, height, samples);
        self.stencil = (samples == 1).then(|| {
            let view = wgpu::BindingResource::TextureView(&targets.stencil_only);
            let layout = &self.layouts.shadow_mask;
            binding::group(&self.gpu.device, "stencil", layout, vec![view])
        });
        self.targets = Some(targets);
    }

    /// Draws the depth of what was seen last, asks what lies behind it, and leaves that out of the
    /// plan, whose first pass is done then.
    fn leave_out_hidden(
        &mut self,
        plan: &mut Plan,
        scenery: (&View, &Region, &Settings),
        numbers: &Frame,
        report: &mut FrameReport,
    ) -> Result<(), GpuError> {
        // Also those that are left out of the first pass.
        let objects = plan.objects_drawn();
        if !plan.part_depth(self.occlusion.hidden()) {
            return Ok(());
        }
        let mut encoder = self.encoder();
        let mut occlusion = std::mem::take(&mut self.occlusion);
        if let Some(recorder) = self.recorder(plan, scenery) {
            let depth = recorder.pass(&mut encoder, &plan.passes[0]);
            report.passes.push(depth);
            let seen = (scenery.0, numbers);
            let (targets, content) = (recorder.targets, &self.content);
            occlusion.ask(&self.gpu, targets, content, &objects, seen, encoder)?;
        }
        self.occlusion = occlusion;
        plan.leave_out(self.occlusion.hidden());
        Ok(())
    }

    fn encoder(&self) -> wgpu::CommandEncoder {
        let descriptor = wgpu::CommandEncoderDescriptor::default();
        self.gpu.device.create_command_encoder(&descriptor)
    }

    fn recorder<'r>(
        &'r self,
        plan: &'r Plan,
        (view, region, settings): (&'r View, &'r Region, &'r Settings),
    ) -> Option<Recorder<'r>> {
        self.targets.as_ref().map(|targets| Recorder {
            renderer: self,
            targets,
            view,
            region,
            settings,
            plan,
        })
    }

    /// All passes but those that the report has already.
    fn record(
        &self,
        plan: &Plan,
        scenery: (&View, &Region, &Settings),
        report: &mut FrameReport,
    ) -> wgpu::CommandBuffer {
        let mut encoder = self.encoder();
        if let Some(recorder) = self.recorder(plan, scenery) {
            recorder.background(&mut encoder);
            for pass in plan.passes.iter().skip(report.passes.len()) {
                report.passes.push(recorder.pass(&mut encoder, pass));
            }
            recorder.overlay(&mut encoder);
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
