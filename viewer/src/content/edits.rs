//! What a user changes about how a scene is shown. The scene itself stays as it is.

use scenegraph::scene::{Faces, Scene, Topology};

use super::{Content, surface, world_lights};

/// What is done with a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightEdit {
    /// Whether it shines.
    pub is_on: bool,
    /// Times its own intensity; at least 0.
    pub factor: f64,
}

impl Default for LightEdit {
    fn default() -> Self {
        Self {
            is_on: true,
            factor: 1.0,
        }
    }
}

/// Which faces are drawn and lit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FaceEdit {
    /// As the model says.
    #[default]
    AsIs,
    /// Both sides of all, lit on the side that is seen.
    Both,
    /// Front faces only.
    FrontOnly,
}

/// All that is changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Edits {
    /// By position in `Scene::instances`; what is beyond the end is shown.
    pub hidden: Vec<bool>,
    /// By position in `Scene::lights`; what is beyond the end is as it is.
    pub lights: Vec<LightEdit>,
    /// Times the model's ambient light; at least 0.
    pub ambient_factor: f64,
    /// Faces.
    pub faces: FaceEdit,
}

impl Default for Edits {
    fn default() -> Self {
        Self {
            hidden: Vec::new(),
            lights: Vec::new(),
            ambient_factor: 1.0,
            faces: FaceEdit::AsIs,
        }
    }
}

impl Content {
    /// Makes all that can be edited what the scene says, changed by `edits`. Objects may change
    /// their order.
    pub fn apply(&mut self, scene: &Scene, edits: &Edits) {
        self.lights = world_lights(scene);
        for (light, edit) in self.lights.iter_mut().zip(&edits.lights) {
            let factor = if edit.is_on { edit.factor } else { 0.0 };
            light.color_srgb = light.color_srgb.map(|c| c * factor);
        }
        for (made, &(material, environment)) in self.surfaces.iter_mut().zip(&self.surface_ids) {
            *made = surface::surface(scene, material, environment, edits.ambient_factor);
        }
        for object in &mut self.objects {
            let instance = object.instance as usize;
            object.is_hidden = edits.hidden.get(instance).copied().unwrap_or(false);
            let material = &scene.materials[scene.instances[instance].material.index()];
            let faces = match edits.faces {
                FaceEdit::AsIs => material.faces,
                FaceEdit::Both => Faces::BothTwoSidedLighting,
                FaceEdit::FrontOnly => Faces::FrontOnly,
            };
            let is_surface = scene.meshes[object.mesh.index()].topology == Topology::Triangles;
            object.is_culled = is_surface && faces == Faces::FrontOnly;
            object.look.is_two_sided =
                is_surface && object.look.is_lit && faces == Faces::BothTwoSidedLighting;
        }
        self.sort();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::Images;

    #[test]
    fn edits_change_what_is_shown_and_can_be_taken_back() {
        let text = std::fs::read(samples::data_dir().join("pavilion.iv")).unwrap();
        let graph = scenegraph::load(
            &text,
            "pavilion.iv",
            &samples::data_dir(),
            &scenegraph::FileLoader::default(),
        );
        let scene = scenegraph::resolve(&graph, &scenegraph::ResolveOptions::default()).scene;
        let content = Content::new(&scene, &Images::none());
        let mut edited = content.clone();
        let edits = Edits {
            hidden: vec![true],
            lights: vec![
                LightEdit {
                    is_on: false,
                    factor: 1.0,
                },
                LightEdit {
                    is_on: true,
                    factor: 0.5,
                },
            ],
            ambient_factor: 0.0,
            faces: FaceEdit::FrontOnly,
        };
        edited.apply(&scene, &edits);
        let hidden: Vec<u32> = edited
            .objects
            .iter()
            .filter(|o| o.is_hidden)
            .map(|o| o.instance)
            .collect();
        assert_eq!(hidden, [0]);
        assert!(!edited.objects.iter().any(|o| o.is_hidden && o.is_caster()));
        assert!(edited.lights[0].is_black() && !content.lights[0].is_black());
        let half = content.lights[1].color_srgb.map(|c| c * 0.5);
        assert_eq!(edited.lights[1].color_srgb, half);
        assert_eq!(edited.lights[2], content.lights[2]);
        assert!(edited.objects.iter().any(|o| o.is_culled));
        assert!(!edited.objects.iter().any(|o| o.look.is_two_sided));
        let emitted = |content: &Content| {
            let sums = content
                .surfaces
                .iter()
                .map(|s| s.constant_srgb.iter().sum::<f64>());
            sums.sum::<f64>()
        };
        assert!(emitted(&edited) < emitted(&content));

        edited.apply(&scene, &Edits::default());
        let facts = |content: &Content| -> Vec<_> {
            let objects = content.objects.iter();
            objects
                .map(|o| (o.instance, o.look, o.is_culled, o.is_hidden))
                .collect()
        };
        assert_eq!(facts(&edited), facts(&content));
        assert_eq!(edited.lights, content.lights);
        assert_eq!(edited.surfaces, content.surfaces);
    }
}
