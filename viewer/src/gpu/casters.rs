//! Casters on the device: welded meshes, one behind the other, uploaded once.

use rustc_hash::FxHashMap;
use scenegraph::scene::{MeshId, Scene};
use wgpu::util::DeviceExt;

use super::device::Gpu;
use crate::content::Content;
use crate::content::positions::positions;
use crate::volume::CasterMesh;

/// Where a caster's arrays begin in the shared buffers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Base {
    /// First edge.
    pub edge: u32,
    /// First triangle.
    pub triangle: u32,
}

/// Arrays of casters, one behind the other.
#[derive(Default)]
pub struct Arrays {
    positions: Vec<[f32; 4]>,
    edges: Vec<[u32; 4]>,
    triangles: Vec<[u32; 4]>,
    refs: Vec<u32>,
}

impl Arrays {
    /// Appends a mesh.
    pub fn add(&mut self, mesh: &CasterMesh) -> Base {
        let vertex = self.positions.len() as u32;
        let base = Base {
            edge: self.edges.len() as u32,
            triangle: self.triangles.len() as u32,
        };
        self.positions.extend(&mesh.positions);
        let edges = mesh.edges.iter();
        let first_ref = self.refs.len() as u32;
        self.edges.extend(
            edges.map(|&[a, b, first, count]| [a + vertex, b + vertex, first + first_ref, count]),
        );
        self.refs.extend(&mesh.refs);
        let triangles = mesh.triangles.iter();
        self.triangles
            .extend(triangles.map(|&[a, b, c, part]| [a + vertex, b + vertex, c + vertex, part]));
        base
    }

    /// Positions, edges, triangles, references.
    pub fn upload(&self, gpu: &Gpu) -> [wgpu::Buffer; 4] {
        [
            storage(
                gpu,
                "caster positions",
                bytemuck::cast_slice(&self.positions),
            ),
            storage(gpu, "caster edges", bytemuck::cast_slice(&self.edges)),
            storage(
                gpu,
                "caster triangles",
                bytemuck::cast_slice(&self.triangles),
            ),
            storage(gpu, "caster references", bytemuck::cast_slice(&self.refs)),
        ]
    }
}

/// All casters.
pub struct Casters {
    meshes: FxHashMap<MeshId, (CasterMesh, Base)>,
    buffers: [wgpu::Buffer; 4],
    /// Bytes on the device.
    pub bytes: u64,
}

impl Casters {
    /// Welds and uploads the meshes of all casters.
    pub fn upload(gpu: &Gpu, scene: &Scene, content: &Content) -> Self {
        let mut meshes = FxHashMap::default();
        let mut arrays = Arrays::default();
        for object in content.objects.iter().filter(|object| object.is_caster()) {
            if meshes.contains_key(&object.mesh) {
                continue;
            }
            let mesh = &scene.meshes[object.mesh.index()];
            let caster = CasterMesh::new(&positions(mesh), &mesh.indices);
            let base = arrays.add(&caster);
            meshes.insert(object.mesh, (caster, base));
        }
        let buffers = arrays.upload(gpu);
        Self {
            meshes,
            bytes: buffers.iter().map(wgpu::Buffer::size).sum(),
            buffers,
        }
    }

    /// The welded mesh of a caster, and where it begins in the shared buffers.
    pub fn mesh(&self, id: MeshId) -> Option<&(CasterMesh, Base)> {
        self.meshes.get(&id)
    }

    /// Positions, edges, triangles, references.
    pub fn buffers(&self) -> &[wgpu::Buffer; 4] {
        &self.buffers
    }
}

/// A buffer that shaders read.
pub fn storage(gpu: &Gpu, label: &str, contents: &[u8]) -> wgpu::Buffer {
    // A buffer of no bytes cannot be bound.
    let contents = if contents.is_empty() {
        &[0; 16]
    } else {
        contents
    };
    gpu.device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(label),
            contents,
            usage: wgpu::BufferUsages::STORAGE,
        })
}
