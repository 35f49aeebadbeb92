//! Pipelines, made when first needed and kept. The caches are keyed by everything that a pipeline
//! depends on, so a second frame of the same scene makes none.

use std::collections::hash_map::Entry;
use std::time::{Duration, Instant};

use rustc_hash::FxHashMap;

use super::binding::Layouts;
use super::device::Gpu;
use super::targets::{COLOR_FORMAT, DEPTH_FORMAT, MAP_FORMAT, OUTPUT_FORMAT};
use crate::content::Primitive;
use crate::shader::{self, ShaderKey, ShadowLookup};

/// The bits of the stencil that count while one keeps the result of earlier layers.
const LAYER_BITS: u32 = 0x7f;
/// The one that keeps it.
pub const LAYER_FLAG: u32 = 0x80;

/// How a surface shader is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Nearest wins, depth is written.
    First,
    /// Added where the depth is equal.
    Add {
        /// And where the stencil is zero.
        tests_stencil: bool,
    },
    /// Blended over what is there.
    Blend,
}

/// Which faces are left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cull {
    /// None.
    None,
    /// Back faces.
    Back,
    /// Front faces.
    Front,
}

/// A part of shadow volumes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VolumePart {
    /// Sides counted in front of the scene.
    ZPassSides,
    /// Sides counted behind it.
    ZFailSides,
    /// Triangles that face the light, or away from it.
    LightCap {
        /// They face it.
        is_pos: bool,
    },
    /// The same at infinity.
    DarkCap {
        /// They face it.
        is_pos: bool,
    },
}

/// Everything a pipeline depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PipelineKey {
    /// Draws objects.
    Surface {
        /// By this shader.
        shader: ShaderKey,
        /// In this stage.
        stage: Stage,
        /// Without these faces.
        cull: Cull,
        /// Front is clockwise.
        is_mirrored: bool,
        /// Samples a pixel.
        samples: u32,
    },
    /// Counts shadow volumes.
    Volume {
        /// This part.
        part: VolumePart,
        /// The near plane cuts nothing.
        is_unclipped: bool,
        /// Counts in seven bits; the eighth keeps what the layers before found.
        is_layered: bool,
        /// Samples a pixel.
        samples: u32,
    },
    /// Ends a layer of volumes: where the seven bits are not zero the eighth is set, and they
    /// become zero.
    EndLayer {
        /// Samples a pixel.
        samples: u32,
    },
    /// Begins a layer: the seven bits become the reference.
    BeginLayer {
        /// Samples a pixel.
        samples: u32,
    },
    /// Draws depth as a light sees it.
    Map,
    /// Draws the gradient.
    Background {
        /// Samples a pixel.
        samples: u32,
    },
    /// Turns summed light into the image.
    Present {
        /// Samples a pixel of the light.
        samples: u32,
    },
}

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
            PipelineKey::Volume { .. } => ModuleKey::Volume,
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
                cull,
                is_mirrored,
                samples,
            } => {
                let front = front_face(!is_mirrored);
                surface(gpu, layouts, module, &shader, (stage, cull, front, samples))
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
        ModuleKey::Background => shader::BACKGROUND.to_owned(),
        ModuleKey::Present(samples) => shader::emit_present(samples),
    };
    gpu.device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("generated"),
            source: wgpu::ShaderSource::Wgsl(text.into()),
        })
}

fn vertex_buffers(shader: &ShaderKey) -> Vec<Option<wgpu::VertexBufferLayout<'static>>> {
    const POSITION: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![0 => Float32x3];
    const NORMAL: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![1 => Float32x3];
    const TEXCOORD: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![2 => Float32x2];
    const COLOR: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![3 => Float32x4];
    if shader.primitive != Primitive::Triangles {
        return Vec::new();
    }
    let buffer = |attributes, array_stride| wgpu::VertexBufferLayout {
        array_stride,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes,
    };
    vec![
        Some(buffer(&POSITION[..], 12)),
        shader.has_normals().then(|| buffer(&NORMAL[..], 12)),
        shader.texture.map(|_| buffer(&TEXCOORD[..], 8)),
        shader.has_colors.then(|| buffer(&COLOR[..], 16)),
    ]
}

