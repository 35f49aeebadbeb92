//! Meshes as shapes: `IndexedFaceSet`, `IndexedLineSet` and `PointSet`, each with its arrays in a
//! `VertexProperty`. Vertex colours become a palette, which the caller writes as a material.

use rustc_hash::FxHashMap;

use crate::scene::{Material, Mesh, Topology};

use super::text::{Number, Text};

/// The distinct colours of a mesh, and which of them each vertex has.
#[derive(Clone, Debug, Default)]
pub(super) struct Palette {
    rgba_srgb: Vec<[f32; 4]>,
    of_vertex: Vec<u32>,
}

impl Palette {
    /// The material's own colour, which the mesh's stand in place of, is the first, so that it
    /// comes back; it is no vertex's, so that the indices are the same with any material. Points have no index: theirs is a list of a colour for each point.
    pub(super) fn new(mesh: &Mesh, material: &Material) -> Self {
        if mesh.colors_srgb.is_empty() {
            return Self::default();
        }
        if mesh.topology == Topology::Points {
            let color = |&i: &u32| mesh.colors_srgb[i as usize];
            return Self {
                rgba_srgb: mesh.indices.iter().map(color).collect(),
                of_vertex: Vec::new(),
            };
        }
        let [r, g, b] = material.diffuse_srgb.map(|v| v as f32);
        let mut rgba_srgb = vec![[r, g, b, (1.0 - material.transparency) as f32]];
        let mut known = FxHashMap::default();
        let mut index = |color: &[f32; 4]| {
            *known.entry(color.map(f32::to_bits)).or_insert_with(|| {
                rgba_srgb.push(*color);
                rgba_srgb.len() as u32 - 1
            })
        };
        let of_vertex = mesh.colors_srgb.iter().map(&mut index).collect();
        Self {
            rgba_srgb,
            of_vertex,
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.rgba_srgb.is_empty()
    }

    pub(super) fn is_indexed(&self) -> bool {
        !self.of_vertex.is_empty()
    }

    pub(super) fn is_translucent(&self) -> bool {
        self.rgba_srgb.iter().any(|color| color[3] != 1.0)
    }

    pub(super) fn colors(&self) -> impl Iterator<Item = [Number; 3]> {
        let rgb = |&[r, g, b, _]: &[f32; 4]| [r, g, b].map(Number::F32);
        self.rgba_srgb.iter().map(rgb)
    }

    pub(super) fn transparencies(&self) -> impl Iterator<Item = f64> {
        self.rgba_srgb.iter().map(|color| 1.0 - f64::from(color[3]))
    }
}

/// The shape of a mesh.
pub(super) fn write(text: &mut Text, mesh: &Mesh, def: Option<&str>, palette: &Palette) {
    let class = match mesh.topology {
        Topology::Triangles => "IndexedFaceSet",
        Topology::Lines => "IndexedLineSet",
        Topology::Points => "PointSet",
    };
    text.open(def, class);
    text.open_field("vertexProperty", "VertexProperty");
    let vertices = vertices(mesh);
    let origin = mesh.origin.to_array();
    let position = |&i: &u32| {
        let stored = mesh.positions[i as usize];
        std::array::from_fn(|axis| match origin[axis] {
            0.0 => Number::F32(stored[axis]),
            origin => Number::F64(origin + f64::from(stored[axis])),
        })
    };
    text.list::<3>("vertex", vertices.iter().map(position));
    if !mesh.normals.is_empty() {
        let normal = |&i: &u32| mesh.normals[i as usize].map(Number::F32);
        text.list("normal", vertices.iter().map(normal));
        if mesh.topology == Topology::Points {
            text.word("normalBinding", "PER_VERTEX");
        }
    }
    if !mesh.texcoords.is_empty() {
        let texcoord = |&i: &u32| mesh.texcoords[i as usize].map(Number::F32);
        text.list("texCoord", vertices.iter().map(texcoord));
    }
    text.close();
    if mesh.topology != Topology::Points {
        text.indices("coordIndex", corners(mesh));
        if palette.is_indexed() {
            let color = |corner: Option<u32>| Some(palette.of_vertex[corner? as usize]);
            text.indices("materialIndex", corners(mesh).map(color));
        }
    }
    text.close();
}

/// Which vertices are written, in which order: all, or those of the points.
fn vertices(mesh: &Mesh) -> Vec<u32> {
    match mesh.topology {
        Topology::Points => mesh.indices.clone(),
        _ => (0..mesh.positions.len() as u32).collect(),
    }
}

/// The corners with a `None` behind each face or line. Segments that follow each other are one
/// line.
fn corners(mesh: &Mesh) -> impl Iterator<Item = Option<u32>> {
    let step = if mesh.topology == Topology::Lines {
        2
    } else {
        3
    };
    let joins = mesh.topology == Topology::Lines;
    let indices = &mesh.indices;
    (0..indices.len()).flat_map(move |i| {
        let continues = |at: usize| joins && at > 0 && indices.get(at) == indices.get(at - 1);
        let is_first = i.is_multiple_of(step);
        let is_last = (i + 1).is_multiple_of(step);
        let corner = (!(is_first && continues(i))).then_some(Some(indices[i]));
        let end = (is_last && !(i + 1 < indices.len() && continues(i + 1))).then_some(None);
        corner.into_iter().chain(end)
    })
}
