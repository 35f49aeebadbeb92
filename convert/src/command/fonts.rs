//! Fonts of this computer, for the models that name them. Only when the user asks for it: what
//! fonts there are differs from computer to computer, and so would the output.

use std::collections::BTreeSet;
use std::sync::{Arc, OnceLock};

use fontdb::{Database, Family, ID, Query, Style, Weight};
use scenegraph::{AddedFont, Graph};

/// Adds to a graph the fonts that it names and this computer has.
pub fn add_system_fonts(graph: &mut Graph) {
    static FONTS: OnceLock<Database> = OnceLock::new();
    let names: BTreeSet<Arc<str>> = graph.font_names().cloned().collect();
    if names.is_empty() {
        return;
    }
    let fonts = FONTS.get_or_init(|| {
        let mut fonts = Database::new();
        fonts.load_system_fonts();
        fonts
    });
    let found = names.iter().filter_map(|name| {
        let id = find(fonts, name)?;
        fonts.with_face_data(id, |bytes, index| AddedFont::new(name, bytes.into(), index))?
    });
    graph.fonts.extend(found);
}

/// The font with this PostScript name (`Times-BoldItalic`), or the one of the family before a
/// hyphen or colon in the style behind it (`Times New Roman:Bold`).
fn find(fonts: &Database, name: &str) -> Option<ID> {
    let by_name = fonts
        .faces()
        .find(|face| face.post_script_name.eq_ignore_ascii_case(name));
    if let Some(face) = by_name {
        return Some(face.id);
    }
    let (family, style) = name.split_once([':', '-']).unwrap_or((name, ""));
    let style = style.to_ascii_lowercase();
    let query = |family: &str| {
        fonts.query(&Query {
            families: &[Family::Name(family)],
            weight: if style.contains("bold") {
                Weight::BOLD
            } else {
                Weight::NORMAL
            },
            style: if style.contains("italic") {
                Style::Italic
            } else if style.contains("oblique") {
                Style::Oblique
            } else {
                Style::Normal
            },
            ..Query::default()
        })
    };
    query(name).or_else(|| query(family))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_find_fonts() {
        let mut fonts = Database::new();
        for bytes in [
            dejavu::serif::regular(),
            dejavu::serif::bold_italic(),
            dejavu::sans_mono::bold(),
        ] {
            fonts.load_font_data(bytes.to_vec());
        }
        let rows = [
            ("DejaVuSerif", Some("DejaVuSerif")),
            ("dejavuserif-bolditalic", Some("DejaVuSerif-BoldItalic")),
            ("DejaVu Serif", Some("DejaVuSerif")),
            ("DejaVu Serif:Bold Italic", Some("DejaVuSerif-BoldItalic")),
            ("DejaVu Sans Mono-Bold", Some("DejaVuSansMono-Bold")),
            ("Times-Roman", None),
            ("", None),
        ];
        for (name, wanted) in rows {
            let found = find(&fonts, name).and_then(|id| fonts.face(id));
            let found = found.map(|face| face.post_script_name.as_str());
            assert_eq!(found, wanted, "{name}");
        }
    }
}
