//! Accessors of any form as f64, by the words of the glTF specification and `KHR_mesh_quantization`.

use glam::{DAffine3, DQuat, DVec3};
use serde_json::Value;

use crate::read::{Converted, numbers};

/// The elements of accessor `index`, components side by side.
pub fn elements(json: &Value, bin: &[u8], index: usize) -> Vec<Vec<f64>> {
    let accessor = &json["accessors"][index];
    let view = &json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
    let width = match accessor["type"].as_str().unwrap() {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" => 4,
        other => panic!("{other}"),
    };
    let component = accessor["componentType"].as_u64().unwrap();
    let size = match component {
        5120 | 5121 => 1,
        5122 | 5123 => 2,
        5125 | 5126 => 4,
        other => panic!("{other}"),
    };
    let number = |bytes: &[u8]| -> (f64, f64) {
        match component {
            5120 => (f64::from(bytes[0] as i8), 127.0),
            5121 => (f64::from(bytes[0]), 255.0),
            5122 => (
                f64::from(i16::from_le_bytes(bytes.try_into().unwrap())),
                32767.0,
            ),
            5123 => (
                f64::from(u16::from_le_bytes(bytes.try_into().unwrap())),
                65535.0,
            ),
            5125 => (
                f64::from(u32::from_le_bytes(bytes.try_into().unwrap())),
                1.0,
            ),
            _ => (
                f64::from(f32::from_le_bytes(bytes.try_into().unwrap())),
                1.0,
            ),
        }
    };
    let normalized = accessor["normalized"].as_bool().unwrap_or(false);
    let stride = view["byteStride"].as_u64().unwrap_or(width * size) as usize;
    let offset = |of: &Value| of["byteOffset"].as_u64().unwrap_or(0) as usize;
    let start = offset(accessor) + offset(view);
    let (width, size) = (width as usize, size as usize);
    let component = |at: usize| {
        let (value, most) = number(&bin[at..at + size]);
        if normalized {
            (value / most).max(-1.0)
        } else {
            value
        }
    };
    (0..accessor["count"].as_u64().unwrap() as usize)
        .map(|i| {
            (0..width)
                .map(|k| component(start + i * stride + k * size))
                .collect()
        })
        .collect()
}

/// One corner of a primitive.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Corner {
    pub p_in_world: DVec3,
    /// Not turned into the world.
    pub normal: Vec<f64>,
    pub texcoord: Vec<f64>,
    pub color_linear: Vec<f64>,
}

/// The corners of all meshes, node by node in order of depth.
pub fn corners(converted: &Converted) -> Vec<Vec<Corner>> {
    let (json, bin) = (&converted.json, &converted.bin[..]);
    let mut all = Vec::new();
    for placed in converted.placed_with("/mesh") {
        let mesh = converted.nodes()[placed.index]["mesh"].as_u64().unwrap() as usize;
        for copy in copies(json, bin, &converted.nodes()[placed.index]) {
            let at = placed.world_from_local * copy;
            for primitive in json["meshes"][mesh]["primitives"].as_array().unwrap() {
                all.push(corners_of(json, bin, primitive, &at));
            }
        }
    }
    all
}

/// `EXT_mesh_gpu_instancing`.
fn copies(json: &Value, bin: &[u8], node: &Value) -> Vec<DAffine3> {
    let attributes = &node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    let attribute = |name: &str| {
        let index = attributes[name].as_u64();
        index.map(|index| elements(json, bin, index as usize))
    };
    let Some(translations) = attribute("TRANSLATION") else {
        return vec![DAffine3::IDENTITY];
    };
    let (rotations, scales) = (attribute("ROTATION"), attribute("SCALE"));
    let frame = |i: usize| {
        let scale = scales
            .as_ref()
            .map_or(DVec3::ONE, |s| DVec3::from_slice(&s[i]));
        let rotation = rotations
            .as_ref()
            .map_or(DQuat::IDENTITY, |r| DQuat::from_slice(&r[i]));
        let translation = DVec3::from_slice(&translations[i]);
        DAffine3::from_scale_rotation_translation(scale, rotation.normalize(), translation)
    };
    (0..translations.len()).map(frame).collect()
}

fn corners_of(json: &Value, bin: &[u8], primitive: &Value, at: &DAffine3) -> Vec<Corner> {
    let attribute = |name: &str| {
        let index = primitive["attributes"][name].as_u64();
        index.map(|index| elements(json, bin, index as usize))
    };
    let positions = attribute("POSITION").unwrap();
    let [normals, texcoords, colors] = ["NORMAL", "TEXCOORD_0", "COLOR_0"].map(attribute);
    let indices: Vec<usize> = match primitive["indices"].as_u64() {
        Some(index) => {
            let indices = elements(json, bin, index as usize);
            indices.iter().map(|i| i[0] as usize).collect()
        }
        None => (0..positions.len()).collect(),
    };
    let of = |list: &Option<Vec<Vec<f64>>>, i: usize| {
        list.as_ref().map_or(Vec::new(), |list| list[i].clone())
    };
    indices
        .into_iter()
        .map(|i| Corner {
            p_in_world: at.transform_point3(DVec3::from_slice(&positions[i])),
            normal: of(&normals, i),
            texcoord: of(&texcoords, i),
            color_linear: of(&colors, i),
        })
        .collect()
}

/// The bounds that an accessor states hold its elements, and are some of them.
pub fn check_bounds(converted: &Converted) {
    let accessors = converted.json["accessors"].as_array().unwrap();
    for (index, accessor) in accessors.iter().enumerate() {
        if accessor.get("min").is_none() {
            continue;
        }
        let elements = elements(&converted.json, &converted.bin, index);
        for axis in 0..3 {
            let values = || elements.iter().map(|e| e[axis]);
            // Floats stand in the text with as few digits as f32 needs.
            let stated = |name: &str| numbers(&accessor[name])[axis] as f32;
            assert_eq!(values().fold(f64::INFINITY, f64::min) as f32, stated("min"));
            assert_eq!(
                values().fold(-f64::INFINITY, f64::max) as f32,
                stated("max")
            );
        }
    }
}
