//! What the options make of frames, looks, images and containers; and all of it read back.

use std::fs;
use std::path::Path;

use convert::{
    Container, Lights, Materials, Options, Quantize, ReadLimits, TextureFormat, Up, read_gltf,
    write_file,
};
use glam::{DAffine3, DVec3};
use scenegraph::scene::{
    Environment, LightKind, Material, Mesh, Projection, Scene, Texture, TextureModel,
};
use serde_json::{Value, json};

use crate::decode::corners;
use crate::read::convert_with;
use crate::reading::OneFile;
use crate::scenes::{
    Build, Images, file_texture, lines, material, png, points, shift, textured_triangle, triangle,
    turn,
};

fn with(options: impl FnOnce(&mut Options)) -> Options {
    let mut chosen = Options::default();
    options(&mut chosen);
    chosen
}

fn images() -> Images {
    let noise = |i: u32| [(i * 97 % 251) as u8, (i * 31 % 241) as u8, 9, 255];
    let plain = png(&[[9, 9, 9, 255]; 400]);
    let noisy: Vec<[u8; 4]> = (0..400).map(noise).collect();
    let mut jpeg = std::io::Cursor::new(Vec::new());
    let pixels = image::RgbImage::from_fn(8, 8, |x, y| image::Rgb([x as u8 * 30, y as u8 * 30, 0]));
    pixels
        .write_to(&mut jpeg, image::ImageFormat::Jpeg)
        .unwrap();
    Images::with(&[
        ("plain.png", plain),
        ("noisy.png", png(&noisy)),
        ("b.jpg", jpeg.into_inner()),
    ])
}

fn textured(name: &str) -> Build {
    Build::textured(file_texture(name), material())
}

fn places(scene: &Scene, options: &Options) -> Vec<DVec3> {
    let got = corners(&convert_with(scene, options, &Images::default()));
    got.into_iter().flatten().map(|c| c.p_in_world).collect()
}

#[test]
fn the_model_is_turned_upright_and_measured_in_metres() {
    let mut build = Build::new();
    let far = shift(2_600_000.0, 1_200_000.0, 400.0);
    let group = build.group(None, Some("House"), far * turn(DVec3::ONE, 0.5));
    build.shape(Some(group), None, shift(1.0, 2.0, 3.0));
    build.shape(None, Some("Door"), shift(-1.0, 0.0, 0.0));
    let plain = places(&build.scene, &Options::default());
    for (up, metres_per_unit) in [(Up::Z, 1.0), (Up::Y, 1e-3), (Up::Z, 0.0254)] {
        let options = with(|o| {
            o.up = up;
            o.metres_per_unit = metres_per_unit;
        });
        let got = places(&build.scene, &options);
        for (p, q) in plain.iter().zip(got) {
            let want = match up {
                Up::Y => *p,
                Up::Z => DVec3::new(p.x, p.z, -p.y),
            } * metres_per_unit;
            assert!(
                (want - q).length() <= 1e-15 * 8.0 * want.length(),
                "{want} {q}"
            );
        }
    }
}

#[test]
fn what_is_measured_in_the_world_gets_its_unit() {
    let mut build = Build::one(triangle(), material());
    build.scene.environments[0] = Environment {
        attenuation: [0.5, 0.25, 1.0],
        ..Environment::default()
    };
    let location = DVec3::new(0.0, 0.0, 10.0);
    build.light(None, DAffine3::IDENTITY, LightKind::Point { location });
    build.camera(
        None,
        DAffine3::IDENTITY,
        Projection::Orthographic { height: 4.0 },
    );
    let value = |options: &Options, pointer: &str| {
        let got = convert_with(&build.scene, options, &Images::default());
        got.at(pointer).as_f64().unwrap()
    };
    let scaled = with(|o| o.metres_per_unit = 0.01);
    // Candela go with the square of the unit, lengths with the unit itself.
    for (pointer, factor) in [
        ("/extensions/KHR_lights_punctual/lights/0/intensity", 1e-4),
        ("/cameras/0/orthographic/ymag", 1e-2),
        ("/cameras/0/orthographic/zfar", 1e-2),
    ] {
        let (plain, got) = (value(&Options::default(), pointer), value(&scaled, pointer));
        assert!(
            (got / plain / factor - 1.0).abs() < 1e-6,
            "{pointer}: {plain} {got}"
        );
    }
}

