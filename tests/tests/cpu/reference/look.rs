//! Fog, glass, textures and colours of vertices at one point, reckoned by hand.

use super::{BACKGROUND, WALL, colour_at, difference, parallel, to_origin};

/// A few dozen roundings of f64 values below 1.
const TOLERANCE: f64 = 1e-13;

const UNLIT: &str = "LightModel { model BASE_COLOR }\n";
const FRONT: [f64; 3] = [0.0, 0.0, 5.0];

fn check(rows: &[(&str, String, [f64; 3], [f64; 3])]) {
    for (name, body, eye, expected) in rows {
        let got = colour_at(body, &to_origin(*eye));
        assert!(
            difference(got, *expected) <= TOLERANCE,
            "{name}: {got:?} for {expected:?}"
        );
    }
}

#[test]
fn fog() {
    let fog = |kind: &str, visibility: f64| {
        format!(
            "Environment {{ fogType {kind} fogColor 0.5 0.75 0.5 fogVisibility {visibility} }}
            Material {{ diffuseColor 0.75 0.25 0.25 }} {UNLIT}{WALL}"
        )
    };
    let mixed = |left: f64| [0.5 + 0.25 * left, 0.75 - 0.5 * left, 0.5 - 0.25 * left];
    // The wall is 5 away; so are, in depth, all its corners seen from straight ahead.
    check(&[
        ("haze", fog("HAZE", 20.0), FRONT, mixed(0.75)),
        ("thick haze", fog("HAZE", 4.0), FRONT, mixed(0.0)),
        ("fog", fog("FOG", 10.0), FRONT, mixed(1.0 / 16.0)),
        ("smoke", fog("SMOKE", 10.0), FRONT, mixed(0.25)),
        ("haze to the end", fog("HAZE", 0.0), FRONT, mixed(0.0)),
        // Its far corners are at depth 5 + 2 * 0.6.
        (
            "haze to the far corner",
            fog("HAZE", 0.0),
            [3.0, 0.0, 4.0],
            mixed(1.2 / 6.2),
        ),
    ]);
}

/// A pane of this colour and transparency at a height above the wall.
fn pane(z: f64, color: &str, transparency: f64) -> String {
    format!(
        "Separator {{ Material {{ diffuseColor {color} transparency {transparency} }}
        Translation {{ translation 0 0 {z} }} {WALL} }}\n"
    )
}

#[test]
fn glass() {
    let red = |z| pane(z, "1 0 0", 0.5);
    let blue = |z| pane(z, "0 0 1", 0.75);
    let wall = pane(0.0, "0.5 0.5 0.5", 0.0);
    let [r, g, b] = BACKGROUND;
    let ordered = "ShapeHints { vertexOrdering COUNTERCLOCKWISE }\n";
    // The pane's own lower half has been folded forward: front seen before its back.
    let folded = "Material { diffuseColor [ 1 0 0, 0 0 1 ] transparency [ 0.5 ] }
        MaterialBinding { value PER_FACE }
        Coordinate3 { point [ -2 -2 1, 2 -2 1, 2 2 1, -2 2 1, -2 -2 2, 2 -2 2, 2 2 2, -2 2 2 ] }
        IndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1, 7, 6, 5, 4, -1 ] }\n";
    let lit = "Environment { ambientIntensity 0 } DirectionalLight { }\n";
    check(&[
        (
            "one pane",
            format!("{UNLIT}{}", red(0.0)),
            FRONT,
            [0.5 + r / 2.0, g / 2.0, b / 2.0],
        ),
        (
            "over a wall",
            format!("{UNLIT}{wall}{}", red(1.0)),
            FRONT,
            [0.75, 0.25, 0.25],
        ),
        (
            "behind a wall",
            format!("{UNLIT}{wall}{}", red(-1.0)),
            FRONT,
            [0.5; 3],
        ),
        (
            "the far one first",
            format!("{UNLIT}{wall}{}{}", red(2.0), blue(1.0)),
            FRONT,
            [0.6875, 0.1875, 0.3125],
        ),
        (
            "the far one first, given first",
            format!("{UNLIT}{wall}{}{}", blue(1.0), red(2.0)),
            FRONT,
            [0.6875, 0.1875, 0.3125],
        ),
        (
            "at one depth as given",
            format!("{UNLIT}{wall}{}{}", blue(1.0), red(1.0)),
            FRONT,
            [0.6875, 0.1875, 0.3125],
        ),
        // The blue back face is nearer to the eye, but backs are drawn first.
        (
            "back faces first",
            format!("{ordered}{UNLIT}{wall}{folded}"),
            FRONT,
            [0.625, 0.125, 0.375],
        ),
        (
            "no shadow on the wall nor on glass",
            format!("{lit}{wall}{}{}", red(1.0), blue(2.0)),
            FRONT,
            [0.5625, 0.1875, 0.4375],
        ),
        (
            "glass is lit though something is in between",
            format!(
                "DirectionalLight {{ direction 0 0 1 }} Environment {{ ambientIntensity 0 }} {}
                ShapeHints {{ vertexOrdering COUNTERCLOCKWISE }} {wall}{}",
                pane(-1.0, "1 1 1", 0.0),
                "Scale { scaleFactor 1 -1 -1 }".to_owned() + &pane(-1.0, "1 0 0", 0.5)
            ),
            FRONT,
            [0.0; 3],
        ),
    ]);
}

