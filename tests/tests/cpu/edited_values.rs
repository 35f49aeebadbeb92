//! What was edited in a glTF file counts more than Inventor's values in its extras, and only what was
//! edited: with the source in the file and without.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::path::Path;

use convert::{Lights, Materials, Options, write_glb};
use scenegraph::scene::{LightKind, Projection, Scene};
use scenegraph::{FileLoader, ResolveOptions, load, resolve};
use serde_json::{Value, json};
use tests::fuzz_body::read_gltf;

use super::edited::{joined, parts};
use super::models::Images;
use super::source_back::glb_with_source;

const MODEL: &str = "#Inventor V2.1 ascii
PerspectiveCamera { position 0 0 9 nearDistance 2 farDistance 30 focalDistance 9 }
DirectionalLight { color 1 0.5 0.25 intensity 0.5 }
Environment { attenuation 0 0.5 1 }
SpotLight { location 1 2 3 intensity 0.75 cutOffAngle 0.5 dropOffRate 0.125 }
DEF Part Separator {
  Translation { translation 1 0 0 }
  ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType SOLID }
  DEF Paint Material {
    ambientColor 0.1 0.2 0.3 diffuseColor 0.2 0.4 0.6 shininess 0.25 transparency 0.5
  }
  Cube { }
}
DEF Shiny Separator {
  Translation { translation 4 0 0 }
  Material { diffuseColor 0.2 0.4 0.6 specularColor 0.5 0.5 0.5 shininess 0.25 }
  Cube { }
  OrthographicCamera { height 4 nearDistance 2 farDistance 30 }
}
";

/// All that a scene says, by name.
fn facts(scene: &Scene) -> BTreeMap<String, Vec<f64>> {
    let mut facts = BTreeMap::new();
    let mut add = |name: String, values: &[f64]| {
        facts.insert(name, values.to_vec());
    };
    for (i, node) in scene.nodes.iter().enumerate() {
        let frame = node.parent_from_local.to_cols_array();
        add(format!("node {i} {:?}", node.name), &frame);
    }
    for (i, instance) in scene.instances.iter().enumerate() {
        let placement = &instance.placement;
        let frame = placement.world_from_local.to_cols_array();
        add(format!("shape {i} {:?}", placement.name), &frame);
        add(
            format!("shape {i} lit by"),
            &[f64::from(instance.light_set.0)],
        );
    }
    for (i, m) in scene.materials.iter().enumerate() {
        add(format!("material {i} {:?}", m.name), &[]);
        add(format!("material {i} ambient"), &m.ambient_srgb);
        add(format!("material {i} diffuse"), &m.diffuse_srgb);
        add(format!("material {i} specular"), &m.specular_srgb);
        add(format!("material {i} emissive"), &m.emissive_srgb);
        add(format!("material {i} shininess"), &[m.shininess]);
        add(format!("material {i} transparency"), &[m.transparency]);
        add(format!("material {i} {:?}", m.faces), &[]);
        add(format!("material {i} {:?}", m.light_model), &[]);
    }
    for (i, light) in scene.lights.iter().enumerate() {
        let environment = &scene.environments[light.environment.index()];
        add(format!("light {i} color"), &light.color_srgb);
        add(format!("light {i} intensity"), &[light.intensity]);
        add(format!("light {i} attenuation"), &environment.attenuation);
        if let LightKind::Spot {
            drop_off_rate,
            cut_off_angle_rad,
            ..
        } = light.kind
        {
            add(format!("light {i} drop-off"), &[drop_off_rate]);
            add(format!("light {i} cut-off"), &[cut_off_angle_rad]);
        }
    }
    for (i, camera) in scene.cameras.iter().enumerate() {
        let range = [camera.near_distance, camera.far_distance];
        add(format!("camera {i} range"), &range);
        add(format!("camera {i} focus"), &[camera.focal_distance]);
        add(format!("camera {i} aspect"), &[camera.aspect_ratio]);
        let view = match camera.projection {
            Projection::Perspective { height_angle_rad } => height_angle_rad,
            Projection::Orthographic { height } => height,
        };
        add(format!("camera {i} view"), &[view]);
    }
    facts
}

/// What differs, in f32: its names, with the new values.
fn changes(was: &Scene, is: &Scene) -> BTreeMap<String, Vec<f32>> {
    let (was, is) = (facts(was), facts(is));
    let narrow = |values: &[f64]| values.iter().map(|v| *v as f32).collect::<Vec<f32>>();
    let same = |name: &String, values: &[f64]| {
        was.get(name).is_some_and(|old| {
            let close = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-12 * a.abs().max(1.0);
            old.len() == values.len() && old.iter().zip(values).all(close)
        })
    };
    let changed = is.iter().filter(|(name, values)| !same(name, values));
    changed
        .map(|(name, values)| (name.clone(), narrow(values)))
        .collect()
}

