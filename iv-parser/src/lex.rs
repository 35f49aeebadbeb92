//! Tokens other than numbers: blanks and comments, names, words and strings.
//!
//! Every function takes the whole text and a position, and returns the position after the token.

use memchr::{memchr2, memmem};
use nom::IResult;
use nom::Parser;
use nom::bytes::complete::{take_while, take_while1};
use nom::combinator::recognize;

/// Skips eight blanks at a time: machine-written files are a quarter indentation.
#[inline(always)]
pub fn skip_indent(bytes: &[u8], mut at: usize) -> usize {
    while bytes.get(at..at + 8) == Some(b"        ") {
        at += 8;
    }
    at
}

/// White space of Inventor files.
pub fn is_blank(b: u8) -> bool {
    matches!(b, b' ' | b'\t' | b'\n' | b'\r' | 0x0b | 0x0c)
}

fn is_name_start(b: u8) -> bool {
    b.is_ascii_alphabetic() || b == b'_' || b >= 0x80
}

fn is_name_part(b: u8) -> bool {
    is_name_start(b) || b.is_ascii_digit()
}

/// Characters that end an unquoted word.
fn ends_word(b: u8) -> bool {
    is_blank(b)
        || matches!(
            b,
            b'{' | b'}' | b'[' | b']' | b'"' | b'#' | b',' | b'|' | b'(' | b')' | b'~' | 0
        )
}

/// Skips blanks and comments.
pub fn skip_trivia(bytes: &[u8], mut at: usize) -> usize {
    while let Some(&b) = bytes.get(at) {
        if is_blank(b) {
            at = skip_indent(bytes, at + 1);
        } else if b == b'#' {
            at = skip_comment(bytes, at);
        } else {
            break;
        }
    }
    at
}

/// From `#` to the line's end, which may be a lone CR.
pub fn skip_comment(bytes: &[u8], at: usize) -> usize {
    memchr2(b'\n', b'\r', &bytes[at..]).map_or(bytes.len(), |i| at + i)
}

fn plain_name(input: &[u8]) -> IResult<&[u8], &[u8]> {
    recognize((take_while1(is_name_start), take_while(is_name_part))).parse(input)
}

/// The end of the identifier at `at`; `None` if there is none. Parts joined by `.` belong to it
/// (`appearance.material`), as node kits write them.
pub fn name(bytes: &[u8], at: usize) -> Option<usize> {
    let (rest, _) = plain_name(bytes.get(at..)?).ok()?;
    let mut end = bytes.len() - rest.len();
    while bytes.get(end) == Some(&b'.') {
        let Ok((rest, _)) = plain_name(&bytes[end + 1..]) else {
            break;
        };
        end = bytes.len() - rest.len();
    }
    Some(end)
}

/// The end of a VRML 2 identifier at `at`; `None` if there is none (ISO 14772-1, A.3 IdFirstChar
/// and IdRestChars).
pub fn vrml_name(bytes: &[u8], at: usize) -> Option<usize> {
    let is_rest = |b: u8| {
        !matches!(
            b,
            0..=b' ' | b'"' | b'#' | b'\'' | b',' | b'.' | b'[' | b'\\' | b']' | b'{' | b'}' | 0x7f
        )
    };
    let is_first = |b: u8| is_rest(b) && !matches!(b, b'0'..=b'9' | b'+' | b'-');
    is_first(*bytes.get(at)?).then_some(())?;
    let rest = bytes[at..].iter().position(|&b| !is_rest(b));
    Some(rest.map_or(bytes.len(), |i| at + i))
}

/// As [`skip_trivia`], for VRML 2, where a comma is white space.
pub fn skip_vrml_trivia(bytes: &[u8], mut at: usize) -> usize {
    loop {
        at = skip_trivia(bytes, at);
        if bytes.get(at) != Some(&b',') {
            return at;
        }
        at += 1;
    }
}

/// The end of an unquoted word: an enum word, a bool, or a string without quotes.
pub fn word(bytes: &[u8], at: usize) -> usize {
    let found: IResult<&[u8], &[u8]> = take_while(|b| !ends_word(b))(&bytes[at..]);
    found.map_or(at, |(rest, _)| bytes.len() - rest.len())
}

/// The end of everything up to the next blank.
pub fn to_blank(bytes: &[u8], at: usize) -> usize {
    let found: IResult<&[u8], &[u8]> = take_while(|b| !is_blank(b))(&bytes[at..]);
    found.map_or(at, |(rest, _)| bytes.len() - rest.len())
}

/// The end of a name glued to what follows: up to the next blank, bracket or comma.
pub fn name_end(bytes: &[u8], at: usize) -> usize {
    let ends = |b: &u8| is_blank(*b) || matches!(b, b'{' | b'}' | b'[' | b']' | b',');
    bytes[at..]
        .iter()
        .position(ends)
        .map_or(bytes.len(), |i| at + i)
}

/// How a quoted string ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StringEnd {
    /// At its closing quote.
    Closed,
    /// Only when a backslash before a quote was taken as part of the text (`"C:\tex\"`).
    BackslashQuote,
    /// Nowhere; the string was cut at the end of its line.
    Unclosed,
}

/// The string whose opening quote is at `at`: the end of its text, the position after it, and how
/// it ended. `\"` is a quote in the text, except right before a line end.
pub fn string(bytes: &[u8], at: usize) -> (usize, usize, StringEnd) {
    let start = at + 1;
    let mut i = start;
    while let Some(found) = memchr2(b'"', b'\\', &bytes[i..]) {
        let hit = i + found;
        if bytes[hit] == b'"' {
            return (hit, hit + 1, StringEnd::Closed);
        }
        if bytes.get(hit + 1) == Some(&b'"') {
            if matches!(bytes.get(hit + 2), Some(b'\n' | b'\r')) {
                return (hit + 1, hit + 2, StringEnd::Closed);
            }
            i = hit + 2;
        } else {
            i = hit + 1;
        }
    }
    open_string(bytes, at)
}

/// As [`string`], for VRML 2, where a backslash takes the next character with it.
pub fn vrml_string(bytes: &[u8], at: usize) -> (usize, usize, StringEnd) {
    let mut i = at + 1;
    while let Some(found) = memchr2(b'"', b'\\', bytes.get(i..).unwrap_or_default()) {
        let hit = i + found;
        if bytes[hit] == b'"' {
            return (hit, hit + 1, StringEnd::Closed);
        }
        i = hit + 2;
    }
    open_string(bytes, at)
}

/// The string whose opening quote is at `at`, in a text where nothing closes it.
pub fn open_string(bytes: &[u8], at: usize) -> (usize, usize, StringEnd) {
    let start = at + 1;
    if let Some(found) = memmem::find(&bytes[start..], b"\\\"") {
        let quote = start + found + 1;
        return (quote, quote + 1, StringEnd::BackslashQuote);
    }
    let line_end = memchr2(b'\n', b'\r', &bytes[start..]).map_or(bytes.len(), |i| start + i);
    (line_end, line_end, StringEnd::Unclosed)
}
