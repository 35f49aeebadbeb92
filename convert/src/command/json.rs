//! JSON as the commands write it: objects have their keys in sorted order, and
//! nothing in them depends on time or machine.

use iv_parser::{Diagnostic, SourcePos};
use serde_json::{Value, json};

/// A document as text, indented, with a line end behind it.
pub fn text(document: &Value) -> String {
    format!("{document:#}\n")
}

/// Diagnostics: `line` and `column` are null when the place is not known.
pub fn diagnostics(list: &[Diagnostic]) -> Value {
    list.iter().map(diagnostic).collect()
}

fn diagnostic(diagnostic: &Diagnostic) -> Value {
    let (line, column) = place(diagnostic.pos);
    json!({
        "severity": diagnostic.severity.to_string(),
        "code": diagnostic.code,
        "message": diagnostic.message,
        "hint": diagnostic.hint,
        "file": *diagnostic.file,
        "line": line,
        "column": column,
    })
}

/// Line and column, if the place is known.
pub fn place(pos: SourcePos) -> (Option<u32>, Option<u32>) {
    let is_known = pos.line > 0;
    (is_known.then_some(pos.line), is_known.then_some(pos.column))
}
