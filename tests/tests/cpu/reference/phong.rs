//! Light on one point of a wall, reckoned by hand.
//!
//! The wall is at the origin and its normal is +Z. Normals are f32, but 0 and 1 are exact in it, so
//! that only f64 roundings remain: some tens of them, each below 2^-52 of values below 4.

use super::{BACKGROUND, WALL, colour_at, difference, parallel, picture, to_origin};

const TOLERANCE: f64 = 1e-13;

const ORDERED: &str = "ShapeHints { vertexOrdering COUNTERCLOCKWISE }\n";
const SOLID: &str = "ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType SOLID }\n";
/// No ambient light, a grey surface.
const GREY: &str = "Environment { ambientIntensity 0 } Material { diffuseColor 0.5 0.5 0.5 }\n";
/// The same with a highlight; the exponent is 64.
const SHINY: &str = "Environment { ambientIntensity 0 }
    Material { diffuseColor 0.5 0.5 0.5 specularColor 0.4 0.2 0 shininess 0.5 }\n";

/// Emits light of its own.
const GLOWING: &str = "Environment { ambientIntensity 0 }
    Material { diffuseColor 0.2 0.2 0.2 specularColor 0.1 0.1 0.1 emissiveColor 0.5 0.25 0.125 }\n";

const FRONT: [f64; 3] = [0.0, 0.0, 5.0];
const BEHIND: [f64; 3] = [0.0, 0.0, -5.0];

struct Row {
    name: &'static str,
    before: String,
    eye: [f64; 3],
    expected: [f64; 3],
}

fn row(name: &'static str, before: &[&str], eye: [f64; 3], expected: [f64; 3]) -> Row {
    Row {
        name,
        before: before.concat(),
        eye,
        expected,
    }
}

fn grey(value: f64) -> [f64; 3] {
    [value; 3]
}

fn check(rows: &[Row]) {
    for row in rows {
        let got = colour_at(&(row.before.clone() + WALL), &to_origin(row.eye));
        let off = difference(got, row.expected);
        assert!(
            off <= TOLERANCE,
            "{}: {got:?} for {:?}",
            row.name,
            row.expected
        );
    }
}

#[test]
fn diffuse_light() {
    let cos60 = 0.5;
    let lamp = "PointLight { location 0 0 2 }\n";
    let fading = "Environment { ambientIntensity 0 attenuation 0.5 0.25 1 }";
    let zero = "Environment { ambientIntensity 0 attenuation 0 0 0 }";
    let material = "Material { diffuseColor 0.5 0.5 0.5 }";
    check(&[
        row(
            "sun from the eye",
            &[GREY, "DirectionalLight { }"],
            FRONT,
            grey(0.5),
        ),
        row(
            "sun at 60 degrees, of a colour",
            &[
                GREY,
                "DirectionalLight { direction -1.7320508075688772 0 -1 color 1 0.5 0 intensity 0.5 }",
            ],
            FRONT,
            [0.25 * cos60, 0.125 * cos60, 0.0],
        ),
        row(
            "sun turned by a transform",
            &[
                GREY,
                "TransformSeparator { } Rotation { rotation 0 1 0 1.0471975511965976 } DirectionalLight { } Rotation { rotation 0 1 0 -1.0471975511965976 }",
            ],
            FRONT,
            grey(0.25),
        ),
        row("lamp", &[GREY, lamp], FRONT, grey(0.5)),
        // 1 + 0.25 * 2 + 0.5 * 4
        row(
            "lamp fading",
            &[fading, material, lamp],
            FRONT,
            grey(0.5 / 3.5),
        ),
        row(
            "attenuation of nothing",
            &[zero, material, lamp],
            FRONT,
            grey(0.5),
        ),
        // At (3, 0, 4): distance 5, cosine 0.8.
        row(
            "lamp at a slant",
            &[fading, material, "PointLight { location 3 0 4 }"],
            FRONT,
            grey(0.5 * 0.8 / (1.0 + 1.25 + 12.5)),
        ),
        row(
            "two lights",
            &[GREY, lamp, "DirectionalLight { intensity 0.5 }"],
            FRONT,
            grey(0.75),
        ),
        row(
            "clamped at the end",
            &[
                GREY,
                lamp,
                "DirectionalLight { color 1 0 1 } PointLight { location 0 0 3 color 1 0 0 }",
            ],
            FRONT,
            [1.0, 0.5, 1.0],
        ),
        row(
            "light of a closed group",
            &[
                GREY,
                "Separator { DirectionalLight { } } DirectionalLight { intensity 0.5 }",
            ],
            FRONT,
            grey(0.25),
        ),
    ]);
}

