//! A scene repainted so that its picture says, in every pixel with something opaque, what is seen
//! and whether one light reaches it: no shading hides a wrong shadow.
//!
//! Geometry, placements and sides stay. The light becomes white and all else about it that
//! weakens goes; normals point to it, so that it shines at full strength wherever it is not
//! shadowed. Red is light; green and blue name the object.

use std::collections::HashMap;

use glam::{DAffine3, DMat3, DVec4};
use scenegraph::scene::{
    Environment, EnvironmentId, Faces, Instance, Light, LightId, LightKind, LightModel, LightSetId,
    Material, MaterialId, Mesh, MeshId, Scene, Topology,
};
use tests::reference::RefImage;
use viewer::frame::Settings;

/// Red of the background: neither lit nor shadowed.
const NOTHING: f64 = 0.5;

/// What a pixel shows: nothing, or an object by its number modulo 256, and whether it is lit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seen(pub Option<(u8, bool)>);

/// The scene repainted for one of its lights.
pub fn repainted(scene: &Scene, light: usize) -> Scene {
    let light = bare(&scene.lights[light]);
    let mut painted = Scene {
        light_sets: vec![vec![LightId(0)]],
        environments: vec![Environment {
            ambient_intensity: 0.0,
            ..Environment::default()
        }],
        files: scene.files.clone(),
        nodes: scene.nodes.clone(),
        ..Scene::default()
    };
    let mut meshes = HashMap::new();
    for (number, instance) in (0..).zip(&scene.instances) {
        let mesh = &scene.meshes[instance.mesh.index()];
        let to_light = ToLight::new(&light, instance);
        // What one set of normals fits stays shared.
        let key = (instance.mesh, to_light.key(number));
        let mesh = *meshes.entry(key).or_insert_with(|| {
            painted.meshes.push(to_light.turned(mesh));
            MeshId(painted.meshes.len() as u32 - 1)
        });
        painted.materials.push(paint(scene, instance, number));
        painted.instances.push(Instance {
            mesh,
            material: MaterialId(number),
            light_set: LightSetId(0),
            environment: EnvironmentId(0),
            ..instance.clone()
        });
    }
    painted.lights.push(light);
    painted
}

/// Over this background and by these settings a picture can be read.
pub fn settings(settings: &Settings) -> Settings {
    Settings {
        background_srgb: [[NOTHING, 0.0, 0.0]; 2],
        samples: 1,
        ..settings.clone()
    }
}

/// What a picture of a repainted scene says. `None` for a colour that says nothing.
pub fn read(rgba: &[u8]) -> Vec<Option<Seen>> {
    let pixel = |&[r, g, b, _]: &[u8; 4]| {
        let object = (g >> 4) | (b & 0xf0);
        match r {
            0..8 => Some(Seen(Some((object, false)))),
            248.. => Some(Seen(Some((object, true)))),
            120..136 => Some(Seen(None)),
            _ => None,
        }
    };
    rgba.as_chunks().0.iter().map(pixel).collect()
}

/// What it must say.
pub fn expected(reference: &RefImage, light: usize) -> Vec<Seen> {
    let pixel = |(object, lit): (&Option<u32>, &u128)| {
        Seen(object.map(|object| (object as u8, lit >> light & 1 == 1)))
    };
    reference
        .object
        .iter()
        .zip(&reference.lit)
        .map(pixel)
        .collect()
}

/// White, of full strength everywhere.
fn bare(light: &Light) -> Light {
    let kind = match light.kind {
        LightKind::Spot { location, .. } => LightKind::Point { location },
        ref other => other.clone(),
    };
    Light {
        kind,
        color_srgb: [1.0; 3],
        intensity: 1.0,
        environment: EnvironmentId(0),
        ..light.clone()
    }
}

/// Where the light is, seen from an instance.
struct ToLight {
    local_from_world: DMat3,
    world_from_local: DAffine3,
    /// Position or direction, in the world.
    light: DVec4,
}

impl ToLight {
    fn new(light: &Light, instance: &Instance) -> Self {
        let placed = &light.placement.world_from_local;
        let world_from_local = instance.placement.world_from_local;
        Self {
            // Normals go to the world by the inverse transpose of what positions go by.
            local_from_world: world_from_local.matrix3.transpose(),
            world_from_local,
            light: match light.kind {
                LightKind::Directional { direction } => {
                    let direction = placed.transform_vector3(direction);
                    (-direction.normalize()).extend(0.0)
                }
                LightKind::Point { location } | LightKind::Spot { location, .. } => {
                    placed.transform_point3(location).extend(1.0)
                }
            },
        }
    }

    /// Equal for instances whose normals are equal if their meshes are.
    fn key(&self, number: u32) -> [u64; 4] {
        if self.light.w > 0.0 {
            return [u64::from(number), 0, 0, 1];
        }
        let [x, y, z] = (self.local_from_world * self.light.truncate()).to_array();
        [x.to_bits(), y.to_bits(), z.to_bits(), 0]
    }

    /// The mesh with normals towards the light. They are as long as the way: interpolated ones
    /// then point to it too.
    fn turned(&self, mesh: &Mesh) -> Mesh {
        let normal = |i: u32| {
            let p = self.world_from_local.transform_point3(mesh.p_in_local(i));
            let way = self.light.truncate() - p * self.light.w;
            (self.local_from_world * way).as_vec3().to_array()
        };
        Mesh {
            normals: (0..mesh.positions.len() as u32).map(normal).collect(),
            texcoords: Vec::new(),
            colors_srgb: Vec::new(),
            ..mesh.clone()
        }
    }
}

/// Red where light is; the object's number in green and blue. What is no opaque surface is not to
/// be seen at all.
fn paint(scene: &Scene, instance: &Instance, number: u32) -> Material {
    let material = &scene.materials[instance.material.index()];
    let mesh = &scene.meshes[instance.mesh.index()];
    let nibble = |n: u32| f64::from((n & 15) * 16 + 8) / 255.0;
    let is_surface = mesh.topology == Topology::Triangles
        && material.transparency == 0.0
        && mesh.colors_srgb.iter().all(|color| color[3] >= 1.0);
    Material {
        ambient_srgb: [0.0; 3],
        diffuse_srgb: [1.0, 0.0, 0.0],
        specular_srgb: [0.0; 3],
        emissive_srgb: [0.0, nibble(number), nibble(number >> 4)],
        transparency: if is_surface { 0.0 } else { 1.0 },
        light_model: LightModel::Phong,
        faces: match material.faces {
            Faces::BothTwoSidedLighting => Faces::BothOneSidedLighting,
            as_it_is => as_it_is,
        },
        texture: None,
        ..material.clone()
    }
}
