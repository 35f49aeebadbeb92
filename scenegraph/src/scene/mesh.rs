//! Shared geometry: vertices with all bindings resolved, and the indices that join them.

use glam::DVec3;
use iv_parser::SourcePos;

/// How the indices of a mesh are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Topology {
    /// Three indices a triangle.
    Triangles,
    /// Two indices a segment.
    Lines,
    /// One index a point.
    Points,
}

/// Vertices and indices of one shape.
///
/// Positions are relative to `origin`, so that f32 holds millimetres at any distance from the
/// world's origin: `p_in_local = origin + position`.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// What `indices` join.
    pub topology: Topology,
    /// Added, in f64, to every position.
    pub origin: DVec3,
    /// Relative to `origin`; at least one.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals in the local frame; empty for what is not lit: `LightModel` BASE_COLOR, and
    /// lines and points without normals of their own.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates as Inventor has them (T upwards), texture transform applied; may be empty.
    pub texcoords: Vec<[f32; 2]>,
    /// Display-referred (sRGB) diffuse colour, and alpha = 1 - transparency; may be empty. Where
    /// present they stand in place of the material's diffuse colour and transparency.
    pub colors_srgb: Vec<[f32; 4]>,
    /// Two, three or one for each primitive, by `topology`.
    pub indices: Vec<u32>,
    /// The shape that made it.
    pub pos: SourcePos,
}

impl Mesh {
    /// Number of triangles, segments or points.
    pub fn primitive_count(&self) -> usize {
        match self.topology {
            Topology::Triangles => self.indices.len() / 3,
            Topology::Lines => self.indices.len() / 2,
            Topology::Points => self.indices.len(),
        }
    }

    /// Position of vertex `i` in the local frame, in f64.
    pub fn p_in_local(&self, i: u32) -> DVec3 {
        let [x, y, z] = self.positions[i as usize];
        self.origin + DVec3::new(f64::from(x), f64::from(y), f64::from(z))
    }
}