fn glb(options: &Options) -> Vec<u8> {
    let nothing = FileLoader::default();
    let graph = load(MODEL.as_bytes(), "m.iv", Path::new(""), &nothing);
    let scene = resolve(&graph, &ResolveOptions::default()).scene;
    let mut glb = Vec::new();
    write_glb(&scene, options, &Images(nothing), &mut glb).expect("a file");
    glb
}

/// Exponent's share of a lobe of this roughness, by the width of GGX at half its height.
fn shininess(roughness: f64) -> f64 {
    let a = roughness.powi(4);
    let cos_squared = (1.0 - 2.0_f64.sqrt() * a) / (1.0 - a);
    2.0 * 2.0_f64.ln() / -cos_squared.ln() / 128.0
}

/// A colour under a highlight of this shininess and strength, once that is gone.
fn scattered(color_srgb: f64, shininess: f64, strength: f64) -> f64 {
    let cos_squared = (-2.0 / (128.0 * shininess)).exp2();
    let mirrored = 4.0 * strength * (1.0 - cos_squared) / (2.0_f64.sqrt() - cos_squared);
    let linear = ((color_srgb + 0.055) / 1.055).powf(2.4) / (1.0 - mirrored);
    1.055 * linear.powf(1.0 / 2.4) - 0.055
}

