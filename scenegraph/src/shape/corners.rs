//! Corners of faces, segments and points, with the index of every value that each takes.
//!
//! Bindings end here: behind this file there are corners with indices, and no Inventor rule.

use crate::resolve::Binding;

use super::attributes::{Attributes, TexCoordSource};

/// The index that each corner takes into one list of values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Take {
    /// None: the attribute is not there.
    Nothing,
    /// The first value, for all.
    First,
    /// The one of the corner's coordinate index.
    Coordinate,
    /// An index for each corner.
    Corners(Vec<u32>),
}

/// Corners in order, cut into faces (or segments, or points).
#[derive(Clone, Debug)]
pub struct Corners {
    /// Index of each corner's coordinate; all in range.
    pub coordinates: Vec<u32>,
    /// One past the last corner of each face. Empty when all have `step` corners.
    pub ends: Vec<u32>,
    /// Corners a face when `ends` is empty.
    pub step: usize,
    pub normals: Take,
    pub colors: Take,
    pub texcoords: Take,
    /// Whether corners at equal positions count as one vertex even if their indices differ.
    pub by_position: bool,
    /// Smooth whatever the crease angle is.
    pub always_smooth: bool,
}

impl Corners {
    /// Whether every three corners are a face.
    pub fn is_triangle_list(&self) -> bool {
        self.ends.is_empty() && self.step == 3
    }

    /// The corner ranges of all faces.
    pub fn faces(&self) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
        let by_step = self.ends.is_empty();
        let count = if by_step {
            self.coordinates.len() / self.step
        } else {
            self.ends.len()
        };
        (0..count).map(move |i| {
            if by_step {
                i * self.step..(i + 1) * self.step
            } else {
                let start = if i == 0 { 0 } else { self.ends[i - 1] };
                start as usize..self.ends[i] as usize
            }
        })
    }
}

/// Arrays whose memory can be used again.
#[derive(Default)]
pub struct Spare {
    coordinates: Vec<u32>,
    ends: Vec<u32>,
}

impl From<Corners> for Spare {
    fn from(mut corners: Corners) -> Self {
        corners.coordinates.clear();
        corners.ends.clear();
        Self {
            coordinates: corners.coordinates,
            ends: corners.ends,
        }
    }
}

/// Where a corner is, in all ways that a binding may ask for.
#[derive(Clone, Copy, Default)]
pub struct Spot {
    /// Ordinal of the part (strip, row, segment).
    pub part: usize,
    /// Ordinal of the face (face, triangle, quad, polyline).
    pub face: usize,
    /// Running number of the corner among those of the shape, `startIndex` not counted.
    pub corner: usize,
    /// Position in the index list.
    pub slot: usize,
    /// Coordinate index.
    pub coordinate: u32,
}

/// What one attribute takes at a spot.
enum Rule<'g> {
    Nothing,
    First,
    Coordinate,
    Part,
    Face,
    Corner,
    PartIndex(&'g [i32]),
    FaceIndex(&'g [i32]),
    SlotIndex(&'g [i32]),
}

impl Rule<'_> {
    fn at(&self, spot: &Spot) -> u32 {
        // A list that is too short goes on with what it would be without one.
        let listed = |list: &[i32], i: usize, without: usize| {
            list.get(i).map_or(without as u32, |&v| v.max(0) as u32)
        };
        match self {
            Self::Nothing | Self::First => 0,
            Self::Coordinate => spot.coordinate,
            Self::Part => spot.part as u32,
            Self::Face => spot.face as u32,
            Self::Corner => spot.corner as u32,
            Self::PartIndex(list) => listed(list, spot.part, spot.part),
            Self::FaceIndex(list) => listed(list, spot.face, spot.face),
            Self::SlotIndex(list) => listed(list, spot.slot, spot.coordinate as usize),
        }
    }
}

/// Collects corners under fixed rules.
pub struct Collector<'g> {
    rules: [Rule<'g>; 3],
    takes: [Vec<u32>; 3],
    pub coordinates: Vec<u32>,
    pub ends: Vec<u32>,
    pub coordinate_count: usize,
}

/// Whether PER_PART counts faces, as in face sets, or parts of their own.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Parts {
    AreFaces,
    Own,
}

