//! DEF and USE, and the names of prototypes, within one file.
//!
//! A name is known from its DEF on, inside the node's own body too (where using it would be a
//! cycle); the latest DEF before a USE wins; included files have names of their own. What is named
//! inside a PROTO is not known outside of it.

use std::sync::Arc;

use iv_parser::{Form, NodeId, Span, Tree, text_of};
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

/// The innermost PROTO around a place.
pub type Scope = Option<NodeId>;

/// Most PROTOs around each other in which a name is looked for.
const MAX_SCOPES: usize = 64;

/// For each scope and name the definitions in order of place.
type Definitions<'t> = FxHashMap<(Scope, &'t [u8]), Vec<NodeId>>;

/// All definitions of a file.
pub struct Names<'t> {
    nodes: Definitions<'t>,
    protos: Definitions<'t>,
    /// For each node its scope; empty without prototypes.
    scopes: Vec<Scope>,
}

impl<'t> Names<'t> {
    /// Collects the definitions of a tree.
    pub fn of(tree: &'t Tree<'_>) -> Self {
        let mut names = Self {
            nodes: FxHashMap::default(),
            protos: FxHashMap::default(),
            scopes: scopes(tree),
        };
        for i in 0..tree.node_count() as u32 {
            let id = NodeId(i);
            let node = tree.node(id);
            let Some(name) = node.def else { continue };
            let key = (names.scope(id), name);
            let definitions = match node.form {
                Form::Node => &mut names.nodes,
                _ => &mut names.protos,
            };
            definitions.entry(key).or_default().push(id);
        }
        names
    }

    /// The PROTO that a node stands in.
    pub fn scope(&self, id: NodeId) -> Scope {
        self.scopes.get(id.0 as usize).copied().flatten()
    }

    /// What `USE name`, written at `span` inside `scope`, means.
    pub fn find(&self, tree: &Tree<'_>, name: &[u8], span: Span, scope: Scope) -> Reference {
        match self.look_up(&self.nodes, tree, name, span, scope) {
            Reference::Unknown => {
                // SGI's writers put a point into names that only the part before it defines.
                let before_point = name.split(|&b| b == b'.').next().unwrap_or(name);
                self.look_up(&self.nodes, tree, before_point, span, scope)
            }
            found => found,
        }
    }

    /// The prototype that a class name, written at `span` inside `scope`, means.
    pub fn find_proto(&self, tree: &Tree<'_>, name: &[u8], span: Span, scope: Scope) -> Reference {
        self.look_up(&self.protos, tree, name, span, scope)
    }

    fn look_up(
        &self,
        definitions: &Definitions<'_>,
        tree: &Tree<'_>,
        name: &[u8],
        span: Span,
        mut scope: Scope,
    ) -> Reference {
        let mut found = Reference::Unknown;
        for _ in 0..MAX_SCOPES {
            if let Some(list) = definitions.get(&(scope, name)) {
                let before = list.partition_point(|id| tree.node(*id).span.start < span.start);
                match before.checked_sub(1).map(|i| list[i]) {
                    None => found = Reference::Later,
                    Some(id) if tree.node(id).span.end > span.start => return Reference::Cycle,
                    Some(id) => return Reference::Node(id),
                }
            }
            match scope {
                Some(proto) => scope = self.scope(proto),
                None => break,
            }
        }
        found
    }
}

/// The innermost PROTO around each node; nodes stand in order of their beginnings.
fn scopes(tree: &Tree<'_>) -> Vec<Scope> {
    let count = tree.node_count() as u32;
    if !(0..count).any(|i| tree.node(NodeId(i)).form == Form::Proto) {
        return Vec::new();
    }
    let mut open: Vec<NodeId> = Vec::new();
    let mut scopes = Vec::with_capacity(count as usize);
    for i in 0..count {
        let node = tree.node(NodeId(i));
        while open
            .last()
            .is_some_and(|&id| tree.node(id).span.end <= node.span.start)
        {
            open.pop();
        }
        scopes.push(open.last().copied());
        if node.form == Form::Proto {
            open.push(NodeId(i));
        }
    }
    scopes
}

/// The name a node carries: the part before the `+N` suffix that writers add to tell instances
/// apart. `+3` alone is no name.
pub fn display_name(def: &[u8]) -> Option<Arc<str>> {
    let name = def.split(|&b| b == b'+').next().unwrap_or(def);
    (!name.is_empty()).then(|| text_of(name).into())
}
