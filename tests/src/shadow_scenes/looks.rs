//! Materials, textures, lights of all kinds, fog: what a surface looks like besides its shadows.

use glam::DVec3;

use super::text::{Mesh, Text};
use super::{ShadowScene, facing, over, perspective};

/// Lamps, spots and suns of different colours, fading with distance, on shining things; one light
/// reaches some of them only.
pub fn many_lights() -> ShadowScene {
    let mut text = Text::new();
    text.raw("Environment { ambientIntensity 0.3 ambientColor 0.8 0.9 1 attenuation 0.02 0.05 1 }");
    text.lamp(
        "PointLight",
        DVec3::new(1.5, 2.5, 1.0),
        "color 1 0.6 0.5 intensity 0.7",
    );
    let spot = "direction 0.3 -1 -0.2 cutOffAngle 0.5 dropOffRate 0.05 color 0.5 1 0.6";
    text.lamp("SpotLight", DVec3::new(-1.0, 3.0, 1.0), spot);
    let narrow = "direction -0.5 -1 0.1 cutOffAngle 0.25 dropOffRate 0 color 0.6 0.6 1";
    text.lamp("SpotLight", DVec3::new(1.2, 3.2, -0.8), narrow);
    text.raw("DirectionalLight { direction -0.4 -1 -0.7 color 0.9 0.9 0.7 intensity 0.4 }");
    text.raw("DirectionalLight { direction 0.9 -0.5 0.1 color 0.4 0.5 0.9 intensity 0.3 }");
    text.floor(0.0, 4.0);
    let things = [
        (
            "0.8 0.2 0.2",
            "0.1",
            [-1.0, 0.5, 0.5],
            "Cube { width 0.8 height 0.8 depth 0.8 }",
        ),
        (
            "0.2 0.7 0.3",
            "0.4",
            [0.4, 0.7, -0.5],
            "Sphere { radius 0.6 }",
        ),
        (
            "0.3 0.3 0.8",
            "1",
            [1.2, 0.6, 1.0],
            "Cone { bottomRadius 0.5 height 1 }",
        ),
    ];
    for (i, (color, shininess, place, shape)) in things.into_iter().enumerate() {
        text.separator(|t| {
            if i == 1 {
                t.lamp("PointLight", DVec3::new(0.0, 1.0, 2.0), "intensity 0.3");
            }
            t.raw(&format!(
                "Material {{ diffuseColor {color} ambientColor 0.3 0.2 0.2 \
                 specularColor 0.5 0.6 0.5 emissiveColor 0.02 0 0.03 shininess {shininess} }}"
            ));
            t.translation(place);
            t.raw(shape);
        });
    }
    ShadowScene {
        name: "lights of all kinds",
        text: text.finish(),
        cameras: vec![
            ("over", over()),
            (
                "low",
                perspective(DVec3::new(-2.0, 0.9, 4.0), DVec3::new(0.0, 0.5, 0.0), 0.4),
            ),
        ],
    }
}

/// Spot lights that fade from an inner cone to nothing; where they do, no mask can tell light from
/// shadow.
pub fn beams() -> ShadowScene {
    let mut text = Text::new();
    for (hints, place) in [
        (
            "beamWidthAngle 0.3 LightSource.concentrationExponent 1.8",
            -0.6,
        ),
        ("beamWidthAngle 0.5", 0.8),
    ] {
        text.raw(&format!("Info {{ string \"LightSource.{hints}\" }}"));
        let beam = "direction 0.1 -1 0.2 cutOffAngle 0.5 dropOffRate 0.3 color 0.7 0.3 0.7";
        text.lamp("SpotLight", DVec3::new(place, 3.1, 0.4), beam);
    }
    text.floor(0.0, 4.0);
    text.colored(
        [0.8, 0.7, 0.3],
        &Mesh::cuboid([-0.4, 0.2, -0.4], [0.4, 1.0, 0.4]),
    );
    ShadowScene {
        name: "beams",
        text: text.finish(),
        cameras: vec![
            ("over", over()),
            (
                "low",
                perspective(DVec3::new(-2.0, 0.9, 4.0), DVec3::new(0.0, 0.5, 0.0), 0.4),
            ),
        ],
    }
}

/// How a texture meets the surface, with the name of the scene.
const MODELS: [(&str, &str); 4] = [
    ("MODULATE", "textures modulate"),
    ("DECAL", "textures decal"),
    ("BLEND", "textures blend"),
    ("REPLACE", "textures replace"),
];

/// A scene for each texture model: images of 1 to 4 components, magnified, wrapped and clamped.
pub fn textures() -> [ShadowScene; 4] {
    MODELS.map(|(model, name)| {
        let mut text = Text::new();
        text.sun([0.0, 0.0, -1.0], 1.0);
        text.color([0.9, 0.7, 0.5]);
        // Behind all, so that alpha shows.
        text.colored(
            [0.2, 0.4, 0.3],
            &Mesh::quad([-2.0, -1.5, -0.5], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]),
        );
        text.raw("TextureCoordinate2 { point [ -0.3 -0.2, 1.6 -0.2, 1.6 1.3, -0.3 1.3 ] }");
        for components in 1..=4 {
            text.separator(|t| {
                let wrap = if components % 2 == 0 {
                    "CLAMP"
                } else {
                    "REPEAT"
                };
                t.raw(&format!(
                    "Texture2 {{ model {model} blendColor 0.2 0.3 0.9 wrapS {wrap} wrapT REPEAT"
                ));
                image(t, components);
                t.raw("}");
                let [x, y] = [(components - 1) % 2, (components - 1) / 2].map(|i| 1.7 * i as f64);
                t.mesh(&Mesh::quad(
                    [x - 1.65, y - 1.65, 0.0],
                    [1.6, 0.0, 0.0],
                    [0.0, 1.6, 0.0],
                ));
            });
        }
        ShadowScene {
            name,
            text: text.finish(),
            cameras: vec![("front", facing(5.0, 0.4))],
        }
    })
}

