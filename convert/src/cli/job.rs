//! One input to one output. Prints nothing: all there is to say is in the [`Outcome`].

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use convert::command::access::Access;
use convert::command::atomic;
use convert::command::fonts;
use convert::command::messages::{file_of, image_left_out};
use convert::command::model::{self, Opened};
use convert::{Container, Loss, Options, Recorder, Report, Source};
use iv_parser::{Diagnostic, Severity, SourcePos};
use scenegraph::{Graph, Loader, ResolveOptions, Resolved};
use serde_json::{Value, json};

use super::args::{Args, Format};
use super::inputs::Input;
use super::{from_gltf, inventor};

/// Why an input of a format that is not read failed; its diagnostic says which format it is.
pub const UNSUPPORTED: &str = "not converted: its format is not read";

/// What is the same for all inputs.
#[derive(Clone)]
pub struct Settings {
    /// `None` if no format could be settled; no input has an output then.
    format: Option<Format>,
    options: Options,
    /// How inputs are opened.
    pub access: Access,
    /// Inventor files are written in binary.
    pub is_binary: bool,
    /// The source goes into the output.
    pub round_trip: bool,
    /// Images go into an Inventor text.
    pub embed: bool,
    resolve: ResolveOptions,
    /// Text is set in fonts of the system.
    system_fonts: bool,
}

impl Settings {
    /// As the user wants it.
    pub fn of(args: &Args, inputs: usize, access: Access) -> Self {
        let format = args.format().ok();
        let options = Options {
            container: match format {
                Some(Format::Gltf) if args.embed => Container::GltfEmbedded,
                Some(Format::Gltf) => Container::GltfBin,
                Some(Format::Html) => Container::Html,
                _ => Container::Glb,
            },
            extras: !args.no_extras,
            // Processors that no input takes for itself.
            threads: (args.jobs() / inputs.max(1)).max(1),
            ..Options::default()
        };
        Self {
            format,
            options: args.choices.apply(options),
            access,
            is_binary: args.binary,
            round_trip: args.round_trip,
            embed: args.embed,
            resolve: ResolveOptions {
                chord: args.chord,
                alternatives: args.choices.alternatives,
                ..ResolveOptions::default()
            },
            system_fonts: args.system_fonts,
        }
    }
}

/// A loss with the name of its file.
#[derive(Clone, Debug)]
pub struct NamedLoss {
    /// The loss.
    pub loss: Loss,
    /// Name for display of the file that `loss.pos` is in.
    pub file: Arc<str>,
}

/// All there is to say about one input.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// The input.
    pub input: PathBuf,
    /// Where the output is, or would have been.
    pub output: Option<PathBuf>,
    /// Why there is no output.
    pub failure: Option<String>,
    /// Length of the input.
    pub bytes_in: u64,
    /// Length of the output, all its files together.
    pub bytes_out: u64,
    /// Sizes of the output, as JSON; null if there is none.
    pub counts: Value,
    /// What was wrong with the input.
    pub diagnostics: Vec<Diagnostic>,
    /// What of the model is not in the output although glTF could carry it.
    pub warnings: Vec<Diagnostic>,
    /// What glTF cannot carry.
    pub losses: Vec<NamedLoss>,
    /// Time taken.
    pub time: Duration,
}

impl Outcome {
    fn new(input: &Input, output: Option<&Path>) -> Self {
        Self {
            input: input.path.clone(),
            output: output.map(Path::to_owned),
            ..Self::default()
        }
    }

    /// Of an input whose conversion panicked.
    pub fn broken(input: &Input, output: Option<&Path>, panic: &str) -> Self {
        Self {
            failure: Some(format!("internal error: {panic}")),
            ..Self::new(input, output)
        }
    }
}

/// Converts one input.
pub fn run(input: &Input, output: Option<&Path>, settings: &Settings) -> Outcome {
    let start = Instant::now();
    let mut outcome = Outcome::new(input, output);
    let target = match (&input.fault, output, settings.format) {
        (Some(fault), _, _) => Err(fault.clone()),
        (None, Some(path), Some(format)) => Ok((path, format)),
        _ => Err("it has no output".to_owned()),
    };
    outcome.failure = target
        .and_then(|(path, format)| match format {
            Format::Iv => to_inventor(&mut outcome, path, settings),
            Format::Glb | Format::Gltf | Format::Html => to_gltf(&mut outcome, path, settings),
        })
        .err();
    outcome.time = start.elapsed();
    outcome
}

