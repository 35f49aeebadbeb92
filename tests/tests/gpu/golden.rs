//! Pictures that were looked at once and must stay: one idea each. What they show is said beside
//! each scene; that it is right is for eyes, and for the tests that trace rays.
//!
//! `UPDATE_GOLDEN=1` writes them anew; look at them then.

use std::fs::File;
use std::path::{Path, PathBuf};

use glam::DVec3;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{DynamicImage, RgbaImage};
use tests::reference::{RefCamera, RefLens};
use tests::shadow_scenes::scene_of;
use viewer::compare::{Tolerance, compare, strip};
use viewer::frame::Settings;

use super::device::Stage;

const SIZE: [u32; 2] = [160, 120];
/// What a picture may take in the repository, bytes.
const MOST_BYTES: u64 = 8 << 10;

const FLOOR: &str = "Separator { Material { diffuseColor 0.7 0.7 0.6 }
  Coordinate3 { point [ -3 0 3, 3 0 3, 3 0 -3, -3 0 -3 ] }
  IndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1 ] } }
";
const CUBE: &str = "Separator { Material { diffuseColor 0.9 0.3 0.2 }
  Translation { translation 0 0.6 0 } Cube { width 1 height 1 depth 1 } }
";

/// A scene, where it is seen from and looked at, and samples a pixel.
struct Golden {
    name: &'static str,
    body: String,
    eye: [f64; 3],
    target: [f64; 3],
    samples: u32,
}

impl Golden {
    fn new(name: &'static str, body: String, eye: [f64; 3], target: [f64; 3]) -> Self {
        Self {
            name,
            body,
            eye,
            target,
            samples: 1,
        }
    }

    fn draw(&self) -> RgbaImage {
        let text = format!("#Inventor V2.1 ascii\n{}", self.body);
        let lens = RefLens::Perspective {
            tan_half_height: 0.4,
        };
        let [eye, target] = [self.eye, self.target].map(DVec3::from);
        let camera = RefCamera::look_at(eye, target, DVec3::Y, lens);
        let settings = Settings {
            samples: self.samples,
            background_srgb: [[0.15, 0.2, 0.3]; 2],
            ..Settings::default()
        };
        let shot = Stage::new(scene_of(&text)).shoot(&camera, SIZE, &settings);
        RgbaImage::from_raw(SIZE[0], SIZE[1], shot.rgba).expect("a picture of this size")
    }

    fn file(&self) -> PathBuf {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden");
        folder.join(format!("{}.png", self.name))
    }

    /// Compares with the file, or writes it.
    fn check(&self) {
        let drawn = self.draw();
        let file = self.file();
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            let out = File::create(&file).expect("the golden folder can be written");
            // Everything is opaque; a file without alpha is read back with it.
            let opaque = DynamicImage::from(drawn.clone()).into_rgb8();
            let (best, adaptive) = (CompressionType::Best, FilterType::Adaptive);
            opaque
                .write_with_encoder(PngEncoder::new_with_quality(out, best, adaptive))
                .expect("the golden folder can be written");
        }
        let bytes = std::fs::metadata(&file).map_or(u64::MAX, |about| about.len());
        assert!(
            bytes <= MOST_BYTES,
            "{}: {bytes} bytes, or no such file",
            self.name
        );
        let golden = image::open(&file).expect("a PNG").into_rgba8();
        let tolerance = Tolerance::default();
        let difference = compare(&golden, &drawn, tolerance.step).expect("equal sizes");
        println!("{}: {difference}", self.name);
        if !difference.is_within(&tolerance) {
            let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("golden");
            std::fs::create_dir_all(&folder).expect("target can be written");
            let shown = folder.join(format!("{}.png", self.name));
            let strip = strip(&golden, &drawn).expect("equal sizes");
            strip
                .expect("small")
                .save(&shown)
                .expect("target can be written");
            panic!("{}: {difference}; look at {}", self.name, shown.display());
        }
    }
}

/// A floor with the shadow of a cube that hovers a little above it, away from a lamp at the upper
/// left; the cube's faces are of different brightness.
fn shadow() -> Golden {
    let lamp = "PointLight { location -1.5 3 1 }\n";
    let body = [lamp, FLOOR, CUBE].concat();
    Golden::new("shadow", body, [2.0, 3.5, 5.0], [0.3, 0.2, 0.0])
}

/// A cube's shadow in a floor that is brightest in the middle of a cone of light, darker outwards
/// and dark beyond it.
fn spot() -> Golden {
    let lamp = "Environment { ambientIntensity 0.4 }
        SpotLight { location -1 4 1 direction 0.25 -1 -0.25 cutOffAngle 0.5 dropOffRate 0.08 }\n";
    let body = [lamp, FLOOR, CUBE].concat();
    Golden::new("spot", body, [2.0, 3.5, 5.0], [0.0, 0.2, 0.0])
}

