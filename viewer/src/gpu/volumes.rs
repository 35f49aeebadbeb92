//! Shadow volumes on the device: casters uploaded once, sides and caps for each light, kept while
//! neither the light nor a caster moves.

use std::borrow::Cow;
use std::ops::Range;

use glam::{DAffine3, DVec3, DVec4};
use rustc_hash::FxHashMap;
use scenegraph::scene::{MeshId, Scene};
use wgpu::util::DeviceExt;

use super::binding::{self, Layouts};
use super::device::Gpu;
use crate::content::{Content, LightShape, WorldLight};
use crate::frame::{VolumeDraw, VolumeMethod};
use crate::volume::{
    CastRule, CasterMesh, LayerCaster, Method, Volume, bisect, count_at_infinity, extract, facing,
    layer_bound, split,
};

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
struct Arrays {
    positions: Vec<[f32; 4]>,
    edges: Vec<[u32; 4]>,
    triangles: Vec<[u32; 4]>,
    refs: Vec<u32>,
}

impl Arrays {
    fn add(&mut self, mesh: &CasterMesh) -> Base {
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
    fn upload(&self, gpu: &Gpu) -> [wgpu::Buffer; 4] {
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
            let caster = CasterMesh::new(&mesh.positions, &mesh.indices);
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

/// Entries of one object, or of a part of it, in the buffer of a light.
#[derive(Clone, Debug, Default, PartialEq)]
struct Parts {
    object: u32,
    sides: Range<u32>,
    cap_pos: Range<u32>,
    cap_neg: Range<u32>,
}

/// What the start value of z-pass is counted from, for a parallel projection.
struct Signs {
    object: u32,
    /// Of a part of a caster.
    part: Option<CasterMesh>,
    signs: Vec<i8>,
}

/// The volumes of one light.
pub struct LightVolumes {
    shape: LightShape,
    method: VolumeMethod,
    /// Sets of volumes that may share eight bits of stencil, each ascending by object.
    layers: Vec<Vec<Parts>>,
    /// For each of them.
    signs: Vec<Vec<Signs>>,
    /// Group 2.
    pub group: wgpu::BindGroup,
    /// On the device.
    bytes: u64,
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
}

impl VolumeCache {
    /// Makes the volumes of a light if they are not those kept.
    pub fn prepare(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        content: &Content,
        casters: &Casters,
        (index, light): (u32, &WorldLight),
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
        let made = make(gpu, layouts, content, casters, light, method);
        self.lights.insert(index, made);
        self.made += 1;
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        self.lights.values().map(|volumes| volumes.bytes).sum()
    }

    /// The volumes of a light.
    pub fn of(&self, light: u32) -> Option<&LightVolumes> {
        self.lights.get(&light)
    }
}

impl LightVolumes {
    /// In how many goes the volumes are counted: more than one if more could lie on top of each
    /// other than eight bits count.
    pub fn layer_count(&self) -> usize {
        self.layers.len()
    }

    /// The entries of these volumes in a layer, neighbours joined. `draws` ascend by object.
    pub fn ranges(&self, layer: usize, draws: &[VolumeDraw]) -> VolumeRanges {
        let mut ranges = VolumeRanges::default();
        let mut draws = draws.iter().peekable();
        for parts in &self.layers[layer] {
            while draws.next_if(|draw| draw.object < parts.object).is_some() {}
            match draws.peek() {
                Some(draw) if draw.object == parts.object => ranges.add(parts, draw.is_z_pass),
                _ => {}
            }
        }
        ranges
    }

    /// How many of these volumes, of a layer, hold the point at infinity from where a parallel
    /// projection looks.
    pub fn count_at_infinity(
        &self,
        layer: usize,
        content: &Content,
        casters: &Casters,
        draws: &[VolumeDraw],
        towards_viewer: DVec3,
    ) -> u32 {
        let mut count = 0;
        let mut draws = draws.iter().peekable();
        for Signs {
            object,
            part,
            signs,
        } in &self.signs[layer]
        {
            while draws.next_if(|draw| draw.object < *object).is_some() {}
            if draws.peek().is_none_or(|draw| draw.object != *object) {
                continue;
            }
            let object = &content.objects[*object as usize];
            let whole = casters.meshes.get(&object.mesh).map(|(mesh, _)| mesh);
            let Some(mesh) = part.as_ref().or(whole) else {
                continue;
            };
            let viewer_in_mesh = object.world_from_mesh.matrix3.inverse() * towards_viewer;
            let light = light_in_mesh(&self.shape, &object.world_from_mesh);
            count += count_at_infinity(mesh, signs, viewer_in_mesh, light);
        }
        count
    }
}

impl VolumeRanges {
    fn add(&mut self, parts: &Parts, is_z_pass: bool) {
        if is_z_pass {
            join(&mut self.z_pass_sides, &parts.sides);
        } else {
            join(&mut self.z_fail_sides, &parts.sides);
            join(&mut self.cap_pos, &parts.cap_pos);
            join(&mut self.cap_neg, &parts.cap_neg);
        }
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

/// The light in the world, homogeneous.
pub fn light_in_world(light: &LightShape) -> DVec4 {
    match *light {
        LightShape::Directional { towards } => towards.extend(0.0),
        LightShape::Point { p_in_world } | LightShape::Spot { p_in_world, .. } => {
            p_in_world.extend(1.0)
        }
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

/// A caster, or a part of one, with its volume.
struct Piece<'a> {
    object: u32,
    mesh: Cow<'a, CasterMesh>,
    base: Base,
    signs: Vec<i8>,
    volume: Volume,
}

/// Makes volumes of one light.
struct Maker<'a> {
    content: &'a Content,
    light: &'a WorldLight,
    method: VolumeMethod,
}

/// Most layers that eight bits count, and that seven do when one bit keeps the result of the
/// layers before.
const MAX_LAYERS: u32 = 255;
const MAX_SPLIT_LAYERS: u32 = 127;

impl<'a> Maker<'a> {
    fn piece(&self, object: u32, mesh: Cow<'a, CasterMesh>, base: Base) -> Piece<'a> {
        let of = &self.content.objects[object as usize];
        let light = light_in_mesh(&self.light.shape, &of.world_from_mesh);
        let mut signs = Vec::new();
        facing(
            &mesh,
            light,
            of.is_mirrored,
            CastRule::default(),
            &mut signs,
        );
        let mut volume = Volume::default();
        let method = match self.method {
            VolumeMethod::Silhouette => Method::Silhouette,
            VolumeMethod::ReferenceEdge => Method::ReferenceEdge,
            VolumeMethod::PerTriangle => Method::PerTriangle,
        };
        extract(&mesh, method, &signs, light, of.is_mirrored, &mut volume);
        Piece {
            object,
            mesh,
            base,
            signs,
            volume,
        }
    }

    fn bound(&self, pieces: &[Piece<'_>], limit: u32) -> u32 {
        let casters: Vec<LayerCaster<'_>> = pieces
            .iter()
            .map(|piece| LayerCaster {
                mesh: &piece.mesh,
                signs: &piece.signs,
                sides: &piece.volume.sides,
                frame_from_local: self.content.objects[piece.object as usize].world_from_mesh,
            })
            .collect();
        layer_bound(&casters, light_in_world(&self.light.shape), limit)
    }

    /// Cuts pieces that alone have too many layers.
    fn cut(&self, pieces: Vec<Piece<'a>>) -> Vec<Piece<'a>> {
        let mut cut = Vec::new();
        for piece in pieces {
            let of = &self.content.objects[piece.object as usize];
            let light = light_in_mesh(&self.light.shape, &of.world_from_mesh);
            let ranges = split(&piece.mesh, light, CastRule::default(), MAX_SPLIT_LAYERS);
            if ranges.len() <= 1 {
                cut.push(piece);
                continue;
            }
            for range in ranges {
                let part = Cow::Owned(piece.mesh.part(range));
                cut.push(self.piece(piece.object, part, Base::default()));
            }
        }
        cut
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
    let maker = Maker {
        content,
        light,
        method,
    };
    let mut pieces: Vec<Piece<'_>> = (0..)
        .zip(&content.objects)
        .filter(|(_, object)| object.is_caster())
        .filter_map(|(index, object)| {
            let (mesh, base) = casters.meshes.get(&object.mesh)?;
            Some(maker.piece(index, Cow::Borrowed(mesh), *base))
        })
        .collect();
    let whole = 0..pieces.len();
    let mut layers = vec![whole];
    let mut own_buffers = None;
    if maker.bound(&pieces, MAX_LAYERS) > MAX_LAYERS {
        pieces = maker.cut(pieces);
        let mut arrays = Arrays::default();
        for piece in &mut pieces {
            piece.base = arrays.add(&piece.mesh);
        }
        own_buffers = Some(arrays.upload(gpu));
        layers = bisect(0..pieces.len(), |range| {
            maker.bound(&pieces[range], MAX_SPLIT_LAYERS) <= MAX_SPLIT_LAYERS
        });
    }
    let mut entries = Entries::default();
    let mut parts: Vec<Vec<Parts>> = layers
        .iter()
        .map(|range| {
            pieces[range.clone()]
                .iter()
                .map(|piece| entries.add(piece))
                .collect()
        })
        .collect();
    for part in parts.iter_mut().flatten() {
        entries.place(part);
    }
    let entries = storage(
        gpu,
        "volume entries",
        bytemuck::cast_slice(&entries.joined()),
    );
    let [positions, edges, triangles, _] = own_buffers.as_ref().unwrap_or(&casters.buffers);
    let group = binding::group(
        &gpu.device,
        "volumes",
        &layouts.volumes,
        [positions, edges, triangles, &entries]
            .map(wgpu::Buffer::as_entire_binding)
            .into(),
    );
    let mut pieces = pieces.into_iter();
    let signs = layers
        .into_iter()
        .map(|range| pieces.by_ref().take(range.len()).map(signs_of).collect())
        .collect();
    LightVolumes {
        shape: light.shape,
        method,
        layers: parts,
        signs,
        group,
        bytes: entries.size(),
    }
}

fn signs_of(piece: Piece<'_>) -> Signs {
    Signs {
        object: piece.object,
        part: match piece.mesh {
            Cow::Borrowed(_) => None,
            Cow::Owned(mesh) => Some(mesh),
        },
        signs: piece.signs,
    }
}

/// Entries while they are collected: sides first, then the two kinds of caps.
#[derive(Default)]
struct Entries {
    sides: Vec<[u32; 2]>,
    cap_pos: Vec<[u32; 2]>,
    cap_neg: Vec<[u32; 2]>,
}

impl Entries {
    fn add(&mut self, piece: &Piece<'_>) -> Parts {
        let push = |list: &mut Vec<[u32; 2]>, from: &[u32], base: u32| {
            let start = list.len() as u32;
            list.extend(from.iter().map(|&entry| [entry + base, piece.object]));
            start..list.len() as u32
        };
        let Base { edge, triangle } = piece.base;
        Parts {
            object: piece.object,
            sides: push(&mut self.sides, &piece.volume.sides, edge << 1),
            cap_pos: push(&mut self.cap_pos, &piece.volume.cap_pos, triangle),
            cap_neg: push(&mut self.cap_neg, &piece.volume.cap_neg, triangle),
        }
    }

    /// Moves ranges to where their list will be.
    fn place(&self, parts: &mut Parts) {
        let after_sides = self.sides.len() as u32;
        let after_pos = after_sides + self.cap_pos.len() as u32;
        for (range, by) in [
            (&mut parts.cap_pos, after_sides),
            (&mut parts.cap_neg, after_pos),
        ] {
            *range = range.start + by..range.end + by;
        }
    }

    fn joined(mut self) -> Vec<[u32; 2]> {
        self.sides.append(&mut self.cap_pos);
        self.sides.append(&mut self.cap_neg);
        self.sides
    }
}
