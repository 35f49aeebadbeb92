//! DEF and USE within one file.
//!
//! A name is known from its DEF on, inside the node's own body too (where using it would be a
//! cycle); the latest DEF before a USE wins; included files have names of their own.

use std::sync::Arc;

use iv_parser::{NodeId, Span, Tree, text_of};
use rustc_hash::FxHashMap;

/// What a USE means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// This node.
    Node(NodeId),
    /// The node it stands in: a cycle.
    Cycle,
    /// Nothing yet; the name is defined only further down.
    Later,
    /// Nothing at all.
    Unknown,
}

/// All definitions of a file.
pub struct Names<'t> {
    /// For each name the definitions in order of place.
    definitions: FxHashMap<&'t [u8], Vec<NodeId>>,
}

impl<'t> Names<'t> {
    /// Collects the definitions of a tree.
    pub fn of(tree: &'t Tree<'_>) -> Self {
        let mut definitions: FxHashMap<&'t [u8], Vec<NodeId>> = FxHashMap::default();
        for i in 0..tree.node_count() as u32 {
            let id = NodeId(i);
            if let Some(name) = tree.node(id).def {
                definitions.entry(name).or_default().push(id);
            }
        }
        Self { definitions }
    }

    /// What `USE name`, written at `span`, means.
    pub fn find(&self, tree: &Tree<'_>, name: &[u8], span: Span) -> Reference {
        // SGI's writers put a point into names that only the part before it defines.
        let before_point = name.split(|&b| b == b'.').next().unwrap_or(name);
        let Some(list) = self
            .definitions
            .get(name)
            .or_else(|| self.definitions.get(before_point))
        else {
            return Reference::Unknown;
        };
        let before = list.partition_point(|id| tree.node(*id).span.start < span.start);
        match before.checked_sub(1).map(|i| list[i]) {
            None => Reference::Later,
            Some(id) if tree.node(id).span.end > span.start => Reference::Cycle,
            Some(id) => Reference::Node(id),
        }
    }
}

/// The name a node carries: the part before the `+N` suffix that writers add to tell instances
/// apart. `+3` alone is no name.
pub fn display_name(def: &[u8]) -> Option<Arc<str>> {
    let name = def.split(|&b| b == b'+').next().unwrap_or(def);
    (!name.is_empty()).then(|| text_of(name).into())
}
