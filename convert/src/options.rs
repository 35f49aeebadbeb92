//! What the caller can choose: plain data.

use std::sync::Arc;

/// The form of the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Container {
    /// One binary file, `.glb`.
    Glb,
    /// JSON text, `.gltf`, with its numbers in `.bin` files.
    GltfBin,
}

/// Options of a conversion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// The form of the output.
    pub container: Container,
    /// Whether Inventor's own values, which glTF has no place for, go into `extras.iv`.
    pub extras: bool,
    /// Largest length of a `.glb`; its header has 32 bits for it.
    pub max_glb_bytes: u64,
    /// Largest length of one `.bin`; what is more goes into further ones. Web loaders and 32-bit
    /// readers fail beyond 32 bits.
    pub max_bin_bytes: u64,
    /// JSON that goes into `extras.iv.source` of the scene as it is; see
    /// [`write_file_with_source`](crate::write_file_with_source).
    pub source: Option<Arc<str>>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            container: Container::Glb,
            extras: true,
            max_glb_bytes: u64::from(u32::MAX),
            max_bin_bytes: u64::from(u32::MAX),
            source: None,
        }
    }
}
