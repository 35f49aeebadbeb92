//! Primitives as meshes: each combination of arrays becomes one mesh, however often it is used.

use glam::DVec3;
use gltf::json::Index;
use gltf::json::accessor::Accessor as JsonAccessor;
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked;
use iv_parser::SourcePos;
use rustc_hash::FxHashMap;
use scenegraph::scene::{Mesh, MeshId, Topology};

use super::accessor::Accessor;
use super::budget::Budget;
use super::buffers::Buffers;
use super::document::Document;
use super::error::ReadError;
use super::normals::{flat, unit_normal};
use super::topology::{growth, list, topology};
use crate::color::srgb_from_linear;

/// What a material wants of the arrays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wants {
    /// Triangles without normals get flat ones.
    pub(crate) lit: bool,
    /// The set of texture coordinates, and their transform.
    pub(crate) texcoords: Option<(u32, UvTransform)>,
    /// Multiplies the vertices' colours.
    pub(crate) base_color_linear: [f32; 4],
    /// Alpha counts for 1.
    pub(crate) opaque: bool,
}

/// `KHR_texture_transform`: rows of a 2 x 3 matrix on glTF's coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct UvTransform(pub(crate) [[f32; 3]; 2]);

impl UvTransform {
    pub(crate) const IDENTITY: Self = Self([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);

    fn apply(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        if *self == Self::IDENTITY {
            return [u, v];
        }
        self.0.map(|[a, b, c]| a * u + b * v + c)
    }

    fn bits(&self) -> [u32; 6] {
        let [a, b] = self.0.map(|row| row.map(f32::to_bits));
        [a[0], a[1], a[2], b[0], b[1], b[2]]
    }
}

/// All that a mesh depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Key {
    mode: u32,
    lit: bool,
    indices: Option<usize>,
    positions: usize,
    normals: Option<usize>,
    texcoords: Option<(usize, [u32; 6])>,
    colors: Option<(usize, [u32; 4], bool)>,
}

/// The meshes of a file.
pub(crate) struct Meshes<'a> {
    document: &'a Document<'a>,
    buffers: &'a Buffers<'a>,
    known: FxHashMap<Key, Option<MeshId>>,
    pub(crate) meshes: Vec<Mesh>,
}

type Attribute = Option<Index<JsonAccessor>>;

impl<'a> Meshes<'a> {
    pub(crate) fn new(document: &'a Document<'a>, buffers: &'a Buffers<'a>) -> Self {
        Self {
            document,
            buffers,
            known: FxHashMap::default(),
            meshes: Vec::new(),
        }
    }

    /// The mesh of a primitive; `None` when it shows nothing.
    pub(crate) fn primitive(
        &mut self,
        primitive: &Primitive,
        wants: &Wants,
        budget: &mut Budget,
    ) -> Result<Option<MeshId>, ReadError> {
        let attribute = |semantic| -> Attribute {
            let found = primitive.attributes.get(&Checked::Valid(semantic));
            found.copied()
        };
        // An unknown mode draws nothing that could be known.
        let (Checked::Valid(mode), Some(positions)) =
            (primitive.mode, attribute(Semantic::Positions))
        else {
            return Ok(None);
        };
        let normals = attribute(Semantic::Normals).filter(|_| wants.lit);
        let colors = attribute(Semantic::Colors(0));
        let texcoords = wants.texcoords.and_then(|(set, transform)| {
            let array = attribute(Semantic::TexCoords(set))?;
            Some((array, transform))
        });
        let key = Key {
            mode: mode.as_gl_enum(),
            lit: wants.lit,
            indices: primitive.indices.map(|i| i.value()),
            positions: positions.value(),
            normals: normals.map(|i| i.value()),
            texcoords: texcoords.map(|(array, transform)| (array.value(), transform.bits())),
            colors: colors.map(|array| {
                let factor = wants.base_color_linear.map(f32::to_bits);
                (array.value(), factor, wants.opaque)
            }),
        };
        if let Some(&known) = self.known.get(&key) {
            return Ok(known);
        }
        let mesh = self.build(mode, primitive.indices, positions, budget)?;
        let id = match mesh {
            None => None,
            Some((mut mesh, vertices)) => {
                let mut gather = Gather {
                    document: self.document,
                    buffers: self.buffers,
                    vertices: &vertices,
                    budget,
                };
                mesh.normals = gather.normals(normals)?;
                mesh.texcoords = gather.texcoords(texcoords)?;
                mesh.colors_srgb = gather.colors(colors, wants)?;
                if wants.lit && mesh.normals.is_empty() && mesh.topology == Topology::Triangles {
                    // A vertex with all attributes for each corner.
                    budget.take(48 * mesh.indices.len() as u64)?;
                    mesh = flat(&mesh);
                }
                let id = MeshId(self.meshes.len() as u32);
                self.meshes.push(mesh);
                Some(id)
            }
        };
        self.known.insert(key, id);
        Ok(id)
    }

    /// Positions and indices, and which elements of the arrays its vertices are.
    fn build(
        &self,
        mode: Mode,
        indices: Attribute,
        positions: Index<JsonAccessor>,
        budget: &mut Budget,
    ) -> Result<Option<(Mesh, Vec<u32>)>, ReadError> {
        let accessor = self.open(positions, &[3], budget)?;
        let count = accessor.count();
        let indices = match indices {
            Some(indices) => self.indices(indices, mode, count, budget)?,
            None => {
                budget.take(4 * count as u64 * growth(mode))?;
                (0..count as u32).collect()
            }
        };
        let few = indices.len() < count;
        let mut indices = list(mode, indices);
        if indices.is_empty() {
            return Ok(None);
        }
        let vertices = if few {
            budget.take(4 * indices.len() as u64)?;
            compact(&mut indices)
        } else {
            budget.take(4 * count as u64)?;
            (0..count as u32).collect()
        };
        budget.take(12 * vertices.len() as u64)?;
        let p: Vec<[f32; 3]> = vertices
            .iter()
            .map(|&v| accessor.floats(v as usize))
            .collect();
        finite(p.as_flattened(), positions)?;
        let mesh = Mesh {
            topology: topology(mode),
            origin: DVec3::ZERO,
            positions: p,
            normals: Vec::new(),
            texcoords: Vec::new(),
            colors_srgb: Vec::new(),
            indices,
            pos: SourcePos::default(),
        };
        Ok(Some((mesh, vertices)))
    }

