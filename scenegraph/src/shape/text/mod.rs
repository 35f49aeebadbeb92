//! `Text2`, `Text3` and `AsciiText`: what the nodes and the state say about a text. How letters are
//! made is in `glyphs`, where they stand in `layout`, how they become a mesh in `solid`.

mod glyphs;
mod layout;
mod profile;
mod solid;
#[cfg(test)]
mod tests;
mod vrml;

use std::collections::BTreeSet;

pub use glyphs::GlyphCache;
use glyphs::{Typeface, tolerance};
use layout::{Justify, Layout, Line, place};
use profile::Profile;

use iv_parser::{Severity, SourcePos};

use crate::font::{self, FontId, Found, Style};
use crate::graph::{Graph, Node, NodeId};
use crate::registry::Class;
use crate::remarks::Remarks;
use crate::resolve::State;
use crate::scene::Mesh;

use super::Job;
use super::attributes::Attributes;

/// Characters of one text; each takes some kilobytes.
pub const MAX_CHARACTERS: usize = 8_192;

/// Characters without a glyph that a message names.
const MAX_NAMED_CHARACTERS: usize = 8;

/// Whether a class draws text.
pub fn is_text(class: Class) -> bool {
    matches!(
        class,
        Class::Text2 | Class::Text3 | Class::AsciiText | Class::VRMLText
    )
}

/// Whether a class draws text of a size in pixels that faces the viewer.
pub fn is_screen_text(class: Class) -> bool {
    class == Class::Text2
}

/// What a text depends on besides what other shapes do.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct TextKey {
    font: Option<NodeId>,
    size: u64,
}

impl TextKey {
    /// Of the text in a state.
    pub fn of(state: &State) -> Self {
        Self {
            font: state.font,
            size: state.font_size.to_bits(),
        }
    }
}

/// A text, ready to be made.
struct Text<'g> {
    strings: Vec<&'g str>,
    /// Length asked for of each string; 0 for as it comes.
    lengths: &'g [f64],
    layout: Layout,
    solid: Solid,
}

/// What of the letters is drawn.
struct Solid {
    front: bool,
    sides: bool,
    back: bool,
    profile: Profile,
}

impl Solid {
    /// Letters without depth.
    fn flat() -> Self {
        Self {
            front: true,
            sides: false,
            back: false,
            profile: Profile::flat(),
        }
    }
}

/// The mesh of a text; `None` if it draws nothing.
pub fn mesh(
    job: &Job<'_>,
    attributes: &Attributes<'_>,
    cache: &mut GlyphCache,
    remarks: &mut Remarks,
) -> Option<Mesh> {
    let text = text_of(job, attributes.node, remarks);
    if text.layout.size <= 0.0 {
        if text.strings.iter().any(|s| !s.is_empty()) {
            remarks.warn(
                "font-size",
                "text has a font of no size",
                "it was left out",
                attributes.pos,
            );
        }
        return None;
    }
    let chosen = match job.class {
        Class::VRMLText => vrml::font_of(job.graph, attributes.node),
        _ => font_of(job.graph, job.state.font),
    };
    let face = Typeface::open(chosen.font, &job.graph.fonts)?;
    let lines = lines(&text, &face, attributes, remarks);
    if lines.iter().all(|line| line.glyphs.is_empty()) {
        return None;
    }
    if let Some((name, pos)) = chosen.missing {
        remarks.add(
            Severity::Note,
            "font-substituted",
            &format!(
                "the font `{name}` is not at hand; {} was used",
                chosen.font.title(&job.graph.fonts)
            ),
            "--system-fonts uses the fonts of this computer",
            pos,
        );
    }
    let placed = place(&lines, &text.layout);
    let tolerance = tolerance(job.state.complexity);
    solid::mesh(
        &placed,
        &text.solid,
        text.layout.size,
        attributes,
        |glyph| cache.get(&face, glyph, tolerance),
    )
}

