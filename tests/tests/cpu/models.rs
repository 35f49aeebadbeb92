//! The models that are converted in tests: the samples, and the corpus where it is at hand.

use std::fs;
use std::path::{Path, PathBuf};

use convert::TextureLoader;
use scenegraph::scene::Scene;
use scenegraph::{FileLoader, Loader, ResolveOptions, load, resolve};
use tests::corpus;

/// A file, and what it may read.
#[derive(Clone, Debug)]
pub struct Model {
    /// For messages.
    pub name: String,
    /// The file.
    pub path: PathBuf,
    /// Included files and textures come from below this folder.
    pub source: PathBuf,
}

/// Images from disk, below the folders that a [`FileLoader`] allows.
pub struct Images(pub FileLoader);

impl TextureLoader for Images {
    fn load(&self, beside: &Path, name: &str) -> Result<Vec<u8>, String> {
        let loaded = Loader::load(&self.0, beside, name).map_err(|why| why.to_string())?;
        Ok(loaded.bytes)
    }
}

impl Model {
    /// What the model may read.
    pub fn loader(&self) -> FileLoader {
        FileLoader::new([self.source.as_path()])
    }

    /// Its textures.
    pub fn images(&self) -> Images {
        Images(self.loader())
    }

    /// Read and resolved as the command does it.
    pub fn scene(&self) -> Scene {
        let bytes = fs::read(&self.path).expect("a model that is listed");
        let beside = self.path.parent().unwrap_or(&self.source);
        let graph = load(&bytes, &self.name, beside, &self.loader());
        resolve(&graph, &ResolveOptions::default()).scene
    }
}

/// All samples.
pub fn samples() -> Vec<Model> {
    let model = |sample: &samples::Sample| Model {
        name: sample.path.to_owned(),
        path: samples::path_of(sample),
        source: samples::data_dir(),
    };
    samples::ALL.iter().map(model).collect()
}

/// All files of the corpus in a format that this version reads; none, said loudly, without it.
pub fn corpus() -> Vec<Model> {
    let Some(folder) = corpus::folder() else {
        return Vec::new();
    };
    let files = folder.join("files");
    let entries = corpus::entries(&folder).expect("the corpus's list");
    let is_read =
        |header: &str| header.starts_with("#VRML V1.0 ascii") || header.starts_with("#Inventor V");
    let read = entries.iter().filter(|entry| is_read(&entry.header));
    let model = |entry: &corpus::Entry| Model {
        name: entry.path.clone(),
        path: files.join(&entry.path),
        source: files.join(entry.path.split('/').next().unwrap_or_default()),
    };
    read.map(model).collect()
}