    fn indices(
        &self,
        index: Index<JsonAccessor>,
        mode: Mode,
        vertices: usize,
        budget: &mut Budget,
    ) -> Result<Vec<u32>, ReadError> {
        let accessor = self.open(index, &[1], budget)?;
        let broken = |reason| ReadError::broken("accessor", index.value(), reason);
        if !accessor.is_unsigned() {
            return Err(broken("indices are unsigned integers"));
        }
        budget.take(4 * accessor.count() as u64 * growth(mode))?;
        let indices: Vec<u32> = (0..accessor.count())
            .map(|i| accessor.unsigned(i))
            .collect();
        if indices.iter().any(|&v| v as usize >= vertices) {
            return Err(broken("an index is not below the number of vertices"));
        }
        Ok(indices)
    }

    fn open(
        &self,
        index: Index<JsonAccessor>,
        widths: &[usize],
        budget: &mut Budget,
    ) -> Result<Accessor<'a>, ReadError> {
        Accessor::open(self.document, self.buffers, index, widths, budget)
    }
}

/// Renumbers indices into many vertices of which few are used; gives those, ascending.
fn compact(indices: &mut [u32]) -> Vec<u32> {
    let mut used = indices.to_vec();
    used.sort_unstable();
    used.dedup();
    for index in indices {
        // Every index is in the list.
        *index = used.binary_search(index).unwrap_or_default() as u32;
    }
    used
}

fn finite(values: &[f32], index: Index<JsonAccessor>) -> Result<(), ReadError> {
    if values.iter().all(|v| v.is_finite()) {
        return Ok(());
    }
    let reason = "a number is not finite";
    Err(ReadError::broken("accessor", index.value(), reason))
}

/// Attributes of the vertices that a mesh uses.
struct Gather<'a, 'g> {
    document: &'a Document<'a>,
    buffers: &'a Buffers<'a>,
    vertices: &'g [u32],
    budget: &'g mut Budget,
}

impl<'a> Gather<'a, '_> {
    /// Opens an array and takes the bytes for its elements.
    fn open(
        &mut self,
        index: Index<JsonAccessor>,
        widths: &[usize],
        bytes: u64,
    ) -> Result<Accessor<'a>, ReadError> {
        let accessor = Accessor::open(self.document, self.buffers, index, widths, self.budget)?;
        let needed = self.vertices.iter().max().map_or(0, |&v| v as usize + 1);
        if accessor.count() < needed {
            let reason = "it has fewer elements than there are positions";
            return Err(ReadError::broken("accessor", index.value(), reason));
        }
        self.budget.take(bytes * self.vertices.len() as u64)?;
        Ok(accessor)
    }

    fn collect<T>(&self, make: impl FnMut(usize) -> T) -> Vec<T> {
        self.vertices
            .iter()
            .map(|&v| v as usize)
            .map(make)
            .collect()
    }

    fn normals(&mut self, index: Attribute) -> Result<Vec<[f32; 3]>, ReadError> {
        let Some(index) = index else {
            return Ok(Vec::new());
        };
        let accessor = self.open(index, &[3], 12)?;
        Ok(self.collect(|v| unit_normal(accessor.floats(v))))
    }

    /// Inventor's T goes up from the image's lower edge, glTF's down from the upper.
    fn texcoords(
        &mut self,
        array: Option<(Index<JsonAccessor>, UvTransform)>,
    ) -> Result<Vec<[f32; 2]>, ReadError> {
        let Some((index, transform)) = array else {
            return Ok(Vec::new());
        };
        let accessor = self.open(index, &[2], 8)?;
        let texcoords = self.collect(|v| {
            let [s, t] = transform.apply(accessor.floats(v));
            [s, 1.0 - t]
        });
        finite(texcoords.as_flattened(), index)?;
        Ok(texcoords)
    }

    fn colors(&mut self, index: Attribute, wants: &Wants) -> Result<Vec<[f32; 4]>, ReadError> {
        let Some(index) = index else {
            return Ok(Vec::new());
        };
        let accessor = self.open(index, &[3, 4], 16)?.into_normalized();
        let mut last = ([f32::NAN; 4], [0.0; 4]);
        let colors = self.collect(|v| {
            let color = accessor.floats::<4>(v);
            // Neighbouring vertices mostly share their colour, and the transfer function is slow.
            if color != last.0 {
                last = (color, diffuse_srgb(color, wants));
            }
            last.1
        });
        finite(colors.as_flattened(), index)?;
        Ok(colors)
    }
}

fn diffuse_srgb(color_linear: [f32; 4], wants: &Wants) -> [f32; 4] {
    let [fr, fg, fb, fa] = wants.base_color_linear;
    let [r, g, b, a] = color_linear;
    let [r, g, b] = [r * fr, g * fg, b * fb].map(|v| srgb_from_linear(f64::from(v)) as f32);
    let alpha = if wants.opaque {
        1.0
    } else {
        crate::color::unit(f64::from(a * fa)) as f32
    };
    [r, g, b, alpha]
}
