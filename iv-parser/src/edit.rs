//! Changes to a text at the places that its tree knows, with everything else left as it is:
//! comments, layout, unknown nodes. For texts in ASCII; knows no class and no field.

use std::ops::Range;

use crate::lex;
use crate::tree::{Atom, Child, Field, Item, NodeId, Tree};

/// Changes being collected.
#[derive(Debug)]
pub struct TextEdits<'t, 'a> {
    tree: &'t Tree<'a>,
    edits: Vec<Edit>,
}

/// Text in the place of other text.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Edit {
    range: Range<usize>,
    text: Vec<u8>,
    /// Whether it is made as often as it is asked for.
    counts: bool,
}

impl<'t, 'a> TextEdits<'t, 'a> {
    /// No changes yet.
    pub fn new(tree: &'t Tree<'a>) -> Self {
        Self {
            tree,
            edits: Vec::new(),
        }
    }

    fn add(&mut self, range: Range<usize>, text: Vec<u8>) {
        self.edits.push(Edit {
            range,
            text,
            counts: false,
        });
    }

    /// The last field of this name, which is the one that counts.
    pub fn field(&self, node: NodeId, name: &str) -> Option<&'t Field<'a>> {
        let items = self.tree.items(node).iter().rev();
        let mut fields = items.filter_map(|item| match item {
            Item::Field(id) => Some(self.tree.field(*id)),
            Item::Child(_) => None,
        });
        fields.find(|field| field.name == name.as_bytes())
    }

    /// Gives a field a value, in the place of the one it has or as the first of the node. False if
    /// the field is connected: its value is not its own.
    pub fn set_field(&mut self, node: NodeId, name: &str, value: &str) -> bool {
        match self.field(node, name) {
            Some(field) if field.connection.is_some() => return false,
            Some(field) => {
                let text = format!("{name} {value}").into_bytes();
                self.add(field.span.range(), text);
            }
            None => return self.insert_first(node, &format!("{name} {value}")),
        }
        true
    }

    /// Puts text at the beginning of a node's body; false if the body is not found.
    pub fn insert_first(&mut self, node: NodeId, text: &str) -> bool {
        let span = self.tree.node(node).span;
        let class = self.tree.node(node).class.len();
        let brace = lex::skip_trivia(self.tree.source, span.start as usize + class);
        if self.tree.source.get(brace) != Some(&b'{') {
            return false;
        }
        self.add(brace + 1..brace + 1, format!(" {text} ").into_bytes());
        true
    }

    /// Puts text before and behind a node, its name included; what is called first is outermost.
    pub fn wrap(&mut self, node: NodeId, before: &str, behind: &str) {
        let start = self.start_of(node);
        let end = self.tree.node(node).span.end as usize;
        self.insert(start, before);
        self.insert(end, behind);
    }

    /// As [`Self::wrap`], around one of [`Self::references`].
    pub fn wrap_reference(&mut self, reference: &Range<usize>, before: &str, behind: &str) {
        self.insert(reference.start, before);
        self.insert(reference.end, behind);
    }

    /// Inserts as often as it is asked for.
    fn insert(&mut self, at: usize, text: &str) {
        self.edits.push(Edit {
            range: at..at,
            text: text.as_bytes().to_vec(),
            counts: true,
        });
    }

    /// Where a node stands: written out, and by `USE`; in the order of the text.
    pub fn references(&self, node: NodeId) -> Vec<Range<usize>> {
        let end = self.tree.node(node).span.end as usize;
        let mut all: Vec<Range<usize>> = Vec::new();
        all.push(self.start_of(node)..end);
        for name in self.uses_of(node) {
            let before = &self.tree.source[..name.start];
            let word = before.windows(3).rposition(|word| word == b"USE");
            all.push(word.unwrap_or(name.start)..name.end);
        }
        all.sort_by_key(|range| range.start);
        all
    }

    /// Replaces a node but for its name.
    pub fn replace(&mut self, node: NodeId, text: &[u8]) {
        self.add(self.tree.node(node).span.range(), text.to_vec());
    }

    /// Names a node, and all that uses it. The number behind a `+` stays.
    pub fn rename(&mut self, node: NodeId, name: &str) {
        let Some(old) = self.tree.node(node).def else {
            let start = self.tree.node(node).span.start as usize;
            self.add(start..start, format!("DEF {name} ").into_bytes());
            return;
        };
        let number = old.iter().position(|&b| b == b'+').unwrap_or(old.len());
        let new = [name.as_bytes(), &old[number..]].concat();
        let Some(at) = self.offset_of(old) else {
            return;
        };
        self.add(at..at + old.len(), new.clone());
        for range in self.uses_of(node) {
            self.add(range, new.clone());
        }
    }

    /// The names of all `USE` that mean a node.
    fn uses_of(&self, node: NodeId) -> Vec<Range<usize>> {
        let Some(name) = self.tree.node(node).def else {
            return Vec::new();
        };
        // A USE means the last definition before it.
        let all = (0..self.tree.node_count() as u32).map(NodeId);
        let same = all.filter(|&id| self.tree.node(id).def == Some(name));
        let starts = same.map(|id| self.tree.node(id).span.start);
        let own = self.tree.node(node).span.start;
        let next = starts.filter(|&start| start > own).min();
        let reach = own..next.unwrap_or(u32::MAX);
        self.uses()
            .filter(|(used, start)| *used == name && reach.contains(start))
            .map(|(name, start)| start as usize..start as usize + name.len())
            .collect()
    }

