//! What was edited in a glTF file that carries its source arrives in the source's text, and nothing
//! else changes.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use convert::{InventorFiles, Options, Up, write_glb};
use glam::{DAffine3, DQuat, DVec3};
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use scenegraph::{FileLoader, ResolveOptions, load, resolve};
use serde_json::{Value, json};

use super::models::{Images, Model, samples};
use super::source_back::{back, glb_made_so};

/// An edit of one object, whichever there is.
#[derive(Clone, Debug)]
enum Edit {
    Name(Index, u16),
    Move(Index, [f64; 3]),
    Turn(Index, f64),
    Color(Index, [f32; 3]),
    Light(Index, [f32; 3]),
}

fn edit() -> impl Strategy<Value = Edit> {
    let far = prop::array::uniform3(-100.0..100.0_f64);
    let color = prop::array::uniform3(0.0..1.0_f32);
    prop_oneof![
        (any::<Index>(), any::<u16>()).prop_map(|(i, n)| Edit::Name(i, n)),
        (any::<Index>(), far).prop_map(|(i, v)| Edit::Move(i, v)),
        (any::<Index>(), 0.1..3.0_f64).prop_map(|(i, a)| Edit::Turn(i, a)),
        (any::<Index>(), color.clone()).prop_map(|(i, c)| Edit::Color(i, c)),
        (any::<Index>(), color).prop_map(|(i, c)| Edit::Light(i, c)),
    ]
}

/// The text of a `.glb`, and what follows it.
pub fn parts(glb: &[u8]) -> (Value, &[u8]) {
    let length = glb[12..16].try_into().map_or(0, u32::from_le_bytes) as usize;
    let text = serde_json::from_slice(&glb[20..20 + length]).expect("JSON");
    (text, &glb[20 + length..])
}

pub fn joined(text: &Value, rest: &[u8]) -> Vec<u8> {
    let mut text = text.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let words = [2, 20 + text.len() + rest.len(), text.len()];
    let mut out = b"glTF".to_vec();
    out.extend(words.iter().flat_map(|&word| (word as u32).to_le_bytes()));
    out.extend(b"JSON");
    out.extend(text);
    out.extend(rest);
    out
}

/// Makes an edit; false if there is nothing to edit.
fn apply(document: &mut Value, edit: &Edit) -> bool {
    let (pointer, index) = match edit {
        Edit::Name(index, _) | Edit::Move(index, _) | Edit::Turn(index, _) => ("/nodes", index),
        Edit::Color(index, _) => ("/materials", index),
        Edit::Light(index, _) => ("/extensions/KHR_lights_punctual/lights", index),
    };
    let Some(list) = document.pointer_mut(pointer).and_then(Value::as_array_mut) else {
        return false;
    };
    if list.is_empty() {
        return false;
    }
    let object = index.get_mut(list);
    match edit {
        Edit::Name(_, number) => object["name"] = format!("Edited_{number}").into(),
        Edit::Move(_, by) => {
            let old: [f64; 3] =
                std::array::from_fn(|i| object["translation"][i].as_f64().unwrap_or(0.0));
            let new: Vec<f64> = old.iter().zip(by).map(|(a, b)| a + b).collect();
            object["translation"] = json!(new);
        }
        Edit::Turn(_, angle) => {
            object["rotation"] = json!([0.0, (angle / 2.0).sin(), 0.0, (angle / 2.0).cos()]);
        }
        Edit::Color(_, color) => {
            let alpha = object["pbrMetallicRoughness"]["baseColorFactor"][3].as_f64();
            let [r, g, b] = color;
            let factor = json!([r, g, b, alpha.unwrap_or(1.0)]);
            object["pbrMetallicRoughness"]["baseColorFactor"] = factor;
        }
        Edit::Light(_, color) => object["color"] = json!(color),
    }
    true
}

/// The JSON of what a text and the files beside it give.
fn converted(files: &InventorFiles, options: &Options) -> Value {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path().canonicalize().expect("a folder");
    for (name, bytes) in &files.beside {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap_or(&folder)).expect("a folder");
        fs::write(path, bytes).expect("a file");
    }
    let loader = FileLoader::new([folder.as_path()]);
    let graph = load(&files.text, "model.iv", &folder, &loader);
    let scene = resolve(&graph, &ResolveOptions::default()).scene;
    let mut glb = Vec::new();
    write_glb(&scene, options, &Images(loader), &mut glb).expect("a file");
    parts(&glb).0
}

/// Numbers near each other, all else equal.
fn same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap_or(0.0), b.as_f64().unwrap_or(0.0));
            (a - b).abs() <= 2e-5 + 1e-11 * a.abs()
        }
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            let get = |map: &serde_json::Map<String, Value>, key: &str| {
                map.get(key).cloned().unwrap_or(default_of(key))
            };
            let mut keys = a.keys().chain(b.keys());
            keys.all(|key| same(&get(a, key), &get(b, key)))
        }
        (a, b) => a == b,
    }
}

