//! Shapes: sizes in closed form, outward normals, bindings, texture coordinates.

use std::f64::consts::{FRAC_PI_4, PI};

use glam::DVec3;
use scenegraph::scene::Scene;
use tests::measure::{primitives, totals};

use super::scene_of;

/// A shape by its geometry: area, volume (`None` where it is not asked for) and bounds.
struct Row {
    geometry: &'static str,
    area: Option<f64>,
    volume: Option<f64>,
    low: [f64; 3],
    high: [f64; 3],
}

const ROWS: &[Row] = &[
    Row {
        geometry: "Box { size 1 2 3 }",
        area: Some(22.0),
        volume: Some(6.0),
        low: [-0.5, -1.0, -1.5],
        high: [0.5, 1.0, 1.5],
    },
    Row {
        geometry: "Extrusion { }",
        area: Some(4.0 * 2.0 + 2.0 * 4.0),
        volume: Some(4.0),
        low: [-1.0, 0.0, -1.0],
        high: [1.0, 1.0, 1.0],
    },
    // A straight spine turns the section with it: along x, what was x points down.
    Row {
        geometry: "Extrusion { spine [ 0 0 0, 1 0 0, 3 0 0 ]
            crossSection [ 2 1, 2 -1, -2 -1, -2 1, 2 1 ] }",
        area: Some(2.0 * 8.0 + 3.0 * 12.0),
        volume: Some(24.0),
        low: [0.0, -2.0, -1.0],
        high: [3.0, 2.0, 1.0],
    },
    // Downwards it stays a closed body with normals outward.
    Row {
        geometry: "Extrusion { spine [ 0 0 0, 0 -2 0 ] }",
        area: Some(2.0 * 4.0 + 2.0 * 8.0),
        volume: Some(8.0),
        low: [-1.0, -2.0, -1.0],
        high: [1.0, 0.0, 1.0],
    },
    // One scale for each point: a pyramid with a point for its tip.
    Row {
        geometry: "Extrusion { spine [ 0 0 0, 0 3 0 ] scale [ 1 1, 0 0 ] }",
        area: Some(4.0 + 4.0 * 3.162_277_660_168_379_5),
        volume: Some(4.0),
        low: [-1.0, 0.0, -1.0],
        high: [1.0, 3.0, 1.0],
    },
    // An orientation for all: a quarter turn about y makes 4 by 2 of 2 by 4.
    Row {
        geometry: "Extrusion { crossSection [ 2 1, 2 -1, -2 -1, -2 1, 2 1 ]
            orientation 0 1 0 1.5707963267948966 }",
        area: Some(2.0 * 8.0 + 12.0),
        volume: Some(8.0),
        low: [-1.0, 0.0, -2.0],
        high: [1.0, 1.0, 2.0],
    },
    // A spine round a square in the xz plane, closed: mitred corners, no caps. The plane at each
    // corner lies across the diagonal, so the ring is the square's outline moved by half a unit
    // of the section along it: 1 / sqrt 2 to each side.
    Row {
        geometry: "Extrusion { spine [ 2 0 2, 2 0 -2, -2 0 -2, -2 0 2, 2 0 2 ]
            crossSection [ 1 1, 1 -1, -1 -1, -1 1, 1 1 ] beginCap FALSE endCap FALSE }",
        // Outer and inner walls 4 * 2 * (4 + sqrt 2) and 4 * 2 * (4 - sqrt 2); two rings
        // (4 + sqrt 2)^2 - (4 - sqrt 2)^2 = 16 sqrt 2 each.
        area: Some(64.0 + 2.0 * 22.627_416_997_969_522),
        volume: Some(2.0 * 22.627_416_997_969_522),
        low: [-2.707_106_781_186_547_5, -1.0, -2.707_106_781_186_547_5],
        high: [2.707_106_781_186_547_5, 1.0, 2.707_106_781_186_547_5],
    },
    // An S in the xy plane: the plane must not turn over where the bend changes sides.
    Row {
        geometry: "Extrusion { spine [ 0 0 0, 1 0 0, 1 1 0, 2 1 0 ]
            crossSection [ .1 .1, .1 -.1, -.1 -.1, -.1 .1, .1 .1 ] }",
        // Three arms of 0.2 high trapezoids, cut across the diagonal, which moves the corners by
        // w = 0.1 / sqrt 2: 0.2 (2 (0.1 + w) + 2 w).
        area: None,
        volume: Some(0.096_568_542_494_923_8),
        low: [0.0, -0.1, -0.1],
        high: [2.0, 1.1, 0.1],
    },
    // A tilted plane over 2 by 3 units, rising 1 along x.
    Row {
        geometry: "ElevationGrid { xDimension 3 zDimension 4 height [ 0 .5 1 0 .5 1 0 .5 1 0 .5 1 ] }",
        area: Some(3.0 * 2.236_067_977_499_79),
        volume: None,
        low: [0.0, 0.0, 0.0],
        high: [2.0, 1.0, 3.0],
    },
    Row {
        geometry: "ElevationGrid { xDimension 2 zDimension 2 xSpacing 5 zSpacing .5 height [ 1 1 1 1 7 ] }",
        area: Some(2.5),
        volume: None,
        low: [0.0, 1.0, 0.0],
        high: [5.0, 1.0, 0.5],
    },
];

