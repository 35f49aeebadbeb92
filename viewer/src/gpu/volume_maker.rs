//! Makes the shadow volumes of a light: finds sides and caps of every caster, looks how many can
//! lie on top of each other, and cuts them into layers if the stencil cannot count so many.

use std::borrow::Cow;

use geometry::bounds::Aabb;

use super::binding::{self, Layouts};
use super::casters::{Arrays, Base, Casters, storage};
use super::device::Gpu;
use super::volumes::{LightVolumes, Parts, Signs, light_in_mesh, light_in_world};
use crate::content::{Content, WorldLight};
use crate::frame::{VolumeMethod, far_plane, is_cut};
use crate::volume::{
    CastRule, CasterMesh, LayerCaster, Method, Volume, bisect, extract, facing, layer_bound, split,
};

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

/// Makes the volumes of all casters for a light.
pub fn make(
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
            let (mesh, base) = casters.mesh(object.mesh)?;
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
    let boxes: Vec<Aabb> = pieces
        .iter()
        .map(|piece| content.objects[piece.object as usize].bounds)
        .collect();
    let far_plane = far_plane(&content.bounds, &light.shape, &boxes);
    let is_cut: Vec<bool> = boxes
        .iter()
        .map(|bounds| far_plane.is_some_and(|plane| is_cut(plane, &light.shape, bounds)))
        .collect();
    let mut entries = Entries::default();
    let mut parts: Vec<Vec<Parts>> = layers
        .iter()
        .map(|range| {
            pieces[range.clone()]
                .iter()
                .zip(&is_cut[range.clone()])
                .map(|(piece, &is_cut)| entries.add(piece, is_cut))
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
    let [positions, edges, triangles, _] = own_buffers.as_ref().unwrap_or(casters.buffers());
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
        far_plane,
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

/// The bit of an entry's object that lets its side end at the far plane.
const CUT: u32 = 1 << 31;

/// Entries while they are collected: sides first, then the two kinds of caps.
#[derive(Default)]
struct Entries {
    sides: Vec<[u32; 2]>,
    cap_pos: Vec<[u32; 2]>,
    cap_neg: Vec<[u32; 2]>,
}

impl Entries {
    fn add(&mut self, piece: &Piece<'_>, is_cut: bool) -> Parts {
        let push = |list: &mut Vec<[u32; 2]>, from: &[u32], base: u32, mark: u32| {
            let start = list.len() as u32;
            list.extend(
                from.iter()
                    .map(|&entry| [entry + base, piece.object | mark]),
            );
            start..list.len() as u32
        };
        let cut = if is_cut { CUT } else { 0 };
        let Base { edge, triangle } = piece.base;
        Parts {
            object: piece.object,
            sides: push(&mut self.sides, &piece.volume.sides, edge << 1, cut),
            cap_pos: push(&mut self.cap_pos, &piece.volume.cap_pos, triangle, 0),
            cap_neg: push(&mut self.cap_neg, &piece.volume.cap_neg, triangle, 0),
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