#[test]
fn spot_light() {
    // The lamp at (3, 0, 4) sees the origin at acos(0.8) = 0.6435 from its axis -Z.
    let spot = |cut_off: f64, drop_off: f64| {
        format!(
            "SpotLight {{ location 3 0 4 direction 0 0 -1 cutOffAngle {cut_off} dropOffRate {drop_off} }}"
        )
    };
    check(&[
        row(
            "inside the cone",
            &[GREY, &spot(0.65, 0.0)],
            FRONT,
            grey(0.4),
        ),
        row(
            "outside the cone",
            &[GREY, &spot(0.64, 0.0)],
            FRONT,
            grey(0.0),
        ),
        row(
            "dropping off",
            &[GREY, &spot(0.65, 0.03125)],
            FRONT,
            grey(0.4 * 0.8_f64.powi(4)),
        ),
        row(
            "behind the lamp: 0 to the power of 0",
            &[
                GREY,
                "SpotLight { location 0 0 2 direction 0 0 1 cutOffAngle 3.1415926535897932 dropOffRate 0 }",
            ],
            FRONT,
            grey(0.5),
        ),
    ]);
}

#[test]
fn highlights() {
    // The mirrored sun goes along (1, 0, 1), seen from FRONT at 45 degrees.
    let slanted = "DirectionalLight { direction 1 0 -1 }";
    let cos45 = 0.5_f64.sqrt();
    let matt = "Environment { ambientIntensity 0 } Material { diffuseColor 0 0 0 specularColor 0.4 0.2 0 shininess 0 }";
    check(&[
        row(
            "in the mirror",
            &[SHINY, "DirectionalLight { }"],
            FRONT,
            [0.9, 0.7, 0.5],
        ),
        row(
            "beside the mirror",
            &[SHINY, slanted],
            FRONT,
            [0.4, 0.2, 0.0].map(|s| 0.5 * cos45 + s * cos45.powi(64)),
        ),
        row(
            "seen along the mirrored ray",
            &[SHINY, slanted],
            [3.0, 0.0, 3.0],
            [0.4, 0.2, 0.0].map(|s| 0.5 * cos45 + s),
        ),
        row(
            "no exponent",
            &[matt, slanted],
            [-3.0, 0.0, 0.5],
            [0.4, 0.2, 0.0],
        ),
        row(
            "light from behind",
            &[SHINY, "DirectionalLight { direction 0 0 1 }"],
            FRONT,
            grey(0.0),
        ),
    ]);
}

#[test]
fn a_parallel_view_sees_all_points_from_one_direction() {
    let body = format!("{SHINY} DirectionalLight {{ }} {WALL}");
    for color in picture(&body, &parallel(0.5), [3, 1]).color {
        assert!(difference(color, [0.9, 0.7, 0.5]) <= TOLERANCE, "{color:?}");
    }
}

