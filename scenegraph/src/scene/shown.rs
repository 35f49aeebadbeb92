//! What a model has besides what it shows: parts that a Switch hides, coarser levels of detail,
//! other materials. A scene has them only if it was asked for; see
//! [`ResolveOptions::alternatives`](crate::ResolveOptions::alternatives).

use std::sync::Arc;

use super::{MaterialId, Node, NodeId, Scene};

/// When a group is shown; all in it follows it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Shown {
    /// Whenever the group around it is.
    #[default]
    Always,
    /// Not as the model stands: a Switch shows another part, or none.
    Hidden,
    /// In place of what its parent always shows, and of the levels before it.
    Level(Coarser),
}

/// When a coarser level of detail takes the place of the finer ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coarser {
    /// Farther than this from the viewer, in units of the world.
    Beyond(f64),
    /// When the part's box covers less than this, in square pixels of the window.
    Below(f64),
    /// The source gives no limit: never by itself.
    Never,
}

/// Another look of the model: one state of a Switch that sets the materials of what follows it.
#[derive(Clone, Debug, PartialEq)]
pub struct Variant {
    /// What it is called; no two of a scene have one name.
    pub name: Arc<str>,
    /// Instances, ascending, that have another material in it than their own.
    pub materials: Vec<(u32, MaterialId)>,
}

impl Scene {
    /// For each node whether the scene as it stands does not show it: it is hidden or a coarser
    /// level, or below one.
    pub fn nodes_not_shown(&self) -> Vec<bool> {
        let mut not_shown: Vec<bool> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let inherited = node.parent.is_some_and(|p| not_shown[p.index()]);
            not_shown.push(inherited || node.shown != Shown::Always);
        }
        not_shown
    }

    /// Whether all there is is shown.
    pub fn shows_all(&self) -> bool {
        self.nodes.iter().all(|node| node.shown == Shown::Always)
    }
}

impl Node {
    /// The limit behind which a coarser level begins, if it is one.
    pub fn level(&self) -> Option<Coarser> {
        match self.shown {
            Shown::Level(coarser) => Some(coarser),
            Shown::Always | Shown::Hidden => None,
        }
    }
}

/// Whether a place in the hierarchy is below one of `not_shown`.
pub fn is_below(node: Option<NodeId>, not_shown: &[bool]) -> bool {
    node.is_some_and(|node| not_shown.get(node.index()).copied().unwrap_or(false))
}
