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

/// Bytes as text: UTF-8 where they are, else Latin-1, which every byte sequence is.
pub fn text_of(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect(),
    }
}
