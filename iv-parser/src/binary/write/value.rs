//! Values as bytes.

use std::borrow::Cow;

use super::{Writer, pad, put_string, put_word};
use crate::binary::{ValueKind, ValueType};
use crate::parse;
use crate::tree::{Atom, Child, Field, Item, Tree, Value};

/// A value that can be written.
pub(super) enum Encoded<'a> {
    /// At once.
    Bytes(Vec<u8>),
    /// Node by node.
    Nodes {
        nodes: Vec<Child<'a>>,
        is_list: bool,
    },
}

impl<'a> Writer<'_, 'a, '_> {
    /// The value of a field; `None` if it is not of the type that the field is stored as.
    pub(super) fn encoded(
        &mut self,
        class: &[u8],
        field: &Field<'a>,
        stored: ValueType,
    ) -> Option<Encoded<'a>> {
        let tree = self.tree;
        let value = &field.value;
        if stored.kind == ValueKind::Node {
            return nodes(tree, value, stored.is_list);
        }
        let mut out = Vec::new();
        match stored.kind {
            ValueKind::Nothing | ValueKind::Node => {}
            ValueKind::Flag => each(&mut out, stored, flags(tree, value)?, |out, flag| {
                put_word(out, u32::from(flag));
            })?,
            ValueKind::Text => each(&mut out, stored, texts(tree, value)?, |out, text| {
                put_string(out, &text);
            })?,
            ValueKind::Word => each(&mut out, stored, words(tree, value)?, put_string)?,
            ValueKind::Mask => {
                for word in words(tree, value)? {
                    put_string(&mut out, word);
                }
                put_string(&mut out, b"");
            }
            ValueKind::Image => self.image(value, 2, &mut out)?,
            ValueKind::Volume => self.image(value, 3, &mut out)?,
            ValueKind::Float | ValueKind::Double => {
                let all = floats(tree, value)?;
                let used = used(all.len(), stored)?;
                self.told_surplus(class, field, all.len() - used);
                put_count(&mut out, used, stored);
                if stored.kind == ValueKind::Double {
                    out.extend(all[..used].iter().flat_map(|value| value.to_be_bytes()));
                } else {
                    self.rounding.put(&all[..used], field.span, &mut out);
                }
            }
            ValueKind::Int | ValueKind::Unsigned | ValueKind::Wide => {
                let all = ints(tree, value)?;
                let used = used(all.len(), stored)?;
                self.told_surplus(class, field, all.len() - used);
                put_count(&mut out, used, stored);
                for value in &all[..used] {
                    match stored.kind {
                        ValueKind::Wide => out.extend(value.to_be_bytes()),
                        _ => put_word(&mut out, *value as u32),
                    }
                }
            }
        }
        Some(Encoded::Bytes(out))
    }

    /// The value to write where the tree has none.
    pub(super) fn default_value(
        &mut self,
        class: &[u8],
        name: &[u8],
        stored: ValueType,
    ) -> Option<Encoded<'a>> {
        if stored.kind == ValueKind::Node {
            let nodes = if stored.is_list {
                Vec::new()
            } else {
                vec![Child::Null]
            };
            let is_list = stored.is_list;
            return Some(Encoded::Nodes { nodes, is_list });
        }
        let known = self.schema.default_text(class, name, &self.tree.header);
        let text = format!("X {{ x {} }}", known.unwrap_or_default());
        let parsed = parse(text.as_bytes());
        let field = parsed
            .tree
            .children_of_root()
            .first()
            .and_then(|child| match child {
                Child::Node(id) => parsed.tree.items(*id).first(),
                _ => None,
            });
        if let Some(Item::Field(field)) = field {
            // Nothing of a default is lost, and it holds no node.
            let mut nowhere = Writer {
                tree: &parsed.tree,
                schema: self.schema,
                out: &mut std::io::sink(),
                steps: Vec::new(),
                problems: Vec::new(),
                rounding: super::Rounding::default(),
            };
            if let Some(Encoded::Bytes(bytes)) =
                nowhere.encoded(class, parsed.tree.field(*field), stored)
            {
                return Some(Encoded::Bytes(bytes));
            }
        }
        let words = match stored.kind {
            _ if stored.is_list => 1,
            ValueKind::Nothing => 0,
            ValueKind::Image => 3,
            ValueKind::Volume => 4,
            ValueKind::Double | ValueKind::Wide => 2 * usize::from(stored.size),
            _ => usize::from(stored.size),
        };
        Some(Encoded::Bytes(vec![0; 4 * words]))
    }

    fn told_surplus(&mut self, class: &[u8], field: &Field<'_>, surplus: usize) {
        if surplus > 0 {
            let why = format!("{surplus} numbers too many for it are left out");
            self.left_out_part(class, field, &why);
        }
    }

    fn left_out_part(&mut self, class: &[u8], field: &Field<'_>, why: &str) {
        let message = format!(
            "not all of `{}.{}` is in the binary file: {why}",
            crate::text_of(class),
            crate::text_of(field.name)
        );
        self.problem("not-in-binary", message, "", field.span);
    }

    /// A picture of so many dimensions.
    fn image(&self, value: &Value, dimensions: usize, out: &mut Vec<u8>) -> Option<()> {
        let all = ints(self.tree, value)?;
        let (head, pixels) = all.split_at_checked(dimensions + 1)?;
        let components = usize::try_from(head[dimensions]).ok().filter(|n| *n <= 4)?;
        let mut count = usize::from(components > 0);
        for &size in &head[..dimensions] {
            count = count.checked_mul(usize::try_from(size).ok()?)?;
        }
        let pixels = pixels.get(..count)?;
        for size in head {
            put_word(out, *size as u32);
        }
        if self.tree.header.version < (2, 1) {
            for pixel in pixels {
                put_word(out, *pixel as u32);
            }
            return Some(());
        }
        for pixel in pixels {
            // The first component is in the highest byte that is used.
            let word = (*pixel as u32).to_be_bytes();
            out.extend_from_slice(&word[4 - components..]);
        }
        // As Coin writes it; readers tell it by what follows.
        pad(out, count * components);
        Some(())
    }
}

