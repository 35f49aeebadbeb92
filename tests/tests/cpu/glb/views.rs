//! Lights and cameras: there once each, where they were, looking where they looked.

use glam::{DAffine3, DVec3};
use scenegraph::scene::{LightKind, Placement, Scene};
use serde_json::Value;

use super::material::linear;
use super::read::{Glb, Placed, numbers};

/// Of unit vectors and of places as a part of their distance: some dozen roundings in f64 in each
/// of at most ten levels.
const TOLERANCE: f64 = 1e-13;

/// By how much a frame that viewers take for a rotation and a scale may be another one: a few
/// thousandths of a pixel in an image of a thousand.
const FRAME_TOLERANCE: f64 = 3e-6;

/// What is different, in words.
pub fn differences(scene: &Scene, glb: &Glb) -> Vec<String> {
    let lights = scene.lights.iter().enumerate().map(|(i, light)| {
        let (place, direction) = match light.kind {
            LightKind::Directional { direction } => (None, Some(direction)),
            LightKind::Point { location } => (Some(location), None),
            LightKind::Spot {
                location,
                direction,
                ..
            } => (Some(location), Some(direction)),
        };
        let json = &glb.json["extensions"]["KHR_lights_punctual"]["lights"][i];
        let nodes = nodes_with(glb, |node| node.light == Some(i));
        let placed = place_difference(&nodes, &light.placement, place, direction);
        let tinted = color_difference(json, light.color_srgb);
        placed.or(tinted).map(|text| format!("light {i}: {text}"))
    });
    let cameras = scene.cameras.iter().enumerate().map(|(i, camera)| {
        let nodes = nodes_with(glb, |node| node.camera == Some(i));
        let forward = camera.orientation * DVec3::NEG_Z;
        let (place, placement) = (Some(camera.position), &camera.placement);
        let difference = place_difference(&nodes, placement, place, Some(forward));
        difference.map(|text| format!("camera {i}: {text}"))
    });
    lights.chain(cameras).flatten().collect()
}

fn nodes_with(glb: &Glb, test: impl Fn(&Placed) -> bool) -> Vec<&Placed> {
    glb.nodes.iter().filter(|node| test(node)).collect()
}

/// `place` and `direction` are in the frame of `placement`; glTF looks along -Z.
fn place_difference(
    nodes: &[&Placed],
    placement: &Placement,
    place: Option<DVec3>,
    direction: Option<DVec3>,
) -> Option<String> {
    let [node] = nodes else {
        return Some(format!("it has {} nodes", nodes.len()));
    };
    let (got, want): (&DAffine3, &DAffine3) = (&node.world_from_local, &placement.world_from_local);
    if !is_similarity(got) {
        return Some(format!("its frame is no rotation with scale: {got}"));
    }
    if let Some(place) = place {
        let (got, want) = (got.translation, want.transform_point3(place));
        let far = want
            .length()
            .max(placement.world_from_local.translation.length());
        let agrees = got.distance(want) <= TOLERANCE * far;
        if !agrees {
            return Some(format!("it is at {got} for {want}"));
        }
    }
    if let Some(direction) = direction {
        let got = got.transform_vector3(DVec3::NEG_Z).normalize();
        let want = want.transform_vector3(direction).normalize();
        let agrees = got.distance(want) <= TOLERANCE;
        if !agrees {
            return Some(format!("it looks along {got} for {want}"));
        }
    }
    None
}

fn is_similarity(frame: &DAffine3) -> bool {
    let m = frame.matrix3;
    let scale = m.x_axis.length();
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis].map(|axis| axis / scale);
    (x.cross(y) - z).length() <= FRAME_TOLERANCE && (y.cross(z) - x).length() <= FRAME_TOLERANCE
}

fn color_difference(json: &Value, color_srgb: [f64; 3]) -> Option<String> {
    let list = numbers(&json["color"]);
    let got: [f64; 3] = list.try_into().unwrap_or([1.0; 3]);
    let want = color_srgb.map(linear);
    // Written as f32.
    let near = |(got, want): (f64, f64)| (got - want).abs() <= f64::from(f32::EPSILON);
    let agrees = got.into_iter().zip(want).all(near);
    (!agrees).then(|| format!("colour {got:?} for {want:?}"))
}
