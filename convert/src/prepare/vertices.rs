//! Which vertices a mesh has, and in which order: sharing, cutting apart, and the order that suits
//! graphics devices.

use geometry::weld::{Welder, key_bits};
use scenegraph::scene::{Mesh, Topology};

use crate::binary::{Channel, bytes_of_color, bytes_of_color8};
use crate::formats::{
    Colors, Formats, Normals, Positions, Texcoords, i8_from_signed, i16_from_signed, steps,
    u16_from_share,
};

/// A vertex not seen yet.
const UNSEEN: u32 = u32::MAX;

/// Gives each corner a vertex of its own.
pub(crate) fn cut_apart(mesh: &mut Mesh) {
    let corners = std::mem::take(&mut mesh.indices);
    pick(mesh, &corners);
    mesh.indices = (0..corners.len() as u32).collect();
}

/// Makes one of all vertices that are stored as the same numbers.
pub(crate) fn weld(mesh: &mut Mesh, formats: &Formats) {
    let (words, stride) = words(mesh, formats);
    let mut remap = Vec::new();
    let count = Welder::new().weld(&words, stride, &mut remap);
    if count == mesh.positions.len() {
        return;
    }
    let mut firsts = vec![UNSEEN; count];
    for (vertex, &distinct) in remap.iter().enumerate().rev() {
        firsts[distinct as usize] = vertex as u32;
    }
    pick(mesh, &firsts);
    for index in &mut mesh.indices {
        *index = remap[*index as usize];
    }
    drop_collapsed(mesh);
}

/// Triangles that have become lines or points show nothing; one stays, so that a part as small as
/// the tolerance does not lose its place.
fn drop_collapsed(mesh: &mut Mesh) {
    if mesh.topology != Topology::Triangles {
        return;
    }
    let first = mesh.indices.first_chunk::<3>().copied();
    let (triangles, _) = mesh.indices.as_chunks::<3>();
    let sound = |&&[a, b, c]: &&[u32; 3]| a != b && b != c && c != a;
    let kept: Vec<[u32; 3]> = triangles.iter().filter(sound).copied().collect();
    if kept.len() < triangles.len() {
        mesh.indices = kept.into_flattened();
        if let (true, Some(first)) = (mesh.indices.is_empty(), first) {
            mesh.indices.extend(first);
        }
    }
}

/// Triangles in an order that finds vertices in a device's cache, and vertices in that of their
/// first use, which also leaves out those that nothing uses.
///
/// The order of strips takes a little more of the cache, and compresses better.
pub(crate) fn order(mesh: &mut Mesh, for_compression: bool) {
    if mesh.topology == Topology::Triangles {
        let vertices = mesh.positions.len();
        if for_compression {
            meshopt::optimize_vertex_cache_strip_in_place(&mut mesh.indices, vertices);
        } else {
            meshopt::optimize_vertex_cache_in_place(&mut mesh.indices, vertices);
        }
    }
    let mut number = vec![UNSEEN; mesh.positions.len()];
    let mut used = Vec::with_capacity(mesh.positions.len());
    for index in &mut mesh.indices {
        let number = &mut number[*index as usize];
        if *number == UNSEEN {
            *number = used.len() as u32;
            used.push(*index);
        }
        *index = *number;
    }
    pick(mesh, &used);
}

/// Makes the vertices those of `sources`.
fn pick(mesh: &mut Mesh, sources: &[u32]) {
    fn from<T: Copy>(values: &mut Vec<T>, sources: &[u32]) {
        if !values.is_empty() {
            *values = sources.iter().map(|&i| values[i as usize]).collect();
        }
    }
    from(&mut mesh.positions, sources);
    from(&mut mesh.normals, sources);
    from(&mut mesh.texcoords, sources);
    from(&mut mesh.colors_srgb, sources);
}