#[test]
fn a_model_turned_upright_says_so() {
    let build = Build::one(triangle(), material());
    for (up, want) in [(Up::Y, true), (Up::Z, false)] {
        let got = convert_with(&build.scene, &with(|o| o.up = up), &Images::default());
        let model = read(&got.bytes);
        assert_eq!(model.is_from_inventor, want);
    }
}

#[test]
fn looks_of_a_shiny_material() {
    let shiny = Material {
        diffuse_srgb: [1.0, 0.0, 0.0],
        emissive_srgb: [0.0, 1.0, 0.0],
        specular_srgb: [0.5; 3],
        ..material()
    };
    let build = Build::one(triangle(), shiny);
    let rows = [
        (
            Materials::Fidelity,
            vec!["KHR_materials_ior", "KHR_materials_specular"],
            true,
            None,
        ),
        (Materials::Simple, vec![], true, Some(json!([1, 0, 0, 1]))),
        (
            Materials::Unlit,
            vec!["KHR_materials_unlit"],
            false,
            Some(json!([1, 1, 0, 1])),
        ),
    ];
    for (materials, extensions, normals, color) in rows {
        let got = convert_with(
            &build.scene,
            &with(|o| o.materials = materials),
            &Images::default(),
        );
        let used = got.json.get("extensionsUsed").cloned().unwrap_or(json!([]));
        assert_eq!(used, json!(extensions), "{materials:?}");
        let of_material = got.at("/materials/0/extensions").as_object();
        let names: Vec<_> = of_material.map_or(Vec::new(), |e| e.keys().cloned().collect());
        assert_eq!(names, extensions);
        assert_eq!(
            got.at("/meshes/0/primitives/0/attributes")
                .get("NORMAL")
                .is_some(),
            normals
        );
        if let Some(color) = color {
            assert_eq!(
                *got.at("/materials/0/pbrMetallicRoughness/baseColorFactor"),
                color
            );
        }
    }
}

#[test]
fn physical_lights_are_683_times_as_strong() {
    let mut build = Build::one(triangle(), material());
    let direction = DVec3::NEG_Z;
    build.light(
        None,
        DAffine3::IDENTITY,
        LightKind::Directional { direction },
    );
    let intensity = |lights| {
        let got = convert_with(
            &build.scene,
            &with(|o| o.lights = lights),
            &Images::default(),
        );
        let light = got.at("/extensions/KHR_lights_punctual/lights/0/intensity");
        light.as_f64().unwrap()
    };
    let ratio = intensity(Lights::Physical) / intensity(Lights::Unitless);
    assert!((ratio - 683.0).abs() < 1e-4, "{ratio}");
}

