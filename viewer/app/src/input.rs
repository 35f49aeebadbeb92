//! The model: read, told apart by content, resolved. Prints nothing; what is wrong with it is in
//! the list of diagnostics.

use std::path::Path;
use std::time::{Duration, Instant};

use convert::command::access::Access;
use convert::command::archive::OpenError;
use convert::command::fonts;
use convert::command::model::{self, Files, Opened};
use convert::{ReadLimits, read_gltf};
use iv_parser::{Diagnostic, Severity, SourcePos};
use scenegraph::ResolveOptions;
use scenegraph::scene::Scene;
use viewer::view::framing::Up;

use crate::cli::args::Args;

/// A model in memory.
pub struct Input {
    /// What is drawn.
    pub scene: Scene,
    /// `inventor` or `gltf`.
    pub format: &'static str,
    /// Which way is up if nobody says so.
    pub up: Up,
    /// Opens what the model names.
    pub files: Files,
    /// Reading, and parsing text or JSON.
    pub read_time: Duration,
    /// From the graph to the scene; none for glTF.
    pub resolve_time: Duration,
}

/// Reads a model. Adds what is wrong with it to `diagnostics`, also when it fails.
///
/// # Errors
///
/// Why there is nothing to draw.
pub fn read(
    path: &Path,
    args: &Args,
    access: &Access,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Input, OpenError> {
    let start = Instant::now();
    let mut opened = model::open(path, access)?;
    if is_gltf(&opened.bytes) {
        diagnostics.append(&mut opened.diagnostics);
        return gltf(path, opened, start, diagnostics);
    }
    let (mut graph, files) = opened.into_graph();
    let read_time = start.elapsed();
    diagnostics.append(&mut graph.diagnostics);
    if model::is_unsupported(diagnostics) {
        return Err("not shown: its format is not read".to_owned().into());
    }
    let start = Instant::now();
    if args.system_fonts {
        fonts::add_system_fonts(&mut graph);
    }
    let options = ResolveOptions {
        chord: args.chord,
        ..ResolveOptions::default()
    };
    let mut resolved = scenegraph::resolve(&graph, &options);
    diagnostics.append(&mut resolved.diagnostics);
    Ok(Input {
        scene: resolved.scene,
        format: "inventor",
        up: Up::Z,
        files,
        read_time,
        resolve_time: start.elapsed(),
    })
}

fn gltf(
    path: &Path,
    opened: Opened,
    start: Instant,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Input, OpenError> {
    let Opened {
        bytes,
        name,
        folder,
        files,
        ..
    } = opened;
    let model = read_gltf(&bytes, &name, &folder, &files, &ReadLimits::default())
        .map_err(|error| error.to_string())?;
    let left_out = model.warnings.into_iter();
    diagnostics.extend(left_out.map(|message| warning(path, "gltf", message, "")));
    Ok(Input {
        scene: model.scene,
        format: "gltf",
        up: if model.is_from_inventor { Up::Z } else { Up::Y },
        files,
        read_time: start.elapsed(),
        resolve_time: Duration::ZERO,
    })
}

/// A warning about the whole of a model.
pub fn warning(path: &Path, code: &'static str, message: String, hint: &str) -> Diagnostic {
    Diagnostic {
        severity: Severity::Warning,
        code,
        message,
        hint: hint.to_owned(),
        file: path.display().to_string().into(),
        pos: SourcePos::default(),
        snippet: None,
    }
}

/// Whether bytes are a `.glb`, or JSON: no text of Inventor begins with a brace.
fn is_gltf(bytes: &[u8]) -> bool {
    const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
    let text = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    bytes.starts_with(b"glTF") || text.trim_ascii_start().starts_with(b"{")
}