fn front_face(is_ccw: bool) -> wgpu::FrontFace {
    if is_ccw {
        wgpu::FrontFace::Ccw
    } else {
        wgpu::FrontFace::Cw
    }
}

fn surface(
    gpu: &Gpu,
    layouts: &Layouts,
    module: &wgpu::ShaderModule,
    shader: &ShaderKey,
    (stage, cull, front_face, samples): (Stage, Cull, wgpu::FrontFace, u32),
) -> wgpu::RenderPipeline {
    let group_3 = match shader.light().map(|light| light.shadow) {
        Some(ShadowLookup::Map | ShadowLookup::CubeMap) => Some(&layouts.shadow_map),
        Some(ShadowLookup::Mask) => Some(&layouts.shadow_mask),
        _ => None,
    };
    let group_2 = match (shader.primitive, shader.texture) {
        (Primitive::Triangles, None) => group_3.map(|_| &layouts.nothing),
        (Primitive::Triangles, Some(_)) => Some(&layouts.image),
        _ => Some(&layouts.strokes),
    };
    let layout = pipeline_layout(
        gpu,
        &[Some(&layouts.scene), Some(&layouts.pass), group_2, group_3],
    );
    let one = wgpu::BlendFactor::One;
    let add = wgpu::BlendOperation::Add;
    let over = |src_factor, dst_factor| wgpu::BlendComponent {
        src_factor,
        dst_factor,
        operation: add,
    };
    let blend = match stage {
        Stage::First => None,
        Stage::Add { .. } => Some(wgpu::BlendState {
            color: over(one, one),
            alpha: over(wgpu::BlendFactor::Zero, one),
        }),
        Stage::Blend => Some(wgpu::BlendState {
            color: over(
                wgpu::BlendFactor::SrcAlpha,
                wgpu::BlendFactor::OneMinusSrcAlpha,
            ),
            alpha: over(wgpu::BlendFactor::Zero, one),
        }),
    };
    let stencil_face = wgpu::StencilFaceState {
        compare: match stage {
            Stage::Add {
                tests_stencil: true,
            } => wgpu::CompareFunction::Equal,
            _ => wgpu::CompareFunction::Always,
        },
        ..wgpu::StencilFaceState::IGNORE
    };
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("surface"),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some("place"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &vertex_buffers(shader),
            },
            primitive: wgpu::PrimitiveState {
                front_face,
                cull_mode: match cull {
                    Cull::None => None,
                    Cull::Back => Some(wgpu::Face::Back),
                    Cull::Front => Some(wgpu::Face::Front),
                },
                ..wgpu::PrimitiveState::default()
            },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(stage == Stage::First),
                depth_compare: Some(match stage {
                    Stage::Add { .. } => wgpu::CompareFunction::Equal,
                    _ => wgpu::CompareFunction::Greater,
                }),
                stencil: wgpu::StencilState {
                    front: stencil_face,
                    back: stencil_face,
                    read_mask: 0xff,
                    write_mask: 0,
                },
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: multisample(samples),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some("shade"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(wgpu::ColorTargetState {
                    format: COLOR_FORMAT,
                    blend,
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        })
}

fn volume(
    gpu: &Gpu,
    layouts: &Layouts,
    module: &wgpu::ShaderModule,
    part: VolumePart,
    (is_unclipped, write_mask, samples): (bool, u32, u32),
) -> wgpu::RenderPipeline {
    let layout = pipeline_layout(
        gpu,
        &[
            Some(&layouts.scene),
            Some(&layouts.pass),
            Some(&layouts.volumes),
        ],
    );
    let (entry_point, is_front_ccw) = match part {
        VolumePart::ZPassSides | VolumePart::ZFailSides => ("side", true),
        VolumePart::LightCap { is_pos } => ("light_cap", is_pos),
        VolumePart::DarkCap { is_pos } => ("dark_cap", !is_pos),
    };
    // Z-pass counts what lies before the scene: in at a front face, out at a back face. Z-fail
    // counts what does not: from infinity towards the eye, so in at a back face.
    let face = |operation| match part {
        VolumePart::ZPassSides => wgpu::StencilFaceState {
            compare: wgpu::CompareFunction::Always,
            fail_op: wgpu::StencilOperation::Keep,
            depth_fail_op: wgpu::StencilOperation::Keep,
            pass_op: operation,
        },
        _ => wgpu::StencilFaceState {
            compare: wgpu::CompareFunction::Always,
            fail_op: wgpu::StencilOperation::Keep,
            depth_fail_op: operation,
            pass_op: wgpu::StencilOperation::Keep,
        },
    };
    let (up, down) = (
        wgpu::StencilOperation::IncrementWrap,
        wgpu::StencilOperation::DecrementWrap,
    );
    let (front, back) = match part {
        VolumePart::ZPassSides => (face(up), face(down)),
        _ => (face(down), face(up)),
    };
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("volume"),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState {
                front_face: front_face(is_front_ccw),
                cull_mode: None,
                unclipped_depth: is_unclipped,
                ..wgpu::PrimitiveState::default()
            },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(false),
                depth_compare: Some(wgpu::CompareFunction::Greater),
                stencil: wgpu::StencilState {
                    front,
                    back,
                    read_mask: 0xff,
                    write_mask,
                },
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: multisample(samples),
            fragment: None,
            multiview_mask: None,
            cache: None,
        })
}

