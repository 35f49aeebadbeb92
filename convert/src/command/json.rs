//! JSON as the commands write it: objects have their keys in sorted order, and
//! nothing in them depends on time or machine.

use iv_parser::{Diagnostic, SourcePos};
use serde_json::{Value, json};

/// A document as text, indented, with a line end behind it.
pub fn text(document: &Value) -> String {
    format!("{document:#}\n")
}

/// Diagnostics: `line` and `column` are null when the place is not known, and in a binary file,
/// which has `byte` instead.
pub fn diagnostics(list: &[Diagnostic]) -> Value {
    list.iter().map(diagnostic).collect()
}

fn diagnostic(diagnostic: &Diagnostic) -> Value {
    let (line, column, byte) = place(diagnostic.pos);
    json!({
        "severity": diagnostic.severity.to_string(),
        "code": diagnostic.code,
        "message": diagnostic.message,
        "hint": diagnostic.hint,
        "file": *diagnostic.file,
        "line": line,
        "column": column,
        "byte": byte,
    })
}

/// Line and column in a text, the offset in a binary file, if the place is known.
pub fn place(pos: SourcePos) -> (Option<u32>, Option<u32>, Option<u32>) {
    let (line, column) = pos.line_and_column().unzip();
    (line, column, pos.byte())
}
