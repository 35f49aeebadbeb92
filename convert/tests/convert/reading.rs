//! Ordinary glTF, written by hand here, as scenes.

use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use convert::{Model, Options, ReadError, ReadLimits, read_gltf};
use glam::{DAffine3, DVec3};
use scenegraph::scene::{
    Environment, EnvironmentId, Faces, LightKind, LightModel, Mesh, Projection, Scene, Texture,
    TextureModel, TextureSource, Wrap,
};
use scenegraph::{LoadError, Loader};
use serde_json::{Value, json};

use crate::read::{assert_near, convert_with};
use crate::scenes::{Build, Images, file_texture, material, png, scale, shift, triangle, turn};

/// Has one file, `a b.bin`, with these bytes.
pub struct OneFile(pub Vec<u8>);

impl Loader for OneFile {
    fn find(&self, beside: &Path, name: &str) -> Result<PathBuf, LoadError> {
        match (beside.to_str(), name) {
            (Some("folder"), "a b.bin") => Ok(name.into()),
            _ => Err(LoadError::NotFound),
        }
    }

    fn read(&self, _: &Path) -> Result<Vec<u8>, LoadError> {
        Ok(self.0.clone())
    }
}

pub fn glb(text: &Value, bin: &[u8]) -> Vec<u8> {
    let mut text = serde_json::to_vec(text).unwrap();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bin = bin.to_vec();
    bin.resize(bin.len().next_multiple_of(4), 0);
    let mut out = b"glTF".to_vec();
    let total = 28 + text.len() + bin.len();
    for word in [2, total as u32, text.len() as u32] {
        out.extend(word.to_le_bytes());
    }
    out.extend(b"JSON");
    out.extend(&text);
    out.extend((bin.len() as u32).to_le_bytes());
    out.extend(b"BIN\0");
    out.extend(&bin);
    out
}

pub fn read_bytes(bytes: &[u8], file: Vec<u8>) -> Result<Model, ReadError> {
    let folder = Path::new("folder");
    let model = read_gltf(
        bytes,
        "m.glb",
        folder,
        &OneFile(file),
        &ReadLimits::default(),
    );
    if let Ok(model) = &model {
        assert_eq!(model.scene.check(), []);
    }
    model
}

pub fn read(text: &Value, bin: &[u8]) -> Result<Model, ReadError> {
    read_bytes(&glb(text, bin), Vec::new())
}

pub fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// Five vertices and whatever else: accessor 0 are the positions, `more` lies behind them in a
/// view of its own and is read by accessor 1.
pub fn five(more: &[u8], accessor: Value, primitive: Value) -> (Value, Vec<u8>) {
    let mut bin = floats(&[
        0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 2.0, 0.0,
    ]);
    let start = bin.len();
    bin.extend(more);
    let text = json!({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [primitive]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3"},
            accessor,
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": start},
            {"buffer": 0, "byteOffset": start, "byteLength": more.len()},
        ],
        "buffers": [{"byteLength": bin.len()}],
    });
    (text, bin)
}

/// A file with one shape in this material.
fn in_material(material: Value) -> (Value, Vec<u8>) {
    let primitive = json!({"attributes": {"POSITION": 0}, "material": 0});
    let (mut text, bin) = five(
        &[],
        json!({"componentType": 5126, "count": 1, "type": "VEC3"}),
        primitive,
    );
    text["materials"] = json!([material]);
    (text, bin)
}

fn only_mesh(model: &Model) -> &Mesh {
    assert_eq!(model.scene.meshes.len(), 1);
    &model.scene.meshes[0]
}