#[test]
fn colours_of_vertices() {
    // Half way along the diagonal between red and blue, and of opaque and invisible.
    let body = "MaterialBinding { value PER_VERTEX_INDEXED }
        Material { diffuseColor [ 1 0 0, 1 1 1, 0 0 1, 1 1 1 ] transparency [ 0, 0, 1, 0 ] }\n";
    let [r, g, b] = BACKGROUND;
    let expected = [0.25 + r / 2.0, g / 2.0, 0.25 + b / 2.0];
    check(&[("diagonal", format!("{UNLIT}{body}{WALL}"), FRONT, expected)]);
}

/// A texture of 2 x 2 pixels on the wall, in unlit orange of this transparency.
fn textured(model: &str, pixels: &str, st: [f64; 2], wrap: &str, transparency: f64) -> String {
    // The point of the wall in the middle of the view has these texture coordinates.
    let [s, t] = st;
    let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
    let points: String = (corners.iter())
        .map(|(u, v)| format!("{} {}, ", s + u, t + v))
        .collect();
    format!(
        "{UNLIT} Material {{ diffuseColor 1 0.5 0 transparency {transparency} }}
        Texture2 {{ model {model} blendColor 0 0 1 wrapS {wrap} wrapT {wrap} image {pixels} }}
        TextureCoordinate2 {{ point [ {points} ] }} {WALL}"
    )
}

/// `color` with `alpha` over the background.
fn over(color: [f64; 3], alpha: f64) -> [f64; 3] {
    [0, 1, 2].map(|i| color[i] * alpha + BACKGROUND[i] * (1.0 - alpha))
}

#[test]
fn texture_models() {
    // In the middle of the lower left pixel; 0x33 is 0.2, 0x66 is 0.4, 0x99 is 0.6 of 255.
    let at = [0.25, 0.25];
    let grey = "2 2 1 0x33 0 0 0";
    let grey_alpha = "2 2 2 0x3399 0 0 0";
    let rgb = "2 2 3 0x336699 0 0 0";
    let rgba = "2 2 4 0x33669999 0 0 0";
    let rows = [
        ("MODULATE", grey, [0.2, 0.1, 0.0], 0.25, 0.75),
        ("MODULATE", grey_alpha, [0.2, 0.1, 0.0], 0.25, 0.45),
        ("MODULATE", rgb, [0.2, 0.2, 0.0], 0.25, 0.75),
        ("MODULATE", rgba, [0.2, 0.2, 0.0], 0.25, 0.45),
        ("DECAL", rgb, [0.2, 0.4, 0.6], 0.25, 0.75),
        ("DECAL", rgba, [0.52, 0.44, 0.36], 0.25, 0.75),
        ("BLEND", grey, [0.8, 0.4, 0.2], 0.25, 0.75),
        ("BLEND", rgba, [0.8, 0.3, 0.6], 0.25, 0.45),
        ("REPLACE", rgb, [0.2, 0.4, 0.6], 0.25, 0.75),
        ("REPLACE", rgba, [0.2, 0.4, 0.6], 0.25, 0.6),
        // Only the texture makes these transparent; a decal does not.
        ("MODULATE", rgba, [0.2, 0.2, 0.0], 0.0, 0.6),
        ("BLEND", rgba, [0.8, 0.3, 0.6], 0.0, 0.6),
        ("REPLACE", rgba, [0.2, 0.4, 0.6], 0.0, 0.6),
        ("DECAL", rgba, [0.52, 0.44, 0.36], 0.0, 1.0),
    ];
    for (model, pixels, color, transparency, alpha) in rows {
        // Texture coordinates are f32: 0.25 +- 0.5 is exact in it.
        let got = colour_at(
            &textured(model, pixels, at, "REPEAT", transparency),
            &parallel(1.0),
        );
        let expected = over(color, alpha);
        assert!(
            difference(got, expected) <= TOLERANCE,
            "{model} {pixels}: {got:?} for {expected:?}"
        );
    }
}

#[test]
fn between_pixels() {
    // Rows from the bottom: 0x33 0x66, 0x99 0xff.
    let pixels = "2 2 1 0x33 0x66 0x99 0xff";
    let rows = [
        ([0.25, 0.25], "REPEAT", 0.2),
        ([0.75, 0.25], "REPEAT", 0.4),
        ([0.25, 0.75], "REPEAT", 0.6),
        ([0.5, 0.25], "REPEAT", 0.3),
        ([0.25, 0.5], "REPEAT", 0.4),
        ([0.5, 0.5], "REPEAT", 0.55),
        ([0.375, 0.25], "REPEAT", 0.25),
        // Across the seam, on either side of it.
        ([0.0, 0.25], "REPEAT", 0.3),
        ([1.125, 0.25], "REPEAT", 0.25),
        ([-1.75, 2.25], "REPEAT", 0.2),
        ([0.0, 0.25], "CLAMP", 0.2),
        ([-3.0, 0.25], "CLAMP", 0.2),
        ([1.0, 7.0], "CLAMP", 1.0),
    ];
    for (st, wrap, value) in rows {
        let got = colour_at(&textured("REPLACE", pixels, st, wrap, 0.25), &parallel(1.0));
        let expected = over([value; 3], 0.75);
        assert!(
            difference(got, expected) <= TOLERANCE,
            "{st:?} {wrap}: {got:?} for {expected:?}"
        );
    }
}