fn shape(geometry: &str) -> Scene {
    let text = format!(
        "Shape {{ appearance Appearance {{ material Material {{ }} }} geometry {geometry} }}"
    );
    let (scene, codes) = scene_of(&text);
    assert!(codes.is_empty(), "{geometry}: {codes:?}");
    scene
}

fn close(a: f64, b: f64) -> bool {
    // Positions are f32.
    (a - b).abs() <= 1e-5 * b.abs().max(1.0)
}

#[test]
fn sizes_in_closed_form() {
    for row in ROWS {
        let found = totals(&shape(row.geometry));
        let geometry = row.geometry;
        if let Some(area) = row.area {
            assert!(close(found.area, area), "{geometry}: area {}", found.area);
        }
        if let Some(volume) = row.volume {
            assert!(
                close(found.volume, volume),
                "{geometry}: volume {}",
                found.volume
            );
        }
        let [low, high] = found.bounds.expect("something drawn");
        for (found, wanted) in [(low, row.low), (high, row.high)] {
            let same = found.abs_diff_eq(DVec3::from(wanted), 1e-5);
            assert!(same, "{geometry}: {found} for {wanted:?}");
        }
        // Normals agree with the triangles they stand on.
        assert!(close(found.normal_dot, found.area), "{geometry}: normals");
    }
}

/// A torus of n by m quads has the volume that its inscribed rings enclose; it tends to
/// 2 pi^2 R r^2, from inside.
#[test]
fn a_closed_spine_makes_a_torus() {
    let (n, m, major, minor) = (96, 48, 3.0_f64, 1.0_f64);
    let around = |count: usize, radius: f64, sign: f64| -> Vec<[f64; 2]> {
        let point = |i: usize| {
            let angle = 2.0 * PI * (i % count) as f64 / count as f64;
            [radius * angle.cos(), sign * radius * angle.sin()]
        };
        (0..=count).map(point).collect()
    };
    let list = |points: &[[f64; 2]], between: &str| {
        let text: Vec<String> = points
            .iter()
            .map(|[a, b]| format!("{a:?}{between}{b:?}"))
            .collect();
        text.join(",")
    };
    let spine = list(&around(n, major, 1.0), " 0 ");
    let section = list(&around(m, minor, -1.0), " ");
    let text = format!(
        "Extrusion {{ beginCap FALSE endCap FALSE creaseAngle 1 spine [ {spine} ] crossSection [ {section} ] }}"
    );
    let found = totals(&shape(&text));
    let volume = 2.0 * PI * PI * major * minor * minor;
    assert!(
        found.volume < volume && found.volume > 0.99 * volume,
        "{}",
        found.volume
    );
    let area = 4.0 * PI * PI * major * minor;
    assert!(
        found.area < area && found.area > 0.99 * area,
        "{}",
        found.area
    );
    // Smooth across both seams: no face is further from its normals than half a step.
    assert!(found.normal_dot > 0.997 * found.area);
}

/// A twist keeps the section's area at each end and lengthens the sides.
#[test]
fn a_twist_turns_the_end() {
    let scene = shape(
        "Extrusion { crossSection [ 3 1, 3 -1, -3 -1, -3 1, 3 1 ] orientation [ 0 1 0 0, 0 1 0 1.5707963267948966 ] }",
    );
    let top = |axis: usize| {
        let corners = primitives(&scene).flat_map(|p| p.corners);
        let upper = corners.filter(|c| c.p_in_world.y > 0.5);
        upper.fold(0.0_f64, |m, c| m.max(c.p_in_world[axis].abs()))
    };
    assert!(
        close(top(0), 1.0) && close(top(2), 3.0),
        "{} {}",
        top(0),
        top(2)
    );
}

