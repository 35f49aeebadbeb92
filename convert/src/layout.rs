//! Where every number goes: buffers, buffer views and accessors, known before a byte is written.
//!
//! All arrays of one kind share a buffer view, so that a model of many small meshes stays small.
//! Images have a view each, as glTF asks. Everything starts at a multiple of four bytes, but for
//! 16-bit indices, which need two.

use scenegraph::scene::{MeshId, Scene};

use crate::Error;
use crate::json::Json;
use crate::mesh::{Attributes, Facts, IndexWidth};

/// What an accessor holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Data {
    Positions,
    Normals,
    Texcoords,
    Colors,
    Indices16,
    Indices32,
}

/// What a buffer view holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Three f32: positions and normals.
    Vec3,
    /// Two f32.
    Vec2,
    /// Four normalized u16.
    Color,
    Indices16,
    Indices32,
    Image,
}

impl Kind {
    /// Those that meshes use, with what each holds; in the order of the output.
    const OF_MESHES: [(Self, &'static [Data]); 5] = [
        (Self::Vec3, &[Data::Positions, Data::Normals]),
        (Self::Vec2, &[Data::Texcoords]),
        (Self::Color, &[Data::Colors]),
        (Self::Indices16, &[Data::Indices16]),
        (Self::Indices32, &[Data::Indices32]),
    ];

    fn stride(self) -> Option<u64> {
        match self {
            Self::Vec3 => Some(12),
            Self::Vec2 | Self::Color => Some(8),
            Self::Indices16 | Self::Indices32 | Self::Image => None,
        }
    }

    fn element_bytes(self) -> u64 {
        match self {
            Self::Vec3 => 12,
            Self::Vec2 | Self::Color => 8,
            Self::Indices16 => 2,
            Self::Indices32 => 4,
            Self::Image => 1,
        }
    }

    fn target(self) -> Option<u64> {
        match self {
            Self::Vec3 | Self::Vec2 | Self::Color => Some(34962),
            Self::Indices16 | Self::Indices32 => Some(34963),
            Self::Image => None,
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    pub(crate) buffer: usize,
    pub(crate) offset: u64,
    len: u64,
    kind: Kind,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Accessor {
    pub(crate) mesh: MeshId,
    pub(crate) data: Data,
    pub(crate) view: usize,
    pub(crate) offset: u64,
}

/// Accessors of one mesh.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct MeshAccessors {
    pub(crate) positions: u32,
    pub(crate) normals: Option<u32>,
    pub(crate) texcoords: Option<u32>,
    pub(crate) colors: Option<u32>,
    pub(crate) indices: Option<u32>,
}

/// A mesh of the scene as the output needs it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Needs {
    pub(crate) facts: Facts,
    pub(crate) attributes: Attributes,
}

/// The whole binary part.
#[derive(Debug, Default)]
pub(crate) struct Layout {
    /// Length of each.
    pub(crate) buffers: Vec<u64>,
    pub(crate) views: Vec<View>,
    pub(crate) accessors: Vec<Accessor>,
    /// By mesh of the scene; those that nothing shows have default values.
    pub(crate) meshes: Vec<MeshAccessors>,
    /// View of the first image; the others follow.
    pub(crate) first_image_view: usize,
}

impl Layout {
    /// `needs` by mesh of the scene, `None` for those that nothing shows.
    pub(crate) fn new(
        scene: &Scene,
        needs: &[Option<Needs>],
        image_lens: impl Iterator<Item = u64>,
        max_buffer_bytes: u64,
    ) -> Result<Self, Error> {
        let mut layout = Self {
            meshes: vec![MeshAccessors::default(); needs.len()],
            ..Self::default()
        };
        for (kind, holds) in Kind::OF_MESHES {
            let mut view = None;
            for (i, needs) in needs.iter().enumerate() {
                let Some(needs) = needs else { continue };
                for &data in holds.iter().filter(|&&data| needs.has(data)) {
                    let bytes = kind.element_bytes() * count(scene, i, data);
                    let (in_view, offset) = layout.place(kind, view, bytes, max_buffer_bytes)?;
                    view = Some(in_view);
                    layout.add_accessor(MeshId(i as u32), data, in_view, offset);
                }
            }
        }
        layout.first_image_view = layout.views.len();
        for len in image_lens {
            layout.place(Kind::Image, None, len, max_buffer_bytes)?;
        }
        Ok(layout)
    }

    /// Appends to `view` if there is one and its buffer has room, else to a new view.
    fn place(
        &mut self,
        kind: Kind,
        view: Option<usize>,
        bytes: u64,
        max_buffer_bytes: u64,
    ) -> Result<(usize, u64), Error> {
        if bytes > max_buffer_bytes {
            return Err(Error::BinTooLarge {
                bytes,
                limit: max_buffer_bytes,
            });
        }
        let fits = |start: u64| {
            start
                .checked_add(bytes)
                .is_some_and(|e| e <= max_buffer_bytes)
        };
        let end = self.buffers.last().copied();
        // A kind's last view is the last of all, so it ends where the buffer ends.
        if let (Some(view), Some(end)) = (view, end)
            && fits(end)
        {
            let offset = self.views[view].len;
            self.views[view].len += bytes;
            self.extend_buffer(end + bytes);
            return Ok((view, offset));
        }
        let offset = match end.and_then(|end| end.checked_next_multiple_of(4)) {
            Some(start) if fits(start) => start,
            _ => {
                self.buffers.push(0);
                0
            }
        };
        let buffer = self.buffers.len() - 1;
        self.views.push(View {
            buffer,
            offset,
            len: bytes,
            kind,
        });
        self.extend_buffer(offset + bytes);
        Ok((self.views.len() - 1, 0))
    }

    fn extend_buffer(&mut self, end: u64) {
        if let Some(len) = self.buffers.last_mut() {
            *len = end;
        }
    }

    fn add_accessor(&mut self, mesh: MeshId, data: Data, view: usize, offset: u64) {
        let index = self.accessors.len() as u32;
        self.accessors.push(Accessor {
            mesh,
            data,
            view,
            offset,
        });
        let of_mesh = &mut self.meshes[mesh.index()];
        match data {
            Data::Positions => of_mesh.positions = index,
            Data::Normals => of_mesh.normals = Some(index),
            Data::Texcoords => of_mesh.texcoords = Some(index),
            Data::Colors => of_mesh.colors = Some(index),
            Data::Indices16 | Data::Indices32 => of_mesh.indices = Some(index),
        }
    }

    /// `accessors`, `bufferViews` and `buffers`; `uri_of` names the files of the buffers.
    pub(crate) fn write(
        &self,
        json: &mut Json,
        scene: &Scene,
        needs: &[Option<Needs>],
        uri_of: impl Fn(usize) -> Option<String>,
    ) {
        json.array_unless_empty("accessors", &self.accessors, |json, accessor| {
            let facts = needs[accessor.mesh.index()]
                .as_ref()
                .map(|needs| &needs.facts);
            accessor.write(json, scene, facts);
        });
        json.array_unless_empty("bufferViews", &self.views, |json, view| view.write(json));
        json.array_unless_empty(
            "buffers",
            self.buffers.iter().enumerate(),
            |json, (i, &len)| {
                json.object(|json| {
                    if let Some(uri) = uri_of(i) {
                        json.key("uri").str(&uri);
                    }
                    json.key("byteLength").u64(len);
                });
            },
        );
    }
}

impl Needs {
    fn has(&self, data: Data) -> bool {
        match data {
            Data::Positions => true,
            Data::Normals => self.attributes.normals,
            Data::Texcoords => self.attributes.texcoords,
            Data::Colors => self.attributes.colors,
            Data::Indices16 => self.facts.index_width == IndexWidth::U16,
            Data::Indices32 => self.facts.index_width == IndexWidth::U32,
        }
    }
}

fn count(scene: &Scene, mesh: usize, data: Data) -> u64 {
    let mesh = &scene.meshes[mesh];
    let count = match data {
        Data::Indices16 | Data::Indices32 => mesh.indices.len(),
        _ => mesh.positions.len(),
    };
    count as u64
}

impl Accessor {
    fn write(&self, json: &mut Json, scene: &Scene, facts: Option<&Facts>) {
        const UNSIGNED_SHORT: u64 = 5123;
        const UNSIGNED_INT: u64 = 5125;
        const FLOAT: u64 = 5126;
        let (component, shape) = match self.data {
            Data::Positions | Data::Normals => (FLOAT, "VEC3"),
            Data::Texcoords => (FLOAT, "VEC2"),
            Data::Colors => (UNSIGNED_SHORT, "VEC4"),
            Data::Indices16 => (UNSIGNED_SHORT, "SCALAR"),
            Data::Indices32 => (UNSIGNED_INT, "SCALAR"),
        };
        json.object(|json| {
            json.key("bufferView").usize(self.view);
            if self.offset > 0 {
                json.key("byteOffset").u64(self.offset);
            }
            json.key("componentType").u64(component);
            if self.data == Data::Colors {
                json.key("normalized").bool(true);
            }
            json.key("count")
                .u64(count(scene, self.mesh.index(), self.data));
            json.key("type").str(shape);
            if let (Data::Positions, Some(facts)) = (self.data, facts) {
                json.key("min").f32s(&facts.min);
                json.key("max").f32s(&facts.max);
            }
        });
    }
}

impl View {
    fn write(&self, json: &mut Json) {
        json.object(|json| {
            json.key("buffer").usize(self.buffer);
            if self.offset > 0 {
                json.key("byteOffset").u64(self.offset);
            }
            json.key("byteLength").u64(self.len);
            if let Some(stride) = self.kind.stride() {
                json.key("byteStride").u64(stride);
            }
            if let Some(target) = self.kind.target() {
                json.key("target").u64(target);
            }
        });
    }
}
