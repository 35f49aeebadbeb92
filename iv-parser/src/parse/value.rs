//! A field's value: numbers, words, strings, masks, nodes, or a list of them.

use super::{Frame, Parser};
use crate::lex::{self, StringEnd};
use crate::number;
use crate::source::Span;
use crate::tree::{Atom, Child, FieldId, Value};

impl<'a> Parser<'a> {
    /// The value of a field whose name has just been read, and what follows it.
    pub(super) fn field_value(&mut self, field: FieldId) {
        let name_end = self.at;
        self.skip_trivia();
        while self.peek() == Some(b',') {
            self.warn(
                "stray-comma",
                "a comma before a value",
                "it was ignored",
                Span::new(self.at, self.at + 1),
            );
            self.at += 1;
            self.skip_trivia();
        }
        match self.peek() {
            Some(b'[') => {
                self.at += 1;
                return self.list(field);
            }
            Some(b'(') => self.mask(field),
            Some(b'~' | b'=') => {}
            None | Some(b'}' | b']' | b')' | b'{') => {
                let span = self.tree.field(field).span;
                self.warn(
                    "no-value",
                    &format!(
                        "field `{}` has no value",
                        crate::text::text_of(self.tree.field(field).name)
                    ),
                    "it keeps its default",
                    span,
                );
                self.at = name_end;
                return;
            }
            Some(_) => {
                if self.number_here() {
                    self.numbers(field, false);
                } else if self.vrml2 && self.opt_is(field) {
                } else if let Some(atom) = self.opt_atom() {
                    return self.single(field, atom);
                } else {
                    let start = self.at;
                    self.skip_junk();
                    self.warn(
                        "bad-value",
                        "this is not a value",
                        "it was skipped",
                        Span::new(start, self.at),
                    );
                }
            }
        }
        self.after_value(field);
    }

    /// One value without brackets; strings and words may be followed by more of their kind.
    fn single(&mut self, field: FieldId, atom: Atom<'a>) {
        let start = self.tree.atoms.len();
        self.tree.atoms.push(atom);
        let opened = matches!(
            (atom, self.frames.last()),
            (
                Atom::Child(Child::Node(id)),
                Some(Frame::Body { node, .. } | Frame::Interface { node, .. })
            ) if *node == id
        );
        if !opened {
            self.more_of_a_kind(atom);
        }
        let range = (start as u32, self.tree.atoms.len() as u32);
        self.tree.fields[field.0 as usize].value =
            if matches!(atom, Atom::Word(..)) && range.1 - range.0 > 1 {
                Value::Mask(range)
            } else {
                Value::Atoms {
                    atoms: range,
                    bracketed: false,
                }
            };
        if opened {
            // The node's body is read first, then what follows the value.
            let below = self.frames.len() - 1;
            self.frames.insert(below, Frame::AfterValue(field));
        } else {
            self.after_value(field);
        }
    }

    /// `A | B` without parentheses, and `"a" "b"` without brackets.
    fn more_of_a_kind(&mut self, first: Atom<'a>) {
        loop {
            let next = self.next_token(self.at);
            match (first, self.bytes.get(next)) {
                (Atom::Word(..), Some(b'|')) => {
                    self.at = lex::skip_trivia(self.bytes, next + 1);
                    let end = lex::word(self.bytes, self.at);
                    if end == self.at {
                        return;
                    }
                    let word = Atom::Word(&self.bytes[self.at..end], Span::new(self.at, end));
                    self.tree.atoms.push(word);
                    self.at = end;
                }
                (Atom::String(..), Some(b'"')) => {
                    self.warn(
                        "no-brackets",
                        "several strings without brackets",
                        "they were taken as a list; write `[ \"a\", \"b\" ]`",
                        Span::new(next, next + 1),
                    );
                    self.at = next;
                    let atom = self.string();
                    self.tree.atoms.push(atom);
                }
                _ => return,
            }
        }
    }

