//! Properties of any model: printed it reads back equal, and a glTF file that carries it gives it
//! back, and is made of it again, byte for byte. Models are random trees of nodes with random
//! fields, names, uses, flags, connections, unknown classes and descriptions.

use std::fmt::Write;
use std::path::Path;

use iv_parser::parse;
use proptest::prelude::*;
use scenegraph::FileLoader;
use tests::fuzz_body::print;
use tests::same_tree;

use super::source_back::{back, glb_with_source};

/// A node of a random model.
#[derive(Clone, Debug)]
enum Part {
    /// A node without children: the text of its body, by class.
    Leaf(&'static str, String),
    /// A group, its name, and what is in it.
    Group(&'static str, Option<u8>, Vec<Part>),
    /// A use of a name, if it is known.
    Use(u8),
}

/// Any number that text can have, as text.
fn number() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => (-1e3..1e3_f64).prop_map(|v| format!("{v}")),
        2 => (-9..9_i32).prop_map(|v| v.to_string()),
        1 => any::<f32>().prop_filter("finite", |v| v.is_finite()).prop_map(|v| format!("{v:e}")),
        1 => any::<f64>().prop_filter("no field holds more", |v| v.abs() < 3e38).prop_map(|v| format!("{v:?}")),
    ]
}

fn numbers(count: usize) -> impl Strategy<Value = String> {
    prop::collection::vec(number(), count).prop_map(|list| list.join(" "))
}

/// Text that a string can hold: a quote before a line end, or a backslash at the end, would end it.
fn string() -> impl Strategy<Value = String> {
    "[a-zA-Z0-9 .,#{}~|()äß\\[\\]]{0,12}".prop_map(|text| format!("\"{text}\""))
}

fn points() -> impl Strategy<Value = String> {
    let point = prop::array::uniform3(-50.0..50.0_f64).prop_map(|[x, y, z]| format!("{x} {y} {z}"));
    prop::collection::vec(point, 4..8).prop_map(|list| format!("[ {} ]", list.join(", ")))
}

fn color() -> impl Strategy<Value = String> {
    prop::array::uniform3(0.0..1.0_f32).prop_map(|[r, g, b]| format!("{r} {g} {b}"))
}

fn leaf() -> impl Strategy<Value = Part> {
    let flag = prop_oneof![3 => Just(""), 1 => Just(" ~")];
    prop_oneof![
        (numbers(3), flag)
            .prop_map(|(n, f)| Part::Leaf("Translation", format!("translation {n}{f}"))),
        numbers(4).prop_map(|n| Part::Leaf("Rotation", format!("rotation {n}"))),
        (numbers(3), numbers(3)).prop_map(|(t, s)| {
            Part::Leaf("Transform", format!("translation {t} scaleFactor {s}"))
        }),
        (color(), color(), 0.0..1.0_f32).prop_map(|(d, s, t)| {
            Part::Leaf(
                "Material",
                format!("diffuseColor {d} specularColor {s} transparency {t}"),
            )
        }),
        (number(), number()).prop_map(|(w, h)| {
            Part::Leaf(
                "Cube",
                format!("width {w} height {h} ~ depth 1 = USE other . width"),
            )
        }),
        (1.0..9.0_f32).prop_map(|r| Part::Leaf("Sphere", format!("radius {r}"))),
        points().prop_map(|p| Part::Leaf("Coordinate3", format!("point {p}"))),
        Just(Part::Leaf(
            "IndexedFaceSet",
            "coordIndex [ 0, 1, 2, -1, 1, 2, 3, -1 ]".to_owned()
        )),
        Just(Part::Leaf(
            "IndexedLineSet",
            "coordIndex [ 0, 1, 2, 3, -1 ]".to_owned()
        )),
        Just(Part::Leaf(
            "ShapeHints",
            "vertexOrdering CLOCKWISE shapeType SOLID".to_owned()
        )),
        Just(Part::Leaf("LightModel", "model BASE_COLOR".to_owned())),
        (color(), numbers(3)).prop_map(|(c, d)| {
            Part::Leaf("DirectionalLight", format!("color {c} direction {d}"))
        }),
        numbers(3).prop_map(|p| Part::Leaf("PerspectiveCamera", format!("position {p}"))),
        string().prop_map(|s| Part::Leaf("Label", format!("label {s}"))),
        (string(), numbers(2)).prop_map(|(s, n)| {
            let described = "fields [ SFString text, MFFloat list ]";
            Part::Leaf("Novelty", format!("{described} text {s} list [ {n} ]"))
        }),
        Just(Part::Leaf(
            "Texture2",
            "image 1 2 3 0xff00ff 255 wrapS CLAMP".to_owned()
        )),
    ]
}

fn part() -> impl Strategy<Value = Part> {
    let leaf = prop_oneof![6 => leaf(), 1 => (0..8_u8).prop_map(Part::Use)];
    leaf.prop_recursive(4, 40, 6, |inner| {
        let class = prop_oneof![
            4 => Just("Separator"),
            1 => Just("Group"),
            1 => Just("TransformSeparator"),
            1 => Just("Oddity"),
        ];
        let parts = prop::collection::vec(inner, 0..6);
        (class, prop::option::of(0..8_u8), parts).prop_map(|(c, n, p)| Part::Group(c, n, p))
    })
}

/// Writes a part; names are known once their group has ended.
fn write(part: &Part, known: &mut Vec<u8>, out: &mut String) {
    // Writing to a String does not fail.
    match part {
        Part::Leaf(class, body) => {
            let _ = writeln!(out, "{class} {{ {body} }}");
        }
        Part::Use(name) if known.contains(name) => {
            let _ = writeln!(out, "USE n{name}");
        }
        Part::Use(_) => out.push_str("Cone { }\n"),
        Part::Group(class, name, parts) => {
            // A name within its own body would be a cycle.
            let name = name.filter(|name| !known.contains(name));
            if let Some(name) = name {
                let _ = write!(out, "DEF n{name} ");
            }
            let _ = writeln!(out, "{class} {{");
            parts.iter().for_each(|part| write(part, known, out));
            out.push_str("}\n");
            known.extend(name);
        }
    }
}

fn model() -> impl Strategy<Value = String> {
    prop::collection::vec(part(), 1..5).prop_map(|parts| {
        let mut out = String::from("#Inventor V2.1 ascii\nDEF other Cube { width 3 }\n");
        let mut known = Vec::new();
        parts
            .iter()
            .for_each(|part| write(part, &mut known, &mut out));
        out
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 256,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn printed_models_read_back_equal(text in model()) {
        let parsed = parse(text.as_bytes());
        prop_assert_eq!(&parsed.problems, &[], "{}", text);
        let printed = print(&parsed.tree);
        let again = parse(&printed);
        prop_assert_eq!(&again.problems, &[]);
        let difference = same_tree::difference(&parsed.tree, &again.tree);
        prop_assert_eq!(difference, None, "{}", text);
    }

    #[test]
    fn models_and_files_come_back_byte_for_byte(text in model()) {
        let nothing = FileLoader::default();
        let first = glb_with_source(text.as_bytes(), Path::new(""), &nothing).expect("a file");
        let files = back(&first).expect("a text");
        prop_assert_eq!(&files.text[..], text.as_bytes());
        let second = glb_with_source(&files.text, Path::new(""), &nothing).expect("a file");
        prop_assert!(first == second);
    }
}
