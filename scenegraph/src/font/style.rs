//! Styles of the built-in family, and which of them a font's name asks for.

/// Serifs or not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Family {
    /// `FontStyle` SERIF: Times and its like.
    Serif,
    /// `FontStyle` SANS: Helvetica and its like.
    #[default]
    Sans,
    /// `FontStyle` TYPEWRITER: Courier and its like.
    Typewriter,
}

/// A style of the built-in family.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Style {
    /// Serifs or not.
    pub family: Family,
    /// Heavy.
    pub bold: bool,
    /// Slanted.
    pub italic: bool,
}

/// Parts of names, in small letters. The first that a name has decides; sans-serif fonts stand
/// before `serif`, and Times New Roman behind the monospaced fonts.
const FAMILIES: &[(&str, Family)] = &[
    ("courier", Family::Typewriter),
    ("mono", Family::Typewriter),
    ("typewriter", Family::Typewriter),
    ("fixed", Family::Typewriter),
    ("console", Family::Typewriter),
    ("consolas", Family::Typewriter),
    ("screen", Family::Typewriter),
    ("terminal", Family::Typewriter),
    ("sans", Family::Sans),
    ("helvetica", Family::Sans),
    ("arial", Family::Sans),
    ("times", Family::Serif),
    ("serif", Family::Serif),
    ("roman", Family::Serif),
    ("utopia", Family::Serif),
    ("palatino", Family::Serif),
    ("century", Family::Serif),
    ("schoolbook", Family::Serif),
    ("garamond", Family::Serif),
    ("georgia", Family::Serif),
    ("bookman", Family::Serif),
    ("charter", Family::Serif),
    ("goudy", Family::Serif),
    ("rockwell", Family::Serif),
];

impl Style {
    /// The style that a font's name asks for: `Times-BoldItalic`, `Arial:Bold`, `Courier-Oblique`.
    pub fn of_name(name: &str) -> Self {
        let name = name.to_ascii_lowercase();
        let family = FAMILIES.iter().find(|(part, _)| name.contains(part));
        Self {
            family: family.map_or(Family::default(), |(_, family)| *family),
            bold: name.contains("bold") || name.contains("black") || name.contains("heavy"),
            italic: name.contains("italic") || name.contains("oblique"),
        }
    }

    /// The name of the font, as its makers call it.
    pub fn title(self) -> String {
        let family = match self.family {
            Family::Serif => "DejaVu Serif",
            Family::Sans => "DejaVu Sans",
            Family::Typewriter => "DejaVu Sans Mono",
        };
        let bold = if self.bold { " Bold" } else { "" };
        let italic = if self.italic { ", slanted" } else { "" };
        format!("{family}{bold}{italic}")
    }

    /// The style of a `FontStyle`, from the words of its fields.
    pub fn of_words(family: &str, bold: bool, italic: bool) -> Self {
        Self {
            family: match family {
                "SANS" => Family::Sans,
                "TYPEWRITER" => Family::Typewriter,
                _ => Family::Serif,
            },
            bold,
            italic,
        }
    }
}

/// Whether a name asks for no font in particular, or for the built-in one.
pub fn stands_for_itself(name: &str) -> bool {
    const ANY: [&str; 6] = [
        "",
        "defaultfont",
        "sans",
        "serif",
        "typewriter",
        "monospace",
    ];
    let name = name.to_ascii_lowercase();
    ANY.contains(&name.as_str()) || name.contains("dejavu")
}
