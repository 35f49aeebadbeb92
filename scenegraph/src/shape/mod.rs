//! Shapes to meshes: bindings resolved, polygons triangulated, normals and texture coordinates
//! made where the source gives none.
//!
//! A shape under the same geometric state gives the same mesh, which is made once. What reads
//! the state is here and in `attributes`; the other files see plain arrays.

mod assemble;
mod attributes;
mod color;
mod corners;
mod faces;
mod lines;
mod made;
mod measure;
mod normals;
mod nurbs;
mod outline;
mod primitives;
mod profiles;
mod texcoords;
mod text;
mod values;

use glam::DVec3;
use rustc_hash::FxHashMap;

use crate::graph::NodeId;
use crate::registry::Class;
use crate::remarks::Remarks;
use crate::resolve::{ColorSource, ProfileList, State, Style, TexCoords};
use crate::scene::{Mesh, MeshId, Topology};

pub use measure::Measure;

use crate::graph::Graph;
use assemble::Assembler;
pub(crate) use attributes::{Attributes, has_texcoords};
pub(crate) use made::{Complaint, MadeFaces, elevation_grid, extrusion};
pub(crate) use nurbs::is_nurbs;
pub(crate) use primitives::is_closed;
pub(crate) use text::{is_screen_text, is_text};

/// All that a mesh depends on.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct MeshKey {
    shape: NodeId,
    coordinates: Option<NodeId>,
    normals: Option<NodeId>,
    texcoords: Option<TexCoords>,
    texture_transform: Option<[u64; 9]>,
    colors: Option<(ColorSource, ColorSource)>,
    bindings: [crate::resolve::Binding; 3],
    ordering: crate::resolve::Ordering,
    crease_angle: u64,
    complexity: u64,
    /// Of what profiles shape: them, and their points.
    profiles: Option<(ProfileList, Option<NodeId>)>,
    chord: Option<u64>,
    style: Style,
    lit: bool,
    /// Font and size, for text.
    text: Option<text::TextKey>,
}

/// Whether profiles have a say in a shape of this class.
pub(crate) fn has_profiles(class: Class) -> bool {
    nurbs::is_trimmed(class) || class == Class::Text3
}

/// What a mesh takes: each index, and each vertex with all it may have.
const BYTES_EACH_INDEX: usize = 4;
const BYTES_EACH_VERTEX: usize = 48;

/// A mesh that was made, and what its material must know.
#[derive(Clone, Copy, Debug)]
pub struct Made {
    /// The mesh.
    pub mesh: MeshId,
    /// It carries normals.
    pub lit: bool,
    /// It carries texture coordinates.
    pub textured: bool,
}

/// Makes meshes, each once.
#[derive(Default)]
pub struct ShapeMaker {
    cache: FxHashMap<MeshKey, Option<Made>>,
    assembler: Assembler,
    /// The arrays of an earlier shape, for the next one to fill.
    spare: corners::Spare,
    glyphs: text::GlyphCache,
    bytes: usize,
}

/// A shape to be made: where it is and in which state.
pub struct Job<'a> {
    pub graph: &'a Graph,
    pub class: Class,
    pub node: NodeId,
    pub state: &'a State,
    /// Whether lighting can matter to it.
    pub lit: bool,
    /// How polygons are drawn.
    pub style: Style,
    /// Whether the shape can come again; only then is its mesh looked up and remembered.
    pub shared: bool,
    /// Whether polygons are cut from their first corner, whatever their shape.
    pub fans: bool,
    /// Of NURBS: the chord asked for, in the shape's own frame.
    pub chord: Option<f64>,
    /// Of NURBS surfaces the profiles that trim it, of text those that shape it.
    pub profiles: Vec<NodeId>,
    /// The faces of a shape that is given by rule.
    pub made: Option<&'a MadeFaces>,
}

impl ShapeMaker {
    fn key(job: &Job<'_>, attributes: &Attributes<'_>) -> MeshKey {
        let state = job.state;
        let textured = state.texture.is_some();
        let transform = state.texture_transform;
        MeshKey {
            shape: job.node,
            coordinates: state.coordinates,
            normals: state.normals,
            texcoords: textured.then_some(state.texcoords),
            texture_transform: textured.then(|| transform.to_cols_array().map(f64::to_bits)),
            colors: (!attributes.colors.is_uniform())
                .then_some((state.material.diffuse, state.material.transparency)),
            bindings: [
                state.normal_binding,
                state.material_binding,
                state.texcoord_binding,
            ],
            ordering: state.hints.ordering,
            crease_angle: state.hints.crease_angle_rad.to_bits(),
            complexity: state.complexity.to_bits(),
            profiles: has_profiles(job.class)
                .then_some((state.profiles, state.profile_coordinates)),
            chord: job.chord.map(f64::to_bits),
            style: job.style,
            lit: job.lit,
            text: is_text(job.class).then(|| text::TextKey::of(state)),
        }
    }

