//! The numbers of a buffer, streamed from the scene's arrays: as they are where the machine's byte
//! order is glTF's and nothing changes, else through one small block.

use std::io::{self, Write};

use bytemuck::Pod;
use scenegraph::scene::{Mesh, Scene};

use crate::color::{linear_from_srgb, u16_from_unit};
use crate::formats::{
    Positions, i8_from_signed, i16_from_signed, steps, u8_from_unit, u16_from_share,
};
use crate::layout::{Accessor, Data, Layout, Needs};
use crate::texture::Textures;

/// A multiple of every element's size, small enough to stay in the processor's cache.
const BLOCK_BYTES: usize = 24 * 1024;

/// Writes buffer number `buffer`, exactly as long as the layout says.
pub(crate) fn write_buffer(
    buffer: usize,
    layout: &Layout,
    scene: &Scene,
    needs: &[Option<Needs>],
    copies: &[Vec<u8>],
    textures: &Textures,
    out: &mut dyn Write,
) -> io::Result<()> {
    let mut packer = Packer {
        out,
        written: 0,
        block: vec![0; BLOCK_BYTES],
    };
    // Views that are compressed are in a buffer that nobody writes.
    for accessor in &layout.accessors {
        let view = &layout.views[accessor.view];
        if view.buffer == buffer {
            packer.pad_to(view.offset + accessor.offset)?;
            packer.write_accessor(accessor, scene, needs)?;
        }
    }
    for stored in layout.stored.iter().filter(|s| s.buffer == buffer) {
        packer.pad_to(stored.offset)?;
        packer.write_bytes(&stored.encoded.bytes)?;
    }
    let first_copy_view = layout.first_image_view - copies.len();
    for (view, bytes) in layout.views[first_copy_view..].iter().zip(copies) {
        if view.buffer == buffer {
            packer.pad_to(view.offset)?;
            packer.write_bytes(bytes)?;
        }
    }
    for (i, view) in layout.views[layout.first_image_view..].iter().enumerate() {
        if view.buffer == buffer {
            packer.pad_to(view.offset)?;
            packer.write_bytes(textures.image_bytes(i))?;
        }
    }
    Ok(())
}

/// All bytes of a view of meshes.
pub(crate) fn view_bytes(
    view: usize,
    layout: &Layout,
    scene: &Scene,
    needs: &[Option<Needs>],
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut packer = Packer {
        out: &mut bytes,
        written: 0,
        block: vec![0; BLOCK_BYTES],
    };
    for accessor in layout.accessors.iter().filter(|a| a.view == view) {
        // Writing to memory does not fail.
        let _ = packer.write_accessor(accessor, scene, needs);
    }
    bytes
}

struct Packer<'w> {
    out: &'w mut dyn Write,
    written: u64,
    block: Vec<u8>,
}

