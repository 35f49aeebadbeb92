//! Everything that touches the device; no other module names wgpu.

mod binding;
mod casters;
mod compute;
mod device;
mod frame_data;
mod geometry;
mod occlusion;
mod overlay;
mod pipeline_flat;
mod pipeline_key;
mod pipeline_make;
mod pipelines;
mod prepare;
mod rays;
mod readback;
mod record;
mod record_shadows;
mod renderer;
mod shadow_map;
mod targets;
mod textures;
mod volume_maker;
mod volumes;

pub use device::{AdapterChoice, Gpu, GpuError};
pub use renderer::{FrameReport, PassReport, Renderer};
