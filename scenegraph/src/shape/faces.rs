//! Polygon shapes as lists of faces, with the index of every value that a corner takes.
//!
//! Bindings end here: behind this file there are corners with indices, and no Inventor rule.

use crate::registry::Class;
use crate::remarks::Remarks;
use crate::resolve::Binding;

use super::Job;
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
    coordinate_count: usize,
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
    fn with(self, spare: Spare) -> Self {
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
    fn is_plain(&self) -> bool {
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

/// The faces of a polygon shape; `None` if it has none.
pub fn faces(
    job: &Job<'_>,
    attributes: &Attributes<'_>,
    spare: Spare,
    remarks: &mut Remarks,
) -> Option<Corners> {
    let corners = match job.class {
        Class::IndexedFaceSet => indexed_faces(attributes, spare, remarks),
        Class::FaceSet => face_set(attributes, remarks),
        Class::IndexedTriangleStripSet => indexed_strips(attributes, remarks),
        Class::TriangleStripSet => strips(attributes, remarks),
        Class::QuadMesh => quads(attributes, remarks),
        _ => return None,
    };
    (!corners.coordinates.is_empty()).then_some(corners)
}

fn bad_index(attributes: &Attributes<'_>, what: &str, remarks: &mut Remarks) {
    remarks.warn(
        "bad-index",
        &format!(
            "{what} of {} uses a coordinate that does not exist",
            attributes.node.class_name()
        ),
        "it was left out",
        attributes.pos,
    );
}

fn too_small(attributes: &Attributes<'_>, remarks: &mut Remarks) {
    remarks.warn(
        "small-face",
        &format!(
            "a face of {} has fewer than three corners",
            attributes.node.class_name()
        ),
        "it was left out",
        attributes.pos,
    );
}

fn indexed_faces(attributes: &Attributes<'_>, spare: Spare, remarks: &mut Remarks) -> Corners {
    let list = attributes.ints("coordIndex");
    let mut collector = Collector::new(attributes, true, Parts::AreFaces).with(spare);
    let plain = collector.is_plain();
    let count = collector.coordinate_count as u64;
    collector.reserve(list.len() - list.len() / 4);
    let (mut face, mut corner, mut start) = (0, 0, 0);
    let mut only_triangles = true;
    while start < list.len() {
        let rest = &list[start..];
        let len = rest.iter().position(|&v| v < 0).unwrap_or(rest.len());
        let indices = &rest[..len];
        if len < 3 {
            if len > 0 && (len, start) != (1, 0) {
                too_small(attributes, remarks);
            }
        } else if indices.iter().any(|&v| v as u64 >= count) {
            bad_index(attributes, "a face", remarks);
        } else {
            if only_triangles && len != 3 {
                // From here on the ends are needed; those so far are multiples of three.
                only_triangles = false;
                let done = collector.coordinates.len() as u32;
                collector.ends.extend((3..=done).step_by(3));
            }
            if plain {
                collector
                    .coordinates
                    .extend(indices.iter().map(|&v| v as u32));
            } else {
                for (i, &index) in indices.iter().enumerate() {
                    collector.push(&Spot {
                        part: face,
                        face,
                        corner: corner + i,
                        slot: start + i,
                        coordinate: index as u32,
                    });
                }
            }
            if !only_triangles {
                collector.end_face();
            }
        }
        face += usize::from(len > 0);
        corner += len;
        start += len + 1;
    }
    collector.finish(3, 0)
}

/// The ranges that `numVertices` cuts the coordinates from `startIndex` on into: -1 takes all
/// that is left.
pub fn runs(
    attributes: &Attributes<'_>,
    field: &str,
    remarks: &mut Remarks,
) -> (usize, Vec<usize>) {
    let total = attributes.coordinate_count();
    let start = attributes.start_index().min(total);
    let mut left = total - start;
    let mut runs = Vec::new();
    for &count in attributes.ints(field) {
        let wanted = if count < 0 { left } else { count as usize };
        if wanted > left {
            remarks.warn(
                "short-coordinates",
                &format!(
                    "{} has fewer coordinates than it counts",
                    attributes.node.class_name()
                ),
                "what is there was used",
                attributes.pos,
            );
        }
        runs.push(wanted.min(left));
        left -= wanted.min(left);
        if left == 0 {
            break;
        }
    }
    (start, runs)
}

fn face_set(attributes: &Attributes<'_>, remarks: &mut Remarks) -> Corners {
    let (start, runs) = runs(attributes, "numVertices", remarks);
    let mut collector = Collector::new(attributes, false, Parts::AreFaces);
    let mut corner = 0;
    for (face, &len) in runs.iter().enumerate() {
        if len < 3 {
            too_small(attributes, remarks);
        } else {
            for i in corner..corner + len {
                collector.push(&Spot {
                    part: face,
                    face,
                    corner: i,
                    slot: i,
                    coordinate: (start + i) as u32,
                });
            }
            collector.end_face();
        }
        corner += len;
    }
    Corners {
        by_position: true,
        ..collector.finish(3, start as u32)
    }
}

/// Adds the triangles of a strip whose corners are the `spots`; every other one is turned.
fn strip(collector: &mut Collector<'_>, spots: &[Spot], face: &mut usize) {
    for (i, window) in spots.windows(3).enumerate() {
        let order = if i.is_multiple_of(2) {
            [0, 1, 2]
        } else {
            [1, 0, 2]
        };
        for k in order {
            collector.push(&Spot {
                face: *face,
                ..window[k]
            });
        }
        *face += 1;
    }
}

fn strips(attributes: &Attributes<'_>, remarks: &mut Remarks) -> Corners {
    let (start, runs) = runs(attributes, "numVertices", remarks);
    let mut collector = Collector::new(attributes, false, Parts::Own);
    let (mut corner, mut face) = (0, 0);
    for (part, &len) in runs.iter().enumerate() {
        if len < 3 {
            too_small(attributes, remarks);
        }
        let spots: Vec<Spot> = (corner..corner + len)
            .map(|i| Spot {
                part,
                corner: i,
                slot: i,
                coordinate: (start + i) as u32,
                face: 0,
            })
            .collect();
        strip(&mut collector, &spots, &mut face);
        corner += len;
    }
    Corners {
        by_position: true,
        ..collector.finish(3, start as u32)
    }
}

fn indexed_strips(attributes: &Attributes<'_>, remarks: &mut Remarks) -> Corners {
    let list = attributes.ints("coordIndex");
    let mut collector = Collector::new(attributes, true, Parts::Own);
    let (mut part, mut corner, mut face, mut start) = (0, 0, 0, 0);
    let mut spots = Vec::new();
    while start < list.len() {
        let rest = &list[start..];
        let len = rest.iter().position(|&v| v < 0).unwrap_or(rest.len());
        spots.clear();
        spots.extend(rest[..len].iter().enumerate().map(|(i, &index)| Spot {
            part,
            corner: corner + i,
            slot: start + i,
            coordinate: index as u32,
            face: 0,
        }));
        if len > 0 && len < 3 && (len, start) != (1, 0) {
            too_small(attributes, remarks);
        }
        if spots
            .iter()
            .all(|s| collector.is_valid(i64::from(s.coordinate)))
        {
            strip(&mut collector, &spots, &mut face);
        } else {
            bad_index(attributes, "a strip", remarks);
            face += len.saturating_sub(2);
        }
        part += usize::from(len > 0);
        corner += len;
        start += len + 1;
    }
    Corners {
        by_position: true,
        ..collector.finish(3, 0)
    }
}

fn quads(attributes: &Attributes<'_>, remarks: &mut Remarks) -> Corners {
    let node = attributes.node;
    let start = node.int("startIndex").max(0) as usize;
    let columns = node.int("verticesPerRow").max(0) as usize;
    let mut rows = node.int("verticesPerColumn").max(0) as usize;
    let available = attributes.coordinate_count().saturating_sub(start);
    if columns == 0 {
        rows = 0;
    } else if rows > available / columns {
        remarks.warn(
            "short-coordinates",
            "QuadMesh has fewer coordinates than its rows and columns need",
            "the whole rows that are there were used",
            attributes.pos,
        );
        rows = available / columns;
    }
    let mut collector = Collector::new(attributes, false, Parts::Own);
    for row in 1..rows {
        for column in 1..columns {
            let face = (row - 1) * (columns - 1) + column - 1;
            for (r, c) in [
                (row - 1, column - 1),
                (row, column - 1),
                (row, column),
                (row - 1, column),
            ] {
                let corner = r * columns + c;
                collector.push(&Spot {
                    part: row - 1,
                    face,
                    corner,
                    slot: corner,
                    coordinate: (start + corner) as u32,
                });
            }
            collector.end_face();
        }
    }
    Corners {
        by_position: true,
        always_smooth: true,
        ..collector.finish(4, start as u32)
    }
}
