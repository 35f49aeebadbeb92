//! Binary Inventor files, read and written: the same tree as of text.
//!
//! All is made of big-endian words of four bytes and strings padded to whole words:
//!
//! ```text
//! node   "NULL" | "USE" name | [ "DEF" name ] class head fields [ children ]
//! head   2.1: flags (1 engine, 2 group), number of fields | 0x4000 if described
//!        older: the number of fields, unless the class has none at all
//!        described (2.1) or unknown (older): the types and names of all fields
//! field  name, value, flags (1 ignored, 2 connected, 4 default) [ master node, output ]
//! list   count, values
//! group  number of children, children; in 1.0 then the word -1
//! ```
//!
//! No value says how long it is: that takes a [`Schema`]. Reading is total, as it is for text:
//! `recover` goes on behind what cannot be read. Nesting lives on a stack of [`Frame`]s, and each
//! step takes bytes or a frame, so reading ends.
//!
//! Source: SGI's `SoInput`, `SoBase`, `SoFieldData` and `SoGroup`, where Coin differs.

mod guess;
mod head;
mod image;
mod numbers;
mod recover;
mod schema;
mod value;
mod words;
mod write;

use guess::guess_type;
pub use schema::{ClassShape, Schema, ValueKind, ValueType};
pub use write::{has_binary_form, print_binary};

use crate::diagnostic::Severity;
use crate::header::Header;
use crate::limits::Limits;
use crate::parse::Parse;
use crate::source::{Problem, Problems, Span};
use crate::tree::{Atom, Child, FieldId, Item, NodeId, Tree};

use words::Words;

/// Reads what stands behind the header, which ends with its line.
pub(crate) fn parse_binary<'a>(
    bytes: &'a [u8],
    header_start: usize,
    header: Header,
    schema: &dyn Schema,
    limits: &Limits,
    problems: Vec<Problem>,
) -> Parse<'a> {
    let readable = &bytes[..bytes.len().min(limits.bytes)];
    let body = readable.get(header_start..).unwrap_or_default();
    let line_end = body.iter().position(|&b| b == b'\n');
    let start = line_end.map_or(readable.len(), |end| header_start + end + 1);
    let mut reader = Reader {
        words: Words::new(readable, start),
        schema,
        header,
        limits: *limits,
        tree: Tree::new(bytes, header),
        frames: Vec::new(),
        depth: 0,
        open_items: Vec::new(),
        open_atoms: Vec::new(),
        described: Vec::new(),
        ints: Vec::new(),
        floats: Vec::new(),
        problems: Problems::new(problems, limits.problems),
        not_finite_reported: false,
    };
    if bytes.len() > limits.bytes {
        reader.problem(
            Severity::Error,
            "too-large",
            "the file is longer than can be read",
            "only the beginning was read; split the model into several files",
            Span::default(),
        );
    }
    reader.run();
    reader.tree.int_lists.close();
    reader.tree.float_lists.close();
    Parse {
        tree: reader.tree,
        problems: reader.problems.list,
        problems_dropped: reader.problems.dropped,
    }
}

/// A node whose fields are being read.
#[derive(Clone, Copy, Debug)]
struct Body {
    node: NodeId,
    /// Where its items begin on the stack of open items.
    items: usize,
    fields_left: u32,
    /// Whether children follow; `None` for a class that nobody knows, in an old file.
    is_group: Option<bool>,
    /// Where its own descriptions of fields begin.
    described: usize,
    /// The type of fields that nobody describes: what an engine of any type is of.
    any_type: Option<ValueType>,
}

/// What is being read.
#[derive(Clone, Copy, Debug)]
enum Frame {
    /// What stands before the fields of a node.
    Head { node: NodeId, items: usize },
    /// The fields of a node.
    Fields(Body),
    /// Its children.
    Children {
        node: NodeId,
        items: usize,
        left: u32,
    },
    /// The nodes that are a field's value.
    Nodes {
        field: FieldId,
        atoms: usize,
        left: u32,
        is_list: bool,
    },
    /// The node that a field is connected to.
    Master(FieldId),
    /// A path behind its first node.
    Path { node: NodeId, items: usize },
}