#[test]
fn images_take_the_format_asked_for() {
    use TextureFormat::{Keep, Png, Webp};
    for (file, format, want) in [
        ("plain.png", Keep, "image/png"),
        ("b.jpg", Keep, "image/jpeg"),
        ("b.jpg", Png, "image/png"),
        ("plain.png", Webp, "image/webp"),
        // So few pixels that the tables of a JPEG file weigh more than they do.
        ("b.jpg", Webp, "image/webp"),
    ] {
        let got = convert_with(
            &textured(file).scene,
            &with(|o| o.textures = format),
            &images(),
        );
        assert_eq!(got.at("/images/0/mimeType"), want, "{file} {format:?}");
        let texture = got.at("/textures/0");
        let extension = texture.pointer("/extensions/EXT_texture_webp/source");
        assert_eq!(extension.is_some(), want == "image/webp");
        assert_eq!(texture.get("source").is_some(), want != "image/webp");
        let required = got.json.get("extensionsRequired");
        assert_eq!(
            required == Some(&json!(["EXT_texture_webp"])),
            want == "image/webp"
        );
        // The same pixels, found by our own reader.
        let view =
            &got.json["bufferViews"][got.at("/images/0/bufferView").as_u64().unwrap() as usize];
        let start = view["byteOffset"].as_u64().unwrap_or(0) as usize;
        let stored = &got.bin[start..start + view["byteLength"].as_u64().unwrap() as usize];
        let source = convert::TextureLoader::load(&images(), Path::new(""), file).unwrap();
        let pixels = |bytes: &[u8]| image::load_from_memory(bytes).unwrap().into_rgba8();
        assert!(pixels(stored) == pixels(&source), "{file}");
        let model = read(&got.bytes);
        assert_eq!(model.warnings, Vec::<String>::new());
        assert_eq!(model.scene.textures.len(), 1);
    }
}

fn read(bytes: &[u8]) -> convert::Model {
    let loader = OneFile(Vec::new());
    let limits = ReadLimits::default();
    let model = read_gltf(bytes, "m.glb", Path::new("folder"), &loader, &limits).unwrap();
    assert_eq!(model.scene.check(), []);
    model
}

/// Triangles, lines and points, with all attributes.
fn all_kinds() -> Build {
    let texture = Texture {
        model: TextureModel::Modulate,
        ..file_texture("plain.png")
    };
    let mut build = Build::textured(texture, material());
    let many = |size: u32| {
        let at = |i: u32| {
            (0..size).map(move |j| [i as f32 * 0.01, j as f32 * 0.01, (i * j) as f32 * 1e-4])
        };
        let quads = (0..size - 1).flat_map(move |i| (0..size - 1).map(move |j| i * size + j));
        Mesh {
            positions: (0..size).flat_map(at).collect(),
            normals: vec![[0.0, 0.6, 0.8]; (size * size) as usize],
            colors_srgb: (0..size * size)
                .map(|i| [i as f32 / 400.0, 0.5, 1.0, 1.0])
                .collect(),
            indices: quads
                .flat_map(|a| [a, a + 1, a + size, a + size, a + 1, a + size + 1])
                .collect(),
            ..triangle()
        }
    };
    build.instance(None, None, turn(DVec3::X, 1.0), many(20), material());
    build.instance(None, None, shift(1e5, 0.0, 0.0), many(7), material());
    build.instance(None, None, DAffine3::IDENTITY, lines(), material());
    build.instance(None, None, DAffine3::IDENTITY, points(), material());
    build.instance(
        None,
        None,
        DAffine3::IDENTITY,
        textured_triangle(),
        material(),
    );
    build
}

fn source_places(scene: &Scene) -> Vec<DVec3> {
    let mut places = Vec::new();
    for instance in &scene.instances {
        let mesh = &scene.meshes[instance.mesh.index()];
        let at = &instance.placement.world_from_local;
        places.extend(
            mesh.indices
                .iter()
                .map(|&i| at.transform_point3(mesh.p_in_local(i))),
        );
    }
    places
}

/// How far the corners of one scene are from those of another, in any order of triangles.
fn distance(a: &[DVec3], b: &[DVec3]) -> f64 {
    let nearest = |p: &DVec3| {
        b.iter()
            .map(|q| q.distance(*p))
            .fold(f64::INFINITY, f64::min)
    };
    a.iter().map(nearest).fold(0.0, f64::max)
}

