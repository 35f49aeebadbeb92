//! What tests of reading and of writing share: a few classes, bytes put together by hand, trees and
//! problems in short.

use super::{ClassShape, Schema, ValueKind, ValueType};
use crate::header::Header;
pub(super) use crate::parse::tests::brief;
use crate::{Limits, Parse, Problem, parse_any};

/// A few classes.
pub(super) struct Known;

const fn of(kind: ValueKind, size: u8, is_list: bool) -> ValueType {
    ValueType {
        kind,
        size,
        is_list,
    }
}

impl Schema for Known {
    fn class(&self, class: &[u8], header: &Header) -> Option<ClassShape> {
        let (is_group, has_fields) = match class {
            b"Group" => (true, false),
            b"Separator" => (true, header.version > (1, 0)),
            b"Switch" => (true, true),
            b"Default" => (false, false),
            b"Shape" | b"Gate" | b"Kit" => (false, true),
            _ => return None,
        };
        Some(ClassShape {
            is_group,
            has_fields,
        })
    }

    fn field(&self, class: &[u8], field: &[u8], _: &Header) -> Option<ValueType> {
        use ValueKind::{
            Double, Flag, Image, Int, Mask, Node, Nothing, Text, Unsigned, Wide, Word,
        };
        let known: &[&[u8]] = &[b"Shape", b"Switch", b"Separator"];
        match field {
            _ if class == b"Kit" => Some(of(Node, 1, false)),
            _ if !known.contains(&class) => None,
            b"flag" => Some(of(Flag, 1, false)),
            b"int" => Some(of(Int, 1, false)),
            b"ints" => Some(of(Int, 1, true)),
            b"colors" => Some(of(Unsigned, 1, true)),
            b"wide" => Some(of(Wide, 1, false)),
            b"time" => Some(of(Double, 1, false)),
            b"point" => Some(of(ValueKind::Float, 3, true)),
            b"size" => Some(of(ValueKind::Float, 1, false)),
            b"text" => Some(of(Text, 1, false)),
            b"texts" => Some(of(Text, 1, true)),
            b"style" => Some(of(Word, 1, false)),
            b"parts" => Some(of(Mask, 1, false)),
            b"node" => Some(of(Node, 1, false)),
            b"nodes" => Some(of(Node, 1, true)),
            b"image" => Some(of(Image, 1, false)),
            b"touch" => Some(of(Nothing, 1, false)),
            _ => None,
        }
    }

    fn named_type(&self, name: &[u8]) -> Option<ValueType> {
        match name {
            b"SFInt32" => Some(of(ValueKind::Int, 1, false)),
            b"SFFloat" => Some(of(ValueKind::Float, 1, false)),
            b"MFFloat" => Some(of(ValueKind::Float, 1, true)),
            b"SFNode" => Some(of(ValueKind::Node, 1, false)),
            _ => None,
        }
    }

    fn name_of(&self, wanted: ValueType) -> Option<&'static str> {
        let all = ["SFInt32", "SFFloat", "MFFloat", "SFNode"];
        all.into_iter()
            .find(|name| self.named_type(name.as_bytes()) == Some(wanted))
    }

    fn default_text(&self, _: &[u8], field: &[u8], _: &Header) -> Option<&'static str> {
        (field == b"int").then_some("7")
    }
}

/// The bytes of a file: numbers are words, `1.5` floats, `"…"` strings, `'…'` raw bytes, and
/// anything else is a string too.
pub(super) fn bytes(version: &str, body: &str) -> Vec<u8> {
    let mut out = format!("#Inventor V{version} binary  \n").into_bytes();
    let mut rest = body.trim_start();
    while !rest.is_empty() {
        let (item, tail) = if let Some(inside) = rest.strip_prefix('\'') {
            let (raw, tail) = inside.split_once('\'').unwrap();
            out.extend(raw.bytes());
            rest = tail.trim_start();
            continue;
        } else if let Some(inside) = rest.strip_prefix('"') {
            inside.split_once('"').unwrap()
        } else {
            let (item, tail) = rest.split_once(' ').unwrap_or((rest, ""));
            if let Ok(word) = item.parse::<i64>() {
                out.extend((word as u32).to_be_bytes());
                rest = tail.trim_start();
                continue;
            }
            if let Some(double) = item.strip_suffix('d').and_then(|d| d.parse::<f64>().ok()) {
                out.extend(double.to_be_bytes());
                rest = tail.trim_start();
                continue;
            }
            if let Ok(float) = item.parse::<f32>() {
                out.extend(float.to_be_bytes());
                rest = tail.trim_start();
                continue;
            }
            (item, tail)
        };
        out.extend((item.len() as u32).to_be_bytes());
        out.extend(item.bytes());
        out.extend(std::iter::repeat_n(
            0,
            item.len().next_multiple_of(4) - item.len(),
        ));
        rest = tail.trim_start();
    }
    out
}

/// With the classes of [`Known`].
pub(super) fn read(bytes: &[u8]) -> Parse<'_> {
    parse_any(bytes, &Known, &Limits::default())
}

/// The codes of problems, in their order.
pub(super) fn codes(problems: &[Problem]) -> String {
    let codes: Vec<&str> = problems.iter().map(|p| p.code).collect();
    codes.join(" ")
}
