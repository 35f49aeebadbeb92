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

/// What became of some edits of each sample of which `is_one_of` holds.
fn fates(is_one_of: impl Fn(&[u8]) -> bool, options: &Options) -> BTreeMap<Fate, usize> {
    let mut runner = TestRunner::new_with_rng(
        Config::default(),
        TestRng::deterministic_rng(RngAlgorithm::ChaCha),
    );
    let mut fates: BTreeMap<Fate, usize> = BTreeMap::new();
    let mut faults = Vec::new();
    for model in samples() {
        let text = fs::read(&model.path).expect("a sample");
        if !is_one_of(&text) {
            continue;
        }
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

fn is_vrml2(text: &[u8]) -> bool {
    text.starts_with(b"#VRML V2.0")
}

#[test]
fn edits_arrive_in_the_source() {
    let turned = Options {
        up: Up::Z,
        metres_per_unit: 0.001,
        ..Options::default()
    };
    for options in [Options::default(), turned] {
        let fates = fates(|text| !is_vrml2(text), &options);
        // What is left are edits of one of several uses of a node, and of what the source computes.
        let count = |fate: Fate| fates.get(&fate).copied().unwrap_or_default();
        assert!(count(Fate::Patched) > 4 * count(Fate::Anew), "{fates:?}");
    }
}

#[test]
fn edits_arrive_in_vrml_2() {
    let fates = fates(is_vrml2, &Options::default());
    let count = |fate: Fate| fates.get(&fate).copied().unwrap_or_default();
    assert!(count(Fate::Patched) > 2 * count(Fate::Anew), "{fates:?}");
}
