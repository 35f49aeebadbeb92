//! The scene's box in the world: what lights and cameras without useful numbers go by.

use glam::{DAffine3, DVec3};
use scenegraph::scene::{Mesh, Scene};

use crate::layout::Needs;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) min: DVec3,
    pub(crate) max: DVec3,
}

impl Bounds {
    /// Of all instances, from the corners of their meshes' boxes; `None` when there are none.
    pub(crate) fn of(scene: &Scene, needs: &[Option<Needs>]) -> Option<Self> {
        let mut bounds: Option<Self> = None;
        for instance in &scene.instances {
            let Some(needs) = &needs[instance.mesh.index()] else {
                continue;
            };
            let mesh = &scene.meshes[instance.mesh.index()];
            for p_in_world in corners(mesh, needs, &instance.placement.world_from_local) {
                if p_in_world.is_finite() {
                    bounds = Some(bounds.map_or(
                        Self {
                            min: p_in_world,
                            max: p_in_world,
                        },
                        |b| Self {
                            min: b.min.min(p_in_world),
                            max: b.max.max(p_in_world),
                        },
                    ));
                }
            }
        }
        bounds
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
