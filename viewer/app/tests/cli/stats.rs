//! `--stats`: the keys that docs/STATS.md promises, and what they say.

use std::collections::BTreeSet;

use serde_json::Value;

use crate::place::{CUBE, Place, repository};

/// All keys below a value, as the document writes them. Lists of numbers are values.
fn keys(value: &Value, path: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(object) => {
            for (key, value) in object {
                let dot = if path.is_empty() { "" } else { "." };
                keys(value, &format!("{path}{dot}{key}"), found);
            }
        }
        Value::Array(list) if list.iter().any(Value::is_object) => {
            for value in list {
                keys(value, &format!("{path}[]"), found);
            }
        }
        // An empty list has no members to tell keys by; another pass has.
        Value::Array(list) if list.is_empty() => {}
        _ => {
            found.insert(path.to_owned());
        }
    }
}

#[test]
fn keys_are_those_of_the_document() {
    let document = std::fs::read_to_string(repository().join("docs/STATS.md")).unwrap();
    let rows = document.lines().filter_map(|line| line.strip_prefix("| `"));
    let promised: BTreeSet<String> = rows
        .map(|row| row.split_once('`').unwrap().0.to_owned())
        .collect();
    let place = Place::new().sample("lights/three_kinds.iv");
    let run = place.run("three_kinds.iv -o a.png --stats sub/stats.json");
    assert_eq!((run.code, run.out.as_str()), (0, ""), "{}", run.err);
    let stats = serde_json::from_slice(&place.bytes("sub/stats.json")).unwrap();
    let mut found = BTreeSet::new();
    keys(&stats, "", &mut found);
    assert_eq!(found, promised);
}

#[test]
fn statistics_say_what_was_drawn() {
    let place = Place::new()
        .file("cube.iv", CUBE)
        .file(
            "dark.iv",
            "#Inventor V2.1 ascii\nDEF Off PointLight { intensity 0 } Cube { }\n",
        )
        .sample("lights/gate_shadow.iv")
        .sample("textures/inline_image.iv")
        .glb_of("cube.iv");
    // Arguments, place in the document, value.
    let rows: &[(&str, &str, Value)] = &[
        ("cube.iv", "/format", "inventor".into()),
        ("cube.glb", "/format", "gltf".into()),
        ("cube.iv", "/model", "cube.iv".into()),
        ("cube.iv", "/adapter/is_software", true.into()),
        ("cube.iv", "/settings/width", 64.into()),
        ("cube.iv", "/settings/height", 48.into()),
        ("cube.iv --msaa 4", "/settings/samples", 4.into()),
        ("cube.iv --shadows none", "/settings/shadows", "none".into()),
        ("cube.iv", "/scene/triangles/instanced", 12.into()),
        ("cube.iv", "/scene/lights", 0.into()),
        ("cube.iv", "/lights/0/kind", "headlight".into()),
        ("cube.iv", "/passes/0/kind", "first".into()),
        ("cube.iv", "/passes/0/light", 0.into()),
        ("cube.iv", "/passes/0/primitives", 12.into()),
        ("cube.iv", "/passes/1", Value::Null),
        ("cube.iv --no-headlight", "/lights/0", Value::Null),
        ("dark.iv", "/lights/0/name", "Off".into()),
        ("dark.iv", "/lights/0/kind", "point".into()),
        ("dark.iv", "/lights/0/skipped", "black light".into()),
        ("gate_shadow.iv", "/passes/1/kind", "volumes".into()),
        ("gate_shadow.iv", "/passes/2/kind", "first".into()),
        ("gate_shadow.iv", "/lights/0/skipped", Value::Null),
        ("gate_shadow.iv --shadows none", "/passes/1", Value::Null),
        ("inline_image.iv", "/scene/images", 1.into()),
    ];
    for (args, at, value) in rows {
        let stats = place.stats(args);
        let found = stats.pointer(at).unwrap_or(&Value::Null);
        assert_eq!(found, value, "{args}: {at}");
    }
    let stats = place.stats("gate_shadow.iv");
    let volumes = &stats["passes"][1];
    let count = |key| volumes[key].as_u64().unwrap();
    assert!(count("z_pass") + count("z_fail") > 0, "{volumes}");
    assert!(count("primitives") > 0, "{volumes}");
    let bytes = &stats["device_bytes"];
    let parts = ["meshes", "textures", "casters", "shadows", "images"];
    let sum: u64 = parts.iter().map(|key| bytes[key].as_u64().unwrap()).sum();
    assert_eq!(bytes["total"].as_u64(), Some(sum));
    // 36 indices and 24 corners with normals at least.
    assert!(bytes["meshes"].as_u64().unwrap() >= 36 * 4 + 24 * 24);
    let times = stats["times_ms"].as_object().unwrap();
    let time = |key: &str| times[key].as_f64().unwrap();
    for key in ["read", "device", "draw", "png"] {
        assert!(time(key) > 0.0, "{key}: {times:?}");
    }
    // Nothing is counted twice; roundings are half a microsecond each.
    let parts = times.keys().filter(|key| *key != "total");
    let sum: f64 = parts.map(|key| time(key)).sum();
    assert!(sum <= time("total") + 0.01, "{times:?}");
}
