//! Statements of VRML 2: PROTO, EXTERNPROTO, ROUTE, IS, and the declarations of interfaces.
//!
//! Each statement stands in the tree as a node of a [`Form`] of its own, so that bodies, lists and
//! error recovery are those of nodes.

use super::{Frame, Parser};
use crate::lex;
use crate::source::Span;
use crate::tree::{Access, Atom, Child, Declaration, FieldId, Form, NodeId, Value};

/// Whether a word begins a statement.
pub(super) fn is_statement(word: &[u8]) -> bool {
    matches!(word, b"PROTO" | b"EXTERNPROTO" | b"ROUTE")
}

impl<'a> Parser<'a> {
    /// The statement whose first word is here; `None`, with nothing read, if it is none.
    pub(super) fn statement(&mut self, start: usize, end: usize) -> Option<Child<'a>> {
        let word = &self.bytes[start..end];
        if word == b"ROUTE" {
            return self.route(start, end);
        }
        let form = if word == b"PROTO" {
            Form::Proto
        } else {
            Form::ExternProto
        };
        let name_start = self.next_token(end);
        let name_end = self.name(name_start)?;
        let open = self.next_token(name_end);
        if self.bytes.get(open) != Some(&b'[') {
            return self.statement_without_interface(form, start, end, (name_start, name_end));
        }
        self.at = open + 1;
        let name = &self.bytes[name_start..name_end];
        let child = self.open_node(word, Some(name), start);
        self.begin_interface(child, form);
        Some(child)
    }

    /// `PROTO name { … }`: the empty interface was forgotten.
    fn statement_without_interface(
        &mut self,
        form: Form,
        start: usize,
        end: usize,
        (name_start, name_end): (usize, usize),
    ) -> Option<Child<'a>> {
        if form != Form::Proto || !self.is_body_next(name_end) {
            return None;
        }
        self.warn(
            "no-interface",
            "a PROTO without an interface",
            "it was taken as `[ ]`; write `PROTO Name [ ] { … }`",
            Span::new(start, name_end),
        );
        self.at = self.next_token(name_end) + 1;
        let name = &self.bytes[name_start..name_end];
        let child = self.open_node(&self.bytes[start..end], Some(name), start);
        if let Child::Node(id) = child {
            self.tree.nodes[id.0 as usize].form = form;
        }
        Some(child)
    }

    /// Turns the body just opened into an interface.
    fn begin_interface(&mut self, child: Child<'a>, form: Form) {
        let Child::Node(id) = child else { return };
        self.tree.nodes[id.0 as usize].form = form;
        if let Some(frame) = self.frames.last_mut()
            && let Frame::Body { node, items } = *frame
            && node == id
        {
            *frame = Frame::Interface { node, items };
        }
    }

    /// Reads one declaration of an interface, or its end and the beginning of what follows.
    pub(super) fn interface_step(&mut self, node: NodeId, items: usize) {
        self.skip_trivia();
        let start = self.at;
        match self.peek() {
            None => self.close_at_end(node, items),
            Some(b']') => {
                self.at += 1;
                self.behind_interface(node, items);
            }
            Some(b'{' | b'}') => {
                self.warn(
                    "missing-bracket",
                    "an interface is not closed by `]`",
                    "it was closed here",
                    Span::new(start, start + 1),
                );
                if self.peek() == Some(b'}') {
                    self.at += 1;
                    self.close_body(node, items);
                } else {
                    self.behind_interface(node, items);
                }
            }
            Some(_) => {
                let name = self.name(start);
                if name.is_some_and(|end| self.opt_declaration(start, end)) {
                    return;
                }
                self.skip_junk();
                self.warn(
                    "bad-declaration",
                    "this is not the declaration of a field or event",
                    "it was skipped; write `field SFFloat name 1` or `eventIn SFFloat name`",
                    Span::new(start, self.at),
                );
            }
        }
    }

    /// Behind `]`: the body of a PROTO, the URL of an EXTERNPROTO.
    fn behind_interface(&mut self, node: NodeId, items: usize) {
        self.skip_trivia();
        let form = self.tree.node(node).form;
        let Some(frame) = self.frames.last_mut() else {
            return;
        };
        match (form, self.bytes.get(self.at)) {
            (Form::Proto, Some(b'{')) => {
                *frame = Frame::Body { node, items };
                self.at += 1;
            }
            (Form::ExternProto, Some(b'[' | b'"')) => {
                *frame = Frame::AfterUrl { node, items };
                let id = self.new_field(self.at, self.at);
                self.tree.fields[id.0 as usize].name = b"url";
                self.field_value(id);
            }
            _ => {
                let span = Span::new(self.at, (self.at + 1).min(self.bytes.len()));
                let hint = match form {
                    Form::Proto => "write `PROTO Name [ … ] { … }`",
                    _ => "write `EXTERNPROTO Name [ … ] \"file.wrl#Name\"`",
                };
                self.warn("bad-proto", "a prototype ends too early", hint, span);
                self.close_body(node, items);
            }
        }
    }

    /// `exposedField SFColor color 1 0 0` or `eventIn SFTime start`, if one is here; the word of
    /// access ends at `end`.
    pub(super) fn opt_declaration(&mut self, start: usize, end: usize) -> bool {
        let Some(access) = Access::from_word(&self.bytes[start..end]) else {
            return false;
        };
        let type_start = self.next_token(end);
        let Some(type_end) = self.name(type_start) else {
            return false;
        };
        let name_start = self.next_token(type_end);
        let Some(name_end) = self.name(name_start) else {
            return false;
        };
        self.at = name_end;
        let id = self.new_field(name_start, name_end);
        self.tree.fields[id.0 as usize].span = Span::new(start, name_end);
        let field_type = &self.bytes[type_start..type_end];
        self.tree
            .declarations
            .push((id, Declaration { access, field_type }));
        self.skip_trivia();
        // The interface of an EXTERNPROTO gives no defaults: what follows is the next declaration.
        let is_extern = self.frames.last().is_some_and(|frame| {
            matches!(frame, Frame::Interface { node, .. }
                if self.tree.node(*node).form == Form::ExternProto)
        });
        if self.opt_is(id) {
            self.after_value(id);
        } else if access.has_value() && !is_extern {
            self.field_value(id);
        } else {
            self.at = name_end;
        }
        true
    }

    /// `IS name` as the value of a field.
    pub(super) fn opt_is(&mut self, field: FieldId) -> bool {
        let start = self.at;
        let Some(end) = self.name(start) else {
            return false;
        };
        if &self.bytes[start..end] != b"IS" {
            return false;
        }
        let name_start = self.next_token(end);
        let Some(name_end) = self.name(name_start) else {
            return false;
        };
        let span = Span::new(name_start, name_end);
        let atom = self.tree.atoms.len() as u32;
        self.tree
            .atoms
            .push(Atom::Word(&self.bytes[name_start..name_end], span));
        self.tree.fields[field.0 as usize].value = Value::Is((atom, atom + 1));
        self.at = name_end;
        true
    }

    /// `ROUTE node.event TO node.event`
    fn route(&mut self, start: usize, end: usize) -> Option<Child<'a>> {
        let from_start = self.next_token(end);
        let from_end = lex::word(self.bytes, from_start);
        let to = self.next_token(from_end);
        let to_end = self.name(to)?;
        if from_end == from_start || !self.bytes[to..to_end].eq_ignore_ascii_case(b"TO") {
            return None;
        }
        let target_start = self.next_token(to_end);
        let target_end = lex::word(self.bytes, target_start);
        if target_end == target_start {
            return None;
        }
        let items = self.open_items.len();
        let class = &self.bytes[start..end];
        let id = NodeId(self.tree.nodes.len() as u32);
        let span = Span::new(start, target_end);
        let mut node = crate::tree::Node::new(class, None, span);
        node.form = Form::Route;
        self.tree.nodes.push(node);
        let field = self.new_field(from_start, from_end);
        let atom = self.tree.atoms.len() as u32;
        let target = &self.bytes[target_start..target_end];
        self.tree
            .atoms
            .push(Atom::Word(target, Span::new(target_start, target_end)));
        self.tree.fields[field.0 as usize].value = Value::Atoms {
            atoms: (atom, atom + 1),
            bracketed: false,
        };
        self.at = target_end;
        let first = self.tree.items.len();
        self.tree.items.extend(self.open_items.drain(items..));
        let last = self.tree.items.len();
        self.tree.nodes[id.0 as usize].set_items(first, last);
        Some(Child::Node(id))
    }
}
