//! The arrays and bindings that a shape sees: those of the state, or of its `vertexProperty`.

use glam::{DMat3, DVec2};
use iv_parser::{Dialect, SourcePos};

use crate::graph::{Graph, Node, NodeId};
use crate::registry::{Class, Family};
use crate::resolve::{Binding, ColorSource, Ordering, TexCoords};

use super::color::Colors;
use super::{Job, MadeFaces};

/// What a shape is made from.
pub struct Attributes<'g> {
    /// The shape node.
    pub node: &'g Node,
    pub pos: SourcePos,
    /// Coordinates, flat.
    pub coordinates: &'g [f64],
    /// Numbers a coordinate: 3, or 4 with a weight.
    pub coordinate_size: usize,
    /// Normals, flat; empty to have them made.
    pub normals: &'g [f64],
    pub normal_binding: Binding,
    pub colors: Colors<'g>,
    pub color_binding: Binding,
    /// `None` when nothing shows a texture.
    pub texcoords: Option<TexCoordSource<'g>>,
    pub texcoord_binding: Binding,
    pub texture_transform: DMat3,
    pub ordering: Ordering,
    pub crease_angle_rad: f64,
    /// The shape stands in a VRML 1 file.
    pub vrml1: bool,
    /// The shape is a node of VRML 2.
    pub vrml2: bool,
    made: Option<&'g MadeFaces>,
}

/// Where texture coordinates come from.
#[derive(Clone, Copy)]
pub enum TexCoordSource<'g> {
    /// The bounding box.
    Default,
    /// A list.
    List(TexCoordList<'g>),
    /// `TextureCoordinatePlane` or `TextureCoordinateObject`.
    Function(&'g Node),
}

/// A list of texture coordinates, flat.
#[derive(Clone, Copy)]
pub struct TexCoordList<'g> {
    numbers: &'g [f64],
    /// Numbers a coordinate: 2, or 3 with an `r` that a flat texture does not look at (OpenGL
    /// divides by the fourth coordinate only, which is 1 here).
    size: usize,
}

impl TexCoordList<'_> {
    /// Number of entries.
    pub fn len(&self) -> usize {
        self.numbers.len() / self.size
    }

    /// `s` and `t` of an entry; zero beyond the end.
    pub fn get(&self, index: usize) -> DVec2 {
        match self.numbers.get(index * self.size..(index + 1) * self.size) {
            Some(&[s, t, ..]) => DVec2::new(s, t),
            _ => DVec2::ZERO,
        }
    }
}

impl<'g> Attributes<'g> {
    pub fn of(job: &Job<'g>) -> Self {
        let graph = job.graph;
        let state = job.state;
        let node = graph.node(job.node);
        let (mut coordinates, mut coordinate_size) = coordinates_of(graph, state.coordinates);
        let mut normals = state
            .normals
            .map_or(&[][..], |id| normals_of(graph.node(id)));
        let mut normal_binding = state.normal_binding;
        let mut diffuse = state.material.diffuse;
        let mut color_binding = state.material_binding;
        let mut texcoords = match state.texcoords {
            TexCoords::Default => TexCoordSource::Default,
            TexCoords::List(id) => TexCoordSource::List(texcoords_of(graph.node(id))),
            TexCoords::Function(id) => TexCoordSource::Function(graph.node(id)),
        };
        if let Some(made) = job.made {
            (coordinates, coordinate_size) = (&made.coordinates, 3);
            if matches!(texcoords, TexCoordSource::Default) {
                texcoords = TexCoordSource::List(TexCoordList {
                    numbers: &made.texcoords,
                    size: 2,
                });
            }
        }
        // What a vertexProperty holds takes the place of the state's; its bindings count only
        // where it holds data for them.
        if let Some(id) = own_property(graph, node) {
            let own = graph.node(id);
            if !own.numbers("vertex").is_empty() {
                (coordinates, coordinate_size) = (own.numbers("vertex"), 3);
            }
            if !own.numbers("normal").is_empty() {
                normals = own.numbers("normal");
                normal_binding =
                    Binding::from_word(own.word("normalBinding"), Binding::PerVertexIndexed);
            }
            if !own.ints("orderedRGBA").is_empty() {
                diffuse = ColorSource::Packed(id);
                color_binding = Binding::from_word(own.word("materialBinding"), Binding::Overall);
            }
            if has_texcoords(own) {
                texcoords = TexCoordSource::List(texcoords_of(own));
            }
        }
        Self {
            node,
            pos: node.pos,
            coordinates,
            coordinate_size,
            normals,
            normal_binding,
            colors: Colors::of(graph, diffuse, state.material.transparency, color_binding),
            color_binding,
            texcoords: state.texture.map(|_| texcoords),
            texcoord_binding: state.texcoord_binding,
            texture_transform: state.texture_transform,
            ordering: state.hints.ordering,
            crease_angle_rad: state.hints.crease_angle_rad,
            vrml1: graph.files[node.pos.file as usize].header.dialect == Dialect::Vrml1,
            vrml2: node
                .class()
                .is_some_and(|c| c.spec().family == Family::Vrml),
            made: job.made,
        }
    }

