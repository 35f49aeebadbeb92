//! What can be settled only when all nodes of all files are in the graph and prototypes are
//! expanded: parts of kits, connections, surfaces that are made of curves. A copy of a node is
//! joined to copies as the node is joined to nodes.

use rustc_hash::{FxHashMap, FxHashSet};
use std::sync::Arc;

use iv_parser::{Diagnostic, Severity};

use super::connect::{Inputs, Link};
use super::kits::Compound;
use super::{Builder, connect, kits, swept};
use crate::graph::NodeId;
use crate::registry::{Class, Family};

/// What waits.
#[derive(Default)]
pub(super) struct Late {
    /// Only files of Inventor can name them, which have no prototypes.
    pub compounds: Vec<Compound>,
    pub links: Vec<Link>,
    links_of: FxHashMap<NodeId, Vec<usize>>,
    pub inputs: Inputs,
    /// There are kits, or nodes that become surfaces.
    pub has_kits: bool,
}

impl Late {
    pub fn add_link(&mut self, link: Link) {
        let list = self.links_of.entry(link.slave).or_default();
        list.push(self.links.len());
        self.links.push(link);
    }

    pub fn links_of(&self, slave: NodeId) -> impl Iterator<Item = &Link> {
        let list = self.links_of.get(&slave).into_iter().flatten();
        list.map(|&i| &self.links[i])
    }
}

impl Builder<'_> {
    /// Settles all that waits.
    pub(super) fn settle_late(&mut self) {
        let mut late = std::mem::take(&mut self.late);
        if !late.has_kits && late.links.is_empty() {
            return;
        }
        // Of these nodes only the copies are in use.
        let templates = self.templates();
        late.links.retain(|l| !templates.contains(&l.slave));
        kits::place_all(self, std::mem::take(&mut late.compounds));
        self.give_children(late.has_kits);
        let slaves: Vec<NodeId> = late.links.iter().map(|link| link.slave).collect();
        connect::settle(self, late.links, late.inputs);
        for slave in slaves {
            self.give_children_to(slave);
        }
        self.make_surfaces(late.has_kits, &templates);
    }

    fn templates(&self) -> FxHashSet<NodeId> {
        let mut all = FxHashSet::default();
        for own in self.expansion.own_sets() {
            all.extend(own.iter().copied());
        }
        all
    }

    fn give_children(&mut self, has_kits: bool) {
        let count = if has_kits { self.nodes.len() } else { 0 };
        for i in 0..count {
            self.give_children_to(NodeId(i as u32));
        }
    }

    fn give_children_to(&mut self, id: NodeId) {
        let class = self.nodes[id.0 as usize].class();
        if class.is_some_and(|c| c.spec().family == Family::Kit) {
            let children = kits::children(self, id);
            self.nodes[id.0 as usize].children = children;
        }
    }

    fn make_surfaces(&mut self, has_kits: bool, templates: &FxHashSet<NodeId>) {
        let count = if has_kits { self.nodes.len() } else { 0 };
        for i in 0..count {
            let id = NodeId(i as u32);
            if self.nodes[i].class() == Some(Class::GeneralizedCylinder) && !templates.contains(&id)
            {
                swept::expand(self, id);
            }
        }
    }

    /// A problem of a node. Its text is gone, so there is no snippet.
    pub(super) fn late_problem(
        &mut self,
        severity: Severity,
        code: &'static str,
        message: String,
        hint: &str,
        node: NodeId,
    ) {
        let pos = self.nodes[node.0 as usize].pos;
        self.diagnostics.push(Diagnostic {
            severity,
            code,
            message,
            hint: hint.to_owned(),
            file: Arc::clone(&self.files[pos.file as usize].name),
            pos,
            snippet: None,
        });
    }
}
