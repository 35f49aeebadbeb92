//! Makes pipelines. Keeps none: that is the business of `pipelines`.

use super::binding::Layouts;
use super::device::Gpu;
use super::pipeline_key::{Cull, LAYER_BITS, Stage, VolumePart};
use super::targets::{COLOR_FORMAT, DEPTH_FORMAT, MAP_FORMAT};
use crate::content::Primitive;
use crate::frame::Pixels;
use crate::shader::{ShaderKey, ShadowLookup};

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

/// Which way round front faces are.
pub fn front_face(is_ccw: bool) -> wgpu::FrontFace {
    if is_ccw {
        wgpu::FrontFace::Ccw
    } else {
        wgpu::FrontFace::Cw
    }
}

/// Draws objects.
pub fn surface(
    gpu: &Gpu,
    layouts: &Layouts,
    module: &wgpu::ShaderModule,
    shader: &ShaderKey,
    (stage, pixels, cull, front_face, samples): (Stage, Pixels, Cull, wgpu::FrontFace, u32),
) -> wgpu::RenderPipeline {
    let group_3 = match shader.light().map(|light| light.shadow) {
        Some(ShadowLookup::Map | ShadowLookup::CubeMap) => Some(&layouts.shadow_map),
        Some(ShadowLookup::Mask | ShadowLookup::Stencil) => Some(&layouts.shadow_mask),
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
        Stage::Depth | Stage::First | Stage::FirstAtDepth => None,
        Stage::Add => Some(wgpu::BlendState {
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
    let targets = [Some(wgpu::ColorTargetState {
        format: COLOR_FORMAT,
        blend,
        write_mask: wgpu::ColorWrites::ALL,
    })];
    let stencil_face = wgpu::StencilFaceState {
        compare: match pixels {
            Pixels::All => wgpu::CompareFunction::Always,
            Pixels::Lit => wgpu::CompareFunction::Equal,
            Pixels::Shadowed => wgpu::CompareFunction::NotEqual,
        },
        // Of surfaces in one place one is lit: it takes the pixel out of the lit ones.
        pass_op: match stage {
            Stage::Add => wgpu::StencilOperation::IncrementClamp,
            _ => wgpu::StencilOperation::Keep,
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
                depth_write_enabled: Some(matches!(stage, Stage::Depth | Stage::First)),
                depth_compare: Some(match stage {
                    Stage::FirstAtDepth | Stage::Add => wgpu::CompareFunction::Equal,
                    _ => wgpu::CompareFunction::Greater,
                }),
                stencil: wgpu::StencilState {
                    front: stencil_face,
                    back: stencil_face,
                    read_mask: 0xff,
                    write_mask: if stage == Stage::Add { 0xff } else { 0 },
                },
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: multisample(samples),
            fragment: (stage != Stage::Depth || shader.is_cut).then_some(wgpu::FragmentState {
                module,
                entry_point: Some("shade"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: if stage == Stage::Depth { &[] } else { &targets },
            }),
            multiview_mask: None,
            cache: None,
        })
}

/// Counts shadow volumes.
pub fn volume(
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
        VolumePart::ZPassSides => ("side_cut", true),
        VolumePart::ZFailSides => ("side", true),
        VolumePart::ZPassLightCap { is_pos } | VolumePart::LightCap { is_pos } => {
            ("light_cap", is_pos)
        }
        VolumePart::DarkCap { is_pos } => ("dark_cap", !is_pos),
    };
    // Z-pass counts what lies before the scene: in at a front face, out at a back face. Z-fail
    // counts what does not: from infinity towards the eye, so in at a back face.
    let is_z_pass = matches!(
        part,
        VolumePart::ZPassSides | VolumePart::ZPassLightCap { .. }
    );
    let face = |operation| match is_z_pass {
        true => wgpu::StencilFaceState {
            compare: wgpu::CompareFunction::Always,
            fail_op: wgpu::StencilOperation::Keep,
            depth_fail_op: wgpu::StencilOperation::Keep,
            pass_op: operation,
        },
        false => wgpu::StencilFaceState {
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
    let (front, back) = match is_z_pass {
        true => (face(up), face(down)),
        false => (face(down), face(up)),
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
pub fn layer(
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
pub fn map(gpu: &Gpu, layouts: &Layouts, module: &wgpu::ShaderModule) -> wgpu::RenderPipeline {
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
pub fn whole_image(
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

pub fn multisample(count: u32) -> wgpu::MultisampleState {
    wgpu::MultisampleState {
        count,
        ..wgpu::MultisampleState::default()
    }
}

pub fn pipeline_layout(
    gpu: &Gpu,
    groups: &[Option<&wgpu::BindGroupLayout>],
) -> wgpu::PipelineLayout {
    gpu.device
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: groups,
            immediate_size: 0,
        })
}
