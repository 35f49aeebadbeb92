//! A tree as a binary file of the version that its header tells.
//!
//! Fields go before children. What the format has no room for is left out and told: see
//! [`print_binary`].

mod fields;
mod round;
mod value;

use std::io::{self, Write};

use super::Schema;
use crate::diagnostic::Severity;
use crate::header::{Dialect, Header};
use crate::source::{Problem, Span};
use crate::tree::{Child, Field, Item, NodeId, Tree};

use fields::Fields;
use round::Rounding;

/// Problems told of one tree; what else is left out is not counted.
const MOST_PROBLEMS: usize = 200;

/// Whether files of this kind have a binary form: all of Inventor, none of VRML.
pub fn has_binary_form(header: &Header) -> bool {
    header.dialect == Dialect::Inventor
}

/// Writes the whole tree as a binary file, header first, in the layout of its version. Returns
/// what is not in it, in the order of the file:
///
/// - `rounded`, once: numbers of more digits than a float of 32 bits keeps;
/// - `not-in-binary`: fields whose type nobody knows, values that do not fit their field, children
///   of what is no group;
/// - `field-moved`: a field with nodes that stood behind children, where a `USE` in it may mean
///   another node now.
///
/// # Errors
///
/// Those of `out`, and [`io::ErrorKind::Unsupported`] where [`has_binary_form`] says no.
pub fn print_binary(
    tree: &Tree<'_>,
    schema: &dyn Schema,
    out: &mut dyn Write,
) -> io::Result<Vec<Problem>> {
    if !has_binary_form(&tree.header) {
        let why = "VRML has no binary form";
        return Err(io::Error::new(io::ErrorKind::Unsupported, why));
    }
    let (major, minor) = tree.header.version;
    let mut header = format!("#Inventor V{major}.{minor} binary");
    while !(header.len() + 1).is_multiple_of(4) {
        header.push(' ');
    }
    writeln!(out, "{header}")?;
    let mut writer = Writer {
        tree,
        schema,
        out,
        steps: Vec::new(),
        problems: Vec::new(),
        rounding: Rounding::default(),
    };
    for &root in tree.children_of_root() {
        writer.steps.push(Step::Child(root));
        writer.run()?;
    }
    writer.problems.extend(writer.rounding.problem());
    let mut problems = writer.problems;
    problems.sort_by_key(|problem| problem.span.start);
    Ok(problems)
}

/// What is left to write, last first.
enum Step<'t, 'a> {
    Child(Child<'a>),
    /// The fields from the given one on.
    Fields(Fields<'t, 'a>, usize),
    /// Behind a field's value: its flags, and whether the value is a default.
    Tail(&'t Field<'a>, bool),
    /// The name of a master's field.
    Output(&'a [u8]),
    Children(NodeId),
    Word(u32),
}

struct Writer<'t, 'a, 'o> {
    tree: &'t Tree<'a>,
    schema: &'o dyn Schema,
    out: &'o mut dyn Write,
    steps: Vec<Step<'t, 'a>>,
    problems: Vec<Problem>,
    rounding: Rounding,
}

/// Appends a word.
fn put_word(out: &mut Vec<u8>, word: u32) {
    out.extend_from_slice(&word.to_be_bytes());
}

/// Appends a string, padded to whole words.
fn put_string(out: &mut Vec<u8>, bytes: &[u8]) {
    put_word(out, bytes.len() as u32);
    out.extend_from_slice(bytes);
    pad(out, bytes.len());
}

/// Fills up `len` bytes to whole words.
fn pad(out: &mut Vec<u8>, len: usize) {
    out.extend(std::iter::repeat_n(0, len.next_multiple_of(4) - len));
}

impl<'t, 'a> Writer<'t, 'a, '_> {
    fn run(&mut self) -> io::Result<()> {
        while let Some(step) = self.steps.pop() {
            match step {
                Step::Child(child) => self.child(child)?,
                Step::Fields(fields, next) => self.field(fields, next)?,
                Step::Tail(field, is_default) => self.tail(field, is_default)?,
                Step::Output(name) => self.string(name)?,
                Step::Children(id) => self.children(id)?,
                Step::Word(word) => self.word(word)?,
            }
        }
        Ok(())
    }

    fn word(&mut self, word: u32) -> io::Result<()> {
        self.out.write_all(&word.to_be_bytes())
    }

    fn string(&mut self, bytes: &[u8]) -> io::Result<()> {
        let mut out = Vec::with_capacity(bytes.len() + 8);
        put_string(&mut out, bytes);
        self.out.write_all(&out)
    }

    /// Whether nodes have flags, and a number of fields whatever their class.
    fn is_new(&self) -> bool {
        self.tree.header.version > (2, 0)
    }

    fn child(&mut self, child: Child<'a>) -> io::Result<()> {
        let id = match child {
            Child::Null => return self.string(b"NULL"),
            Child::Use(name, _) => {
                self.string(b"USE")?;
                return self.string(name);
            }
            Child::Node(id) => id,
        };
        let node = self.tree.node(id);
        if let Some(name) = node.def {
            self.string(b"DEF")?;
            self.string(name)?;
        }
        let class = if node.class.is_empty() {
            b"Group"
        } else {
            node.class
        };
        self.string(class)?;
        if class == b"Path" {
            return self.path(id);
        }
        let fields = self.fields_of(id, class);
        self.head(class, &fields)?;
        if fields.is_group {
            self.steps.push(Step::Children(id));
        }
        self.steps.push(Step::Fields(fields, 0));
        Ok(())
    }

    /// A path: its first node. The steps from there are not in the tree.
    fn path(&mut self, id: NodeId) -> io::Result<()> {
        if self.is_new() {
            self.word(0)?;
        }
        let first = self.children_of(id).next().unwrap_or(Child::Null);
        self.steps.push(Step::Word(0));
        self.steps.push(Step::Child(first));
        Ok(())
    }

    fn children_of(&self, id: NodeId) -> impl DoubleEndedIterator<Item = Child<'a>> + use<'t, 'a> {
        let items = self.tree.items(id).iter();
        items.filter_map(|item| match item {
            Item::Child(child) => Some(*child),
            Item::Field(_) => None,
        })
    }

    fn children(&mut self, id: NodeId) -> io::Result<()> {
        self.word(self.children_of(id).count() as u32)?;
        if self.tree.header.version < (2, 0) {
            self.steps.push(Step::Word(u32::MAX));
        }
        let children = self.children_of(id).rev();
        self.steps.extend(children.map(Step::Child));
        Ok(())
    }

    fn problem(&mut self, code: &'static str, message: String, hint: &str, span: Span) {
        if self.problems.len() < MOST_PROBLEMS {
            self.problems.push(Problem {
                severity: Severity::Warning,
                code,
                message,
                hint: hint.to_owned(),
                span,
            });
        }
    }
}

#[cfg(test)]
mod tests;
