//! Makes the pipelines of what is drawn over a picture.

use super::binding::Layouts;
use super::device::Gpu;
use super::pipeline_key::{FlatKind, VolumePart};
use super::pipeline_make::{multisample, pipeline_layout};
use super::targets::{COLOR_FORMAT, DEPTH_FORMAT};

const ALPHA: wgpu::ColorTargetState = wgpu::ColorTargetState {
    format: COLOR_FORMAT,
    blend: Some(wgpu::BlendState {
        color: wgpu::BlendComponent {
            src_factor: wgpu::BlendFactor::SrcAlpha,
            dst_factor: wgpu::BlendFactor::OneMinusSrcAlpha,
            operation: wgpu::BlendOperation::Add,
        },
        alpha: wgpu::BlendComponent {
            src_factor: wgpu::BlendFactor::Zero,
            dst_factor: wgpu::BlendFactor::One,
            operation: wgpu::BlendOperation::Add,
        },
    }),
    write_mask: wgpu::ColorWrites::ALL,
};

fn depth(compare: wgpu::CompareFunction, writes: bool) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH_FORMAT,
        depth_write_enabled: Some(writes),
        depth_compare: Some(compare),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}

/// Draws objects or lists in a plain colour.
pub fn flat(
    gpu: &Gpu,
    layouts: &Layouts,
    module: &wgpu::ShaderModule,
    kind: FlatKind,
    samples: u32,
) -> wgpu::RenderPipeline {
    const POSITION: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![0 => Float32x3];
    const SEGMENT: [wgpu::VertexAttribute; 4] =
        wgpu::vertex_attr_array![0 => Float32x3, 1 => Uint32, 2 => Float32x3, 3 => Unorm8x4];
    const CAP: [wgpu::VertexAttribute; 3] =
        wgpu::vertex_attr_array![0 => Float32x3, 1 => Uint32, 2 => Unorm8x4];
    let (vertex, step, attributes, stride): (_, _, &[wgpu::VertexAttribute], _) = match kind {
        FlatKind::Segment => ("segment", wgpu::VertexStepMode::Instance, &SEGMENT, 32),
        FlatKind::Cap => ("cap", wgpu::VertexStepMode::Vertex, &CAP, 20),
        FlatKind::Tint => ("tint", wgpu::VertexStepMode::Vertex, &POSITION, 12),
        FlatKind::TintBehind => ("tint_behind", wgpu::VertexStepMode::Vertex, &POSITION, 12),
        FlatKind::Wire => ("wire", wgpu::VertexStepMode::Vertex, &POSITION, 12),
        FlatKind::Point => ("dot_at", wgpu::VertexStepMode::Vertex, &POSITION, 12),
    };
    let compare = match kind {
        FlatKind::TintBehind => wgpu::CompareFunction::Less,
        _ => wgpu::CompareFunction::Greater,
    };
    let is_cap = kind == FlatKind::Cap;
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("overlay"),
            layout: Some(&pipeline_layout(
                gpu,
                &[Some(&layouts.scene), Some(&layouts.pass)],
            )),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: stride,
                    step_mode: step,
                    attributes,
                })],
            },
            primitive: wgpu::PrimitiveState {
                polygon_mode: match kind {
                    FlatKind::Wire => wgpu::PolygonMode::Line,
                    FlatKind::Point => wgpu::PolygonMode::Point,
                    _ => wgpu::PolygonMode::Fill,
                },
                ..wgpu::PrimitiveState::default()
            },
            depth_stencil: Some(depth(compare, is_cap)),
            multisample: multisample(samples),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some(if is_cap { "cap_color" } else { "flat_color" }),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(ALPHA)],
            }),
            multiview_mask: None,
            cache: None,
        })
}

/// Draws the sides of shadow volumes, where they are before the scene.
pub fn shown_volume(
    gpu: &Gpu,
    layouts: &Layouts,
    module: &wgpu::ShaderModule,
    part: VolumePart,
    samples: u32,
) -> wgpu::RenderPipeline {
    let entry_point = match part {
        VolumePart::ZPassSides => "side_cut",
        _ => "side",
    };
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("shown volume"),
            layout: Some(&pipeline_layout(
                gpu,
                &[
                    Some(&layouts.scene),
                    Some(&layouts.pass),
                    Some(&layouts.volumes),
                ],
            )),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(depth(wgpu::CompareFunction::Greater, false)),
            multisample: multisample(samples),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some("shown"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(ALPHA)],
            }),
            multiview_mask: None,
            cache: None,
        })
}
