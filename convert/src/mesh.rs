//! What must be known of a mesh before its numbers are written.

use scenegraph::scene::{Material, MaterialId, Mesh, MeshId, Topology};

use crate::alternatives;
use crate::color::u16_from_unit;
use crate::json::Json;
use crate::layout::MeshAccessors;
use crate::material::{GltfMaterial, VertexColors};

/// How the indices are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum IndexWidth {
    /// Not at all: they count up from 0, which is what glTF takes without indices.
    None,
    U16,
    U32,
}

/// Facts from one pass over a mesh.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facts {
    /// Exact extremes of the positions as stored.
    pub(crate) min: [f32; 3],
    pub(crate) max: [f32; 3],
    pub(crate) colors: VertexColors,
    pub(crate) index_width: IndexWidth,
}

impl Facts {
    pub(crate) fn of(mesh: &Mesh) -> Self {
        let mut min = [f32::INFINITY; 3];
        let mut max = [f32::NEG_INFINITY; 3];
        for position in &mesh.positions {
            // Positions are finite: comparisons do without what `f32::min` does for NaN.
            for axis in 0..3 {
                let x = position[axis];
                min[axis] = if x < min[axis] { x } else { min[axis] };
                max[axis] = if x > max[axis] { x } else { max[axis] };
            }
        }
        let opaque = |color: &[f32; 4]| u16_from_unit(f64::from(color[3])) == u16::MAX;
        let colors = match mesh.colors_srgb.as_slice() {
            [] => VertexColors::None,
            colors if colors.iter().all(opaque) => VertexColors::Opaque,
            _ => VertexColors::Translucent,
        };
        Self {
            min,
            max,
            colors,
            index_width: index_width(mesh),
        }
    }
}

/// The index 65535 means "restart" on graphics devices, so 16 bits do for 65535 vertices.
fn index_width(mesh: &Mesh) -> IndexWidth {
    let vertices = mesh.positions.len();
    let counts_up = || {
        mesh.indices
            .iter()
            .enumerate()
            .all(|(i, &v)| v as usize == i)
    };
    if vertices == mesh.indices.len() && counts_up() {
        IndexWidth::None
    } else if vertices <= usize::from(u16::MAX) {
        IndexWidth::U16
    } else {
        IndexWidth::U32
    }
}

/// Which attributes some material reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Attributes {
    pub(crate) normals: bool,
    pub(crate) texcoords: bool,
    pub(crate) colors: bool,
}

impl Attributes {
    pub(crate) fn read_by(material: &GltfMaterial, mesh: &Mesh) -> Self {
        Self {
            normals: !material.unlit && !mesh.normals.is_empty(),
            texcoords: material.texture.is_some(),
            colors: material.reads_colors,
        }
    }

    pub(crate) fn union(self, other: Self) -> Self {
        Self {
            normals: self.normals || other.normals,
            texcoords: self.texcoords || other.texcoords,
            colors: self.colors || other.colors,
        }
    }
}

/// Geometry with a material: in glTF the material belongs to the mesh.
#[derive(Clone, Debug)]
pub(crate) struct GltfMesh {
    pub(crate) source: MeshId,
    pub(crate) material: u32,
    pub(crate) attributes: Attributes,
    /// In each variant; none if all are alike.
    pub(crate) in_variants: Vec<u32>,
}

impl GltfMesh {
    pub(crate) fn write(&self, json: &mut Json, topology: Topology, at: &MeshAccessors) {
        let primitive = |json: &mut Json| {
            json.key("attributes").object(|json| {
                json.key("POSITION").u64(at.positions.into());
                for (name, read, accessor) in [
                    ("NORMAL", self.attributes.normals, at.normals),
                    ("TEXCOORD_0", self.attributes.texcoords, at.texcoords),
                    ("COLOR_0", self.attributes.colors, at.colors),
                ] {
                    if let (true, Some(accessor)) = (read, accessor) {
                        json.key(name).u64(accessor.into());
                    }
                }
            });
            if let Some(indices) = at.indices {
                json.key("indices").u64(indices.into());
            }
            json.key("material").u64(self.material.into());
            match topology {
                Topology::Points => json.key("mode").u64(0),
                Topology::Lines => json.key("mode").u64(1),
                // 4, the default.
                Topology::Triangles => {}
            }
            if !self.in_variants.is_empty() {
                alternatives::write_mappings(json, &self.in_variants);
            }
        };
        json.object(|json| {
            json.key("primitives").array(|json| json.object(primitive));
        });
    }
}

/// Whether light changes the look of this mesh in this material.
pub(crate) fn can_be_lit(mesh: &Mesh) -> bool {
    mesh.topology == Topology::Triangles || !mesh.normals.is_empty()
}

/// Key of a [`GltfMesh`]: what it is made of, and the materials in other variants.
pub(crate) type MeshUse = (MeshId, MaterialId, Vec<(u32, MaterialId)>);

/// Whether a texture can show.
pub(crate) fn shows_texture(mesh: &Mesh, material: &Material) -> bool {
    material.texture.is_some() && !mesh.texcoords.is_empty()
}
