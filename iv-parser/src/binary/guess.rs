//! Guesses: where a value ends that nobody knows the type of, by what follows it; what is a node;
//! and the type of a value that has none yet.

use super::value::{ALL_FLAGS, IS_CONNECTED};
use super::words::{Words, is_name};
use super::{Frame, Reader, ValueKind, ValueType};
use crate::tree::{Atom, Tree, Value};

/// Lengths of single values, and of the values of lists, that are tried in this order: one, three,
/// two, four and sixteen floats.
const SIZES: [usize; 5] = [4, 12, 8, 16, 64];

/// Longest list of texts that is tried, as each of them must be looked at.
const MOST_TEXTS: u32 = 64;

impl Reader<'_, '_> {
    /// The end of the value here, by what follows it: the first of the usual layouts behind which
    /// the file goes on as it should.
    pub(super) fn guess_end(&self) -> Option<usize> {
        let here = self.words;
        let counted = |size: usize| {
            let mut words = here;
            let count = words.count(size).filter(|count| *count > 0)?;
            words.items(count as usize, size)?;
            Some(words.at)
        };
        let single = |size: usize| {
            let mut words = here;
            words.take(size).map(|_| words.at)
        };
        let text = || {
            let mut words = here;
            words.string().map(|_| words.at)
        };
        let texts = || {
            let mut words = here;
            for _ in 0..words.count(4).filter(|count| *count <= MOST_TEXTS)? {
                words.string()?;
            }
            Some(words.at)
        };
        let lists = SIZES.into_iter().map(counted);
        let singles = SIZES.into_iter().map(single);
        let ends = std::iter::once_with(text)
            .chain(lists)
            .chain(std::iter::once_with(texts))
            .chain(singles);
        ends.flatten().find(|&end| self.follows(end))
    }

    /// Whether the flags of a field stand at `at`, and behind them what must follow.
    pub(super) fn follows(&self, at: usize) -> bool {
        let mut words = self.words.from(at);
        match words.word() {
            Some(flags) if flags & IS_CONNECTED != 0 => flags <= ALL_FLAGS && self.is_node(words),
            Some(flags) => flags <= ALL_FLAGS && self.continues(words),
            None => false,
        }
    }

    /// Whether what is open goes on at `words`.
    fn continues(&self, mut words: Words<'_>) -> bool {
        for frame in self.frames.iter().rev() {
            match *frame {
                Frame::Head { .. } => return false,
                Frame::Fields(body) if body.fields_left > 0 => {
                    let class = self.tree.node(body.node).class;
                    let mut described = self.described[body.described..].iter();
                    return words.name().is_some_and(|name| {
                        self.schema.field(class, name, &self.header).is_some()
                            || described.any(|(known, _)| *known == name)
                            || self.schema.class(class, &self.header).is_none()
                    });
                }
                Frame::Fields(body) => {
                    let is_group = match body.is_group {
                        Some(is_group) => is_group,
                        None => self.are_children(words),
                    };
                    if is_group {
                        return self.are_children(words);
                    }
                }
                Frame::Children { left, .. } => {
                    if left > 0 {
                        return self.is_node(words);
                    }
                    if self.header.version < (2, 0) {
                        return words.word() == Some(u32::MAX);
                    }
                }
                Frame::Nodes { left, .. } if left > 0 => return self.is_node(words),
                Frame::Nodes { .. } => {
                    return words.word().is_some_and(|flags| flags <= ALL_FLAGS);
                }
                Frame::Master(_) => return words.name().is_some(),
                Frame::Path { .. } => return words.count(4).is_some(),
            }
        }
        words.left() < 4 || self.is_node(words)
    }

    /// Whether the number of children stands here, of a node whose frame has been taken from the
    /// stack. A 0 is one if nothing that is open goes on with it.
    pub(super) fn children_here(&self) -> bool {
        let mut ahead = self.words;
        match ahead.word() {
            Some(0) => !self.continues(self.words),
            _ => self.are_children(self.words),
        }
    }

    fn are_children(&self, mut words: Words<'_>) -> bool {
        match words.word() {
            Some(0) => true,
            Some(_) => self.is_node(words),
            None => false,
        }
    }

    /// Whether a node, or what stands for one, begins here.
    pub(super) fn is_node(&self, mut words: Words<'_>) -> bool {
        match words.name() {
            Some(b"NULL") => true,
            Some(b"USE") => is_def(words.string()),
            Some(b"DEF") => {
                is_def(words.string()) && words.name().is_some_and(|name| self.is_head(name, words))
            }
            Some(class) => self.is_head(class, words),
            None => false,
        }
    }

    /// Whether what follows a class name can be the head of a node of that class.
    fn is_head(&self, class: &[u8], mut words: Words<'_>) -> bool {
        let shape = self.schema.class(class, &self.header);
        if self.header.version > (2, 0) {
            let (flags, fields) = (words.word(), words.word());
            let is_described = fields.is_some_and(|fields| fields & 0x4000 != 0);
            return flags.is_some_and(|flags| flags <= 3)
                && fields.is_some_and(|fields| fields & !0x40ff == 0)
                && (shape.is_some() || is_described);
        }
        let is_described = words.skip_string(b"fields") || words.skip_string(b"inputs");
        match shape {
            Some(shape) if shape.has_fields && !is_described => match words.word() {
                Some(0) => true,
                Some(..=0xff) => words.name().is_some(),
                _ => false,
            },
            Some(_) => true,
            None => is_described,
        }
    }
}

/// Whether this can be the name of a definition.
fn is_def(name: Option<&[u8]>) -> bool {
    name.is_some_and(|name| {
        let is_shown = |b: &u8| *b > b' ' && *b != 0x7f;
        !name.is_empty() && (is_name(name) || name.iter().all(is_shown))
    })
}

/// The type that a value of text most likely has, for a node that describes its fields.
pub(super) fn guess_type(tree: &Tree<'_>, value: &Value) -> Option<ValueType> {
    let of = |kind, size, is_list| {
        Some(ValueType {
            kind,
            size,
            is_list,
        })
    };
    match value {
        Value::Missing | Value::Mask(_) | Value::Is(_) => None,
        Value::Numbers {
            numbers, bracketed, ..
        } => {
            let kind = match tree.ints(numbers) {
                Some(_) => ValueKind::Int,
                None => ValueKind::Float,
            };
            match tree.count(numbers) {
                _ if *bracketed => of(kind, 1, true),
                1 => of(kind, 1, false),
                // There are types of two to four and of sixteen floats.
                size @ (2..=4 | 16) => of(ValueKind::Float, size as u8, false),
                _ => of(kind, 1, true),
            }
        }
        Value::Atoms { atoms, bracketed } => {
            let kind = match tree.atoms(*atoms).first()? {
                Atom::String(..) => ValueKind::Text,
                Atom::Child(_) => ValueKind::Node,
                Atom::Number(..) => ValueKind::Float,
                Atom::Word(b"TRUE" | b"FALSE", _) => ValueKind::Flag,
                Atom::Word(..) => ValueKind::Text,
            };
            of(kind, 1, *bracketed)
        }
    }
}
