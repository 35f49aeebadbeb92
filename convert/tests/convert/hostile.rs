//! Bytes made to break a reader: each gives an error that says what is wrong, and none takes long.

use std::path::Path;
use std::time::{Duration, Instant};

use convert::{ReadLimits, read_gltf};
use serde_json::{Value, json};

use crate::reading::{OneFile, five, floats, glb, read, read_bytes};

/// Far more than any of these takes, far less than one that goes wrong.
const LONG: Duration = Duration::from_secs(20);

/// A sound file: a strip with normals and indices.
fn sound() -> (Value, Vec<u8>) {
    let accessor = json!({"bufferView": 1, "componentType": 5121, "count": 5, "type": "SCALAR"});
    let primitive = json!({"attributes": {"POSITION": 0}, "indices": 1, "mode": 5});
    five(&[0, 1, 2, 3, 4], accessor, primitive)
}

fn error_of(text: &Value, bin: &[u8]) -> String {
    let start = Instant::now();
    let error = read(text, bin).unwrap_err().to_string();
    assert!(start.elapsed() < LONG, "{error}");
    error
}

#[test]
fn each_fault_has_its_error() {
    let rows: &[(&str, Value, &str)] = &[
        (
            "/asset/version",
            json!("1.0"),
            "glTF 1.0 is not supported, only version 2 is",
        ),
        ("/nodes/0/mesh", json!(7), "mesh 7: it does not exist"),
        (
            "/nodes/0/children",
            json!([0]),
            "node 0: it has several parents, or is below itself",
        ),
        ("/nodes/0/children", json!([9]), "node 9: it does not exist"),
        (
            "/scenes/0/nodes",
            json!([0, 0]),
            "node 0: it has several parents, or is below itself",
        ),
        ("/nodes/0/camera", json!(0), "camera 0: it does not exist"),
        (
            "/nodes/0/extensions",
            json!({"KHR_lights_punctual": {"light": 0}}),
            "light 0: it does not exist",
        ),
        ("/nodes/0/scale", json!([1e300, 1, 1]), ""),
        ("/nodes/0/matrix", json!(1), "not a glTF text"),
        ("/scene", json!(1), "scene 1: it does not exist"),
        (
            "/extensionsRequired",
            json!(["KHR_draco_mesh_compression"]),
            "the extension KHR_draco_mesh_compression is required and not supported",
        ),
        (
            "/meshes/0/primitives/0/indices",
            json!(0),
            "accessor 0: its type does not suit its use",
        ),
        (
            "/meshes/0/primitives/0/indices",
            json!(5),
            "accessor 5: it does not exist",
        ),
        (
            "/meshes/0/primitives/0/material",
            json!(0),
            "material 0: it does not exist",
        ),
        (
            "/meshes/0/primitives/0/attributes/NORMAL",
            json!(1),
            "accessor 1: its type does not suit its use",
        ),
        (
            "/accessors/0/count",
            json!(4),
            "accessor 1: an index is not below the number of vertices",
        ),
        (
            "/accessors/0/count",
            json!(6),
            "accessor 0: it reaches beyond its buffer view",
        ),
        (
            "/accessors/0/count",
            json!(4_000_000_000_u64),
            "accessor 0: it reaches beyond its buffer view",
        ),
        (
            "/accessors/0/count",
            json!(u64::MAX),
            "accessor 0: its count is too large",
        ),
        (
            "/accessors/0/byteOffset",
            json!(u64::MAX),
            "accessor 0: it reaches beyond its buffer view",
        ),
        (
            "/accessors/0/componentType",
            json!(5),
            "accessor 0: its component type is unknown",
        ),
        (
            "/accessors/1/componentType",
            json!(5120),
            "accessor 1: indices are unsigned integers",
        ),
        (
            "/accessors/1/count",
            json!(4_000_000_000_u64),
            "accessor 1: it reaches beyond its buffer view",
        ),
        (
            "/bufferViews/0/byteStride",
            json!(4),
            "accessor 0: its elements overlap",
        ),
        (
            "/bufferViews/0/byteStride",
            json!(u64::MAX),
            "accessor 0: it reaches beyond its buffer view",
        ),
        (
            "/bufferViews/0/byteLength",
            json!(u64::MAX),
            "buffer view 0: it reaches beyond its buffer",
        ),
        (
            "/bufferViews/0/byteOffset",
            json!(u64::MAX),
            "buffer view 0: it reaches beyond its buffer",
        ),
        (
            "/bufferViews/0/buffer",
            json!(1),
            "buffer view 0: its buffer does not exist",
        ),
        (
            "/buffers/0/uri",
            json!("other.bin"),
            "buffer 0: other.bin: it was not found",
        ),
        (
            "/buffers/0/uri",
            json!("data:,x"),
            "buffer 0: its data URI is not base64",
        ),
    ];
    for (at, value, want) in rows {
        let (mut text, bin) = sound();
        assert!(read(&text, &bin).is_ok(), "the file is sound before");
        let (parent, key) = at.rsplit_once('/').unwrap();
        text.pointer_mut(parent).unwrap()[key] = value.clone();
        if want.is_empty() {
            assert!(read(&text, &bin).is_ok(), "{at}");
        } else {
            let error = error_of(&text, &bin);
            assert!(error.starts_with(want), "{at} = {value}: {error}");
        }
    }
}

