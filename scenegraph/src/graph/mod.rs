//! The typed scene graph: nodes in an arena, fields with typed values, sharing by equal handles.
//!
//! The graph owns all it holds; nothing of the text it was read from is needed any more. It is
//! acyclic: `USE` inside its own definition, files that include themselves and parts of kits that
//! hold their kit are refused when it is built.

mod defaults;
mod value;

use std::path::PathBuf;
use std::sync::Arc;

use iv_parser::{Diagnostic, Header, SourcePos};
use rustc_hash::FxHashMap;

use crate::font::AddedFont;
use crate::registry::Class;

pub use value::FieldValue;

/// Index of a [`Node`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub u32);

/// What a node is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A class of the registry.
    Known(Class),
    /// A class that is not known, by its name.
    Unknown(Arc<str>),
}

/// A value that the source gives for a field.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldEntry {
    /// Position in the class's field list.
    pub index: u16,
    /// Whether `~` was written: the field does not touch the state.
    pub ignored: bool,
    /// The value.
    pub value: FieldValue,
}

/// One node.
#[derive(Clone, Debug)]
pub struct Node {
    /// What it is.
    pub kind: Kind,
    /// DEF name without the `+N` suffix; `None` when there is none.
    pub name: Option<Arc<str>>,
    /// Fields that the source sets. All others have their defaults.
    pub fields: Vec<FieldEntry>,
    /// Children in order. For a `File`, the contents of the file; for an unknown class, what is
    /// to be drawn in its place.
    pub children: Vec<NodeId>,
    /// Where it stands.
    pub pos: SourcePos,
}

/// One file that was read.
#[derive(Clone, Debug)]
pub struct SourceFile {
    /// Name for display.
    pub name: Arc<str>,
    /// The folder it is in: where its own references are looked for first.
    pub folder: PathBuf,
    /// Its first line.
    pub header: Header,
}

/// A model as read.
#[derive(Clone, Debug)]
pub struct Graph {
    pub(crate) nodes: Vec<Node>,
    /// Components of the pictures of `ImageTexture`s, as far as they are known.
    pub(crate) pictures: FxHashMap<NodeId, u8>,
    /// The root: the only `Separator` at the top of the file, or one around all that is there.
    pub root: NodeId,
    /// The files read; the first is the one asked for.
    pub files: Vec<SourceFile>,
    /// Fonts that stand at hand besides the built-in ones.
    pub fonts: Vec<AddedFont>,
    /// What was wrong, file by file, in order of place.
    pub diagnostics: Vec<Diagnostic>,
}

impl Graph {
    /// A node.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0 as usize]
    }

    /// The names of fonts that nodes give, in their order.
    pub fn font_names(&self) -> impl Iterator<Item = &Arc<str>> {
        self.nodes.iter().flat_map(|node| {
            let field = match node.class() {
                Some(Class::Font | Class::FontStyle) => "name",
                Some(Class::VRMLFontStyle) => "family",
                _ => return &[][..],
            };
            node.entry(field).map_or(&[][..], |f| f.value.texts())
        })
    }

    /// All nodes, in the order in which they were read.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }
}

impl Node {
    /// The class, if it is of the registry.
    pub fn class(&self) -> Option<Class> {
        match self.kind {
            Kind::Known(class) => Some(class),
            Kind::Unknown(_) => None,
        }
    }

    /// Name of the class.
    pub fn class_name(&self) -> &str {
        match &self.kind {
            Kind::Known(class) => class.name(),
            Kind::Unknown(name) => name,
        }
    }

    fn find(&self, field: &str) -> Option<(Class, usize, Option<&FieldEntry>)> {
        let class = self.class()?;
        let (index, _) = class.spec().field(field.as_bytes())?;
        // The last one written wins.
        let entry = self
            .fields
            .iter()
            .rev()
            .find(|f| usize::from(f.index) == index);
        Some((class, index, entry))
    }

    /// The entry that the source gives for a field, if any.
    pub fn entry(&self, field: &str) -> Option<&FieldEntry> {
        self.find(field)?.2
    }

    /// Whether the field is marked `~`.
    pub fn is_ignored(&self, field: &str) -> bool {
        self.entry(field).is_some_and(|f| f.ignored)
    }

    /// The field's value, its default if the source gives none.
    pub fn value(&self, field: &str) -> &FieldValue {
        match self.find(field) {
            Some((_, _, Some(entry))) => &entry.value,
            Some((class, index, None)) => defaults::of(class, index),
            None => {
                debug_assert!(false, "{} has no field {field}", self.class_name());
                &FieldValue::None
            }
        }
    }

    /// The numbers of a field of any numeric type, flat.
    pub fn numbers(&self, field: &str) -> &[f64] {
        self.value(field).numbers()
    }

    /// A single number.
    pub fn number(&self, field: &str) -> f64 {
        self.numbers(field).first().copied().unwrap_or(0.0)
    }

    /// Three numbers.
    pub fn triple(&self, field: &str) -> [f64; 3] {
        match self.numbers(field) {
            [x, y, z, ..] => [*x, *y, *z],
            _ => [0.0; 3],
        }
    }

    /// A list of integers.
    pub fn ints(&self, field: &str) -> &[i32] {
        self.value(field).ints()
    }

    /// A single integer.
    pub fn int(&self, field: &str) -> i32 {
        self.ints(field).first().copied().unwrap_or(0)
    }

    /// A bool.
    pub fn flag(&self, field: &str) -> bool {
        matches!(self.value(field), FieldValue::Bool(true))
    }

    /// The word of an enum field, in Inventor's spelling; aliases give the word they stand for.
    pub fn word(&self, field: &str) -> &'static str {
        let Some((class, index, _)) = self.find(field) else {
            return "";
        };
        let FieldValue::Word(value) = self.value(field) else {
            return "";
        };
        let words = class.spec().fields[index].words;
        words
            .iter()
            .find(|w| w.value == *value)
            .map_or("", |w| w.name)
    }

    /// The bits of a bit mask field that `name` stands for are all set.
    pub fn has_bits(&self, field: &str, name: &str) -> bool {
        let Some((class, index, _)) = self.find(field) else {
            return false;
        };
        let FieldValue::Word(bits) = self.value(field) else {
            return false;
        };
        let wanted = class.spec().fields[index]
            .word(name.as_bytes())
            .unwrap_or(0);
        wanted != 0 && bits & wanted == wanted
    }

    /// A text field, or the first of a list of texts.
    pub fn text(&self, field: &str) -> Option<&Arc<str>> {
        self.value(field).texts().first()
    }

    /// All nodes that it holds: its children, then those in its fields.
    pub(crate) fn handles(&self) -> impl Iterator<Item = NodeId> {
        let in_fields = self.fields.iter().flat_map(|f| match &f.value {
            FieldValue::Nodes(nodes) => &nodes[..],
            _ => &[],
        });
        self.children.iter().chain(in_fields).copied()
    }

    /// A node field.
    pub fn node_field(&self, field: &str) -> Option<NodeId> {
        match self.value(field) {
            FieldValue::Nodes(nodes) => nodes.first().copied(),
            _ => None,
        }
    }
}
