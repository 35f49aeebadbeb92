//! Zip archives: what is in them, and the bytes of one entry.

use std::collections::HashMap;
use std::collections::hash_map::Entry as Place;
use std::io::{Cursor, Read};
use std::sync::{Mutex, MutexGuard, PoisonError};

use zip::ZipArchive;
use zip::result::ZipError;

use crate::limits::drain;
use crate::{Error, Limits, NameFault, clean_name};

/// Most entries of an archive.
const MOST_ENTRIES: u64 = u16::MAX as u64;

/// One file in an archive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Its name as [`clean_name`] gives it.
    pub name: String,
    index: usize,
}

/// An entry that is not used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// Its name as written.
    pub name: String,
    /// Why.
    pub why: NameFault,
}

/// An archive in memory.
pub struct Archive {
    /// In the archive's order; folders are left out.
    pub entries: Vec<Entry>,
    /// What is not among them.
    pub refused: Vec<Refused>,
    /// Whether several entries have the same name. The last of each is among the entries: it is
    /// what programs that unpack them one by one leave.
    pub has_repeated_names: bool,
    password: Option<Vec<u8>>,
    limits: Limits,
    packed: u64,
    inside: Mutex<Inside>,
}

struct Inside {
    archive: ZipArchive<Cursor<Vec<u8>>>,
    /// Bytes unpacked so far: all entries together stay within the limits.
    unpacked: u64,
}

impl Archive {
    /// Reads the list of entries.
    ///
    /// # Errors
    ///
    /// When it cannot be read.
    pub fn open(bytes: Vec<u8>, password: Option<&[u8]>, limits: Limits) -> Result<Self, Error> {
        if claimed_entries(&bytes) > MOST_ENTRIES {
            return Err(Error::TooManyEntries);
        }
        let packed = bytes.len() as u64;
        let archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| words(&error))?;
        let mut entries = Vec::new();
        let mut refused = Vec::new();
        // Names that are the same as they are written do not come out of the reader.
        let mut has_repeated_names = archive.has_duplicate_names();
        let mut places: HashMap<String, usize> = HashMap::new();
        for index in 0..archive.len() {
            let entry = archive
                .by_index_data(index)
                .map_err(|error| words(&error))?;
            let name = match entry.name() {
                Ok(name) => name.into_owned(),
                Err(_) => String::from_utf8_lossy(entry.name_raw()).into_owned(),
            };
            let clean = match clean_name(&name) {
                Ok(_) if entry.is_symlink() => Err(NameFault::Link),
                other => other,
            };
            match clean {
                _ if entry.is_dir() => {}
                Ok(name) => match places.entry(name.clone()) {
                    Place::Occupied(place) => {
                        entries[*place.get()] = Entry { name, index };
                        has_repeated_names = true;
                    }
                    Place::Vacant(place) => {
                        place.insert(entries.len());
                        entries.push(Entry { name, index });
                    }
                },
                Err(why) => refused.push(Refused { name, why }),
            }
        }
        Ok(Self {
            entries,
            refused,
            has_repeated_names,
            password: password.map(<[u8]>::to_vec),
            limits,
            packed,
            inside: Mutex::new(Inside {
                archive,
                unpacked: 0,
            }),
        })
    }

    fn inside(&self) -> MutexGuard<'_, Inside> {
        // Nothing is half done when a reader panics.
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The bytes of an entry.
    ///
    /// # Errors
    ///
    /// When they cannot be had; then also when they are damaged, as nobody can tell how much of a
    /// wrong password's result is right.
    pub fn read(&self, entry: &Entry) -> Result<Vec<u8>, Error> {
        let mut inside = self.inside();
        let before = inside.unpacked;
        let mut file = self.file(&mut inside.archive, entry)?;
        let expected = file.entry().size();
        let is_encrypted = file.entry().encrypted();
        let drained = drain(&mut file, self.packed, before, expected, &self.limits)?;
        drop(file);
        inside.unpacked += drained.bytes.len() as u64;
        match drained.fault {
            // The old encryption lets one in 256 wrong passwords pass.
            Some(_) if is_encrypted => Err(Error::PasswordWrong),
            Some(fault) => Err(Error::Damaged(fault.to_string())),
            None => Ok(drained.bytes),
        }
    }

    /// At most `len` bytes of an entry's beginning.
    ///
    /// # Errors
    ///
    /// When nothing can be read.
    pub fn beginning(&self, entry: &Entry, len: u64) -> Result<Vec<u8>, Error> {
        let mut inside = self.inside();
        let file = self.file(&mut inside.archive, entry)?;
        let drained = drain(&mut file.take(len), self.packed, 0, len, &self.limits)?;
        Ok(drained.bytes)
    }

    fn file<'f>(
        &self,
        archive: &'f mut ZipArchive<Cursor<Vec<u8>>>,
        entry: &Entry,
    ) -> Result<zip::read::ZipFile<'f, Cursor<Vec<u8>>>, Error> {
        let data = archive
            .by_index_data(entry.index)
            .map_err(|error| words(&error))?;
        let file = match (&self.password, data.encrypted()) {
            (None, true) => return Err(Error::PasswordNeeded),
            (Some(password), true) => archive.by_index_decrypt(entry.index, password),
            (_, false) => archive.by_index(entry.index),
        };
        file.map_err(|error| words(&error))
    }
}

fn words(error: &ZipError) -> Error {
    match error {
        ZipError::InvalidPassword => Error::PasswordWrong,
        ZipError::UnsupportedArchive(why) if *why == ZipError::PASSWORD_REQUIRED => {
            Error::PasswordNeeded
        }
        ZipError::UnsupportedArchive(_) | ZipError::CompressionMethodNotSupported(_) => {
            Error::Unsupported(error.to_string())
        }
        other => Error::Damaged(other.to_string()),
    }
}

/// The largest number of entries that any directory in the bytes claims. Readers make room for as
/// many before they look at them.
fn claimed_entries(bytes: &[u8]) -> u64 {
    /// The end record of the directory for large archives.
    const SIGNATURE: &[u8; 4] = b"PK\x06\x06";
    let mut largest = 0;
    let mut rest = bytes;
    while let Some(at) = rest.windows(4).position(|four| four == SIGNATURE) {
        rest = &rest[at + 4..];
        let number = |at: usize| {
            let field = rest.get(at..at + 8).and_then(|bytes| bytes.try_into().ok());
            field.map_or(0, u64::from_le_bytes)
        };
        // Its own length tells it from packed bytes that look like it.
        if number(0) <= u64::from(u32::MAX) {
            largest = largest.max(number(20)).max(number(28));
        }
    }
    largest
}

#[cfg(test)]
mod tests;
