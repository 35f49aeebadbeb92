//! Collects the scene and shares what is equal.

use std::sync::Arc;

use rustc_hash::{FxHashMap, FxHashSet};

use crate::graph::NodeId;
use crate::scene::{
    Camera, Environment, EnvironmentId, Instance, Light, LightId, LightModel, LightSetId, Material,
    MaterialId, Mesh, MeshId, Node, Scene, Texture, TextureId,
};
use crate::shape::Measure;

/// What two uses of a material must have in common to share it: all values, bit by bit.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct MaterialKey {
    name: Option<Arc<str>>,
    numbers: [u64; 16],
    texture: Option<TextureId>,
    light_model: LightModel,
    faces: crate::scene::Faces,
    line_pattern: u16,
}

#[derive(Default)]
pub(super) struct Builder {
    scene: Scene,
    measures: Vec<Measure>,
    materials: FxHashMap<MaterialKey, MaterialId>,
    textures: FxHashMap<NodeId, TextureId>,
    light_sets: FxHashMap<Vec<LightId>, LightSetId>,
    class_names: FxHashSet<Arc<str>>,
}

impl Builder {
    pub fn finish(self) -> (Scene, Vec<Measure>) {
        (self.scene, self.measures)
    }

    pub fn items(&self) -> usize {
        let scene = &self.scene;
        scene.nodes.len() + scene.instances.len() + scene.lights.len() + scene.cameras.len()
    }

    pub fn class_name(&mut self, name: &str) -> Arc<str> {
        if let Some(known) = self.class_names.get(name) {
            return Arc::clone(known);
        }
        let name: Arc<str> = name.into();
        self.class_names.insert(Arc::clone(&name));
        name
    }

    pub fn node(&mut self, node: Node) -> crate::scene::NodeId {
        self.scene.nodes.push(node);
        crate::scene::NodeId(self.scene.nodes.len() as u32 - 1)
    }

    pub fn set_notes(&mut self, node: crate::scene::NodeId, notes: Vec<Arc<str>>) {
        self.scene.nodes[node.index()].notes = notes;
    }

    pub fn mesh(&mut self, mesh: Mesh) -> MeshId {
        self.scene.meshes.push(mesh);
        MeshId(self.scene.meshes.len() as u32 - 1)
    }

    /// Stands for a mesh that is measured, not made.
    pub fn measure(&mut self, measure: Measure) -> MeshId {
        self.measures.push(measure);
        MeshId(self.measures.len() as u32 - 1)
    }

    pub fn instance(&mut self, instance: Instance) {
        self.scene.instances.push(instance);
    }

    pub fn light(&mut self, light: Light) -> LightId {
        self.scene.lights.push(light);
        LightId(self.scene.lights.len() as u32 - 1)
    }

    pub fn camera(&mut self, camera: Camera) {
        self.scene.cameras.push(camera);
    }

    pub fn light_set(&mut self, lights: &[LightId]) -> LightSetId {
        if let Some(&known) = self.light_sets.get(lights) {
            return known;
        }
        let id = LightSetId(self.scene.light_sets.len() as u32);
        self.scene.light_sets.push(lights.to_vec());
        self.light_sets.insert(lights.to_vec(), id);
        id
    }

    pub fn environment(&mut self, environment: &Environment) -> EnvironmentId {
        // Few files have more than one.
        let known = self
            .scene
            .environments
            .iter()
            .rposition(|e| e == environment);
        let index = known.unwrap_or_else(|| {
            self.scene.environments.push(environment.clone());
            self.scene.environments.len() - 1
        });
        EnvironmentId(index as u32)
    }

    /// The texture of a `Texture2` node.
    pub fn texture(&mut self, node: NodeId, make: impl FnOnce() -> Texture) -> TextureId {
        *self.textures.entry(node).or_insert_with(|| {
            self.scene.textures.push(make());
            TextureId(self.scene.textures.len() as u32 - 1)
        })
    }

    pub fn material(&mut self, material: Material) -> MaterialId {
        let mut numbers = [0; 16];
        let triples = [
            material.ambient_srgb,
            material.diffuse_srgb,
            material.specular_srgb,
            material.emissive_srgb,
        ];
        let singles = [
            material.shininess,
            material.transparency,
            material.line_width_px,
            material.point_size_px,
        ];
        let all = triples.as_flattened().iter().chain(&singles);
        for (slot, number) in numbers.iter_mut().zip(all) {
            *slot = number.to_bits();
        }
        let key = MaterialKey {
            name: material.name.clone(),
            numbers,
            texture: material.texture,
            light_model: material.light_model,
            faces: material.faces,
            line_pattern: material.line_pattern,
        };
        *self.materials.entry(key).or_insert_with(|| {
            self.scene.materials.push(material);
            MaterialId(self.scene.materials.len() as u32 - 1)
        })
    }
}
