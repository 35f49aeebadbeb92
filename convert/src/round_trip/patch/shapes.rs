//! Meshes and images.

use scenegraph::scene::{Faces, Mesh, TextureSource};
use scenegraph::write_shape;

use super::places::Ahead;
use super::text::hints;
use super::{No, Patcher};
use crate::round_trip::paths::target;

impl Patcher<'_, '_, '_> {
    pub(super) fn mesh(&mut self, at: usize, to: usize) -> Result<(), No> {
        if self.is_vrml2() {
            return Err("a mesh of VRML 2.0 was edited".to_owned());
        }
        let id = self.was.origins.meshes.get(at).copied();
        let id = id.ok_or("a mesh has no origin")?;
        let source = &self.scene.meshes[id.index()];
        let [primitive] = self.is.meshes[to].as_slice() else {
            return Err("a mesh of several parts was edited".to_owned());
        };
        let Some(mesh) = primitive.mesh.as_ref().filter(|m| m.colors_srgb.is_empty()) else {
            return Err("a mesh with colours of its own was edited".to_owned());
        };
        let node = self.node_at(source.pos)?;
        let material = self
            .scene
            .instances
            .iter()
            .find(|i| i.mesh == id)
            .map(|i| i.material);
        let faces = material.map(|id| self.scene.materials[id.index()].faces);
        let hints = hints(faces.unwrap_or(Faces::BothOneSidedLighting));
        let shape = Mesh {
            origin: source.origin + mesh.origin,
            ..mesh.clone()
        };
        let text = write_shape(&shape, 0);
        self.edits.replace(node, text.trim_ascii());
        for place in self.edits.references(node) {
            let hints = Ahead::Nodes(format!("ShapeHints {{ {hints} }}"));
            self.wrap(&place, "", &hints)?;
        }
        Ok(())
    }

    /// Gives an image's file another name where textures call it.
    pub(super) fn image(&mut self, old: &str, new: &str) -> Result<(), No> {
        let field = match self.is_vrml2() {
            true => "url",
            false => "filename",
        };
        let mut found = false;
        for texture in &self.scene.textures {
            let TextureSource::File { name, beside } = &texture.source else {
                continue;
            };
            if target(&beside.to_string_lossy(), name).as_deref() != Some(old) {
                continue;
            }
            let node = self.node_at(texture.pos)?;
            self.set(node, field, &format!("\"{new}\""))?;
            found = true;
        }
        match found {
            true => Ok(()),
            false => Err("an image was edited that no texture names".to_owned()),
        }
    }
}
