//! Buffer views in the compression of meshoptimizer (`EXT_meshopt_compression`, and
//! `KHR_meshopt_compression`, which is the same but for newer codecs).
//!
//! The decoders are made for bytes that nobody vouches for: they give an error or numbers, whatever
//! they are; indices are checked where they are used.

use meshopt::{
    decode_filter_color, decode_filter_exp, decode_filter_oct, decode_filter_quat,
    decode_index_buffer, decode_index_sequence, decode_vertex_buffer,
};
use serde::Deserialize;
use serde_json::Value;

/// Under either name, what stands in its place.
pub(crate) const NAMES: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// What a buffer view says of its compressed bytes.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Compressed {
    pub(crate) buffer: usize,
    #[serde(default)]
    pub(crate) byte_offset: u64,
    pub(crate) byte_length: u64,
    byte_stride: usize,
    count: u32,
    mode: Mode,
    #[serde(default)]
    filter: Filter,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
enum Mode {
    Attributes,
    Triangles,
    Indices,
}

#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
enum Filter {
    #[default]
    None,
    Octahedral,
    Quaternion,
    Exponential,
    Color,
}

impl Compressed {
    /// What the extension says; `None` if it says nothing that makes sense.
    pub(crate) fn of(extension: &Value) -> Option<Self> {
        Self::deserialize(extension).ok()
    }

    /// Length of the numbers.
    pub(crate) fn decoded_len(&self) -> u64 {
        // Saturating: 32 bits each, and a stride beyond any that is decoded.
        u64::from(self.count).saturating_mul(self.byte_stride as u64)
    }

    /// The numbers of these bytes; `None` if they are not what the view says.
    pub(crate) fn decode(&self, bytes: &[u8]) -> Option<Vec<u8>> {
        let count = self.count as usize;
        let stride = self.byte_stride;
        match (self.mode, stride) {
            (Mode::Attributes, _) => attributes(bytes, count, stride, self.filter),
            (Mode::Triangles, _) if !count.is_multiple_of(3) => None,
            (Mode::Triangles, 2) => flat(decode_index_buffer::<u16>(bytes, count).ok()?),
            (Mode::Triangles, 4) => flat(decode_index_buffer::<u32>(bytes, count).ok()?),
            (Mode::Indices, 2) => flat(decode_index_sequence::<u16>(bytes, count).ok()?),
            (Mode::Indices, 4) => flat(decode_index_sequence::<u32>(bytes, count).ok()?),
            _ => None,
        }
    }
}

/// As the file has them on a machine of its byte order, which is little-endian.
fn flat<T: bytemuck::Pod>(values: Vec<T>) -> Option<Vec<u8>> {
    cfg!(target_endian = "little").then(|| bytemuck::cast_slice(&values).to_vec())
}

/// One vertex of `N` words.
#[derive(Clone, Copy)]
#[repr(transparent)]
struct Row<const N: usize>([[u8; 4]; N]);

impl<const N: usize> Default for Row<N> {
    fn default() -> Self {
        Self([[0; 4]; N])
    }
}

fn rows<const N: usize>(bytes: &[u8], count: usize) -> Option<Vec<[[u8; 4]; N]>> {
    let rows = decode_vertex_buffer::<Row<N>>(bytes, count).ok()?;
    Some(rows.into_iter().map(|row| row.0).collect())
}

fn attributes(bytes: &[u8], count: usize, stride: usize, filter: Filter) -> Option<Vec<u8>> {
    macro_rules! of_words {
        ($($words:literal)*) => {
            match stride {
                $(stride if stride == 4 * $words => {
                    let rows = rows::<$words>(bytes, count)?;
                    Some(rows.into_flattened().into_flattened())
                })*
                _ => None,
            }
        };
    }
    let mut bytes = of_words!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26
        27 28 29 30 31 32 33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57
        58 59 60 61 62 63 64)?;
    if cfg!(target_endian = "big") && !matches!(filter, Filter::None) {
        return None;
    }
    match (filter, stride) {
        (Filter::None, _) => {}
        (Filter::Octahedral, 4) => filtered(&mut bytes, decode_filter_oct::<i8>)?,
        (Filter::Octahedral, 8) => filtered(&mut bytes, decode_filter_oct::<i16>)?,
        (Filter::Quaternion, 8) => filtered(&mut bytes, decode_filter_quat)?,
        (Filter::Exponential, _) => filtered(&mut bytes, decode_filter_exp::<1>)?,
        (Filter::Color, 4) => filtered(&mut bytes, decode_filter_color::<u8>)?,
        (Filter::Color, 8) => filtered(&mut bytes, decode_filter_color::<u16>)?,
        _ => return None,
    }
    Some(bytes)
}

/// Undoes a filter on whole elements.
fn filtered<T: bytemuck::Pod>(bytes: &mut [u8], undo: fn(&mut [T])) -> Option<()> {
    // The stride is a multiple of the element's size.
    let mut elements = vec![T::zeroed(); bytes.len() / size_of::<T>()];
    bytemuck::cast_slice_mut(&mut elements).copy_from_slice(bytes);
    undo(&mut elements);
    bytes.copy_from_slice(bytemuck::cast_slice(&elements));
    Some(())
}
