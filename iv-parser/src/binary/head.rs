//! A node's beginning and end: what is said about its fields before them.

use super::{Body, Fault, Frame, Reader, ValueType};
use crate::source::Span;
use crate::tree::{Atom, Field, FieldId, Item, Node, NodeId, Value};

const IS_ENGINE: u32 = 1;
const IS_GROUP: u32 = 2;
/// Beside the number of fields: types and names of all of them follow.
const IS_DESCRIBED: u32 = 0x4000;
/// Largest number of fields.
const MOST_FIELDS: u32 = 0xff;

impl<'a> Reader<'a, '_> {
    pub(super) fn new_node(
        &mut self,
        class: &'a [u8],
        def: Option<&'a [u8]>,
        start: usize,
    ) -> NodeId {
        let id = NodeId(self.tree.nodes.len() as u32);
        let span = self.span_from(start);
        self.tree.nodes.push(Node::new(class, def, span));
        id
    }

    /// Reads the head of a node. Its frame then stands for its fields.
    pub(super) fn head(&mut self, node: NodeId, items: usize) -> Result<(), Fault> {
        let class = self.tree.node(node).class;
        if class == b"Path" {
            return self.path(node, items);
        }
        let mut body = Body {
            node,
            items,
            fields_left: 0,
            is_group: Some(false),
            described: self.described.len(),
            any_type: None,
        };
        let is_new = self.header.version > (2, 0);
        if is_new {
            let flags = self.words.word().ok_or(Fault::End)?;
            if flags > (IS_ENGINE | IS_GROUP) {
                return Err(Fault::Bad("a node"));
            }
            body.is_group = Some(flags & IS_GROUP != 0);
        } else {
            let shape = self.schema.class(class, &self.header);
            body.is_group = shape.map(|shape| shape.is_group);
        }
        body.any_type = self.engine_type()?;
        let is_described = if is_new {
            let word = self.words.word().ok_or(Fault::End)?;
            body.fields_left = word & MOST_FIELDS;
            if word & !(IS_DESCRIBED | MOST_FIELDS) != 0 {
                return Err(Fault::Bad("the number of fields"));
            }
            word & IS_DESCRIBED != 0
        } else {
            false
        };
        if is_described {
            self.description(b"fields", body.fields_left)?;
        }
        if !is_new {
            body.fields_left = self.old_head(class)?;
        }
        if let Some(open) = self.frames.last_mut() {
            *open = Frame::Fields(body);
        }
        Ok(())
    }

    /// Files up to 2.0: descriptions stand behind their own words, and no number of fields stands
    /// where there can be none.
    fn old_head(&mut self, class: &[u8]) -> Result<u32, Fault> {
        let mut is_described = false;
        for word in [&b"fields"[..], b"inputs", b"fields"] {
            if self.words.skip_string(word) {
                let count = self
                    .words
                    .count(8)
                    .ok_or_else(|| self.fault("a description"))?;
                self.description(word, count)?;
                is_described = true;
            }
        }
        let shape = self.schema.class(class, &self.header);
        if !is_described && shape.is_some_and(|shape| !shape.has_fields) {
            return Ok(0);
        }
        let fields = self.words.word().ok_or(Fault::End)?;
        if fields > MOST_FIELDS {
            return Err(Fault::Bad("the number of fields"));
        }
        Ok(fields)
    }

    /// `type "MFFloat"`, with which engines begin whose inputs are of any type.
    fn engine_type(&mut self) -> Result<Option<ValueType>, Fault> {
        let start = self.words.at;
        if !self.words.skip_string(b"type") {
            return Ok(None);
        }
        let name_start = self.words.at;
        let name = self.words.name().ok_or_else(|| self.fault("a type"))?;
        let word = Atom::Word(name, self.span_from(name_start));
        let value = self.atoms_value(&[word], false);
        self.new_field(b"type", value, start);
        Ok(self.schema.named_type(name))
    }

    /// The types and names of `count` fields, as text has them: `fields [ SFFloat x ]`.
    fn description(&mut self, called: &'static [u8], count: u32) -> Result<(), Fault> {
        let start = self.words.at;
        let mut atoms = Vec::new();
        for _ in 0..count {
            let mut word = || -> Result<(&'a [u8], Span), Fault> {
                let start = self.words.at;
                let name = self
                    .words
                    .name()
                    .ok_or_else(|| self.fault("a description"))?;
                Ok((name, self.span_from(start)))
            };
            let (type_name, type_span) = word()?;
            let (name, span) = word()?;
            atoms.push(Atom::Word(type_name, type_span));
            atoms.push(Atom::Word(name, span));
            let stored = self.schema.named_type(type_name);
            self.described.push((name, stored));
        }
        let value = self.atoms_value(&atoms, true);
        self.new_field(called, value, start);
        Ok(())
    }

    fn atoms_value(&mut self, atoms: &[Atom<'a>], bracketed: bool) -> Value {
        let start = self.tree.atoms.len() as u32;
        self.tree.atoms.extend_from_slice(atoms);
        Value::Atoms {
            atoms: (start, self.tree.atoms.len() as u32),
            bracketed,
        }
    }

    pub(super) fn new_field(&mut self, name: &'a [u8], value: Value, start: usize) -> FieldId {
        let id = FieldId(self.tree.fields.len() as u32);
        self.tree.fields.push(Field {
            name,
            value,
            ignored: false,
            connection: None,
            span: self.span_from(start),
        });
        self.open_items.push(Item::Field(id));
        id
    }

    /// Behind the last field.
    pub(super) fn fields_end(&mut self, body: Body) -> Result<(), Fault> {
        self.described.truncate(body.described);
        self.frames.pop();
        let is_group = body.is_group.unwrap_or_else(|| self.children_here());
        let (node, items) = (body.node, body.items);
        if !is_group {
            self.close_node(node, items);
            return Ok(());
        }
        self.frames.push(Frame::Children {
            node,
            items,
            left: 0,
        });
        let count = self.words.word().ok_or(Fault::End)?;
        // Of a file that was cut off, those that are there are read.
        if count > 0 && self.words.from(self.words.at).name().is_none() {
            return Err(self.fault("the number of children"));
        }
        if let Some(Frame::Children { left, .. }) = self.frames.last_mut() {
            *left = count;
        }
        Ok(())
    }

    /// Ends a node whose frame has been taken from the stack.
    pub(super) fn close_node(&mut self, node: NodeId, items: usize) {
        let start = self.tree.items.len();
        let is_too_deep = self.depth > self.limits.depth;
        self.depth -= 1;
        if is_too_deep {
            self.open_items.truncate(items);
        } else {
            self.tree.items.extend(self.open_items.drain(items..));
        }
        let end = self.tree.items.len();
        let entry = &mut self.tree.nodes[node.0 as usize];
        entry.set_items(start, end);
        entry.span.end = self.words.at as u32;
        let span = entry.span;
        if is_too_deep && self.depth == self.limits.depth {
            let message = format!("nodes are nested deeper than {} levels", self.limits.depth);
            let hint = "the contents of this node were skipped";
            self.problem(crate::Severity::Error, "too-deep", &message, hint, span);
        }
    }

    /// `Path`: a node, and by which children the path goes on from it.
    fn path(&mut self, node: NodeId, items: usize) -> Result<(), Fault> {
        if self.header.version > (2, 0) {
            self.words.word().ok_or(Fault::End)?;
        }
        if let Some(open) = self.frames.last_mut() {
            *open = Frame::Path { node, items };
        }
        self.child(true)?;
        Ok(())
    }

    pub(super) fn path_end(&mut self, node: NodeId, items: usize) -> Result<(), Fault> {
        let start = self.words.at;
        let count = self.words.count(4).ok_or_else(|| self.fault("a path"))?;
        self.words.items(count as usize, 4).ok_or(Fault::End)?;
        self.frames.pop();
        self.close_node(node, items);
        let span = self.span_from(start);
        let hint = "its first node was kept";
        self.warn(
            "path-indices",
            "the steps of a path are not kept",
            hint,
            span,
        );
        Ok(())
    }
}