/// Where a value stands, its new one, and what of the scene has which values then.
type Row = (String, Value, Vec<(&'static str, Vec<f64>)>);

#[test]
fn edits_count_more_than_extras() {
    let lights = "/extensions/KHR_lights_punctual/lights";
    let rows: Vec<Row> = vec![
        (
            "/materials/0/pbrMetallicRoughness/baseColorFactor".into(),
            json!([1, 0, 0, 0.5]),
            vec![("material 0 diffuse", vec![1.0, 0.0, 0.0])],
        ),
        (
            "/materials/0/pbrMetallicRoughness/baseColorFactor/3".into(),
            json!(0.25),
            vec![("material 0 transparency", vec![0.75])],
        ),
        (
            "/materials/0/alphaMode".into(),
            json!("OPAQUE"),
            vec![("material 0 transparency", vec![0.0])],
        ),
        (
            "/materials/0/emissiveFactor".into(),
            json!([0, 1, 0]),
            vec![("material 0 emissive", vec![0.0, 1.0, 0.0])],
        ),
        (
            "/materials/0/pbrMetallicRoughness/roughnessFactor".into(),
            json!(0.5),
            vec![("material 0 shininess", vec![shininess(0.5)])],
        ),
        (
            "/materials/0/doubleSided".into(),
            json!(true),
            vec![("material 0 BothTwoSidedLighting", vec![])],
        ),
        (
            "/materials/0/extensions".into(),
            json!({"KHR_materials_unlit": {}}),
            vec![("material 0 BaseColor", vec![])],
        ),
        (
            "/materials/0/name".into(),
            json!("Varnish"),
            vec![("material 0 Some(\"Varnish\")", vec![])],
        ),
        (
            "/materials/1/extensions/KHR_materials_specular/specularFactor".into(),
            json!(0),
            // What is no longer mirrored is scattered.
            vec![
                (
                    "material 1 diffuse",
                    [0.2, 0.4, 0.6].map(|v| scattered(v, 0.25, 0.5)).to_vec(),
                ),
                ("material 1 specular", vec![0.0; 3]),
            ],
        ),
        (
            format!("{lights}/0/color"),
            json!([0, 1, 0]),
            vec![("light 0 color", vec![0.0, 1.0, 0.0])],
        ),
        (
            format!("{lights}/0/intensity"),
            json!(PI),
            vec![("light 0 intensity", vec![1.0])],
        ),
        (
            format!("{lights}/1/intensity"),
            json!(0),
            vec![("light 1 intensity", vec![0.0])],
        ),
        (
            format!("{lights}/1/spot"),
            json!({"innerConeAngle": 0.25, "outerConeAngle": 0.25}),
            vec![
                ("light 1 cut-off", vec![0.25]),
                ("light 1 drop-off", vec![0.0]),
            ],
        ),
        (
            "/cameras/0/perspective/yfov".into(),
            json!(1.25),
            vec![("camera 0 view", vec![1.25])],
        ),
        (
            "/cameras/0/perspective/zfar".into(),
            json!(50),
            vec![("camera 0 range", vec![2.0, 50.0])],
        ),
        (
            "/cameras/0/perspective/aspectRatio".into(),
            json!(2),
            vec![("camera 0 aspect", vec![2.0])],
        ),
        (
            "/cameras/1/orthographic/znear".into(),
            json!(3),
            vec![("camera 1 range", vec![3.0, 30.0])],
        ),
    ];
    let nothing = FileLoader::default();
    let with_source = glb_with_source(MODEL.as_bytes(), Path::new(""), &nothing).expect("a file");
    let mut faults = Vec::new();
    for glb in [glb(&Options::default()), with_source] {
        let was = read_gltf(&glb).expect("a scene").scene;
        let (document, rest) = parts(&glb);
        for (pointer, value, want) in &rows {
            let mut edited = document.clone();
            let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
            let parent = edited.pointer_mut(parent).expect(pointer);
            match key.parse::<usize>() {
                Ok(index) => parent[index] = value.clone(),
                Err(_) => parent[key] = value.clone(),
            }
            let is = read_gltf(&joined(&edited, rest)).expect("a scene").scene;
            let narrow = |values: &[f64]| values.iter().map(|v| *v as f32).collect::<Vec<f32>>();
            let want: BTreeMap<_, _> = (want.iter())
                .map(|(name, values)| ((*name).to_owned(), narrow(values)))
                .collect();
            let got = changes(&was, &is);
            if got != want {
                faults.push(format!("{pointer}: {got:?} instead of {want:?}"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Each choice makes other values of the same material and light: none of them is an edit.
#[test]
fn choices_of_the_writer_are_no_edits() {
    let usual = read_gltf(&glb(&Options::default())).expect("a scene").scene;
    for materials in [Materials::Fidelity, Materials::Simple, Materials::Unlit] {
        for lights in [Lights::Unitless, Lights::Physical] {
            let options = Options {
                materials,
                lights,
                ..Options::default()
            };
            let scene = read_gltf(&glb(&options)).expect("a scene").scene;
            let changed = changes(&usual, &scene);
            assert!(changed.is_empty(), "{materials:?} {lights:?}: {changed:?}");
        }
    }
}

/// A light that was taken out or added leaves the sets of the others as they were.
#[test]
fn light_sets_follow_their_lights() {
    let text = "#Inventor V2.1 ascii\n\
        Separator { DirectionalLight { direction 1 0 0 } Cube { } }\n\
        Separator { DirectionalLight { direction 0 1 0 } Sphere { } }\n";
    let nothing = FileLoader::default();
    let glb = glb_with_source(text.as_bytes(), Path::new(""), &nothing).expect("a file");
    let (document, rest) = parts(&glb);
    let sets = |document: &Value| {
        let scene = read_gltf(&joined(document, rest)).expect("a scene").scene;
        let of = |i: &scenegraph::scene::Instance| {
            let set = &scene.light_sets[i.light_set.index()];
            set.iter().map(|light| light.index()).collect::<Vec<_>>()
        };
        scene.instances.iter().map(of).collect::<Vec<_>>()
    };
    assert_eq!(sets(&document), [[0], [1]]);
    let list = "/extensions/KHR_lights_punctual/lights";
    let lights = |document: &mut Value| {
        let list = document.pointer_mut(list).and_then(Value::as_array_mut);
        std::mem::take(list.expect("lights"))
    };
    // The other way round: every node keeps its light.
    let mut turned = document.clone();
    let mut reversed = lights(&mut turned);
    reversed.reverse();
    turned["extensions"]["KHR_lights_punctual"]["lights"] = reversed.into();
    for node in turned["nodes"].as_array_mut().expect("nodes") {
        if let Some(light) = node.pointer_mut("/extensions/KHR_lights_punctual/light") {
            *light = json!(1 - light.as_u64().expect("a number"));
        }
    }
    assert_eq!(sets(&turned), [[1], [0]]);
    // One more reaches all.
    let mut more = document.clone();
    let mut added = lights(&mut more);
    added.push(json!({"type": "point"}));
    more["extensions"]["KHR_lights_punctual"]["lights"] = added.into();
    let count = more["nodes"].as_array().expect("nodes").len();
    let node = json!({"extensions": {"KHR_lights_punctual": {"light": 2}}});
    more["nodes"].as_array_mut().expect("nodes").push(node);
    more["scenes"][0]["nodes"]
        .as_array_mut()
        .expect("roots")
        .push(count.into());
    assert_eq!(sets(&more), [[0, 2], [1, 2]]);
}
