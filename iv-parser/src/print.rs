//! A tree as ASCII text again.
//!
//! Everything of the tree is kept: names, unknown nodes and fields, flags, connections, the
//! values to the last bit (numbers are printed with the fewest digits that read back equal).
//! Comments and the layout are not kept.

use std::io::{self, Write};

use crate::header::{Dialect, Encoding};
use crate::text::{encode_name, encode_string};
use crate::tree::{Atom, Child, Field, FieldId, Form, Item, NodeId, Numbers, Tree, Value};

/// What the printer asks about a field: how to lay out its numbers.
pub trait Layout {
    /// Numbers in one value of the field (3 for a point), or 0 when not known. SGI's reader wants
    /// a comma between the values of a list.
    fn tuple_size(&self, class: &[u8], field: &[u8]) -> usize;
}

/// What is left to print, last first.
enum Step<'t, 'a> {
    Body(NodeId, usize),
    Interface(NodeId, usize),
    /// Atoms of which each so many have a comma behind them.
    Atoms(&'t [Atom<'a>], usize, usize),
    CloseList,
    Tail(&'t Field<'a>),
    Output(&'a [u8]),
    EndLine,
}

struct Printer<'t, 'a, 'o> {
    tree: &'t Tree<'a>,
    layout: &'o dyn Layout,
    out: &'o mut dyn Write,
    steps: Vec<Step<'t, 'a>>,
    indent: usize,
}

/// Writes the whole tree, header first.
///
/// # Errors
///
/// Those of `out`.
pub fn print(tree: &Tree<'_>, layout: &dyn Layout, out: &mut dyn Write) -> io::Result<()> {
    let (major, minor) = tree.header.version;
    match (tree.header.dialect, tree.header.encoding) {
        (Dialect::Inventor, _) => writeln!(out, "#Inventor V{major}.{minor} ascii\n")?,
        (Dialect::Vrml1, Encoding::Ascii | Encoding::Binary) => {
            writeln!(out, "#VRML V{major}.{minor} ascii\n")?
        }
        (Dialect::Vrml2, _) => writeln!(out, "#VRML V{major}.{minor} utf8\n")?,
    }
    let mut printer = Printer {
        tree,
        layout,
        out,
        steps: Vec::new(),
        indent: 0,
    };
    for &root in tree.children_of_root() {
        printer.child(root)?;
        printer.run()?;
        printer.out.write_all(b"\n")?;
    }
    Ok(())
}