impl<'g> Collector<'g> {
    /// For a shape whose index fields are read if `indexed`.
    pub fn new(attributes: &Attributes<'g>, indexed: bool, parts: Parts) -> Self {
        let list = |field: &str| {
            if indexed { attributes.ints(field) } else { &[] }
        };
        // An index list whose first value is negative counts as empty.
        let usable = |list: &'g [i32]| list.first().is_some_and(|&v| v >= 0).then_some(list);
        let rule = |binding: Binding, field: &str| {
            let index = usable(list(field));
            match (binding, index) {
                (Binding::Overall, _) => Rule::First,
                (Binding::PerPart, _) if parts == Parts::AreFaces => Rule::Face,
                (Binding::PerPart, _) => Rule::Part,
                (Binding::PerFace, _) => Rule::Face,
                // VRML 1 has no running count: a vertex is its coordinate (SoIndexedFaceSet).
                (Binding::PerVertex, _) if indexed && attributes.vrml1 => Rule::Coordinate,
                (Binding::PerVertex, _) => Rule::Corner,
                (Binding::PerPartIndexed, Some(index)) if parts == Parts::Own => {
                    Rule::PartIndex(index)
                }
                (Binding::PerPartIndexed, None) if parts == Parts::Own => Rule::Part,
                (Binding::PerPartIndexed | Binding::PerFaceIndexed, Some(index)) => {
                    Rule::FaceIndex(index)
                }
                // SGI falls back on coordIndex here and Coin crashes; the face's number is what
                // writers of such files mean.
                (Binding::PerPartIndexed | Binding::PerFaceIndexed, None) => Rule::Face,
                (Binding::PerVertexIndexed, Some(index)) => Rule::SlotIndex(index),
                (Binding::PerVertexIndexed, None) if indexed => Rule::Coordinate,
                (Binding::PerVertexIndexed, None) => Rule::Corner,
            }
        };
        let normals = match attributes.normals {
            [] => Rule::Nothing,
            _ => rule(attributes.normal_binding, "normalIndex"),
        };
        let colors = match attributes.colors.is_uniform() {
            true => Rule::Nothing,
            false => rule(attributes.color_binding, "materialIndex"),
        };
        let texcoords = match (&attributes.texcoords, attributes.texcoord_binding) {
            (Some(TexCoordSource::List(_)), Binding::PerVertex) => Rule::Corner,
            (Some(TexCoordSource::List(_)), _) => {
                rule(Binding::PerVertexIndexed, "textureCoordIndex")
            }
            (Some(_), _) => Rule::Coordinate,
            (None, _) => Rule::Nothing,
        };
        Self {
            rules: [normals, colors, texcoords],
            takes: Default::default(),
            coordinates: Vec::new(),
            ends: Vec::new(),
            coordinate_count: attributes.coordinate_count(),
        }
    }

    /// Fills these arrays, which are empty.
    pub fn with(self, spare: Spare) -> Self {
        Self {
            coordinates: spare.coordinates,
            ends: spare.ends,
            ..self
        }
    }

    /// Whether a coordinate index can be used.
    pub fn is_valid(&self, index: i64) -> bool {
        (0..self.coordinate_count as i64).contains(&index)
    }

    /// Room for `corners` more.
    pub fn reserve(&mut self, corners: usize) {
        self.coordinates.reserve(corners);
    }

    /// Adds a corner.
    pub fn push(&mut self, spot: &Spot) {
        self.coordinates.push(spot.coordinate);
        for (rule, take) in self.rules.iter().zip(&mut self.takes) {
            if !matches!(rule, Rule::Nothing | Rule::First | Rule::Coordinate) {
                take.push(rule.at(spot));
            }
        }
    }

    /// Ends a face.
    pub fn end_face(&mut self) {
        self.ends.push(self.coordinates.len() as u32);
    }

    /// Whether a corner's coordinate is all there is to it, so that lists can be copied.
    pub fn is_plain(&self) -> bool {
        let plain =
            |rule: &Rule<'_>| matches!(rule, Rule::Nothing | Rule::First | Rule::Coordinate);
        self.rules.iter().all(plain)
    }

    /// The corners; `first_value` is added to what normals and texture coordinates take by
    /// running number.
    pub fn finish(self, step: usize, first_value: u32) -> Corners {
        let [normals, colors, texcoords] = self.rules;
        let [normal_takes, color_takes, texcoord_takes] = self.takes;
        let take = |rule: Rule<'_>, mut list: Vec<u32>, offset: u32| match rule {
            Rule::Nothing => Take::Nothing,
            Rule::First => Take::First,
            Rule::Coordinate => Take::Coordinate,
            Rule::Corner => {
                list.iter_mut().for_each(|v| *v = v.saturating_add(offset));
                Take::Corners(list)
            }
            _ => Take::Corners(list),
        };
        Corners {
            coordinates: self.coordinates,
            ends: self.ends,
            step,
            normals: take(normals, normal_takes, first_value),
            colors: take(colors, color_takes, 0),
            texcoords: take(texcoords, texcoord_takes, first_value),
            by_position: false,
            always_smooth: false,
        }
    }
}
