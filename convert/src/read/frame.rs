//! The frames of nodes, in f64, and those of copies (`EXT_mesh_gpu_instancing`).

use glam::{DAffine3, DQuat, DVec3, DVec4};
use gltf::json::Index;
use gltf::json::Node as JsonNode;

use super::accessor::Accessor;
use super::budget::Budget;
use super::buffers::Buffers;
use super::document::{Document, ExactNode};
use super::error::ReadError;

/// A node's frame in that of its parent. The last row of a matrix is taken for 0 0 0 1, as glTF
/// demands.
pub(crate) fn parent_from_local(node: &ExactNode) -> DAffine3 {
    if let Some(m) = &node.matrix {
        let columns = [0, 4, 8, 12].map(|i| DVec3::new(m[i], m[i + 1], m[i + 2]));
        let [x, y, z, translation] = columns;
        return DAffine3 {
            matrix3: glam::DMat3::from_cols(x, y, z),
            translation,
        };
    }
    let translation = node.translation.map_or(DVec3::ZERO, DVec3::from);
    let scale = node.scale.map_or(DVec3::ONE, DVec3::from);
    let rotation = rotation(node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]));
    DAffine3::from_scale_rotation_translation(scale, rotation, translation)
}

/// A quaternion at unit length; no rotation if it has none. One that is a unit quaternion but for
/// rounding stays as it is.
fn rotation(quaternion: [f64; 4]) -> DQuat {
    let v = DVec4::from(quaternion);
    let length_squared = v.length_squared();
    // Four squares and three sums.
    let tolerance = 8.0 * f64::EPSILON;
    if (length_squared - 1.0).abs() <= tolerance {
        return DQuat::from_vec4(v);
    }
    v.try_normalize().map_or(DQuat::IDENTITY, DQuat::from_vec4)
}

/// The frames of a node's copies in the node's own; just one, the identity, without the extension.
pub(crate) fn copies(
    node: &JsonNode,
    document: &Document,
    buffers: &Buffers,
    budget: &mut Budget,
) -> Result<Vec<DAffine3>, ReadError> {
    let extensions = node.extensions.as_ref();
    let instancing = extensions.and_then(|e| e.others.get("EXT_mesh_gpu_instancing"));
    let Some(attributes) = instancing.and_then(|instancing| instancing.get("attributes")) else {
        return Ok(vec![DAffine3::IDENTITY]);
    };
    let mut open = |name: &str, width: usize| {
        let number = attributes.get(name).and_then(serde_json::Value::as_u64);
        let Some(number) = number else {
            return Ok(None);
        };
        // A number beyond all accessors, as any other that does not exist.
        let index = Index::new(u32::try_from(number).unwrap_or(u32::MAX));
        let accessor = Accessor::open(document, buffers, index, &[width], budget)?;
        Ok(Some(accessor))
    };
    let translations = open("TRANSLATION", 3)?;
    // Integers are shares here, as with the rotations of animations.
    let rotations = open("ROTATION", 4)?.map(Accessor::into_normalized);
    let scales = open("SCALE", 3)?;
    let all = [&translations, &rotations, &scales];
    let count = all.iter().filter_map(|a| a.as_ref()).map(Accessor::count);
    let Some(count) = count.min() else {
        return Ok(vec![DAffine3::IDENTITY]);
    };
    budget.take_items(count)?;
    let frame = |i: usize| {
        let triple = |a: &Option<Accessor>, otherwise: DVec3| {
            a.as_ref()
                .map_or(otherwise, |a| DVec3::from(a.floats(i).map(f64::from)))
        };
        let turned = |a: &Accessor| rotation(a.floats(i).map(f64::from));
        let rotation = rotations.as_ref().map_or(DQuat::IDENTITY, turned);
        let (translation, scale) = (
            triple(&translations, DVec3::ZERO),
            triple(&scales, DVec3::ONE),
        );
        DAffine3::from_scale_rotation_translation(scale, rotation, translation)
    };
    Ok((0..count).map(frame).collect())
}
