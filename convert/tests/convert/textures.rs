//! Images, samplers and texture models.

use std::io::Cursor;
use std::sync::Arc;

use convert::{LossKind, Options};
use glam::DAffine3;
use scenegraph::scene::{
    Image, LightModel, Material, Texture, TextureId, TextureModel, TextureSource, Wrap,
};
use serde_json::{Value, json};

use crate::read::{Converted, convert_with};
use crate::scenes::{
    Build, Images, at_line, file_texture, lines, material, png, textured_triangle, triangle,
};

const OPAQUE: [u8; 4] = [200, 100, 50, 255];
const HOLE: [u8; 4] = [0, 0, 0, 0];
const MIST: [u8; 4] = [10, 10, 10, 128];

fn with(build: &Build, images: &Images) -> Converted {
    convert_with(&build.scene, &Options::default(), images)
}

/// Bytes of image `index`.
fn image(converted: &Converted, index: usize) -> &[u8] {
    let view = converted.at(&format!("/images/{index}/bufferView"));
    let view = converted.at(&format!("/bufferViews/{view}"));
    let start = view["byteOffset"].as_u64().unwrap_or(0) as usize;
    &converted.bin[start..start + view["byteLength"].as_u64().unwrap() as usize]
}

fn jpeg() -> Vec<u8> {
    let mut out = Cursor::new(Vec::new());
    let pixels = image::RgbImage::new(2, 2);
    pixels.write_to(&mut out, image::ImageFormat::Jpeg).unwrap();
    out.into_inner()
}

#[test]
fn files_pass_through_byte_for_byte() {
    for (bytes, mime) in [(png(&[OPAQUE]), "image/png"), (jpeg(), "image/jpeg")] {
        let build = Build::textured(file_texture("dir\\a.rgb"), material());
        let images = Images::with(&[("dir\\a.rgb", bytes.clone())]);
        let converted = with(&build, &images);
        assert!(image(&converted, 0) == bytes);
        assert_eq!(converted.at("/images/0/mimeType"), mime);
        assert_eq!(converted.at("/images/0/name"), "a.rgb");
        assert_eq!(converted.at("/textures/0/extras/iv/filename"), "dir\\a.rgb");
        assert_eq!(*images.asked.lock().unwrap(), ["folder/dir\\a.rgb"]);

        let in_memory = Texture {
            source: TextureSource::Encoded {
                bytes: bytes.into(),
                name: Some("dir\\a.rgb".into()),
            },
            ..file_texture("")
        };
        let build = Build::textured(in_memory, material());
        let again = with(&build, &Images::default());
        assert!(again.bytes == converted.bytes);
    }
}

#[test]
fn the_same_pixels_are_stored_once() {
    let inline = Arc::new(Image {
        width: 1,
        height: 1,
        components: 3,
        bytes: vec![1, 2, 3],
    });
    let from_pixels = |image: Arc<Image>| Texture {
        source: TextureSource::Inline(image),
        ..file_texture("")
    };
    let mut build = Build::new();
    let textures = [
        file_texture("a.png"),
        Texture {
            wrap_s: Wrap::Clamp,
            ..file_texture("a.png")
        },
        file_texture("copy.png"),
        from_pixels(inline.clone()),
        Texture {
            wrap_t: Wrap::Clamp,
            ..from_pixels(Arc::new((*inline).clone()))
        },
    ];
    for (i, texture) in textures.into_iter().enumerate() {
        let material = Material {
            texture: Some(TextureId(i as u32)),
            ..material()
        };
        build.instance(
            None,
            None,
            DAffine3::IDENTITY,
            textured_triangle(),
            material,
        );
        build.scene.textures.push(texture);
    }
    let bytes = png(&[OPAQUE]);
    let images = Images::with(&[("a.png", bytes.clone()), ("copy.png", bytes)]);
    let converted = with(&build, &images);
    let sources: Vec<_> = (converted.json["textures"].as_array().unwrap().iter())
        .map(|t| {
            (
                t["source"].as_u64().unwrap(),
                t["sampler"].as_u64().unwrap(),
            )
        })
        .collect();
    assert_eq!(sources, [(0, 0), (0, 1), (0, 0), (1, 0), (1, 2)]);
    assert_eq!(converted.json["images"].as_array().unwrap().len(), 2);
    assert_eq!(
        *images.asked.lock().unwrap(),
        ["folder/a.png", "folder/copy.png"]
    );
    let linear = |wraps: Value| {
        let mut sampler = json!({"magFilter": 9729, "minFilter": 9987});
        sampler
            .as_object_mut()
            .unwrap()
            .extend(wraps.as_object().unwrap().clone());
        sampler
    };
    let samplers = [json!({}), json!({"wrapS": 33071}), json!({"wrapT": 33071})].map(linear);
    assert_eq!(converted.json["samplers"], json!(samplers));
}

