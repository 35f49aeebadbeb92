//! A model that is shown: the scene, the renderer that has it, and what the user did to it.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use glam::DVec4;

use convert::command::model::Files;
use iv_parser::Diagnostic;
use scenegraph::scene::{Scene, TextureSource};
use viewer::content::Edits;
use viewer::gpu::Renderer;
use viewer::pick::{Hit, PickOptions, Picker};
use viewer::texture::Images;
use viewer::view::framing::Up;
use viewer::view::{Region, View};

use crate::fields::Fields;
use crate::outline::Outline;

/// How far beside a line or a point a click may be.
const STROKE_TOLERANCE_PX: f64 = 4.0;

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
    /// What finds things below the mouse, and the revision it knows.
    pub picker: Option<(Picker, u64)>,
    /// The files it was read from, itself first.
    pub files: Vec<PathBuf>,
    /// What its source says of nodes, once somebody asked.
    pub fields: Option<Fields>,
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
            picker: None,
            fields: None,
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

    /// What is seen at a place of the picture, in pixels from its top left corner. What lies before
    /// `section` is cut away.
    pub fn pick(
        &mut self,
        view: &View,
        size: (u32, u32),
        place: [f64; 2],
        section: Option<DVec4>,
    ) -> Option<Hit> {
        let content = self.renderer.content();
        let (picker, known) = self.picker.get_or_insert_with(|| {
            let picker = Picker::new(Arc::clone(&self.scene), content);
            (picker, self.revision)
        });
        if *known != self.revision {
            picker.update(content);
            *known = self.revision;
        }
        let region = Region::whole(size.0, size.1);
        let aim = picker.aim(view, &region, place)?;
        let options = PickOptions {
            tolerance_px: STROKE_TOLERANCE_PX,
            cut: section.map(|plane| -plane),
        };
        picker.pick(
            &aim,
            |object| !content.objects[object as usize].is_hidden,
            &options,
        )
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