/// An image of 4 by 3 pixels, no two alike.
fn image(text: &mut Text, components: usize) {
    text.raw(&format!("image 4 3 {components}"));
    for pixel in 0..12_usize {
        let digits: String = (0..components)
            .map(|i| format!("{:02x}", (37 + 71 * pixel + 97 * i + 13 * pixel * i) % 256))
            .collect();
        text.raw(&format!("0x{digits}"));
    }
}

/// Glass before, behind and around opaque things, with a lamp: glass casts no shadow.
pub fn panes() -> ShadowScene {
    let mut text = Text::new();
    text.point_light([1.0, 4.0, 2.0]);
    text.raw("Info { string \"LightSource.beamWidthAngle 0.2\" }");
    let beam = "direction -0.1 -0.4 -1 cutOffAngle 0.4 intensity 0.5";
    text.lamp("SpotLight", DVec3::new(0.2, 2.0, 4.0), beam);
    text.floor(0.0, 4.0);
    text.colored(
        [0.8, 0.3, 0.3],
        &Mesh::cuboid([-0.4, 0.2, -0.4], [0.4, 1.0, 0.4]),
    );
    let colors = ["0.2 0.4 0.9", "0.3 0.9 0.4", "0.9 0.8 0.2"];
    for (i, color) in colors.into_iter().enumerate() {
        text.separator(|t| {
            let transparency = 0.3 + 0.2 * i as f64;
            t.raw(&format!(
                "Material {{ diffuseColor {color} transparency {transparency} }}"
            ));
            let z = i as f64 - 1.0;
            t.mesh(&Mesh::quad(
                [z - 1.3, 0.1, z],
                [2.0, 0.0, 0.1],
                [0.0, 1.6, 0.2],
            ));
        });
    }
    text.separator(|t| {
        t.raw("Material { diffuseColor 0.9 0.9 0.9 transparency 0.7 }");
        t.mesh(&Mesh::cuboid([-0.6, 0.1, -0.6], [0.6, 1.2, 0.6]));
    });
    text.separator(|t| {
        t.raw("Material { diffuseColor [ 1 0 0, 0 1 0, 0 0 1, 1 1 1 ] transparency [ 0, 0.3, 0.6, 1 ] }");
        t.raw("MaterialBinding { value PER_VERTEX }");
        t.mesh(&Mesh::quad([1.2, 0.2, 1.5], [1.0, 0.0, -0.6], [0.0, 1.2, 0.0]));
    });
    ShadowScene {
        name: "transparent panes",
        text: text.finish(),
        cameras: vec![
            ("over", over()),
            (
                "through",
                perspective(DVec3::new(-0.6, 0.9, 5.0), DVec3::new(0.0, 0.7, 0.0), 0.35),
            ),
        ],
    }
}

/// A scene for each kind of fog; the last one's visibility is the scene's size.
pub fn fogs() -> [ShadowScene; 4] {
    [
        ("HAZE", 9.0, "haze"),
        ("FOG", 15.0, "fog"),
        ("SMOKE", 12.0, "smoke"),
        ("HAZE", 0.0, "haze to the end of the scene"),
    ]
    .map(|(kind, visibility, name)| {
        let mut text = Text::new();
        text.raw(&format!(
            "Environment {{ fogType {kind} fogColor 0.6 0.7 0.8 fogVisibility {visibility} }}"
        ));
        text.sun([0.4, -1.0, -0.3], 1.0);
        text.floor(0.0, 6.0);
        for z in [-4.0, -2.0, 0.0, 2.0, 4.0] {
            let post = Mesh::cuboid([z / 3.0 - 0.3, 0.0, z], [z / 3.0 + 0.3, 1.2, z + 0.3]);
            text.colored([0.9, 0.4, 0.2], &post);
        }
        ShadowScene {
            name,
            text: text.finish(),
            cameras: vec![(
                "along",
                perspective(DVec3::new(0.3, 1.5, 7.0), DVec3::Y, 0.4),
            )],
        }
    })
}

/// Colours for each vertex, lit and unlit, and seen from behind.
pub fn vertex_colors() -> ShadowScene {
    let mut text = Text::new();
    text.sun([0.3, -0.5, -1.0], 1.0);
    text.raw("Material { diffuseColor [ 1 0 0, 0 1 0, 0 0 1, 1 1 0 ] }");
    text.raw("MaterialBinding { value PER_VERTEX_INDEXED }");
    let quad = |x: f64| Mesh::quad([x, -0.6, 0.0], [1.2, 0.0, 0.2], [0.1, 1.2, 0.0]);
    text.mesh(&quad(-1.9));
    text.mesh(&quad(-0.6).reversed());
    text.raw("LightModel { model BASE_COLOR }");
    text.mesh(&quad(0.7));
    ShadowScene {
        name: "vertex colours",
        text: text.finish(),
        cameras: vec![("front", facing(5.0, 0.4))],
    }
}
