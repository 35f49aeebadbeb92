//! `File`, `WWWInline` and `Inline`: models in models.
//!
//! A file that is included twice is read once and shared. A file cannot include itself, neither
//! directly nor by way of others.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use iv_parser::{Diagnostic, Severity, SourcePos};
use rustc_hash::{FxHashMap, FxHashSet};

use super::Builder;
use crate::graph::{Node, NodeId};
use crate::loader::{LoadError, Loader};
use crate::registry::Class;

/// Most files that one model may bring in.
const MAX_FILES: usize = 10_000;

/// A reference that waits to be followed.
struct Pending {
    node: NodeId,
    file: u32,
    /// Tried in order.
    names: Vec<Arc<str>>,
    pos: SourcePos,
}

pub(super) struct Includes<'l> {
    loader: &'l dyn Loader,
    pending: VecDeque<Pending>,
    known: FxHashMap<PathBuf, (u32, NodeId)>,
    /// For each file, the files it includes, each once.
    edges: Vec<Vec<u32>>,
    /// The same, as pairs.
    connected: FxHashSet<(u32, u32)>,
}

impl<'l> Includes<'l> {
    pub(super) fn new(loader: &'l dyn Loader) -> Self {
        Self {
            loader,
            pending: VecDeque::new(),
            known: FxHashMap::default(),
            edges: Vec::new(),
            connected: FxHashSet::default(),
        }
    }

    pub(super) fn loader(&self) -> &'l dyn Loader {
        self.loader
    }

    pub(super) fn unpack_limits(&self) -> unpack::Limits {
        self.loader.unpack_limits()
    }

    /// Makes the first file known, so that others that include it are refused.
    pub(super) fn know_root(&mut self, name: &str, folder: &Path, root: NodeId) {
        if let Some(last) = Path::new(name).file_name() {
            self.known.insert(folder.join(last), (0, root));
        }
    }

    /// Whether `from` includes `to`, directly or by way of others, or is it.
    fn reaches(&self, from: u32, to: u32) -> bool {
        let mut seen = vec![false; self.edges.len()];
        let mut open = vec![from];
        while let Some(file) = open.pop() {
            if file == to {
                return true;
            }
            if let Some(seen) = seen.get_mut(file as usize)
                && !std::mem::replace(seen, true)
            {
                open.extend(&self.edges[file as usize]);
            }
        }
        false
    }

    fn connect(&mut self, from: u32, to: u32) {
        if !self.connected.insert((from, to)) {
            return;
        }
        let size = from.max(to) as usize + 1;
        if self.edges.len() < size {
            self.edges.resize_with(size, Vec::new);
        }
        self.edges[from as usize].push(to);
    }
}

/// Why a file is not included.
#[derive(Debug)]
pub(super) struct Failure {
    pub message: String,
    /// What can be done about it.
    pub hint: &'static str,
}

impl Failure {
    pub fn of(error: LoadError) -> Self {
        Self {
            message: error.to_string(),
            hint: match error {
                LoadError::NotFound => {
                    "it is looked for beside this file, then beside the first file, then in the \
                     --search folders"
                }
                LoadError::Outside => "--search allows a folder",
                LoadError::Remote | LoadError::Unreadable(_) => "",
            },
        }
    }
}

/// The part of a reference before `#`, which says what of the file is meant.
pub(super) fn file_part(url: &str) -> &str {
    url.split_once('#').map_or(url, |(file, _)| file)
}

