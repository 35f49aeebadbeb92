//! What was edited in a glTF file that carries its source arrives in the source's text, and nothing
//! else changes.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use convert::{InventorFiles, Options, write_glb};
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use scenegraph::{FileLoader, ResolveOptions, load, resolve};
use serde_json::{Value, json};

use super::models::{Images, Model, samples};
use super::source_back::{back, glb_with_source};

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
fn parts(glb: &[u8]) -> (Value, &[u8]) {
    let length = glb[12..16].try_into().map_or(0, u32::from_le_bytes) as usize;
    let text = serde_json::from_slice(&glb[20..20 + length]).expect("JSON");
    (text, &glb[20 + length..])
}

fn joined(text: &Value, rest: &[u8]) -> Vec<u8> {
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
fn converted(files: &InventorFiles) -> Value {
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
    write_glb(&scene, &Options::default(), &Images(loader), &mut glb).expect("a file");
    parts(&glb).0
}

/// Numbers near each other, all else equal; extras left out.
fn same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap_or(0.0), b.as_f64().unwrap_or(0.0));
            (a - b).abs() <= 1e-5 * a.abs().max(b.abs()).max(1.0)
        }
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            let keys = a.keys().chain(b.keys()).filter(|key| *key != "extras");
            let get = |map: &serde_json::Map<String, Value>, key: &str| {
                map.get(key).cloned().unwrap_or(default_of(key))
            };
            keys.into_iter().all(|key| same(&get(a, key), &get(b, key)))
        }
        (a, b) => a == b,
    }
}

/// What a member that is not there means.
fn default_of(key: &str) -> Value {
    match key {
        "translation" => json!([0, 0, 0]),
        "rotation" => json!([0, 0, 0, 1]),
        "scale" => json!([1, 1, 1]),
        "color" => json!([1, 1, 1]),
        "baseColorFactor" => json!([1, 1, 1, 1]),
        _ => Value::Null,
    }
}

/// What became of an edit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Fate {
    Nothing,
    Patched,
    Anew,
}

fn fate(model: &Model, glb: &[u8], edit: &Edit) -> Result<Fate, String> {
    let (mut document, rest) = parts(glb);
    if !apply(&mut document, edit) {
        return Ok(Fate::Nothing);
    }
    let files = back(&joined(&document, rest))?;
    let anew = files.notes.iter().any(|n| n.code == "edited" && n.is_loss);
    if anew {
        return Ok(Fate::Anew);
    }
    let result = converted(&files);
    for list in [
        "/nodes",
        "/materials",
        "/extensions/KHR_lights_punctual/lights",
    ] {
        let (want, got) = (document.pointer(list), result.pointer(list));
        let none = Value::Array(Vec::new());
        let (want, got) = (want.unwrap_or(&none), got.unwrap_or(&none));
        let pairs = want
            .as_array()
            .into_iter()
            .flatten()
            .zip(got.as_array().into_iter().flatten());
        for (i, (want, got)) in pairs.enumerate() {
            if !same(want, got) {
                return Err(format!(
                    "{} {edit:?}: {list} {i}: {want}, {got}",
                    model.name
                ));
            }
        }
    }
    Ok(Fate::Patched)
}

#[test]
fn edits_arrive_in_the_source() {
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
        let glb = glb_with_source(&text, &folder, &model.loader()).expect("a file");
        for _ in 0..8 {
            let edit = edit().new_tree(&mut runner).expect("an edit").current();
            match fate(&model, &glb, &edit) {
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
    // What is left are edits of one of several uses of a node, and of what the source computes.
    let count = |fate: Fate| fates.get(&fate).copied().unwrap_or_default();
    assert!(count(Fate::Patched) > 4 * count(Fate::Anew), "{fates:?}");
}
