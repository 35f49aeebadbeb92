//! Positions of a `.glb`, read with a JSON parser and f64 alone, so that nothing of the writer and
//! no f32 matrix of a glTF library stands between.

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};
use serde_json::Value;

/// World positions of the vertices of all mesh primitives in the default scene.
///
/// # Errors
///
/// Says what is not as glTF asks.
pub fn world_positions(glb: &[u8]) -> Result<Vec<DVec3>, String> {
    let (json, bin) = chunks(glb).ok_or("not a .glb of a JSON and a BIN chunk")?;
    let root: Value = serde_json::from_slice(json).map_err(|e| e.to_string())?;
    let scene = &root["scenes"][root["scene"].as_u64().unwrap_or(0) as usize];
    let mut positions = Vec::new();
    let mut open: Vec<(u64, DAffine3)> = Vec::new();
    open.extend(indices(&scene["nodes"]).map(|node| (node, DAffine3::IDENTITY)));
    while let Some((node, world_from_parent)) = open.pop() {
        let node = &root["nodes"][node as usize];
        let world_from_local = world_from_parent * parent_from_local(node);
        open.extend(indices(&node["children"]).map(|child| (child, world_from_local)));
        let Some(mesh) = node["mesh"].as_u64() else {
            continue;
        };
        let primitives = root["meshes"][mesh as usize]["primitives"].as_array();
        for primitive in primitives.into_iter().flatten() {
            let accessor = primitive["attributes"]["POSITION"].as_u64();
            let accessor = accessor.ok_or("a primitive without positions")?;
            let local = vectors(&root, bin, accessor).ok_or("positions out of range")?;
            positions.extend(local.map(|p| world_from_local.transform_point3(p)));
        }
    }
    Ok(positions)
}

fn chunks(glb: &[u8]) -> Option<(&[u8], &[u8])> {
    let word = |at: usize| {
        let bytes = glb.get(at..at + 4)?;
        Some(u32::from_le_bytes(bytes.try_into().ok()?) as usize)
    };
    let json_end = 20 + word(12)?;
    let bin_end = json_end + 8 + word(json_end)?;
    let named = glb.get(..4)? == b"glTF" && glb.get(16..20)? == b"JSON";
    let bin_named = glb.get(json_end + 4..json_end + 8)? == b"BIN\0";
    (named && bin_named).then_some(())?;
    Some((glb.get(20..json_end)?, glb.get(json_end + 8..bin_end)?))
}

fn indices(list: &Value) -> impl Iterator<Item = u64> + '_ {
    let list = list.as_array().into_iter().flatten();
    list.filter_map(Value::as_u64)
}

fn numbers<const N: usize>(list: &Value) -> Option<[f64; N]> {
    let list: Vec<f64> = list.as_array()?.iter().filter_map(Value::as_f64).collect();
    list.try_into().ok()
}

fn parent_from_local(node: &Value) -> DAffine3 {
    if let Some(matrix) = numbers::<16>(&node["matrix"]) {
        return DAffine3::from_mat4(DMat4::from_cols_array(&matrix));
    }
    let translation = numbers(&node["translation"]).map_or(DVec3::ZERO, DVec3::from);
    let rotation = numbers(&node["rotation"]).map_or(DQuat::IDENTITY, DQuat::from_array);
    let scale = numbers(&node["scale"]).map_or(DVec3::ONE, DVec3::from);
    let linear = DMat3::from_quat(rotation) * DMat3::from_diagonal(scale);
    DAffine3::from_mat3_translation(linear, translation)
}

/// The f32 vectors of an accessor.
fn vectors<'a>(
    root: &Value,
    bin: &'a [u8],
    accessor: u64,
) -> Option<impl Iterator<Item = DVec3> + use<'a>> {
    const FLOAT: u64 = 5126;
    let accessor = &root["accessors"][accessor as usize];
    (accessor["componentType"].as_u64()? == FLOAT).then_some(())?;
    let view = &root["bufferViews"][accessor["bufferView"].as_u64()? as usize];
    let number = |v: &Value| v.as_u64().unwrap_or(0) as usize;
    let start = number(&view["byteOffset"]) + number(&accessor["byteOffset"]);
    let count = number(&accessor["count"]);
    let stride = number(&view["byteStride"]).max(12);
    let bytes = bin.get(start..start + count.saturating_sub(1) * stride + 12)?;
    Some((0..count).map(move |i| {
        let axis = |k: usize| {
            let at = i * stride + 4 * k;
            let word = [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]];
            f64::from(f32::from_le_bytes(word))
        };
        DVec3::new(axis(0), axis(1), axis(2))
    }))
}