#[test]
fn compressed_and_quantized_models_are_read_back() {
    let build = all_kinds();
    let want = source_places(&build.scene);
    for (tolerance, compress) in [
        (None, true),
        (Some(1e-3), false),
        (Some(1e-3), true),
        (Some(1e-5), true),
    ] {
        let options = with(|o| {
            o.quantize = tolerance.map(Quantize::within);
            o.compress = compress;
        });
        let got = convert_with(&build.scene, &options, &images());
        let required = got.json["extensionsRequired"].as_array().unwrap();
        assert_eq!(
            required.contains(&json!("EXT_meshopt_compression")),
            compress
        );
        let model = read(&got.bytes);
        let got = source_places(&model.scene);
        assert_eq!(want.len(), got.len());
        // Numbers as large as the places have steps of their own.
        let bound = tolerance.unwrap_or(0.0) + 1e-10;
        let worst = distance(&want, &got).max(distance(&got, &want));
        assert!(worst <= bound, "{tolerance:?} {compress}: {worst}");
        for (mesh, source) in model.scene.meshes.iter().zip(&build.scene.meshes) {
            assert_eq!(mesh.topology, source.topology);
        }
        let normals = model
            .scene
            .meshes
            .iter()
            .find(|m| m.positions.len() == 400)
            .unwrap();
        for n in &normals.normals {
            let n = DVec3::from(n.map(f64::from));
            let angle = n.distance(DVec3::new(0.0, 0.6, 0.8)).to_degrees();
            assert!(
                angle <= if tolerance.is_some() { 0.5 } else { 1e-5 },
                "{angle}"
            );
        }
    }
}

#[test]
fn broken_compressed_bytes_are_an_error() {
    let options = with(|o| o.compress = true);
    let got = convert_with(&all_kinds().scene, &options, &images());
    let start = got.bytes.len() - got.bin.len();
    let mut refused = 0;
    for at in (start..got.bytes.len()).step_by(7) {
        let mut bytes = got.bytes.clone();
        bytes[at] ^= 0x55;
        let limits = ReadLimits::default();
        let loader = OneFile(Vec::new());
        // Any bytes are numbers or an error.
        refused += usize::from(read_gltf(&bytes, "m", Path::new(""), &loader, &limits).is_err());
    }
    assert!(refused > 0);
}

#[test]
fn embedded_text_holds_all() {
    let folder = tempfile::tempdir().unwrap();
    let build = all_kinds();
    let path = folder.path().join("m.gltf");
    let options = with(|o| o.container = Container::GltfEmbedded);
    let report = write_file(&build.scene, &options, &images(), &path).unwrap();
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    let bytes = fs::read(&path).unwrap();
    assert_eq!(report.counts.bytes, bytes.len() as u64);
    let mut text: Value = serde_json::from_slice(&bytes).unwrap();
    let glb = convert_with(&build.scene, &Options::default(), &images());
    let uri = text["buffers"][0]
        .as_object_mut()
        .unwrap()
        .remove("uri")
        .unwrap();
    assert!(
        uri.as_str()
            .unwrap()
            .starts_with("data:application/octet-stream;base64,")
    );
    assert_eq!(text, glb.json);
    let (embedded, binary) = (read(&bytes), read(&glb.bytes));
    assert_eq!(source_places(&embedded.scene), source_places(&binary.scene));
}

#[test]
fn a_page_holds_the_model_and_no_address() {
    let folder = tempfile::tempdir().unwrap();
    let build = all_kinds();
    let path = folder.path().join("a <b>.html");
    let options = with(|o| o.container = Container::Html);
    let report = write_file(&build.scene, &options, &images(), &path).unwrap();
    let page = fs::read_to_string(&path).unwrap();
    assert_eq!(report.counts.bytes, page.len() as u64);
    assert!(page.contains("<title>a &lt;b&gt;</title>"));
    for loads in ["src=\"", "href=\"", "@import"] {
        assert!(!page[..2000].contains(loads), "{loads}");
    }
    let start = page.find("octet-stream\">").unwrap() + 14;
    let text = &page[start..start + page[start..].find('<').unwrap()];
    let glb = convert_with(&build.scene, &Options::default(), &images());
    assert_eq!(text.len(), glb.bytes.len().div_ceil(3) * 4);
    assert!(text.starts_with("Z2xURg"), "glTF in base64");
}
