//! The whole model in the axes and the unit that glTF means: +Y upwards, metres.
//!
//! A group around all does it, so the model's own frames stay what they are. What Inventor measures
//! in the world's unit, whatever frame it stands in, is put into the new one.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use iv_parser::SourcePos;
use scenegraph::scene::{Coarser, Environment, Node, NodeId, Placement, Scene, Shown};

use crate::{Options, Up};

/// The turn and scale that the options ask for; `None` if none.
fn world_from_model(options: &Options) -> Option<DAffine3> {
    if options.up == Up::Y && options.metres_per_unit == 1.0 {
        return None;
    }
    let turn = match options.up {
        Up::Y => DMat3::IDENTITY,
        // Y goes to -Z, Z to Y.
        Up::Z => DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y),
    };
    Some(DAffine3::from_mat3(turn * options.metres_per_unit))
}

/// Puts a group around all, if the options ask for one.
pub(crate) fn turn(scene: &mut Scene, options: &Options) {
    let Some(world_from_model) = world_from_model(options) else {
        return;
    };
    let behind = |id: NodeId| NodeId(id.0 + 1);
    let root = Some(NodeId(0));
    for node in &mut scene.nodes {
        node.parent = node.parent.map_or(root, |parent| Some(behind(parent)));
        if let Shown::Level(Coarser::Beyond(distance)) = &mut node.shown {
            *distance *= options.metres_per_unit;
        }
    }
    let group = Node {
        parent: None,
        name: None,
        class: Arc::from("Separator"),
        notes: Vec::new(),
        link: None,
        parent_from_local: world_from_model,
        shown: Shown::Always,
        pos: SourcePos::default(),
    };
    scene.nodes.insert(0, group);
    let within = |placement: &mut Placement| {
        placement.node = placement.node.map_or(root, |node| Some(behind(node)));
        placement.world_from_local = world_from_model * placement.world_from_local;
    };
    scene
        .instances
        .iter_mut()
        .for_each(|i| within(&mut i.placement));
    scene
        .lights
        .iter_mut()
        .for_each(|l| within(&mut l.placement));
    scene
        .cameras
        .iter_mut()
        .for_each(|c| within(&mut c.placement));
    for light in &mut scene.lights {
        let radius = light.radius_in_world.map(|r| r * options.metres_per_unit);
        light.radius_in_world = radius;
    }
    for environment in &mut scene.environments {
        measure(environment, options.metres_per_unit);
    }
}

/// Distances in the new unit, of which the old one has `scale`.
fn measure(environment: &mut Environment, scale: f64) {
    let [square, linear, constant] = environment.attenuation;
    environment.attenuation = [square / (scale * scale), linear / scale, constant];
    if let Some(fog) = &mut environment.fog {
        fog.visibility *= scale;
    }
}