impl<'t, 'a> Printer<'t, 'a, '_> {
    fn run(&mut self) -> io::Result<()> {
        while let Some(step) = self.steps.pop() {
            match step {
                Step::Body(node, next) => self.body(node, next)?,
                Step::Interface(node, next) => self.interface(node, next)?,
                Step::Atoms(atoms, next, group) => self.atoms(atoms, next, group)?,
                Step::CloseList => self.out.write_all(b" ]")?,
                Step::Tail(field) => self.tail(field)?,
                Step::Output(name) => {
                    self.out.write_all(b".")?;
                    self.out.write_all(name)?;
                }
                Step::EndLine => self.out.write_all(b"\n")?,
            }
        }
        Ok(())
    }

    fn pad(&mut self) -> io::Result<()> {
        const BLANKS: &[u8] = b"                                ";
        self.out
            .write_all(&BLANKS[..(2 * self.indent).min(BLANKS.len())])
    }

    fn child(&mut self, child: Child<'a>) -> io::Result<()> {
        match child {
            Child::Null => self.out.write_all(b"NULL"),
            Child::Use(name, _) => {
                self.out.write_all(b"USE ")?;
                self.name(name)
            }
            Child::Node(id) => {
                let node = self.tree.node(id);
                match node.form {
                    Form::Node => {}
                    Form::Route => return self.route(id),
                    Form::Proto | Form::ExternProto => {
                        self.out.write_all(node.class)?;
                        self.out.write_all(b" ")?;
                        self.out.write_all(node.def.unwrap_or_default())?;
                        self.out.write_all(b" [\n")?;
                        self.indent += 1;
                        self.steps.push(Step::Interface(id, 0));
                        return Ok(());
                    }
                }
                if let Some(name) = node.def {
                    self.out.write_all(b"DEF ")?;
                    self.name(name)?;
                    self.out.write_all(b" ")?;
                }
                self.out.write_all(if node.class.is_empty() {
                    b"Group"
                } else {
                    node.class
                })?;
                if self.tree.items(id).is_empty() {
                    return self.out.write_all(b" { }");
                }
                self.out.write_all(b" {\n")?;
                self.indent += 1;
                self.steps.push(Step::Body(id, 0));
                Ok(())
            }
        }
    }

    fn body(&mut self, id: NodeId, next: usize) -> io::Result<()> {
        match self.tree.items(id).get(next).copied() {
            None => {
                self.indent -= 1;
                self.pad()?;
                return self.out.write_all(b"}");
            }
            Some(Item::Child(child)) => {
                self.steps.push(Step::Body(id, next + 1));
                self.steps.push(Step::EndLine);
                self.pad()?;
                self.child(child)?;
            }
            Some(Item::Field(field)) => {
                self.steps.push(Step::Body(id, next + 1));
                self.steps.push(Step::EndLine);
                self.pad()?;
                self.field(id, field)?;
            }
        }
        Ok(())
    }

    fn field(&mut self, owner: NodeId, id: FieldId) -> io::Result<()> {
        if let Some(declaration) = self.tree.declaration(id) {
            self.out.write_all(declaration.access.word().as_bytes())?;
            self.out.write_all(b" ")?;
            self.out.write_all(declaration.field_type)?;
            self.out.write_all(b" ")?;
        }
        let field = self.tree.field(id);
        self.out.write_all(field.name)?;
        self.steps.push(Step::Tail(field));
        self.value(self.tree.node(owner).class, field)
    }

    /// The declarations of a prototype, then the beginning of its body, or its URL.
    fn interface(&mut self, id: NodeId, next: usize) -> io::Result<()> {
        let is_declared = |field: &FieldId| self.tree.declaration(*field).is_some();
        match self.tree.items(id).get(next) {
            Some(Item::Field(field)) if is_declared(field) => {
                self.steps.push(Step::Interface(id, next + 1));
                self.steps.push(Step::EndLine);
                self.pad()?;
                return self.field(id, *field);
            }
            _ => {}
        }
        self.indent -= 1;
        self.pad()?;
        self.out.write_all(b"]")?;
        if self.tree.node(id).form == Form::Proto {
            self.out.write_all(b" {\n")?;
            self.indent += 1;
            self.steps.push(Step::Body(id, next));
        } else if let Some(Item::Field(url)) = self.tree.items(id).get(next) {
            let field = self.tree.field(*url);
            self.value(self.tree.node(id).class, field)?;
        }
        Ok(())
    }

    fn route(&mut self, id: NodeId) -> io::Result<()> {
        let Some(Item::Field(field)) = self.tree.items(id).first() else {
            return Ok(());
        };
        let field = self.tree.field(*field);
        self.out.write_all(b"ROUTE ")?;
        self.out.write_all(field.name)?;
        self.out.write_all(b" TO")?;
        self.value(b"ROUTE", field)
    }

    fn value(&mut self, class: &[u8], field: &'t Field<'a>) -> io::Result<()> {
        match &field.value {
            Value::Missing => Ok(()),
            Value::Is(range) => {
                self.out.write_all(b" IS ")?;
                match self.tree.atoms(*range) {
                    [Atom::Word(word, _)] => self.out.write_all(word),
                    _ => Ok(()),
                }
            }
            Value::Mask(range) => {
                self.out.write_all(b" (")?;
                for (i, atom) in self.tree.atoms(*range).iter().enumerate() {
                    if let Atom::Word(word, _) = atom {
                        self.out.write_all(if i == 0 { b"" } else { b" | " })?;
                        self.out.write_all(word)?;
                    }
                }
                self.out.write_all(b")")
            }
            Value::Atoms { atoms, bracketed } => {
                self.out.write_all(if *bracketed { b" [ " } else { b" " })?;
                if *bracketed {
                    self.steps.push(Step::CloseList);
                }
                // Descriptions of fields are pairs of a type and a name.
                let is_pairs = matches!(field.name, b"fields" | b"inputs");
                let group = if is_pairs { 2 } else { 1 };
                let atoms = self.tree.atoms(*atoms);
                self.steps.push(Step::Atoms(atoms, 0, group));
                Ok(())
            }
            Value::Numbers {
                numbers,
                bracketed,
                octal,
                span,
            } => {
                self.out.write_all(if *bracketed { b" [ " } else { b" " })?;
                if *octal {
                    // Which base a leading zero means depends on the reader: keep the tokens.
                    self.out.write_all(&self.tree.source[span.range()])?;
                } else {
                    let tuple = self.layout.tuple_size(class, field.name);
                    self.numbers(numbers, if *bracketed { tuple } else { 0 })?;
                }
                self.out.write_all(if *bracketed { b" ]" } else { b"" })
            }
        }
    }

    fn atoms(&mut self, atoms: &'t [Atom<'a>], next: usize, group: usize) -> io::Result<()> {
        let Some(atom) = atoms.get(next) else {
            return Ok(());
        };
        if next > 0 {
            let ends_group = next.is_multiple_of(group);
            self.out.write_all(if ends_group { b", " } else { b" " })?;
        }
        self.steps.push(Step::Atoms(atoms, next + 1, group));
        match atom {
            Atom::Number(value, _) => write_number(self.out, *value),
            Atom::String(raw, _) => self.string(raw),
            Atom::Word(word, _) => self.out.write_all(word),
            Atom::Child(child) => self.child(*child),
        }
    }

    fn string(&mut self, raw: &[u8]) -> io::Result<()> {
        self.out.write_all(b"\"")?;
        match self.tree.header.encoding {
            Encoding::Ascii => self.out.write_all(raw)?,
            Encoding::Binary => self.out.write_all(&encode_string(raw))?,
        }
        // A backslash at the end would take the quote with it, unless a line end follows.
        let backslash = raw.last() == Some(&b'\\') && self.tree.header.dialect != Dialect::Vrml2;
        self.out.write_all(if backslash { b"\"\n" } else { b"\"" })
    }

    /// The name of a definition; of a binary file, where it can be anything, as text can have it.
    fn name(&mut self, name: &[u8]) -> io::Result<()> {
        match self.tree.header.encoding {
            Encoding::Ascii => self.out.write_all(name),
            Encoding::Binary => self.out.write_all(&encode_name(name)),
        }
    }

    fn tail(&mut self, field: &'t Field<'a>) -> io::Result<()> {
        if field.ignored {
            self.out.write_all(b" ~")?;
        }
        if let Some(connection) = &field.connection {
            self.out.write_all(b" = ")?;
            self.steps.push(Step::Output(connection.output));
            self.child(connection.master)?;
        }
        Ok(())
    }

    fn numbers(&mut self, numbers: &Numbers, tuple: usize) -> io::Result<()> {
        let tree = self.tree;
        if let Some(values) = tree.ints(numbers) {
            for (i, value) in values.iter().enumerate() {
                let before = i.checked_sub(1).map(|b| f64::from(values[b]));
                self.between(i, tuple, before)?;
                write!(self.out, "{value}")?;
            }
        } else if let Some(values) = tree.floats(numbers) {
            for (i, value) in values.iter().enumerate() {
                self.between(i, tuple, i.checked_sub(1).map(|b| values[b]))?;
                write_number(self.out, *value)?;
            }
        }
        Ok(())
    }

    /// What stands between a number and the one before it: a new line for each value of several
    /// numbers, and behind each -1, which ends a face.
    fn between(&mut self, i: usize, tuple: usize, before: Option<f64>) -> io::Result<()> {
        let Some(before) = before else { return Ok(()) };
        let ends_value = tuple > 0 && i.is_multiple_of(tuple);
        if ends_value {
            self.out.write_all(b",")?;
        }
        let line_ends = if tuple > 1 {
            ends_value
        } else {
            before == -1.0
        };
        if line_ends {
            self.out.write_all(b"\n")?;
            self.indent += 1;
            self.pad()?;
            self.indent -= 1;
            return Ok(());
        }
        self.out.write_all(b" ")
    }
}

/// The fewest digits that read back to the same f64; whole numbers without a point.
fn write_number(out: &mut dyn Write, value: f64) -> io::Result<()> {
    // Below 2^53 every whole number is exact in f64.
    if value.fract() == 0.0
        && value.abs() < 9_007_199_254_740_992.0
        && !(value == 0.0 && value.is_sign_negative())
    {
        return write!(out, "{}", value as i64);
    }
    let mut buffer = zmij::Buffer::new();
    out.write_all(buffer.format_finite(value).as_bytes())
}
