//! Vertices and indices on the device, uploaded once.
//!
//! Meshes with the same attributes share buffers, so that most draws differ by offsets only.

use bytemuck::{Pod, Zeroable};
use rustc_hash::FxHashMap;
use scenegraph::scene::{Mesh, MeshId, Scene, Topology};
use wgpu::util::DeviceExt;

use crate::content::Content;
use crate::content::positions::positions;

/// Which attributes the meshes of a group have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Attributes {
    /// Normals.
    pub normals: bool,
    /// Texture coordinates.
    pub texcoords: bool,
    /// Colours.
    pub colors: bool,
}

impl Attributes {
    fn of(mesh: &Mesh) -> Self {
        Self {
            normals: !mesh.normals.is_empty(),
            texcoords: !mesh.texcoords.is_empty(),
            colors: !mesh.colors_srgb.is_empty(),
        }
    }
}

/// Where the triangles of a mesh are.
#[derive(Clone, Copy, Debug)]
pub struct TriangleRange {
    /// Index into [`Geometry::groups`].
    pub group: usize,
    /// First index.
    pub first_index: u32,
    /// Number of indices.
    pub index_count: u32,
    /// Added to every index.
    pub base_vertex: i32,
}

/// Where a mesh is.
#[derive(Clone, Copy, Debug)]
pub enum MeshRange {
    /// Triangles.
    Triangles(TriangleRange),
    /// Lines or points.
    Strokes {
        /// First segment or point.
        first: u32,
        /// Number of segments or points.
        count: u32,
    },
}

/// Buffers of meshes with the same attributes.
pub struct Group {
    /// Three floats a vertex.
    pub positions: wgpu::Buffer,
    /// Three floats a vertex.
    pub normals: Option<wgpu::Buffer>,
    /// Two floats a vertex.
    pub texcoords: Option<wgpu::Buffer>,
    /// Four floats a vertex.
    pub colors: Option<wgpu::Buffer>,
    /// Of all its meshes.
    pub indices: wgpu::Buffer,
}

/// An end of a segment, or a point.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct StrokeEnd {
    position: [f32; 3],
    color_rgba8: u32,
    normal: [f32; 3],
    unused: f32,
}

/// All meshes that are drawn.
pub struct Geometry {
    /// Buffers for triangles.
    pub groups: Vec<Group>,
    /// Lines and points, two ends for each line.
    pub line_ends: wgpu::Buffer,
    /// Points.
    pub points: wgpu::Buffer,
    ranges: FxHashMap<MeshId, MeshRange>,
    /// Bytes uploaded.
    pub bytes: u64,
}

#[derive(Default)]
struct GroupData {
    attributes: Attributes,
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    texcoords: Vec<[f32; 2]>,
    colors: Vec<[f32; 4]>,
    indices: Vec<u32>,
}

#[derive(Default)]
struct Collected {
    groups: Vec<GroupData>,
    by_attributes: FxHashMap<Attributes, usize>,
    line_ends: Vec<StrokeEnd>,
    points: Vec<StrokeEnd>,
    ranges: FxHashMap<MeshId, MeshRange>,
}

/// Vertices in one group at most: `base_vertex` is an i32.
const MAX_GROUP_VERTICES: usize = i32::MAX as usize;

