//! The grammar: a total function from bytes to a tree.
//!
//! Nesting lives on an explicit stack of [`Frame`]s, so input cannot deepen the call stack. Each
//! step consumes at least one byte or pops a frame, so parsing ends. An error costs the smallest
//! thing that can be skipped: a token, a value, a balanced body.

mod body;
mod braces;
mod numbers;
mod plain;
mod recover;
mod value;
mod vrml;

use std::collections::HashSet;

use crate::binary::{Schema, parse_binary};
use crate::diagnostic::Severity;
use crate::header::{Dialect, Encoding, Header, read_header};
use crate::lex;
use crate::limits::Limits;
use crate::source::{Problem, Problems, Span};
use crate::tree::{Atom, Child, FieldId, Item, Node, NodeId, Tree};

/// A tree, and what was wrong with its text.
#[derive(Clone, Debug)]
pub struct Parse<'a> {
    /// The tree; never missing anything that could be read.
    pub tree: Tree<'a>,
    /// In order of discovery.
    pub problems: Vec<Problem>,
    /// How many more problems there were than the limit allows to keep.
    pub problems_dropped: usize,
}

/// Parses with the default [`Limits`].
pub fn parse(bytes: &[u8]) -> Parse<'_> {
    parse_with(bytes, &Limits::default())
}

/// Parses text, or a binary file with what the schema knows of its classes.
pub fn parse_any<'a>(bytes: &'a [u8], schema: &dyn Schema, limits: &Limits) -> Parse<'a> {
    let mut problems = Vec::new();
    let (header, start) = read_header(bytes, &mut problems);
    if header.encoding == Encoding::Binary {
        return parse_binary(bytes, start, header, schema, limits, problems);
    }
    parse_text(bytes, start, header, limits, problems)
}

/// Parses any text. Of a binary file it reads nothing: see [`parse_any`].
pub fn parse_with<'a>(bytes: &'a [u8], limits: &Limits) -> Parse<'a> {
    let mut problems = Vec::new();
    let (header, start) = read_header(bytes, &mut problems);
    if header.encoding == Encoding::Binary {
        problems.push(Problem {
            severity: Severity::Error,
            code: "unsupported-format",
            message: "this is a binary file, not a text".to_owned(),
            hint: String::new(),
            span: Span::default(),
        });
    }
    parse_text(bytes, start, header, limits, problems)
}

fn parse_text<'a>(
    bytes: &'a [u8],
    start: usize,
    header: Header,
    limits: &Limits,
    problems: Vec<Problem>,
) -> Parse<'a> {
    let mut parser = Parser {
        bytes: &bytes[..bytes.len().min(limits.bytes)],
        vrml2: header.dialect == Dialect::Vrml2,
        at: start,
        limits: *limits,
        tree: Tree::new(bytes, header),
        frames: Vec::new(),
        open_items: Vec::new(),
        open_atoms: Vec::new(),
        odd_names: HashSet::new(),
        longest_odd_name: 0,
        unclosed: false,
        ended_inside: false,
        run: numbers::Run::default(),
        problems: Problems::new(problems, limits.problems),
        overflow_reported: false,
        nan_reported: false,
    };
    if bytes.len() > limits.bytes {
        parser.problem(
            Severity::Error,
            "too-large",
            "the text is longer than can be read",
            "only the beginning was read; split the model into several files",
            Span::new(0, 0),
        );
    }
    // The bytes of another format are no text to look for nodes in.
    let is_foreign = |p: &Problem| p.code == "unsupported-format";
    if !parser.problems.list.iter().any(is_foreign) {
        parser.run();
    }
    parser.tree.int_lists.close();
    parser.tree.float_lists.close();
    Parse {
        tree: parser.tree,
        problems: parser.problems.list,
        problems_dropped: parser.problems.dropped,
    }
}

/// What is being read.
#[derive(Clone, Copy, Debug)]
enum Frame {
    /// Between a node's braces; its items begin at `items` of the stack of open items.
    Body { node: NodeId, items: usize },
    /// Between the brackets of a list that is not all numbers.
    List {
        field: FieldId,
        atoms: usize,
        open: usize,
    },
    /// Right behind a field's node value.
    AfterValue(FieldId),
    /// Right behind the master node of a connection.
    AfterMaster(FieldId),
    /// Between the brackets of a prototype's interface; its declarations are the first of the
    /// items that begin at `items`.
    Interface { node: NodeId, items: usize },
    /// Behind the URL of an EXTERNPROTO, whose items begin at `items`.
    AfterUrl { node: NodeId, items: usize },
}