/// Four squares with one picture: shaded and tinted, pasted, blended with blue, and as it is.
fn texture_models() -> Golden {
    let mut body = "DirectionalLight { direction 0 -0.6 -0.8 }
        Material { diffuseColor 1 0.8 0.5 }
        TextureCoordinate2 { point [ 0 0, 1 0, 1 1, 0 1 ] }\n"
        .to_owned();
    // Black, grey, white and colours; DECAL shows the square where alpha is small.
    let rgba = "image 3 2 4 0x000000ff 0x808080ff 0xffffffff 0xff0000ff 0x00ff0080 0xffff0010";
    // BLEND takes brightness alone.
    let grey = "image 3 2 1 0x00 0x80 0xff 0x40 0xc0 0xa0";
    let opaque = "image 3 2 3 0x000000 0x808080 0xffffff 0xff0000 0x00ff00 0xffff00";
    let rows = [
        ("MODULATE", opaque, -1.4),
        ("DECAL", rgba, -0.45),
        ("BLEND blendColor 0 0 1", grey, 0.5),
        ("REPLACE", opaque, 1.45),
    ];
    for (model, image, x) in rows {
        let (left, right) = (x - 0.47, x + 0.42);
        body.push_str(&format!(
            "Separator {{ Texture2 {{ model {model} {image} }}
             Coordinate3 {{ point [ {left} -0.6 0, {right} -0.6 0, {right} 0.6 0, {left} 0.6 0 ] }}
             IndexedFaceSet {{ coordIndex [ 0, 1, 2, 3, -1 ] }} }}\n"
        ));
    }
    Golden::new("texture-models", body, [0.0, 0.0, 4.6], [0.0, 0.0, 0.0])
}

/// Two coloured panes before a cube and its shadow, which shows through both; they throw none.
fn panes() -> Golden {
    let mut body = ["PointLight { location -1.5 3 1 }\n", FLOOR, CUBE].concat();
    for (color, x, z) in [("0.2 0.5 1", -1.0, 1.2), ("0.3 1 0.3", 0.2, 1.6)] {
        let right = x + 1.8;
        body.push_str(&format!(
            "Separator {{ Material {{ diffuseColor {color} transparency 0.6 }}
             Coordinate3 {{ point [ {x} 0.1 {z}, {right} 0.1 {z}, {right} 1.5 {z}, {x} 1.5 {z} ] }}
             IndexedFaceSet {{ coordIndex [ 0, 1, 2, 3, -1 ] }} }}\n"
        ));
    }
    Golden::new("panes", body, [1.0, 3.0, 5.5], [0.3, 0.3, 0.0])
}

/// Rows of lines and points that go into haze: those near are plain in colour, those far take the
/// haze's; from left to right lines one to seven pixels wide, and points two to eight.
fn strokes() -> Golden {
    let mut body = "Environment { fogType HAZE fogColor 0.6 0.7 0.8 fogVisibility 12 }
        LightModel { model BASE_COLOR }\n"
        .to_owned();
    for (i, width) in [1, 3, 5, 7].into_iter().enumerate() {
        let x = 0.5 * i as f64 - 1.8;
        body.push_str(&format!(
            "Separator {{ DrawStyle {{ lineWidth {width} }} Material {{ diffuseColor 1 0.2 0 }}
             Coordinate3 {{ point [ {x} 0 2, {x} 0 -8 ] }} LineSet {{ }} }}\n"
        ));
    }
    for (i, size) in [2, 4, 6, 8].into_iter().enumerate() {
        let x = 0.5 * i as f64 + 0.3;
        let points: String = (0..6)
            .map(|row| format!("{x} 0 {}, ", 2 - 2 * row))
            .collect();
        body.push_str(&format!(
            "Separator {{ DrawStyle {{ pointSize {size} }} Material {{ diffuseColor 0 0.4 0 }}
             Coordinate3 {{ point [ {points} ] }} PointSet {{ }} }}\n"
        ));
    }
    Golden::new("strokes", body, [0.0, 2.5, 6.0], [0.0, 0.0, 0.0])
}

/// The cube's shadow again with four samples a pixel: its edges, and the shadow's, have steps
/// between the two colours.
fn samples() -> Golden {
    Golden {
        name: "samples",
        samples: 4,
        ..shadow()
    }
}

#[test]
fn hard_shadow() {
    shadow().check();
}

#[test]
fn spot_with_drop_off() {
    spot().check();
}

#[test]
fn four_texture_models() {
    texture_models().check();
}

#[test]
fn panes_before_a_shadow() {
    panes().check();
}

#[test]
fn lines_and_points_in_haze() {
    strokes().check();
}

#[test]
fn four_samples() {
    samples().check();
}
