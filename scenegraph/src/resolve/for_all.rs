//! What VRML 2 says about the whole scene from anywhere in it: point and spot lights, and fog. It
//! is known only at the end of the walk.

use geometry::bounds::Aabb;
use glam::DVec3;
use rustc_hash::FxHashMap;

use crate::scene::{Environment, EnvironmentId, Fog, Instance, LightId, LightSetId, Scene};

use super::builder::MAX_LIGHT_SET_ENTRIES;

/// Most tests of a light against an instance; beyond it every such light counts as near.
const MAX_TESTS: usize = 20_000_000;

/// Environments among which an equal one is looked for.
const MAX_COMPARED: usize = 100;

/// A light that reaches everything within a ball.
#[derive(Clone, Copy, Debug)]
struct Reach {
    light: LightId,
    center: DVec3,
    radius: f64,
    ambient_srgb: [f64; 3],
}

#[derive(Debug, Default)]
pub(super) struct ForAll {
    lights: Vec<Reach>,
    fog: Option<Fog>,
}

impl ForAll {
    pub fn add_light(
        &mut self,
        light: LightId,
        center: DVec3,
        radius: f64,
        ambient_srgb: [f64; 3],
    ) {
        self.lights.push(Reach {
            light,
            center,
            radius,
            ambient_srgb,
        });
    }

    pub fn add_fog(&mut self, fog: Fog) {
        self.fog.get_or_insert(fog);
    }

    /// Gives every instance the lights that reach it, and the scene its fog.
    /// False if shapes and lights are so many that all lights were taken as near, or the last shapes
    /// kept the lights they had.
    pub fn apply(&self, scene: &mut Scene) -> bool {
        if let Some(fog) = self.fog {
            for environment in &mut scene.environments {
                environment.fog.get_or_insert(fog);
            }
        }
        let is_exact = self.lights.is_empty() || self.add_to_sets(scene);
        self.add_ambient(scene);
        is_exact
    }

    /// Adds the ambient light of all lights that reach an instance to that around it.
    fn add_ambient(&self, scene: &mut Scene) {
        let brings = |reach: &&Reach| reach.ambient_srgb != [0.0; 3];
        let ambient_of: FxHashMap<LightId, [f64; 3]> = (self.lights.iter().filter(brings))
            .map(|reach| (reach.light, reach.ambient_srgb))
            .collect();
        if ambient_of.is_empty() {
            return;
        }
        let mut known: FxHashMap<(EnvironmentId, LightSetId), EnvironmentId> = FxHashMap::default();
        for instance in &mut scene.instances {
            let key = (instance.environment, instance.light_set);
            instance.environment = *known.entry(key).or_insert_with(|| {
                let lights = &scene.light_sets[key.1.index()];
                let before = &scene.environments[key.0.index()];
                let mut sum = before
                    .ambient_color_srgb
                    .map(|v| v * before.ambient_intensity);
                for ambient in lights.iter().filter_map(|light| ambient_of.get(light)) {
                    sum = [0, 1, 2].map(|i| sum[i] + ambient[i]);
                }
                let lit = Environment {
                    ambient_intensity: 1.0,
                    ambient_color_srgb: sum.map(|v| v.min(1.0)),
                    ..before.clone()
                };
                let is_same = |e: &Environment| *e == lit;
                let found = scene
                    .environments
                    .iter()
                    .take(MAX_COMPARED)
                    .position(is_same);
                let index = found.unwrap_or_else(|| {
                    scene.environments.push(lit);
                    scene.environments.len() - 1
                });
                EnvironmentId(index as u32)
            });
        }
    }

    fn add_to_sets(&self, scene: &mut Scene) -> bool {
        let boxes: Vec<Aabb> = scene.meshes.iter().map(bounds).collect();
        let is_few = scene.instances.len().saturating_mul(self.lights.len()) <= MAX_TESTS;
        let mut sets: Vec<Vec<LightId>> = Vec::new();
        let mut known: FxHashMap<Vec<LightId>, LightSetId> = FxHashMap::default();
        // By the set before, where all lights are taken as near.
        let mut set_of: FxHashMap<LightSetId, LightSetId> = FxHashMap::default();
        let mut entries = 0;
        let before = std::mem::take(&mut scene.light_sets);
        for instance in &mut scene.instances {
            let old = instance.light_set;
            if let Some(&set) = set_of.get(&old) {
                instance.light_set = set;
                continue;
            }
            let mut lights = before[old.index()].clone();
            let local = boxes.get(instance.mesh.index());
            let reaches =
                |reach: &&Reach| !is_few || local.is_none_or(|b| reach.touches(instance, b));
            lights.extend(self.lights.iter().filter(reaches).map(|r| r.light));
            lights.sort_unstable();
            if let Some(&set) = known.get(&lights) {
                instance.light_set = set;
                continue;
            }
            entries += lights.len();
            if entries > MAX_LIGHT_SET_ENTRIES {
                lights.clone_from(&before[old.index()]);
            }
            let set = LightSetId(sets.len() as u32);
            instance.light_set = *known.entry(lights.clone()).or_insert(set);
            if instance.light_set == set {
                sets.push(lights);
            }
            if !is_few || entries > MAX_LIGHT_SET_ENTRIES {
                set_of.insert(old, instance.light_set);
            }
        }
        scene.light_sets = sets;
        is_few && entries <= MAX_LIGHT_SET_ENTRIES
    }
}

impl Reach {
    /// Whether an instance has anything within the ball, as far as the ball around its box tells.
    fn touches(&self, instance: &Instance, local: &Aabb) -> bool {
        let world = &instance.placement.world_from_local;
        let center = world.transform_point3((local.min + local.max) / 2.0);
        let axes = [world.x_axis, world.y_axis, world.z_axis];
        let scale: f64 = axes.map(DVec3::length_squared).iter().sum::<f64>().sqrt();
        let radius = scale * local.size().length() / 2.0;
        let distance = center.distance(self.center);
        // Not to be told, because something overflows: it counts as near.
        distance <= self.radius + radius || distance.is_nan() || radius.is_nan()
    }
}

fn bounds(mesh: &crate::scene::Mesh) -> Aabb {
    let mut bounds = Aabb::EMPTY;
    (0..mesh.positions.len() as u32).for_each(|i| bounds.include(mesh.p_in_local(i)));
    bounds
}
