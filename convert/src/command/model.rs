//! One input of Inventor text: its graph, and whether its format can be read at all.

use std::path::{Path, PathBuf};

use iv_parser::Diagnostic;
use scenegraph::{FileLoader, Graph, Loader};

/// Opens what a model refers to: in its own folder, then in the search folders.
pub fn file_loader(path: &Path, search: &[PathBuf]) -> FileLoader {
    let own = folder_of(path);
    FileLoader::new([own].into_iter().chain(search.iter().map(PathBuf::as_path)))
}

/// The graph of a model with all it includes.
pub fn graph(bytes: &[u8], path: &Path, files: &dyn Loader) -> Graph {
    let name = path.display().to_string();
    scenegraph::load(bytes, &name, &canonical_folder_of(path), files)
}

/// The folder that a file is in, canonical where it exists, so that a file that includes itself is
/// known again.
pub fn canonical_folder_of(path: &Path) -> PathBuf {
    let folder = match folder_of(path) {
        folder if folder.as_os_str().is_empty() => Path::new("."),
        folder => folder,
    };
    folder.canonicalize().unwrap_or_else(|_| folder.to_owned())
}

/// A tolerance as the user gives it.
///
/// # Errors
///
/// It is not a positive number.
pub fn chord(text: &str) -> Result<f64, String> {
    let number = text.parse().ok();
    number
        .filter(|v: &f64| *v > 0.0 && v.is_finite())
        .ok_or_else(|| "it is a distance, a number above 0".to_owned())
}

/// Whether the input itself, not a file it includes, is of a format that is not read.
pub fn is_unsupported(diagnostics: &[Diagnostic]) -> bool {
    diagnostics
        .iter()
        .any(|d| d.code == "unsupported-format" && d.pos.file == 0)
}

/// The folder that a file is named in; empty for the current one.
pub fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// Images by way of the graph's own loader.
pub struct Images<'a>(pub &'a FileLoader);

impl crate::TextureLoader for Images<'_> {
    fn load(&self, beside: &Path, name: &str) -> Result<Vec<u8>, String> {
        match self.0.load(beside, name) {
            Ok(loaded) => Ok(loaded.bytes),
            Err(error) => Err(error.to_string()),
        }
    }
}
