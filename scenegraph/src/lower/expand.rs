//! Instances of VRML 2 prototypes: a copy of the body for each, with its own values.
//!
//! Only nodes are copied that an instance can have otherwise than another one: those with an `IS`
//! and all around them. The rest is shared by all instances, as if by `USE`.
//!
//! A definition stands before its instances, and files that name each other in a circle are
//! refused, so no prototype comes to hold itself. Prototypes that hold each other twice, level by
//! level, could still become any number of nodes: what all copies together hold is limited.

use std::collections::VecDeque;
use std::rc::Rc;
use std::sync::Arc;

use iv_parser::{Diagnostic, Severity};
use rustc_hash::{FxHashMap, FxHashSet};

use super::Builder;
use super::connect::Link;
use super::include::{Failure, file_part};
use super::node::settle;
use super::proto::{Instance, follow_links};
use crate::graph::{FieldValue, Kind, Node, NodeId};
use crate::registry::Class;

/// Most nodes, fields and names that all copies together may hold.
const MAX_COPIED: usize = 2_000_000;

/// Looking at so many nodes counts as one copied.
const SCANNED_SHARE: usize = 10;

/// Longest way from an EXTERNPROTO over others to a definition.
const MAX_HOPS: usize = 16;

/// The state of expanding.
#[derive(Debug, Default)]
pub(super) struct Expansion {
    /// How much has been copied.
    copied: usize,
    reported: bool,
    /// Where each EXTERNPROTO leads.
    found: FxHashMap<usize, Option<usize>>,
    /// For each prototype the nodes that its instances do not share.
    own: FxHashMap<usize, Rc<FxHashSet<NodeId>>>,
}

/// The nodes of one copy.
struct Copy {
    /// Nodes of the template that each copy has for itself.
    own: Rc<FxHashSet<NodeId>>,
    /// For each node of the template its copy.
    places: FxHashMap<NodeId, NodeId>,
    /// Still to be copied.
    open: VecDeque<NodeId>,
}

impl Copy {
    /// Where the copy of a node stands, or the node itself if it is shared.
    fn place(&mut self, node: NodeId, nodes: &mut Vec<Node>) -> NodeId {
        if let Some(&known) = self.places.get(&node) {
            return known;
        }
        if !self.own.contains(&node) {
            return node;
        }
        let made = NodeId(nodes.len() as u32);
        nodes.push(Node {
            kind: Kind::Known(Class::Group),
            name: None,
            fields: Vec::new(),
            children: Vec::new(),
            pos: nodes[node.0 as usize].pos,
        });
        self.places.insert(node, made);
        self.open.push_back(node);
        made
    }

    fn place_all(&mut self, value: &mut FieldValue, nodes: &mut Vec<Node>) {
        if let FieldValue::Nodes(list) = value {
            for node in list {
                *node = self.place(*node, nodes);
            }
        }
    }
}

impl Expansion {
    /// For each prototype that has instances the nodes that those do not share.
    pub fn own_sets(&self) -> impl Iterator<Item = &FxHashSet<NodeId>> {
        self.own.values().map(|own| &**own)
    }
}

