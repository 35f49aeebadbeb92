//! The words behind letters, for readers who want them and not their shapes.

use std::sync::Arc;

/// What an instance spells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Text {
    /// Index into [`Scene::instances`](super::Scene::instances).
    pub instance: u32,
    /// Line by line.
    pub strings: Vec<Arc<str>>,
    /// In the source it faces the viewer and has a size in pixels (`Text2`); its size and
    /// direction here are those of one view.
    pub faces_viewer: bool,
}