#[test]
fn numbers_that_are_not_finite() {
    let accessor = json!({"bufferView": 1, "componentType": 5126, "count": 5, "type": "VEC3"});
    let primitive = json!({"attributes": {"POSITION": 1}});
    for value in [f32::NAN, f32::INFINITY] {
        let (text, bin) = five(&floats(&[value; 15]), accessor.clone(), primitive.clone());
        assert_eq!(error_of(&text, &bin), "accessor 1: a number is not finite");
    }
    let (mut text, bin) = sound();
    text["nodes"] = json!([
        {"scale": [1e300, 1, 1], "children": [1]},
        {"scale": [1e300, 1, 1], "mesh": 0},
    ]);
    assert_eq!(error_of(&text, &bin), "node 1: its transform is not finite");
}

#[test]
fn counts_that_would_fill_the_memory() {
    // Zeros without a buffer cost nothing in the file.
    let zeros = json!({"componentType": 5126, "count": 4_000_000_000_u32, "type": "VEC3"});
    let (text, bin) = five(&[], zeros.clone(), json!({"attributes": {"POSITION": 1}}));
    assert!(error_of(&text, &bin).contains("bytes of geometry"));
    let zeros = json!({"componentType": 5125, "count": 4_000_000_000_u32, "type": "SCALAR"});
    let (text, bin) = five(
        &[],
        zeros,
        json!({"attributes": {"POSITION": 0}, "indices": 1, "mode": 6}),
    );
    assert!(error_of(&text, &bin).contains("bytes of geometry"));

    // Many arrays out of the same bytes.
    let bytes = vec![0; 12 << 20];
    let count = bytes.len() as u64 / 12 - 2000;
    let (mut text, bin) = five(&bytes, json!({}), json!({}));
    let accessors = (0..2000).map(|i| {
        json!({"bufferView": 1, "byteOffset": 4 * i, "componentType": 5126, "count": count, "type": "VEC3"})
    });
    text["accessors"] = accessors.collect();
    let primitives = (0..2000).map(|i| json!({"attributes": {"POSITION": i}, "mode": 0}));
    text["meshes"] = json!([{"primitives": primitives.collect::<Vec<_>>()}]);
    assert!(error_of(&text, &bin).contains("bytes of geometry"));

    // Many nodes, each with many primitives.
    let (mut text, bin) = sound();
    let primitive = text["meshes"][0]["primitives"][0].clone();
    text["meshes"] = json!([{"primitives": vec![primitive; 2000]}]);
    text["nodes"] = json!(vec![json!({"mesh": 0}); 2000]);
    text["scenes"] = json!([{"nodes": (0..2000).collect::<Vec<_>>()}]);
    let limits = ReadLimits {
        items: 10_000,
        ..ReadLimits::default()
    };
    let bytes = glb(&text, &bin);
    let error = read_gltf(&bytes, "", Path::new(""), &OneFile(Vec::new()), &limits);
    let error = error.unwrap_err().to_string();
    assert_eq!(error, "more than 10000 nodes and instances");
}

#[test]
fn nodes_in_a_long_chain() {
    let (mut text, bin) = sound();
    let count = 100_000;
    let chain = (0..count).map(|i| {
        if i + 1 < count {
            json!({"children": [i + 1]})
        } else {
            json!({"mesh": 0})
        }
    });
    text["nodes"] = chain.collect();
    assert_eq!(error_of(&text, &bin), "more than 4000 levels of nodes");
    text["nodes"][count - 1] = json!({"children": [0]});
    text["scenes"] = json!([{"nodes": [count - 3000]}]);
    let error = error_of(&text, &bin);
    assert!(error.starts_with("more than 4000 levels"), "{error}");
    // Not nested for the parser of the text either.
    let nested = [b"[".repeat(1 << 20), b"]".repeat(1 << 20)].concat();
    assert!(read_bytes(&nested, Vec::new()).is_err());
}

#[test]
fn every_cut_of_a_file_is_an_error() {
    let (text, bin) = sound();
    let whole = glb(&text, &bin);
    assert!(read_bytes(&whole, Vec::new()).is_ok());
    for end in 0..whole.len() {
        assert!(read_bytes(&whole[..end], Vec::new()).is_err(), "{end}");
    }
    for word in [2, 3, 4] {
        for value in [0, 1, u32::MAX] {
            let mut broken = whole.clone();
            let at = 4 * word - 4;
            broken[at..at + 4].copy_from_slice(&value.to_le_bytes());
            assert!(
                read_bytes(&broken, Vec::new()).is_err(),
                "word {word} = {value}"
            );
        }
    }
}
