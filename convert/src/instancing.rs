//! Many copies of a mesh in one node (`EXT_mesh_gpu_instancing`).
//!
//! Nodes below one parent that hold the same mesh, have no children, and say the same (name, class,
//! surroundings) become one, if their frames do not shear. Frames of copies are f32: they are
//! relative to the middle of all, which stays f64 in the node. Where positions have a tolerance,
//! copies that f32 would move by more than a quarter of it stay nodes.

use geometry::transform::{Decomposition, Trs, decompose};
use glam::{DAffine3, DQuat, DVec3};
use rustc_hash::FxHashMap;

use crate::json::Json;

/// Fewer copies take less room as nodes.
pub(crate) const MIN_COPIES: usize = 4;
/// Share of a tolerance that the rounding of frames may take.
pub(crate) const TOLERANCE_SHARE: f64 = 1.0 / 4.0;

/// The name that both writer and file use.
pub(crate) const EXTENSION: &str = "EXT_mesh_gpu_instancing";

/// The frames of all copies, as they are stored.
#[derive(Debug, Default)]
pub(crate) struct Copies {
    /// Translations and scales.
    triples: Vec<[f32; 3]>,
    rotations: Vec<[f32; 4]>,
    accessors: Vec<Accessor>,
    batches: Vec<Batch>,
}

#[derive(Clone, Copy, Debug)]
struct Accessor {
    is_rotation: bool,
    first: usize,
    count: usize,
}

/// Accessors of the copies of one node.
#[derive(Clone, Copy, Debug)]
struct Batch {
    translations: usize,
    /// `None`: no copy is turned.
    rotations: Option<usize>,
    /// `None`: no copy is scaled.
    scales: Option<usize>,
}

/// How the frames of copies are stored.
pub(crate) struct Frames {
    /// Where the node is.
    pub(crate) middle: DVec3,
    copies: Vec<Trs>,
}

impl Frames {
    /// `None` if one of them shears, or is moved by more than `tolerance` in its parent's frame;
    /// `corners` are those of the mesh's box.
    pub(crate) fn new(
        frames: &[DAffine3],
        corners: &[DVec3; 8],
        tolerance: Option<f64>,
    ) -> Option<Self> {
        let places = || frames.iter().map(|frame| frame.translation);
        let min = places().fold(DVec3::INFINITY, DVec3::min);
        let max = places().fold(DVec3::NEG_INFINITY, DVec3::max);
        let middle = min * 0.5 + max * 0.5;
        let mut copies = Vec::with_capacity(frames.len());
        for frame in frames {
            let mut local = *frame;
            local.translation -= middle;
            let Decomposition::Trs(trs) = decompose(&local) else {
                return None;
            };
            let stored = stored(&trs);
            if let Some(tolerance) = tolerance {
                let moved = |&p: &DVec3| {
                    let (at, was) = (stored.transform_point3(p), local.transform_point3(p));
                    at.distance(was) <= tolerance
                };
                if !corners.iter().all(moved) {
                    return None;
                }
            }
            copies.push(trs);
        }
        Some(Self { middle, copies })
    }
}

/// The frame that a reader makes of what is stored.
fn stored(trs: &Trs) -> DAffine3 {
    let rotation = DQuat::from_vec4(trs.rotation.as_quat().as_dquat().into()).normalize();
    let (scale, translation) = (trs.scale.as_vec3(), trs.translation.as_vec3());
    DAffine3::from_scale_rotation_translation(scale.as_dvec3(), rotation, translation.as_dvec3())
}

impl Copies {
    pub(crate) fn is_empty(&self) -> bool {
        self.batches.is_empty()
    }

    /// Keeps the copies of a node; gives the number of the batch.
    pub(crate) fn add(&mut self, frames: &Frames) -> usize {
        let copies = &frames.copies;
        let turned = copies.iter().any(|c| c.rotation != DQuat::IDENTITY);
        let scaled = copies.iter().any(|c| c.scale != DVec3::ONE);
        let triples = |of: fn(&Trs) -> DVec3| -> Vec<[f32; 3]> {
            copies.iter().map(|c| of(c).as_vec3().to_array()).collect()
        };
        let translations = self.add_triples(&triples(|c| c.translation));
        let rotations = turned.then(|| {
            let first = self.rotations.len();
            let rotations = copies.iter().map(|c| c.rotation.as_quat().to_array());
            self.rotations.extend(rotations);
            self.add_accessor(true, first, copies.len())
        });
        let scales = scaled.then(|| self.add_triples(&triples(|c| c.scale)));
        self.batches.push(Batch {
            translations,
            rotations,
            scales,
        });
        self.batches.len() - 1
    }

    fn add_triples(&mut self, triples: &[[f32; 3]]) -> usize {
        let first = self.triples.len();
        self.triples.extend(triples);
        self.add_accessor(false, first, triples.len())
    }

    fn add_accessor(&mut self, is_rotation: bool, first: usize, count: usize) -> usize {
        self.accessors.push(Accessor {
            is_rotation,
            first,
            count,
        });
        self.accessors.len() - 1
    }

    /// The bytes of the buffer views, at most two, one of which has the rotations.
    pub(crate) fn views(&self) -> Vec<Vec<u8>> {
        let bytes = |floats: &[f32]| floats.iter().flat_map(|v| v.to_le_bytes()).collect();
        let views: [Vec<u8>; 2] = [
            bytes(self.triples.as_flattened()),
            bytes(self.rotations.as_flattened()),
        ];
        views.into_iter().filter(|view| !view.is_empty()).collect()
    }

    /// How many accessors there are.
    pub(crate) fn accessor_count(&self) -> usize {
        self.accessors.len()
    }

    /// Accessor `index` of the copies; their views begin at `first_view`.
    pub(crate) fn write_accessor(&self, json: &mut Json, index: usize, first_view: usize) {
        const FLOAT: u64 = 5126;
        let accessor = &self.accessors[index];
        let (view, bytes, shape) = if accessor.is_rotation {
            (1, 16, "VEC4")
        } else {
            (0, 12, "VEC3")
        };
        json.object(|json| {
            json.key("bufferView").usize(first_view + view);
            if accessor.first > 0 {
                json.key("byteOffset").usize(accessor.first * bytes);
            }
            json.key("componentType").u64(FLOAT);
            json.key("count").usize(accessor.count);
            json.key("type").str(shape);
        });
    }

    /// The extension of a node; the copies' accessors begin at `first_accessor`.
    pub(crate) fn write_batch(&self, json: &mut Json, batch: usize, first_accessor: usize) {
        let batch = &self.batches[batch];
        json.key(EXTENSION).object(|json| {
            json.key("attributes").object(|json| {
                json.key("TRANSLATION")
                    .usize(first_accessor + batch.translations);
                if let Some(rotations) = batch.rotations {
                    json.key("ROTATION").usize(first_accessor + rotations);
                }
                if let Some(scales) = batch.scales {
                    json.key("SCALE").usize(first_accessor + scales);
                }
            });
        });
    }
}

/// Numbers of items with equal keys, in the order of their first; items without a key by
/// themselves.
pub(crate) fn alike<K: Eq + std::hash::Hash>(
    items: &[usize],
    key: impl Fn(usize) -> Option<K>,
) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let mut known: FxHashMap<K, usize> = FxHashMap::default();
    for &item in items {
        match key(item) {
            None => groups.push(vec![item]),
            Some(key) => {
                let next = groups.len();
                let group = *known.entry(key).or_insert(next);
                if group == next {
                    groups.push(Vec::new());
                }
                groups[group].push(item);
            }
        }
    }
    groups
}
