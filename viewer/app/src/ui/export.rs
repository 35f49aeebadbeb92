//! The scene, or what is selected of it, to a file of another format.

use std::path::Path;

use convert::command::{atomic, model};
use convert::{Container, InventorOptions, Options, TextureLoader, gltf_to_inventor};
use scenegraph::FileLoader;
use scenegraph::scene::Scene;

use super::state::App;
use crate::model::Model;

impl App {
    /// Writes a `.glb`, `.gltf`, `.html` or `.iv`, by the name. What is hidden is left out.
    pub(super) fn export(&mut self, path: &Path, only_selected: bool) -> Result<String, String> {
        let selected = self.selected_instances();
        if only_selected && selected.is_empty() {
            return Err("nothing is selected".to_owned());
        }
        let model = self.model.as_ref().ok_or("nothing is shown")?;
        let hidden = &model.edits.hidden;
        let part = model.scene.subset(|i| {
            let is_hidden = hidden.get(i).copied().unwrap_or(false);
            let is_wanted = !only_selected || selected.binary_search(&i).is_ok();
            is_wanted && !is_hidden
        });
        let mut scene = part;
        if !only_selected {
            scene = with_cameras(scene, model);
        }
        let nothing = FileLoader::default();
        let images: &dyn TextureLoader = match &model.loader {
            Some(files) => &model::Images(files),
            None => &model::Images(&nothing),
        };
        let extension = path
            .extension()
            .unwrap_or_default()
            .to_string_lossy()
            .to_lowercase();
        let container = match extension.as_str() {
            "glb" => Container::Glb,
            "gltf" => Container::GltfBin,
            "html" => Container::Html,
            "iv" => return inventor(&scene, images, path),
            _ => return Err("the name must end in .glb, .gltf, .html or .iv".to_owned()),
        };
        let options = Options {
            container,
            ..Options::default()
        };
        let report = convert::write_file(&scene, &options, images, path)
            .map_err(|error| error.to_string())?;
        Ok(match report.losses.len() {
            0 => format!("exported to {}", path.display()),
            1 => format!("exported to {}, with one kind of loss", path.display()),
            n => format!("exported to {}, with {n} kinds of losses", path.display()),
        })
    }
}

/// Cameras are no part of a part, but of the whole: they stand in the world then.
fn with_cameras(mut scene: Scene, model: &Model) -> Scene {
    for camera in &model.scene.cameras {
        let mut camera = camera.clone();
        camera.placement.node = None;
        camera.placement.parent_from_local = camera.placement.world_from_local;
        scene.cameras.push(camera);
    }
    scene
}

/// As Inventor text, with the images in it.
fn inventor(scene: &Scene, images: &dyn TextureLoader, path: &Path) -> Result<String, String> {
    let mut glb = Vec::new();
    convert::write_glb(scene, &Options::default(), images, &mut glb)
        .map_err(|error| error.to_string())?;
    let options = InventorOptions {
        embed_images: true,
        ..InventorOptions::default()
    };
    let nothing = FileLoader::default();
    let made = gltf_to_inventor(&glb, "", Path::new(""), &nothing, &|_| None, &options)
        .map_err(|error| error.to_string())?;
    atomic::write(path, |out| out.write_all(&made.text))
        .map_err(|error| atomic::cannot_write(path, &error))?;
    Ok(format!("exported to {}", path.display()))
}
