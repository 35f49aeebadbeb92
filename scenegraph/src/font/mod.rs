//! Which typeface a `Font` or `FontStyle` means. Without fonts that the user adds, the one family
//! that is built in, DejaVu, stands for all: the same model then looks the same everywhere.

mod style;
#[cfg(test)]
mod tests;

use std::sync::Arc;

pub use style::Style;
use style::{Family, stands_for_itself};

/// A font that the user added, under the name that models call it by.
#[derive(Clone, Debug)]
pub struct AddedFont {
    name: Arc<str>,
    bytes: Arc<[u8]>,
    index: u32,
}

impl AddedFont {
    /// A font for the name that a `Font` node has: the bytes of a TrueType or OpenType file, or of
    /// a collection of them, and which of the collection. `None` if they are no font.
    pub fn new(name: &str, bytes: Arc<[u8]>, index: u32) -> Option<Self> {
        ttf_parser::Face::parse(&bytes, index).ok()?;
        Some(Self {
            name: name.into(),
            bytes,
            index,
        })
    }
}

/// A font to set text in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FontId {
    /// The built-in family in one of its styles.
    BuiltIn(Style),
    /// One of the added fonts.
    Added(u32),
}

impl FontId {
    /// Its name, for messages.
    pub fn title(self, added: &[AddedFont]) -> String {
        match self {
            Self::BuiltIn(style) => style.title(),
            Self::Added(index) => {
                let font = added.get(index as usize);
                font.map_or_else(String::new, |f| f.name.to_string())
            }
        }
    }
}

/// What was found for a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Found {
    /// The font.
    pub font: FontId,
    /// It is another than the one asked for.
    pub substituted: bool,
}

/// The font for a name of a `Font` node.
pub fn find(name: &str, added: &[AddedFont]) -> Found {
    let position = added.iter().position(|f| *f.name == *name);
    if let Some(index) = position {
        return Found {
            font: FontId::Added(index as u32),
            substituted: false,
        };
    }
    Found {
        font: FontId::BuiltIn(Style::of_name(name)),
        substituted: !stands_for_itself(name),
    }
}

/// The bytes of a font, its number in the file, and whether it must be slanted.
pub fn data(font: FontId, added: &[AddedFont]) -> (&[u8], u32, bool) {
    let style = match font {
        FontId::Added(index) => match added.get(index as usize) {
            Some(font) => return (&font.bytes, font.index, false),
            None => Style::default(),
        },
        FontId::BuiltIn(style) => style,
    };
    use dejavu::{sans, sans_mono, serif};
    let bytes = match (style.family, style.bold) {
        (Family::Sans, false) => sans::regular(),
        (Family::Sans, true) => sans::bold(),
        (Family::Serif, false) => serif::regular(),
        (Family::Serif, true) => serif::bold(),
        (Family::Typewriter, false) => sans_mono::regular(),
        (Family::Typewriter, true) => sans_mono::bold(),
    };
    (bytes, 0, style.italic)
}
