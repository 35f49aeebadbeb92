//! Files that appear whole or not at all, for what is not written by [`write_file`](crate::write_file).

use std::io::{self, BufWriter, Write};
use std::path::Path;

use serde_json::Value;

use super::json;

/// Writes a file under a temporary name and then renames it. Returns its length.
///
/// # Errors
///
/// What the system says, or that `path` is something other than a file.
pub fn write(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<u64> {
    if path.metadata().is_ok_and(|found| !found.is_file()) {
        return Err(io::Error::other("it exists and is not a file"));
    }
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".ivory-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As for any new file; a temporary one would be closed to all others.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let mut out = BufWriter::new(builder.tempfile_in(folder)?);
    content(&mut out)?;
    let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
    let length = file.as_file().metadata()?.len();
    file.persist(path)?;
    Ok(length)
}

/// Writes a JSON document.
///
/// # Errors
///
/// As [`write()`], in words with the path.
pub fn write_json(path: &Path, document: &Value) -> Result<u64, String> {
    let text = json::text(document);
    write(path, |out| out.write_all(text.as_bytes())).map_err(|error| cannot_write(path, &error))
}

/// Makes the folder of an output.
///
/// # Errors
///
/// In words with the path.
pub fn make_folder_of(path: &Path) -> Result<(), String> {
    let folder = path.parent().unwrap_or(Path::new(""));
    std::fs::create_dir_all(folder)
        .map_err(|error| format!("cannot make the folder {}: {error}", folder.display()))
}

/// An output that could not be written.
pub fn cannot_write(path: &Path, error: &io::Error) -> String {
    format!("cannot write {}: {}", path.display(), cause(error))
}

/// What the system says. `tempfile` adds the temporary name, which says nothing to the user and
/// differs from run to run.
fn cause(error: &io::Error) -> String {
    let text = error.to_string();
    match text.split_once(" at path ") {
        Some((cause, _)) => cause.to_owned(),
        None => text,
    }
}
