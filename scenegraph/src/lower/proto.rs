//! VRML 2 prototypes: their definitions, and the nodes that are written in their names.
//!
//! The body of a prototype becomes nodes of the graph that nothing leads to: a template, of which
//! `expand` makes a copy for each instance.

use std::collections::VecDeque;
use std::ops::Range;
use std::sync::Arc;

use iv_parser::{Atom, FieldId, Form, Item, NodeId as TreeId, Severity, Value, text_of};
use rustc_hash::FxHashMap;

use super::File;
use super::names::Reference;
use super::value::Reader;
use crate::graph::{FieldEntry, FieldValue, Kind, Node, NodeId};
use crate::registry::{Class, FieldSpec, FieldType};

/// Most fields that a prototype may declare.
const MAX_SLOTS: usize = 1000;

/// One entry of an interface that holds a value.
#[derive(Clone, Debug)]
pub(super) struct Slot {
    pub name: Box<[u8]>,
    /// `None` for a type that nobody knows.
    pub field_type: Option<FieldType>,
    pub default: Option<FieldValue>,
}

/// A definition.
#[derive(Clone, Debug)]
pub(super) struct Proto {
    pub file: u32,
    pub name: Arc<str>,
    /// It stands in no other.
    pub is_top: bool,
    /// Its place in the graph, which orders definitions and instances of a file.
    pub node: NodeId,
    pub slots: Vec<Slot>,
    /// What stands in its body; the first is what an instance is.
    pub body: Vec<NodeId>,
    /// All nodes inside, interface included.
    pub inside: Range<u32>,
    /// Of an EXTERNPROTO: where its definition is.
    pub urls: Option<Vec<Arc<str>>>,
}

/// A field that takes its value from a slot of the prototype around it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub field: u16,
    pub slot: u32,
}

/// A node in the name of a prototype.
#[derive(Clone, Debug)]
pub(super) struct Instance {
    pub node: NodeId,
    /// Where it is written.
    pub origin: NodeId,
    /// Index of the prototype.
    pub proto: usize,
    /// Values by slot; the last one counts.
    pub values: Vec<(u32, FieldValue)>,
    /// Slots that take their values from those of the prototype around it.
    pub links: Vec<Link>,
}

/// All prototypes of a model.
#[derive(Debug, Default)]
pub(super) struct Protos {
    pub list: Vec<Proto>,
    by_node: FxHashMap<NodeId, usize>,
    /// Those that stand in no other, by file and name, the first one without a name.
    top: FxHashMap<(u32, Option<Arc<str>>), usize>,
    /// Of nodes in templates.
    pub links: FxHashMap<NodeId, Vec<Link>>,
    /// Of engines in templates: inputs that are in no class's list, and their slots.
    pub input_links: FxHashMap<NodeId, Vec<(Arc<str>, u32)>>,
    /// Instances in templates.
    pub templates: FxHashMap<NodeId, Instance>,
    /// Instances still to be expanded.
    pub pending: VecDeque<Instance>,
}

impl Protos {
    fn add(&mut self, proto: Proto) {
        let index = self.list.len();
        self.by_node.insert(proto.node, index);
        if proto.is_top {
            for name in [None, Some(Arc::clone(&proto.name))] {
                let known = self.top.entry((proto.file, name)).or_insert(index);
                // A definition says more than a reference to one.
                if *known < index && self.list[*known].urls.is_some() && proto.urls.is_none() {
                    *known = index;
                }
            }
        }
        self.list.push(proto);
    }

    /// The prototype called `name` of a file, the first one without a name; never `except`.
    pub fn find(&self, file: u32, name: Option<&str>, except: usize) -> Option<usize> {
        let found = self.top.get(&(file, name.map(Arc::from))).copied();
        found.filter(|&i| i != except)
    }
}

/// Two field types whose values are alike.
fn is_alike(a: FieldType, b: FieldType) -> bool {
    if a.tuple_size() == 0 || b.tuple_size() == 0 {
        return a == b;
    }
    (a.tuple_size(), a.is_multiple(), a.is_integer())
        == (b.tuple_size(), b.is_multiple(), b.is_integer())
}

