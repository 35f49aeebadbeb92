//! What the bytes of a string mean as text.

use std::borrow::Cow;

use crate::header::Dialect;

/// The bytes between the quotes with escapes resolved. Inventor knows one escape, `\"`; VRML 2
/// also `\\`.
pub fn decode_string(raw: &[u8], dialect: Dialect) -> Cow<'_, [u8]> {
    if !raw.contains(&b'\\') {
        return Cow::Borrowed(raw);
    }
    let mut text = Vec::with_capacity(raw.len());
    let mut rest = raw;
    while let [first, tail @ ..] = rest {
        let escaped = match tail.first() {
            Some(b'"') if *first == b'\\' => Some(b'"'),
            Some(b'\\') if *first == b'\\' && dialect == Dialect::Vrml2 => Some(b'\\'),
            _ => None,
        };
        text.push(escaped.unwrap_or(*first));
        rest = if escaped.is_some() { &tail[1..] } else { tail };
    }
    Cow::Owned(text)
}

/// What stands between the quotes in Inventor text for these bytes: [`decode_string`] gives them
/// back. A quote before a line end would end the text there: it gets a blank behind it.
pub fn encode_string(bytes: &[u8]) -> Cow<'_, [u8]> {
    if !bytes.contains(&b'"') {
        return Cow::Borrowed(bytes);
    }
    let mut raw = Vec::with_capacity(bytes.len() + 8);
    for (i, &b) in bytes.iter().enumerate() {
        if b == b'"' {
            raw.push(b'\\');
        }
        raw.push(b);
        if b == b'"' && matches!(bytes.get(i + 1), Some(b'\n' | b'\r')) {
            raw.push(b' ');
        }
    }
    Cow::Owned(raw)
}

/// A name as it can stand behind `DEF`: `_` for what would end it or mean something else.
pub fn encode_name(name: &[u8]) -> Cow<'_, [u8]> {
    let breaks = |b: u8| b <= b' ' || b == 0x7f || b"{}[](),\"#".contains(&b);
    if !name.iter().any(|b| breaks(*b)) {
        return Cow::Borrowed(name);
    }
    let kept = |b: &u8| if breaks(*b) { b'_' } else { *b };
    Cow::Owned(name.iter().map(kept).collect())
}

/// Bytes as text: UTF-8 where they are, else Latin-1, which every byte sequence is.
pub fn text_of(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strings_come_back_from_text() {
        for bytes in [
            &b""[..],
            b"plain",
            b"a \"quote\"",
            b"C:\\tex\\wood.png",
            b"\\\"",
            b"\\\\\"\"\\x",
            b"ends with \\",
            b"two\nlines",
        ] {
            let raw = encode_string(bytes);
            assert_eq!(decode_string(&raw, Dialect::Inventor), bytes);
        }
        assert_eq!(encode_string(b"a\"\nb"), &b"a\\\" \nb"[..]);
    }
}
