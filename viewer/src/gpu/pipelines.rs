//! Pipelines, made when first needed and kept. The caches are keyed by everything that a pipeline
//! depends on, so a second frame of the same scene makes none.

use std::collections::hash_map::Entry;
use std::time::{Duration, Instant};

use rustc_hash::FxHashMap;

use super::binding::Layouts;
use super::device::Gpu;
use super::pipeline_flat::{flat, shown_volume};
use super::pipeline_key::{LAYER_BITS, PipelineKey};
use super::pipeline_make::{front_face, layer, map, surface, volume, whole_image};
use super::targets::{COLOR_FORMAT, OUTPUT_FORMAT};
use crate::shader::{self, ShaderKey};

/// What making pipelines took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PipelineCounts {
    /// Shader texts compiled.
    pub shaders: u32,
    /// Pipelines made.
    pub pipelines: u32,
    /// Times a pipeline was asked for and there.
    pub hits: u32,
    /// Time taken.
    pub time: Duration,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum ModuleKey {
    Surface(ShaderKey),
    Volume,
    Map,
    Overlay,
    Background,
    Present(u32),
}

/// The caches.
#[derive(Default)]
pub struct Pipelines {
    modules: FxHashMap<ModuleKey, wgpu::ShaderModule>,
    pipelines: FxHashMap<PipelineKey, wgpu::RenderPipeline>,
    /// Since the beginning.
    pub counts: PipelineCounts,
}

impl Pipelines {
    /// Makes a pipeline unless it is there.
    pub fn prepare(&mut self, gpu: &Gpu, layouts: &Layouts, key: PipelineKey) {
        if self.pipelines.contains_key(&key) {
            self.counts.hits += 1;
            return;
        }
        let start = Instant::now();
        let module_key = match key {
            PipelineKey::Surface { shader, .. } => ModuleKey::Surface(shader),
            PipelineKey::Volume { .. } | PipelineKey::ShownVolume { .. } => ModuleKey::Volume,
            PipelineKey::Flat { .. } => ModuleKey::Overlay,
            PipelineKey::Map => ModuleKey::Map,
            // Any triangle over the whole image will do.
            PipelineKey::EndLayer { .. }
            | PipelineKey::BeginLayer { .. }
            | PipelineKey::Background { .. } => ModuleKey::Background,
            PipelineKey::Present { samples } => ModuleKey::Present(samples),
        };
        let module = match self.modules.entry(module_key) {
            Entry::Occupied(there) => there.into_mut(),
            Entry::Vacant(place) => {
                self.counts.shaders += 1;
                place.insert(module(gpu, module_key))
            }
        };
        let pipeline = match key {
            PipelineKey::Surface {
                shader,
                stage,
                pixels,
                cull,
                is_mirrored,
                samples,
            } => {
                let front = front_face(!is_mirrored);
                let drawn = (stage, pixels, cull, front, samples);
                surface(gpu, layouts, module, &shader, drawn)
            }
            PipelineKey::Volume {
                part,
                is_unclipped,
                is_layered,
                samples,
            } => {
                let mask = if is_layered { LAYER_BITS } else { 0xff };
                volume(gpu, layouts, module, part, (is_unclipped, mask, samples))
            }
            PipelineKey::Map => map(gpu, layouts, module),
            PipelineKey::Flat { kind, samples } => flat(gpu, layouts, module, kind, samples),
            PipelineKey::ShownVolume { part, samples } => {
                shown_volume(gpu, layouts, module, part, samples)
            }
            PipelineKey::EndLayer { samples } => {
                layer(gpu, module, wgpu::CompareFunction::NotEqual, 0xff, samples)
            }
            PipelineKey::BeginLayer { samples } => layer(
                gpu,
                module,
                wgpu::CompareFunction::Always,
                LAYER_BITS,
                samples,
            ),
            PipelineKey::Background { samples } => {
                whole_image(gpu, module, "background", COLOR_FORMAT, samples)
            }
            PipelineKey::Present { .. } => whole_image(gpu, module, "present", OUTPUT_FORMAT, 1),
        };
        self.counts.pipelines += 1;
        self.counts.time += start.elapsed();
        self.pipelines.insert(key, pipeline);
    }

    /// A pipeline that was prepared.
    pub fn get(&self, key: &PipelineKey) -> Option<&wgpu::RenderPipeline> {
        self.pipelines.get(key)
    }

    /// How many surface shaders sample a texture.
    pub fn textured_shaders(&self) -> usize {
        self.modules
            .keys()
            .filter(|key| matches!(key, ModuleKey::Surface(shader) if shader.texture.is_some()))
            .count()
    }
}

fn module(gpu: &Gpu, key: ModuleKey) -> wgpu::ShaderModule {
    let text = match key {
        ModuleKey::Surface(shader) => shader::emit(&shader),
        ModuleKey::Volume => format!("{}{}", shader::TYPES, shader::VOLUME),
        ModuleKey::Map => format!("{}{}", shader::TYPES, shader::MAP),
        ModuleKey::Overlay => format!("{}{}", shader::TYPES, shader::OVERLAY),
        ModuleKey::Background => shader::BACKGROUND.to_owned(),
        ModuleKey::Present(samples) => shader::emit_present(samples),
    };
    gpu.device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("generated"),
            source: wgpu::ShaderSource::Wgsl(text.into()),
        })
}
