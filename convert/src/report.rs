//! What a conversion did besides its output.

use iv_parser::SourcePos;

use crate::Loss;

/// Sizes of an output.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// glTF nodes.
    pub nodes: usize,
    /// glTF meshes.
    pub meshes: usize,
    /// glTF materials.
    pub materials: usize,
    /// Images stored.
    pub images: usize,
    /// glTF lights.
    pub lights: usize,
    /// glTF cameras.
    pub cameras: usize,
    /// Triangles stored, each mesh counted once.
    pub triangles: u64,
    /// Triangles drawn, each instance counted.
    pub triangles_drawn: u64,
    /// Bytes written, all files together.
    pub bytes: u64,
}

/// An image that is not in the output; its material was written without it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// The image's name as written in the source, or `inline image`.
    pub name: String,
    /// Why it is not there.
    pub reason: String,
    /// The texture that asked for it first.
    pub pos: SourcePos,
}

/// What a conversion did besides its output.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// What glTF could not carry; at most one entry of each kind.
    pub losses: Vec<Loss>,
    /// Images that could not be used; at most one entry for each file.
    pub warnings: Vec<Warning>,
    /// Sizes.
    pub counts: Counts,
}
