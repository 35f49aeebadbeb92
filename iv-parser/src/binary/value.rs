//! Fields and their values.

use super::words::is_plain_word;
use super::{Body, Fault, Frame, Reader, ValueKind, ValueType, numbers};
use crate::source::Span;
use crate::tree::{Atom, Child, Connection, FieldId, Numbers, Value};

pub(super) const IS_IGNORED: u32 = 1;
pub(super) const IS_CONNECTED: u32 = 2;
pub(super) const IS_DEFAULT: u32 = 4;
/// Largest flags word.
pub(super) const ALL_FLAGS: u32 = 7;

impl<'a> Reader<'a, '_> {
    /// Reads one field, or ends them.
    pub(super) fn fields_step(&mut self, body: Body) -> Result<(), Fault> {
        if body.fields_left == 0 {
            return self.fields_end(body);
        }
        if let Some(Frame::Fields(body)) = self.frames.last_mut() {
            body.fields_left -= 1;
        }
        let start = self.words.at;
        let name = self.words.name().ok_or_else(|| self.fault("a field"))?;
        let class = self.tree.node(body.node).class;
        let described = self.described[body.described..].iter();
        let by_node = described.rev().find(|(known, _)| *known == name);
        let stored = match by_node {
            Some((_, stored)) => *stored,
            None => self
                .schema
                .field(class, name, &self.header)
                .or(body.any_type),
        };
        match stored {
            Some(stored) => {
                let field = self.new_field(name, Value::Missing, start);
                self.value(field, stored)
            }
            None => self.skip_unknown(body, name, start),
        }
    }

    /// Reads a value and what follows it. Nodes wait on the stack.
    fn value(&mut self, field: FieldId, stored: ValueType) -> Result<(), Fault> {
        let start = self.words.at;
        let count = match stored.is_list {
            true => self.count(stored)?,
            false => 1,
        };
        if stored.kind == ValueKind::Node {
            self.frames.push(Frame::Nodes {
                field,
                atoms: self.open_atoms.len(),
                left: count as u32,
                is_list: stored.is_list,
            });
            return Ok(());
        }
        let value = self.plain_value(stored, count, start)?;
        self.tree.fields[field.0 as usize].value = value;
        self.tail(field)
    }

    /// The number of values in a list, all of which are there.
    fn count(&mut self, stored: ValueType) -> Result<usize, Fault> {
        let least = match stored.kind {
            ValueKind::Nothing => 1,
            ValueKind::Double | ValueKind::Wide => 8 * usize::from(stored.size),
            _ => 4 * usize::from(stored.size),
        };
        let count = self.words.count(least);
        count
            .map(|count| count as usize)
            .ok_or_else(|| self.fault("the number of values"))
    }

    fn plain_value(
        &mut self,
        stored: ValueType,
        count: usize,
        start: usize,
    ) -> Result<Value, Fault> {
        let bracketed = stored.is_list && count != 1;
        let values = count * usize::from(stored.size);
        match stored.kind {
            ValueKind::Nothing | ValueKind::Node => Ok(Value::Missing),
            ValueKind::Image => self.image(2),
            ValueKind::Volume => self.image(3),
            ValueKind::Flag | ValueKind::Text | ValueKind::Word => {
                let first = self.tree.atoms.len() as u32;
                for _ in 0..count {
                    let atom = self.atom(stored.kind)?;
                    self.tree.atoms.push(atom);
                }
                Ok(Value::Atoms {
                    atoms: (first, self.tree.atoms.len() as u32),
                    bracketed,
                })
            }
            ValueKind::Mask => {
                let first = self.tree.atoms.len() as u32;
                loop {
                    let at = self.words.at;
                    let word = self.words.string().ok_or_else(|| self.fault("a word"))?;
                    if word.is_empty() {
                        break;
                    }
                    let span = self.span_from(at);
                    if is_plain_word(word) {
                        self.tree.atoms.push(Atom::Word(word, span));
                    } else {
                        self.warn("bad-word", "this is not a word", "it was left out", span);
                    }
                }
                Ok(Value::Mask((first, self.tree.atoms.len() as u32)))
            }
            // As text has an empty list.
            _ if values == 0 => Ok(Value::Atoms {
                atoms: (0, 0),
                bracketed: true,
            }),
            _ => {
                let numbers = self.numbers(stored.kind, values)?;
                Ok(Value::Numbers {
                    numbers,
                    bracketed,
                    octal: false,
                    span: self.span_from(start),
                })
            }
        }
    }

    fn atom(&mut self, kind: ValueKind) -> Result<Atom<'a>, Fault> {
        let start = self.words.at;
        if kind == ValueKind::Flag {
            let flag = self.words.word().ok_or(Fault::End)?;
            let word: &[u8] = if flag == 0 { b"FALSE" } else { b"TRUE" };
            return Ok(Atom::Word(word, self.span_from(start)));
        }
        let text = self.words.string().ok_or_else(|| self.fault("a string"))?;
        let span = self.span_from(start);
        Ok(if kind == ValueKind::Word && is_plain_word(text) {
            Atom::Word(text, span)
        } else {
            Atom::String(text, span)
        })
    }

    /// A run of numbers that text would have written.
    fn numbers(&mut self, kind: ValueKind, count: usize) -> Result<Numbers, Fault> {
        let start = self.words.at;
        let size = match kind {
            ValueKind::Double | ValueKind::Wide => 8,
            _ => 4,
        };
        let bytes = self.words.items(count, size).ok_or(Fault::End)?;
        let mut not_finite = false;
        match kind {
            ValueKind::Float => not_finite = numbers::floats(bytes, &mut self.floats),
            ValueKind::Double => not_finite = numbers::doubles(bytes, &mut self.floats),
            ValueKind::Wide => {
                let (wide, _) = bytes.as_chunks::<8>();
                let wide = wide.iter().map(|bytes| i64::from_be_bytes(*bytes) as f64);
                self.floats.extend(wide);
            }
            _ => numbers::ints(bytes, &mut self.ints),
        }
        if kind == ValueKind::Unsigned && self.ints.iter().any(|value| *value < 0) {
            // As in text, large whole numbers stand among the floats.
            let unsigned = self.ints.iter().map(|value| f64::from(*value as u32));
            self.floats.extend(unsigned);
            self.ints.clear();
        }
        if not_finite && !std::mem::replace(&mut self.not_finite_reported, true) {
            let span = self.span_from(start);
            self.warn(
                "not-a-number",
                "a value that is not a number",
                "it was read as 0; later ones are not reported",
                span,
            );
        }
        Ok(if self.floats.is_empty() {
            self.tree.add_ints(&mut self.ints)
        } else {
            self.tree.add_floats(&mut self.floats)
        })
    }

    /// Whole numbers, as floats if they are too large for 32 bits with a sign.
    pub(super) fn whole_numbers(&mut self, values: impl Iterator<Item = u32> + Clone) -> Numbers {
        if values.clone().all(|value| i32::try_from(value).is_ok()) {
            self.ints.extend(values.map(|value| value as i32));
            self.tree.add_ints(&mut self.ints)
        } else {
            self.floats.extend(values.map(f64::from));
            self.tree.add_floats(&mut self.floats)
        }
    }

    /// Reads one node of a value, or ends it.
    pub(super) fn nodes_step(
        &mut self,
        field: FieldId,
        atoms: usize,
        left: u32,
        is_list: bool,
    ) -> Result<(), Fault> {
        if left > 0 {
            if let Some(Frame::Nodes { left, .. }) = self.frames.last_mut() {
                *left -= 1;
            }
            // Put down first: the node's own frame comes on top of this one.
            let slot = self.open_atoms.len();
            self.open_atoms.push(Atom::Child(Child::Null));
            let child = self.child(false)?;
            self.open_atoms[slot] = Atom::Child(child);
            return Ok(());
        }
        self.frames.pop();
        self.close_nodes(field, atoms, is_list);
        self.tail(field)
    }

    pub(super) fn close_nodes(&mut self, field: FieldId, atoms: usize, is_list: bool) {
        let start = self.tree.atoms.len() as u32;
        self.tree.atoms.extend(self.open_atoms.drain(atoms..));
        self.tree.fields[field.0 as usize].value = Value::Atoms {
            atoms: (start, self.tree.atoms.len() as u32),
            bracketed: is_list,
        };
    }

    /// Behind a value: the flags and a connection.
    fn tail(&mut self, field: FieldId) -> Result<(), Fault> {
        let flags = self.words.word().ok_or(Fault::End)?;
        if flags > ALL_FLAGS {
            return Err(Fault::Bad("the flags of a field"));
        }
        let is_connected = flags & IS_CONNECTED != 0;
        let entry = &mut self.tree.fields[field.0 as usize];
        entry.span.end = self.words.at as u32;
        entry.ignored = flags & IS_IGNORED != 0;
        if flags & IS_DEFAULT != 0 && (is_connected || entry.ignored) {
            // Text would have left the value out.
            entry.value = Value::Missing;
        }
        if !is_connected {
            return Ok(());
        }
        entry.connection = Some(Box::new(Connection {
            master: Child::Null,
            output: b"",
        }));
        self.frames.push(Frame::Master(field));
        let master = self.child(false)?;
        if let Some(connection) = &mut self.tree.fields[field.0 as usize].connection {
            connection.master = master;
        }
        Ok(())
    }

    /// Behind the node that a field is connected to.
    pub(super) fn master_output(&mut self, field: FieldId) -> Result<(), Fault> {
        let output = self.words.name().ok_or_else(|| self.fault("an output"))?;
        self.frames.pop();
        let entry = &mut self.tree.fields[field.0 as usize];
        entry.span.end = self.words.at as u32;
        if let Some(connection) = &mut entry.connection {
            connection.output = output;
        }
        Ok(())
    }

    /// Nothing: where the value of a field that cannot be read ends is found out by what follows.
    fn skip_unknown(&mut self, body: Body, name: &'a [u8], start: usize) -> Result<(), Fault> {
        let value = self.words.at;
        let Some(end) = self.guess_end() else {
            return Err(Fault::Bad("a value whose length is known"));
        };
        self.words.at = end;
        let class = crate::text_of(self.tree.node(body.node).class);
        let message = format!("`{}` is not a known field of {class}", crate::text_of(name));
        let hint = format!(
            "its value was left out; by what follows it has {} bytes",
            end - value
        );
        let span = Span::new(start, value);
        self.warn("unknown-field", &message, &hint, span);
        if self
            .words
            .from(end)
            .word()
            .is_some_and(|flags| flags & IS_CONNECTED != 0)
        {
            let field = self.new_field(name, Value::Missing, start);
            return self.tail(field);
        }
        self.words.word().map(|_| ()).ok_or(Fault::End)
    }
}