/// What is stored of each vertex, in words, and how many there are for each.
fn words(mesh: &Mesh, formats: &Formats) -> (Vec<u32>, usize) {
    let pair = |a: u16, b: u16| u32::from(a) << 16 | u32::from(b);
    let mut rows = Rows::new(mesh, formats);
    rows.put(&mesh.positions, |p, out| match formats.positions {
        Positions::F32 => out.copy_from_slice(&p.map(key_bits)),
        Positions::U16 { step } => {
            let [x, y, z] = p.map(|v| steps(v, step));
            out.copy_from_slice(&[pair(x, y), z.into()]);
        }
        Positions::U8 { step } => {
            let [x, y, z] = p.map(|v| u32::from(steps(v, step)));
            out[0] = x << 16 | y << 8 | z;
        }
    });
    rows.put(&mesh.normals, |n, out| match formats.normals {
        Normals::F32 => out.copy_from_slice(&n.map(key_bits)),
        Normals::I16 | Normals::Oct16 { .. } => {
            let [x, y, z] = n.map(|v| i16_from_signed(v).cast_unsigned());
            out.copy_from_slice(&[pair(x, y), z.into()]);
        }
        Normals::I8 | Normals::Oct8 { .. } => {
            let [x, y, z] = n.map(|v| u32::from(i8_from_signed(v).cast_unsigned()));
            out[0] = x << 16 | y << 8 | z;
        }
    });
    rows.put(&mesh.texcoords, |t, out| match formats.texcoords {
        Texcoords::F32 => out.copy_from_slice(&t.map(key_bits)),
        Texcoords::U16 => out[0] = pair(u16_from_share(t[0]), u16_from_share(1.0 - t[1])),
    });
    let mut channels = [Channel::default(); 3];
    rows.put(&mesh.colors_srgb, |color, out| match formats.colors {
        Colors::U16 => {
            let [a, b, c, d, e, f, g, h] = bytes_of_color(&color, &mut channels);
            out[0] = u32::from_le_bytes([a, b, c, d]);
            out[1] = u32::from_le_bytes([e, f, g, h]);
        }
        Colors::U8 => out[0] = u32::from_le_bytes(bytes_of_color8(&color, &mut channels)),
    });
    (rows.words, rows.stride)
}

/// Words being gathered, attribute by attribute.
struct Rows {
    words: Vec<u32>,
    stride: usize,
    /// Words of each attribute still to come, the next one last.
    widths: Vec<usize>,
    at: usize,
}

impl Rows {
    fn new(mesh: &Mesh, formats: &Formats) -> Self {
        let width = |is_there: bool, words: usize| if is_there { words } else { 0 };
        let widths = [
            match formats.positions {
                Positions::F32 => 3,
                Positions::U16 { .. } => 2,
                Positions::U8 { .. } => 1,
            },
            width(
                !mesh.normals.is_empty(),
                match formats.normals {
                    Normals::F32 => 3,
                    Normals::I16 | Normals::Oct16 { .. } => 2,
                    Normals::I8 | Normals::Oct8 { .. } => 1,
                },
            ),
            width(
                !mesh.texcoords.is_empty(),
                match formats.texcoords {
                    Texcoords::F32 => 2,
                    Texcoords::U16 => 1,
                },
            ),
            width(
                !mesh.colors_srgb.is_empty(),
                match formats.colors {
                    Colors::U16 => 2,
                    Colors::U8 => 1,
                },
            ),
        ];
        let stride = widths.iter().sum();
        Self {
            words: vec![0; mesh.positions.len() * stride],
            stride,
            widths: widths.into_iter().rev().collect(),
            at: 0,
        }
    }

    /// The next attribute.
    fn put<T: Copy>(&mut self, values: &[T], mut write: impl FnMut(T, &mut [u32])) {
        let width = self.widths.pop().unwrap_or(0);
        let range = self.at..self.at + width;
        self.at = range.end;
        for (row, &value) in self.words.chunks_exact_mut(self.stride).zip(values) {
            write(value, &mut row[range.clone()]);
        }
    }
}
