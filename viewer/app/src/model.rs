//! A model that is shown: the scene, the renderer that has it, and what the user did to it.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use convert::command::model::Files;
use iv_parser::Diagnostic;
use scenegraph::scene::{Scene, TextureSource};
use viewer::content::Edits;
use viewer::gpu::Renderer;
use viewer::texture::Images;
use viewer::view::framing::Up;

use crate::outline::Outline;

/// What it took until the first picture.
#[derive(Clone, Copy, Debug, Default)]
pub struct Times {
    /// Reading and parsing.
    pub read: Duration,
    /// From graph to scene.
    pub resolve: Duration,
    /// Waiting for the device, which is made at the same time.
    pub device_wait: Duration,
    /// Bringing it to the device.
    pub upload: Duration,
    /// Making shaders for the first picture.
    pub compile: Duration,
    /// Drawing the first picture, shaders apart.
    pub draw: Duration,
    /// From the start of the process, or the wish to open it, to the first picture.
    pub total: Duration,
}

/// A model that is shown.
pub struct Model {
    /// Its file.
    pub path: PathBuf,
    /// What is shown.
    pub scene: Arc<Scene>,
    /// What draws it.
    pub renderer: Renderer,
    /// `inventor` or `gltf`.
    pub format: &'static str,
    /// Which way is up.
    pub up: Up,
    /// What is wrong with it.
    pub diagnostics: Vec<Diagnostic>,
    /// What it took.
    pub times: Times,
    /// Its hierarchy.
    pub outline: Outline,
    /// What the user changed.
    pub edits: Edits,
    /// Counts changes of `edits` and of images: a picture belongs to one.
    pub revision: u64,
    /// The files it was read from, itself first.
    pub files: Vec<PathBuf>,
    /// Opens the files it refers to, once it is all read.
    pub loader: Option<Files>,
}

impl Model {
    /// As it was read, without images.
    pub fn new(
        path: &Path,
        scene: Arc<Scene>,
        renderer: Renderer,
        format: &'static str,
        up: Up,
        diagnostics: Vec<Diagnostic>,
        times: Times,
    ) -> Self {
        Self {
            path: path.to_owned(),
            files: files_of(path, &scene),
            outline: Outline::new(&scene),
            scene,
            renderer,
            format,
            up,
            diagnostics,
            times,
            edits: Edits::default(),
            revision: 0,
            loader: None,
        }
    }

    /// Changes what is shown.
    pub fn edit(&mut self, change: impl FnOnce(&mut Edits)) {
        let mut edits = self.edits.clone();
        change(&mut edits);
        if edits != self.edits {
            self.edits = edits;
            self.renderer.apply(&self.edits);
            self.revision += 1;
        }
    }

    /// Shows its images.
    pub fn set_images(&mut self, images: &Images, diagnostics: Vec<Diagnostic>) {
        self.diagnostics.extend(diagnostics);
        if !self.scene.textures.is_empty() {
            self.renderer.set_images(images, &self.edits);
            self.revision += 1;
        }
    }
}

/// The model's own file, those it includes, and images beside it, as far as they can be found by
/// name.
fn files_of(path: &Path, scene: &Scene) -> Vec<PathBuf> {
    let mut files = vec![path.to_owned()];
    let folder = path.parent().unwrap_or(Path::new(""));
    let included = scene.files.iter().map(|name| PathBuf::from(&**name));
    let images = scene.textures.iter().filter_map(|t| match &t.source {
        TextureSource::File { name, beside } => Some(beside.join(&**name)),
        _ => None,
    });
    for file in included.chain(images) {
        for candidate in [file.clone(), folder.join(&file)] {
            if candidate.is_file() && !files.contains(&candidate) {
                files.push(candidate);
                break;
            }
        }
    }
    files
}
