//! Shadow volumes on the device: casters uploaded once, sides and caps for each light, kept while
//! neither the light nor a caster moves.

use std::ops::Range;
use std::time::{Duration, Instant};

use glam::{DAffine3, DVec3, DVec4};
use rustc_hash::FxHashMap;
use scenegraph::scene::{MeshId, Scene};
use wgpu::util::DeviceExt;

use super::binding::{self, Layouts};
use super::device::Gpu;
use crate::content::{Content, LightShape, WorldLight};
use crate::frame::{VolumeDraw, VolumeMethod};
use crate::volume::{CastRule, CasterMesh, Method, Volume, extract, facing};

/// Where a caster's arrays begin in the shared buffers.
#[derive(Clone, Copy, Debug)]
struct Base {
    edge: u32,
    triangle: u32,
}

/// All casters.
pub struct Casters {
    meshes: FxHashMap<MeshId, (CasterMesh, Base)>,
    positions: wgpu::Buffer,
    edges: wgpu::Buffer,
    triangles: wgpu::Buffer,
    /// Bytes on the device.
    pub bytes: u64,
}

impl Casters {
    /// Welds and uploads the meshes of all casters.
    pub fn upload(gpu: &Gpu, scene: &Scene, content: &Content) -> Self {
        let mut meshes = FxHashMap::default();
        let mut positions: Vec<[f32; 4]> = Vec::new();
        let mut edges: Vec<[u32; 4]> = Vec::new();
        let mut triangles: Vec<[u32; 4]> = Vec::new();
        for object in content.objects.iter().filter(|object| object.is_caster()) {
            if meshes.contains_key(&object.mesh) {
                continue;
            }
            let mesh = &scene.meshes[object.mesh.index()];
            let caster = CasterMesh::new(&mesh.positions, &mesh.indices);
            let vertex = positions.len() as u32;
            let base = Base {
                edge: edges.len() as u32,
                triangle: triangles.len() as u32,
            };
            positions.extend(&caster.positions);
            edges.extend(
                caster
                    .edges
                    .iter()
                    .map(|&[a, b, first, count]| [a + vertex, b + vertex, first, count]),
            );
            triangles.extend(
                caster
                    .triangles
                    .iter()
                    .map(|&[a, b, c, part]| [a + vertex, b + vertex, c + vertex, part]),
            );
            meshes.insert(object.mesh, (caster, base));
        }
        let upload = |label, contents: &[u8]| storage(gpu, label, contents);
        let bytes = (positions.len() + edges.len() + triangles.len()) as u64 * 16;
        Self {
            meshes,
            positions: upload("caster positions", bytemuck::cast_slice(&positions)),
            edges: upload("caster edges", bytemuck::cast_slice(&edges)),
            triangles: upload("caster triangles", bytemuck::cast_slice(&triangles)),
            bytes,
        }
    }
}

fn storage(gpu: &Gpu, label: &str, contents: &[u8]) -> wgpu::Buffer {
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

/// Entries of one object in the buffer of a light.
#[derive(Clone, Debug, Default, PartialEq)]
struct Parts {
    sides: Range<u32>,
    cap_pos: Range<u32>,
    cap_neg: Range<u32>,
}

/// The volumes of one light.
pub struct LightVolumes {
    shape: LightShape,
    method: VolumeMethod,
    parts: FxHashMap<u32, Parts>,
    /// Group 2.
    pub group: wgpu::BindGroup,
    /// Side quads.
    pub side_count: u32,
    /// Triangles of caps at the light's end.
    pub cap_count: u32,
}

/// The draws of a volume pass: ranges of entries.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VolumeRanges {
    /// Sides counted in front of the scene.
    pub z_pass_sides: Vec<Range<u32>>,
    /// Sides counted behind it.
    pub z_fail_sides: Vec<Range<u32>>,
    /// Caps of triangles that face the light.
    pub cap_pos: Vec<Range<u32>>,
    /// Caps of triangles that face away.
    pub cap_neg: Vec<Range<u32>>,
}

/// The volumes of all lights, with what it took to make them.
#[derive(Default)]
pub struct VolumeCache {
    lights: FxHashMap<u32, LightVolumes>,
    /// Lights whose volumes were made anew.
    pub made: u32,
    /// Lights whose volumes were kept.
    pub kept: u32,
    /// Time taken to make volumes.
    pub time: Duration,
}

impl VolumeCache {
    /// Makes the volumes of a light if they are not those kept.
    pub fn prepare(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        content: &Content,
        casters: &Casters,
        index: u32,
        light: &WorldLight,
        method: VolumeMethod,
    ) {
        let is_kept = self
            .lights
            .get(&index)
            .is_some_and(|kept| kept.shape == light.shape && kept.method == method);
        if is_kept {
            self.kept += 1;
            return;
        }
        let start = Instant::now();
        let made = make(gpu, layouts, content, casters, light, method);
        self.lights.insert(index, made);
        self.made += 1;
        self.time += start.elapsed();
    }