#[test]
fn every_mode_and_index_type_becomes_a_list() {
    let unlit_lines = [
        (0, vec![3, 0, 4]),
        (1, vec![3, 0]),
        (2, vec![3, 0, 0, 4, 4, 3]),
        (3, vec![3, 0, 0, 4]),
    ];
    for (mode, want) in unlit_lines {
        let primitive = json!({"attributes": {"POSITION": 0}, "indices": 1, "mode": mode});
        let (text, bin) = five(
            &[3, 0, 4],
            json!({"bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR"}),
            primitive,
        );
        let model = read(&text, &bin).unwrap();
        let mesh = only_mesh(&model);
        let x_and_y = |i: u32| (mesh.positions[i as usize][0], mesh.positions[i as usize][1]);
        let points = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (0.0, 2.0)];
        let got: Vec<_> = mesh.indices.iter().map(|&i| x_and_y(i)).collect();
        assert_eq!(
            got,
            want.iter().map(|&i: &usize| points[i]).collect::<Vec<_>>(),
            "mode {mode}"
        );
        assert!(mesh.positions.len() <= 3, "only the vertices in use");
        assert!(mesh.normals.is_empty());
    }
    let triangles = [(4, 3), (5, 9), (6, 9)];
    let indices = [0_u8, 1, 2, 3, 4];
    let wide = |bytes: usize| -> Vec<u8> {
        let le = indices
            .iter()
            .flat_map(|&i| u32::from(i).to_le_bytes()[..bytes].to_vec());
        le.collect()
    };
    for (component, bytes) in [(5121, 1), (5123, 2), (5125, 4)] {
        for (mode, want) in triangles {
            let primitive = json!({"attributes": {"POSITION": 0}, "indices": 1, "mode": mode});
            let accessor =
                json!({"bufferView": 1, "componentType": component, "count": 5, "type": "SCALAR"});
            let (text, bin) = five(&wide(bytes), accessor, primitive);
            let model = read(&text, &bin).unwrap();
            let mesh = only_mesh(&model);
            // Flat normals give each corner a vertex.
            assert_eq!((mesh.indices.len(), mesh.positions.len()), (want, want));
        }
    }
    let primitive = json!({"attributes": {"POSITION": 0}, "mode": 0});
    let (text, bin) = five(
        &[],
        json!({"componentType": 5126, "count": 1, "type": "VEC3"}),
        primitive,
    );
    assert_eq!(
        only_mesh(&read(&text, &bin).unwrap()).indices,
        [0, 1, 2, 3, 4]
    );
}

#[test]
fn missing_normals_are_flat_and_given_ones_stay() {
    let (text, bin) = in_material(json!({}));
    let model = read(&text, &bin).unwrap();
    assert_eq!(only_mesh(&model).normals, [[0.0, 0.0, 1.0]; 3]);

    let tilted = [0.6, 0.0, 0.8];
    let normals = floats(&[tilted, tilted, tilted, [0.0, 0.0, 7.0], [0.0; 3]].concat());
    let accessor = json!({"bufferView": 1, "componentType": 5126, "count": 5, "type": "VEC3"});
    let primitive = json!({"attributes": {"POSITION": 0, "NORMAL": 1}, "mode": 5});
    let (text, bin) = five(&normals, accessor, primitive);
    let model = read(&text, &bin).unwrap();
    let up = [0.0, 0.0, 1.0];
    assert_eq!(only_mesh(&model).normals, [tilted, tilted, tilted, up, up]);
}

#[test]
fn colours_of_every_type_are_display_referred() {
    // Linear 0.2140 is half way on the display.
    let half = [0.5, 1.0, 0.0, 0.5];
    for (component, shape, bytes, alpha) in [
        (5126, "VEC4", floats(&[0.214_041_14, 1.0, 0.0, 0.5]), 0.5),
        (5126, "VEC3", floats(&[0.214_041_14, 1.0, 0.0]), 1.0),
        (5121, "VEC4", vec![55, 255, 0, 128], 0.5),
        (
            5123,
            "VEC4",
            [14027_u16, 65535, 0, 32768].map(u16::to_le_bytes).concat(),
            0.5,
        ),
        (
            5123,
            "VEC3",
            [14027_u16, 65535, 0].map(u16::to_le_bytes).concat(),
            1.0,
        ),
    ] {
        let accessor = json!({"bufferView": 1, "componentType": component, "count": 5,
            "type": shape, "normalized": component != 5126});
        let primitive =
            json!({"attributes": {"POSITION": 0, "COLOR_0": 1}, "material": 0, "mode": 0});
        let (mut text, bin) = five(&bytes.repeat(5), accessor, primitive);
        text["materials"] = json!([{"alphaMode": "BLEND"}]);
        let model = read(&text, &bin).unwrap();
        let want = [half[0], half[1], half[2], alpha];
        for color in &only_mesh(&model).colors_srgb {
            for (got, want) in color.iter().zip(want) {
                // Half a step of a byte, steeper by the transfer function.
                assert!(
                    (got - want).abs() < 0.0025,
                    "{component} {shape}: {color:?}"
                );
            }
        }
        text["materials"] =
            json!([{"pbrMetallicRoughness": {"baseColorFactor": [1, 0.214_041_14, 1, 1]}}]);
        let model = read(&text, &bin).unwrap();
        let [_, green, _, alpha] = only_mesh(&model).colors_srgb[0];
        assert!((green - 0.5).abs() < 1e-6, "the base colour multiplies");
        assert_eq!(alpha, 1.0, "opaque");
    }
}