    /// `( A | B )`
    fn mask(&mut self, field: FieldId) {
        let open = self.at;
        self.at += 1;
        let start = self.tree.atoms.len();
        loop {
            self.skip_trivia();
            match self.peek() {
                Some(b')') => {
                    self.at += 1;
                    break;
                }
                Some(b'|' | b',') => self.at += 1,
                None | Some(b'}' | b'{' | b']' | b'[') => {
                    self.warn(
                        "missing-paren",
                        "a parenthesis is not closed",
                        "it was closed here",
                        Span::new(open, open + 1),
                    );
                    break;
                }
                Some(_) => {
                    let end = lex::word(self.bytes, self.at).max(self.at + 1);
                    let word = Atom::Word(&self.bytes[self.at..end], Span::new(self.at, end));
                    self.tree.atoms.push(word);
                    self.at = end;
                }
            }
        }
        let range = (start as u32, self.tree.atoms.len() as u32);
        self.tree.fields[field.0 as usize].value = Value::Mask(range);
    }

    /// Behind `[`.
    fn list(&mut self, field: FieldId) {
        let open = self.at - 1;
        self.skip_trivia();
        if self.peek() == Some(b',') {
            self.at += 1;
            self.warn(
                "stray-comma",
                "a comma before the first value",
                "it was ignored",
                Span::new(self.at - 1, self.at),
            );
            self.skip_trivia();
        }
        if self.number_here() {
            self.numbers(field, true);
            self.after_value(field);
        } else {
            let atoms = self.open_atoms.len();
            self.frames.push(Frame::List { field, atoms, open });
        }
    }

    /// Reads one value of a mixed list, or its end.
    pub(super) fn list_step(&mut self, field: FieldId, atoms: usize, open: usize) {
        self.skip_trivia();
        match self.peek() {
            Some(b']') => {
                self.at += 1;
                self.close_list(field, atoms);
            }
            Some(b',') => self.at += 1,
            None | Some(b'}') => {
                self.missing_bracket(open);
                self.close_list(field, atoms);
            }
            Some(_) => {
                if let Some((value, end, _)) = number::number(self.bytes, self.at) {
                    let value = match value {
                        number::Number::Int(i) => f64::from(i),
                        number::Number::Float(f) => f,
                    };
                    self.open_atoms
                        .push(Atom::Number(value, Span::new(self.at, end)));
                    self.at = end;
                } else if let Some(atom) = self.opt_atom() {
                    // A node's body, if opened, is read next; it leaves the list's atoms alone.
                    self.open_atoms.push(atom);
                } else {
                    let start = self.at;
                    self.skip_junk();
                    self.warn(
                        "bad-value",
                        "this is not a value",
                        "it was skipped",
                        Span::new(start, self.at),
                    );
                }
            }
        }
    }

    pub(super) fn missing_bracket(&mut self, open: usize) {
        self.warn(
            "missing-bracket",
            "a list is not closed by `]`",
            "it was closed at the end of its values",
            Span::new(open, open + 1),
        );
    }

    fn close_list(&mut self, field: FieldId, atoms: usize) {
        self.frames.pop();
        let start = self.tree.atoms.len() as u32;
        self.tree.atoms.extend(self.open_atoms.drain(atoms..));
        self.tree.fields[field.0 as usize].value = Value::Atoms {
            atoms: (start, self.tree.atoms.len() as u32),
            bracketed: true,
        };
        self.after_value(field);
    }

    /// A node, string or word, if one is here.
    fn opt_atom(&mut self) -> Option<Atom<'a>> {
        if self.peek() == Some(b'"') {
            return Some(self.string());
        }
        let child_possible = self.name(self.at).is_some();
        if child_possible && let Some(child) = self.opt_child() {
            return Some(Atom::Child(child));
        }
        let start = self.at;
        let end = lex::word(self.bytes, start);
        if end == start {
            return None;
        }
        self.at = end;
        Some(Atom::Word(&self.bytes[start..end], Span::new(start, end)))
    }

    fn string(&mut self) -> Atom<'a> {
        let start = self.at;
        let (text_end, end, ending) = self.quoted();
        self.at = end;
        let hint = match ending {
            StringEnd::Closed => "",
            StringEnd::BackslashQuote => {
                "the backslash before a quote was taken as text; write the path with `/`"
            }
            StringEnd::Unclosed => "it was cut at the end of its line",
        };
        if ending != StringEnd::Closed {
            self.warn(
                "unclosed-string",
                "a string is not closed",
                hint,
                Span::new(start, text_end.max(start + 1)),
            );
        }
        Atom::String(&self.bytes[start + 1..text_end], Span::new(start, end))
    }
}
