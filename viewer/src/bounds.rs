//! Boxes of instances.

use geometry::bounds::Aabb;
use scenegraph::scene::Scene;

/// The world box of each instance.
pub fn instance_boxes(scene: &Scene) -> Vec<Aabb> {
    let local: Vec<Aabb> = scene.meshes.iter().map(|m| (0..m.positions.len() as u32).map(|i| m.p_in_local(i)).collect()).collect();
    scene.instances.iter().map(|i| local[i.mesh.index()].transformed(&i.placement.world_from_local)).collect()
}
