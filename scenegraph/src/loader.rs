//! The only way to other files: included models and, later, textures.

use std::fmt;
use std::fs;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

/// A file found.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// What identifies it, however it was named: its canonical path.
    pub id: PathBuf,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// Why a file was not read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LoadError {
    /// It is not where it was looked for.
    NotFound,
    /// It lies outside the folders that may be read.
    Outside,
    /// It is a web address; nothing is fetched.
    Remote,
    /// It exists but cannot be read.
    Unreadable(String),
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFound => f.write_str("it was not found"),
            Self::Outside => f.write_str("it lies outside the folders that may be read"),
            Self::Remote => f.write_str("it is a web address, and nothing is fetched"),
            Self::Unreadable(why) => write!(f, "it cannot be read: {why}"),
        }
    }
}

/// Finds and reads files that a model refers to.
pub trait Loader {
    /// What identifies the file called `name` by a file in the folder `beside`, however it is
    /// called: its canonical path. It is not read yet.
    ///
    /// # Errors
    ///
    /// Says why there is none.
    fn find(&self, beside: &Path, name: &str) -> Result<PathBuf, LoadError>;

    /// The bytes of a file that [`Self::find`] gave.
    ///
    /// # Errors
    ///
    /// Says why it cannot be read.
    fn read(&self, id: &Path) -> Result<Vec<u8>, LoadError>;

    /// At most `len` bytes of its beginning.
    ///
    /// # Errors
    ///
    /// As [`Self::read`].
    fn beginning(&self, id: &Path, len: u64) -> Result<Vec<u8>, LoadError> {
        let mut bytes = self.read(id)?;
        bytes.truncate(usize::try_from(len).unwrap_or(usize::MAX));
        Ok(bytes)
    }

    /// How much may come out of a file that is packed.
    fn unpack_limits(&self) -> unpack::Limits {
        unpack::Limits::default()
    }

    /// Finds and reads.
    ///
    /// # Errors
    ///
    /// Those of both.
    fn load(&self, beside: &Path, name: &str) -> Result<Loaded, LoadError> {
        let id = self.find(beside, name)?;
        let bytes = self.read(&id)?;
        Ok(Loaded { id, bytes })
    }
}

/// Reads from disk: beside the naming file first, then in the search folders; by the name as
/// written, then by its last part alone, which finds files moved from another machine. Nothing
/// outside the search folders is read.
#[derive(Clone, Debug, Default)]
pub struct FileLoader {
    folders: Vec<PathBuf>,
    unpack_limits: unpack::Limits,
}

/// Longest file read, so that a device or a mistake cannot exhaust memory.
const MAX_BYTES: u64 = u32::MAX as u64;

impl FileLoader {
    /// A loader that may read below each of `folders`, searched in this order. Folders that do
    /// not exist are left out.
    pub fn new<'a>(folders: impl IntoIterator<Item = &'a Path>) -> Self {
        let real = |folder: &Path| {
            let folder = if folder.as_os_str().is_empty() {
                Path::new(".")
            } else {
                folder
            };
            folder.canonicalize().ok()
        };
        Self {
            folders: folders.into_iter().filter_map(real).collect(),
            unpack_limits: unpack::Limits::default(),
        }
    }

    /// The same with other limits on what comes out of packed files.
    #[must_use]
    pub fn with_unpack_limits(self, unpack_limits: unpack::Limits) -> Self {
        Self {
            unpack_limits,
            ..self
        }
    }

    /// Whether a canonical path may be read.
    fn allows(&self, id: &Path) -> bool {
        self.folders.iter().any(|folder| id.starts_with(folder))
    }

    fn candidates(&self, beside: &Path, name: &str) -> Vec<PathBuf> {
        let name = name.trim().trim_matches('"').replace('\\', "/");
        let name = match name.as_bytes() {
            [drive, b':', ..] if drive.is_ascii_alphabetic() => name[2..].to_owned(),
            _ => name,
        };
        let last = name.rsplit('/').next().unwrap_or_default().to_owned();
        let folders = || std::iter::once(beside).chain(self.folders.iter().map(PathBuf::as_path));
        let as_written = folders().map(|f| f.join(&name));
        let by_last = folders().map(|f| f.join(&last));
        let all: Vec<PathBuf> = if last.is_empty() {
            Vec::new()
        } else {
            as_written.chain(by_last).collect()
        };
        all
    }
}

impl Loader for FileLoader {
    fn find(&self, beside: &Path, name: &str) -> Result<PathBuf, LoadError> {
        if name.contains("://") {
            return Err(LoadError::Remote);
        }
        if name.contains('\0') {
            return Err(LoadError::NotFound);
        }
        let mut error = LoadError::NotFound;
        for path in self.candidates(beside, name) {
            let Ok(id) = path.canonicalize() else {
                continue;
            };
            if !id.is_file() {
                continue;
            }
            if self.allows(&id) {
                return Ok(id);
            }
            error = LoadError::Outside;
        }
        let goes_up = Path::new(name)
            .components()
            .any(|c| matches!(c, Component::RootDir | Component::ParentDir));
        if error == LoadError::NotFound && goes_up {
            error = LoadError::Outside;
        }
        Err(error)
    }

    fn unpack_limits(&self) -> unpack::Limits {
        self.unpack_limits
    }

    fn read(&self, id: &Path) -> Result<Vec<u8>, LoadError> {
        if !self.allows(id) {
            return Err(LoadError::Outside);
        }
        read_limited(id).map_err(LoadError::Unreadable)
    }

    fn beginning(&self, id: &Path, len: u64) -> Result<Vec<u8>, LoadError> {
        if !self.allows(id) {
            return Err(LoadError::Outside);
        }
        let unreadable = |error: std::io::Error| LoadError::Unreadable(error.to_string());
        let mut bytes = Vec::new();
        let file = fs::File::open(id).map_err(unreadable)?;
        file.take(len).read_to_end(&mut bytes).map_err(unreadable)?;
        Ok(bytes)
    }
}

fn read_limited(path: &Path) -> Result<Vec<u8>, String> {
    let file = fs::File::open(path).map_err(|e| e.to_string())?;
    let length = file.metadata().map_err(|e| e.to_string())?.len();
    if length > MAX_BYTES {
        return Err("it is longer than 4 GiB".to_owned());
    }
    let mut bytes = Vec::with_capacity(length as usize);
    file.take(MAX_BYTES)
        .read_to_end(&mut bytes)
        .map_err(|e| e.to_string())?;
    Ok(bytes)
}