    /// Whether a shape has the same mesh under another look, which `other` is its job with. Where
    /// `job` is lit or textured and `other` is not, the mesh does for both.
    pub fn same_mesh(
        job: &Job<'_>,
        attributes: &Attributes<'_>,
        other: &Job<'_>,
        other_attributes: &Attributes<'_>,
    ) -> bool {
        let (key, mut others) = (
            Self::key(job, attributes),
            Self::key(other, other_attributes),
        );
        if !other.lit {
            others.lit = key.lit;
        }
        if other.state.texture.is_none() {
            others.texcoords = key.texcoords;
            others.texture_transform = key.texture_transform;
        }
        key == others
    }

    /// The mesh of a shape, kept by `keep` when it is new; `None` if it draws nothing.
    pub fn mesh(
        &mut self,
        job: &Job<'_>,
        attributes: &Attributes<'_>,
        remarks: &mut Remarks,
        keep: impl FnOnce(Mesh) -> MeshId,
    ) -> Option<Made> {
        let key = job.shared.then(|| Self::key(job, attributes));
        if let Some(known) = key.as_ref().and_then(|key| self.cache.get(key)) {
            return *known;
        }
        let made = self.make(job, attributes, remarks).map(|mesh| {
            self.bytes +=
                BYTES_EACH_INDEX * mesh.indices.len() + BYTES_EACH_VERTEX * mesh.positions.len();
            Made {
                lit: !mesh.normals.is_empty(),
                textured: !mesh.texcoords.is_empty(),
                mesh: keep(mesh),
            }
        });
        self.cache.extend(key.map(|key| (key, made)));
        made
    }

    /// Bytes of all meshes that were made.
    pub fn made_bytes(&self) -> usize {
        self.bytes
    }

    fn make(
        &mut self,
        job: &Job<'_>,
        attributes: &Attributes<'_>,
        remarks: &mut Remarks,
    ) -> Option<Mesh> {
        match job.class {
            Class::Cube | Class::Sphere | Class::Cone | Class::Cylinder => {
                primitives::mesh(job, attributes)
                    .and_then(|m| outline::styled_primitive(m, job.style))
            }
            _ if is_nurbs(job.class) => nurbs::mesh(job, attributes, remarks),
            class if is_text(class) => text::mesh(job, attributes, &mut self.glyphs, remarks)
                .and_then(|m| outline::styled_primitive(m, job.style)),
            Class::LineSet | Class::IndexedLineSet => {
                let mut segments = lines::segments(job, attributes, remarks);
                self.assembler
                    .assemble(&mut segments, Topology::Lines, attributes, job, remarks)
            }
            Class::PointSet
            | Class::IndexedPointSet
            | Class::MarkerSet
            | Class::IndexedMarkerSet => {
                let mut points = lines::points(job, attributes, remarks);
                self.assembler
                    .assemble(&mut points, Topology::Points, attributes, job, remarks)
            }
            _ => {
                let spare = std::mem::take(&mut self.spare);
                let faces = faces::faces(job, attributes, spare, remarks)?;
                let (mut corners, topology) = outline::styled(faces, job.style);
                let mesh =
                    self.assembler
                        .assemble(&mut corners, topology, attributes, job, remarks);
                self.spare = corners.into();
                mesh
            }
        }
    }

    /// Whether shapes of this class are made here.
    pub fn knows(class: Class) -> bool {
        is_nurbs(class)
            || is_text(class)
            || matches!(
                class,
                Class::Cube
                    | Class::Sphere
                    | Class::Text2
                    | Class::Text3
                    | Class::AsciiText
                    | Class::Cone
                    | Class::Cylinder
                    | Class::FaceSet
                    | Class::IndexedFaceSet
                    | Class::TriangleStripSet
                    | Class::IndexedTriangleStripSet
                    | Class::QuadMesh
                    | Class::LineSet
                    | Class::IndexedLineSet
                    | Class::PointSet
                    | Class::IndexedPointSet
                    | Class::MarkerSet
                    | Class::IndexedMarkerSet
            )
    }
}

/// A point of a flat list of coordinates, three or four numbers each.
fn point(coordinates: &[f64], size: usize, index: usize) -> Option<DVec3> {
    match *coordinates.get(index * size..(index + 1) * size)? {
        [x, y, z] => Some(DVec3::new(x, y, z)),
        [x, y, z, w] if w != 0.0 => Some(DVec3::new(x, y, z) / w),
        [x, y, z, _] => Some(DVec3::new(x, y, z)),
        _ => None,
    }
}
