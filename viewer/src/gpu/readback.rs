//! The final image as bytes.

use super::device::{Gpu, GpuError};
use super::targets::Targets;

/// The image, four bytes a pixel, rows from top to bottom without padding.
///
/// # Errors
///
/// [`GpuError::Device`] if the device refuses.
pub fn read(gpu: &Gpu, targets: &Targets) -> Result<Vec<u8>, GpuError> {
    let row = targets.width * 4;
    let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size: u64::from(padded) * u64::from(targets.height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_texture_to_buffer(
        targets.output.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(padded),
                rows_per_image: None,
            },
        },
        targets.output.size(),
    );
    gpu.queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |_| {});
    gpu.device
        .poll(wgpu::PollType::wait_indefinitely())
        .map_err(|error| GpuError::Device(error.to_string()))?;
    gpu.check()?;
    let mapped = buffer
        .get_mapped_range(..)
        .map_err(|error| GpuError::Device(error.to_string()))?;
    let mut pixels = Vec::with_capacity(row as usize * targets.height as usize);
    for line in mapped.chunks_exact(padded as usize) {
        pixels.extend_from_slice(&line[..row as usize]);
    }
    Ok(pixels)
}
