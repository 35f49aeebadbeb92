//! `Text` and `FontStyle` of VRML 2 (ISO 14772-1, 6.20 and 6.47), which have words where Inventor
//! has fields of other types.

use crate::font::{FontId, Found, Style};
use crate::graph::Node;

use super::layout::{Justify, Layout};

/// How a `Text` is set by its `FontStyle`, if it has one.
pub fn layout(text: &Node, style: Option<&Node>) -> Layout {
    let max_extent = text.number("maxExtent").max(0.0);
    let Some(style) = style else {
        return Layout {
            max_extent,
            ..Layout::rows(1.0, 1.0, Justify::Begin)
        };
    };
    let justify = style.value("justify").texts();
    let word = |index: usize| justify.get(index).map_or("", |word| &**word);
    Layout {
        size: style.number("size"),
        spacing: style.number("spacing"),
        major: match word(0) {
            "MIDDLE" => Justify::Middle,
            "END" => Justify::End,
            _ => Justify::Begin,
        },
        minor: match word(1) {
            "BEGIN" => Justify::Begin,
            "MIDDLE" => Justify::Middle,
            "END" => Justify::End,
            _ => Justify::First,
        },
        horizontal: style.flag("horizontal"),
        left_to_right: style.flag("leftToRight"),
        top_to_bottom: style.flag("topToBottom"),
        max_extent,
    }
}

/// The font of a `FontStyle`: the first family that is one of the three that VRML knows.
pub fn font(style: Option<&Node>) -> Found {
    let families = style.map_or(&[][..], |style| style.value("family").texts());
    let known = |family: &&str| matches!(*family, "SERIF" | "SANS" | "TYPEWRITER");
    let family = families.iter().map(|f| &**f).find(known);
    let look = style.and_then(|style| style.text("style"));
    let look = look.map_or("", |text| text);
    let is = |what: &str| look.contains(what);
    Found {
        font: FontId::BuiltIn(Style::of_words(
            family.unwrap_or("SERIF"),
            is("BOLD"),
            is("ITALIC"),
        )),
        substituted: false,
    }
}
