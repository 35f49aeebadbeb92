//! `Text` of VRML 97, whose font and layout stand in its own `FontStyle`.

use std::sync::Arc;

use crate::font::{self, FontId, Style};
use crate::graph::{Graph, Node};
use crate::registry::Class;

use super::layout::{Justify, Layout};
use super::{Chosen, Solid, Text};

fn style_of<'g>(graph: &'g Graph, node: &Node) -> Option<&'g Node> {
    let style = graph.node(node.node_field("fontStyle")?);
    (style.class() == Some(Class::VRMLFontStyle)).then_some(style)
}

/// The text of a node.
pub(super) fn text_of<'g>(graph: &'g Graph, node: &'g Node) -> Text<'g> {
    let style = style_of(graph, node);
    let number = |field: &str, default: f64| style.map_or(default, |style| style.number(field));
    let flag = |field: &str| style.is_none_or(|style| style.flag(field));
    let justify = style.map_or(&[][..], |style| style.value("justify").texts());
    let word = |axis: usize| justify.get(axis).map(|word| &**word);
    Text {
        strings: node.value("string").texts().iter().map(|s| &**s).collect(),
        lengths: node.numbers("length"),
        layout: Layout {
            size: number("size", 1.0),
            spacing: number("spacing", 1.0),
            major: match word(0) {
                Some("MIDDLE") => Justify::Middle,
                Some("END") => Justify::End,
                _ => Justify::Begin,
            },
            minor: match word(1) {
                Some("BEGIN") => Justify::Begin,
                Some("MIDDLE") => Justify::Middle,
                Some("END") => Justify::End,
                _ => Justify::First,
            },
            horizontal: flag("horizontal"),
            left_to_right: flag("leftToRight"),
            top_to_bottom: flag("topToBottom"),
            max_extent: node.number("maxExtent"),
        },
        solid: Solid::flat(),
    }
}

/// The first family of its list that is at hand; SERIF, SANS and TYPEWRITER always are.
pub(super) fn font_of<'g>(graph: &'g Graph, node: &Node) -> Chosen<'g> {
    let serif = Style::of_words("SERIF", false, false);
    let Some(style) = style_of(graph, node) else {
        return Chosen::built_in(serif);
    };
    let find = |name: &'g Arc<str>| Chosen::of(font::find(name, &graph.fonts), name, style);
    let mut families = style.value("family").texts().iter().map(find);
    let first = families.next().unwrap_or_else(|| Chosen::built_in(serif));
    let chosen = match first.missing {
        Some(_) => families.find(|f| f.missing.is_none()).unwrap_or(first),
        None => first,
    };
    let FontId::BuiltIn(family) = chosen.font else {
        return chosen;
    };
    let words = style.text("style").map_or("", |words| words);
    Chosen {
        font: FontId::BuiltIn(Style {
            bold: family.bold || words.contains("BOLD"),
            italic: family.italic || words.contains("ITALIC"),
            ..family
        }),
        ..chosen
    }
}