#[test]
fn the_rest_of_the_sum() {
    let all = "Environment { ambientIntensity 0.5 ambientColor 1 0.5 0.25 }
        Material { ambientColor 0.4 0.4 0.4 emissiveColor 0.1 0 0.2 diffuseColor 0.5 0.5 0.5 }";
    check(&[
        row(
            "ambient and emitted",
            &[all, "DirectionalLight { direction 0 0 1 }"],
            FRONT,
            [0.3, 0.1, 0.25],
        ),
        row("headlight", &[GREY], FRONT, grey(0.5)),
        row("headlight at a slant", &[GREY], [3.0, 0.0, 4.0], grey(0.4)),
        row(
            "no headlight where there is a light",
            &[GREY, "Separator { DirectionalLight { } }"],
            FRONT,
            grey(0.0),
        ),
        row(
            "unlit",
            &[
                all,
                "LightModel { model BASE_COLOR } DirectionalLight { direction 0 0 1 }",
            ],
            FRONT,
            grey(0.5),
        ),
    ]);
}

#[test]
fn both_sides() {
    let to_back = "DirectionalLight { direction 0 0 1 }\n";
    let to_front = "DirectionalLight { direction 0 0 -1 }\n";
    let mirror = "Scale { scaleFactor -1 1 1 }\n";
    // Turns the wall round without mirroring it.
    let turn = "Scale { scaleFactor -1 1 -1 }\n";
    check(&[
        row(
            "two-sided back",
            &[ORDERED, GREY, to_back],
            BEHIND,
            grey(0.5),
        ),
        row(
            "two-sided front",
            &[ORDERED, GREY, to_front],
            FRONT,
            grey(0.5),
        ),
        row(
            "one-sided back, lit with the front's normal",
            &[GREY, to_back],
            BEHIND,
            grey(0.0),
        ),
        // Nothing is taken away: neither by the diffuse part nor by the highlight.
        row(
            "one-sided back that glows",
            &[GLOWING, to_back],
            BEHIND,
            [0.5, 0.25, 0.125],
        ),
        row("solid's front", &[SOLID, GREY, to_front], FRONT, grey(0.5)),
        row(
            "solid's back is not seen",
            &[SOLID, GREY, to_front],
            BEHIND,
            BACKGROUND,
        ),
        row(
            "mirrored front",
            &[SOLID, GREY, to_front, mirror],
            FRONT,
            grey(0.5),
        ),
        row(
            "mirrored back",
            &[SOLID, GREY, to_front, mirror],
            BEHIND,
            BACKGROUND,
        ),
        row("turned", &[SOLID, GREY, to_back, turn], BEHIND, grey(0.5)),
        row(
            "mirrored, two-sided",
            &[ORDERED, GREY, to_back, mirror],
            BEHIND,
            grey(0.5),
        ),
    ]);
}

#[test]
fn smooth_and_stretched_normals() {
    // Scaled by 2 along X, the normal (0.6, 0, 0.8) is along (0.3, 0, 0.8). The stored normals are
    // f32: 0.6 and 0.8 err by 2^-25 and the result by no more than that.
    let cosine = 0.8 / (0.3_f64 * 0.3 + 0.8 * 0.8).sqrt();
    let body = "Environment { ambientIntensity 0 } DirectionalLight { } Scale { scaleFactor 2 1 1 }
        Normal { vector [ 0.6 0 0.8 ] } NormalBinding { value OVERALL }";
    let got = colour_at(&format!("{body}{WALL}"), &to_origin(FRONT));
    assert!(difference(got, grey(0.8 * cosine)) < 6e-8, "{got:?}");
    // Between (0.6, 0, 0.8) on the left and (-0.6, 0, 0.8) on the right there is (0, 0, 1).
    let body = "Environment { ambientIntensity 0 } DirectionalLight { } NormalBinding { value PER_VERTEX_INDEXED }
        Normal { vector [ 0.6 0 0.8, -0.6 0 0.8, -0.6 0 0.8, 0.6 0 0.8 ] }";
    let got = colour_at(&format!("{body}{WALL}"), &to_origin(FRONT));
    assert!(difference(got, grey(0.8)) < 6e-8, "{got:?}");
}
