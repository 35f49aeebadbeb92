//! Between a node's braces: fields and children.

use super::{Frame, Parser};
use crate::lex;
use crate::source::Span;
use crate::tree::{Child, Connection, Field, FieldId, Item, NodeId, Value};

impl<'a> Parser<'a> {
    /// Reads one entry of a body, or its end.
    pub(super) fn body_step(&mut self, node: NodeId, items: usize) {
        self.skip_trivia();
        let start = self.at;
        match self.peek() {
            None => self.close_at_end(node, items),
            Some(b'}') => {
                self.at += 1;
                self.close_body(node, items);
            }
            // Harmless between entries; VRML 2 counts it as white space.
            Some(b',') => self.at += 1,
            Some(_) => {
                if let Some(child) = self.opt_child() {
                    self.place_child(child);
                } else if let Some(end) = self.name(start) {
                    if !(self.vrml2 && self.opt_declaration(start, end)) {
                        self.at = end;
                        self.field(start, end);
                    }
                } else {
                    self.skip_junk();
                    self.warn(
                        "stray-value",
                        "a value without a field name",
                        "it was skipped; write `fieldName value`",
                        Span::new(start, self.at),
                    );
                }
            }
        }
    }

    /// Puts a child among the open items. When it has opened a body of its own, which is read
    /// next, that body's items begin behind it.
    fn place_child(&mut self, child: Child<'a>) {
        self.open_items.push(Item::Child(child));
        if let (
            Child::Node(id),
            Some(Frame::Body { node, items } | Frame::Interface { node, items }),
        ) = (child, self.frames.last_mut())
            && *node == id
        {
            *items = self.open_items.len();
        }
    }

    pub(super) fn close_body(&mut self, node: NodeId, items: usize) {
        self.frames.pop();
        let start = self.tree.items.len();
        self.tree.items.extend(self.open_items.drain(items..));
        let end = self.tree.items.len();
        let entry = &mut self.tree.nodes[node.0 as usize];
        entry.set_items(start, end);
        entry.span.end = self.at as u32;
    }

    pub(super) fn close_at_end(&mut self, node: NodeId, items: usize) {
        if !self.ended_inside {
            self.ended_inside = true;
            self.report_missing_brace();
        }
        self.close_body(node, items);
    }

    /// A field whose name has been read.
    pub(super) fn field(&mut self, start: usize, end: usize) {
        let id = self.new_field(start, end);
        self.field_value(id);
    }

    /// Adds a field without a value.
    pub(super) fn new_field(&mut self, start: usize, end: usize) -> FieldId {
        let id = FieldId(self.tree.fields.len() as u32);
        self.tree.fields.push(Field {
            name: &self.bytes[start..end],
            value: Value::Missing,
            ignored: false,
            connection: None,
            span: Span::new(start, end),
        });
        self.open_items.push(Item::Field(id));
        id
    }

    /// Behind a value: the ignored flag and a connection.
    pub(super) fn after_value(&mut self, field: FieldId) {
        self.tree.fields[field.0 as usize].span.end = self.at as u32;
        self.skip_trivia();
        if self.peek() == Some(b'~') {
            self.at += 1;
            self.tree.fields[field.0 as usize].ignored = true;
            self.skip_trivia();
        }
        if self.peek() != Some(b'=') {
            return;
        }
        let start = self.at;
        self.at += 1;
        self.skip_trivia();
        let child = match self.opt_child() {
            // `USE x.y` is read as one name: the part behind the last point is the output.
            Some(Child::Use(name, span)) => {
                if let Some(point) = name.iter().rposition(|&b| b == b'.') {
                    let split = span.start as usize + point;
                    self.at = split;
                    Some(Child::Use(
                        &name[..point],
                        Span::new(span.start as usize, split),
                    ))
                } else {
                    Some(Child::Use(name, span))
                }
            }
            other => other,
        };
        let Some(master) = child else {
            self.warn(
                "bad-connection",
                "`=` is not followed by a node",
                "write `field = USE node . output`; the connection was dropped",
                Span::new(start, self.at.max(start + 1)),
            );
            return;
        };
        self.tree.fields[field.0 as usize].connection = Some(Box::new(Connection {
            master,
            output: b"",
        }));
        match self.frames.last().copied() {
            Some(Frame::Body { node, .. }) if master == Child::Node(node) => {
                let below = self.frames.len() - 1;
                self.frames.insert(below, Frame::AfterMaster(field));
            }
            _ => self.master_output(field),
        }
    }

    /// `. output`
    pub(super) fn master_output(&mut self, field: FieldId) {
        self.skip_trivia();
        let start = self.at;
        if self.peek() == Some(b'.') {
            let name_start = lex::skip_trivia(self.bytes, start + 1);
            if let Some(end) = lex::name(self.bytes, name_start) {
                self.at = end;
                let output = &self.bytes[name_start..end];
                if let Some(connection) = &mut self.tree.fields[field.0 as usize].connection {
                    connection.output = output;
                }
                self.tree.fields[field.0 as usize].span.end = end as u32;
                return;
            }
        }
        self.warn(
            "bad-connection",
            "a connection names no output",
            "write `field = USE node . output`; the connection was dropped",
            Span::new(start, (start + 1).min(self.bytes.len())),
        );
        self.tree.fields[field.0 as usize].connection = None;
    }
}
