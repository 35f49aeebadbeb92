//! What a reader or writer of binary files must ask about classes. Such files do not say where a
//! value ends; whoever knows the field types does.

use crate::header::Header;

/// How one value of a field is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueKind {
    /// Not at all: a trigger.
    Nothing,
    /// A word, 0 or 1; `TRUE` and `FALSE` in text.
    Flag,
    /// Signed words.
    Int,
    /// Unsigned words.
    Unsigned,
    /// Signed integers of eight bytes.
    Wide,
    /// Floats of four bytes.
    Float,
    /// Floats of eight bytes.
    Double,
    /// A text.
    Text,
    /// A word out of a list.
    Word,
    /// Any number of words.
    Mask,
    /// A node, an engine or a path.
    Node,
    /// A picture of `width height components`, then its pixels.
    Image,
    /// As [`Image`](Self::Image), with a depth.
    Volume,
}

/// How the values of a field are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ValueType {
    /// Of what.
    pub kind: ValueKind,
    /// Numbers in one value (3 for a point); 1 for what is no number.
    pub size: u8,
    /// Whether there is a count before any number of values.
    pub is_list: bool,
}

/// What is known about a class.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClassShape {
    /// Its nodes have a list of children.
    pub is_group: bool,
    /// It has a field at all: files up to version 2.0 give no number of fields otherwise.
    pub has_fields: bool,
}

/// Knows classes, as far as it matters for binary files of the version that the header tells.
pub trait Schema {
    /// A class; `None` if it is not known.
    fn class(&self, class: &[u8], header: &Header) -> Option<ClassShape>;

    /// A field of a class; `None` if it is not known.
    fn field(&self, class: &[u8], field: &[u8], header: &Header) -> Option<ValueType>;

    /// The type of that name, as it stands in `fields [ SFFloat x ]`.
    fn named_type(&self, name: &[u8]) -> Option<ValueType>;

    /// A name of a type that is stored so.
    fn name_of(&self, stored: ValueType) -> Option<&'static str>;

    /// The default of a field as text, for a value that is not written.
    fn default_text(&self, class: &[u8], field: &[u8], header: &Header) -> Option<&'static str>;
}
