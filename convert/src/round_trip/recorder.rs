//! Remembers what a model reads, so that it can go into the output with it.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use scenegraph::{LoadError, Loader};

use super::paths::{folder_of, target};
use crate::TextureLoader;

/// A loader that keeps a copy of all it reads, under the path by which the model finds it again
/// when all lies below one folder.
pub struct Recorder<'l> {
    loader: &'l dyn Loader,
    state: RefCell<State>,
}

#[derive(Default)]
struct State {
    /// Of a real folder, what it is below the model's.
    folders: BTreeMap<PathBuf, String>,
    /// Of a real file, its path below the model's folder.
    paths: BTreeMap<PathBuf, String>,
    files: BTreeMap<String, Arc<[u8]>>,
    /// Paths of images.
    images: BTreeMap<String, ()>,
}

impl<'l> Recorder<'l> {
    /// Of a model in `folder`, which is what its references are looked for in first.
    pub fn new(loader: &'l dyn Loader, folder: &Path) -> Self {
        let mut state = State::default();
        state.folders.insert(folder.to_owned(), String::new());
        Self {
            loader,
            state: RefCell::new(state),
        }
    }

    /// Files by path: first what was included, then images.
    pub(crate) fn files(&self) -> Vec<(String, Arc<[u8]>)> {
        let state = self.state.borrow();
        let files = state
            .files
            .iter()
            .map(|(path, bytes)| (path.clone(), Arc::clone(bytes)));
        let (images, texts): (Vec<_>, Vec<_>) =
            files.partition(|(path, _)| state.images.contains_key(path));
        texts.into_iter().chain(images).collect()
    }
}

impl Loader for Recorder<'_> {
    fn find(&self, beside: &Path, name: &str) -> Result<PathBuf, LoadError> {
        let id = self.loader.find(beside, name)?;
        let mut state = self.state.borrow_mut();
        let folder = state.folders.get(beside).cloned().unwrap_or_default();
        if let Some(path) = target(&folder, name)
            && !state.paths.contains_key(&id)
        {
            if let Some(real) = id.parent() {
                let below = folder_of(&path).to_owned();
                state.folders.entry(real.to_owned()).or_insert(below);
            }
            state.paths.insert(id.clone(), path);
        }
        Ok(id)
    }

    /// A look at a file does not make it one that the model needs.
    fn beginning(&self, id: &Path, len: u64) -> Result<Vec<u8>, LoadError> {
        self.loader.beginning(id, len)
    }

    fn unpack_limits(&self) -> unpack::Limits {
        self.loader.unpack_limits()
    }

    fn read(&self, id: &Path) -> Result<Vec<u8>, LoadError> {
        let bytes = self.loader.read(id)?;
        let mut state = self.state.borrow_mut();
        if let Some(path) = state.paths.get(id).cloned() {
            state
                .files
                .entry(path)
                .or_insert_with(|| bytes.as_slice().into());
        }
        Ok(bytes)
    }
}

impl TextureLoader for Recorder<'_> {
    fn load(&self, beside: &Path, name: &str) -> Result<Vec<u8>, String> {
        let loaded = Loader::load(self, beside, name).map_err(|why| why.to_string())?;
        let mut state = self.state.borrow_mut();
        if let Some(path) = state.paths.get(&loaded.id).cloned() {
            state.images.insert(path, ());
        }
        Ok(loaded.bytes)
    }
}
