//! Everything that touches the device; no other module names wgpu.

mod binding;
mod compute;
mod device;
mod frame_data;
mod geometry;
mod pipelines;
mod rays;
mod readback;
mod record;
mod renderer;
mod shadow_map;
mod targets;
mod textures;
mod volumes;

pub use device::{AdapterChoice, Gpu, GpuError};
pub use renderer::{FrameReport, PassReport, Renderer};
