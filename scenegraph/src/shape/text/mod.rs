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

use crate::font::{self, Found, Style};
use crate::graph::{Graph, Node, NodeId};
use crate::registry::Class;
use crate::remarks::Remarks;
use crate::resolve::State;
use crate::scene::Mesh;

use super::Job;
use super::attributes::Attributes;

/// Characters of one text; each takes some kilobytes.
pub const MAX_CHARACTERS: usize = 65_536;

/// Characters without a glyph that a message names.
const MAX_NAMED_CHARACTERS: usize = 8;

/// Whether a class draws text.
pub fn is_text(class: Class) -> bool {
    matches!(class, Class::Text2 | Class::Text3 | Class::AsciiText)
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
    let found = match job.state.font {
        None if attributes.vrml2 => vrml::font(None),
        font => font_of(job.graph, font),
    };
    let face = Typeface::open(found.font, &job.graph.fonts)?;
    let lines = lines(&text, &face, attributes, remarks);
    if lines.iter().all(|line| line.glyphs.is_empty()) {
        return None;
    }
    if let (true, Some(id)) = (found.substituted, job.state.font) {
        let node = job.graph.node(id);
        let name = node.text("name").map_or("", |name| name);
        remarks.add(
            iv_parser::Severity::Note,
            "font-substituted",
            &format!(
                "the font `{name}` is not at hand; {} was used",
                found.font.title(&job.graph.fonts)
            ),
            "--system-fonts uses the fonts of this computer",
            node.pos,
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
    if node.class() == Some(Class::VRMLText) {
        let style = job.state.font.map(|id| job.graph.node(id));
        let style = style.filter(|style| style.class() == Some(Class::VRMLFontStyle));
        return Text {
            strings: node.value("string").texts().iter().map(|s| &**s).collect(),
            lengths: node.numbers("length"),
            layout: vrml::layout(node, style),
            solid: Solid {
                front: true,
                sides: false,
                back: false,
                profile: Profile::flat(),
            },
        };
    }
    let major = match node.word("justification") {
        "RIGHT" => Justify::End,
        "CENTER" => Justify::Middle,
        _ => Justify::Begin,
    };
    let is_solid = job.class == Class::Text3;
    let part = |name: &str| is_solid && node.has_bits("parts", name);
    Text {
        strings: node.value("string").texts().iter().map(|s| &**s).collect(),
        lengths: match job.class {
            Class::AsciiText => node.numbers("width"),
            _ => &[],
        },
        layout: Layout::rows(job.state.font_size, node.number("spacing"), major),
        solid: Solid {
            front: !is_solid || part("FRONT"),
            sides: part("SIDES"),
            back: part("BACK"),
            profile: if is_solid {
                profile::of(
                    job,
                    tolerance(job.state.complexity) * job.state.font_size.max(f64::MIN_POSITIVE),
                    remarks,
                )
            } else {
                Profile::flat()
            },
        },
    }
}

/// The font that a `Font` or `FontStyle` asks for.
fn font_of(graph: &Graph, node: Option<NodeId>) -> Found {
    let Some(node) = node.map(|id| graph.node(id)) else {
        return font::find("", &[]);
    };
    if node.class() == Some(Class::VRMLFontStyle) {
        return vrml::font(Some(node));
    }
    let name = node.text("name").map_or("", |name| name);
    let has_own_name = node.entry("name").is_some() && name != "defaultFont";
    if node.class() == Some(Class::FontStyle) && !has_own_name {
        let style = Style::of_words(
            node.word("family"),
            node.has_bits("style", "BOLD"),
            node.has_bits("style", "ITALIC"),
        );
        return Found {
            font: font::FontId::BuiltIn(style),
            substituted: false,
        };
    }
    font::find(name, &graph.fonts)
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
                        "a text is too long",
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
