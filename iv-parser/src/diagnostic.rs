//! What went wrong in an input, where, and what to do about it.
//!
//! A diagnostic owns all it says, so it outlives the bytes it speaks of. Losses of an output
//! format are not diagnostics; they belong to the writer.

use std::borrow::Cow;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::fmt::{self, Write};
use std::sync::Arc;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Worth knowing; nothing was guessed.
    Note,
    /// Something was guessed, replaced or left out; the rest is right.
    Warning,
    /// A part of the input could not be used.
    Error,
}

/// A place in a file: line and column count from 1, columns in bytes. In a binary file the line is
/// 0 and the column counts all bytes; both are 0 where the place is not known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SourcePos {
    /// Index into the list of files read (0 = the file named by the user).
    pub file: u32,
    /// Line, from 1; 0 when the place is not known, and in a binary file.
    pub line: u32,
    /// Column in bytes, from 1; in a binary file one more than the byte's offset.
    pub column: u32,
}

impl SourcePos {
    /// The byte at an offset of a binary file.
    pub fn at_byte(file: u32, offset: usize) -> Self {
        Self {
            file,
            line: 0,
            column: u32::try_from(offset).map_or(u32::MAX, |offset| offset.saturating_add(1)),
        }
    }

    /// Whether there is a place.
    pub fn is_known(self) -> bool {
        self.column > 0
    }

    /// Line and column, in a text.
    pub fn line_and_column(self) -> Option<(u32, u32)> {
        (self.line > 0).then_some((self.line, self.column))
    }

    /// The offset, in a binary file.
    pub fn byte(self) -> Option<u32> {
        (self.line == 0 && self.column > 0).then(|| self.column - 1)
    }
}

/// As it stands behind a file's name: `:12:5`, or `:byte 1234` in a binary file.
impl fmt::Display for SourcePos {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.line_and_column(), self.byte()) {
            (Some((line, column)), _) => write!(f, ":{line}:{column}"),
            (None, Some(byte)) => write!(f, ":byte {byte}"),
            (None, None) => Ok(()),
        }
    }
}

/// The text around a place, kept for display.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Snippet {
    /// The line, without its end; cut to a readable length.
    pub line: String,
    /// First marked character of `line`, in characters, from 0.
    pub start: usize,
    /// Number of characters marked, at least 1.
    pub len: usize,
}

/// One remark about the input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// Stable short name, such as `unknown-field`.
    pub code: &'static str,
    /// One sentence without a full stop.
    pub message: String,
    /// What to do, or what was done instead; may be empty.
    pub hint: String,
    /// Name of the file as it should be shown.
    pub file: Arc<str>,
    /// Where; line 0 when not known.
    pub pos: SourcePos,
    /// The text there, where it was at hand.
    pub snippet: Option<Snippet>,
}

/// Makes one of those that say the same of the same file, with their number. The first one stays
/// where it is.
#[must_use]
pub fn collapsed(all: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let mut places: HashMap<(u32, &'static str, String, String), usize> = HashMap::new();
    let mut kept: Vec<(Diagnostic, usize)> = Vec::new();
    for one in all {
        let key = (
            one.pos.file,
            one.code,
            one.message.clone(),
            one.hint.clone(),
        );
        match places.entry(key) {
            Entry::Occupied(place) => kept[*place.get()].1 += 1,
            Entry::Vacant(place) => {
                place.insert(kept.len());
                kept.push((one, 1));
            }
        }
    }
    let finish = |(mut one, count): (Diagnostic, usize)| {
        if count > 1 {
            // Writing to a String does not fail.
            let _ = write!(one.message, " ({count} times, first here)");
        }
        one
    };
    kept.into_iter().map(finish).collect()
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Error => "error",
        })
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let message = one_line(&self.message);
        write!(f, "{}{}", one_line(&self.file), self.pos)?;
        write!(f, ": {}[{}]: {message}", self.severity, self.code)?;
        let number = self.pos.line.to_string();
        if let Some(snippet) = &self.snippet {
            let pad = " ".repeat(number.len());
            write!(f, "\n {number} | {}", snippet.line)?;
            write!(
                f,
                "\n {pad} | {}{}",
                " ".repeat(snippet.start),
                "^".repeat(snippet.len)
            )?;
        }
        if !self.hint.is_empty() {
            let pad = " ".repeat(number.len());
            write!(f, "\n {pad} = {}", one_line(&self.hint))?;
        }
        Ok(())
    }
}

/// Names come from the input: a line break in one must not begin what looks like another message.
fn one_line(text: &str) -> Cow<'_, str> {
    if text.contains(['\n', '\r']) {
        text.replace(['\n', '\r'], "\u{fffd}").into()
    } else {
        text.into()
    }
}