#[test]
fn sparse_elements_replace_others() {
    let mut more = vec![1, 4, 0, 0];
    more.extend(floats(&[9.0, 8.0, 7.0, 6.0, 5.0, 4.0]));
    for base in [None, Some(0)] {
        let mut accessor = json!({"componentType": 5126, "count": 5, "type": "VEC3", "sparse": {
            "count": 2,
            "indices": {"bufferView": 1, "componentType": 5121},
            "values": {"bufferView": 1, "byteOffset": 4},
        }});
        if let Some(view) = base {
            accessor["bufferView"] = json!(view);
        }
        let (text, bin) = five(
            &more,
            accessor,
            json!({"attributes": {"POSITION": 1}, "mode": 0}),
        );
        let model = read(&text, &bin).unwrap();
        let p = &only_mesh(&model).positions;
        assert_eq!((p[1], p[4]), ([9.0, 8.0, 7.0], [6.0, 5.0, 4.0]));
        let under = if base.is_some() {
            [1.0, 1.0, 0.0]
        } else {
            [0.0; 3]
        };
        assert_eq!(p[3], under);
    }
}

#[test]
fn buffers_come_from_text_and_files() {
    let (mut text, bin) = in_material(json!({}));
    let want = read(&text, &bin).unwrap();
    for uri in [
        "a%20b.bin",
        "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAgD8AAAAAAAAAAAAAAEAAAAAA",
    ] {
        text["buffers"][0]["uri"] = json!(uri);
        let got = read_bytes(text.to_string().as_bytes(), bin.clone()).unwrap();
        assert_eq!(got.scene.meshes, want.scene.meshes);
    }
}

