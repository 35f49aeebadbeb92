//! Prototypes: interfaces, defaults, nesting, other files, and attacks.

use std::time::Instant;

use tests::measure::totals;

use super::{Library, graph_of, scene_of, scene_with};

/// A text, the boxes (12 triangles each) that it draws, their width together along x, the codes.
type Row = (&'static str, usize, f64, &'static [&'static str]);

const ROWS: &[Row] = &[
    (
        "PROTO P [ field SFVec3f size 3 1 1 ] { Shape { geometry Box { size IS size } } } P { }",
        1,
        3.0,
        &[],
    ),
    (
        "PROTO P [ field SFVec3f size 3 1 1 ] { Shape { geometry Box { size IS size } } }
         P { size 5 1 1 } P { size 2 1 1 size 4 1 1 }",
        2,
        5.0,
        &[],
    ),
    // Nodes as values: the default, the instance's, and none.
    (
        "PROTO P [ field MFNode parts [ Shape { geometry Box { size 6 1 1 } } ] ] { Group { children IS parts } }
         P { } P { parts [ ] } P { parts [ Shape { geometry Box { } } Shape { geometry Box { } } ] }",
        3,
        6.0,
        &[],
    ),
    // Instances as values: the defaults are made anew for each instance.
    (
        "PROTO Q [ field SFVec3f s 3 1 1 ] { Shape { geometry Box { size IS s } } }
         PROTO P [ field MFNode parts [ Q { } Q { s 4 1 1 } ] ] { Group { children IS parts } }
         P { } P { parts Q { s 5 1 1 } }",
        3,
        5.0,
        &[],
    ),
    // A prototype where a geometry, an appearance or a material stands.
    (
        "PROTO G [ field SFVec3f s 1 1 1 ] { Box { size IS s } }
         PROTO A [ ] { Appearance { } } Shape { geometry G { s 7 1 1 } appearance A { } }",
        1,
        7.0,
        &[],
    ),
    // Nested: the inner one is known inside only, and takes values through both.
    (
        "PROTO Outer [ field SFVec3f s 1 1 1 ] {
            PROTO Inner [ field SFVec3f t 9 9 9 ] { Shape { geometry Box { size IS t } } }
            Group { children [ Inner { t IS s } Inner { t 2 1 1 } ] } }
         Outer { s 8 1 1 } Inner { }",
        2,
        8.0,
        &["unknown-class"],
    ),
    // A prototype that is an instance of another one.
    (
        "PROTO A [ field SFVec3f s 1 1 1 ] { Shape { geometry Box { size IS s } } }
         PROTO B [ field SFVec3f s 4 1 1 ] { A { s IS s } } B { }",
        1,
        4.0,
        &[],
    ),
    // DEF inside is shared inside, and not known outside; the first node is what is drawn.
    (
        "PROTO P [ ] { Group { children [ DEF X Shape { geometry Box { } } USE X ] } Shape { geometry Box { } } }
         P { } USE X",
        2,
        2.0,
        &["unknown-name"],
    ),
    // Events have no values.
    (
        "PROTO P [ eventIn SFVec3f set_s eventOut SFBool done exposedField SFVec3f s 3 1 1 ] {
            Transform { set_translation IS set_s scale IS s children Shape { geometry Box { size 1 1 1 } } } }
         P { }",
        1,
        3.0,
        &[],
    ),
    // Mistakes.
    ("P { } PROTO P [ ] { Shape { geometry Box { } } }", 0, 0.0, &["unknown-class"]),
    ("PROTO P [ ] { Group { children P { } } } P { }", 0, 0.0, &["cycle"]),
    ("PROTO P [ ] { } P { }", 0, 0.0, &["empty"]),
    (
        "PROTO P [ field SFFloat s 3 ] { Shape { geometry Box { size IS s } } } P { }",
        1,
        2.0,
        &["is-type"],
    ),
    (
        "PROTO P [ field SFOdd s 3 ] { Shape { geometry Box { size IS s } } } P { s 3 }",
        1,
        2.0,
        &["unknown-type"],
    ),
    (
        "PROTO P [ ] { Shape { geometry Box { } } } P { size 3 }",
        1,
        2.0,
        &["unknown-field"],
    ),
    ("Shape { geometry Box { size IS s } }", 1, 2.0, &["is-outside"]),
];

#[test]
fn rows() {
    for (text, boxes, width, wanted) in ROWS {
        let (scene, codes) = scene_of(text);
        let found = totals(&scene);
        assert_eq!(found.triangles, 12 * boxes, "{text}");
        let found = found.bounds.map_or(0.0, |[low, high]| (high - low).x);
        assert!((found - width).abs() < 1e-6, "{text}: {found}");
        assert_eq!(codes, *wanted, "{text}");
    }
}

#[test]
fn an_instance_has_its_own_name() {
    let (scene, _) = scene_of(
        "PROTO P [ ] { DEF Inside Group { children Shape { geometry Box { } } } } DEF Own P { } P { }",
    );
    let names: Vec<_> = scene
        .nodes
        .iter()
        .filter_map(|n| n.name.as_deref())
        .collect();
    assert_eq!(names, ["Own", "Inside"]);
}

