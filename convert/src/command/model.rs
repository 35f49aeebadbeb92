//! One input: its bytes out of whatever they are packed in, and what opens the files it refers to.

use std::path::{Path, PathBuf};

use iv_parser::{Diagnostic, Severity, SourcePos};
use scenegraph::{FileLoader, Graph, LoadError, Loader};
use unpack::{Archive, Error, Format};

use super::access::Access;
use super::archive::{ArchiveLoader, OpenError, model_in};
use super::bytes::{self, Bytes};

/// A model that was opened.
pub struct Opened {
    /// Its bytes, no longer packed.
    pub bytes: Bytes,
    /// Its name for display: the path, in an archive that of the entry behind it.
    pub name: String,
    /// The canonical folder it is in.
    pub folder: PathBuf,
    /// What opens the files it refers to.
    pub files: Files,
    /// Length of the file.
    pub packed_len: u64,
    /// What was wrong with what it is packed in.
    pub diagnostics: Vec<Diagnostic>,
}

/// Opens the files that a model refers to.
pub enum Files {
    /// In folders.
    Folders(FileLoader),
    /// In an archive, then in folders.
    Archive(Box<ArchiveLoader>),
}

impl Files {
    fn loader(&self) -> &dyn Loader {
        match self {
            Self::Folders(loader) => loader,
            Self::Archive(loader) => &**loader,
        }
    }
}

impl Loader for Files {
    fn find(&self, beside: &Path, name: &str) -> Result<PathBuf, LoadError> {
        self.loader().find(beside, name)
    }

    fn read(&self, id: &Path) -> Result<Vec<u8>, LoadError> {
        self.loader().read(id)
    }

    fn beginning(&self, id: &Path, len: u64) -> Result<Vec<u8>, LoadError> {
        self.loader().beginning(id, len)
    }

    fn unpack_limits(&self) -> unpack::Limits {
        self.loader().unpack_limits()
    }
}

/// Opens an input: a plain file, a gzip or bzip2 stream, or a model in a zip archive, told by
/// content. What is packed several times comes out whole, as of included files.
///
/// # Errors
///
/// When there is no model to be had from it.
pub fn open(path: &Path, access: &Access) -> Result<Opened, OpenError> {
    let bytes = bytes::read(path)?;
    let packed_len = bytes.len() as u64;
    let mut opened = Opened {
        bytes,
        name: path.display().to_string(),
        folder: canonical_folder_of(path),
        files: Files::Folders(access.file_loader(folder_of(path))),
        packed_len,
        diagnostics: Vec::new(),
    };
    if Format::of(&opened.bytes) == Some(Format::Zip) {
        return in_archive(path, opened, access);
    }
    opened.unpack(access)?;
    Ok(opened)
}

/// The model in an archive.
fn in_archive(path: &Path, mut opened: Opened, access: &Access) -> Result<Opened, OpenError> {
    let bytes = std::mem::replace(&mut opened.bytes, Bytes::Heap(Vec::new()));
    let password = access.password.as_deref();
    let archive = Archive::open(bytes.into_vec()?, password, access.limits)
        .map_err(|error| format!("the zip archive cannot be read: {error}"))?;
    for refused in &archive.refused {
        let message = format!("the entry `{}` is not used: {}", refused.name, refused.why);
        opened.remark(Severity::Warning, "refused-entry", message, "");
    }
    if archive.has_repeated_names {
        let message = "several entries of the archive have the same name".to_owned();
        let hint = "of each name the last entry is used; look at them with `unzip -l`";
        opened.remark(Severity::Warning, "repeated-entry", message, hint);
    }
    let (entry, others) = model_in(&archive)?;
    let inside = entry.name.clone();
    if others > 0 {
        let message = format!(
            "of {} models in the archive, `{inside}` is read",
            others + 1
        );
        let hint = "the one in the fewest folders is taken, then the first; unpack the archive to \
                    read the others";
        opened.remark(Severity::Note, "several-models", message, hint);
    }
    let content = archive.read(entry).map_err(|error| match error {
        Error::PasswordNeeded => OpenError::PasswordNeeded,
        Error::PasswordWrong => OpenError::PasswordWrong,
        error => OpenError::Other(format!("`{inside}`: {error}")),
    })?;
    opened.bytes = Bytes::Heap(content);
    opened.unpack(access)?;
    let own = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    opened.name = path.join(&inside).display().to_string();
    opened.folder = own.join(folder_of(Path::new(&inside)));
    let folders = access.file_loader(folder_of(path));
    opened.files = Files::Archive(Box::new(ArchiveLoader::new(archive, own, folders)));
    Ok(opened)
}

impl Opened {
    /// Takes the bytes out of a stream, if they are one.
    fn unpack(&mut self, access: &Access) -> Result<(), String> {
        let Some(unpacked) = unpack::unpack(&self.bytes, &access.limits) else {
            return Ok(());
        };
        let unpacked = unpacked.map_err(|error| format!("cannot be unpacked: {error}"))?;
        if let Some(why) = unpacked.damage {
            let message = format!("the file cannot be unpacked to its end: {why}");
            let hint = "what came out before was read";
            self.remark(Severity::Error, "damaged", message, hint);
        }
        self.bytes = Bytes::Heap(unpacked.bytes);
        Ok(())
    }

    fn remark(&mut self, severity: Severity, code: &'static str, message: String, hint: &str) {
        self.diagnostics.push(Diagnostic {
            severity,
            code,
            message,
            hint: hint.to_owned(),
            file: self.name.as_str().into(),
            pos: SourcePos::default(),
            snippet: None,
        });
    }

    /// The graph of the model with all it includes. The bytes are gone when this returns, so that
    /// they take up no memory while the graph is worked on.
    pub fn into_graph(self) -> (Graph, Files) {
        let mut graph = scenegraph::load(&self.bytes, &self.name, &self.folder, &self.files);
        graph.diagnostics.splice(0..0, self.diagnostics);
        (graph, self.files)
    }
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
pub struct Images<'a>(pub &'a dyn Loader);

impl crate::TextureLoader for Images<'_> {
    fn load(&self, beside: &Path, name: &str) -> Result<Vec<u8>, String> {
        match self.0.load(beside, name) {
            Ok(loaded) => Ok(loaded.bytes),
            Err(error) => Err(error.to_string()),
        }
    }
}