/// What a member that is not there means.
fn default_of(key: &str) -> Value {
    match key {
        "color" => json!([1, 1, 1]),
        "baseColorFactor" => json!([1, 1, 1, 1]),
        _ => Value::Null,
    }
}

/// A member of a list, without its extras; null if there is none.
fn at(document: &Value, list: &str, index: &Value) -> Value {
    let index = index.as_u64().unwrap_or(u64::MAX) as usize;
    let found = document.pointer(list).and_then(|list| list.get(index));
    let mut object = found.cloned().unwrap_or_default();
    if let Some(members) = object.as_object_mut() {
        members.remove("extras");
    }
    object
}

fn frame(node: &Value) -> DAffine3 {
    let number = |key: &str, i: usize, default: f64| node[key][i].as_f64().unwrap_or(default);
    let triple =
        |key: &str, d: f64| DVec3::new(number(key, 0, d), number(key, 1, d), number(key, 2, d));
    let rotation = [0.0, 0.0, 0.0, 1.0];
    let rotation = std::array::from_fn(|i| number("rotation", i, rotation[i]));
    DAffine3::from_scale_rotation_translation(
        triple("scale", 1.0),
        DQuat::from_array(rotation),
        triple("translation", 0.0),
    )
}

/// What a file shows, whatever the order and grouping: each mesh, light and camera with the name of
/// its node, its place in the world and its look; and the names of groups.
fn facts(document: &Value) -> Vec<Value> {
    let mut facts = Vec::new();
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let roots = list(&document["scenes"][0]["nodes"]);
    let mut open: Vec<(Value, DAffine3)> = Vec::new();
    open.extend(roots.into_iter().map(|root| (root, DAffine3::IDENTITY)));
    while let Some((index, parent)) = open.pop() {
        let node = at(document, "/nodes", &index);
        let world = parent * frame(&node);
        open.extend(
            list(&node["children"])
                .into_iter()
                .map(|child| (child, world)),
        );
        let light = &node["extensions"]["KHR_lights_punctual"]["light"];
        if !node["mesh"].is_null() {
            let primitive = at(document, "/meshes", &node["mesh"])["primitives"][0].clone();
            let accessor = at(document, "/accessors", &primitive["attributes"]["POSITION"]);
            facts.push(json!({
                "name": node["name"],
                "world": world.to_cols_array(),
                "box": [accessor["min"], accessor["max"]],
                "count": accessor["count"],
                "material": at(document, "/materials", &primitive["material"]),
            }));
        } else if !light.is_null() {
            let light = at(document, "/extensions/KHR_lights_punctual/lights", light);
            facts.push(json!({
                "name": node["name"],
                "type": light["type"],
                "color": light.get("color").cloned().unwrap_or(default_of("color")),
                "place": world.translation.to_array(),
                "beam": world.transform_vector3(DVec3::Z).to_array(),
            }));
        } else if !node["camera"].is_null() {
            facts.push(json!({ "name": node["name"], "world": world.to_cols_array() }));
        } else if !node["name"].is_null() {
            facts.push(json!({ "group": node["name"] }));
        }
    }
    facts
}

/// A fact of one file that the other has not.
fn difference(want: &Value, got: &Value) -> Option<String> {
    let mut left = facts(got);
    for fact in facts(want) {
        let Some(found) = left.iter().position(|other| same(&fact, other)) else {
            return Some(format!("{fact}, of {left:?}"));
        };
        left.swap_remove(found);
    }
    left.first().map(|fact| format!("besides {fact}"))
}

/// What became of an edit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Fate {
    Nothing,
    Patched,
    Anew,
}

fn fate(model: &Model, glb: &[u8], edit: &Edit, options: &Options) -> Result<Fate, String> {
    let (mut document, rest) = parts(glb);
    if !apply(&mut document, edit) {
        return Ok(Fate::Nothing);
    }
    let files = back(&joined(&document, rest))?;
    let anew = files.notes.iter().any(|n| n.code == "edited" && n.is_loss);
    if anew {
        return Ok(Fate::Anew);
    }
    let result = converted(&files, options);
    if let Some(why) = difference(&document, &result) {
        let why: String = why.chars().take(700).collect();
        return Err(format!("{} {edit:?}: {why}", model.name));
    }
    Ok(Fate::Patched)
}