/// Longest DEF name with a bracket in it that a USE is compared with.
const LONGEST_ODD_NAME: usize = 256;

struct Parser<'a> {
    bytes: &'a [u8],
    /// The text is VRML 2, which has rules of its own for names, commas and strings.
    vrml2: bool,
    at: usize,
    limits: Limits,
    tree: Tree<'a>,
    frames: Vec<Frame>,
    open_items: Vec<Item<'a>>,
    open_atoms: Vec<Atom<'a>>,
    /// DEF names that hold braces or brackets.
    odd_names: HashSet<&'a [u8]>,
    longest_odd_name: usize,
    /// A string was found that nothing closes.
    unclosed: bool,
    /// The text ended inside a body.
    ended_inside: bool,
    /// Buffers for the run of numbers being read.
    run: numbers::Run,
    problems: Problems,
    overflow_reported: bool,
    nan_reported: bool,
}

impl<'a> Parser<'a> {
    fn run(&mut self) {
        loop {
            match self.frames.last().copied() {
                None => {
                    if !self.root_step() {
                        return;
                    }
                }
                Some(Frame::Body { node, items }) => self.body_step(node, items),
                Some(Frame::List { field, atoms, open }) => self.list_step(field, atoms, open),
                Some(Frame::AfterValue(field)) => {
                    self.frames.pop();
                    self.after_value(field);
                }
                Some(Frame::AfterMaster(field)) => {
                    self.frames.pop();
                    self.master_output(field);
                }
                Some(Frame::Interface { node, items }) => self.interface_step(node, items),
                Some(Frame::AfterUrl { node, items }) => self.close_body(node, items),
            }
        }
    }

    /// Reads one thing at the top level; false at the end of the text.
    fn root_step(&mut self) -> bool {
        self.skip_trivia();
        let Some(b) = self.peek() else { return false };
        if let Some(child) = self.opt_child() {
            self.tree.roots.push(child);
        } else if b == b'}' {
            self.at += 1;
            self.warn(
                "extra-brace",
                "a closing brace without an opening one",
                "it was ignored",
                Span::new(self.at - 1, self.at),
            );
        } else {
            let start = self.at;
            self.skip_junk();
            self.warn(
                "not-a-node",
                "a node was expected here",
                "it was skipped; nodes are written `ClassName { … }`",
                Span::new(start, self.at),
            );
        }
        true
    }

