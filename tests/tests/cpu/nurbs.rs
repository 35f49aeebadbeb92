//! NURBS in Inventor files: fields, profiles, textures, tolerances and what is wrong with them.
//! That curves and surfaces are right is tested in `geometry`.

mod corpus;

use std::path::Path;

use scenegraph::scene::{Scene, Topology};
use scenegraph::{FileLoader, ResolveOptions, Resolved, load, resolve};
use tests::measure::totals;

const PI: f64 = std::f64::consts::PI;

/// The unit circle about z: points, times weights, for a Coordinate4.
const CIRCLE: &str = "1 0 0 1, .70710678 .70710678 0 .70710678, 0 1 0 1,
    -.70710678 .70710678 0 .70710678, -1 0 0 1, -.70710678 -.70710678 0 .70710678,
    0 -1 0 1, .70710678 -.70710678 0 .70710678, 1 0 0 1";
const CIRCLE_KNOTS: &str = "[ 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4 ]";

/// A flat square from 0 to 2, as a bilinear surface over 0 to 1.
const SQUARE: &str = "Coordinate3 { point [ 0 0 0, 2 0 0, 0 2 0, 2 2 0 ] }";
const FLAT: &str = "NurbsSurface { numUControlPoints 2 numVControlPoints 2
    uKnotVector [ 0, 0, 1, 1 ] vKnotVector [ 0, 0, 1, 1 ] }";

fn resolved_with(body: &str, options: &ResolveOptions) -> Resolved {
    let text = format!("#Inventor V2.1 ascii\n{body}");
    let graph = load(
        text.as_bytes(),
        "nurbs.iv",
        Path::new("."),
        &FileLoader::default(),
    );
    assert_eq!(graph.diagnostics, [], "{body}");
    let resolved = resolve(&graph, options);
    assert_eq!(resolved.scene.check(), [], "{body}");
    resolved
}

fn resolved(body: &str) -> Resolved {
    resolved_with(body, &ResolveOptions::default())
}

fn scene(body: &str) -> Scene {
    let resolved = resolved(body);
    assert_eq!(resolved.diagnostics, [], "{body}");
    resolved.scene
}

fn circle() -> String {
    format!(
        "Coordinate4 {{ point [ {CIRCLE} ] }}
        NurbsCurve {{ numControlPoints 9 knotVector {CIRCLE_KNOTS} }}"
    )
}

/// A cylinder about z of radius 1 and height 2.
fn tube() -> String {
    let raised = |dz: f64| {
        CIRCLE
            .split(',')
            .map(|point| {
                let n: Vec<f64> = point
                    .split_whitespace()
                    .map(|t| t.parse().expect("a number"))
                    .collect();
                format!("{} {} {} {}", n[0], n[1], dz * n[3], n[3])
            })
            .collect::<Vec<_>>()
            .join(", ")
    };
    format!(
        "Coordinate4 {{ point [ {}, {} ] }}
        DEF Tube NurbsSurface {{ numUControlPoints 9 numVControlPoints 2
            uKnotVector {CIRCLE_KNOTS} vKnotVector [ 0, 0, 1, 1 ] }}",
        raised(0.0),
        raised(2.0)
    )
}

#[test]
fn curves_are_lines_as_fine_as_complexity_says() {
    for (complexity, slices) in [(0.0, 8), (0.5, 32), (1.0, 64)] {
        let scene = scene(&format!("Complexity {{ value {complexity} }} {}", circle()));
        let mesh = &scene.meshes[0];
        assert_eq!(mesh.topology, Topology::Lines);
        assert_eq!(mesh.primitive_count(), slices, "{complexity}");
        assert!(mesh.normals.is_empty());
        let length = totals(&scene).length;
        assert!((length / (2.0 * PI) - 1.0).abs() < 0.03, "{length}");
    }
    let indexed = scene(
        "Coordinate3 { point [ 9 9 9, 0 0 0, 1 0 0 ] }
        IndexedNurbsCurve { numControlPoints 2 coordIndex [ 1, 2, -1 ] knotVector [ 0, 0, 1, 1 ] }",
    );
    assert_eq!((totals(&indexed).length, totals(&indexed).lines), (1.0, 1));
}

