//! Values as the field's type wants them, from what the text gives.
//!
//! Accepts what Coin accepts, and what users write nonetheless, with a warning. A value that
//! cannot be used gives `None`: the field keeps its default.

use std::borrow::Cow;
use std::sync::Arc;

use iv_parser::{Atom, Child, Problem, Severity, Span, Tree, Value, parse, text_of};

use crate::graph::{FieldValue, NodeId};
use crate::registry::{FieldSpec, FieldType};
use crate::scene::Image;

use super::decimal::has_decimal_commas;

/// What reading a value needs besides the value.
pub(super) struct Reader<'t, 'a> {
    pub tree: &'t Tree<'a>,
    /// Class and field, for messages.
    pub subject: &'t dyn Fn() -> String,
    /// The handle of a node that stands in a value.
    pub node: &'t mut dyn FnMut(Child<'a>) -> Option<NodeId>,
    pub problems: &'t mut Vec<Problem>,
}

/// The default of a field, from the registry's text.
pub(crate) fn read_default(spec: &FieldSpec) -> FieldValue {
    let text = format!("#Inventor V2.1 ascii\nX {{ f {} }}", spec.default);
    let parsed = parse(text.as_bytes());
    let Some(Child::Node(id)) = parsed.tree.children_of_root().first() else {
        return FieldValue::None;
    };
    let Some(iv_parser::Item::Field(field)) = parsed.tree.items(*id).first() else {
        return FieldValue::None;
    };
    let mut problems = Vec::new();
    let mut reader = Reader {
        tree: &parsed.tree,
        subject: &|| spec.name.to_owned(),
        node: &mut |_| None,
        problems: &mut problems,
    };
    let span = parsed.tree.field(*field).span;
    let value = reader.read(&parsed.tree.field(*field).value, spec, span);
    value.unwrap_or(FieldValue::None)
}

