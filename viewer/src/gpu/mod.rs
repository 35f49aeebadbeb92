//! Everything that touches the device; no other module names wgpu.

mod binding;
mod device;
mod encode;
mod frame_data;
mod geometry;
mod pipelines;
mod readback;
mod targets;
mod textures;
mod volumes;

pub use device::{AdapterChoice, Gpu, GpuError};
pub use encode::{FrameReport, PassReport, Renderer};