#[test]
fn surfaces_are_lit_by_their_own_normals_and_face_where_they_point() {
    let default = scene(&tube());
    let t = totals(&default);
    assert!((t.area / (4.0 * PI) - 1.0).abs() < 0.01, "{}", t.area);
    assert!(t.normal_dot > 0.99 * t.area, "triangles face as normals do");
    // The sides of a cylinder that stands on the origin: two thirds of its volume.
    assert!(
        (t.volume / (4.0 * PI / 3.0) - 1.0).abs() < 0.02,
        "{}",
        t.volume
    );
    // As for other shapes, clockwise turns the faces and leaves given normals alone.
    let turned = scene(&format!(
        "ShapeHints {{ vertexOrdering CLOCKWISE }} {}",
        tube()
    ));
    assert!((totals(&turned).volume + t.volume).abs() < 1e-6);
    assert_eq!(turned.meshes[0].normals, default.meshes[0].normals);
    let unlit = scene(&format!("LightModel {{ model BASE_COLOR }} {}", tube()));
    assert!(unlit.meshes[0].normals.is_empty());
    let lines = scene(&format!("DrawStyle {{ style LINES }} {}", tube()));
    assert_eq!(lines.meshes[0].topology, Topology::Lines);
}

#[test]
fn profiles_cut_surfaces() {
    let outer = "ProfileCoordinate2 { point [ 0 0, 1 0, 1 1, 0 1, .25 .25, .25 .75, .75 .75,
        .75 .25 ] }";
    let hole_points = "[ 4, 5, 6, 7 ]";
    let border = "LinearProfile { index [ 0, 1, 2, 3 ] }";
    let disc = format!(
        "ProfileCoordinate3 {{ point [ {} ] }} NurbsProfile {{
        index [ 0, 1, 2, 3, 4, 5, 6, 7, 8 ] knotVector {CIRCLE_KNOTS} }}",
        // A circle of radius 0.25 about the middle; the third number is the weight.
        ".75 .5 1, .53033009 .53033009 .70710678, .5 .75 1, .1767767 .53033009 .70710678, .25 .5 1,
        .1767767 .1767767 .70710678, .5 .25 1, .53033009 .1767767 .70710678, .75 .5 1"
    );
    let rows = [
        ("none", String::new(), 4.0),
        ("the border", format!("{outer} {border}"), 4.0),
        (
            "a hole in the border",
            format!("{outer} {border} LinearProfile {{ linkage START_NEW index {hole_points} }}"),
            3.0,
        ),
        (
            "a hole, joined of two",
            format!(
                "{outer} {border} LinearProfile {{ linkage START_NEW index [ 4, 5 ] }}
                LinearProfile {{ linkage ADD_TO_CURRENT index [ 6, 7 ] }}"
            ),
            3.0,
        ),
        (
            "the last START_FIRST counts",
            format!("{outer} {border} LinearProfile {{ index [ 7, 6, 5, 4 ] }}"),
            1.0,
        ),
        ("a disc", disc, PI / 4.0),
        (
            "points that come later",
            format!("{border} ProfileCoordinate2 {{ point [ 0 0, .5 0, .5 1, 0 1 ] }}"),
            2.0,
        ),
        (
            "profiles of a Separator before",
            format!("Separator {{ {outer} LinearProfile {{ index {hole_points} }} }}"),
            4.0,
        ),
    ];
    for (name, profiles, area) in rows {
        let found = totals(&scene(&format!("{SQUARE} {profiles} {FLAT}"))).area;
        assert!((found - area).abs() < 0.02, "{name}: {found}");
    }
    // The same surface under other profiles, or other points of them, is another mesh.
    let used = scene(&format!(
        "{SQUARE} DEF S {FLAT} {outer} LinearProfile {{ index {hole_points} }} USE S
        ProfileCoordinate2 {{ point [ 0 0, 0 0, 0 0, 0 0, 0 0, .5 0, .5 .5, 0 .5 ] }} USE S"
    ));
    assert_eq!(used.meshes.len(), 3);
}

