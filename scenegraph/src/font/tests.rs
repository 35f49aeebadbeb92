//! Which style a font's name asks for.

use super::style::Family;
use super::{FontId, Style, find};

#[test]
fn names_ask_for_styles() {
    use Family::{Sans, Serif, Typewriter};
    let rows = [
        ("Times-Roman", Serif, false, false, true),
        ("Times-BoldItalic", Serif, true, true, true),
        ("Times New Roman:Bold", Serif, true, false, true),
        ("Helvetica", Sans, false, false, true),
        ("Helvetica-Oblique", Sans, false, true, true),
        ("Arial:Bold Italic", Sans, true, true, true),
        ("Courier-Bold", Typewriter, true, false, true),
        ("MS Sans Serif", Sans, false, false, true),
        ("Utopia-Regular", Serif, false, false, true),
        ("nobody knows it", Sans, false, false, true),
        ("SERIF", Serif, false, false, false),
        ("TYPEWRITER", Typewriter, false, false, false),
        ("defaultFont", Sans, false, false, false),
        ("", Sans, false, false, false),
        ("DejaVu Sans Mono", Typewriter, false, false, false),
    ];
    for (name, family, bold, italic, substituted) in rows {
        let found = find(name, &[]);
        let style = Style {
            family,
            bold,
            italic,
        };
        assert_eq!(found.font, FontId::BuiltIn(style), "{name}");
        assert_eq!(found.substituted, substituted, "{name}");
    }
}
