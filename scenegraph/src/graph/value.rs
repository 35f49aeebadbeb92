//! Typed field values.

use std::sync::Arc;

use iv_parser::List;

use super::NodeId;
use crate::scene::Image;

/// The value of a field. Numbers keep the precision of the text.
#[derive(Clone, Debug, PartialEq)]
pub enum FieldValue {
    /// No value: a trigger, or a type that is not kept.
    None,
    /// `SFBool`.
    Bool(bool),
    /// Up to four numbers, of any numeric type that is not integer.
    Few(u8, [f64; 4]),
    /// More numbers, flat.
    Many(List<f64>),
    /// A single integer.
    Int(i32),
    /// Several integers.
    Ints(List<i32>),
    /// An enum's value or a mask's bits, in the registry's numbering.
    Word(u32),
    /// Texts.
    Texts(Vec<Arc<str>>),
    /// Nodes; `NULL` entries are left out.
    Nodes(Vec<NodeId>),
    /// `SFImage`; `None` for one without pixels.
    Image(Option<Arc<Image>>),
}

impl FieldValue {
    /// A numeric value from a list.
    pub fn from_numbers(values: &[f64]) -> Self {
        if values.len() <= 4 {
            let mut few = [0.0; 4];
            few[..values.len()].copy_from_slice(values);
            Self::Few(values.len() as u8, few)
        } else {
            Self::Many(values.to_vec().into())
        }
    }

    /// The numbers; empty for other types.
    pub fn numbers(&self) -> &[f64] {
        match self {
            Self::Few(len, values) => &values[..usize::from(*len)],
            Self::Many(values) => values,
            _ => &[],
        }
    }

    /// The integers; empty for other types.
    pub fn ints(&self) -> &[i32] {
        match self {
            Self::Int(value) => std::slice::from_ref(value),
            Self::Ints(values) => values,
            _ => &[],
        }
    }

    /// The texts; empty for other types.
    pub fn texts(&self) -> &[Arc<str>] {
        match self {
            Self::Texts(texts) => texts,
            _ => &[],
        }
    }
}
