//! The guarantees of the scene that the writer leans on, checked in one cheap pass, so that a
//! scene made by hand cannot make it fail later.

use scenegraph::scene::{MaterialId, Mesh, Placement, Scene, Topology};

use crate::Error;

pub(crate) fn check(scene: &Scene) -> Result<(), Error> {
    let nodes = scene.nodes.len();
    let placed = |p: &Placement| p.node.is_none_or(|n| n.index() < nodes);
    let mut parents = scene.nodes.iter().map(|n| n.parent).enumerate();
    ensure(
        parents.all(|(i, parent)| parent.is_none_or(|p| p.index() < i)),
        "a group does not stand behind its parent",
    )?;
    ensure(
        scene.instances.iter().all(|instance| {
            placed(&instance.placement)
                && instance.mesh.index() < scene.meshes.len()
                && instance.material.index() < scene.materials.len()
                && instance.light_set.index() < scene.light_sets.len()
                && instance.environment.index() < scene.environments.len()
        }),
        "an instance refers to something that is not there",
    )?;
    ensure(
        scene.lights.iter().all(|light| {
            placed(&light.placement) && light.environment.index() < scene.environments.len()
        }) && scene.cameras.iter().all(|camera| placed(&camera.placement)),
        "a light or camera refers to something that is not there",
    )?;
    ensure(
        (scene.nodes.iter()).all(|node| node.level().is_none() || node.parent.is_some()),
        "a level of detail has no group around it",
    )?;
    ensure(
        scene.variants.iter().all(|variant| {
            let in_range = |&(instance, material): &(u32, MaterialId)| {
                (instance as usize) < scene.instances.len()
                    && material.index() < scene.materials.len()
            };
            variant.materials.iter().all(in_range)
                && variant.materials.is_sorted_by(|a, b| a.0 < b.0)
        }),
        "a variant refers to something that is not there",
    )?;
    let mut textures = scene
        .materials
        .iter()
        .filter_map(|material| material.texture);
    ensure(
        textures.all(|texture| texture.index() < scene.textures.len()),
        "a material refers to a texture that is not there",
    )?;
    ensure(
        scene.meshes.iter().all(is_sound),
        "a mesh is empty or its arrays do not match",
    )
}

fn is_sound(mesh: &Mesh) -> bool {
    let vertices = mesh.positions.len();
    let step = match mesh.topology {
        Topology::Triangles => 3,
        Topology::Lines => 2,
        Topology::Points => 1,
    };
    let matches = |len: usize| len == 0 || len == vertices;
    vertices > 0
        && !mesh.indices.is_empty()
        && mesh.indices.len().is_multiple_of(step)
        && matches(mesh.normals.len())
        && matches(mesh.texcoords.len())
        && matches(mesh.colors_srgb.len())
}

fn ensure(holds: bool, otherwise: &str) -> Result<(), Error> {
    if holds {
        Ok(())
    } else {
        Err(Error::Scene(otherwise.to_owned()))
    }
}