#[test]
fn textures_follow_the_domain_the_net_or_a_function() {
    let picture = "Texture2 { image 1 1 1 128 }";
    let points = "TextureCoordinate2 { point [ 0 0, 3 0, 0 2, 3 2 ] }";
    let net = |class: &str, more: &str| {
        format!(
            "{class} {{ numUControlPoints 2 numVControlPoints 2 uKnotVector [ 0, 0, 1, 1 ]
            vKnotVector [ 0, 0, 1, 1 ] numSControlPoints 2 numTControlPoints 2
            sKnotVector [ 0, 0, 1, 1 ] tKnotVector [ 0, 0, 1, 1 ] {more} }}"
        )
    };
    let indexed = |more: &str| {
        net(
            "IndexedNurbsSurface",
            &format!("coordIndex [ 0, 1, 2, 3 ] {more}"),
        )
    };
    let rows = [
        (format!("{picture} {FLAT}"), [1.0, 1.0]),
        (format!("{picture} {points} {FLAT}"), [1.0, 1.0]),
        (
            format!("{picture} {points} {}", net("NurbsSurface", "")),
            [3.0, 2.0],
        ),
        (format!("{picture} {points} {}", indexed("")), [3.0, 2.0]),
        (
            format!(
                "{picture} {points} {}",
                indexed("textureCoordIndex [ 0, 2, 1, 3 ]")
            ),
            [3.0, 2.0],
        ),
        (
            format!(
                "{picture} TextureCoordinatePlane {{ directionS 1 0 0 directionT 0 .5 0 }} {FLAT}"
            ),
            [2.0, 4.0],
        ),
        (
            format!("{picture} Texture2Transform {{ scaleFactor 5 7 }} {FLAT}"),
            [5.0, 7.0],
        ),
    ];
    for (body, largest) in rows {
        let scene = scene(&format!("{SQUARE} {body}"));
        let mesh = &scene.meshes[0];
        let far = mesh
            .positions
            .iter()
            .position(|p| *p == [2.0, 2.0, 0.0])
            .unwrap();
        assert_eq!(mesh.texcoords[far].map(f64::from), largest, "{body}");
        let near = mesh
            .positions
            .iter()
            .position(|p| *p == [0.0, 0.0, 0.0])
            .unwrap();
        assert_eq!(mesh.texcoords[near], [0.0, 0.0], "{body}");
    }
    assert!(
        scene(&format!("{SQUARE} {points} {FLAT}")).meshes[0]
            .texcoords
            .is_empty()
    );
}

#[test]
fn a_chord_asked_for_is_kept_wherever_the_shape_is_placed() {
    for (scale, chord) in [(1.0, 0.1), (1.0, 0.001), (100.0, 0.1), (0.01, 0.001)] {
        let options = ResolveOptions {
            chord: Some(chord),
            ..ResolveOptions::default()
        };
        let body = format!(
            "Scale {{ scaleFactor {scale} {scale} {scale} }} {}",
            circle()
        );
        let resolved = resolved_with(&body, &options);
        let mesh = &resolved.scene.meshes[0];
        let mut worst: f64 = 0.0;
        for pair in mesh.indices.as_chunks::<2>().0 {
            let [a, b] = pair.map(|i| mesh.p_in_local(i));
            worst = worst.max(scale * (1.0 - ((a + b) / 2.0).length()));
        }
        assert!(worst <= chord, "{scale} {chord}: {worst}");
        assert!(
            worst > chord / 8.0 || mesh.primitive_count() <= 8,
            "{scale} {chord}: {worst}"
        );
    }
    // Other shapes do not follow it, and equal scales share a mesh.
    let options = ResolveOptions {
        chord: Some(1e-3),
        ..ResolveOptions::default()
    };
    let twice = "Rotation { rotation 0 0 1 1 } USE Tube Scale { scaleFactor 2 2 2 } USE Tube";
    let resolved = resolved_with(&format!("{} {twice} Sphere {{ }}", tube()), &options);
    let meshes = &resolved.scene.meshes;
    assert_eq!(meshes.len(), 3);
    assert_eq!(
        meshes[2].primitive_count(),
        scene("Sphere { }").meshes[0].primitive_count()
    );
}