impl<'a> File<'_, '_, 'a, '_> {
    /// Adds a definition. Its body is added with all other nodes.
    pub(super) fn proto(&mut self, id: TreeId) {
        let tree = self.tree;
        let source = tree.node(id);
        let mut slots = Vec::new();
        let mut body = Vec::new();
        let mut urls = None;
        for item in tree.items(id) {
            match *item {
                Item::Field(field) => match tree.declaration(field) {
                    Some(d) if d.access.has_value() && slots.len() == MAX_SLOTS => self.problem(
                        Severity::Warning,
                        "many-fields",
                        format!("a prototype declares more than {MAX_SLOTS} fields"),
                        "this one was ignored",
                        tree.field(field).span,
                    ),
                    Some(d) if d.access.has_value() => {
                        let field_type = FieldType::from_name(d.field_type);
                        if field_type.is_none() {
                            let name = text_of(&d.field_type[..d.field_type.len().min(80)]);
                            self.problem(
                                Severity::Warning,
                                "unknown-type",
                                format!("`{name}` is not a field type"),
                                "the declaration was ignored",
                                tree.field(field).span,
                            );
                        }
                        let default = field_type.and_then(|t| self.slot_value(t, field));
                        slots.push(Slot {
                            name: tree.field(field).name.into(),
                            field_type,
                            default,
                        });
                    }
                    Some(_) => {}
                    None if source.form == Form::ExternProto => {
                        let value = self.slot_value(FieldType::MFString, field);
                        urls = Some(value.map_or(Vec::new(), |v| v.texts().to_vec()));
                    }
                    None => {}
                },
                Item::Child(child) => body.extend(self.child(child)),
            }
        }
        if source.form == Form::ExternProto {
            urls.get_or_insert_default();
        }
        let end = source.span.end;
        let after = |i: &u32| tree.node(TreeId(*i)).span.start >= end;
        let count = tree.node_count() as u32;
        // Nodes stand in order of their beginnings.
        let inside = (id.0 + 1..count).find(after).unwrap_or(count);
        let node = NodeId(self.base + id.0);
        let protos = &mut self.builder.protos;
        protos.add(Proto {
            file: self.index,
            name: text_of(source.def.unwrap_or_default()).into(),
            is_top: self.scope.is_none(),
            node,
            slots,
            body,
            inside: node.0 + 1..self.base + inside,
            urls,
        });
    }

    /// The prototype in whose name a node is written, if there is one; `Err` if it is the one
    /// around it.
    pub(super) fn proto_of(&self, id: TreeId) -> Option<Result<usize, ()>> {
        let source = self.tree.node(id);
        let scope = self.names.scope(id);
        let found = self
            .names
            .find_proto(self.tree, source.class, source.span, scope);
        match found {
            Reference::Node(proto) => {
                let node = NodeId(self.base + proto.0);
                self.builder.protos.by_node.get(&node).map(|&p| Ok(p))
            }
            Reference::Cycle => Some(Err(())),
            Reference::Later | Reference::Unknown => None,
        }
    }

    /// The index of the prototype around the node being added.
    fn proto_around(&self) -> Option<usize> {
        let scope = self.names.scope(self.owner)?;
        let node = NodeId(self.base + scope.0);
        self.builder.protos.by_node.get(&node).copied()
    }

    /// Adds a node in the name of prototype `index`.
    pub(super) fn instance(&mut self, id: TreeId, index: usize, node: &mut Node) {
        let tree = self.tree;
        let graph_id = NodeId(self.base + id.0);
        let mut instance = Instance {
            node: graph_id,
            origin: graph_id,
            proto: index,
            values: Vec::new(),
            links: Vec::new(),
        };
        node.kind = Kind::Known(Class::Group);
        for item in tree.items(id) {
            let Item::Field(field) = *item else { continue };
            let name = tree.field(field).name;
            let slots = &self.builder.protos.list[index].slots;
            let slot = slots.iter().position(|s| *s.name == *name);
            let field_type = slot.and_then(|s| slots[s].field_type);
            match (&tree.field(field).value, slot, field_type) {
                (Value::Is(outer), slot, field_type) => {
                    let link = self.link(*outer, slot.unwrap_or(0), field_type, field);
                    // Events may be connected too, which says nothing about values.
                    instance.links.extend(link.filter(|_| slot.is_some()));
                }
                (_, Some(slot), Some(field_type)) => {
                    let value = self.slot_value(field_type, field);
                    if value.is_none() && tree.field(field).connection.is_some() {
                        let name = text_of(&name[..name.len().min(80)]);
                        self.problem(
                            Severity::Warning,
                            "connection",
                            format!("`{name}` of a prototype's instance is connected to a field"),
                            "the field keeps its default; connect the nodes in the PROTO's body",
                            tree.field(field).span,
                        );
                    }
                    instance
                        .values
                        .extend(value.map(|value| (slot as u32, value)));
                }
                (_, Some(_), None) => {}
                (_, None, _) => {
                    let name = text_of(&name[..name.len().min(80)]);
                    let proto = &self.builder.protos.list[index].name;
                    let message = format!("`{name}` is not a field of PROTO {proto}");
                    let span = tree.field(field).span;
                    let hint = "the value was ignored";
                    self.problem(Severity::Warning, "unknown-field", message, hint, span);
                }
            }
        }
        if self.names.scope(id).is_some() {
            self.builder.protos.templates.insert(graph_id, instance);
        } else {
            self.builder.protos.pending.push_back(instance);
        }
    }

    /// A link for `field IS name` in the node being added, if both fit together.
    pub(super) fn link(
        &mut self,
        name: (u32, u32),
        field: usize,
        field_type: Option<FieldType>,
        id: FieldId,
    ) -> Option<Link> {
        let tree = self.tree;
        let &[Atom::Word(name, span)] = tree.atoms(name) else {
            return None;
        };
        let Some(around) = self.proto_around() else {
            self.problem(
                Severity::Warning,
                "is-outside",
                "`IS` stands outside of a PROTO".to_owned(),
                "the field keeps its default",
                tree.field(id).span,
            );
            return None;
        };
        let slots = &self.builder.protos.list[around].slots;
        let slot = slots.iter().position(|s| *s.name == *name)?;
        let (Some(inner), Some(outer)) = (field_type, slots[slot].field_type) else {
            return None;
        };
        if !is_alike(inner, outer) {
            let name = text_of(&name[..name.len().min(80)]);
            self.problem(
                Severity::Warning,
                "is-type",
                format!("`{name}` is a {}, not a {}", outer.name(), inner.name()),
                "`IS` joins fields of the same type; the field keeps its default",
                span,
            );
            return None;
        }
        Some(Link {
            field: field as u16,
            slot: slot as u32,
        })
    }

    /// `field IS name` in a node of a known class.
    pub(super) fn link_field(
        &mut self,
        name: (u32, u32),
        index: usize,
        of: FieldType,
        id: FieldId,
    ) {
        if let Some(link) = self.link(name, index, Some(of), id) {
            let node = NodeId(self.base + self.owner.0);
            let links = &mut self.builder.protos.links;
            links.entry(node).or_default().push(link);
        }
    }

    /// `input IS name` in an engine that names the type of its inputs.
    pub(super) fn link_input(
        &mut self,
        name: (u32, u32),
        input: Arc<str>,
        of: FieldType,
        id: FieldId,
    ) {
        if let Some(link) = self.link(name, 0, Some(of), id) {
            let node = NodeId(self.base + self.owner.0);
            let links = &mut self.builder.protos.input_links;
            links.entry(node).or_default().push((input, link.slot));
        }
    }

    /// The value of a field that a prototype declares.
    fn slot_value(&mut self, field_type: FieldType, id: FieldId) -> Option<FieldValue> {
        let tree = self.tree;
        let field = tree.field(id);
        if matches!(field.value, Value::Missing | Value::Is(_)) {
            return None;
        }
        let spec = FieldSpec {
            name: "field",
            field_type,
            default: "",
            words: &[],
        };
        let mut handles = self.handles(&field.value).into_iter();
        let mut reader = Reader {
            tree,
            subject: &|| format!("`{}`", text_of(&field.name[..field.name.len().min(80)])),
            node: &mut |_| handles.next().flatten(),
            problems: self.problems,
        };
        reader.read(&field.value, &spec, field.span)
    }
}

/// The fields that a node has when its links are followed.
pub(super) fn follow_links(
    node: &mut Node,
    links: &[Link],
    value: impl Fn(u32) -> Option<FieldValue>,
) {
    for link in links {
        if let Some(value) = value(link.slot) {
            node.fields.push(FieldEntry {
                index: link.field,
                ignored: false,
                value,
            });
        }
    }
}
