//! The syntax tree: nodes, fields and values in an arena, with spans.
//!
//! Names are borrowed from the source. Numbers stand in bulk: a few in two pools, more in shared
//! arrays that later stages can take parts of without copying.

use std::borrow::Cow;

use crate::header::{Encoding, Header};
use crate::lex;
use crate::list::{List, Lists, Part};
use crate::number;
use crate::source::Span;
use crate::text::decode_string;

/// Index of a [`Node`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct NodeId(pub u32);

/// Index of a [`Field`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FieldId(pub u32);

/// Something that stands where a node can stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Child<'a> {
    /// A node written here.
    Node(NodeId),
    /// `USE name`.
    Use(&'a [u8], Span),
    /// `NULL`.
    Null,
}

/// One entry of a node's body, in source order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Item<'a> {
    /// A named value.
    Field(FieldId),
    /// A child node.
    Child(Child<'a>),
}

/// What a [`Node`] of the tree stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Form {
    /// A node.
    Node,
    /// VRML 2 `PROTO def [ … ] { … }`: the declarations of its interface, then its body. The class
    /// is `PROTO`.
    Proto,
    /// VRML 2 `EXTERNPROTO def [ … ] url`: the declarations, then a field `url`. The class is
    /// `EXTERNPROTO`.
    ExternProto,
    /// VRML 2 `ROUTE from TO to`: a field called `from` with the word `to`. The class is `ROUTE`.
    Route,
}

/// How others reach what a VRML 2 prototype or script declares.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Access {
    /// `field`
    Field,
    /// `exposedField`
    ExposedField,
    /// `eventIn`
    EventIn,
    /// `eventOut`
    EventOut,
}

impl Access {
    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Field => "field",
            Self::ExposedField => "exposedField",
            Self::EventIn => "eventIn",
            Self::EventOut => "eventOut",
        }
    }

    pub(crate) fn from_word(word: &[u8]) -> Option<Self> {
        let all = [
            Self::Field,
            Self::ExposedField,
            Self::EventIn,
            Self::EventOut,
        ];
        all.into_iter().find(|a| a.word().as_bytes() == word)
    }

    /// Whether it holds a value.
    pub fn has_value(self) -> bool {
        matches!(self, Self::Field | Self::ExposedField)
    }
}

/// What stands before the name of a declared field: `exposedField SFColor color 1 0 0`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Declaration<'a> {
    /// How it is reached.
    pub access: Access,
    /// Name of the field type.
    pub field_type: &'a [u8],
}

/// `DEF name Class { … }`, or a statement of VRML 2 that stands where a node can stand.
#[derive(Clone, Debug)]
pub struct Node<'a> {
    /// What it stands for.
    pub form: Form,
    /// Class name; empty for a body that stands without one.
    pub class: &'a [u8],
    /// The name behind `DEF`, with any `+N` suffix.
    pub def: Option<&'a [u8]>,
    /// From the class name to the closing brace.
    pub span: Span,
    items: (u32, u32),
}

/// `name value ~ = master . field`.
#[derive(Clone, Debug)]
pub struct Field<'a> {
    /// Field name.
    pub name: &'a [u8],
    /// The value written.
    pub value: Value,
    /// Whether `~` follows.
    pub ignored: bool,
    /// What it is connected to.
    pub connection: Option<Box<Connection<'a>>>,
    /// Name and value.
    pub span: Span,
}

/// The master of a connected field.
#[derive(Clone, Debug)]
pub struct Connection<'a> {
    /// The node that owns the master field.
    pub master: Child<'a>,
    /// Name of the master field or engine output.
    pub output: &'a [u8],
}

/// A field's value as written.
#[derive(Clone, Debug)]
pub enum Value {
    /// None at all.
    Missing,
    /// Numbers only.
    Numbers {
        /// The numbers.
        numbers: Numbers,
        /// Whether they stand in `[ ]`.
        bracketed: bool,
        /// Whether a token has a leading zero, so that an integer field must read the text again.
        octal: bool,
        /// From the first to the last number.
        span: Span,
    },
    /// Anything else: one atom without brackets, or any number in `[ ]`.
    Atoms {
        /// Range of the tree's atoms.
        atoms: (u32, u32),
        /// Whether they stand in `[ ]`.
        bracketed: bool,
    },
    /// `( A | B )`: a range of word atoms.
    Mask((u32, u32)),
    /// VRML 2 `IS name`: a range of one word atom, the name of what a prototype declares.
    Is((u32, u32)),
}

/// A run of numbers.
#[derive(Clone, Copy, Debug)]
pub enum Numbers {
    /// Range of the tree's integers.
    Ints(u32, u32),
    /// Range of the tree's floats.
    Floats(u32, u32),
    /// Many integers.
    ManyInts(Part),
    /// Many floats.
    ManyFloats(Part),
}

