//! The document `docs/NODES.md`, generated from the registry.

use std::fmt::Write;

use super::{Class, ClassSpec, Family, FieldSpec, OLD_FIELDS, OldFields, Support};

const HEAD: &str = "\
# Open Inventor classes

This page lists every node, engine, kit and dragger class that is known by name, with its fields.
It is generated from the table in `scenegraph/src/registry`; a test fails when the two differ, and
rewrites this page when it is run with `UPDATE_DOCS=1`.

A class that is not listed here is read as an unknown node. The classes of VRML 2.0 have the prefix
`VRML`; files that begin with `#VRML V2.0` write them without it.

| support | meaning |
|---|---|
| full | Everything the class does to a static model takes effect. |
| partial | Its main effect is there; the note says what is missing. |
| kept | Read and written back. It has no effect on a static model. |
| planned | Recognised and read, but its geometry or effect is not there yet: reported as a loss. |

Fields are given as `name type = default`, with the words an enum or bit mask accepts in braces.
Angles are in radians. A default of `[]` is an empty list.
";

const OLD_HEAD: &str = "
## Fields of old files

Fields that a class had in old files only, or had with another type, default or other words. They
are understood in files of that version or older.

| class | up to version | fields |
|---|---|---|
";

/// The text of `docs/NODES.md`: a table of classes for each family, then the fields that only
/// old files have. It depends on the registry alone.
#[must_use]
pub fn nodes_markdown() -> String {
    let mut text = HEAD.to_owned();
    write_totals(&mut text);
    for &family in Family::ALL {
        write_family(&mut text, family);
    }
    text.push_str(OLD_HEAD);
    for old in OLD_FIELDS {
        text.push_str(&old_row(old));
    }
    text
}

/// How many classes stand at each level.
fn write_totals(text: &mut String) {
    let at_level = |support: &Support| {
        let classes = Class::ALL.iter();
        let count = classes.filter(|class| class.spec().support == *support);
        format!("{} {}", count.count(), support.title())
    };
    let levels: Vec<String> = Support::ALL.iter().map(at_level).collect();
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "\n{} classes: {}.",
        Class::ALL.len(),
        levels.join(", ")
    );
}

fn write_family(text: &mut String, family: Family) {
    let _ = write!(
        text,
        "\n## {}\n\n| class | support | fields | note |\n|---|---|---|---|\n",
        family.title()
    );
    let in_family = |class: &&Class| class.spec().family == family;
    for class in Class::ALL.iter().filter(in_family) {
        text.push_str(&class_row(class.spec()));
    }
}

fn class_row(spec: &ClassSpec) -> String {
    let base = match spec.base {
        Some(base) => format!(" (as {})", base.name()),
        None => String::new(),
    };
    format!(
        "| {}{base} | {} | {} | {} |\n",
        spec.name,
        spec.support.title(),
        field_list(spec.fields),
        spec.note
    )
}

fn old_row(old: &OldFields) -> String {
    let (major, minor) = old.until;
    let fields = field_list(old.fields);
    format!("| {} | {major}.{minor} | {fields} |\n", old.class.name())
}

/// One line per field inside a table cell.
fn field_list(fields: &[FieldSpec]) -> String {
    let lines: Vec<String> = fields.iter().map(field_text).collect();
    lines.join("<br>")
}

fn field_text(field: &FieldSpec) -> String {
    let mut text = format!("`{} {}`", field.name, field.field_type.name());
    if !field.default.is_empty() {
        let _ = write!(text, " = `{}`", field.default);
    }
    if !field.words.is_empty() {
        let words: Vec<&str> = field.words.iter().map(|word| word.name).collect();
        let _ = write!(text, " {{{}}}", words.join(", "));
    }
    text
}
