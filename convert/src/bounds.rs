//! The scene's box in the world: what lights and cameras without useful numbers go by.

use glam::{DAffine3, DVec3};
use scenegraph::scene::{Instance, Mesh, Scene, Shown, is_below};

use crate::layout::Needs;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) min: DVec3,
    pub(crate) max: DVec3,
}

impl Bounds {
    /// Of all instances that are shown, from the corners of their meshes' boxes; `None` when there
    /// are none.
    pub(crate) fn of(scene: &Scene, needs: &[Option<Needs>]) -> Option<Self> {
        let not_shown = scene.nodes_not_shown();
        let shown = |i: &&Instance| !is_below(i.placement.node, &not_shown);
        let instances = scene.instances.iter().filter(shown);
        instances.fold(None, |bounds, instance| {
            union(bounds, Self::of_instance(scene, needs, instance))
        })
    }

    /// Of what each node shows at any depth.
    pub(crate) fn by_node(scene: &Scene, needs: &[Option<Needs>]) -> Vec<Option<Self>> {
        let mut bounds = vec![None; scene.nodes.len()];
        for instance in &scene.instances {
            if let Some(node) = instance.placement.node {
                let slot = &mut bounds[node.index()];
                *slot = union(*slot, Self::of_instance(scene, needs, instance));
            }
        }
        for (i, node) in scene.nodes.iter().enumerate().rev() {
            if let (Some(parent), Shown::Always) = (node.parent, node.shown) {
                bounds[parent.index()] = union(bounds[parent.index()], bounds[i]);
            }
        }
        bounds
    }

    fn of_instance(scene: &Scene, needs: &[Option<Needs>], instance: &Instance) -> Option<Self> {
        let needs = needs[instance.mesh.index()].as_ref()?;
        let mesh = &scene.meshes[instance.mesh.index()];
        let corners = corners(mesh, needs, &instance.placement.world_from_local);
        let finite = corners.into_iter().filter(|p| p.is_finite());
        finite.fold(None, |bounds, p| {
            union(bounds, Some(Self { min: p, max: p }))
        })
    }

    pub(crate) fn center(&self) -> DVec3 {
        // Halved before the sum, which could overflow.
        self.min * 0.5 + self.max * 0.5
    }

    pub(crate) fn radius(&self) -> f64 {
        (self.max * 0.5 - self.min * 0.5).length()
    }

    pub(crate) fn corners(&self) -> [DVec3; 8] {
        corners_between(self.min, self.max)
    }
}

fn union(a: Option<Bounds>, b: Option<Bounds>) -> Option<Bounds> {
    match (a, b) {
        (Some(a), Some(b)) => Some(Bounds {
            min: a.min.min(b.min),
            max: a.max.max(b.max),
        }),
        (one, None) | (None, one) => one,
    }
}

fn corners(mesh: &Mesh, needs: &Needs, world_from_local: &DAffine3) -> [DVec3; 8] {
    let [min, max] = [needs.facts.min, needs.facts.max]
        .map(|p| mesh.origin + DVec3::from_array(p.map(f64::from)));
    corners_between(min, max).map(|p| world_from_local.transform_point3(p))
}

pub(crate) fn corners_between(min: DVec3, max: DVec3) -> [DVec3; 8] {
    std::array::from_fn(|i| {
        let pick = |axis: usize| {
            if i >> axis & 1 == 0 {
                min[axis]
            } else {
                max[axis]
            }
        };
        DVec3::new(pick(0), pick(1), pick(2))
    })
}