impl Geometry {
    /// Uploads the meshes that `content` draws.
    pub fn upload(device: &wgpu::Device, scene: &Scene, content: &Content) -> Self {
        let mut collected = Collected::default();
        for object in &content.objects {
            if !collected.ranges.contains_key(&object.mesh) {
                collected.add(object.mesh, &scene.meshes[object.mesh.index()]);
            }
        }
        let mut bytes = 0;
        let mut buffer = |label: &str, contents: &[u8], usage| {
            bytes += contents.len() as u64;
            // A buffer of no bytes cannot be bound.
            let contents = if contents.is_empty() {
                &[0; 32]
            } else {
                contents
            };
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some(label),
                contents,
                usage,
            })
        };
        let vertex = wgpu::BufferUsages::VERTEX;
        let groups = collected
            .groups
            .iter()
            .map(|data| Group {
                positions: buffer("positions", bytemuck::cast_slice(&data.positions), vertex),
                normals: data
                    .attributes
                    .normals
                    .then(|| buffer("normals", bytemuck::cast_slice(&data.normals), vertex)),
                texcoords: data
                    .attributes
                    .texcoords
                    .then(|| buffer("texcoords", bytemuck::cast_slice(&data.texcoords), vertex)),
                colors: data
                    .attributes
                    .colors
                    .then(|| buffer("colors", bytemuck::cast_slice(&data.colors), vertex)),
                indices: buffer(
                    "indices",
                    bytemuck::cast_slice(&data.indices),
                    wgpu::BufferUsages::INDEX,
                ),
            })
            .collect();
        let storage = wgpu::BufferUsages::STORAGE;
        let line_ends = buffer("lines", bytemuck::cast_slice(&collected.line_ends), storage);
        let points = buffer("points", bytemuck::cast_slice(&collected.points), storage);
        Self {
            groups,
            line_ends,
            points,
            ranges: collected.ranges,
            bytes,
        }
    }

    /// Where a mesh is; `None` for one that no object draws.
    pub fn range(&self, mesh: MeshId) -> Option<MeshRange> {
        self.ranges.get(&mesh).copied()
    }
}

impl Collected {
    fn add(&mut self, id: MeshId, mesh: &Mesh) {
        let range = match mesh.topology {
            Topology::Triangles => MeshRange::Triangles(self.add_triangles(mesh)),
            Topology::Lines => {
                let first = self.line_ends.len() / 2;
                let ends = &mesh.indices[..mesh.indices.len() / 2 * 2];
                let places = positions(mesh);
                self.line_ends
                    .extend(ends.iter().map(|&i| end(mesh, &places, i)));
                strokes(first, ends.len() / 2)
            }
            Topology::Points => {
                let first = self.points.len();
                let places = positions(mesh);
                self.points
                    .extend(mesh.indices.iter().map(|&i| end(mesh, &places, i)));
                strokes(first, mesh.indices.len())
            }
        };
        self.ranges.insert(id, range);
    }

    fn add_triangles(&mut self, mesh: &Mesh) -> TriangleRange {
        let attributes = Attributes::of(mesh);
        let full = self.by_attributes.get(&attributes).copied().filter(|&at| {
            self.groups[at].positions.len() + mesh.positions.len() <= MAX_GROUP_VERTICES
        });
        let group = full.unwrap_or_else(|| {
            self.groups.push(GroupData {
                attributes,
                ..GroupData::default()
            });
            self.by_attributes.insert(attributes, self.groups.len() - 1);
            self.groups.len() - 1
        });
        let data = &mut self.groups[group];
        let range = TriangleRange {
            group,
            first_index: u32::try_from(data.indices.len()).unwrap_or(u32::MAX),
            index_count: u32::try_from(mesh.indices.len()).unwrap_or(0),
            base_vertex: i32::try_from(data.positions.len()).unwrap_or(i32::MAX),
        };
        data.positions.extend(positions(mesh).iter());
        data.normals.extend(&mesh.normals);
        data.texcoords.extend(&mesh.texcoords);
        data.colors.extend(&mesh.colors_srgb);
        data.indices.extend(&mesh.indices);
        range
    }
}

fn strokes(first: usize, count: usize) -> MeshRange {
    MeshRange::Strokes {
        first: u32::try_from(first).unwrap_or(u32::MAX),
        count: u32::try_from(count).unwrap_or(0),
    }
}

fn end(mesh: &Mesh, places: &[[f32; 3]], index: u32) -> StrokeEnd {
    let i = index as usize;
    let color = mesh.colors_srgb.get(i).copied().unwrap_or([1.0; 4]);
    // Saturating: `as` clamps what is out of range, and the clamp makes NaN 0.
    let bytes = color.map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8);
    StrokeEnd {
        position: places[i],
        color_rgba8: u32::from_le_bytes(bytes),
        normal: mesh.normals.get(i).copied().unwrap_or_default(),
        unused: 0.0,
    }
}