impl Builder<'_> {
    /// Follows all includes and expands all instances, those that come in with them too.
    pub(super) fn complete(&mut self) {
        loop {
            self.load_includes();
            match self.protos.pending.pop_front() {
                Some(instance) => self.expand(&instance),
                None => return,
            }
        }
    }

    fn expand(&mut self, instance: &Instance) {
        if self.has_copied_too_much(instance) {
            return;
        }
        let Some(index) = self.definition(instance) else {
            return;
        };
        let proto = &self.protos.list[index];
        let given = &self.protos.list[instance.proto];
        let defaults = proto.slots.iter().filter_map(|s| s.default.as_ref());
        self.expansion.copied += defaults.map(cost).sum::<usize>();
        let mut values: Vec<Option<FieldValue>> =
            proto.slots.iter().map(|s| s.default.clone()).collect();
        let mut is_given = vec![false; values.len()];
        for (slot, value) in &instance.values {
            let from = &given.slots[*slot as usize];
            // An EXTERNPROTO may list the fields in another order.
            let to = match index == instance.proto {
                true => Some(*slot as usize),
                false => (proto.slots.iter())
                    .position(|s| s.name == from.name && s.field_type == from.field_type),
            };
            if let Some(to) = to {
                values[to] = Some(value.clone());
                is_given[to] = true;
            }
        }
        self.expansion.copied += values.len();
        let Some(&root) = proto.body.first() else {
            let message = format!("PROTO {} has no node in its body", proto.name);
            self.say(
                Severity::Warning,
                "empty",
                message,
                "its instances are empty",
                instance,
            );
            return;
        };
        if !proto.inside.contains(&root.0) {
            self.nodes[instance.node.0 as usize].children = vec![root];
            return;
        }
        let mut copy = Copy {
            own: self.own_nodes(index),
            places: FxHashMap::default(),
            open: VecDeque::new(),
        };
        copy.places.insert(root, instance.node);
        copy.open.push_back(root);
        // What stands in the interface belongs to the prototype, as its body does.
        for (value, _) in values
            .iter_mut()
            .zip(&is_given)
            .filter(|(_, given)| !**given)
        {
            if let Some(value) = value {
                copy.place_all(value, &mut self.nodes);
            }
        }
        while let Some(template) = copy.open.pop_front() {
            if self.has_copied_too_much(instance) {
                return;
            }
            self.copy_node(template, &mut copy, &values);
        }
    }

    /// Whether all copies together are more than may be; says so once.
    fn has_copied_too_much(&mut self, instance: &Instance) -> bool {
        if self.expansion.copied <= MAX_COPIED {
            return false;
        }
        if !std::mem::replace(&mut self.expansion.reported, true) {
            let message = format!("prototypes expand to more than {MAX_COPIED} nodes and fields");
            let hint = "the rest was left out";
            self.say(Severity::Error, "too-many-copies", message, hint, instance);
        }
        true
    }

    /// The nodes of a template that depend on the instance: those with an `IS`, other instances
    /// and includes, and all that hold one of them.
    fn own_nodes(&mut self, index: usize) -> Rc<FxHashSet<NodeId>> {
        if let Some(known) = self.expansion.own.get(&index) {
            return Rc::clone(known);
        }
        let inside = self.protos.list[index].inside.clone();
        self.expansion.copied += inside.len() / SCANNED_SHARE;
        let mut holders: FxHashMap<NodeId, Vec<NodeId>> = FxHashMap::default();
        let mut open = Vec::new();
        for id in inside.map(NodeId) {
            let node = &self.nodes[id.0 as usize];
            let values = self.protos.templates.get(&id).map(|i| &i.values[..]);
            let values = values.unwrap_or_default().iter().map(|(_, value)| value);
            let values = values.chain(node.fields.iter().map(|f| &f.value));
            let held = values.flat_map(|value| match value {
                FieldValue::Nodes(nodes) => &nodes[..],
                _ => &[],
            });
            for &child in node.children.iter().chain(held) {
                holders.entry(child).or_default().push(id);
            }
            let includes = matches!(
                node.class(),
                Some(Class::VRMLInline | Class::File | Class::WWWInline)
            );
            for link in self.late.links_of(id) {
                holders.entry(link.master).or_default().push(id);
            }
            let inputs = self.late.inputs.get(&id).into_iter().flatten();
            let in_inputs = inputs.filter_map(|(_, value)| match value {
                FieldValue::Nodes(nodes) => Some(&nodes[..]),
                _ => None,
            });
            for &held in in_inputs.flatten() {
                holders.entry(held).or_default().push(id);
            }
            let is_linked =
                self.protos.links.contains_key(&id) || self.protos.input_links.contains_key(&id);
            if includes || is_linked || self.protos.templates.contains_key(&id) {
                open.push(id);
            }
        }
        let mut own = FxHashSet::default();
        while let Some(id) = open.pop() {
            if own.insert(id) {
                open.extend(holders.get(&id).into_iter().flatten());
            }
        }
        let own = Rc::new(own);
        self.expansion.own.insert(index, Rc::clone(&own));
        own
    }

    fn copy_node(&mut self, template: NodeId, copy: &mut Copy, values: &[Option<FieldValue>]) {
        let place = copy.place(template, &mut self.nodes);
        let mut node = self.nodes[template.0 as usize].clone();
        for child in &mut node.children {
            *child = copy.place(*child, &mut self.nodes);
        }
        for field in &mut node.fields {
            copy.place_all(&mut field.value, &mut self.nodes);
        }
        let value = |slot: u32| values.get(slot as usize).cloned().flatten();
        if let Some(links) = self.protos.links.get(&template) {
            follow_links(&mut node, links, value);
        }
        if let Some(inner) = self.protos.templates.get(&template) {
            let mut inner = inner.clone();
            for (_, value) in &mut inner.values {
                copy.place_all(value, &mut self.nodes);
            }
            for link in std::mem::take(&mut inner.links) {
                let given = value(link.slot).map(|v| (u32::from(link.field), v));
                inner.values.extend(given);
            }
            inner.node = place;
            self.expansion.copied += inner.values.iter().map(|(_, v)| cost(v)).sum::<usize>();
            self.protos.pending.push_back(inner);
        }
        settle(&mut node);
        self.copy_joints(template, copy, &value);
        self.expansion.copied += 1 + node.children.len();
        self.expansion.copied += node.fields.iter().map(|f| cost(&f.value)).sum::<usize>();
        // The name of an instance says more than that of what it is made of.
        let own = self.nodes[place.0 as usize].name.take();
        node.name = own.or(node.name);
        self.note_include(place, &node);
        self.nodes[place.0 as usize] = node;
    }

    /// Joins a copy as its template is joined.
    fn copy_joints(
        &mut self,
        template: NodeId,
        copy: &mut Copy,
        value: &impl Fn(u32) -> Option<FieldValue>,
    ) {
        let place = copy.place(template, &mut self.nodes);
        let links: Vec<Link> = self.late.links_of(template).cloned().collect();
        self.expansion.copied += links.len();
        for mut link in links {
            link.slave = place;
            link.master = copy.place(link.master, &mut self.nodes);
            self.late.add_link(link);
        }
        let mut inputs = self.late.inputs.get(&template).cloned().unwrap_or_default();
        for (_, input) in &mut inputs {
            copy.place_all(input, &mut self.nodes);
        }
        let linked = self.protos.input_links.get(&template).into_iter().flatten();
        inputs.extend(linked.filter_map(|(name, slot)| Some((name.clone(), value(*slot)?))));
        if !inputs.is_empty() {
            self.expansion.copied += inputs.iter().map(|(_, v)| cost(v)).sum::<usize>();
            self.late.inputs.insert(place, inputs);
        }
    }

    /// The definition of an instance: that of its prototype, or where the EXTERNPROTO leads.
    fn definition(&mut self, instance: &Instance) -> Option<usize> {
        let mut index = instance.proto;
        for _ in 0..MAX_HOPS {
            if self.protos.list[index].urls.is_none() {
                let found = &self.protos.list[index];
                let origin = &self.nodes[instance.origin.0 as usize];
                if found.file == origin.pos.file && found.inside.end > instance.origin.0 {
                    let message = format!("PROTO {} comes to hold itself", found.name);
                    let hint = "this instance was left out";
                    self.say(Severity::Error, "cycle", message, hint, instance);
                    return None;
                }
                return Some(index);
            }
            index = match self.expansion.found.get(&index) {
                Some(known) => (*known)?,
                None => {
                    let found = self.external(index, instance);
                    self.expansion.found.insert(index, found);
                    found?
                }
            };
        }
        None
    }

    /// Where an EXTERNPROTO leads: the first of its URLs that can be read.
    fn external(&mut self, index: usize, instance: &Instance) -> Option<usize> {
        let proto = &self.protos.list[index];
        let from = proto.file;
        let urls = proto.urls.clone().unwrap_or_default();
        let mut first_failure = None;
        for url in &urls {
            let name = url.split_once('#').map(|(_, name)| name);
            let found = self.library(file_part(url), from).and_then(|file| {
                self.protos.find(file, name, index).ok_or_else(|| Failure {
                    message: "it has no PROTO of that name".to_owned(),
                    hint: "",
                })
            });
            match found {
                Ok(found) => return Some(found),
                Err(why) => {
                    first_failure.get_or_insert((url, why));
                }
            }
        }
        let pos = self.nodes[instance.origin.0 as usize].pos;
        match first_failure {
            Some((url, why)) => self.report_missing(Severity::Error, url, &why, from, pos),
            None => self.say(
                Severity::Error,
                "include",
                "an EXTERNPROTO says no file".to_owned(),
                "its instances are empty",
                instance,
            ),
        }
        None
    }

    fn say(
        &mut self,
        severity: Severity,
        code: &'static str,
        message: String,
        hint: &str,
        instance: &Instance,
    ) {
        let pos = self.nodes[instance.origin.0 as usize].pos;
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

/// What a copy of a value costs; numbers are shared.
fn cost(value: &FieldValue) -> usize {
    1 + match value {
        FieldValue::Texts(texts) => texts.len(),
        FieldValue::Nodes(nodes) => nodes.len(),
        _ => 0,
    }
}