#[test]
fn what_is_wrong_is_said_and_costs_no_more_than_itself() {
    let surface = |fields: &str| format!("{SQUARE} NurbsSurface {{ {fields} }}");
    let counts = "numUControlPoints 2 numVControlPoints 2";
    let good = "uKnotVector [ 0, 0, 1, 1 ] vKnotVector [ 0, 0, 1, 1 ]";
    let long = "9".repeat(9);
    let s = "numSControlPoints 2 numTControlPoints 2";
    let rows: Vec<(String, &[&str], usize)> = vec![
        (surface(""), &[], 0),
        (surface(counts), &["bad-nurbs"], 0),
        (
            surface(&format!(
                "{counts} uKnotVector [ 0, 0, 1 ] vKnotVector [ 0, 0, 1, 1 ]"
            )),
            &["bad-nurbs"],
            0,
        ),
        (
            surface(&format!(
                "{counts} uKnotVector [ 0, 1, 0, 1 ] vKnotVector [ 0, 0, 1, 1 ]"
            )),
            &["bad-nurbs"],
            0,
        ),
        (
            surface(&format!("numUControlPoints 3 numVControlPoints 2 {good}")),
            &["bad-nurbs"],
            0,
        ),
        (
            surface(&format!(
                "numUControlPoints {long} numVControlPoints {long} {good}"
            )),
            &["bad-nurbs"],
            0,
        ),
        (
            surface(&format!("numUControlPoints -2 numVControlPoints 2 {good}")),
            &["bad-nurbs"],
            0,
        ),
        (
            format!("Coordinate4 {{ point [ 0 0 0 1, 1 0 0 0, 0 1 0 1, 1 1 0 1 ] }} {FLAT}"),
            &["bad-nurbs"],
            0,
        ),
        (
            format!("{SQUARE} IndexedNurbsSurface {{ {counts} {good} coordIndex [ 0, 1, 2, 9 ] }}"),
            &["bad-nurbs"],
            0,
        ),
        (
            format!("{SQUARE} LinearProfile {{ index [ 0, 1, 7 ] }} {FLAT}"),
            &["bad-profile"],
            1,
        ),
        (
            format!("{SQUARE} NurbsProfile {{ index 0 }} {FLAT}"),
            &["bad-profile"],
            1,
        ),
        (
            format!(
                "{SQUARE} ProfileCoordinate2 {{ point [ 0 0, 1 1, 1 0, 0 .5 ] }}
                LinearProfile {{ index [ 0, 2, 1, 3 ] }}
                LinearProfile {{ linkage START_NEW index [ 0, 1, 2, 3 ] }} {FLAT}"
            ),
            &["crossing-trim"],
            1,
        ),
        (
            format!(
                "{SQUARE} Texture2 {{ image 1 1 1 9 }} TextureCoordinate2 {{ point 0 0 }}
                NurbsSurface {{ {counts} {good} {s} }}"
            ),
            &["bad-nurbs"],
            1,
        ),
        (
            "NurbsCurve { numControlPoints 2 knotVector [ 0, 0, 1, 1 ] }".into(),
            &["bad-nurbs"],
            0,
        ),
    ];
    for (body, codes, instances) in rows {
        let resolved = resolved(&format!("Cube {{ }} {body}"));
        let found: Vec<&str> = resolved.diagnostics.iter().map(|d| d.code).collect();
        assert_eq!(found, codes, "{body}");
        assert_eq!(resolved.scene.instances.len(), 1 + instances, "{body}");
    }
    let options = ResolveOptions {
        chord: Some(1e-9),
        ..ResolveOptions::default()
    };
    let coarse = resolved_with(&tube(), &options);
    assert_eq!(coarse.diagnostics[0].code, "coarse-nurbs");
}
