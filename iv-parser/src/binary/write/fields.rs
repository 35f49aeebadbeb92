//! The fields of a node: which of them can be written, as what, and what is said about them.

use std::io;

use super::value::Encoded;
use super::{Step, Writer, put_string, put_word};
use crate::binary::ValueType;
use crate::binary::guess_type;
use crate::binary::value::{IS_CONNECTED, IS_DEFAULT, IS_IGNORED};
use crate::text::text_of;
use crate::tree::{Atom, Child, Field, Item, NodeId, Value};

/// Most fields of a node: their number has eight bits.
const MOST_FIELDS: usize = 255;

/// One field that can be written.
pub(super) struct Planned<'t, 'a> {
    field: &'t Field<'a>,
    /// The name of its type, where the node describes its fields.
    type_name: &'t [u8],
    value: Encoded<'a>,
    /// No value stands in the tree: this one is the default.
    is_default: bool,
}

/// The fields of a node.
pub(super) struct Fields<'t, 'a> {
    fields: Vec<Planned<'t, 'a>>,
    /// `fields` or `inputs`, if the node describes them.
    description: Option<&'static [u8]>,
    /// The type of an engine of any type.
    engine_type: Option<&'t [u8]>,
    pub is_group: bool,
    has_count: bool,
}

impl<'t, 'a> Writer<'t, 'a, '_> {
    pub(super) fn fields_of(&mut self, id: NodeId, class: &[u8]) -> Fields<'t, 'a> {
        let tree = self.tree;
        let shape = self.schema.class(class, &tree.header);
        let described = self.described(id);
        let engine_type = self.engine_type(id);
        let any_type = engine_type.and_then(|name| self.schema.named_type(name));
        let is_described = shape.is_none() || !described.is_empty();
        let mut is_engine = false;
        let mut seen_child = false;
        let mut fields: Vec<Planned<'t, 'a>> = Vec::new();
        for item in tree.items(id) {
            let Item::Field(field) = item else {
                seen_child = true;
                continue;
            };
            let field = tree.field(*field);
            is_engine |= field.name == b"inputs";
            let is_said = matches!(field.name, b"fields" | b"inputs")
                || (field.name == b"type" && engine_type.is_some());
            if is_said {
                continue;
            }
            let by_node = described.iter().rev().find(|(_, name)| *name == field.name);
            let by_class = || {
                self.schema
                    .field(class, field.name, &tree.header)
                    .or(any_type)
            };
            let (stored, type_name) = match by_node {
                Some((type_name, _)) => (self.schema.named_type(type_name), *type_name),
                None if is_described => {
                    let stored = by_class().or_else(|| guess_type(tree, &field.value));
                    let name = stored.and_then(|stored| self.schema.name_of(stored));
                    (stored, name.unwrap_or_default().as_bytes())
                }
                None => (by_class(), &b""[..]),
            };
            let planned = self.planned(class, field, stored, type_name);
            if fields.len() == MOST_FIELDS {
                self.left_out(class, field, "a node has at most 255 fields");
                break;
            }
            if seen_child && planned.as_ref().is_some_and(Planned::holds_nodes) {
                let message = format!(
                    "`{}.{}` was moved before the children of its node",
                    text_of(class),
                    text_of(field.name)
                );
                let hint = "binary files have fields first; a USE in it means what is defined \
                            before the node";
                self.problem("field-moved", message, hint, field.span);
            }
            // Of a field that is written twice the last counts; one with nodes may define names.
            let again = fields.iter().position(|earlier| {
                planned.is_some() && earlier.field.name == field.name && !earlier.holds_nodes()
            });
            if let Some(earlier) = again {
                fields.remove(earlier);
            }
            fields.extend(planned);
        }
        let is_group = shape.map_or(seen_child, |shape| shape.is_group);
        if seen_child && !is_group {
            let message = format!("{} cannot have children", text_of(class));
            let span = tree.node(id).span;
            self.problem("not-in-binary", message, "they were left out", span);
        }
        Fields {
            fields,
            description: is_described.then_some(if is_engine { b"inputs" } else { b"fields" }),
            engine_type,
            is_group,
            has_count: is_described || shape.is_some_and(|shape| shape.has_fields),
        }
    }

    /// Type and name of the fields that a node describes.
    fn described(&self, id: NodeId) -> Vec<(&'t [u8], &'t [u8])> {
        let tree = self.tree;
        let words = |item: &'t Item<'a>| {
            let Item::Field(field) = item else {
                return Vec::new();
            };
            let field = tree.field(*field);
            let Value::Atoms { atoms, .. } = &field.value else {
                return Vec::new();
            };
            if !matches!(field.name, b"fields" | b"inputs") {
                return Vec::new();
            }
            let word = |atom: &'t Atom<'a>| match atom {
                Atom::Word(word, _) => Some(*word),
                _ => None,
            };
            tree.atoms(*atoms)
                .iter()
                .filter_map(word)
                .collect::<Vec<_>>()
        };
        let words: Vec<&'t [u8]> = tree.items(id).iter().flat_map(words).collect();
        let pairs = words.chunks_exact(2).map(|pair| (pair[0], pair[1]));
        pairs.collect()
    }

    /// The type that `type MFFloat` names.
    fn engine_type(&self, id: NodeId) -> Option<&'t [u8]> {
        let tree = self.tree;
        tree.items(id).iter().find_map(|item| {
            let Item::Field(field) = item else {
                return None;
            };
            let field = tree.field(*field);
            let Value::Atoms { atoms, .. } = &field.value else {
                return None;
            };
            match tree.atoms(*atoms) {
                [Atom::Word(word, _) | Atom::String(word, _)] if field.name == b"type" => {
                    self.schema.named_type(word).map(|_| *word)
                }
                _ => None,
            }
        })
    }

    fn planned(
        &mut self,
        class: &[u8],
        field: &'t Field<'a>,
        stored: Option<ValueType>,
        type_name: &'t [u8],
    ) -> Option<Planned<'t, 'a>> {
        let Some(stored) = stored else {
            self.left_out(class, field, "its type is not known");
            return None;
        };
        let is_missing = matches!(field.value, Value::Missing);
        let value = if is_missing {
            if !field.ignored && field.connection.is_none() {
                // As a reader of text has it: nothing was written.
                return None;
            }
            self.default_value(class, field.name, stored)
        } else {
            self.encoded(class, field, stored)
        };
        let Some(value) = value else {
            self.left_out(class, field, "its value is not of the field's type");
            return None;
        };
        Some(Planned {
            field,
            type_name,
            value,
            is_default: is_missing,
        })
    }

    fn left_out(&mut self, class: &[u8], field: &Field<'_>, why: &str) {
        let message = format!(
            "`{}.{}` is not in the binary file: {why}",
            text_of(class),
            text_of(field.name)
        );
        self.problem("not-in-binary", message, "", field.span);
    }

    /// What stands before the fields.
    pub(super) fn head(&mut self, class: &[u8], fields: &Fields<'_, '_>) -> io::Result<()> {
        let mut out = Vec::new();
        if self.is_new() {
            let is_engine = u32::from(fields.description == Some(b"inputs"));
            put_word(&mut out, is_engine | u32::from(fields.is_group) << 1);
        }
        if let Some(name) = fields.engine_type {
            put_string(&mut out, b"type");
            put_string(&mut out, name);
        }
        let count = fields.fields.len() as u32;
        match fields.description {
            Some(_) if self.is_new() => put_word(&mut out, 0x4000 | count),
            Some(word) => {
                put_string(&mut out, word);
                put_word(&mut out, count);
            }
            None if self.is_new() || fields.has_count => put_word(&mut out, count),
            None => debug_assert_eq!(count, 0, "fields of {}", text_of(class)),
        }
        if fields.description.is_some() {
            for planned in &fields.fields {
                put_string(&mut out, planned.type_name);
                put_string(&mut out, planned.field.name);
            }
            if !self.is_new() {
                put_word(&mut out, count);
            }
        }
        self.out.write_all(&out)
    }

    /// Writes the field at `next`; those behind it wait.
    pub(super) fn field(&mut self, mut fields: Fields<'t, 'a>, next: usize) -> io::Result<()> {
        let Some(planned) = fields.fields.get_mut(next) else {
            return Ok(());
        };
        let (field, is_default) = (planned.field, planned.is_default);
        let value = std::mem::replace(&mut planned.value, Encoded::Bytes(Vec::new()));
        self.steps.push(Step::Fields(fields, next + 1));
        self.steps.push(Step::Tail(field, is_default));
        self.string(field.name)?;
        match value {
            Encoded::Bytes(bytes) => self.out.write_all(&bytes),
            Encoded::Nodes { nodes, is_list } => {
                if is_list {
                    self.word(nodes.len() as u32)?;
                }
                self.steps.extend(nodes.into_iter().rev().map(Step::Child));
                Ok(())
            }
        }
    }

    pub(super) fn tail(&mut self, field: &'t Field<'a>, is_default: bool) -> io::Result<()> {
        let mut flags = 0;
        if field.ignored {
            flags |= IS_IGNORED;
        }
        if is_default {
            flags |= IS_DEFAULT;
        }
        if let Some(connection) = &field.connection {
            flags |= IS_CONNECTED;
            self.steps.push(Step::Output(connection.output));
            self.steps.push(Step::Child(connection.master));
        }
        self.word(flags)
    }
}

impl Planned<'_, '_> {
    fn holds_nodes(&self) -> bool {
        let is_node = |child: &Child<'_>| *child != Child::Null;
        self.field.connection.is_some()
            || matches!(&self.value, Encoded::Nodes { nodes, .. } if nodes.iter().any(is_node))
    }
}