/// A single value in a list that is not all numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Atom<'a> {
    /// A number.
    Number(f64, Span),
    /// The raw text between quotes; of a binary file, the string itself. See [`Tree::string`].
    String(&'a [u8], Span),
    /// An unquoted word.
    Word(&'a [u8], Span),
    /// A node, `USE` or `NULL`.
    Child(Child<'a>),
}

/// A parsed file.
#[derive(Clone, Debug)]
pub struct Tree<'a> {
    /// The text it was read from.
    pub source: &'a [u8],
    /// What the first line says.
    pub header: Header,
    pub(crate) nodes: Vec<Node<'a>>,
    pub(crate) fields: Vec<Field<'a>>,
    pub(crate) items: Vec<Item<'a>>,
    pub(crate) atoms: Vec<Atom<'a>>,
    pub(crate) ints: Vec<i32>,
    pub(crate) floats: Vec<f64>,
    pub(crate) int_lists: Lists<i32>,
    pub(crate) float_lists: Lists<f64>,
    pub(crate) roots: Vec<Child<'a>>,
    /// In order of their fields.
    pub(crate) declarations: Vec<(FieldId, Declaration<'a>)>,
}

/// Runs at least this long can be passed on without copying: more than a value of a field that
/// takes one value has, but for matrices.
const MANY: usize = 5;

impl<'a> Node<'a> {
    pub(crate) fn new(class: &'a [u8], def: Option<&'a [u8]>, span: Span) -> Self {
        Self {
            form: Form::Node,
            class,
            def,
            span,
            items: (0, 0),
        }
    }

    pub(crate) fn set_items(&mut self, start: usize, end: usize) {
        self.items = (start as u32, end as u32);
    }
}

impl<'a> Tree<'a> {
    pub(crate) fn new(source: &'a [u8], header: Header) -> Self {
        Self {
            source,
            header,
            nodes: Vec::new(),
            fields: Vec::new(),
            items: Vec::new(),
            atoms: Vec::new(),
            ints: Vec::new(),
            floats: Vec::new(),
            int_lists: Lists::default(),
            float_lists: Lists::default(),
            roots: Vec::new(),
            declarations: Vec::new(),
        }
    }

    /// Keeps a run of integers, and leaves the buffer empty.
    pub(crate) fn add_ints(&mut self, run: &mut Vec<i32>) -> Numbers {
        if run.len() >= MANY {
            let part = self.int_lists.add(run);
            run.clear();
            return Numbers::ManyInts(part);
        }
        let start = self.ints.len() as u32;
        self.ints.append(run);
        Numbers::Ints(start, self.ints.len() as u32)
    }

    /// Keeps a run of floats, and leaves the buffer empty.
    pub(crate) fn add_floats(&mut self, run: &mut Vec<f64>) -> Numbers {
        if run.len() >= MANY {
            let part = self.float_lists.add(run);
            run.clear();
            return Numbers::ManyFloats(part);
        }
        let start = self.floats.len() as u32;
        self.floats.append(run);
        Numbers::Floats(start, self.floats.len() as u32)
    }

    /// The bytes that a string of this tree means. Text has escapes, binary files have none.
    pub fn string<'s>(&self, raw: &'s [u8]) -> Cow<'s, [u8]> {
        match self.header.encoding {
            Encoding::Binary => Cow::Borrowed(raw),
            Encoding::Ascii => decode_string(raw, self.header.dialect),
        }
    }

    /// What stands at the top level.
    pub fn children_of_root(&self) -> &[Child<'a>] {
        &self.roots
    }

    /// A node.
    pub fn node(&self, id: NodeId) -> &Node<'a> {
        &self.nodes[id.0 as usize]
    }

    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// A field.
    pub fn field(&self, id: FieldId) -> &Field<'a> {
        &self.fields[id.0 as usize]
    }

    /// What declares a field, if it belongs to the interface of a VRML 2 prototype or script.
    pub fn declaration(&self, id: FieldId) -> Option<&Declaration<'a>> {
        let at = self.declarations.binary_search_by_key(&id.0, |d| d.0.0);
        at.ok().map(|i| &self.declarations[i].1)
    }

    /// A node's body.
    pub fn items(&self, id: NodeId) -> &[Item<'a>] {
        let (start, end) = self.node(id).items;
        &self.items[start as usize..end as usize]
    }

    /// The atoms of a value.
    pub fn atoms(&self, range: (u32, u32)) -> &[Atom<'a>] {
        &self.atoms[range.0 as usize..range.1 as usize]
    }

    /// The numbers as integers, if all are written as such.
    pub fn ints(&self, numbers: &Numbers) -> Option<&[i32]> {
        match numbers {
            Numbers::Ints(start, end) => Some(&self.ints[*start as usize..*end as usize]),
            Numbers::ManyInts(part) => Some(self.int_lists.values(*part)),
            _ => None,
        }
    }

    /// The numbers as floats, if at least one is written as such.
    pub fn floats(&self, numbers: &Numbers) -> Option<&[f64]> {
        match numbers {
            Numbers::Floats(start, end) => Some(&self.floats[*start as usize..*end as usize]),
            Numbers::ManyFloats(part) => Some(self.float_lists.values(*part)),
            _ => None,
        }
    }

    /// Many integers, shared with the tree.
    pub fn many_ints(&self, numbers: &Numbers) -> Option<List<i32>> {
        match numbers {
            Numbers::ManyInts(part) => Some(self.int_lists.share(*part)),
            _ => None,
        }
    }

    /// Many floats, shared with the tree.
    pub fn many_floats(&self, numbers: &Numbers) -> Option<List<f64>> {
        match numbers {
            Numbers::ManyFloats(part) => Some(self.float_lists.share(*part)),
            _ => None,
        }
    }

    /// How many numbers.
    pub fn count(&self, numbers: &Numbers) -> usize {
        match numbers {
            Numbers::Ints(start, end) | Numbers::Floats(start, end) => (end - start) as usize,
            Numbers::ManyInts(part) | Numbers::ManyFloats(part) => part.len(),
        }
    }

    /// The integers of `span` read again by C's rules, where `010` is 8. Costs a pass over the text.
    pub fn octal_ints(&self, span: Span) -> Vec<i64> {
        let text = &self.source[span.range()];
        let mut values = Vec::new();
        let mut at = 0;
        loop {
            at = lex::skip_trivia(text, at);
            match number::number(text, at) {
                Some((_, end, _)) => {
                    values.push(number::octal_aware(&text[at..end]));
                    at = end;
                }
                None if at < text.len() => at += 1,
                None => return values,
            }
        }
    }
}
