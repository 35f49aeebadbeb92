//! A model in a zip archive: which entry it is, and how what it refers to is found.
//!
//! The archive stays in memory; nothing is written to disk. Its entries have paths below the
//! archive's own path, as if it were a folder.

use std::fmt;
use std::path::{Path, PathBuf};

use iv_parser::Header;
use rustc_hash::FxHashMap;
use scenegraph::{FileLoader, LoadError, Loader};
use unpack::{Archive, Entry, Error, Format, clean_name};

/// Endings of the names of models.
const MODEL_ENDINGS: [&str; 6] = ["iv", "ivx", "ivl", "wrl", "vrml", "wrz"];

/// Bytes of an entry that tell whether it is a model.
const BEGINNING: u64 = 256;

/// Opens what a model in an archive refers to: in the archive first, then in the folders.
pub struct ArchiveLoader {
    archive: Archive,
    /// The archive's own path, canonical.
    path: PathBuf,
    folders: FileLoader,
    /// Numbers of entries by name, the first of equals: as it is, in small letters, and the last part
    /// of it in small letters.
    names: [FxHashMap<String, usize>; 3],
}

impl ArchiveLoader {
    /// Over an archive that lies at the canonical path `path`.
    pub fn new(archive: Archive, path: PathBuf, folders: FileLoader) -> Self {
        let mut names: [FxHashMap<String, usize>; 3] = Default::default();
        for (i, entry) in archive.entries.iter().enumerate() {
            let small = entry.name.to_ascii_lowercase();
            let last = last_part(&small).to_owned();
            for (names, name) in names.iter_mut().zip([entry.name.clone(), small, last]) {
                names.entry(name).or_insert(i);
            }
        }
        Self {
            archive,
            path,
            folders,
            names,
        }
    }

    /// What is in it.
    pub fn archive(&self) -> &Archive {
        &self.archive
    }

    /// The entry called so: by the whole name, or as Windows would find it.
    fn entry(&self, name: &str) -> Option<&Entry> {
        let [exact, small, _] = &self.names;
        let found = exact.get(name);
        let found = found.or_else(|| small.get(&name.to_ascii_lowercase()));
        self.archive.entries.get(*found?)
    }

    /// The entry that a file in the folder `inside` of the archive calls `name`: beside it, from
    /// the top, then by the last part of the name alone, wherever that is.
    fn named(&self, inside: &str, name: &str) -> Option<&Entry> {
        let name = name.trim().trim_matches('"').replace('\\', "/");
        let name = match name.as_bytes() {
            [letter, b':', ..] if letter.is_ascii_alphabetic() => &name[2..],
            _ => &name,
        };
        let last = last_part(name);
        let beside =
            |name: &str| clean_name(format!("{inside}/{name}").trim_start_matches('/')).ok();
        let candidates = [beside(name), clean_name(name).ok(), beside(last)];
        let found = candidates
            .into_iter()
            .flatten()
            .find_map(|name| self.entry(&name));
        found.or_else(|| {
            let [.., by_last] = &self.names;
            let found = by_last.get(&last.to_ascii_lowercase())?;
            self.archive.entries.get(*found)
        })
    }
}

impl Loader for ArchiveLoader {
    fn find(&self, beside: &Path, name: &str) -> Result<PathBuf, LoadError> {
        if name.contains("://") {
            return Err(LoadError::Remote);
        }
        if let Ok(inside) = beside.strip_prefix(&self.path)
            && let Some(entry) = self.named(&inside.to_string_lossy(), name)
        {
            return Ok(self.path.join(&entry.name));
        }
        let beside = match beside.starts_with(&self.path) {
            true => self.path.parent().unwrap_or(beside),
            false => beside,
        };
        self.folders.find(beside, name)
    }

    fn read(&self, id: &Path) -> Result<Vec<u8>, LoadError> {
        let Ok(inside) = id.strip_prefix(&self.path) else {
            return self.folders.read(id);
        };
        let entry = self
            .entry(&inside.to_string_lossy())
            .ok_or(LoadError::NotFound)?;
        let bytes = self.archive.read(entry);
        bytes.map_err(|error| LoadError::Unreadable(error.to_string()))
    }

    fn beginning(&self, id: &Path, len: u64) -> Result<Vec<u8>, LoadError> {
        let Ok(inside) = id.strip_prefix(&self.path) else {
            return self.folders.beginning(id, len);
        };
        let entry = self
            .entry(&inside.to_string_lossy())
            .ok_or(LoadError::NotFound)?;
        let bytes = self.archive.beginning(entry, len);
        bytes.map_err(|error| LoadError::Unreadable(error.to_string()))
    }

    fn unpack_limits(&self) -> unpack::Limits {
        self.folders.unpack_limits()
    }
}

fn last_part(name: &str) -> &str {
    name.rsplit('/').next().unwrap_or_default()
}

/// Why an input is not opened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OpenError {
    /// It is an archive that takes a password, and there is none.
    PasswordNeeded,
    /// The password is not the archive's.
    PasswordWrong,
    /// In words.
    Other(String),
}

impl fmt::Display for OpenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::PasswordNeeded => {
                "the archive takes a password; give it with --password, --password-file or in \
                 IVORY_PASSWORD"
            }
            Self::PasswordWrong => "the password does not open this archive",
            Self::Other(why) => why,
        })
    }
}

impl From<String> for OpenError {
    fn from(why: String) -> Self {
        Self::Other(why)
    }
}

impl From<OpenError> for String {
    fn from(error: OpenError) -> Self {
        error.to_string()
    }
}

/// The model of an archive, and how many others could have been meant.
///
/// It is a file whose beginning says that it is a model: one with a model's name before others,
/// then one in fewer folders, then the one that comes first. If there is none, the first with a
/// model's name is it.
///
/// # Errors
///
/// In words, when there is none or it cannot be opened.
pub fn model_in(archive: &Archive) -> Result<(&Entry, usize), OpenError> {
    let has_ending = |entry: &Entry| {
        let ending = entry.name.rsplit_once('.').map_or("", |(_, ending)| ending);
        MODEL_ENDINGS
            .iter()
            .any(|known| known.eq_ignore_ascii_case(ending))
    };
    let mut candidates: Vec<&Entry> = archive.entries.iter().collect();
    candidates.sort_by_key(|entry| (!has_ending(entry), entry.name.matches('/').count()));
    let mut models = Vec::new();
    for entry in candidates {
        // Without a model's name an entry is looked at only if no other is one.
        if !models.is_empty() && !has_ending(entry) {
            break;
        }
        match archive.beginning(entry, BEGINNING) {
            Ok(bytes) if is_model(&bytes) => models.push(entry),
            Err(Error::PasswordNeeded) => return Err(OpenError::PasswordNeeded),
            Err(Error::PasswordWrong) => return Err(OpenError::PasswordWrong),
            _ => {}
        }
    }
    let unmarked = archive.entries.iter().find(|entry| has_ending(entry));
    match (&models[..], unmarked) {
        ([model, others @ ..], _) => Ok((model, others.len())),
        ([], Some(model)) => Ok((model, 0)),
        ([], None) => Err("the archive holds no model".to_owned().into()),
    }
}

/// Whether bytes begin as a model does, or as a stream that one may be packed in.
fn is_model(bytes: &[u8]) -> bool {
    let is_stream = matches!(Format::of(bytes), Some(Format::Gzip | Format::Bzip2));
    is_stream || Header::of(bytes).is_some()
}
