//! A reader of the output that shares no code with the writer: the container by hand, the text
//! with `serde_json` (whose numbers are f64), the arrays with the `gltf` crate.

use std::fs;
use std::sync::atomic::{AtomicUsize, Ordering};

use convert::{Options, Report, TextureLoader, write_glb};
use glam::{DAffine3, DQuat, DVec3};
use scenegraph::scene::Scene;
use serde_json::Value;

use crate::scenes::Images;

/// A converted scene.
pub struct Converted {
    pub bytes: Vec<u8>,
    pub report: Report,
    pub json: Value,
    pub bin: Vec<u8>,
}

pub fn convert(scene: &Scene) -> Converted {
    convert_with(scene, &Options::default(), &Images::default())
}

pub fn convert_with(scene: &Scene, options: &Options, images: &dyn TextureLoader) -> Converted {
    assert_eq!(scene.check(), [], "the test's own scene");
    let mut bytes = Vec::new();
    let report = write_glb(scene, options, images, &mut bytes).unwrap();
    assert_eq!(report.counts.bytes, bytes.len() as u64);
    dump(&bytes);
    let (json, bin) = split(&bytes);
    let json: Value = serde_json::from_slice(json).unwrap();
    let bin = bin.to_vec();
    Converted {
        bytes,
        report,
        json,
        bin,
    }
}

fn dump(bytes: &[u8]) {
    static NUMBER: AtomicUsize = AtomicUsize::new(0);
    if let Some(folder) = std::env::var_os("GLTF_DUMP") {
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        fs::write(
            std::path::Path::new(&folder).join(format!("{number}.glb")),
            bytes,
        )
        .unwrap();
    }
}

/// The two chunks of a `.glb`, with every length checked.
pub fn split(bytes: &[u8]) -> (&[u8], &[u8]) {
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!(&bytes[..4], b"glTF");
    assert_eq!((word(4), word(8)), (2, bytes.len()));
    assert_eq!(&bytes[16..20], b"JSON");
    let json_end = 20 + word(12);
    assert_eq!(json_end % 4, 0);
    if json_end == bytes.len() {
        return (&bytes[20..json_end], &[]);
    }
    assert_eq!(&bytes[json_end + 4..json_end + 8], b"BIN\0");
    assert_eq!(json_end + 8 + word(json_end), bytes.len());
    assert_eq!(bytes.len() % 4, 0);
    (&bytes[20..json_end], &bytes[json_end + 8..])
}

/// A node as it stands in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    pub index: usize,
    pub name: Option<String>,
    pub world_from_local: DAffine3,
}

impl Converted {
    pub fn nodes(&self) -> &[Value] {
        self.json["nodes"].as_array().map_or(&[], |nodes| nodes)
    }

    /// All nodes by depth first from the scene's roots; each must be reached once.
    pub fn placed(&self) -> Vec<Placed> {
        let mut placed = Vec::new();
        let roots = indices(&self.json["scenes"][0]["nodes"]);
        let mut open: Vec<_> = roots
            .into_iter()
            .rev()
            .map(|i| (i, DAffine3::IDENTITY))
            .collect();
        while let Some((index, world_from_parent)) = open.pop() {
            let node = &self.nodes()[index];
            let world_from_local = world_from_parent * local_transform(node);
            let name = node["name"].as_str().map(str::to_owned);
            placed.push(Placed {
                index,
                name,
                world_from_local,
            });
            let children = indices(&node["children"]).into_iter().rev();
            open.extend(children.map(|child| (child, world_from_local)));
        }
        let mut seen: Vec<_> = placed.iter().map(|p| p.index).collect();
        seen.sort_unstable();
        assert_eq!(seen, (0..self.nodes().len()).collect::<Vec<_>>());
        placed
    }

    /// Transforms of the nodes whose value at `pointer` is there.
    pub fn placed_with(&self, pointer: &str) -> Vec<Placed> {
        let mut placed = self.placed();
        placed.retain(|p| self.nodes()[p.index].pointer(pointer).is_some());
        placed
    }

    pub fn at(&self, pointer: &str) -> &Value {
        self.json.pointer(pointer).unwrap_or(&Value::Null)
    }

    /// Parsed by the `gltf` crate, which validates as it does.
    pub fn gltf(&self) -> gltf::Gltf {
        gltf::Gltf::from_slice(&self.bytes).unwrap()
    }
}

pub fn indices(list: &Value) -> Vec<usize> {
    let list = list.as_array().map_or(&[][..], |list| list);
    list.iter().map(|i| i.as_u64().unwrap() as usize).collect()
}

pub fn numbers(list: &Value) -> Vec<f64> {
    list.as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect()
}

fn local_transform(node: &Value) -> DAffine3 {
    let vec3 = |key: &str, default: DVec3| {
        if node[key].is_null() {
            default
        } else {
            DVec3::from_slice(&numbers(&node[key]))
        }
    };
    let rotation = match &node["rotation"] {
        Value::Null => DQuat::IDENTITY,
        list => DQuat::from_slice(&numbers(list)),
    };
    assert!((rotation.length() - 1.0).abs() < 1e-14);
    DAffine3::from_scale_rotation_translation(
        vec3("scale", DVec3::ONE),
        rotation,
        vec3("translation", DVec3::ZERO),
    )
}

/// Whether two transforms agree to the roundings of a few products.
pub fn assert_near(got: &DAffine3, want: &DAffine3) {
    let size = want
        .to_cols_array()
        .iter()
        .fold(1.0_f64, |a, x| a.max(x.abs()));
    let pairs = got.to_cols_array().into_iter().zip(want.to_cols_array());
    for (g, w) in pairs {
        assert!((g - w).abs() <= 1e-14 * size, "{got}\n{want}");
    }
}