fn to_inventor(outcome: &mut Outcome, path: &Path, settings: &Settings) -> Result<(), String> {
    let opened = model::open(&outcome.input, &settings.access)?;
    outcome.bytes_in = opened.packed_len;
    if convert::is_gltf(&opened.bytes) {
        return from_gltf::to_inventor(outcome, &opened, path, settings);
    }
    let name: Arc<str> = opened.name.as_str().into();
    let text = inventor::Text::of(&opened.bytes, &name);
    outcome.diagnostics.clone_from(&opened.diagnostics);
    outcome.diagnostics.extend_from_slice(&text.diagnostics);
    if text.is_unsupported() {
        return Err(UNSUPPORTED.to_owned());
    }
    if settings.is_binary && !text.has_binary_form() {
        return Err("VRML has no binary form; leave out --binary".to_owned());
    }
    atomic::make_folder_of(path)?;
    outcome.warnings = text.left_behind(&name, &opened, model::folder_of(path));
    let (length, lost) = text
        .write(path, &name, settings.is_binary)
        .map_err(|error| atomic::cannot_write(path, &error))?;
    outcome.bytes_out = length;
    outcome.warnings.extend(lost);
    outcome.counts = json!({ "nodes": text.node_count() });
    Ok(())
}

fn to_gltf(outcome: &mut Outcome, path: &Path, settings: &Settings) -> Result<(), String> {
    let opened = model::open(&outcome.input, &settings.access)?;
    outcome.bytes_in = opened.packed_len;
    if convert::is_gltf(&opened.bytes) {
        return Err(from_gltf::IS_GLTF.to_owned());
    }
    let Opened {
        bytes,
        name,
        folder,
        files,
        diagnostics,
        ..
    } = opened;
    outcome.diagnostics = diagnostics;
    let recorder = Recorder::new(&files, &folder);
    let keep = settings.round_trip;
    let loader: &dyn Loader = if keep { &recorder } else { &files };
    let graph = scenegraph::load(&bytes, &name, &folder, loader);
    // Text and graph take up no memory while the output is made.
    let text = keep.then_some(bytes);
    let resolved = resolved(outcome, graph, settings)?;
    let scene = resolved.scene;
    atomic::make_folder_of(path)?;
    let report = match text {
        Some(text) => {
            let source = Source {
                text: &text,
                recorder: &recorder,
                resolve: &settings.resolve,
            };
            convert::write_file_with_source(&scene, &settings.options, &source, path)
        }
        None => convert::write_file(&scene, &settings.options, &model::Images(&files), path),
    };
    let report = report.map_err(|error| words(&error))?;
    outcome.bytes_out = report.counts.bytes;
    outcome.counts = counts(&report, scene.instances.len());
    if scene.instances.is_empty() {
        outcome.warnings.push(no_geometry(&outcome.input));
    }
    let left_out = report.warnings.into_iter();
    outcome
        .warnings
        .extend(left_out.map(|warning| image_left_out(warning, &scene)));
    let losses = report.losses.into_iter().map(|loss| NamedLoss {
        file: file_of(&scene, loss.pos),
        loss,
    });
    outcome.losses.extend(losses);
    Ok(())
}

/// Resolves a graph, which is gone then.
fn resolved(
    outcome: &mut Outcome,
    mut graph: Graph,
    settings: &Settings,
) -> Result<Resolved, String> {
    outcome.diagnostics.append(&mut graph.diagnostics);
    if model::is_unsupported(&outcome.diagnostics) {
        return Err(UNSUPPORTED.to_owned());
    }
    if settings.system_fonts {
        fonts::add_system_fonts(&mut graph);
    }
    let mut resolved = scenegraph::resolve(&graph, &settings.resolve);
    outcome.diagnostics.append(&mut resolved.diagnostics);
    Ok(resolved)
}

fn words(error: &convert::Error) -> String {
    match error {
        convert::Error::Io {
            path: Some(path),
            source,
        } => atomic::cannot_write(path, source),
        convert::Error::Target { path, reason } => {
            format!("cannot write {}: {reason}", path.display())
        }
        other => other.to_string(),
    }
}

fn counts(report: &Report, instances: usize) -> Value {
    let counts = &report.counts;
    json!({
        "nodes": counts.nodes,
        "meshes": counts.meshes,
        "instances": instances,
        "triangles": { "unique": counts.triangles, "instanced": counts.triangles_drawn },
        "materials": counts.materials,
        "textures": counts.images,
        "lights": counts.lights,
        "cameras": counts.cameras,
    })
}

fn no_geometry(input: &Path) -> Diagnostic {
    Diagnostic {
        severity: Severity::Warning,
        code: "no-geometry",
        message: "nothing in this model is drawn".to_owned(),
        hint: "the output holds no meshes".to_owned(),
        file: input.display().to_string().into(),
        pos: SourcePos::default(),
        snippet: None,
    }
}