    /// A list of indices or counts of the shape, by Inventor's name for it.
    pub fn ints(&self, field: &str) -> &'g [i32] {
        match (self.made, field) {
            (Some(made), "coordIndex") => &made.coord_index,
            (Some(made), "textureCoordIndex") => &made.texcoord_index,
            (Some(_), _) => &[],
            (None, _) if !self.vrml2 => self.node.ints(field),
            (None, "materialIndex") => self.node.ints("colorIndex"),
            (None, "textureCoordIndex") => self.node.ints("texCoordIndex"),
            (None, "startIndex") => &[],
            // All points.
            (None, "numPoints") => &[-1],
            (None, _) => self.node.ints(field),
        }
    }

    /// Where the coordinates of a shape without indices begin.
    pub fn start_index(&self) -> usize {
        let start = self.ints("startIndex").first().copied();
        start.unwrap_or(0).max(0) as usize
    }

    /// Number of coordinates.
    pub fn coordinate_count(&self) -> usize {
        self.coordinates.len() / self.coordinate_size
    }
}

/// The shape's `vertexProperty`, if it has one.
fn own_property(graph: &Graph, node: &Node) -> Option<NodeId> {
    node.class()?.spec().field(b"vertexProperty")?;
    let id = node.node_field("vertexProperty")?;
    (graph.node(id).class() == Some(Class::VertexProperty)).then_some(id)
}

fn coordinates_of(graph: &Graph, id: Option<NodeId>) -> (&[f64], usize) {
    let Some(id) = id else {
        // Inventor's default coordinate list holds the origin.
        return (&[0.0; 3], 3);
    };
    let node = graph.node(id);
    match node.class() {
        Some(Class::Coordinate4) => (node.numbers("point"), 4),
        Some(Class::VertexProperty) => (node.numbers("vertex"), 3),
        _ => (node.numbers("point"), 3),
    }
}

fn normals_of(node: &Node) -> &[f64] {
    match node.class() {
        Some(Class::VertexProperty) => node.numbers("normal"),
        _ => node.numbers("vector"),
    }
}

/// Whether a VertexProperty holds texture coordinates.
pub fn has_texcoords(node: &Node) -> bool {
    !node.numbers("texCoord").is_empty() || !node.numbers("texCoord3").is_empty()
}

/// Of a VertexProperty with both kinds the flat ones, which the texture is.
fn texcoords_of(node: &Node) -> TexCoordList<'_> {
    let (field, size) = match node.class() {
        Some(Class::VertexProperty) if node.numbers("texCoord").is_empty() => ("texCoord3", 3),
        Some(Class::VertexProperty) => ("texCoord", 2),
        Some(Class::TextureCoordinate3) => ("point", 3),
        _ => ("point", 2),
    };
    TexCoordList {
        numbers: node.numbers(field),
        size,
    }
}
