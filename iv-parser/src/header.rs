//! The first line: which dialect, which version, text or binary.

use nom::IResult;
use nom::Parser;
use nom::branch::alt;
use nom::bytes::complete::{tag, tag_no_case};
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

    /// The header with which bytes begin, if there is one.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        header_line(text.trim_ascii_start())
            .ok()
            .map(|(_, header)| header)
    }

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
    let span = Span::new(0, line_end.min(80));
    match foreign(bytes) {
        Some((what, hint)) => problems.push(Problem {
            severity: Severity::Error,
            code: "unsupported-format",
            message: format!("this is {what}, not an Inventor file"),
            hint: hint.to_owned(),
            span: Span::default(),
        }),
        None => note(
            "no-header",
            "the first line is not an Inventor header",
            "`#Inventor V2.1 ascii` was assumed",
            span,
        ),
    }
    (Header::ASSUMED, at)
}

/// Whether the first line says that what follows is binary.
pub fn is_binary(bytes: &[u8]) -> bool {
    Header::of(bytes).is_some_and(|header| header.encoding == Encoding::Binary)
}

/// What a file without our header is, and what to do with it, if its first bytes tell.
fn foreign(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    const UNPACK: &str = "what is packed twice is not read";
    const CONVERT: &str = "only Inventor and VRML files are read";
    const SIGNS: &[(&[u8], &str, &str)] = &[
        (b"\x1f\x8b", "packed with gzip", UNPACK),
        (b"BZh", "packed with bzip2", UNPACK),
        (
            b"PK\x03\x04",
            "a zip archive",
            "only the archive given to the command is opened",
        ),
        (b"\xff\xfe", "UTF-16 text", "save it as UTF-8"),
        (b"\xfe\xff", "UTF-16 text", "save it as UTF-8"),
        (b"#X3D", "X3D", CONVERT),
        (b"<?xml", "XML", CONVERT),
        (b"glTF", "glTF", CONVERT),
        (b"solid ", "STL", CONVERT),
        (b"ply\n", "PLY", CONVERT),
        (b"ply\r", "PLY", CONVERT),
        (b"\x89PNG", "a PNG image", CONVERT),
        (b"\xff\xd8\xff", "a JPEG image", CONVERT),
        (b"GIF8", "a GIF image", CONVERT),
        (b"%PDF", "a PDF document", CONVERT),
        (b"\x7fELF", "a program", CONVERT),
        (b"mtllib ", "Wavefront OBJ", CONVERT),
    ];
    let found = SIGNS.iter().find(|(sign, ..)| bytes.starts_with(sign));
    found.map(|&(_, what, hint)| (what, hint))
}
