//! The numbers of meshes in the compression of meshoptimizer (`EXT_meshopt_compression`).
//!
//! Each buffer view is compressed as a whole, so a model of many small meshes has few streams. All
//! of it is lossless but normals that are stored short anyway: those become points on an
//! octahedron, of as many bits as their tolerance asks for.

use scenegraph::scene::Scene;

use crate::formats::Normals;
use crate::json::Json;
use crate::layout::{Data, Layout, Needs};
use crate::{binary, parallel};

/// The name that both writer and file use.
pub(crate) const EXTENSION: &str = "EXT_meshopt_compression";

/// The version of the codec of vertices that the extension names.
const VERTEX_CODEC: Option<i32> = Some(0);

/// A view's bytes, and what a reader must know to undo them.
#[derive(Debug)]
pub(crate) struct Encoded {
    pub(crate) bytes: Vec<u8>,
    stride: u64,
    count: u64,
    mode: &'static str,
    filter: Option<&'static str>,
}

impl Encoded {
    /// The extension of a buffer view whose bytes lie in `buffer` from `offset` on.
    pub(crate) fn write(&self, json: &mut Json, buffer: usize, offset: u64) {
        json.key("extensions").object(|json| {
            json.key(EXTENSION).object(|json| {
                json.key("buffer").usize(buffer);
                if offset > 0 {
                    json.key("byteOffset").u64(offset);
                }
                json.key("byteLength").usize(self.bytes.len());
                json.key("byteStride").u64(self.stride);
                json.key("count").u64(self.count);
                json.key("mode").str(self.mode);
                if let Some(filter) = self.filter {
                    json.key("filter").str(filter);
                }
            });
        });
    }
}

/// All views of a layout that holds each kind of numbers in a view of its own.
pub(crate) fn encode(
    layout: &Layout,
    scene: &Scene,
    needs: &[Option<Needs>],
    threads: usize,
) -> Option<Vec<Encoded>> {
    let encoded = parallel::map(layout.views.len(), threads, |view| {
        encode_view(view, layout, scene, needs)
    });
    encoded.into_iter().collect()
}

/// `None` only if the encoder fails, which it does for no input that reaches it.
fn encode_view(
    view: usize,
    layout: &Layout,
    scene: &Scene,
    needs: &[Option<Needs>],
) -> Option<Encoded> {
    let accessors = || layout.accessors.iter().filter(|a| a.view == view);
    let first = accessors().next()?;
    let (stride, len) = (layout.views[view].element_bytes(), layout.views[view].len());
    let count = len / stride;
    let indices = || -> Vec<u32> {
        let meshes = accessors().map(|a| &scene.meshes[a.mesh.index()]);
        meshes
            .flat_map(|mesh| mesh.indices.iter().copied())
            .collect()
    };
    let raw = || binary::view_bytes(view, layout, scene, needs);
    let normals = || -> Vec<[f32; 4]> {
        let meshes = accessors().map(|a| &scene.meshes[a.mesh.index()]);
        let normals = meshes.flat_map(|mesh| &mesh.normals);
        normals.map(|&[x, y, z]| [x, y, z, 0.0]).collect()
    };
    let form = needs[first.mesh.index()]
        .as_ref()
        .map(|needs| needs.formats.normals);
    let (mode, filter, bytes) = match (first.data, form) {
        (Data::Indices16 | Data::Indices32, _) => {
            let indices = indices();
            let vertices = indices.iter().max().map_or(0, |&i| i as usize + 1);
            let bytes = meshopt::encode_index_buffer(&indices, vertices).ok()?;
            ("TRIANGLES", None, bytes)
        }
        (Data::Sequence16 | Data::Sequence32, _) => {
            let indices = indices();
            let vertices = indices.iter().max().map_or(0, |&i| i as usize + 1);
            let bytes = meshopt::encode_index_sequence(&indices, vertices).ok()?;
            ("INDICES", None, bytes)
        }
        (Data::Normals8, Some(Normals::Oct8 { bits })) => {
            let points = meshopt::encode_filter_oct::<i8>(&normals(), bits.into());
            ("ATTRIBUTES", Some("OCTAHEDRAL"), vertices(&points)?)
        }
        (Data::Normals16, Some(Normals::Oct16 { bits })) => {
            let points = meshopt::encode_filter_oct::<i16>(&normals(), bits.into());
            ("ATTRIBUTES", Some("OCTAHEDRAL"), vertices(&points)?)
        }
        _ => {
            let raw = raw();
            let bytes = match stride {
                4 => vertices(raw.as_chunks::<4>().0)?,
                8 => vertices(raw.as_chunks::<8>().0)?,
                12 => vertices(raw.as_chunks::<12>().0)?,
                _ => vertices(raw.as_chunks::<16>().0)?,
            };
            ("ATTRIBUTES", None, bytes)
        }
    };
    Some(Encoded {
        bytes,
        stride,
        count,
        mode,
        filter,
    })
}

fn vertices<T>(elements: &[T]) -> Option<Vec<u8>> {
    meshopt::encode_vertex_buffer_level(elements, 2, VERTEX_CODEC).ok()
}