#[test]
fn grids_face_up_and_cw_turns_them() {
    let grid = "ElevationGrid { xDimension 2 zDimension 2 height [ 0 0 0 0 ] ";
    for (end, up) in [("}", 1.0), ("ccw FALSE }", -1.0)] {
        for triangle in primitives(&shape(&format!("{grid}{end}"))) {
            let [a, b, c] = [0, 1, 2].map(|i| triangle.corners[i].p_in_world);
            assert!((b - a).cross(c - a).y * up > 0.0, "{end}");
            assert_eq!(triangle.corners[0].n_in_world, Some(DVec3::Y * up), "{end}");
        }
    }
}

/// The colours of all corners, triangle by triangle.
fn colors(geometry: &str) -> Vec<Vec<[f64; 3]>> {
    let scene = shape(geometry);
    let of = |p: tests::measure::Primitive| p.corners.iter().map(|c| c.color_srgb).collect();
    primitives(&scene).map(of).collect()
}

const R: [f64; 3] = [1.0, 0.0, 0.0];
const G: [f64; 3] = [0.0, 1.0, 0.0];
const B: [f64; 3] = [0.0, 0.0, 1.0];

#[test]
fn colours_go_by_vertex_or_face_and_index() {
    let faces = "coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0, 0 0 1 ] }
        coordIndex [ 0 1 2 -1 0 2 3 -1 ] color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 0 0 ] }";
    let lines = "coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } coordIndex [ 0 1 -1 1 2 -1 ]
        color Color { color [ 1 0 0, 0 1 0, 0 0 1 ] }";
    let grid = "xDimension 3 zDimension 2 height [ 0 0 0 0 0 0 ]
        color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 0 0, 0 1 0, 0 0 1 ] }";
    let rows: &[(String, Vec<Vec<[f64; 3]>>)] = &[
        (format!("IndexedFaceSet {{ {faces} }}"), vec![vec![R, G, B], vec![R, B, R]]),
        (
            format!("IndexedFaceSet {{ {faces} colorIndex [ 2 2 1 -1 0 0 0 -1 ] }}"),
            vec![vec![B, B, G], vec![R; 3]],
        ),
        (
            format!("IndexedFaceSet {{ {faces} colorPerVertex FALSE }}"),
            vec![vec![R; 3], vec![G; 3]],
        ),
        (
            format!("IndexedFaceSet {{ {faces} colorPerVertex FALSE colorIndex [ 2 0 ] }}"),
            vec![vec![B; 3], vec![R; 3]],
        ),
        (format!("IndexedLineSet {{ {lines} }}"), vec![vec![R, G], vec![G, B]]),
        (
            format!("IndexedLineSet {{ {lines} colorPerVertex FALSE }}"),
            vec![vec![R; 2], vec![G; 2]],
        ),
        (
            format!("IndexedLineSet {{ {lines} colorPerVertex FALSE colorIndex [ 1 2 ] }}"),
            vec![vec![G; 2], vec![B; 2]],
        ),
        (
            "PointSet { coord Coordinate { point [ 0 0 0, 1 0 0 ] } color Color { color [ 0 0 1, 1 0 0 ] } }".to_owned(),
            vec![vec![B], vec![R]],
        ),
        (
            format!("ElevationGrid {{ {grid} colorPerVertex FALSE }}"),
            vec![vec![R; 3], vec![R; 3], vec![G; 3], vec![G; 3]],
        ),
    ];
    for (geometry, wanted) in rows {
        assert_eq!(&colors(geometry), wanted, "{geometry}");
    }
}

/// Bounds of the texture coordinates of a textured geometry.
fn texture_bounds(geometry: &str, more: &str) -> [[f64; 2]; 2] {
    let text = format!(
        "Shape {{ appearance Appearance {{ texture PixelTexture {{ image 1 1 3 0xff0000 }} {more} }} geometry {geometry} }}"
    );
    let (scene, codes) = scene_of(&text);
    assert!(codes.is_empty(), "{geometry}: {codes:?}");
    let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for corner in primitives(&scene).flat_map(|p| p.corners) {
        let st = corner.texcoord.expect("texture coordinates");
        for i in 0..2 {
            bounds[0][i] = bounds[0][i].min(st[i]);
            bounds[1][i] = bounds[1][i].max(st[i]);
        }
    }
    bounds
}

