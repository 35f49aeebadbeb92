//! Output to files: whole or not at all.
//!
//! Everything is written to temporary files beside the target, which take its name only when all
//! of them are complete.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use scenegraph::scene::Scene;
use tempfile::NamedTempFile;

use crate::blocks::Blocks;
use crate::plan::Plan;
use crate::prepare::Prepared;
use crate::texture::TextureLoader;
use crate::{Container, Error, Options, Report};

/// Converts a scene to the file `path`, in the container that the options name. A `.gltf` gets
/// its `.bin` files beside it, under its own name; further ones are numbered.
///
/// Nothing is left behind on failure, and an older file of that name stays as it is, unless the
/// system fails between the renaming of a `.bin` and that of its `.gltf`.
///
/// # Errors
///
/// As [`crate::write_glb`] and [`crate::write_gltf`]; and when the target is not a file or its
/// name cannot stand in a URI.
pub fn write_file(
    scene: &Scene,
    options: &Options,
    textures: &dyn TextureLoader,
    path: &Path,
) -> Result<Report, Error> {
    if path.metadata().is_ok_and(|found| !found.is_file()) {
        let reason = "it exists and is not a file";
        return Err(Error::Target {
            path: path.to_owned(),
            reason,
        });
    }
    let prepared = Prepared::new(scene, options)?;
    let plan = Plan::new(&prepared, options, textures)?;
    match options.container {
        Container::Glb => {
            let mut file = Pending::beside(path)?;
            let report = plan.write_glb(&mut file.out).map_err(|e| file.name(e))?;
            file.complete()?.keep()?;
            Ok(report)
        }
        Container::GltfEmbedded => {
            let mut file = Pending::beside(path)?;
            let report = plan.write_gltf_embedded(&mut file.out);
            let report = report.map_err(|e| file.name(e))?;
            file.complete()?.keep()?;
            Ok(report)
        }
        Container::Html => {
            let mut file = Pending::beside(path)?;
            let title = path.file_stem().unwrap_or_default().to_string_lossy();
            let report = plan.write_html(&title, &mut file.out);
            let report = report.map_err(|e| file.name(e))?;
            file.complete()?.keep()?;
            Ok(report)
        }
        Container::GltfBin => write_gltf_files(&plan, path),
    }
}

fn write_gltf_files(plan: &Plan, path: &Path) -> Result<Report, Error> {
    let mut bins = Vec::new();
    let mut uris = Vec::new();
    for buffer in 0..plan.layout.buffers.len() {
        let target = bin_path(path, buffer);
        uris.push(uri_of(&target)?);
        let mut file = Pending::beside(&target)?;
        plan.write_buffer(buffer, &mut file.out)
            .map_err(|e| file.name(e.into()))?;
        bins.push(file.complete()?);
    }
    let mut text = Pending::beside(path)?;
    let report = plan
        .write_gltf_text(&uris, &mut text.out)
        .map_err(|e| text.name(e))?;
    let text = text.complete()?;
    let mut kept: Vec<PathBuf> = Vec::new();
    let outcome = bins.into_iter().chain([text]).try_for_each(|file| {
        kept.push(file.keep()?);
        Ok(())
    });
    if outcome.is_err() {
        for path in kept {
            // The first failure is the one to tell.
            let _ = std::fs::remove_file(path);
        }
    }
    outcome.map(|()| report)
}

/// A file being written under another name.
struct Pending {
    out: Blocks<NamedTempFile>,
    target: PathBuf,
}

/// A file that only lacks its name.
struct Complete {
    file: NamedTempFile,
    target: PathBuf,
}

impl Pending {
    fn beside(target: &Path) -> Result<Self, Error> {
        let folder = match target.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        let mut builder = tempfile::Builder::new();
        builder.prefix(".ivconvert-");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // As for any new file; a temporary one would be closed to all others.
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let file = builder.tempfile_in(folder).map_err(Error::at(target))?;
        Ok(Self {
            out: Blocks::new(file),
            target: target.to_owned(),
        })
    }

    /// An error with the name of the file.
    fn name(&self, error: Error) -> Error {
        match error {
            Error::Io { path: None, source } => Error::at(&self.target)(source),
            other => other,
        }
    }

    fn complete(self) -> Result<Complete, Error> {
        let file = self.out.finish().map_err(Error::at(&self.target))?;
        Ok(Complete {
            file,
            target: self.target,
        })
    }
}

impl Complete {
    fn keep(self) -> Result<PathBuf, Error> {
        let Self { file, target } = self;
        file.persist(&target)
            .map_err(|e| Error::at(&target)(e.error))?;
        Ok(target)
    }
}

/// `model.bin`, `model.1.bin` and so on beside `model.gltf`.
fn bin_path(path: &Path, buffer: usize) -> PathBuf {
    match buffer {
        0 => path.with_extension("bin"),
        number => path.with_extension(format!("{number}.bin")),
    }
}

/// The name of a file beside the `.gltf`, with all that could mean something in a URI escaped.
fn uri_of(path: &Path) -> Result<String, Error> {
    let Some(name) = path.file_name().and_then(OsStr::to_str) else {
        let reason = "its name is not Unicode and cannot stand in a .gltf";
        return Err(Error::Target {
            path: path.to_owned(),
            reason,
        });
    };
    Ok(escaped_uri(name))
}

/// Percent-encoding (RFC 3986) of all but the unreserved characters.
fn escaped_uri(name: &str) -> String {
    use std::fmt::Write;
    let mut uri = String::with_capacity(name.len());
    for byte in name.bytes() {
        if byte.is_ascii_alphanumeric() || b"-._~".contains(&byte) {
            uri.push(char::from(byte));
        } else {
            // Writing to a String does not fail.
            let _ = write!(uri, "%{byte:02X}");
        }
    }
    uri
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_escaped_for_uris() {
        for (name, want) in [
            ("a-b_c.1~.bin", "a-b_c.1~.bin"),
            ("a b%#?.bin", "a%20b%25%23%3F.bin"),
            ("tür.bin", "t%C3%BCr.bin"),
        ] {
            assert_eq!(escaped_uri(name), want);
        }
    }
}
