//! The swept surfaces of SGI's modeller noodle, by their closed forms.

use std::path::Path;

use scenegraph::{FileLoader, ResolveOptions, load, resolve};
use tests::measure::totals;

struct Row {
    fields: &'static str,
    area: f64,
    /// Signed: positive if the faces look outwards.
    volume: f64,
}

const CLOSED: &str = "crossSectionClosed TRUE";
const ROOT_5: f64 = 2.236_067_977_499_79;

const ROWS: &[Row] = &[
    // A cube of side 2.
    Row {
        fields: "",
        area: 24.0,
        volume: 8.0,
    },
    Row {
        fields: "normsFlipped TRUE",
        area: 24.0,
        volume: -8.0,
    },
    Row {
        fields: "minNumRows 7 minNumCols 9",
        area: 24.0,
        volume: 8.0,
    },
    // A pyramid.
    Row {
        fields: "profileCoords Coordinate3 { point [ 1 0 0, 0 5 0 ] }",
        area: 4.0 + 4.0 * ROOT_5,
        volume: 8.0 / 3.0,
    },
    // The section of an L, 3 of 4 unit squares, lifted by 2.
    Row {
        fields: "crossSectionCoords Coordinate3 { point [ 0 0 2, 2 0 2, 2 0 1, 1 0 1, 1 0 0, 0 0 0 ] }",
        area: 6.0 + 8.0 * 2.0,
        volume: 6.0,
    },
    // Along a longer way, lying down.
    Row {
        fields: "spineCoords DEF WAY Coordinate3 { point [ 0 0 0, 3 0 0, 3 0 0, 9 0 0 ] } \
                 inputSwitch Switch { USE WAY }",
        area: 2.0 * 4.0 + 8.0 * 9.0,
        volume: 36.0,
    },
];

#[test]
fn surfaces() {
    for row in ROWS {
        let text = format!(
            "#Inventor V2.0 ascii\nGeneralizedCylinder {{ {CLOSED} {} }}",
            row.fields
        );
        let loader = FileLoader::default();
        let graph = load(text.as_bytes(), "swept.iv", Path::new("."), &loader);
        let resolved = resolve(&graph, &ResolveOptions::default());
        let codes: Vec<_> = graph
            .diagnostics
            .iter()
            .chain(&resolved.diagnostics)
            // Ends may meet in a point.
            .filter(|d| d.code != "degenerate")
            .collect();
        assert!(codes.is_empty(), "{}: {codes:?}", row.fields);
        let totals = totals(&resolved.scene);
        assert!(
            (totals.area - row.area).abs() < 1e-5,
            "{}: area {}",
            row.fields,
            totals.area
        );
        assert!(
            (totals.volume - row.volume).abs() < 1e-5,
            "{}: volume {}",
            row.fields,
            totals.volume
        );
    }
}

#[test]
fn caps_and_sides_can_be_left_out() {
    for (fields, triangles) in [
        ("withTopCap FALSE", 8 + 2),
        ("withTopCap FALSE withBottomCap FALSE", 8),
        ("withSides FALSE", 4),
        ("crossSectionClosed FALSE", 6),
        ("profileCoords Coordinate3 { point 1 1 1 }", 0),
    ] {
        let text = format!("#Inventor V2.0 ascii\nGeneralizedCylinder {{ {CLOSED} {fields} }}");
        let loader = FileLoader::default();
        let graph = load(text.as_bytes(), "swept.iv", Path::new("."), &loader);
        let resolved = resolve(&graph, &ResolveOptions::default());
        assert_eq!(totals(&resolved.scene).triangles, triangles, "{fields}");
        let codes: Vec<_> = graph.diagnostics.iter().map(|d| d.code).collect();
        assert_eq!(
            codes == ["no-surface"],
            triangles == 0,
            "{fields}: {codes:?}"
        );
    }
}
