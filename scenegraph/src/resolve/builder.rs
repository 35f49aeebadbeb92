//! Collects the scene and shares what is equal.

use std::sync::Arc;

use glam::DVec3;
use iv_parser::SourcePos;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::graph::NodeId;
use crate::remarks::Remarks;
use crate::scene::{
    Camera, Environment, EnvironmentId, Fog, Instance, Light, LightId, LightModel, LightSetId,
    Material, MaterialId, Mesh, MeshId, Node, Scene, Text, Texture, TextureId,
};
use crate::shape::Measure;

use super::for_all::ForAll;
use super::labels;
use super::state::LightList;

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

/// Longest that all light sets may be together. Every shape between two of many lights sees
/// another set, so their length can grow with the square of the file's.
pub(super) const MAX_LIGHT_SET_ENTRIES: usize = 4_000_000;

#[derive(Default)]
pub(super) struct Builder {
    scene: Scene,
    measures: Vec<Measure>,
    materials: FxHashMap<MaterialKey, MaterialId>,
    textures: FxHashMap<NodeId, TextureId>,
    /// Each list: the one it continues, the light it adds, and its length.
    light_lists: Vec<(LightList, LightId, usize)>,
    light_sets: FxHashMap<LightList, LightSetId>,
    light_set_entries: usize,
    environments: FxHashMap<Vec<u64>, EnvironmentId>,
    for_all: ForAll,
    class_names: FxHashSet<Arc<str>>,
    /// Instances of text that faces the viewer, in pixels.
    labels: Vec<u32>,
}

impl Builder {
    pub fn finish(mut self, remarks: &mut Remarks) -> (Scene, Vec<Measure>) {
        if !self.for_all.apply(&mut self.scene) {
            remarks.warn(
                "too-many-lights",
                "there are too many shapes and lights to tell which reaches which",
                "some shapes are lit by lights beyond their radius, or not by all that reach them",
                SourcePos::default(),
            );
        }
        labels::settle(&mut self.scene, &self.measures, &self.labels);
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

    /// The number of the instance that was added last, and its material.
    pub fn last_instance(&self) -> Option<(u32, MaterialId)> {
        let last = self.scene.instances.last()?;
        Some((self.scene.instances.len() as u32 - 1, last.material))
    }

    /// Says what the last instance spells.
    pub fn text(&mut self, strings: Vec<Arc<str>>, faces_viewer: bool) {
        let instance = self.scene.instances.len().saturating_sub(1) as u32;
        if faces_viewer {
            self.labels.push(instance);
        }
        self.scene.texts.push(Text {
            instance,
            strings,
            faces_viewer,
        });
    }

    /// Adds a light to the scene, and to a list.
    pub fn light(&mut self, light: Light, list: LightList) -> LightList {
        let id = LightId(self.scene.lights.len() as u32);
        self.scene.lights.push(light);
        let length = self.light_list_length(list) + 1;
        self.light_lists.push((list, id, length));
        LightList(self.light_lists.len() as u32)
    }

    /// Adds a light that reaches everything around `center`, in the world, within `radius`, and
    /// brings ambient light there.
    pub fn light_for_all(
        &mut self,
        light: Light,
        center: DVec3,
        radius: f64,
        ambient_srgb: [f64; 3],
    ) {
        let id = LightId(self.scene.lights.len() as u32);
        self.scene.lights.push(light);
        self.for_all.add_light(id, center, radius, ambient_srgb);
    }

    /// Adds a fog for the whole scene; the first one counts.
    pub fn fog_for_all(&mut self, fog: Fog) {
        self.for_all.add_fog(fog);
    }

    pub fn camera(&mut self, camera: Camera) {
        self.scene.cameras.push(camera);
    }

    /// The lights of a list as a set of the scene; `None` if the sets would become too long.
    pub fn light_set(&mut self, list: LightList) -> Option<LightSetId> {
        if let Some(&known) = self.light_sets.get(&list) {
            return Some(known);
        }
        let length = self.light_list_length(list);
        if self.light_set_entries + length > MAX_LIGHT_SET_ENTRIES {
            return None;
        }
        let mut lights = Vec::with_capacity(length);
        let mut rest = list;
        while let Some(&(before, light, _)) = (rest.0 as usize)
            .checked_sub(1)
            .and_then(|i| self.light_lists.get(i))
        {
            lights.push(light);
            rest = before;
        }
        lights.reverse();
        self.light_set_entries += lights.len();
        let id = LightSetId(self.scene.light_sets.len() as u32);
        self.scene.light_sets.push(lights);
        self.light_sets.insert(list, id);
        Some(id)
    }

    fn light_list_length(&self, list: LightList) -> usize {
        let entry = (list.0 as usize).checked_sub(1);
        entry.map_or(0, |i| self.light_lists[i].2)
    }

    pub fn environment(&mut self, environment: &Environment) -> EnvironmentId {
        let mut key = vec![environment.ambient_intensity.to_bits()];
        key.extend(environment.ambient_color_srgb.map(f64::to_bits));
        key.extend(environment.attenuation.map(f64::to_bits));
        if let Some(fog) = &environment.fog {
            key.push(fog.fog_type as u64);
            key.extend(fog.color_srgb.map(f64::to_bits));
            key.push(fog.visibility.to_bits());
        }
        *self.environments.entry(key).or_insert_with(|| {
            self.scene.environments.push(environment.clone());
            EnvironmentId(self.scene.environments.len() as u32 - 1)
        })
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
