//! `--info`: what is in a model. Each mesh is made to count it, none is kept, and no image is
//! opened.

pub mod json;
mod measure;
pub mod table;

use std::path::{Path, PathBuf};

use convert::command::access::Access;
use convert::command::{fonts, model};
use iv_parser::{Diagnostic, Dialect, Encoding, Header};
use scenegraph::{Geometry, ResolveOptions};

use super::args::Args;
use super::inputs::Input;

pub use measure::{Content, TextureKind};

/// All there is to show about one input.
#[derive(Clone, Debug, Default)]
pub struct Info {
    /// The input.
    pub path: PathBuf,
    /// Its length.
    pub bytes: u64,
    /// Why nothing can be shown.
    pub failure: Option<String>,
    /// What was wrong with it.
    pub diagnostics: Vec<Diagnostic>,
    /// What is in it.
    pub content: Option<Content>,
}

impl Info {
    fn new(path: &Path) -> Self {
        Self {
            path: path.to_owned(),
            ..Self::default()
        }
    }

    /// Of an input on which the work panicked.
    pub fn broken(input: &Input, panic: &str) -> Self {
        Self {
            failure: Some(format!("internal error: {panic}")),
            ..Self::new(&input.path)
        }
    }
}

/// Reads an input and measures it.
pub fn of(input: &Input, args: &Args, access: &Access) -> Info {
    let mut info = Info::new(&input.path);
    let content = match &input.fault {
        Some(fault) => Err(fault.clone()),
        None => content(&mut info, args, access),
    };
    match content {
        Ok(content) => info.content = Some(content),
        Err(why) => info.failure = Some(why),
    }
    info
}

fn content(info: &mut Info, args: &Args, access: &Access) -> Result<Content, String> {
    let opened = model::open(&info.path, access)?;
    info.bytes = opened.packed_len;
    let (mut graph, _) = opened.into_graph();
    info.diagnostics = std::mem::take(&mut graph.diagnostics);
    if model::is_unsupported(&info.diagnostics) {
        return Err("its format is not read".to_owned());
    }
    if args.system_fonts {
        fonts::add_system_fonts(&mut graph);
    }
    let options = ResolveOptions {
        geometry: Geometry::Measure,
        chord: args.chord,
        ..ResolveOptions::default()
    };
    let mut resolved = scenegraph::resolve(&graph, &options);
    info.diagnostics.append(&mut resolved.diagnostics);
    Ok(Content::of(&graph, &resolved))
}

/// The first line of a file as it would be written today.
pub fn format_name(header: &Header) -> String {
    let dialect = match header.dialect {
        Dialect::Inventor => "Inventor",
        Dialect::Vrml1 | Dialect::Vrml2 => "VRML",
    };
    let encoding = match header.encoding {
        Encoding::Ascii if header.dialect == Dialect::Vrml2 => "utf8",
        Encoding::Ascii => "ascii",
        Encoding::Binary => "binary",
    };
    let (major, minor) = header.version;
    format!("{dialect} V{major}.{minor} {encoding}")
}