#[test]
fn transforms_keep_the_precision_of_the_text() {
    let (mut text, bin) = in_material(json!({}));
    text["nodes"] = json!([
        {"name": "outer", "translation": [2_600_000.123_456_789_f64, 0, 1], "children": [1, 2]},
        {"name": "inner", "mesh": 0, "rotation": [0, 0, 1, 1], "scale": [1, 2, 3]},
        {"matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0.1, 0.2, 0.3, 1], "mesh": 0},
    ]);
    let scene = read(&text, &bin).unwrap().scene;
    assert_eq!(scene.nodes.len(), 1);
    assert_eq!(scene.nodes[0].name.as_deref(), Some("outer"));
    assert_eq!(scene.instances[0].placement.name.as_deref(), Some("inner"));
    assert_eq!(scene.instances[1].placement.name, None);
    assert_eq!(scene.instances[0].mesh, scene.instances[1].mesh);
    let outer = shift(2_600_000.123_456_789, 0.0, 1.0);
    let quarter = turn(DVec3::Z, PI / 2.0);
    let inner = quarter * DAffine3::from_scale(DVec3::new(1.0, 2.0, 3.0));
    assert_near(
        &scene.instances[0].placement.world_from_local,
        &(outer * inner),
    );
    let shifted = shift(0.1, 0.2, 0.3) * quarter;
    assert_near(
        &scene.instances[1].placement.world_from_local,
        &(outer * shifted),
    );
}

#[test]
fn without_a_scene_all_tops_are_shown() {
    let (mut text, bin) = in_material(json!({}));
    text.as_object_mut().unwrap().remove("scenes");
    text["nodes"] = json!([{"mesh": 0}, {"name": "g", "children": [0]}, {"mesh": 0}]);
    let scene = read(&text, &bin).unwrap().scene;
    assert_eq!((scene.nodes.len(), scene.instances.len()), (1, 2));
    // glTF allows a file without anything.
    let nothing = read(&json!({"asset": {"version": "2.0"}}), &[])
        .unwrap()
        .scene;
    assert!(nothing.instances.is_empty());
}

#[test]
fn materials_look_as_near_as_inventor_comes() {
    type Check = fn(&scenegraph::scene::Material) -> bool;
    let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
    let rows: [(Value, Check); 8] = [
        (json!({}), |m| {
            m.faces == Faces::FrontOnly && m.light_model == LightModel::Phong
        }),
        (json!({"doubleSided": true}), |m| {
            m.faces == Faces::BothTwoSidedLighting
        }),
        (json!({"extensions": {"KHR_materials_unlit": {}}}), |m| {
            m.light_model == LightModel::BaseColor && m.diffuse_srgb == [1.0; 3]
        }),
        (
            json!({"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]}}),
            |m| m.transparency == 0.0,
        ),
        (
            json!({"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]}}),
            |m| m.transparency == 0.75,
        ),
        (
            json!({"alphaMode": "MASK", "alphaCutoff": 0.3, "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]}}),
            |m| m.transparency == 1.0,
        ),
        (
            json!({"alphaMode": "MASK", "alphaCutoff": 0.2, "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]}}),
            |m| m.transparency == 0.0,
        ),
        (json!({"name": "m", "emissiveFactor": [0, 0, 1]}), |m| {
            m.emissive_srgb == [0.0, 0.0, 1.0] && m.name.as_deref() == Some("m")
        }),
    ];
    for (material, holds) in rows {
        let (text, bin) = in_material(material.clone());
        let scene = read(&text, &bin).unwrap().scene;
        assert!(
            holds(&scene.materials[0]),
            "{material}: {:?}",
            scene.materials[0]
        );
    }
    // Alpha^2 = 0.0625: c2 = 0.9723717, exponent 49.48; F0 = 0.04.
    let plastic = json!({"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.5}});
    let (text, bin) = in_material(plastic);
    let material = &read(&text, &bin).unwrap().scene.materials[0];
    assert!(
        (material.shininess - 49.48 / 128.0).abs() < 1e-3,
        "{}",
        material.shininess
    );
    assert!(near(material.specular_srgb[0], 0.16));
    // The display's value of 0.96.
    assert!(
        (material.diffuse_srgb[1] - 0.982_207).abs() < 1e-5,
        "{material:?}"
    );
}

#[test]
fn textures_carry_images_and_files() {
    let (mut text, bin) = in_material(json!({"pbrMetallicRoughness": {"baseColorTexture": {
        "index": 0, "texCoord": 1,
        "extensions": {"KHR_texture_transform": {"offset": [0.25, 0], "scale": [2, 3]}},
    }}}));
    let uv = floats(&[0.0, 0.0, 0.5, 0.25, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    let start = bin.len();
    let bin = [bin, uv, vec![1, 2, 3, 4]].concat();
    text["accessors"][1] =
        json!({"bufferView": 1, "componentType": 5126, "count": 5, "type": "VEC2"});
    text["bufferViews"][1] = json!({"buffer": 0, "byteOffset": start, "byteLength": 40});
    let image = json!({"buffer": 0, "byteOffset": start + 40, "byteLength": 4});
    text["bufferViews"].as_array_mut().unwrap().push(image);
    text["buffers"][0]["byteLength"] = json!(bin.len());
    text["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = json!(1);
    text["textures"] = json!([{"source": 0, "sampler": 0, "name": "t"}]);
    text["samplers"] = json!([{"wrapS": 33071}]);
    let bytes: std::sync::Arc<[u8]> = vec![1, 2, 3, 4].into();
    let named = TextureSource::Encoded {
        bytes: bytes.clone(),
        name: Some("i.png".into()),
    };
    let plain = TextureSource::Encoded { bytes, name: None };
    let file = TextureSource::File {
        name: "ü.png".into(),
        beside: "folder".into(),
    };
    for (image, want) in [
        (
            json!({"bufferView": 2, "mimeType": "image/png", "name": "i.png"}),
            Some(named),
        ),
        (
            json!({"uri": "data:image/png;base64,AQIDBA=="}),
            Some(plain),
        ),
        (json!({"uri": "%C3%BC.png"}), Some(file)),
        (json!({"uri": "data:image/png;base64,?"}), None),
        (json!({}), None),
    ] {
        text["images"] = json!([image]);
        let model = read(&text, &bin).unwrap();
        assert_eq!(model.warnings.len(), usize::from(want.is_none()));
        assert_eq!(model.scene.textures.first().map(|t| t.source.clone()), want);
        if let Some(texture) = model.scene.textures.first() {
            assert_eq!(
                (texture.wrap_s, texture.wrap_t),
                (Wrap::Clamp, Wrap::Repeat)
            );
            assert_eq!(texture.name.as_deref(), Some("t"));
        }
        // Scaled, shifted, and turned upside down.
        let texcoords = &only_mesh(&model).texcoords;
        assert_eq!(texcoords[..], [[0.25, 1.0], [1.25, 0.25], [0.25, -2.0]]);
    }
}

#[test]
fn lights_are_as_bright_as_in_gltf() {
    let (mut text, bin) = in_material(json!({}));
    text["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "directional", "intensity": PI},
        {"type": "point", "intensity": 50, "color": [1, 0, 0.214_041_14]},
        {"type": "spot", "spot": {"outerConeAngle": 0.5, "innerConeAngle": 0.4995}},
    ]}});
    let light = |i: usize| json!({"KHR_lights_punctual": {"light": i}});
    text["nodes"] = json!([
        {"children": [1, 2, 3], "mesh": 0},
        {"translation": [0, 0, 4], "extensions": light(2)},
        {"rotation": [0, 1, 0, 0], "extensions": light(0)},
        {"translation": [1, 2, 3], "extensions": light(1)},
    ]);
    let scene = read(&text, &bin).unwrap().scene;
    let [sun, bulb, spot] = &scene.lights[..] else {
        panic!("{:?}", scene.lights)
    };
    assert_eq!(
        scene.light_sets[scene.instances[0].light_set.index()].len(),
        3
    );
    let attenuation =
        |i: usize| scene.environments[scene.lights[i].environment.index()].attenuation;
    assert!((sun.intensity - 1.0).abs() < 1e-6);
    let LightKind::Directional { direction } = sun.kind else {
        panic!("{sun:?}")
    };
    let in_world = sun.placement.world_from_local.transform_vector3(direction);
    assert!((in_world - DVec3::Z).length() < 1e-15);
    assert_eq!(attenuation(0), [0.0, 0.0, 1.0]);
    assert_eq!(bulb.placement.world_from_local, shift(1.0, 2.0, 3.0));
    // candela / d^2 of light on a surface that reflects its share of it / pi.
    assert!((bulb.intensity - 50.0 / PI).abs() < 1e-5);
    assert_eq!(attenuation(1), [1.0, 0.0, 0.0]);
    assert!((bulb.color_srgb[2] - 0.5).abs() < 1e-6);
    let LightKind::Spot {
        drop_off_rate,
        cut_off_angle_rad,
        ..
    } = spot.kind
    else {
        panic!("{spot:?}")
    };
    assert_eq!(drop_off_rate, 0.0);
    assert!((cut_off_angle_rad - 0.5).abs() < 1e-7);
}

#[test]
fn cameras_of_both_kinds() {
    let (mut text, bin) = in_material(json!({}));
    text["nodes"] =
        json!([{"mesh": 0, "camera": 1, "children": [1]}, {"camera": 0, "translation": [0, 0, 5]}]);
    text["cameras"] = json!([
        {"type": "perspective", "perspective": {"yfov": 0.1, "znear": 0.01}},
        {"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 1.5, "znear": 0, "zfar": 7}},
    ]);
    let cameras = read(&text, &bin).unwrap().scene.cameras;
    // f64, where f32 would give 0.10000000149.
    assert_eq!(
        cameras[0].projection,
        Projection::Perspective {
            height_angle_rad: 0.1
        }
    );
    assert_eq!(cameras[0].placement.world_from_local, shift(0.0, 0.0, 5.0));
    assert_eq!(
        cameras[1].projection,
        Projection::Orthographic { height: 3.0 }
    );
    assert_eq!(
        (cameras[1].aspect_ratio, cameras[1].far_distance),
        (2.0, 7.0)
    );
}

#[test]
fn copies_of_a_mesh_are_instances() {
    let at = floats(&[1.0, 0.0, 0.0, 0.0, 2.0, 0.0]);
    let accessor = json!({"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC3"});
    let (mut text, bin) = five(&at, accessor, json!({"attributes": {"POSITION": 0}}));
    text["nodes"][0]["translation"] = json!([0, 0, 3]);
    text["nodes"][0]["extensions"] =
        json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1}}});
    text["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    let scene = read(&text, &bin).unwrap().scene;
    let got: Vec<_> = scene
        .instances
        .iter()
        .map(|i| i.placement.world_from_local)
        .collect();
    assert_eq!(got, [shift(1.0, 0.0, 3.0), shift(0.0, 2.0, 3.0)]);
    assert_eq!(scene.meshes.len(), 1);
}

#[test]
fn what_is_left_out_is_said() {
    let (mut text, bin) = in_material(json!({}));
    text["animations"] = json!([{"channels": [], "samplers": []}]);
    assert_eq!(
        read(&text, &bin).unwrap().warnings,
        ["animations are not played"]
    );
}

/// Written by the writer, and read back.
fn back(scene: &Scene, images: &Images) -> Scene {
    let bytes = convert_with(scene, &Options::default(), images).bytes;
    read_bytes(&bytes, Vec::new()).unwrap().scene
}

#[test]
fn an_image_mixed_with_the_colour_is_on_white() {
    let texture = Texture {
        model: TextureModel::Blend,
        ..file_texture("a.png")
    };
    let build = Build::textured(texture, material());
    let images = Images::with(&[("a.png", png(&[[9, 99, 199, 255]]))]);
    let scene = back(&build.scene, &images);
    assert_eq!(scene.textures[0].model, TextureModel::Modulate);
    assert_eq!(scene.materials[0].diffuse_srgb, [1.0; 3]);
}

#[test]
fn distances_of_a_camera_in_a_scaled_group_are_scaled() {
    let mut build = Build::one(triangle(), material());
    let height_angle_rad = 0.5;
    build.camera(
        None,
        scale(3.0, 3.0, 3.0),
        Projection::Perspective { height_angle_rad },
    );
    let camera = &back(&build.scene, &Images::default()).cameras[0];
    let at = camera
        .placement
        .world_from_local
        .transform_point3(camera.position);
    assert_eq!(at, DVec3::new(0.0, 0.0, 15.0));
    let distances = [
        camera.near_distance,
        camera.far_distance,
        camera.focal_distance,
    ];
    assert_eq!(distances, [3.0, 30.0, 15.0]);
}

#[test]
fn a_light_keeps_its_environment() {
    let mut build = Build::one(triangle(), material());
    let direction = DVec3::X;
    build.light(
        None,
        DAffine3::IDENTITY,
        LightKind::Directional { direction },
    );
    build.scene.environments.push(Environment {
        ambient_intensity: 0.5,
        ..Environment::default()
    });
    build.scene.lights[0].environment = EnvironmentId(1);
    let scene = back(&build.scene, &Images::default());
    assert_eq!(scene.environments, build.scene.environments);
    assert_eq!(scene.lights[0].environment, EnvironmentId(1));
}