/// What became of some edits of each sample.
fn fates(options: &Options) -> BTreeMap<Fate, usize> {
    let mut runner = TestRunner::new_with_rng(
        Config::default(),
        TestRng::deterministic_rng(RngAlgorithm::ChaCha),
    );
    let mut fates: BTreeMap<Fate, usize> = BTreeMap::new();
    let mut faults = Vec::new();
    for model in samples() {
        let text = fs::read(&model.path).expect("a sample");
        let folder = model.path.parent().unwrap_or(Path::new(".")).canonicalize();
        let folder = folder.expect("a folder");
        let glb = glb_made_so(&text, &folder, &model.loader(), options).expect("a file");
        for _ in 0..8 {
            let edit = edit().new_tree(&mut runner).expect("an edit").current();
            match fate(&model, &glb, &edit, options) {
                Ok(fate) => {
                    if fate == Fate::Anew {
                        println!("{} {edit:?}", model.name);
                    }
                    *fates.entry(fate).or_default() += 1;
                }
                Err(why) => faults.push(why),
            }
        }
    }
    println!("{fates:?}");
    assert!(
        faults.is_empty(),
        "{} faults\n{}",
        faults.len(),
        faults.join("\n")
    );
    fates
}

#[test]
fn edits_arrive_in_the_source() {
    let turned = Options {
        up: Up::Z,
        metres_per_unit: 0.001,
        ..Options::default()
    };
    for options in [Options::default(), turned] {
        let fates = fates(&options);
        // What is left are edits of one of several uses of a node, and of what the source computes.
        let count = |fate: Fate| fates.get(&fate).copied().unwrap_or_default();
        assert!(count(Fate::Patched) > 4 * count(Fate::Anew), "{fates:?}");
    }
}

const VRML2: &str = "#VRML V2.0 utf8
Viewpoint { position 0 0 9 fieldOfView 0.5 }
DEF Lamp SpotLight { location 1 2 3 color 1 0.5 0 cutOffAngle 0.5 } # a lamp
DEF Arm Transform { translation 1 2 3 center 0 1 0 rotation 0 1 0 0.5 children [
  DEF Bolt Shape {
    appearance Appearance { material DEF Red Material { diffuseColor 1 0 0 } } # red
    geometry Box { }
  }
] }
DEF Pair Group { children [
  Shape { appearance Appearance { material DEF Blue Material { } } geometry Sphere { } }
  DEF Tip Shape { geometry Cone { } }
] }
";

/// What can be edited in a text of VRML 2.0, and what then stands in it.
#[test]
fn edits_arrive_in_vrml_2() {
    let (nodes, materials) = ("/nodes", "/materials");
    let lights = "/extensions/KHR_lights_punctual/lights";
    let turn = json!([0, 0.6, 0, 0.8]);
    let rows = [
        (nodes, "Arm", "name", json!("Leg"), "DEF Leg Transform {"),
        (
            nodes,
            "Arm",
            "translation",
            json!([1, 2, 4]),
            "translation 1 2 4",
        ),
        (
            nodes,
            "Arm",
            "rotation",
            turn.clone(),
            "DEF Arm Transform {",
        ),
        (nodes, "Arm", "scale", json!([1, 2, 1]), "scale 1 2 1"),
        (
            nodes,
            "Tip",
            "translation",
            json!([0, 0, 7]),
            "Transform { translation 0 0 7 children [ DEF Tip",
        ),
        (nodes, "Pair", "rotation", turn, "children [ DEF Pair"),
        (
            nodes,
            "Lamp",
            "translation",
            json!([1, 2, 5]),
            "location 1 2 5",
        ),
        (
            materials,
            "Red",
            "name",
            json!("Rust"),
            "DEF Rust Material {",
        ),
        (
            materials,
            "Red",
            "emissiveFactor",
            json!([0, 1, 0]),
            "emissiveColor 0 1 0",
        ),
        (
            materials,
            "Blue",
            "emissiveFactor",
            json!([0, 1, 0]),
            "emissiveColor 0 1 0",
        ),
        (lights, "", "color", json!([0, 1, 0]), "color 0 1 0"),
        (
            "/cameras",
            "",
            "perspective",
            json!({"yfov": 0.75, "znear": 0.1}),
            "fieldOfView 0.75",
        ),
    ];
    let nothing = FileLoader::default();
    let turned = Options {
        up: Up::Z,
        metres_per_unit: 0.5,
        ..Options::default()
    };
    let mut faults = Vec::new();
    for options in [Options::default(), turned] {
        let glb = glb_made_so(VRML2.as_bytes(), Path::new(""), &nothing, &options);
        let glb = glb.expect("a file");
        for (list, name, key, value, want) in &rows {
            let (mut document, rest) = parts(&glb);
            let objects = document.pointer_mut(list).and_then(Value::as_array_mut);
            let objects = objects.expect("a list").iter_mut();
            let mut named = objects.filter(|o| name.is_empty() || o["name"] == *name);
            named.next().expect(name)[*key] = value.clone();
            let files = back(&joined(&document, rest)).expect("a text");
            let text = String::from_utf8_lossy(&files.text);
            if !(text.contains(want) && text.contains("# a lamp")) {
                faults.push(format!("{name} {key}: {:?}\n{text:.900}", files.notes));
                continue;
            }
            let difference = difference(&document, &converted(&files, &options));
            faults.extend(difference.map(|why| format!("{name} {key}: {why}")));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
