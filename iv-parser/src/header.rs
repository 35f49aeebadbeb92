//! The first line: which dialect, which version, text or binary.

use nom::IResult;
use nom::Parser;
use nom::branch::alt;
use nom::bytes::complete::{tag, tag_no_case, take_while1};
use nom::character::complete::{char, one_of, space1, u8 as small_number};
use nom::combinator::value;
use nom::sequence::separated_pair;

use crate::diagnostic::Severity;
use crate::source::{Problem, Span};

/// Which family of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dialect {
    /// `#Inventor`.
    Inventor,
    /// `#VRML V1.0`.
    Vrml1,
    /// `#VRML V2.0`, also called VRML 97.
    Vrml2,
}

/// How the body is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Text.
    Ascii,
    /// Big-endian words.
    Binary,
}

/// What the first line says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Header {
    /// Family.
    pub dialect: Dialect,
    /// Major and minor version; 2.1 when there is no header.
    pub version: (u8, u8),
    /// Text or binary.
    pub encoding: Encoding,
}

impl Header {
    /// What a text without a header is taken for.
    pub const ASSUMED: Self = Self {
        dialect: Dialect::Inventor,
        version: (2, 1),
        encoding: Encoding::Ascii,
    };

    /// Whether this is an Inventor file older than version `major.minor`.
    pub fn is_older_than(&self, major: u8, minor: u8) -> bool {
        self.dialect == Dialect::Inventor && self.version < (major, minor)
    }
}

fn version(input: &[u8]) -> IResult<&[u8], (u8, u8)> {
    let (input, _) = one_of("Vv")(input)?;
    separated_pair(small_number, char('.'), small_number).parse(input)
}

fn header_line(input: &[u8]) -> IResult<&[u8], Header> {
    let (input, dialect) = alt((
        value(Dialect::Inventor, tag(&b"#Inventor"[..])),
        value(Dialect::Vrml1, tag(&b"#VRML"[..])),
    ))
    .parse(input)?;
    let (input, version) = nom::sequence::preceded(space1, version).parse(input)?;
    let (input, encoding) = nom::sequence::preceded(
        space1,
        alt((
            value(Encoding::Ascii, tag_no_case(&b"asci"[..])),
            value(Encoding::Ascii, tag_no_case(&b"utf8"[..])),
            value(Encoding::Binary, tag_no_case(&b"binary"[..])),
        )),
    )
    .parse(input)?;
    let dialect = match dialect {
        Dialect::Vrml1 if version.0 >= 2 => Dialect::Vrml2,
        other => other,
    };
    Ok((
        input,
        Header {
            dialect,
            version,
            encoding,
        },
    ))
}

/// Reads the header. Returns it with the offset at which the body begins (the header itself is a
/// comment to the body's grammar, so text bodies begin at it).
pub fn read_header(bytes: &[u8], problems: &mut Vec<Problem>) -> (Header, usize) {
    let mut at = 0;
    let mut note = |code, message: &str, hint: &str, span| {
        problems.push(Problem {
            severity: Severity::Warning,
            code,
            message: message.to_owned(),
            hint: hint.to_owned(),
            span,
        });
    };
    if bytes.starts_with(b"\xef\xbb\xbf") {
        at = 3;
        note(
            "byte-order-mark",
            "a byte order mark stands before the header",
            "it was skipped",
            Span::new(0, 3),
        );
    }
    let blanks = bytes[at..]
        .iter()
        .take_while(|b| b.is_ascii_whitespace())
        .count();
    if let Ok((rest, header)) = header_line(&bytes[at + blanks..]) {
        let end = bytes.len() - rest.len();
        let span = Span::new(at + blanks, end);
        if blanks > 0 {
            note(
                "late-header",
                "the header is not at the very beginning of the file",
                "the blanks before it were skipped",
                span,
            );
        }
        let known = matches!(
            (header.dialect, header.version),
            (Dialect::Inventor, (1, 0) | (2, 0..=6))
                | (Dialect::Vrml1, (1, 0))
                | (Dialect::Vrml2, (2, 0))
        );
        if !known {
            note(
                "unknown-version",
                "this version is not known",
                "the newest known version was assumed",
                span,
            );
        }
        return (header, at + blanks);
    }
    let line_end = bytes
        .iter()
        .position(|&b| b == b'\n' || b == b'\r')
        .unwrap_or(bytes.len());
    note(
        "no-header",
        &format!("the first line is not an Inventor header{}", foreign(bytes)),
        "`#Inventor V2.1 ascii` was assumed",
        Span::new(0, line_end.min(80)),
    );
    (Header::ASSUMED, at)
}

/// What a file without our header looks like, for the message.
fn foreign(bytes: &[u8]) -> &'static str {
    const SIGNS: &[(&[u8], &str)] = &[
        (b"\x1f\x8b", " (this looks like a gzip archive)"),
        (b"BZh", " (this looks like a bzip2 archive)"),
        (b"PK\x03\x04", " (this looks like a zip archive)"),
        (b"#X3D", " (this looks like X3D)"),
        (b"<?xml", " (this looks like XML)"),
        (b"glTF", " (this looks like glTF)"),
        (b"solid ", " (this looks like STL)"),
        (b"ply", " (this looks like PLY)"),
        (b"\x89PNG", " (this looks like a PNG image)"),
    ];
    let first_word: IResult<&[u8], &[u8]> = take_while1(|b: u8| b != b' ' && b != b'\n')(bytes);
    let is_obj = matches!(first_word, Ok((_, b"v" | b"mtllib" | b"vn")));
    SIGNS
        .iter()
        .find(|(sign, _)| bytes.starts_with(sign))
        .map_or(
            if is_obj {
                " (this looks like Wavefront OBJ)"
            } else {
                ""
            },
            |(_, text)| text,
        )
}