#[test]
fn images_that_nothing_shows_are_not_opened() {
    let textured = Material {
        texture: Some(TextureId(0)),
        ..material()
    };
    let mut build = Build::one(triangle(), textured.clone());
    build.instance(None, None, DAffine3::IDENTITY, lines(), textured);
    build.scene.textures.push(file_texture("a.png"));
    let images = Images::default();
    let converted = with(&build, &images);
    assert!(images.asked.lock().unwrap().is_empty());
    assert_eq!(converted.report.warnings, []);
    assert_eq!(converted.json["images"], Value::Null);
}

#[test]
fn a_missing_image_is_a_warning_and_the_shape_keeps_its_colour() {
    let bad = Texture {
        source: TextureSource::Inline(Arc::new(Image {
            width: 9,
            height: 9,
            components: 3,
            bytes: vec![0],
        })),
        ..file_texture("")
    };
    for (texture, files, name) in [
        (file_texture("gone.png"), vec![], "gone.png"),
        (
            file_texture("text.png"),
            vec![("text.png", b"hello".to_vec())],
            "text.png",
        ),
        (bad, vec![], "inline image"),
    ] {
        let mut build = Build::textured(texture, material());
        // A second texture node of the same file is not asked for again.
        let second = Material {
            texture: Some(TextureId(1)),
            ..material()
        };
        build.instance(None, None, DAffine3::IDENTITY, textured_triangle(), second);
        let twin = Texture {
            pos: at_line(99),
            ..build.scene.textures[0].clone()
        };
        build.scene.textures.push(twin);
        let converted = with(&build, &Images::with(&files));
        let warnings = &converted.report.warnings;
        assert_eq!((&*warnings[0].name, warnings[0].pos), (name, at_line(40)));
        assert!(!warnings[0].reason.is_empty());
        assert_eq!(warnings.len(), if name == "inline image" { 2 } else { 1 });
        assert_eq!(
            converted.at("/materials/0/pbrMetallicRoughness/baseColorTexture"),
            &Value::Null
        );
        assert_eq!(
            converted.at("/meshes/0/primitives/0/attributes/TEXCOORD_0"),
            &Value::Null
        );
    }
}