fn text_of<'g>(job: &Job<'g>, node: &'g Node, remarks: &mut Remarks) -> Text<'g> {
    if job.class == Class::VRMLText {
        return vrml::text_of(job.graph, node);
    }
    let major = match node.word("justification") {
        "RIGHT" => Justify::End,
        "CENTER" => Justify::Middle,
        _ => Justify::Begin,
    };
    Text {
        strings: node.value("string").texts().iter().map(|s| &**s).collect(),
        lengths: match job.class {
            Class::AsciiText => node.numbers("width"),
            _ => &[],
        },
        layout: Layout::rows(job.state.font_size, node.number("spacing"), major),
        solid: if job.class == Class::Text3 {
            let size = job.state.font_size.max(f64::MIN_POSITIVE);
            let part = |name: &str| node.has_bits("parts", name);
            Solid {
                front: part("FRONT"),
                sides: part("SIDES"),
                back: part("BACK"),
                profile: profile::of(job, tolerance(job.state.complexity) * size, remarks),
            }
        } else {
            Solid::flat()
        },
    }
}

/// The font for a text.
struct Chosen<'g> {
    font: FontId,
    /// The name that was asked for and its place, if another font stands for it.
    missing: Option<(&'g str, SourcePos)>,
}

impl<'g> Chosen<'g> {
    fn of(found: Found, name: &'g str, node: &Node) -> Self {
        Self {
            font: found.font,
            missing: found.substituted.then_some((name, node.pos)),
        }
    }

    fn built_in(style: Style) -> Self {
        Self {
            font: FontId::BuiltIn(style),
            missing: None,
        }
    }
}

/// The font that a `Font` or `FontStyle` asks for.
fn font_of(graph: &Graph, node: Option<NodeId>) -> Chosen<'_> {
    let Some(node) = node.map(|id| graph.node(id)) else {
        return Chosen::built_in(Style::default());
    };
    let name = node.text("name").map_or("", |name| name);
    let has_own_name = node.entry("name").is_some() && name != "defaultFont";
    if node.class() == Some(Class::FontStyle) && !has_own_name {
        let style = Style::of_words(
            node.word("family"),
            node.has_bits("style", "BOLD"),
            node.has_bits("style", "ITALIC"),
        );
        return Chosen::built_in(style);
    }
    Chosen::of(font::find(name, &graph.fonts), name, node)
}

/// The glyphs of each line. Line breaks in a string begin a line; other control characters draw
/// nothing. What the font has no glyph for is its box.
fn lines(
    text: &Text<'_>,
    face: &Typeface<'_>,
    attributes: &Attributes<'_>,
    remarks: &mut Remarks,
) -> Vec<Line> {
    let mut lines = Vec::new();
    let mut left = MAX_CHARACTERS;
    let mut missing = BTreeSet::new();
    for (number, string) in text.strings.iter().enumerate() {
        let length = text.lengths.get(number).copied().unwrap_or(0.0);
        for row in string.split('\n') {
            let mut line = Line {
                glyphs: Vec::new(),
                length,
            };
            let drawn = row.chars().map(|c| if c == '\t' { ' ' } else { c });
            for c in drawn.filter(|c| !c.is_control()) {
                if left == 0 {
                    remarks.warn(
                        "long-text",
                        &format!("a text has more than {MAX_CHARACTERS} characters"),
                        "the rest of it was left out",
                        attributes.pos,
                    );
                    break;
                }
                left -= 1;
                let glyph = face.glyph(c).unwrap_or_else(|| {
                    missing.insert(c);
                    0
                });
                line.glyphs.push((glyph, face.advance(glyph)));
            }
            lines.push(line);
        }
    }
    if !missing.is_empty() {
        let named = missing.iter().take(MAX_NAMED_CHARACTERS);
        let named: String = named.collect();
        let more = if missing.len() > MAX_NAMED_CHARACTERS {
            " and others"
        } else {
            ""
        };
        remarks.warn(
            "no-glyph",
            &format!("the font has no glyph for `{named}`{more}"),
            "a box stands in its place",
            attributes.pos,
        );
    }
    lines
}
