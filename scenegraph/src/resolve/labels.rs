//! `Text2`: text that faces the viewer and keeps its size in pixels, as text in the world.
//!
//! It is given the direction and the size that it has in one view of [`VIEW_HEIGHT_PX`] pixels: that
//! of the first camera, if the text is before it; without one, a view along -Z that is as high as
//! the scene's diagonal. The size of a pixel is held within [`PIXELS`] of the diagonal, because
//! cameras of files often stand anywhere. The text stays where it hangs in the hierarchy, unless
//! its group's frame has no inverse.

use geometry::bounds::Aabb;
use glam::{DAffine3, DQuat, DVec3};

use crate::scene::{Projection, Scene, is_below};
use crate::shape::Measure;

/// Height of the window that the text is seen in.
const VIEW_HEIGHT_PX: f64 = 600.0;

/// Pixels that the diagonal of the scene may have, at least and at most.
const PIXELS: [f64; 2] = [200.0, 5000.0];

/// Gives each label, whose mesh is in pixels, its frame.
pub fn settle(scene: &mut Scene, measures: &[Measure], labels: &[u32]) {
    if labels.is_empty() {
        return;
    }
    let view = View::of(scene, measures, labels);
    let mut worlds: Vec<Option<DAffine3>> = vec![None; scene.nodes.len()];
    for i in 0..scene.nodes.len() {
        let node = &scene.nodes[i];
        let parent = node.parent.and_then(|p| worlds[p.index()]);
        worlds[i] = Some(parent.unwrap_or_default() * node.parent_from_local);
    }
    for &index in labels {
        let placement = &mut scene.instances[index as usize].placement;
        let anchor = placement.world_from_local.translation;
        let wanted = DAffine3::from_scale_rotation_translation(
            DVec3::splat(view.pixel(anchor)),
            view.world_from_eye,
            anchor,
        );
        let group = placement.node.and_then(|id| worlds[id.index()]);
        let group = group.unwrap_or_default();
        let local = group.inverse() * wanted;
        let world = group * local;
        // Where the inverse has lost the place, the text hangs at the root.
        let kept = world.is_finite() && world.abs_diff_eq(wanted, 1e-6 * view.diagonal);
        if !kept {
            placement.node = None;
        }
        placement.parent_from_local = if kept { local } else { wanted };
        placement.world_from_local = if kept { world } else { wanted };
    }
}

/// The view that labels are sized for.
struct View {
    world_from_eye: DQuat,
    /// Diagonal of the scene; 1 for none.
    diagonal: f64,
    camera: Option<Camera>,
}

/// A camera: the eye, the direction it looks in, and how high its view is at a distance.
struct Camera {
    eye: DVec3,
    forward: DVec3,
    height: f64,
    height_by_distance: f64,
}

impl View {
    fn of(scene: &Scene, measures: &[Measure], labels: &[u32]) -> Self {
        let bounds = bounds(scene, measures, labels);
        let diagonal = bounds.size().length();
        let camera = scene.cameras.first();
        let world_from_eye = camera.map(|camera| {
            let (_, rotation, _) = camera
                .placement
                .world_from_local
                .to_scale_rotation_translation();
            rotation * camera.orientation
        });
        let world_from_eye = world_from_eye
            .map(DQuat::normalize)
            .filter(|q| q.is_finite())
            .unwrap_or_default();
        let camera = camera.map(|camera| {
            let (height, height_by_distance) = match camera.projection {
                Projection::Orthographic { height } => {
                    let frame = &camera.placement.world_from_local.matrix3;
                    (height * (frame * DVec3::Y).length(), 0.0)
                }
                Projection::Perspective { height_angle_rad } => {
                    (0.0, 2.0 * (height_angle_rad / 2.0).tan())
                }
            };
            let to_world = &camera.placement.world_from_local;
            Camera {
                eye: to_world.transform_point3(camera.position),
                forward: world_from_eye * DVec3::NEG_Z,
                height,
                height_by_distance,
            }
        });
        Self {
            world_from_eye,
            diagonal: if diagonal > 0.0 && diagonal.is_finite() {
                diagonal
            } else {
                1.0
            },
            camera,
        }
    }

    /// The size of a pixel at a place.
    fn pixel(&self, at: DVec3) -> f64 {
        let seen = self.camera.as_ref().and_then(|camera| {
            let distance = (at - camera.eye).dot(camera.forward);
            let height = camera.height + camera.height_by_distance * distance;
            (distance > 0.0 && height > 0.0).then_some(height)
        });
        let [fewest, most] = PIXELS.map(|pixels| self.diagonal / pixels);
        (seen.unwrap_or(self.diagonal) / VIEW_HEIGHT_PX).clamp(most, fewest)
    }
}

/// The box around everything but the labels, and around their anchors.
fn bounds(scene: &Scene, measures: &[Measure], labels: &[u32]) -> Aabb {
    let mut boxes: Vec<Option<Aabb>> = vec![None; scene.meshes.len().max(measures.len())];
    let mut bounds = Aabb::EMPTY;
    let mut labels = labels.iter().peekable();
    let not_shown = scene.nodes_not_shown();
    for (i, instance) in scene.instances.iter().enumerate() {
        let is_label = labels.next_if_eq(&&(i as u32)).is_some();
        if is_below(instance.placement.node, &not_shown) {
            continue;
        }
        let world = &instance.placement.world_from_local;
        if is_label {
            bounds.include(world.translation);
            continue;
        }
        let index = instance.mesh.index();
        let local = boxes[index].get_or_insert_with(|| match measures.get(index) {
            Some(measure) => measure.bounds,
            None => {
                let mesh = &scene.meshes[index];
                let mut bounds = Aabb::EMPTY;
                (0..mesh.positions.len() as u32).for_each(|v| bounds.include(mesh.p_in_local(v)));
                bounds
            }
        });
        for p in local.corners() {
            bounds.include(world.transform_point3(p));
        }
    }
    bounds
}