    /// `DEF name Class {`, `Class {`, `USE name` or `NULL`, if one is here. An opened body is put
    /// on the stack and read next.
    fn opt_child(&mut self) -> Option<Child<'a>> {
        if self.peek() == Some(b'{') {
            let start = self.at;
            self.at += 1;
            self.warn(
                "no-class",
                "a body without a class name",
                "its contents were kept",
                Span::new(start, start + 1),
            );
            return Some(self.open_node(b"", None, start));
        }
        let start = self.at;
        let end = self.name(start)?;
        match &self.bytes[start..end] {
            word if self.vrml2 && vrml::is_statement(word) => self.statement(start, end),
            b"DEF" => self.opt_definition(start, end),
            b"USE" => {
                self.at = end;
                self.skip_trivia();
                let (name, span) = self.use_name();
                if name.is_empty() {
                    self.warn(
                        "bad-use",
                        "`USE` is not followed by a name",
                        "it was skipped",
                        Span::new(start, end),
                    );
                    return Some(Child::Null);
                }
                Some(Child::Use(name, span))
            }
            b"NULL" if !self.is_body_next(end) => {
                self.at = end;
                Some(Child::Null)
            }
            class => {
                if !self.is_body_next(end) {
                    return None;
                }
                self.at = self.next_token(end) + 1;
                Some(self.open_node(class, None, start))
            }
        }
    }

    fn is_body_next(&self, at: usize) -> bool {
        self.bytes.get(self.next_token(at)) == Some(&b'{')
    }

    fn opt_definition(&mut self, start: usize, end: usize) -> Option<Child<'a>> {
        let name_start = self.next_token(end);
        let full = if self.vrml2 {
            lex::name_end(self.bytes, name_start)
        } else {
            lex::to_blank(self.bytes, name_start)
        };
        // As in Coin a name goes on to the next blank; one that holds a whole body is none.
        let name = &self.bytes[name_start..full];
        let class_start = self.next_token(full);
        if let Some(class_end) = self.name(class_start)
            && !name.is_empty()
            && !(name.contains(&b'{') && name.ends_with(b"}"))
            && self.is_body_next(class_end)
        {
            if name.len() <= LONGEST_ODD_NAME && self.first_bracket(name_start, full) < full {
                self.odd_names.insert(name);
                self.longest_odd_name = self.longest_odd_name.max(name.len());
            }
            self.at = self.next_token(class_end) + 1;
            let class = &self.bytes[class_start..class_end];
            return Some(self.open_node(class, Some(name), class_start));
        }
        if let Some(child) = self.opt_body_of_no_class(name_start) {
            return Some(child);
        }
        self.at = full.max(end);
        self.warn(
            "bad-def",
            "`DEF` is not followed by a name and a node",
            "write `DEF name ClassName { … }`; this one was skipped",
            Span::new(start, self.at),
        );
        Some(Child::Null)
    }

    /// The body of `DEF name{ … }` or `DEF name { … }`, whose class is missing.
    fn opt_body_of_no_class(&mut self, name_start: usize) -> Option<Child<'a>> {
        let name_end = self.first_bracket(name_start, self.bytes.len());
        if name_end == name_start || !self.is_body_next(name_end) {
            return None;
        }
        let name = &self.bytes[name_start..name_end];
        self.at = self.next_token(name_end) + 1;
        self.warn(
            "no-class",
            "a body without a class name",
            "its contents were kept; write `DEF name ClassName { … }`",
            Span::new(name_start, name_end),
        );
        Some(self.open_node(b"", Some(name), name_start))
    }

    fn first_bracket(&self, start: usize, end: usize) -> usize {
        lex::name_end(&self.bytes[..end], start)
    }

    /// The name behind `USE`: up to the next blank, or up to a bracket glued to it.
    fn use_name(&mut self) -> (&'a [u8], Span) {
        let start = self.at;
        // Looks no further than an odd name can reach, so that many names without a blank
        // between them cost one pass.
        let reach = self.bytes.len().min(start + self.longest_odd_name + 1);
        let full = lex::to_blank(&self.bytes[..reach], start);
        let end = if self.odd_names.contains(&self.bytes[start..full]) {
            full
        } else {
            lex::name_end(self.bytes, start)
        };
        self.at = end;
        (&self.bytes[start..end], Span::new(start, end))
    }

    fn open_node(&mut self, class: &'a [u8], def: Option<&'a [u8]>, start: usize) -> Child<'a> {
        let id = NodeId(self.tree.nodes.len() as u32);
        let span = Span::new(start, self.at);
        self.tree.nodes.push(Node::new(class, def, span));
        if self.frames.len() >= self.limits.depth {
            self.skip_body();
            self.tree.nodes[id.0 as usize].span.end = self.at as u32;
            self.problem(
                Severity::Error,
                "too-deep",
                &format!("nodes are nested deeper than {} levels", self.limits.depth),
                "the contents of this node were skipped",
                span,
            );
        } else {
            let items = self.open_items.len();
            self.frames.push(Frame::Body { node: id, items });
        }
        Child::Node(id)
    }

    /// The string here, as by [`lex::string`]. Where one is not closed, none behind it is: that is
    /// found out once only.
    fn quoted(&mut self) -> (usize, usize, lex::StringEnd) {
        let found = if self.unclosed {
            lex::open_string(self.bytes, self.at)
        } else if self.vrml2 {
            lex::vrml_string(self.bytes, self.at)
        } else {
            lex::string(self.bytes, self.at)
        };
        self.unclosed |= found.2 != lex::StringEnd::Closed;
        found
    }

    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn skip_trivia(&mut self) {
        self.at = self.next_token(self.at);
    }

    /// Where the first token at or behind `at` begins.
    fn next_token(&self, at: usize) -> usize {
        if self.vrml2 {
            lex::skip_vrml_trivia(self.bytes, at)
        } else {
            lex::skip_trivia(self.bytes, at)
        }
    }

    /// The end of the identifier at `at`.
    fn name(&self, at: usize) -> Option<usize> {
        if self.vrml2 {
            lex::vrml_name(self.bytes, at)
        } else {
            lex::name(self.bytes, at)
        }
    }

    fn warn(&mut self, code: &'static str, message: &str, hint: &str, span: Span) {
        self.problem(Severity::Warning, code, message, hint, span);
    }

    fn problem(
        &mut self,
        severity: Severity,
        code: &'static str,
        message: &str,
        hint: &str,
        span: Span,
    ) {
        self.problems.add(severity, code, message, hint, span);
    }
}

#[cfg(test)]
pub(crate) mod tests;
