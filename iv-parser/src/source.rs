//! Places in a source text: byte spans, lines and columns, and problems found there.

use std::sync::Arc;

use memchr::{memchr, memchr_iter, memrchr};

use crate::diagnostic::{Diagnostic, Severity, Snippet, SourcePos, collapsed};
use crate::header::is_binary;

/// A range of bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Span {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// The span of `start..end`.
    pub fn new(start: usize, end: usize) -> Self {
        Self {
            start: start as u32,
            end: end as u32,
        }
    }

    /// As array positions.
    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// A remark about a span, not yet tied to a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// How bad it is.
    pub severity: Severity,
    /// Stable short name.
    pub code: &'static str,
    /// One sentence without a full stop.
    pub message: String,
    /// What to do, or what was done instead; may be empty.
    pub hint: String,
    /// Where.
    pub span: Span,
}

/// The problems of a file, the first of them kept and the rest counted.
#[derive(Debug)]
pub(crate) struct Problems {
    pub list: Vec<Problem>,
    pub dropped: usize,
    /// Most that are kept.
    most: usize,
}

impl Problems {
    pub fn new(list: Vec<Problem>, most: usize) -> Self {
        Self {
            list,
            dropped: 0,
            most,
        }
    }

    pub fn add(
        &mut self,
        severity: Severity,
        code: &'static str,
        message: &str,
        hint: &str,
        span: Span,
    ) {
        if self.list.len() >= self.most {
            self.dropped += 1;
            return;
        }
        self.list.push(Problem {
            severity,
            code,
            message: message.to_owned(),
            hint: hint.to_owned(),
            span,
        });
    }
}

/// A named text, to turn spans into places.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// Name for display.
    pub name: &'a Arc<str>,
    /// Index of the file among those read.
    pub file: u32,
    /// The text.
    pub bytes: &'a [u8],
}

/// Longest part of a line that a snippet shows, in characters.
const SNIPPET_CHARS: usize = 120;

impl Source<'_> {
    /// The problems in order of place, each with its line and the text there; those that say the
    /// same are one, at the place of the first. One pass over the text serves all.
    pub fn diagnostics(&self, mut problems: Vec<Problem>) -> Vec<Diagnostic> {
        problems.sort_by_key(|p| p.span.start);
        let mut lines = LineCounter::new(self.file);
        let finish = |problem| self.diagnostic(problem, &mut lines);
        collapsed(problems.into_iter().map(finish).collect())
    }

    fn diagnostic(&self, problem: Problem, lines: &mut LineCounter) -> Diagnostic {
        let at = (problem.span.start as usize).min(self.bytes.len());
        // An empty span at the beginning means the file as a whole.
        let has_place = problem.span != Span::default();
        Diagnostic {
            severity: problem.severity,
            code: problem.code,
            message: problem.message,
            hint: problem.hint,
            file: Arc::clone(self.name),
            pos: match has_place {
                true => lines.position(self.bytes, at),
                false => SourcePos {
                    file: self.file,
                    ..SourcePos::default()
                },
            },
            snippet: has_place
                .then(|| self.snippet(at, problem.span.end as usize))
                .flatten(),
        }
    }

    fn snippet(&self, at: usize, end: usize) -> Option<Snippet> {
        if is_binary(self.bytes) {
            return None;
        }
        let is_end = |b: &u8| *b == b'\n' || *b == b'\r';
        let line_start = self.bytes[..at]
            .iter()
            .rposition(is_end)
            .map_or(0, |i| i + 1);
        let tail = &self.bytes[line_start..];
        let line_end = line_start + tail.iter().position(is_end).unwrap_or(tail.len());
        // Machine-written lines can be megabytes long: show a window around the place.
        let from = if at - line_start > SNIPPET_CHARS / 2 {
            at - SNIPPET_CHARS / 2
        } else {
            line_start
        };
        let to = line_end.min(from + SNIPPET_CHARS);
        if from >= to {
            return None;
        }
        let show = |bytes: &[u8]| {
            String::from_utf8_lossy(bytes)
                .chars()
                .map(|c| if c == '\t' || c.is_control() { ' ' } else { c })
                .collect::<String>()
        };
        let before = show(&self.bytes[from..at.min(to)]);
        let marked = show(&self.bytes[at.min(to)..end.clamp(at, to).max(at.min(to))]);
        let line = show(&self.bytes[from..to]);
        Some(Snippet {
            start: before.chars().count(),
            len: marked.chars().count().max(1),
            line: line.trim_end().to_owned(),
        })
    }
}

/// Turns increasing byte offsets into lines and columns with one pass over the text.
///
/// Lines end at LF, CRLF or a lone CR.
#[derive(Clone, Debug)]
pub struct LineCounter {
    file: u32,
    line: u32,
    line_start: usize,
    counted_to: usize,
    lines: Option<Lines>,
}

/// What ends the lines of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Lines {
    /// LF, also behind CR.
    Lf,
    /// A lone CR, as on old Macintoshes.
    Cr,
    /// A binary file has none: its places are bytes.
    None,
}

impl Lines {
    fn of(bytes: &[u8]) -> Self {
        if is_binary(bytes) {
            Self::None
        } else if memchr(b'\n', bytes).is_some() {
            Self::Lf
        } else {
            Self::Cr
        }
    }
}

impl LineCounter {
    /// At the first byte of file number `file`.
    pub fn new(file: u32) -> Self {
        Self {
            file,
            line: 1,
            line_start: 0,
            counted_to: 0,
            lines: None,
        }
    }

    /// The place of byte `at`. An offset before the last one asked for starts over.
    pub fn position(&mut self, bytes: &[u8], at: usize) -> SourcePos {
        let at = at.min(bytes.len());
        if at < self.counted_to {
            *self = Self::new(self.file);
        }
        let end = match *self.lines.get_or_insert_with(|| Lines::of(bytes)) {
            Lines::None => return SourcePos::at_byte(self.file, at),
            Lines::Lf => b'\n',
            Lines::Cr => b'\r',
        };
        let passed = &bytes[self.counted_to..at];
        self.line += memchr_iter(end, passed).count() as u32;
        if let Some(i) = memrchr(end, passed) {
            self.line_start = self.counted_to + i + 1;
        }
        self.counted_to = at;
        SourcePos {
            file: self.file,
            line: self.line,
            column: (at - self.line_start) as u32 + 1,
        }
    }
}