/// Writes the count of a list, then each value; of what is no list the first value.
fn each<T>(
    out: &mut Vec<u8>,
    stored: ValueType,
    values: Vec<T>,
    mut put: impl FnMut(&mut Vec<u8>, T),
) -> Option<()> {
    if stored.is_list {
        put_word(out, values.len() as u32);
        for value in values {
            put(out, value);
        }
    } else {
        put(out, values.into_iter().next()?);
    }
    Some(())
}

fn put_count(out: &mut Vec<u8>, numbers: usize, stored: ValueType) {
    if stored.is_list {
        put_word(out, (numbers / usize::from(stored.size.max(1))) as u32);
    }
}

/// How many of so many numbers a field takes.
fn used(given: usize, stored: ValueType) -> Option<usize> {
    let size = usize::from(stored.size.max(1));
    if stored.is_list {
        Some(given - given % size)
    } else {
        (given >= size).then_some(size)
    }
}

fn nodes<'a>(tree: &Tree<'a>, value: &Value, is_list: bool) -> Option<Encoded<'a>> {
    let Value::Atoms { atoms, .. } = value else {
        return None;
    };
    let node = |atom: &Atom<'a>| match atom {
        Atom::Child(child) => Some(*child),
        _ => None,
    };
    let mut nodes: Vec<Child<'a>> = tree.atoms(*atoms).iter().map(node).collect::<Option<_>>()?;
    if !is_list {
        nodes.truncate(1);
        if nodes.is_empty() {
            return None;
        }
    }
    Some(Encoded::Nodes { nodes, is_list })
}

fn flags(tree: &Tree<'_>, value: &Value) -> Option<Vec<bool>> {
    match value {
        Value::Numbers { .. } => Some(ints(tree, value)?.iter().map(|v| *v != 0).collect()),
        Value::Atoms { atoms, .. } => {
            let flag = |atom: &Atom<'_>| match atom {
                Atom::Word(word, _) | Atom::String(word, _) => {
                    let known = [(&b"TRUE"[..], true), (b"FALSE", false)];
                    let found = known
                        .into_iter()
                        .find(|(name, _)| word.eq_ignore_ascii_case(name));
                    found.map(|(_, flag)| flag)
                }
                Atom::Number(value, _) => Some(*value != 0.0),
                Atom::Child(_) => None,
            };
            tree.atoms(*atoms).iter().map(flag).collect()
        }
        Value::Missing | Value::Mask(_) | Value::Is(_) => None,
    }
}

fn texts<'t>(tree: &'t Tree<'_>, value: &Value) -> Option<Vec<Cow<'t, [u8]>>> {
    match value {
        // A number is the text it is written with.
        Value::Numbers { span, .. } => Some(vec![tree.source[span.range()].into()]),
        Value::Atoms { atoms, .. } | Value::Mask(atoms) => {
            let text = |atom: &'t Atom<'_>| match atom {
                Atom::String(raw, _) => Some(tree.string(raw)),
                Atom::Word(word, _) => Some((*word).into()),
                Atom::Number(_, span) => Some(tree.source[span.range()].into()),
                Atom::Child(_) => None,
            };
            tree.atoms(*atoms).iter().map(text).collect()
        }
        Value::Missing | Value::Is(_) => None,
    }
}

fn words<'t, 'v, T>(tree: &'t Tree<'_>, value: &'v Value) -> Option<Vec<T>>
where
    T: From<&'t [u8]>,
{
    let (Value::Atoms { atoms, .. } | Value::Mask(atoms)) = value else {
        return None;
    };
    let word = |atom: &'t Atom<'_>| match atom {
        Atom::Word(word, _) | Atom::String(word, _) => Some(T::from(word)),
        Atom::Number(..) | Atom::Child(_) => None,
    };
    tree.atoms(*atoms).iter().map(word).collect()
}

/// The numbers of a value, if it has nothing else.
fn floats<'t>(tree: &'t Tree<'_>, value: &Value) -> Option<Cow<'t, [f64]>> {
    match value {
        Value::Numbers { numbers, .. } => match tree.floats(numbers) {
            Some(floats) => Some(floats.into()),
            None => Some(tree.ints(numbers)?.iter().map(|v| f64::from(*v)).collect()),
        },
        Value::Atoms {
            atoms,
            bracketed: true,
        } => {
            let number = |atom: &Atom<'_>| match atom {
                Atom::Number(value, _) => Some(*value),
                _ => None,
            };
            tree.atoms(*atoms).iter().map(number).collect()
        }
        _ => None,
    }
}

/// The same as whole numbers: C's octal ones where a token has a leading zero.
fn ints(tree: &Tree<'_>, value: &Value) -> Option<Vec<i64>> {
    match value {
        Value::Numbers {
            octal: true, span, ..
        } => Some(tree.octal_ints(*span)),
        Value::Numbers { numbers, .. } if let Some(ints) = tree.ints(numbers) => {
            Some(ints.iter().map(|v| i64::from(*v)).collect())
        }
        _ => Some(floats(tree, value)?.iter().map(|v| *v as i64).collect()),
    }
}