impl<'a> Reader<'_, 'a> {
    /// The value of a field described by `spec`, written at `span`.
    pub fn read(&mut self, value: &Value, spec: &FieldSpec, span: Span) -> Option<FieldValue> {
        use FieldType as T;
        match spec.field_type {
            T::SFBool | T::MFBool => self.flag(value, span),
            T::SFEnum | T::MFEnum | T::SFBitMask | T::MFBitMask => self.words(value, spec, span),
            T::SFString | T::SFName | T::MFString | T::MFName => self.texts(value, span),
            T::SFNode | T::MFNode | T::SFEngine | T::MFEngine => Some(self.nodes(value)),
            T::SFImage => self.image(value, span),
            t if t.tuple_size() == 0 => Some(FieldValue::None),
            t if t.is_integer() => self.ints(value, t, span),
            t => self.numbers(value, t, span),
        }
    }

    fn warn(&mut self, code: &'static str, message: String, hint: &str, span: Span) {
        self.problems.push(Problem {
            severity: Severity::Warning,
            code,
            message,
            hint: hint.to_owned(),
            span,
        });
    }

    fn wrong_type(&mut self, wanted: &str, span: Span) {
        let message = format!("{} takes {wanted}", (self.subject)());
        self.warn(
            "wrong-type",
            message,
            "the value was ignored; the field keeps its default",
            span,
        );
    }

    fn flag(&mut self, value: &Value, span: Span) -> Option<FieldValue> {
        let flag = match value {
            Value::Atoms { atoms, .. } => match self.tree.atoms(*atoms).first() {
                Some(Atom::Word(word, _) | Atom::String(word, _)) => {
                    let known = [(&b"TRUE"[..], true), (b"FALSE", false)];
                    let found = known.iter().find(|(w, _)| word.eq_ignore_ascii_case(w));
                    if found.is_some_and(|(w, _)| w != word) {
                        let message = format!("`{}` should be in capitals", text_of(word));
                        self.warn("bool-case", message, "it was accepted", span);
                    }
                    found.map(|(_, flag)| *flag)
                }
                _ => None,
            },
            Value::Numbers { numbers, .. } => self
                .tree
                .ints(numbers)
                .and_then(|v| v.first())
                .map(|v| *v != 0),
            _ => None,
        };
        if flag.is_none() {
            self.wrong_type("TRUE or FALSE", span);
        }
        flag.map(FieldValue::Bool)
    }

    fn words(&mut self, value: &Value, spec: &FieldSpec, span: Span) -> Option<FieldValue> {
        let is_mask = matches!(spec.field_type, FieldType::SFBitMask | FieldType::MFBitMask);
        let atoms = match value {
            Value::Atoms { atoms, .. } | Value::Mask(atoms) => self.tree.atoms(*atoms),
            Value::Numbers { numbers, .. } if is_mask => {
                let bits = self.tree.ints(numbers)?.first().copied()?;
                let message = format!("{} is given as a number", (self.subject)());
                self.warn("mask-number", message, "write the names of the bits", span);
                return Some(FieldValue::Word(bits as u32));
            }
            _ => {
                self.wrong_type(&choices(spec), span);
                return None;
            }
        };
        let mut bits = None;
        for atom in atoms {
            let (Atom::Word(word, at) | Atom::String(word, at)) = atom else {
                continue;
            };
            match self.word(word, spec, *at) {
                Some(found) => bits = Some(bits.unwrap_or(0) | found),
                None => {
                    let message =
                        format!("`{}` is not a word of {}", text_of(word), (self.subject)());
                    let hint = format!("it was ignored; {} takes {}", spec.name, choices(spec));
                    self.warn("unknown-word", message, &hint, *at);
                }
            }
            if !is_mask {
                break;
            }
        }
        if is_mask && atoms.is_empty() {
            bits = Some(0);
        }
        bits.map(FieldValue::Word)
    }

    fn word(&mut self, word: &[u8], spec: &FieldSpec, span: Span) -> Option<u32> {
        if let Some(value) = spec.word(word) {
            return Some(value);
        }
        // Words that other systems write for the same thing.
        const ALIASES: &[(&[u8], &[u8])] = &[
            (b"CLAMP_TO_EDGE", b"CLAMP"),
            (b"CLAMP_TO_BORDER", b"CLAMP"),
            (b"DECAL_MODULATE", b"MODULATE"),
            (b"CCW", b"COUNTERCLOCKWISE"),
            (b"CW", b"CLOCKWISE"),
        ];
        let alias = ALIASES
            .iter()
            .find(|(from, _)| word.eq_ignore_ascii_case(from));
        let by_alias = alias.and_then(|(_, to)| spec.word(to));
        let by_case = || {
            spec.words
                .iter()
                .find(|w| w.name.as_bytes().eq_ignore_ascii_case(word))
                .map(|w| w.value)
        };
        let found = by_alias.or_else(by_case)?;
        let meant = spec
            .words
            .iter()
            .find(|w| w.value == found)
            .map_or("", |w| w.name);
        let message = format!("`{}` was taken for `{meant}`", text_of(word));
        self.warn(
            "word-guessed",
            message,
            "Inventor's words are in capitals and exact",
            span,
        );
        Some(found)
    }

    fn texts(&mut self, value: &Value, span: Span) -> Option<FieldValue> {
        let text = |bytes: &[u8]| -> Arc<str> { text_of(bytes).into() };
        // Coin would take the brace for part of the text.
        let is_word = |atom: &Atom<'a>| matches!(atom, Atom::Word(..));
        if let Value::Atoms { atoms, .. } = value
            && self.tree.atoms(*atoms).iter().any(is_word)
            && self.tree.source.get(span.end as usize) == Some(&b'}')
        {
            let message = format!("{} has a brace right behind its text", (self.subject)());
            self.warn(
                "glued-brace",
                message,
                "the text was ended before it; put it in quotes",
                span,
            );
        }
        let texts = match value {
            Value::Atoms { atoms, .. } | Value::Mask(atoms) => self
                .tree
                .atoms(*atoms)
                .iter()
                .filter_map(|atom| match atom {
                    Atom::String(raw, _) => Some(text(&self.tree.string(raw))),
                    Atom::Word(word, _) => Some(text(word)),
                    Atom::Number(_, span) => Some(text(&self.tree.source[span.range()])),
                    Atom::Child(_) => None,
                })
                .collect(),
            Value::Numbers { span, .. } => vec![text(&self.tree.source[span.range()])],
            Value::Missing | Value::Is(_) => return None,
        };
        Some(FieldValue::Texts(texts))
    }

    fn nodes(&mut self, value: &Value) -> FieldValue {
        let Value::Atoms { atoms, .. } = value else {
            return FieldValue::Nodes(Vec::new());
        };
        let atoms = self.tree.atoms(*atoms);
        let child = |atom: &Atom<'a>| match atom {
            Atom::Child(child) => (self.node)(*child),
            _ => None,
        };
        FieldValue::Nodes(atoms.iter().filter_map(child).collect())
    }

    fn numbers(&mut self, value: &Value, field_type: FieldType, span: Span) -> Option<FieldValue> {
        let Some(given) = numeric(self.tree, value) else {
            self.wrong_type("numbers", span);
            return None;
        };
        let usable = self.usable(given.len(), field_type, span)?;
        if usable == given.len() {
            // A longer list is shared with the tree, not copied.
            if let Value::Numbers { numbers, .. } = value
                && let Some(all) = self.tree.many_floats(numbers)
            {
                return Some(FieldValue::Many(all));
            }
        }
        Some(FieldValue::from_numbers(&given[..usable]))
    }

    /// How many of `given` numbers a field of this type takes.
    fn usable(&mut self, given: usize, field_type: FieldType, span: Span) -> Option<usize> {
        let size = field_type.tuple_size();
        let usable = if field_type.is_multiple() {
            given - given % size
        } else {
            given.min(size)
        };
        if !field_type.is_multiple() && given < size {
            let message = format!("{} takes {size} numbers, not {given}", (self.subject)());
            self.warn(
                "too-few-numbers",
                message,
                "the value was ignored; the field keeps its default",
                span,
            );
            return None;
        }
        if usable < given {
            let extra = given - usable;
            let message = format!(
                "{} takes {size} numbers a value; {extra} are left over",
                (self.subject)()
            );
            let hint = if has_decimal_commas(&self.tree.source[span.range()]) {
                "they were ignored; numbers take a point, not a comma: `1.5`"
            } else {
                "they were ignored"
            };
            self.warn("extra-numbers", message, hint, span);
        }
        Some(usable)
    }

    fn ints(&mut self, value: &Value, field_type: FieldType, span: Span) -> Option<FieldValue> {
        let given: Cow<'_, [i32]> = match value {
            Value::Numbers {
                octal: true,
                span: text,
                ..
            } => self
                .tree
                .octal_ints(*text)
                .iter()
                .map(|&v| v as i32)
                .collect(),
            Value::Numbers { numbers, .. } => {
                match (self.tree.ints(numbers), self.tree.floats(numbers)) {
                    (Some(ints), _) => ints.into(),
                    (None, Some(floats)) => {
                        // Whole numbers beyond 31 bits (colours) stand among the floats.
                        if floats.iter().any(|v| v.fract() != 0.0) {
                            let message = format!("{} takes whole numbers", (self.subject)());
                            self.warn("not-whole", message, "fractions were cut off", span);
                        }
                        floats.iter().map(|&v| v as i64 as i32).collect()
                    }
                    (None, None) => return None,
                }
            }
            Value::Atoms {
                atoms,
                bracketed: true,
            } if self.tree.atoms(*atoms).is_empty() => [].as_slice().into(),
            _ => {
                self.wrong_type("whole numbers", span);
                return None;
            }
        };
        let usable = self.usable(given.len(), field_type, span)?;
        if let Value::Numbers {
            numbers,
            octal: false,
            ..
        } = value
            && usable == given.len()
            && let Some(all) = self.tree.many_ints(numbers)
        {
            return Some(FieldValue::Ints(all));
        }
        Some(match &given[..usable] {
            [one] => FieldValue::Int(*one),
            many => FieldValue::Ints(many.to_vec().into()),
        })
    }

    fn image(&mut self, value: &Value, span: Span) -> Option<FieldValue> {
        let Value::Numbers {
            octal, span: text, ..
        } = value
        else {
            self.wrong_type("a width, a height, a number of components and pixels", span);
            return None;
        };
        let numbers: Vec<i64> = if *octal {
            self.tree.octal_ints(*text)
        } else {
            numeric(self.tree, value)?
                .iter()
                .map(|&v| v as i64)
                .collect()
        };
        let (&[width, height, components], pixels) = numbers.split_first_chunk::<3>()?;
        let legal = (0..=i64::from(u16::MAX)).contains(&width)
            && (0..=i64::from(u16::MAX)).contains(&height)
            && (0..=4).contains(&components);
        if !legal {
            self.wrong_type("sizes from 0 to 65535 and 0 to 4 components", span);
            return None;
        }
        let wanted = (width * height) as usize;
        if wanted == 0 || components == 0 {
            return Some(FieldValue::Image(None));
        }
        if pixels.len() < wanted {
            let message = format!(
                "{} has {} of {wanted} pixels",
                (self.subject)(),
                pixels.len()
            );
            self.warn("too-few-pixels", message, "the image was ignored", span);
            return None;
        }
        // The first component stands in the most significant byte that is used.
        let bytes_of = |pixel: &i64| {
            let word = (*pixel as u32).to_be_bytes();
            word.into_iter().skip(4 - components as usize)
        };
        Some(FieldValue::Image(Some(Arc::new(Image {
            width: width as u32,
            height: height as u32,
            components: components as u8,
            bytes: pixels[..wanted].iter().flat_map(bytes_of).collect(),
        }))))
    }
}

/// All numbers of a value as floats.
fn numeric<'v>(tree: &'v Tree<'_>, value: &'v Value) -> Option<Cow<'v, [f64]>> {
    match value {
        Value::Numbers { numbers, .. } => Some(match tree.floats(numbers) {
            Some(floats) => floats.into(),
            None => tree.ints(numbers)?.iter().map(|&i| f64::from(i)).collect(),
        }),
        Value::Atoms { atoms, bracketed } => {
            let number = |atom: &Atom<'_>| match atom {
                Atom::Number(value, _) => Some(*value),
                _ => None,
            };
            let atoms = tree.atoms(*atoms);
            let all: Vec<f64> = atoms.iter().filter_map(number).collect();
            (*bracketed && all.len() == atoms.len()).then_some(all.into())
        }
        Value::Missing | Value::Mask(_) | Value::Is(_) => None,
    }
}

/// The legal words, for a message.
fn choices(spec: &FieldSpec) -> String {
    let names: Vec<&str> = spec.words.iter().map(|w| w.name).collect();
    format!("one of {}", names.join(", "))
}