impl Packer<'_> {
    /// At most three bytes, by the layout's alignment.
    fn pad_to(&mut self, offset: u64) -> io::Result<()> {
        while self.written < offset {
            self.write_bytes(&[0])?;
        }
        Ok(())
    }

    fn write_bytes(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.written += bytes.len() as u64;
        self.out.write_all(bytes)
    }

    fn write_accessor(
        &mut self,
        accessor: &Accessor,
        scene: &Scene,
        needs: &[Option<Needs>],
    ) -> io::Result<()> {
        let mesh = accessor.mesh.index();
        let needs = needs[mesh].as_ref();
        let positions = needs.map_or(Positions::F32, |needs| needs.formats.positions);
        self.write_array(&scene.meshes[mesh], accessor.data, positions)
    }

    fn write_array(&mut self, mesh: &Mesh, data: Data, positions: Positions) -> io::Result<()> {
        let step = positions.step().unwrap_or(1.0);
        match data {
            Data::Positions => self.copy(&mesh.positions, |&p| bytes_of_vec3(p)),
            Data::Positions16 => self.pack(&mesh.positions, |p| {
                bytes_of_short3(p.map(|v| steps(v, step)))
            }),
            Data::Positions8 => self.pack(&mesh.positions, |p| {
                let [x, y, z] = p.map(|v| steps(v, step) as u8);
                [x, y, z, 0]
            }),
            Data::Normals16 => self.pack(&mesh.normals, |n| {
                bytes_of_short3(n.map(|v| i16_from_signed(v).cast_unsigned()))
            }),
            Data::Normals8 => self.pack(&mesh.normals, |n| {
                let [x, y, z] = n.map(|v| i8_from_signed(v).cast_unsigned());
                [x, y, z, 0]
            }),
            Data::Texcoords16 => self.pack(&mesh.texcoords, |&[s, t]| {
                let [a, b] = u16_from_share(s).to_le_bytes();
                let [c, d] = u16_from_share(1.0 - t).to_le_bytes();
                [a, b, c, d]
            }),
            Data::Colors8 => {
                let mut channels = [Channel::default(); 3];
                self.pack(&mesh.colors_srgb, |color| {
                    bytes_of_color8(color, &mut channels)
                })
            }
            Data::Normals => self.copy(&mesh.normals, |&n| bytes_of_vec3(n)),
            // Inventor's T goes up from the image's lower edge, glTF's down from the upper.
            Data::Texcoords => self.pack(&mesh.texcoords, |&[s, t]| {
                let ([a, b, c, d], [e, f, g, h]) = (s.to_le_bytes(), (1.0 - t).to_le_bytes());
                [a, b, c, d, e, f, g, h]
            }),
            Data::Colors => {
                let mut channels = [Channel::default(); 3];
                self.pack(&mesh.colors_srgb, |color| {
                    bytes_of_color(color, &mut channels)
                })
            }
            // The width was chosen by the number of vertices.
            Data::Indices16 | Data::Sequence16 => {
                self.pack(&mesh.indices, |&i| (i as u16).to_le_bytes())
            }
            Data::Indices32 | Data::Sequence32 => self.copy(&mesh.indices, |&i| i.to_le_bytes()),
        }
    }

    /// Writes items that `bytes_of` only puts into glTF's byte order, which is little-endian.
    fn copy<T: Pod, const N: usize>(
        &mut self,
        items: &[T],
        bytes_of: impl FnMut(&T) -> [u8; N],
    ) -> io::Result<()> {
        if cfg!(target_endian = "little") {
            self.write_bytes(bytemuck::cast_slice(items))
        } else {
            self.pack(items, bytes_of)
        }
    }

    fn pack<T, const N: usize>(
        &mut self,
        items: &[T],
        mut bytes_of: impl FnMut(&T) -> [u8; N],
    ) -> io::Result<()> {
        for items in items.chunks(BLOCK_BYTES / N) {
            for (slot, item) in self.block.chunks_exact_mut(N).zip(items) {
                slot.copy_from_slice(&bytes_of(item));
            }
            let bytes = items.len() * N;
            self.out.write_all(&self.block[..bytes])?;
            self.written += bytes as u64;
        }
        Ok(())
    }
}

fn bytes_of_vec3(v: [f32; 3]) -> [u8; 12] {
    let mut bytes = [0; 12];
    for (slot, x) in bytes.chunks_exact_mut(4).zip(v) {
        slot.copy_from_slice(&x.to_le_bytes());
    }
    bytes
}

/// Three numbers and a gap.
fn bytes_of_short3([x, y, z]: [u16; 3]) -> [u8; 8] {
    let ([a, b], [c, d], [e, f]) = (x.to_le_bytes(), y.to_le_bytes(), z.to_le_bytes());
    [a, b, c, d, e, f, 0, 0]
}

/// The last value of a colour channel: neighbouring vertices mostly share their colour, and the
/// transfer function is slow.
#[derive(Clone, Copy, Default)]
pub(crate) struct Channel {
    srgb: f32,
    linear: f64,
}

impl Channel {
    fn linear(&mut self, srgb: f32) -> f64 {
        if srgb != self.srgb {
            let linear = linear_from_srgb(f64::from(srgb));
            *self = Self { srgb, linear };
        }
        self.linear
    }
}

pub(crate) fn bytes_of_color(&[r, g, b, alpha]: &[f32; 4], channels: &mut [Channel; 3]) -> [u8; 8] {
    let mut bytes = [0; 8];
    for ((slot, srgb), last) in bytes.chunks_exact_mut(2).zip([r, g, b]).zip(channels) {
        slot.copy_from_slice(&u16_from_unit(last.linear(srgb)).to_le_bytes());
    }
    bytes[6..].copy_from_slice(&u16_from_unit(f64::from(alpha)).to_le_bytes());
    bytes
}

pub(crate) fn bytes_of_color8(
    &[r, g, b, alpha]: &[f32; 4],
    channels: &mut [Channel; 3],
) -> [u8; 4] {
    let mut bytes = [0; 4];
    for ((slot, srgb), last) in bytes.iter_mut().zip([r, g, b]).zip(channels) {
        *slot = u8_from_unit(last.linear(srgb));
    }
    bytes[3] = u8_from_unit(f64::from(alpha));
    bytes
}