/// Changes the stencil of the whole image where its seven bits compare with zero.
fn layer(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    compare: wgpu::CompareFunction,
    write_mask: u32,
    samples: u32,
) -> wgpu::RenderPipeline {
    let face = wgpu::StencilFaceState {
        compare,
        pass_op: wgpu::StencilOperation::Replace,
        ..wgpu::StencilFaceState::IGNORE
    };
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("layer"),
            layout: Some(&pipeline_layout(gpu, &[])),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some("whole"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(false),
                depth_compare: Some(wgpu::CompareFunction::Always),
                stencil: wgpu::StencilState {
                    front: face,
                    back: face,
                    read_mask: LAYER_BITS,
                    write_mask,
                },
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: multisample(samples),
            fragment: None,
            multiview_mask: None,
            cache: None,
        })
}

/// Depth as a light sees it, moved away from it by two steps and twice the slope: what is lit must
/// not shadow itself by rounding.
fn map(gpu: &Gpu, layouts: &Layouts, module: &wgpu::ShaderModule) -> wgpu::RenderPipeline {
    let layout = pipeline_layout(
        gpu,
        &[
            Some(&layouts.scene),
            Some(&layouts.pass),
            Some(&layouts.map_view),
        ],
    );
    const POSITION: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![0 => Float32x3];
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("map"),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some("place_in_map"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: 12,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: &POSITION,
                })],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: MAP_FORMAT,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState {
                    constant: 2,
                    slope_scale: 2.0,
                    clamp: 0.0,
                },
            }),
            multisample: multisample(1),
            fragment: None,
            multiview_mask: None,
            cache: None,
        })
}

/// A pipeline without geometry and without depth.
fn whole_image(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    entry_point: &str,
    format: wgpu::TextureFormat,
    samples: u32,
) -> wgpu::RenderPipeline {
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(entry_point),
            layout: None,
            vertex: wgpu::VertexState {
                module,
                entry_point: Some("whole"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: multisample(samples),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(wgpu::ColorTargetState {
                    format,
                    blend: None,
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        })
}

fn multisample(count: u32) -> wgpu::MultisampleState {
    wgpu::MultisampleState {
        count,
        ..wgpu::MultisampleState::default()
    }
}

fn pipeline_layout(gpu: &Gpu, groups: &[Option<&wgpu::BindGroupLayout>]) -> wgpu::PipelineLayout {
    gpu.device
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: groups,
            immediate_size: 0,
        })
}