    /// All `USE`: the name and where it stands.
    fn uses(&self) -> impl Iterator<Item = (&'a [u8], u32)> {
        let tree = self.tree;
        let children = tree.items.iter().filter_map(|item| match item {
            Item::Child(child) => Some(*child),
            Item::Field(_) => None,
        });
        let in_values = tree.atoms.iter().filter_map(|atom| match atom {
            Atom::Child(child) => Some(*child),
            _ => None,
        });
        let masters = tree.fields.iter().filter_map(|f| f.connection.as_ref());
        let masters = masters.map(|connection| connection.master);
        let all = children
            .chain(in_values)
            .chain(masters)
            .chain(tree.roots.iter().copied());
        all.filter_map(|child| match child {
            Child::Use(name, span) => Some((name, span.start)),
            _ => None,
        })
    }

    /// Where a node begins, with `DEF` and its name.
    fn start_of(&self, node: NodeId) -> usize {
        let class = self.tree.node(node).span.start as usize;
        let name = self
            .tree
            .node(node)
            .def
            .and_then(|name| self.offset_of(name));
        let Some(name) = name else { return class };
        let before = &self.tree.source[..name];
        before
            .windows(3)
            .rposition(|word| word == b"DEF")
            .unwrap_or(class)
    }

    /// Where a part of the text stands in it.
    fn offset_of(&self, part: &[u8]) -> Option<usize> {
        let start = self.tree.source.as_ptr() as usize;
        let offset = (part.as_ptr() as usize).checked_sub(start)?;
        (offset + part.len() <= self.tree.source.len()).then_some(offset)
    }

    /// The text with all changes; `None` if two of them touch the same bytes in different ways. A
    /// change that was made twice counts once.
    pub fn apply(mut self) -> Option<Vec<u8>> {
        // Insertions go ahead of what replaces the text behind them; otherwise order is kept.
        self.edits
            .sort_by_key(|edit| (edit.range.start, edit.range.end));
        self.edits.dedup_by(|a, b| !a.counts && a == b);
        let mut out = Vec::with_capacity(self.tree.source.len());
        let mut done = 0;
        for Edit { range, text, .. } in &self.edits {
            if range.start < done {
                return None;
            }
            out.extend_from_slice(&self.tree.source[done..range.start]);
            out.extend_from_slice(text);
            done = range.end;
        }
        out.extend_from_slice(&self.tree.source[done..]);
        Some(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parse;

    fn node(tree: &Tree<'_>, class: &str) -> NodeId {
        let mut all = (0..tree.node_count() as u32).map(NodeId);
        all.find(|&id| tree.node(id).class == class.as_bytes())
            .unwrap()
    }

    #[test]
    fn changes_touch_nothing_else() {
        type Change = fn(&mut TextEdits<'_, '_>, NodeId);
        let rows: [(&str, &str, Change, Option<&str>); 11] = [
            (
                "Cube { # wide\n width 2 }",
                "Cube",
                |e, n| assert!(e.set_field(n, "width", "3")),
                Some("Cube { # wide\n width 3 }"),
            ),
            (
                "Cube # c {\n{ }",
                "Cube",
                |e, n| assert!(e.set_field(n, "width", "3")),
                Some("Cube # c {\n{ width 3  }"),
            ),
            (
                "Cube { width 1 ~ width 2 }",
                "Cube",
                |e, n| assert!(e.set_field(n, "width", "3")),
                Some("Cube { width 1 ~ width 3 }"),
            ),
            (
                "Cube { width 1 = USE a.b }",
                "Cube",
                |e, n| assert!(!e.set_field(n, "width", "3")),
                Some("Cube { width 1 = USE a.b }"),
            ),
            (
                "DEF a+1 Cube { } USE a+1 DEF a+1 Cone { } USE a+1",
                "Cube",
                |e, n| e.rename(n, "b"),
                Some("DEF b+1 Cube { } USE b+1 DEF a+1 Cone { } USE a+1"),
            ),
            (
                "X { n USE a m [ USE a ] w 1 = USE a . out } DEF a Cube { } X { n USE a m [ USE a ] w 1 = USE a . out }",
                "Cube",
                |e, n| e.rename(n, "bb"),
                Some(
                    "X { n USE a m [ USE a ] w 1 = USE a . out } DEF bb Cube { } X { n USE bb m [ USE bb ] w 1 = USE bb . out }",
                ),
            ),
            (
                "Cube { }",
                "Cube",
                |e, n| e.rename(n, "b"),
                Some("DEF b Cube { }"),
            ),
            (
                "DEF DEF Cube { }",
                "Cube",
                |e, n| e.wrap(n, "S { ", " }"),
                Some("S { DEF DEF Cube { } }"),
            ),
            (
                "S { DEF a Cube { width 1 } }",
                "Cube",
                |e, n| {
                    e.replace(n, b"Cone { }");
                    e.wrap(n, "T { ", " }");
                },
                Some("S { T { DEF a Cone { } } }"),
            ),
            (
                "Cube { width 1 }",
                "Cube",
                |e, n| {
                    e.set_field(n, "width", "2");
                    e.set_field(n, "width", "2");
                },
                Some("Cube { width 2 }"),
            ),
            (
                "Cube { width 1 }",
                "Cube",
                |e, n| {
                    e.set_field(n, "width", "2");
                    e.set_field(n, "width", "3");
                },
                None,
            ),
        ];
        for (body, class, change, want) in rows {
            let text = format!("#Inventor V2.1 ascii\n{body}");
            let parsed = parse(text.as_bytes());
            let mut edits = TextEdits::new(&parsed.tree);
            change(&mut edits, node(&parsed.tree, class));
            let got = edits.apply().map(|text| String::from_utf8(text).unwrap());
            let want = want.map(|body| format!("#Inventor V2.1 ascii\n{body}"));
            assert_eq!(got, want, "{body}");
        }
    }
}