    /// The volumes of a light.
    pub fn of(&self, light: u32) -> Option<&LightVolumes> {
        self.lights.get(&light)
    }
}

impl LightVolumes {
    /// The entries of these volumes, neighbours joined.
    pub fn ranges(&self, draws: &[VolumeDraw]) -> VolumeRanges {
        let mut ranges = VolumeRanges::default();
        for draw in draws {
            let Some(parts) = self.parts.get(&draw.object) else {
                continue;
            };
            if draw.is_z_pass {
                join(&mut ranges.z_pass_sides, &parts.sides);
            } else {
                join(&mut ranges.z_fail_sides, &parts.sides);
                join(&mut ranges.cap_pos, &parts.cap_pos);
                join(&mut ranges.cap_neg, &parts.cap_neg);
            }
        }
        ranges
    }
}

fn join(list: &mut Vec<Range<u32>>, range: &Range<u32>) {
    if range.is_empty() {
        return;
    }
    match list.last_mut() {
        Some(last) if last.end == range.start => last.end = range.end,
        _ => list.push(range.clone()),
    }
}

/// The light in the frame of a mesh, homogeneous.
pub fn light_in_mesh(light: &LightShape, world_from_mesh: &DAffine3) -> DVec4 {
    let mesh_from_world = world_from_mesh.matrix3.inverse();
    match *light {
        LightShape::Directional { towards } => (mesh_from_world * towards).extend(0.0),
        LightShape::Point { p_in_world } | LightShape::Spot { p_in_world, .. } => {
            // Subtracted first: far from the world's origin the inverse would cancel.
            let offset: DVec3 = p_in_world - world_from_mesh.translation;
            (mesh_from_world * offset).extend(1.0)
        }
    }
}

fn make(
    gpu: &Gpu,
    layouts: &Layouts,
    content: &Content,
    casters: &Casters,
    light: &WorldLight,
    method: VolumeMethod,
) -> LightVolumes {
    let method_here = match method {
        VolumeMethod::Silhouette => Method::Silhouette,
        VolumeMethod::ReferenceEdge => Method::ReferenceEdge,
        VolumeMethod::PerTriangle => Method::PerTriangle,
    };
    let mut parts: FxHashMap<u32, Parts> = FxHashMap::default();
    let [mut sides, mut pos, mut neg]: [Vec<[u32; 2]>; 3] = Default::default();
    let mut volume = Volume::default();
    let mut signs = Vec::new();
    for (index, object) in (0..).zip(&content.objects) {
        if !object.is_caster() {
            continue;
        }
        let Some((mesh, base)) = casters.meshes.get(&object.mesh) else {
            continue;
        };
        volume.clear();
        let light = light_in_mesh(&light.shape, &object.world_from_mesh);
        let is_mirrored = object.is_mirrored;
        if method_here != Method::ReferenceEdge {
            facing(mesh, light, is_mirrored, CastRule::default(), &mut signs);
        }
        extract(mesh, method_here, &signs, light, is_mirrored, &mut volume);
        let push = |list: &mut Vec<[u32; 2]>, from: &[u32], base: u32| {
            let start = list.len() as u32;
            list.extend(from.iter().map(|&entry| [entry + base, index]));
            start..list.len() as u32
        };
        let here = Parts {
            sides: push(&mut sides, &volume.sides, base.edge << 1),
            cap_pos: push(&mut pos, &volume.cap_pos, base.triangle),
            cap_neg: push(&mut neg, &volume.cap_neg, base.triangle),
        };
        parts.insert(index, here);
    }
    let (side_count, pos_count) = (sides.len() as u32, pos.len() as u32);
    for part in parts.values_mut() {
        shift(&mut part.cap_pos, side_count);
        shift(&mut part.cap_neg, side_count + pos_count);
    }
    let cap_count = pos_count + neg.len() as u32;
    sides.append(&mut pos);
    sides.append(&mut neg);
    let entries = storage(gpu, "volume entries", bytemuck::cast_slice(&sides));
    let group = binding::group(
        &gpu.device,
        "volumes",
        &layouts.volumes,
        [
            &casters.positions,
            &casters.edges,
            &casters.triangles,
            &entries,
        ]
        .map(wgpu::Buffer::as_entire_binding)
        .into(),
    );
    LightVolumes {
        shape: light.shape,
        method,
        parts,
        group,
        side_count,
        cap_count,
    }
}

fn shift(range: &mut Range<u32>, by: u32) {
    *range = range.start + by..range.end + by;
}
