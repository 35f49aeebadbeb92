//! Where every number goes: buffers, buffer views and accessors, known before a byte is written.
//!
//! All arrays of one kind share a buffer view, so that a model of many small meshes stays small.
//! Images have a view each, as glTF asks. Everything starts at a multiple of four bytes, but for
//! 16-bit indices, which need two; so vectors of three short numbers have a gap behind them.

use scenegraph::scene::{MeshId, Scene, Topology};

use crate::Error;
use crate::compress::{self, Encoded};
use crate::formats::{Colors, Formats, Normals, Positions, Texcoords};
use crate::instancing::Copies;
use crate::json::Json;
use crate::mesh::{Attributes, Facts, IndexWidth};

/// What an accessor holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Data {
    Positions,
    Positions16,
    Positions8,
    Normals,
    Normals16,
    Normals8,
    Texcoords,
    Texcoords16,
    Colors,
    Colors8,
    Indices16,
    Indices32,
    /// Indices of lines and points, where those are kept apart.
    Sequence16,
    Sequence32,
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
    /// Three u16 or i16, and a gap.
    Short3,
    /// Two normalized u16.
    Short2,
    /// Three or four bytes.
    Byte4,
    Indices16,
    Indices32,
    Image,
}

impl Kind {
    /// Those that meshes use, with what each holds; in the order of the output.
    const OF_MESHES: [(Self, &'static [Data]); 8] = [
        (Self::Vec3, &[Data::Positions, Data::Normals]),
        (Self::Short3, &[Data::Positions16, Data::Normals16]),
        (
            Self::Byte4,
            &[Data::Positions8, Data::Normals8, Data::Colors8],
        ),
        (Self::Vec2, &[Data::Texcoords]),
        (Self::Short2, &[Data::Texcoords16]),
        (Self::Color, &[Data::Colors]),
        (Self::Indices16, &[Data::Indices16]),
        (Self::Indices32, &[Data::Indices32]),
    ];

    /// The same, with each kind of numbers by itself.
    const APART: [(Self, &'static [Data]); 14] = [
        (Self::Vec3, &[Data::Positions]),
        (Self::Vec3, &[Data::Normals]),
        (Self::Short3, &[Data::Positions16]),
        (Self::Short3, &[Data::Normals16]),
        (Self::Byte4, &[Data::Positions8]),
        (Self::Byte4, &[Data::Normals8]),
        (Self::Byte4, &[Data::Colors8]),
        (Self::Vec2, &[Data::Texcoords]),
        (Self::Short2, &[Data::Texcoords16]),
        (Self::Color, &[Data::Colors]),
        (Self::Indices16, &[Data::Indices16]),
        (Self::Indices32, &[Data::Indices32]),
        (Self::Indices16, &[Data::Sequence16]),
        (Self::Indices32, &[Data::Sequence32]),
    ];

    fn stride(self) -> Option<u64> {
        match self {
            Self::Vec3 => Some(12),
            Self::Vec2 | Self::Color | Self::Short3 => Some(8),
            Self::Short2 | Self::Byte4 => Some(4),
            Self::Indices16 | Self::Indices32 | Self::Image => None,
        }
    }

    fn element_bytes(self) -> u64 {
        match self {
            Self::Vec3 => 12,
            Self::Vec2 | Self::Color | Self::Short3 => 8,
            Self::Indices16 => 2,
            Self::Indices32 | Self::Short2 | Self::Byte4 => 4,
            Self::Image => 1,
        }
    }

    fn target(self) -> Option<u64> {
        match self {
            Self::Indices16 | Self::Indices32 => Some(34963),
            Self::Image => None,
            _ => Some(34962),
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

impl View {
    pub(crate) fn len(&self) -> u64 {
        self.len
    }

    pub(crate) fn element_bytes(&self) -> u64 {
        self.kind.element_bytes()
    }
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
    pub(crate) formats: Formats,
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
    /// View behind those of meshes: of the copies, if there are some.
    first_copy_view: usize,
    /// View of the first image; the others follow.
    pub(crate) first_image_view: usize,
    /// What stands in a buffer in place of the meshes' views, if they are compressed; by view.
    pub(crate) stored: Vec<Stored>,
    /// Length of the buffer that compressed views are undone into. It has no bytes in any file.
    unpacked: Option<u64>,
}

/// A compressed view and its place.
#[derive(Debug)]
pub(crate) struct Stored {
    pub(crate) encoded: Encoded,
    pub(crate) buffer: usize,
    pub(crate) offset: u64,
}

impl Layout {
    /// `needs` by mesh of the scene, `None` for those that nothing shows.
    pub(crate) fn new(
        scene: &Scene,
        needs: &[Option<Needs>],
        other_lens: impl Iterator<Item = u64>,
        max_buffer_bytes: u64,
    ) -> Result<Self, Error> {
        let mut layout = Self::of_meshes(scene, needs, &Kind::OF_MESHES, max_buffer_bytes)?;
        layout.add_others(other_lens, max_buffer_bytes)?;
        Ok(layout)
    }

    /// As [`Layout::new`], with the meshes' views compressed.
    pub(crate) fn compressed(
        scene: &Scene,
        needs: &[Option<Needs>],
        other_lens: impl Iterator<Item = u64>,
        max_buffer_bytes: u64,
        threads: usize,
    ) -> Result<Self, Error> {
        let mut layout = Self::of_meshes(scene, needs, &Kind::APART, u64::MAX)?;
        let Some(encoded) = compress::encode(&layout, scene, needs, threads) else {
            return Self::new(scene, needs, other_lens, max_buffer_bytes);
        };
        // One buffer, as its length has no limit.
        layout.unpacked = layout.buffers.pop();
        for encoded in encoded {
            let bytes = encoded.bytes.len() as u64;
            let (buffer, offset) = layout.allocate(bytes, max_buffer_bytes)?;
            layout.stored.push(Stored {
                encoded,
                buffer,
                offset,
            });
        }
        layout.add_others(other_lens, max_buffer_bytes)?;
        // The buffer without bytes stands behind all that have some.
        for view in &mut layout.views[..layout.first_copy_view] {
            view.buffer = layout.buffers.len();
        }
        Ok(layout)
    }

    fn add_others(
        &mut self,
        other_lens: impl Iterator<Item = u64>,
        max_buffer_bytes: u64,
    ) -> Result<(), Error> {
        self.first_copy_view = self.views.len();
        self.first_image_view = self.views.len();
        for len in other_lens {
            self.place(Kind::Image, None, len, max_buffer_bytes)?;
        }
        Ok(())
    }

    fn of_meshes(
        scene: &Scene,
        needs: &[Option<Needs>],
        groups: &[(Kind, &[Data])],
        max_buffer_bytes: u64,
    ) -> Result<Self, Error> {
        let mut layout = Self {
            meshes: vec![MeshAccessors::default(); needs.len()],
            ..Self::default()
        };
        let apart = groups.len() == Kind::APART.len();
        for &(kind, holds) in groups {
            let mut view = None;
            for (i, needs) in needs.iter().enumerate() {
                let Some(needs) = needs else { continue };
                let sequence = apart && scene.meshes[i].topology != Topology::Triangles;
                for &data in holds.iter().filter(|&&data| needs.has(data, sequence)) {
                    let bytes = kind.element_bytes() * count(scene, i, data);
                    let (in_view, offset) = layout.place(kind, view, bytes, max_buffer_bytes)?;
                    view = Some(in_view);
                    layout.add_accessor(MeshId(i as u32), data, in_view, offset);
                }
            }
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
        let end = self.buffers.last().copied();
        // A kind's last view is the last of all, so it ends where the buffer ends.
        if let (Some(view), Some(end)) = (view, end)
            && fits(end, bytes, max_buffer_bytes)
        {
            let offset = self.views[view].len;
            self.views[view].len += bytes;
            self.extend_buffer(end + bytes);
            return Ok((view, offset));
        }
        let (buffer, offset) = self.allocate(bytes, max_buffer_bytes)?;
        self.views.push(View {
            buffer,
            offset,
            len: bytes,
            kind,
        });
        Ok((self.views.len() - 1, 0))
    }

    /// Room behind all else, at a multiple of four bytes: in which buffer, and where.
    fn allocate(&mut self, bytes: u64, max_buffer_bytes: u64) -> Result<(usize, u64), Error> {
        if bytes > max_buffer_bytes {
            return Err(Error::BinTooLarge {
                bytes,
                limit: max_buffer_bytes,
            });
        }
        let end = self.buffers.last().copied();
        let offset = match end.and_then(|end| end.checked_next_multiple_of(4)) {
            Some(start) if fits(start, bytes, max_buffer_bytes) => start,
            _ => {
                self.buffers.push(0);
                0
            }
        };
        self.extend_buffer(offset + bytes);
        Ok((self.buffers.len() - 1, offset))
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
            Data::Positions | Data::Positions16 | Data::Positions8 => of_mesh.positions = index,
            Data::Normals | Data::Normals16 | Data::Normals8 => of_mesh.normals = Some(index),
            Data::Texcoords | Data::Texcoords16 => of_mesh.texcoords = Some(index),
            Data::Colors | Data::Colors8 => of_mesh.colors = Some(index),
            Data::Indices16 | Data::Indices32 | Data::Sequence16 | Data::Sequence32 => {
                of_mesh.indices = Some(index);
            }
        }
    }

    /// `accessors`, `bufferViews` and `buffers`; `uri_of` names the files of the buffers.
    pub(crate) fn write(
        &self,
        json: &mut Json,
        scene: &Scene,
        needs: &[Option<Needs>],
        copies: &Copies,
        uri_of: impl Fn(usize) -> Option<String>,
    ) {
        let count = self.accessors.len();
        let all = 0..count + copies.accessor_count();
        json.array_unless_empty("accessors", all, |json, i| match self.accessors.get(i) {
            Some(accessor) => accessor.write(json, scene, needs[accessor.mesh.index()].as_ref()),
            None => copies.write_accessor(json, i - count, self.first_copy_view),
        });
        let views = self.views.iter().enumerate();
        json.array_unless_empty("bufferViews", views, |json, (i, view)| {
            view.write(json, self.stored.get(i));
        });
        let buffers = self.buffers.iter().chain(&self.unpacked).enumerate();
        json.array_unless_empty("buffers", buffers, |json, (i, &len)| {
            json.object(|json| {
                let has_bytes = i < self.buffers.len();
                if let (true, Some(uri)) = (has_bytes, uri_of(i)) {
                    json.key("uri").str(&uri);
                }
                json.key("byteLength").u64(len);
                if !has_bytes {
                    json.key("extensions").object(|json| {
                        json.key(compress::EXTENSION)
                            .object(|json| json.key("fallback").bool(true));
                    });
                }
            });
        });
    }
}

impl Data {
    fn is_positions(self) -> bool {
        matches!(self, Self::Positions | Self::Positions16 | Self::Positions8)
    }

    /// Whether its integers are shares of their range.
    fn is_normalized(self) -> bool {
        matches!(
            self,
            Self::Normals16 | Self::Normals8 | Self::Texcoords16 | Self::Colors | Self::Colors8
        )
    }
}

impl Needs {
    /// `sequence`: the indices are those of lines or points, and kept apart.
    fn has(&self, data: Data, sequence: bool) -> bool {
        let Formats {
            positions,
            normals,
            texcoords,
            colors,
        } = self.formats;
        let read = &self.attributes;
        match data {
            Data::Positions => positions == Positions::F32,
            Data::Positions16 => matches!(positions, Positions::U16 { .. }),
            Data::Positions8 => matches!(positions, Positions::U8 { .. }),
            Data::Normals => read.normals && normals == Normals::F32,
            Data::Normals16 => {
                read.normals && matches!(normals, Normals::I16 | Normals::Oct16 { .. })
            }
            Data::Normals8 => read.normals && matches!(normals, Normals::I8 | Normals::Oct8 { .. }),
            Data::Texcoords => read.texcoords && texcoords == Texcoords::F32,
            Data::Texcoords16 => read.texcoords && texcoords == Texcoords::U16,
            Data::Colors => read.colors && colors == Colors::U16,
            Data::Colors8 => read.colors && colors == Colors::U8,
            Data::Indices16 => !sequence && self.facts.index_width == IndexWidth::U16,
            Data::Indices32 => !sequence && self.facts.index_width == IndexWidth::U32,
            Data::Sequence16 => sequence && self.facts.index_width == IndexWidth::U16,
            Data::Sequence32 => sequence && self.facts.index_width == IndexWidth::U32,
        }
    }
}

fn fits(start: u64, bytes: u64, max_buffer_bytes: u64) -> bool {
    let end = start.checked_add(bytes);
    end.is_some_and(|end| end <= max_buffer_bytes)
}

fn count(scene: &Scene, mesh: usize, data: Data) -> u64 {
    let mesh = &scene.meshes[mesh];
    let count = match data {
        Data::Indices16 | Data::Indices32 | Data::Sequence16 | Data::Sequence32 => {
            mesh.indices.len()
        }
        _ => mesh.positions.len(),
    };
    count as u64
}

impl Accessor {
    fn write(&self, json: &mut Json, scene: &Scene, needs: Option<&Needs>) {
        const BYTE: u64 = 5120;
        const UNSIGNED_BYTE: u64 = 5121;
        const SHORT: u64 = 5122;
        const UNSIGNED_SHORT: u64 = 5123;
        const UNSIGNED_INT: u64 = 5125;
        const FLOAT: u64 = 5126;
        let (component, shape) = match self.data {
            Data::Positions | Data::Normals => (FLOAT, "VEC3"),
            Data::Positions16 => (UNSIGNED_SHORT, "VEC3"),
            Data::Positions8 => (UNSIGNED_BYTE, "VEC3"),
            Data::Normals16 => (SHORT, "VEC3"),
            Data::Normals8 => (BYTE, "VEC3"),
            Data::Texcoords => (FLOAT, "VEC2"),
            Data::Texcoords16 => (UNSIGNED_SHORT, "VEC2"),
            Data::Colors => (UNSIGNED_SHORT, "VEC4"),
            Data::Colors8 => (UNSIGNED_BYTE, "VEC4"),
            Data::Indices16 | Data::Sequence16 => (UNSIGNED_SHORT, "SCALAR"),
            Data::Indices32 | Data::Sequence32 => (UNSIGNED_INT, "SCALAR"),
        };
        json.object(|json| {
            json.key("bufferView").usize(self.view);
            if self.offset > 0 {
                json.key("byteOffset").u64(self.offset);
            }
            json.key("componentType").u64(component);
            if self.data.is_normalized() {
                json.key("normalized").bool(true);
            }
            json.key("count")
                .u64(count(scene, self.mesh.index(), self.data));
            json.key("type").str(shape);
            if let (true, Some(needs)) = (self.data.is_positions(), needs) {
                let Facts { min, max, .. } = needs.facts;
                // As stored: exact quotients.
                let step = needs.formats.positions.step().unwrap_or(1.0);
                json.key("min").f32s(&min.map(|v| v / step));
                json.key("max").f32s(&max.map(|v| v / step));
            }
        });
    }
}

impl View {
    fn write(&self, json: &mut Json, stored: Option<&Stored>) {
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
            if let Some(stored) = stored {
                stored.encoded.write(json, stored.buffer, stored.offset);
            }
        });
    }
}