const PARTS: &str = "#VRML V2.0 utf8
PROTO First [ ] { Shape { geometry Box { size 3 1 1 } } }
PROTO Second [ field SFVec3f other 1 1 1 field SFVec3f s 4 1 1 ] { Shape { geometry Box { size IS s } } }
First { }";

#[test]
fn other_files() {
    let library = Library(&[
        ("parts.wrl", PARTS),
        (
            "chain.wrl",
            "#VRML V2.0 utf8\nEXTERNPROTO Q [ ] \"parts.wrl#Second\"",
        ),
        (
            "loop.wrl",
            "#VRML V2.0 utf8\nEXTERNPROTO Q [ ] \"main.wrl#P\" PROTO R [ ] { Group { children Q { } } }",
        ),
    ]);
    let rows: &[Row] = &[
        ("EXTERNPROTO P [ ] \"parts.wrl\" P { }", 1, 3.0, &[]),
        (
            "EXTERNPROTO P [ field SFVec3f s ] [ \"gone.wrl#Second\" \"parts.wrl#Second\" ] P { } P { s 6 1 1 }",
            2,
            6.0,
            &[],
        ),
        ("EXTERNPROTO P [ ] \"chain.wrl#Q\" P { }", 1, 4.0, &[]),
        // What nobody uses is not read.
        ("EXTERNPROTO P [ ] \"gone.wrl\"", 0, 0.0, &[]),
        (
            "EXTERNPROTO P [ ] \"gone.wrl\" P { } P { }",
            0,
            0.0,
            &["include"],
        ),
        (
            "EXTERNPROTO P [ ] \"parts.wrl#None\" P { }",
            0,
            0.0,
            &["include"],
        ),
        ("EXTERNPROTO P [ ] [ ] P { }", 0, 0.0, &["include"]),
        // In the file itself, before and behind.
        (
            "PROTO A [ ] { Shape { geometry Box { } } } EXTERNPROTO P [ ] \"main.wrl#A\" P { }",
            1,
            2.0,
            &[],
        ),
        (
            "EXTERNPROTO P [ ] \"#A\" PROTO A [ ] { Group { children P { } } } A { }",
            0,
            0.0,
            &["cycle"],
        ),
        // Two files that hold each other.
        (
            "EXTERNPROTO R [ ] \"loop.wrl#R\" PROTO P [ ] { Group { children R { } } } P { }",
            0,
            0.0,
            &["include"],
        ),
    ];
    for (text, boxes, width, wanted) in rows {
        let (scene, codes) = scene_with(text, &library);
        let found = totals(&scene);
        assert_eq!(found.triangles, 12 * boxes, "{text}");
        let found = found.bounds.map_or(0.0, |[low, high]| (high - low).x);
        assert!((found - width).abs() < 1e-6, "{text}: {found}");
        assert_eq!(codes, *wanted, "{text}");
    }
}

/// Inlines in a prototype are followed for its instances, by the values that these have.
#[test]
fn inlines_of_instances() {
    let library = Library(&[("a.wrl", PARTS)]);
    let text = "PROTO P [ field MFString url \"gone.wrl\" ] { Inline { url IS url } } P { url \"a.wrl\" } P { url \"a.wrl\" }";
    let (scene, codes) = scene_with(text, &library);
    assert_eq!(
        (totals(&scene).triangles, codes.len()),
        (24, 0),
        "{codes:?}"
    );
}

/// Each level holds the one before twice: 2^40 boxes, and 2^40 nodes at one place of each.
#[test]
fn doubling_is_limited() {
    for body in [
        "Group { children [ P P ] }",
        "Shape { appearance P geometry P }",
    ] {
        let mut text = String::from("PROTO P0 [ ] { Shape { geometry Box { } } }\n");
        for i in 1..=40 {
            let inner = format!("P{} {{ }}", i - 1);
            text += &format!("PROTO P{i} [ ] {{ {} }}\n", body.replace('P', &inner));
        }
        text += "P40 { }";
        let start = Instant::now();
        let graph = graph_of(&text, &Library(&[]));
        assert!(
            graph
                .diagnostics
                .iter()
                .any(|d| d.code == "too-many-copies"),
            "{body}"
        );
        assert!(
            start.elapsed().as_secs() < 20,
            "{body}: {:?}",
            start.elapsed()
        );
    }
}

/// Long values are not copied for each instance, or count.
#[test]
fn long_values_are_limited() {
    let texts = "\"a\" ".repeat(20_000);
    let instances = "P { } ".repeat(20_000);
    let text = format!("PROTO P [ ] {{ Anchor {{ parameter [ {texts} ] }} }} {instances}");
    let graph = graph_of(&text, &Library(&[]));
    assert!(
        graph
            .diagnostics
            .iter()
            .any(|d| d.code == "too-many-copies")
    );
}

/// A chain of prototypes, each made of the one before.
#[test]
fn long_chains_do_not_overflow() {
    let mut text = String::from("PROTO P0 [ ] { Shape { geometry Box { } } }\n");
    for i in 1..20_000 {
        text += &format!("PROTO P{i} [ ] {{ P{} {{ }} }}\n", i - 1);
    }
    text += "P19999 { }";
    let (scene, codes) = scene_of(&text);
    assert_eq!(totals(&scene).triangles, 12, "{codes:?}");
}
