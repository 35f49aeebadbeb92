//! One glTF file to Inventor text, with its images beside it. No file is written over but an older
//! text of the same name.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use convert::command::model::Opened;
use convert::command::{atomic, model};
use convert::{InventorOptions, Note, gltf_to_inventor};
use iv_parser::{Diagnostic, Severity, SourcePos};
use serde_json::json;

use super::inventor::Text;
use super::job::{Outcome, Settings};

/// Why glTF is not made of glTF.
pub const IS_GLTF: &str = "it is glTF already; glTF is made of Inventor models only, and Inventor of glTF with `-o NAME.iv`";

/// Whether a folder on the way to a file is a link.
fn leads_away(folder: &Path, name: &str) -> bool {
    let parents = Path::new(name).ancestors().skip(1);
    let is_link = |parent: &Path| {
        let found = fs::symlink_metadata(folder.join(parent));
        found.is_ok_and(|found| found.file_type().is_symlink())
    };
    parents.filter(|p| !p.as_os_str().is_empty()).any(is_link)
}

/// Converts a `.glb` or `.gltf`.
pub fn to_inventor(
    outcome: &mut Outcome,
    opened: &Opened,
    path: &Path,
    settings: &Settings,
) -> Result<(), String> {
    let name = opened.name.clone();
    let folder = model::folder_of(path);
    let existing = |name: &str| fs::read(folder.join(name)).ok();
    let options = InventorOptions {
        embed_images: settings.embed,
        ..InventorOptions::default()
    };
    let (beside, files) = (&opened.folder, &opened.files);
    let made = gltf_to_inventor(&opened.bytes, &name, beside, files, &existing, &options)
        .map_err(|error| error.to_string())?;
    atomic::make_folder_of(path)?;
    let mut written = 0;
    for (name, bytes) in &made.beside {
        let file = folder.join(name);
        if leads_away(folder, name) {
            return Err(format!(
                "`{name}` would be written through a link to another folder"
            ));
        }
        atomic::make_folder_of(&file)?;
        written += atomic::write(&file, |out| out.write_all(bytes))
            .map_err(|error| atomic::cannot_write(&file, &error))?;
    }
    let made_name: Arc<str> = path.display().to_string().into();
    let text = Text::of(&made.text, &made_name);
    let result = if settings.is_binary && text.has_binary_form() {
        text.write(path, &made_name, true)
    } else {
        atomic::write(path, |out| out.write_all(&made.text)).map(|len| (len, Vec::new()))
    };
    let (length, lost) = result.map_err(|error| atomic::cannot_write(path, &error))?;
    outcome.warnings.extend(lost);
    outcome.bytes_out = written + length;
    let counts = made.counts;
    outcome.counts = json!({
        "nodes": counts.nodes,
        "meshes": counts.meshes,
        "instances": counts.instances,
        "materials": counts.materials,
        "files": made.beside.len(),
        "lights": counts.lights,
        "cameras": counts.cameras,
    });
    let (losses, remarks): (Vec<_>, Vec<_>) = made.notes.into_iter().partition(|n| n.is_loss);
    let diagnostic = |note: Note, severity| Diagnostic {
        severity,
        code: note.code,
        message: note.message,
        hint: note.hint.to_owned(),
        file: name.as_str().into(),
        pos: SourcePos::default(),
        snippet: None,
    };
    let warnings = losses.into_iter().map(|n| diagnostic(n, Severity::Warning));
    outcome.warnings.extend(warnings);
    let notes = remarks.into_iter().map(|n| diagnostic(n, Severity::Note));
    outcome.diagnostics.extend(notes);
    Ok(())
}
