//! The models that are converted in tests: the samples, and the corpus where it is at hand.

use std::fs;
use std::path::{Path, PathBuf};
use std::thread;

use convert::TextureLoader;
use scenegraph::scene::Scene;
use scenegraph::{FileLoader, Loader, ResolveOptions, load, resolve};
use tests::corpus;

/// Of a message about one model.
const MESSAGE_CHARS: usize = 600;

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

/// All files of the corpus: text and binary, Inventor and both VRMLs; none, said loudly, without it.
pub fn corpus() -> Vec<Model> {
    let Some(folder) = corpus::folder() else {
        return Vec::new();
    };
    let files = folder.join("files");
    let entries = corpus::entries(&folder).expect("the corpus's list");
    let model = |entry: &corpus::Entry| Model {
        name: entry.path.clone(),
        path: files.join(&entry.path),
        source: files.join(entry.path.split('/').next().unwrap_or_default()),
    };
    entries.iter().map(model).collect()
}

/// Checks all samples and all of the corpus, on as many threads as there are processors.
///
/// # Panics
///
/// When a check fails; says of which models and why.
pub fn check_all(check: impl Fn(&Model) -> Result<(), String> + Sync) {
    let models: Vec<Model> = samples().into_iter().chain(corpus()).collect();
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let (models, check) = (&models, &check);
    // Interleaved, because large files stand together.
    let of_thread = move |first: usize| {
        let mine = models.iter().skip(first).step_by(threads);
        let failed = mine.filter_map(|model| {
            let why = check(model).err()?;
            let why: String = why.chars().take(MESSAGE_CHARS).collect();
            Some(format!("{}: {why}", model.name))
        });
        failed.collect::<Vec<_>>()
    };
    let mut faults: Vec<String> = thread::scope(|scope| {
        let running: Vec<_> = (0..threads)
            .map(|first| scope.spawn(move || of_thread(first)))
            .collect();
        let found = running.into_iter().map(|t| t.join().expect("no panic"));
        found.flatten().collect()
    });
    faults.sort();
    let count = faults.len();
    assert!(count == 0, "{count} faults\n{}", faults.join("\n"));
}
