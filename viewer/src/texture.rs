//! Decoded images of a scene's textures. Opens nothing itself: bytes come from the caller's loader.

use std::path::Path;

use convert::{Pixels, TextureLoader, Warning};
use scenegraph::scene::{Scene, Texture, TextureId, TextureSource};

/// The images of a scene, by texture; those that could not be had are missing.
#[derive(Clone, Debug, Default)]
pub struct Images {
    by_texture: Vec<Option<Pixels>>,
    /// Why images are missing; one for each name.
    pub problems: Vec<Warning>,
}

impl Images {
    /// No image at all.
    pub fn none() -> Self {
        Self::default()
    }

    /// Decodes the images that some visible material shows.
    pub fn load(scene: &Scene, loader: &dyn TextureLoader) -> Self {
        let mut images = Self {
            by_texture: vec![None; scene.textures.len()],
            problems: Vec::new(),
        };
        let mut wanted = vec![false; scene.textures.len()];
        for instance in &scene.instances {
            let has_texcoords = !scene.meshes[instance.mesh.index()].texcoords.is_empty();
            if let Some(id) = scene.materials[instance.material.index()].texture
                && has_texcoords
            {
                wanted[id.index()] = true;
            }
        }
        for (i, texture) in scene
            .textures
            .iter()
            .enumerate()
            .filter(|(i, _)| wanted[*i])
        {
            let pixels = match &texture.source {
                TextureSource::Inline(image) => Pixels::from_inline(image),
                TextureSource::Encoded { bytes, .. } => Pixels::from_file(bytes, ""),
                TextureSource::File { name, beside } => load_file(loader, beside, name),
            };
            match pixels {
                Ok(pixels) => images.by_texture[i] = Some(pixels),
                Err(reason) => images.miss(texture, reason),
            }
        }
        images
    }

    fn miss(&mut self, texture: &Texture, reason: String) {
        let name = match &texture.source {
            TextureSource::File { name, .. }
            | TextureSource::Encoded {
                name: Some(name), ..
            } => name.to_string(),
            _ => "inline image".to_owned(),
        };
        if !self.problems.iter().any(|known| known.name == name) {
            self.problems.push(Warning {
                name,
                reason,
                pos: texture.pos,
            });
        }
    }

    /// The image of a texture, if it is to be had.
    pub fn get(&self, id: TextureId) -> Option<&Pixels> {
        self.by_texture.get(id.index())?.as_ref()
    }
}

fn load_file(loader: &dyn TextureLoader, beside: &Path, name: &str) -> Result<Pixels, String> {
    loader
        .load(beside, name)
        .and_then(|bytes| Pixels::from_file(&bytes, name))
}