#[test]
fn default_texture_coordinates() {
    let quad = |corners: &str| {
        format!(
            "IndexedFaceSet {{ coord Coordinate {{ point [ {corners} ] }} coordIndex [ 0 1 2 3 -1 ] }}"
        )
    };
    let rows = [
        // The longest side fills 0 to 1, the other keeps the aspect.
        (quad("0 0 0, 4 0 0, 4 1 0, 0 1 0"), [1.0, 0.25]),
        (quad("0 0 0, 1 0 0, 1 4 0, 0 4 0"), [1.0, 0.25]),
        (
            "ElevationGrid { xDimension 3 zDimension 2 height [ 0 0 0 0 0 0 ] }".to_owned(),
            [1.0, 1.0],
        ),
        (
            "Extrusion { beginCap FALSE endCap FALSE }".to_owned(),
            [1.0, 1.0],
        ),
        (
            "Extrusion { crossSection [ 2 1, 2 -1, -2 -1, -2 1, 2 1 ] spine [ 0 0 0, 0 .1 0 ] }"
                .to_owned(),
            [1.0, 1.0],
        ),
    ];
    for (geometry, high) in &rows {
        let found = texture_bounds(geometry, "");
        assert_eq!(found[0], [0.0; 2], "{geometry}");
        for i in 0..2 {
            assert!(close(found[1][i], high[i]), "{geometry}: {found:?}");
        }
    }
}

/// For a square S runs along x (Inventor: along y).
#[test]
fn of_equal_sides_the_first_is_the_longer() {
    let text = "Shape { appearance Appearance { texture PixelTexture { image 1 1 3 0xff0000 } }
        geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } coordIndex [ 0 1 2 3 -1 ] } }";
    let (scene, _) = scene_of(text);
    for corner in primitives(&scene).flat_map(|p| p.corners) {
        let p = corner.p_in_world;
        assert_eq!(corner.texcoord, Some([p.x, p.y]));
    }
}

/// Moved, then turned and scaled about the centre.
#[test]
fn texture_transforms() {
    let quad = "IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } coordIndex [ 0 1 2 3 -1 ] }";
    let rows = [
        ("translation 1 2", [[1.0, 2.0], [2.0, 3.0]]),
        ("scale 2 3", [[0.0, 0.0], [2.0, 3.0]]),
        ("translation 1 1 scale 2 3", [[2.0, 3.0], [4.0, 6.0]]),
        ("rotation 1.5707963267948966", [[-1.0, 0.0], [0.0, 1.0]]),
        (
            "rotation 1.5707963267948966 scale 2 3",
            [[-2.0, 0.0], [0.0, 3.0]],
        ),
        ("center .5 .5 scale 2 2", [[0.5, 0.5], [2.5, 2.5]]),
    ];
    for (fields, wanted) in rows {
        let more = format!("textureTransform TextureTransform {{ {fields} }}");
        let found = texture_bounds(quad, &more);
        let same = (0..4).all(|i| close(found[i / 2][i % 2], wanted[i / 2][i % 2]));
        assert!(same, "{fields}: {found:?}");
    }
}

#[test]
fn parts_of_round_shapes() {
    let circle = |r: f64| PI * r * r;
    let rows = [
        ("Cylinder { side FALSE bottom FALSE }", circle(1.0)),
        ("Cylinder { side FALSE }", 2.0 * circle(1.0)),
        (
            "Cylinder { top FALSE bottom FALSE radius 2 }",
            2.0 * PI * 2.0 * 2.0,
        ),
        ("Cone { side FALSE bottomRadius 3 }", circle(3.0)),
        ("Sphere { radius 2 }", 4.0 * circle(2.0)),
        (
            "Cone { bottom FALSE height 1 }",
            PI * (2.0 * FRAC_PI_4).tan().min(1.0) * 2.0_f64.sqrt(),
        ),
    ];
    for (geometry, area) in rows {
        let found = totals(&shape(geometry)).area;
        // Chords of 32 slices cut 0.7 % of a circle's area.
        assert!(
            found < area * 1.000_01 && found > 0.99 * area,
            "{geometry}: {found} of {area}"
        );
    }
}