#[test]
fn texture_models_choose_factor_light_and_alpha() {
    use TextureModel::{Blend, Decal, Modulate, Replace};
    let solid = [OPAQUE, OPAQUE];
    let rows = [
        // model, pixels, transparency; unlit, base colour, alpha, alphaMode, loss
        (Modulate, solid, 0.0, false, 0.214, 1.0, None, false),
        (
            Modulate,
            solid,
            0.5,
            false,
            0.214,
            0.5,
            Some("BLEND"),
            false,
        ),
        (
            Modulate,
            [OPAQUE, HOLE],
            0.0,
            false,
            0.214,
            1.0,
            Some("MASK"),
            false,
        ),
        (
            Modulate,
            [OPAQUE, HOLE],
            0.5,
            false,
            0.214,
            0.5,
            Some("BLEND"),
            false,
        ),
        (
            Modulate,
            [OPAQUE, MIST],
            0.0,
            false,
            0.214,
            1.0,
            Some("BLEND"),
            false,
        ),
        (Replace, solid, 0.0, true, 1.0, 1.0, None, false),
        (Replace, solid, 0.25, true, 1.0, 0.75, Some("BLEND"), false),
        (
            Replace,
            [OPAQUE, HOLE],
            0.25,
            true,
            1.0,
            1.0,
            Some("MASK"),
            false,
        ),
        (Decal, solid, 0.0, true, 1.0, 1.0, None, false),
        (Decal, [OPAQUE, MIST], 0.0, false, 1.0, 1.0, None, true),
        (
            Decal,
            [OPAQUE, MIST],
            0.5,
            false,
            1.0,
            0.5,
            Some("BLEND"),
            true,
        ),
        (Blend, solid, 0.0, false, 1.0, 1.0, None, true),
        (
            Blend,
            [OPAQUE, HOLE],
            0.0,
            false,
            1.0,
            1.0,
            Some("MASK"),
            true,
        ),
    ];
    for (model, pixels, transparency, unlit, base, alpha, mode, lossy) in rows {
        let texture = Texture {
            model,
            blend_color_srgb: [1.0, 0.0, 0.0],
            ..file_texture("a")
        };
        let gray = Material {
            diffuse_srgb: [0.5; 3],
            transparency,
            ..material()
        };
        let build = Build::textured(texture, gray);
        let converted = with(&build, &Images::with(&[("a", png(&pixels))]));
        let got = &converted.json["materials"][0];
        let row = format!("{model:?} {pixels:?} {transparency}: {got}");
        assert_eq!(
            got["extensions"]["KHR_materials_unlit"].is_object(),
            unlit,
            "{row}"
        );
        let factor = &got["pbrMetallicRoughness"]["baseColorFactor"];
        assert!(
            (factor[0].as_f64().unwrap_or(1.0) - base).abs() < 1e-3,
            "{row}"
        );
        assert_eq!(factor[3].as_f64().unwrap_or(1.0), alpha, "{row}");
        assert_eq!(got["alphaMode"].as_str(), mode, "{row}");
        assert_eq!(
            got["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0,
            "{row}"
        );
        let lost = converted
            .report
            .losses
            .iter()
            .any(|l| l.kind == LossKind::TextureModel);
        assert_eq!(lost, lossy, "{row}");
    }
}

#[test]
fn mixed_textures_are_made_for_each_colour() {
    let texture = Texture {
        model: TextureModel::Decal,
        ..file_texture("a")
    };
    let mut build = Build::textured(texture, material());
    for diffuse in [0.0, 1.0, 0.0] {
        let material = Material {
            diffuse_srgb: [diffuse; 3],
            shininess: diffuse,
            texture: Some(TextureId(0)),
            ..material()
        };
        build.instance(
            None,
            None,
            DAffine3::IDENTITY,
            textured_triangle(),
            material,
        );
    }
    let images = Images::with(&[("a", png(&[HOLE]))]);
    let converted = with(&build, &images);
    let pixel = |i: usize| {
        image::load_from_memory(image(&converted, i))
            .unwrap()
            .into_rgb8()
    };
    assert_eq!(converted.json["images"].as_array().unwrap().len(), 3);
    // 0.8 * 255, and the two others.
    assert_eq!(
        [0, 1, 2].map(|i| pixel(i).into_raw()),
        [[204; 3], [0; 3], [255; 3]]
    );
    assert_eq!(images.asked.lock().unwrap().len(), 1);
}

#[test]
fn unlit_textures_show_without_light() {
    let unlit = Material {
        light_model: LightModel::BaseColor,
        ..material()
    };
    let build = Build::textured(file_texture("a"), unlit);
    let converted = with(&build, &Images::with(&[("a", png(&[OPAQUE]))]));
    let got = &converted.json["materials"][0];
    assert_eq!(got["extensions"], json!({"KHR_materials_unlit": {}}));
    assert_eq!(
        got["pbrMetallicRoughness"]["baseColorTexture"],
        json!({"index": 0})
    );
}

#[test]
fn extras_hold_the_texture_as_written() {
    let texture = Texture {
        name: Some("Wood".into()),
        model: TextureModel::Blend,
        blend_color_srgb: [0.5, 0.25, 0.0],
        ..file_texture("wood.png")
    };
    let build = Build::textured(texture, material());
    let converted = with(&build, &Images::with(&[("wood.png", png(&[OPAQUE]))]));
    assert_eq!(
        converted.json["textures"][0],
        json!({
            "name": "Wood",
            "sampler": 0,
            "source": 0,
            "extras": {"iv": {
                "filename": "wood.png",
                "model": "BLEND",
                "blendColor": [0.5, 0.25, 0],
            }},
        })
    );
}
