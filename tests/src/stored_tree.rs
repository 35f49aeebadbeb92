//! Whether a tree read from a binary file says what the tree said that it was written from: equal
//! but for what the binary format has no room for, and numbers to the precision of 32 bits.

use std::borrow::Cow;
use std::collections::BTreeMap;

use iv_parser::{Atom, Child, Field, Item, NodeId, Problem, Tree, Value};

/// The first difference found, or `None`. Fields that `told` speaks of may be missing.
pub fn difference(text: &Tree<'_>, stored: &Tree<'_>, told: &[Problem]) -> Option<String> {
    let mut pairs = Pairs {
        text,
        stored,
        told,
        open: Vec::new(),
    };
    let roots = (text.children_of_root(), stored.children_of_root());
    if !pairs.children(roots.0, roots.1) {
        return Some("roots".to_owned());
    }
    while let Some((a, b)) = pairs.open.pop() {
        if let Some(what) = pairs.node(a, b) {
            let class = String::from_utf8_lossy(text.node(a).class);
            return Some(format!("{class} at {:?}: {what}", text.node(a).span));
        }
    }
    None
}

struct Pairs<'t, 'a, 'b> {
    text: &'t Tree<'a>,
    stored: &'t Tree<'b>,
    told: &'t [Problem],
    open: Vec<(NodeId, NodeId)>,
}

/// The fields of a node, the last of each name, and its children.
fn contents<'t, 'a>(
    tree: &'t Tree<'a>,
    id: NodeId,
) -> (BTreeMap<&'a [u8], &'t Field<'a>>, Vec<Child<'a>>) {
    let mut fields = BTreeMap::new();
    let mut children = Vec::new();
    for item in tree.items(id) {
        match item {
            Item::Child(child) => children.push(*child),
            Item::Field(field) => {
                let field = tree.field(*field);
                fields.insert(field.name, field);
            }
        }
    }
    (fields, children)
}

impl Pairs<'_, '_, '_> {
    fn child(&mut self, a: &Child<'_>, b: &Child<'_>) -> bool {
        match (a, b) {
            (Child::Node(a), Child::Node(b)) => {
                self.open.push((*a, *b));
                true
            }
            (Child::Use(a, _), Child::Use(b, _)) => a == b,
            (Child::Null, Child::Null) => true,
            _ => false,
        }
    }

    fn children(&mut self, a: &[Child<'_>], b: &[Child<'_>]) -> bool {
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| self.child(a, b))
    }

    fn is_told(&self, start: u32) -> bool {
        self.told.iter().any(|problem| problem.span.start == start)
    }

    fn node(&mut self, a: NodeId, b: NodeId) -> Option<String> {
        let (m, n) = (self.text.node(a), self.stored.node(b));
        let class = if m.class.is_empty() {
            b"Group"
        } else {
            m.class
        };
        if class != n.class || m.def != n.def {
            return Some("class or name".to_owned());
        }
        let (mut fields, children) = contents(self.text, a);
        let (stored, others) = contents(self.stored, b);
        if !self.children(&children, &others) && !self.is_told(m.span.start) {
            return Some("children".to_owned());
        }
        for (name, field) in stored {
            let shown = String::from_utf8_lossy(name).into_owned();
            match fields.remove(name) {
                _ if matches!(name, b"fields" | b"inputs") => {}
                None => return Some(format!("`{shown}` is new")),
                Some(text) if !self.field(text, field) && !self.is_told(text.span.start) => {
                    return Some(format!("`{shown}`: {text:?}, {field:?}"));
                }
                Some(_) => {}
            }
        }
        let is_missing = |field: &&Field<'_>| {
            let says_nothing = matches!(field.value, Value::Missing)
                && field.connection.is_none()
                && !field.ignored;
            let is_description = matches!(field.name, b"fields" | b"inputs");
            !(says_nothing || is_description || self.is_told(field.span.start))
        };
        let lost = fields.into_values().find(is_missing)?;
        Some(format!("`{}` is lost", String::from_utf8_lossy(lost.name)))
    }

    fn field(&mut self, a: &Field<'_>, b: &Field<'_>) -> bool {
        let connected = match (&a.connection, &b.connection) {
            (None, None) => true,
            (Some(c), Some(d)) => c.output == d.output && self.child(&c.master, &d.master),
            _ => false,
        };
        connected && a.ignored == b.ignored && self.value(&a.value, &b.value)
    }

    fn value(&mut self, a: &Value, b: &Value) -> bool {
        if let (Some(a), Some(b)) = (numbers(self.text, a), numbers(self.stored, b)) {
            return a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| same_number(*a, *b));
        }
        match (a, b) {
            (Value::Missing, Value::Missing) => true,
            // Octal: which number it is depends on the field's type.
            (Value::Numbers { octal: true, .. }, Value::Numbers { .. }) => true,
            (
                Value::Atoms { atoms: a, .. } | Value::Mask(a),
                Value::Atoms { atoms: b, .. } | Value::Mask(b),
            ) => {
                let (a, b) = (self.text.atoms(*a), self.stored.atoms(*b));
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| self.atom(a, b))
            }
            // A number as a text, or as a flag.
            (Value::Numbers { span, .. }, Value::Atoms { atoms, .. }) => {
                let written = &self.text.source[span.range()];
                match self.stored.atoms(*atoms) {
                    [Atom::String(text, _)] => *text == written,
                    [Atom::Word(word, _)] => (written == b"0") == (*word == b"FALSE"),
                    _ => false,
                }
            }
            _ => false,
        }
    }

    fn atom(&mut self, a: &Atom<'_>, b: &Atom<'_>) -> bool {
        if let (Atom::Child(a), Atom::Child(b)) = (a, b) {
            return self.child(a, b);
        }
        match (word(self.text, a), word(self.stored, b)) {
            (Some(a), Some(b)) => a == b || (is_flag(&a) && a.eq_ignore_ascii_case(&b)),
            _ => false,
        }
    }
}

fn is_flag(word: &[u8]) -> bool {
    word.eq_ignore_ascii_case(b"TRUE") || word.eq_ignore_ascii_case(b"FALSE")
}

fn word<'t>(tree: &'t Tree<'_>, atom: &'t Atom<'_>) -> Option<Cow<'t, [u8]>> {
    match atom {
        Atom::Word(word, _) => Some((*word).into()),
        Atom::String(raw, _) => Some(tree.string(raw)),
        Atom::Number(_, span) => Some(tree.source[span.range()].into()),
        Atom::Child(_) => None,
    }
}

/// Numbers that mean the same whatever the field's type.
fn numbers(tree: &Tree<'_>, value: &Value) -> Option<Vec<f64>> {
    match value {
        Value::Numbers {
            numbers,
            octal: false,
            ..
        } => Some(match tree.floats(numbers) {
            Some(floats) => floats.to_vec(),
            None => tree.ints(numbers)?.iter().map(|v| f64::from(*v)).collect(),
        }),
        Value::Atoms {
            atoms,
            bracketed: true,
        } if tree.atoms(*atoms).is_empty() => Some(vec![]),
        _ => None,
    }
}

/// To 32 bits, as floats or as whole numbers that wrap.
fn same_number(a: f64, b: f64) -> bool {
    a == b || a as f32 == b as f32 || a as i64 as u32 == b as i64 as u32
}