/// Where a text stands: its height is 0.8 above the base line at most, and 0.2 below.
#[test]
fn texts() {
    let rows = [
        // Fields, then from where to where it reaches along x and y, in heights, at the most.
        ("string \"EEE\"", [0.0, 3.0], [0.0, 0.8]),
        (
            "string \"EEE\" fontStyle FontStyle { size 2 justify \"MIDDLE\" }",
            [-3.0, 3.0],
            [0.0, 1.6],
        ),
        (
            "string \"EEE\" fontStyle FontStyle { justify [ \"END\" \"BEGIN\" ] }",
            [-3.0, 0.0],
            [-1.0, 0.0],
        ),
        ("string [ \"E\" \"E\" ]", [0.0, 1.0], [-1.0, 0.8]),
        ("string \"EEE\" length 9", [0.0, 9.0], [0.0, 0.8]),
        ("string \"EEE\" maxExtent 1", [0.0, 1.0], [0.0, 0.8]),
    ];
    for (fields, x, y) in rows {
        let [low, high] = totals(&shape(&format!("Text {{ {fields} }}")))
            .bounds
            .expect("letters");
        // Letters fill a good part of the room that is theirs.
        for (axis, [from, to]) in [(0, x), (1, y)] {
            let (low, high) = (low[axis], high[axis]);
            let inside = low >= from - 0.05 && high <= to + 0.05;
            assert!(
                inside && high - low > 0.3 * (to - from),
                "{fields}: {low} {high}"
            );
        }
    }
}

#[test]
fn shapes_that_are_not_there() {
    let rows: &[(&str, &[&str])] = &[
        ("Shape { }", &[]),
        ("Shape { geometry NULL }", &[]),
        (
            "Shape { geometry IndexedFaceSet { coordIndex [ 0 1 2 ] } }",
            &[],
        ),
        (
            "Shape { geometry IndexedFaceSet { coord Box { } } }",
            &["wrong-class"],
        ),
        ("Shape { geometry Group { } }", &["wrong-class"]),
        ("Shape { geometry Text { } }", &[]),
        (
            "Shape { geometry Extrusion { spine [ 0 0 0 ] } }",
            &["bad-shape"],
        ),
        (
            "Shape { geometry ElevationGrid { xDimension 2 zDimension 2 height [ 1 2 3 ] } }",
            &["bad-shape"],
        ),
        (
            "Shape { geometry ElevationGrid { xDimension -2 zDimension 2147483647 } }",
            &["bad-shape"],
        ),
        ("Coordinate { point [ 0 0 0 ] }", &["no-place"]),
    ];
    for (text, wanted) in rows {
        let (scene, codes) = scene_of(text);
        assert!(scene.instances.is_empty(), "{text}");
        assert_eq!(codes, *wanted, "{text}");
    }
}

/// A short text that asks for more corners than memory holds.
#[test]
fn huge_extrusions_are_refused() {
    let points = "0 1 2 ".repeat(10_000);
    let text = format!(
        "Shape {{ geometry Extrusion {{ spine [ {points} ] crossSection [ {points} ] }} }}"
    );
    let (scene, codes) = scene_of(&text);
    assert!(scene.instances.is_empty());
    assert_eq!(codes, ["bad-shape"]);
}

/// Extreme and degenerate numbers give a sound scene; `scene_of` checks it.
#[test]
fn degenerate_numbers_do_no_harm() {
    for geometry in [
        "Extrusion { spine [ 0 0 0, 0 0 0, 0 0 0 ] }",
        "Extrusion { spine [ 1e300 0 0, -1e300 0 0, 0 1e300 0 ] }",
        "Extrusion { spine [ 0 0 0, 1e-300 0 0, 0 1e-300 0 ] }",
        "Extrusion { crossSection [ 0 0, 0 0 ] }",
        "Extrusion { crossSection [ ] scale [ ] orientation [ ] }",
        "Extrusion { scale [ ] orientation [ ] }",
        "Extrusion { scale -1 0 orientation 0 0 0 1 }",
        "Extrusion { spine [ 0 0 0, 1 0 0, 0 0 0 ] }",
        "ElevationGrid { xDimension 2 zDimension 2 xSpacing 0 height [ 0 0 0 0 ] }",
        "ElevationGrid { xDimension 2 zDimension 2 xSpacing 1e300 height [ 1e300 0 0 -1e300 ] }",
    ] {
        scene_of(&format!("Shape {{ geometry {geometry} }}"));
    }
}
