//! A part of a scene as a scene of its own.

use super::{
    EnvironmentId, LightId, LightSetId, MaterialId, MeshId, NodeId, Placement, Scene, TextureId,
};

/// New numbers for what is kept, given in the order of the old ones.
struct Kept(Vec<Option<u32>>);

impl Kept {
    fn new(is_kept: &[bool]) -> Self {
        let mut next = 0;
        let number = |&is_kept: &bool| {
            is_kept.then(|| {
                next += 1;
                next - 1
            })
        };
        Self(is_kept.iter().map(number).collect())
    }

    fn of(&self, old: usize) -> u32 {
        // Only what is kept is asked for.
        self.0.get(old).copied().flatten().unwrap_or(0)
    }

    fn list<T: Clone>(&self, all: &[T]) -> Vec<T> {
        let kept = all.iter().zip(&self.0).filter(|(_, new)| new.is_some());
        kept.map(|(item, _)| item.clone()).collect()
    }
}

impl Scene {
    /// The instances for whose positions `is_kept` says so, with all they need: their groups, and
    /// the lights that reach them. Cameras are left out.
    #[must_use]
    pub fn subset(&self, is_kept: impl Fn(usize) -> bool) -> Self {
        let instances = Kept::new(&(0..self.instances.len()).map(is_kept).collect::<Vec<_>>());
        let kept = instances.list(&self.instances);
        let flags = |count: usize, used: &mut dyn Iterator<Item = usize>| {
            let mut flags = vec![false; count];
            used.for_each(|i| flags[i] = true);
            Kept::new(&flags)
        };
        let meshes = flags(self.meshes.len(), &mut kept.iter().map(|i| i.mesh.index()));
        let materials = flags(
            self.materials.len(),
            &mut kept.iter().map(|i| i.material.index()),
        );
        let used = materials.list(&self.materials);
        let textures = flags(
            self.textures.len(),
            &mut used.iter().filter_map(|m| m.texture).map(TextureId::index),
        );
        let light_sets = flags(
            self.light_sets.len(),
            &mut kept.iter().map(|i| i.light_set.index()),
        );
        let sets = light_sets.list(&self.light_sets);
        let lights = flags(
            self.lights.len(),
            &mut sets.iter().flatten().map(|light| light.index()),
        );
        let mut scene = Self {
            instances: kept,
            meshes: meshes.list(&self.meshes),
            materials: used,
            textures: textures.list(&self.textures),
            lights: lights.list(&self.lights),
            light_sets: sets,
            files: self.files.clone(),
            ..Self::default()
        };
        let lit = scene.lights.iter().map(|light| light.environment.index());
        let environments = flags(
            self.environments.len(),
            &mut scene
                .instances
                .iter()
                .map(|i| i.environment.index())
                .chain(lit),
        );
        scene.environments = environments.list(&self.environments);
        let nodes = self.nodes_of(&scene);
        scene.nodes = nodes.list(&self.nodes);

        let node = |placement: &mut Placement| {
            placement.node = placement.node.map(|id| NodeId(nodes.of(id.index())));
        };
        for instance in &mut scene.instances {
            node(&mut instance.placement);
            instance.mesh = MeshId(meshes.of(instance.mesh.index()));
            instance.material = MaterialId(materials.of(instance.material.index()));
            instance.light_set = LightSetId(light_sets.of(instance.light_set.index()));
            instance.environment = EnvironmentId(environments.of(instance.environment.index()));
        }
        for light in &mut scene.lights {
            node(&mut light.placement);
            light.environment = EnvironmentId(environments.of(light.environment.index()));
        }
        for material in &mut scene.materials {
            material.texture = material
                .texture
                .map(|id| TextureId(textures.of(id.index())));
        }
        for light in scene.light_sets.iter_mut().flatten() {
            *light = LightId(lights.of(light.index()));
        }
        for node in &mut scene.nodes {
            node.parent = node.parent.map(|id| NodeId(nodes.of(id.index())));
        }
        for text in &self.texts {
            if instances
                .0
                .get(text.instance as usize)
                .copied()
                .flatten()
                .is_some()
            {
                let mut text = text.clone();
                text.instance = instances.of(text.instance as usize);
                scene.texts.push(text);
            }
        }
        scene
    }

    /// Which of this scene's nodes are around what a part of it places.
    fn nodes_of(&self, part: &Self) -> Kept {
        let mut is_kept = vec![false; self.nodes.len()];
        let placed = part.instances.iter().map(|i| &i.placement);
        for placement in placed.chain(part.lights.iter().map(|l| &l.placement)) {
            let mut at = placement.node;
            while let Some(id) = at {
                if std::mem::replace(&mut is_kept[id.index()], true) {
                    break;
                }
                at = self.nodes[id.index()].parent;
            }
        }
        Kept::new(&is_kept)
    }
}

#[cfg(test)]
mod tests {
    use crate::{FileLoader, ResolveOptions};

    #[test]
    fn a_part_stands_for_itself() {
        let text = b"#Inventor V2.1 ascii\nSeparator { DEF Sun PointLight { }\nDEF A Separator { \
            Material { diffuseColor 1 0 0 } Texture2 { filename \"a.png\" } Cube { } }\n\
            DEF B Separator { SpotLight { } Translation { translation 1 2 3 } Cone { } \
            AsciiText { string \"x\" } } }";
        let nothing = FileLoader::default();
        let graph = crate::load(text, "a.iv", std::path::Path::new(""), &nothing);
        let scene = crate::resolve(&graph, &ResolveOptions::default()).scene;
        let all = scene.subset(|_| true);
        assert_eq!(all.check(), Vec::new());
        let lit = |scene: &crate::scene::Scene, i: usize| {
            scene.light_sets[scene.instances[i].light_set.index()].clone()
        };
        for (i, (instance, same)) in all.instances.iter().zip(&scene.instances).enumerate() {
            assert_eq!(instance.placement, same.placement);
            assert_eq!(
                (instance.mesh, instance.material),
                (same.mesh, same.material)
            );
            assert_eq!(lit(&all, i), lit(&scene, i));
        }
        assert_eq!(all.texts, scene.texts);

        let cube = scene.subset(|i| i == 0);
        assert_eq!(cube.check(), Vec::new());
        assert_eq!(
            (cube.instances.len(), cube.meshes.len(), cube.textures.len()),
            (1, 1, 1)
        );
        assert_eq!((cube.lights.len(), cube.texts.len()), (1, 0));
        assert!(
            cube.nodes
                .iter()
                .all(|node| node.name.as_deref() != Some("B"))
        );

        let rest = scene.subset(|i| i > 0);
        assert_eq!(rest.check(), Vec::new());
        assert_eq!(
            (rest.instances.len(), rest.textures.len(), rest.lights.len()),
            (2, 0, 2)
        );
        assert_eq!(rest.texts[0].instance, 1);
        assert_eq!(rest.instances[0].placement, {
            let mut placement = scene.instances[1].placement.clone();
            placement.node = rest.instances[0].placement.node;
            placement
        });
        let nothing = scene.subset(|_| false);
        assert_eq!(nothing.check(), Vec::new());
        assert!(nothing.nodes.is_empty() && nothing.lights.is_empty());
    }
}