impl Builder<'_> {
    /// Remembers the references of a node that includes a file.
    pub(super) fn note_include(&mut self, id: NodeId, node: &Node) {
        let names: Vec<Arc<str>> = match node.class() {
            Some(Class::File | Class::WWWInline) if node.entry("name").is_some() => {
                node.text("name").cloned().into_iter().collect()
            }
            Some(Class::VRMLInline) => {
                let urls = node.value("url").texts();
                urls.iter().map(|url| file_part(url).into()).collect()
            }
            _ => return,
        };
        if !names.is_empty() {
            self.includes.pending.push_back(Pending {
                node: id,
                file: node.pos.file,
                names,
                pos: node.pos,
            });
        }
    }

    /// Follows all references, those of files just read included.
    pub(super) fn load_includes(&mut self) {
        while let Some(pending) = self.includes.pending.pop_front() {
            self.follow(&pending);
        }
    }

    fn follow(&mut self, pending: &Pending) {
        let &Pending {
            node, file, pos, ..
        } = pending;
        let mut first_failure = None;
        for name in &pending.names {
            match self.open(name, file) {
                Ok((_, root)) => {
                    self.nodes[node.0 as usize].children = vec![root];
                    return;
                }
                Err(why) => {
                    first_failure.get_or_insert((name, why));
                }
            }
        }
        let Some((name, why)) = first_failure else {
            return;
        };
        // An inline that brings its own stand-in loses little.
        let includer = &self.nodes[node.0 as usize];
        let is_inline = includer.class() == Some(Class::WWWInline);
        let stand_in = is_inline.then(|| includer.node_field("alternateRep"));
        let stand_in = stand_in.flatten();
        self.nodes[node.0 as usize].children = stand_in.into_iter().collect();
        let severity = match stand_in {
            Some(_) => Severity::Warning,
            None => Severity::Error,
        };
        self.report_missing(severity, name, &why, file, pos);
    }

    /// Says that a file was not read.
    pub(super) fn report_missing(
        &mut self,
        severity: Severity,
        name: &str,
        why: &Failure,
        file: u32,
        pos: SourcePos,
    ) {
        self.diagnostics.push(Diagnostic {
            severity,
            code: "include",
            message: format!("`{name}` is not included: {}", why.message),
            hint: why.hint.to_owned(),
            file: Arc::clone(&self.files[file as usize].name),
            pos,
            snippet: None,
        });
    }

    /// The number and the root of the file called `name` by file number `from`.
    pub(super) fn open(&mut self, name: &str, from: u32) -> Result<(u32, NodeId), Failure> {
        let folder = self.files[from as usize].folder.clone();
        let loader = self.includes.loader;
        let id = loader.find(&folder, name).map_err(Failure::of)?;
        self.included(id, from)
    }

    /// The number of the file called `name` by file number `from`, which may be that file itself.
    pub(super) fn library(&mut self, name: &str, from: u32) -> Result<u32, Failure> {
        if name.is_empty() {
            return Ok(from);
        }
        let folder = self.files[from as usize].folder.clone();
        let loader = self.includes.loader;
        let id = loader.find(&folder, name).map_err(Failure::of)?;
        match self.includes.known.get(&id) {
            Some(&(file, _)) if file == from => Ok(from),
            _ => self.included(id, from).map(|(file, _)| file),
        }
    }

    /// A file's name for display: as the first file's is written, where it lies below its folder.
    fn shown(&self, path: &Path) -> Arc<str> {
        let first = &self.files[0];
        let folder = Path::new(&*first.name).parent().unwrap_or(Path::new(""));
        match path.strip_prefix(&first.folder) {
            Ok(below) => folder.join(below).to_string_lossy().into(),
            Err(_) => path.to_string_lossy().into(),
        }
    }

    fn included(&mut self, id: PathBuf, from: u32) -> Result<(u32, NodeId), Failure> {
        let known = self.includes.known.get(&id).copied();
        if let Some((file, root)) = known {
            // What is connected already was found to be without a circle.
            let is_new = !self.includes.connected.contains(&(from, file));
            if is_new && self.includes.reaches(file, from) {
                return Err(Failure {
                    message: format!(
                        "`{}`, which was found for it, includes this file, and that would never \
                         end",
                        self.files[file as usize].name
                    ),
                    hint: "if another file is meant, put it beside this one or give its folder \
                           with --search",
                });
            }
            self.includes.connect(from, file);
            return Ok((file, root));
        }
        if self.files.len() >= MAX_FILES {
            return Err(Failure {
                message: format!("the model has more than {MAX_FILES} files"),
                hint: "",
            });
        }
        let bytes = self.includes.loader.read(&id).map_err(Failure::of)?;
        let file = self.files.len() as u32;
        self.includes.connect(from, file);
        let name = self.shown(&id);
        let folder = id.parent().unwrap_or(Path::new("")).to_owned();
        // As in SoFile: what stands at the top of the file leaks into the one that includes it.
        let root = self.file(&bytes, name, &folder, Class::Group);
        self.includes.known.insert(id, (file, root));
        Ok((file, root))
    }
}
