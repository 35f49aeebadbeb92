//! Runs of numbers in bulk: one pass, no object a number.
//!
//! Which fields hold integers is not known here, so a run begins as integers and turns into floats
//! at the first token with a point, an exponent or a large value.

use super::Parser;
use super::plain::{self, Stop};
use crate::diagnostic::Severity;
use crate::lex;
use crate::number::{Number, Remark, number};
use crate::source::Span;
use crate::tree::{FieldId, Numbers, Value};

impl Parser<'_> {
    /// Whether a number, or a word for one that is not a number, is here.
    pub(super) fn number_here(&self) -> bool {
        match self.peek() {
            Some(b'0'..=b'9') => true,
            Some(b'+' | b'-' | b'.') => {
                number(self.bytes, self.at).is_some() || self.nan_word(self.at).is_some()
            }
            Some(b'n' | b'N' | b'i' | b'I') => self.nan_word(self.at).is_some(),
            _ => false,
        }
    }

    /// The end of `nan`, `inf` and the like, with or without a sign.
    fn nan_word(&self, at: usize) -> Option<usize> {
        let start = at + usize::from(matches!(self.bytes.get(at), Some(b'+' | b'-')));
        let end = lex::name(self.bytes, start)?;
        let word = &self.bytes[start..end];
        [&b"nan"[..], b"inf", b"infinity", b"ind"]
            .iter()
            .any(|w| word.eq_ignore_ascii_case(w))
            .then_some(end)
    }

    /// The run of numbers here, in brackets (the opening one is behind us) or not.
    pub(super) fn numbers(&mut self, field: FieldId, bracketed: bool) {
        let open = self.at;
        let mut run = std::mem::take(&mut self.run);
        let mut octal = false;
        let mut end = self.at;
        let mut comma = false;
        loop {
            let stop = run.plain(self.bytes, self.at, comma, bracketed);
            self.at = stop.at;
            comma = stop.comma;
            end = stop.end.unwrap_or(end);
            let at = self.at;
            if let Some((value, after, remark)) = number(self.bytes, at) {
                if remark != Remark::None {
                    octal |= remark == Remark::Octal && !self.vrml2;
                    self.remark(remark, Span::new(at, after));
                }
                run.push(value);
                end = after;
                self.at = after;
                comma = false;
                continue;
            }
            match self.peek() {
                Some(b'#') => self.at = lex::skip_comment(self.bytes, at),
                // In VRML 2 commas are blanks. Outside brackets the next number belongs to the value
                // only by its field's type, which readers of the tree know.
                Some(b',') if self.vrml2 && (bracketed || self.number_follows_comma(at)) => {
                    self.at = self.next_token(at);
                }
                Some(b',') if bracketed || self.number_follows_comma(at) => {
                    if comma {
                        self.warn(
                            "stray-comma",
                            "two commas in a row",
                            "one was ignored",
                            Span::new(at, at + 1),
                        );
                    } else if !bracketed {
                        self.warn(
                            "no-brackets",
                            "several values without brackets",
                            "they were taken as a list; write `[ a, b ]`",
                            Span::new(at, at + 1),
                        );
                    }
                    comma = true;
                    self.at += 1;
                }
                _ => {
                    if let Some(after) = self.nan_word(at) {
                        self.remark(Remark::NotANumber, Span::new(at, after));
                        run.push(Number::Float(0.0));
                        end = after;
                        self.at = after;
                    } else if !bracketed {
                        self.at = end;
                        break;
                    } else if self.end_of_list(open) {
                        break;
                    }
                }
            }
        }
        let span = Span::new(open, end);
        let numbers = self.store(run);
        self.tree.fields[field.0 as usize].value = Value::Numbers {
            numbers,
            bracketed,
            octal,
            span,
        };
    }

    fn number_follows_comma(&self, at: usize) -> bool {
        let next = self.next_token(at + 1);
        number(self.bytes, next).is_some()
    }

    /// Something that is no number, in brackets: true if the list ends here.
    fn end_of_list(&mut self, open: usize) -> bool {
        let at = self.at;
        match self.peek() {
            Some(b']') => {
                self.at += 1;
                true
            }
            None | Some(b'}' | b'{') => {
                self.missing_bracket(open.saturating_sub(1));
                true
            }
            Some(_) => {
                // A word with a value behind it is the next field: the bracket was forgotten.
                if let Some(end) = self.name(at) {
                    let next = self.bytes.get(self.next_token(end));
                    if matches!(next, Some(b'[' | b'{' | b'"' | b'a'..=b'z' | b'A'..=b'Z')) {
                        self.missing_bracket(open.saturating_sub(1));
                        return true;
                    }
                }
                self.skip_junk();
                self.warn(
                    "not-a-number",
                    "this is not a number",
                    "it was left out of the list",
                    Span::new(at, self.at),
                );
                false
            }
        }
    }

    #[cold]
    fn remark(&mut self, remark: Remark, span: Span) {
        let (reported, code, message, hint) = match remark {
            Remark::None | Remark::Octal => return,
            Remark::NoExponent => (
                false,
                "bad-exponent",
                "an exponent without digits",
                "it was ignored",
            ),
            Remark::Overflow => (
                std::mem::replace(&mut self.overflow_reported, true),
                "overflow",
                "a number is too large for any field",
                "it was cut to the largest one; later ones are not reported",
            ),
            Remark::NotANumber => (
                std::mem::replace(&mut self.nan_reported, true),
                "not-a-number",
                "a value that is not a number",
                "it was read as 0; later ones are not reported",
            ),
        };
        if !reported {
            self.problem(Severity::Warning, code, message, hint, span);
        }
    }

    fn store(&mut self, mut run: Run) -> Numbers {
        let numbers = if run.is_float {
            self.tree.add_floats(&mut run.floats)
        } else {
            self.tree.add_ints(&mut run.ints)
        };
        run.clear();
        self.run = run;
        numbers
    }
}

/// The numbers of a run read so far: in `ints` until the first float, then in `floats`.
#[derive(Default)]
pub(super) struct Run {
    ints: Vec<i32>,
    floats: Vec<f64>,
    is_float: bool,
}

impl Run {
    /// Reads plain numbers from `at` on.
    fn plain(&mut self, bytes: &[u8], at: usize, comma: bool, commas: bool) -> Stop {
        let stop = Stop {
            at,
            end: None,
            comma,
        };
        if self.is_float {
            plain::floats(bytes, stop, commas, &mut self.floats)
        } else {
            plain::ints(bytes, stop, commas, &mut self.ints)
        }
    }

    #[inline(always)]
    fn push(&mut self, value: Number) {
        match (self.is_float, value) {
            (false, Number::Int(i)) => self.ints.push(i),
            (true, Number::Float(f)) => self.floats.push(f),
            (true, Number::Int(i)) => self.floats.push(f64::from(i)),
            (false, Number::Float(f)) => self.widen(f),
        }
    }

    #[cold]
    fn widen(&mut self, next: f64) {
        self.floats.extend(self.ints.iter().map(|&i| f64::from(i)));
        self.floats.push(next);
        self.is_float = true;
    }

    fn clear(&mut self) {
        self.ints.clear();
        self.floats.clear();
        self.is_float = false;
    }
}