/// Why reading cannot go on here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fault {
    /// The file ends.
    End,
    /// This is not what it should be.
    Bad(&'static str),
}

struct Reader<'a, 's> {
    words: Words<'a>,
    schema: &'s dyn Schema,
    header: Header,
    limits: Limits,
    tree: Tree<'a>,
    frames: Vec<Frame>,
    /// Open nodes.
    depth: usize,
    open_items: Vec<Item<'a>>,
    open_atoms: Vec<Atom<'a>>,
    /// Names and types of fields that nodes describe themselves.
    described: Vec<(&'a [u8], Option<ValueType>)>,
    /// Buffers for the numbers being read.
    ints: Vec<i32>,
    floats: Vec<f64>,
    problems: Problems,
    not_finite_reported: bool,
}

impl<'a> Reader<'a, '_> {
    fn run(&mut self) {
        loop {
            let start = self.words.at;
            let step = match self.frames.last().copied() {
                None if self.words.left() < 4 => return,
                None => self.root_step(),
                Some(Frame::Head { node, items }) => self.head(node, items),
                Some(Frame::Fields(body)) => self.fields_step(body),
                Some(Frame::Children { node, items, left }) => {
                    self.children_step(node, items, left)
                }
                Some(Frame::Nodes {
                    field,
                    atoms,
                    left,
                    is_list,
                }) => self.nodes_step(field, atoms, left, is_list),
                Some(Frame::Master(field)) => self.master_output(field),
                Some(Frame::Path { node, items }) => self.path_end(node, items),
            };
            if let Err(fault) = step {
                self.recover(fault, start);
            }
        }
    }

    fn root_step(&mut self) -> Result<(), Fault> {
        // Inventor 1.0 ends files with the word that ends groups.
        let mut ahead = self.words;
        if ahead.word() == Some(u32::MAX) && ahead.left() == 0 {
            self.words = ahead;
            return Ok(());
        }
        let child = self.child(false)?;
        self.tree.roots.push(child);
        Ok(())
    }

    fn children_step(&mut self, node: NodeId, items: usize, left: u32) -> Result<(), Fault> {
        if let Some(Frame::Children { left, .. }) = self.frames.last_mut()
            && let Some(less) = left.checked_sub(1)
        {
            *left = less;
            self.child(true)?;
            return Ok(());
        }
        debug_assert_eq!(left, 0);
        self.frames.pop();
        self.close_node(node, items);
        self.group_end();
        Ok(())
    }

    /// The word that ends a group in Inventor 1.0.
    fn group_end(&mut self) {
        let mut ahead = self.words;
        if self.header.version < (2, 0) && ahead.word() == Some(u32::MAX) {
            self.words = ahead;
        }
    }

    /// One node, or what stands for one; a node's frame is on the stack then. As an item of the
    /// node around it, it is put among the open items.
    fn child(&mut self, as_item: bool) -> Result<Child<'a>, Fault> {
        let start = self.words.at;
        let first = self.words.name().ok_or_else(|| self.fault("a node"))?;
        let child = match first {
            b"NULL" => Child::Null,
            b"USE" => {
                let name = self.words.string();
                let name = name.ok_or_else(|| self.fault("a name"))?;
                Child::Use(name, self.span_from(start))
            }
            b"DEF" => {
                let name = self.words.string();
                let name = name.ok_or_else(|| self.fault("a name"))?;
                let class = self.words.name();
                let class = class.ok_or_else(|| self.fault("a class"))?;
                let name = (!name.is_empty()).then_some(name);
                Child::Node(self.new_node(class, name, start))
            }
            class => Child::Node(self.new_node(class, None, start)),
        };
        if as_item {
            self.open_items.push(Item::Child(child));
        }
        if let Child::Node(node) = child {
            self.depth += 1;
            self.frames.push(Frame::Head {
                node,
                items: self.open_items.len(),
            });
        }
        Ok(child)
    }

    /// What is wrong here, where `wanted` should be.
    fn fault(&self, wanted: &'static str) -> Fault {
        if self.words.left() < 4 {
            Fault::End
        } else {
            Fault::Bad(wanted)
        }
    }

    fn span_from(&self, start: usize) -> Span {
        Span::new(start, self.words.at)
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
mod testing;
#[cfg(test)]
mod tests;
