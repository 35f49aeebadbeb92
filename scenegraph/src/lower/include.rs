//! `File` and `WWWInline`: models in models.
//!
//! A file that is included twice is read once and shared. A file cannot include itself, neither
//! directly nor by way of others.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use iv_parser::{Diagnostic, NodeId as TreeId, Severity, SourcePos};
use rustc_hash::{FxHashMap, FxHashSet};

use super::{Builder, File};
use crate::graph::{Node, NodeId};
use crate::loader::Loader;
use crate::registry::Class;

/// Most files that one model may bring in.
const MAX_FILES: usize = 10_000;

/// A reference that waits to be followed.
struct Pending {
    node: NodeId,
    file: u32,
    name: Arc<str>,
    pos: SourcePos,
}

pub(super) struct Includes<'l> {
    loader: &'l dyn Loader,
    pending: Vec<Pending>,
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
            pending: Vec::new(),
            known: FxHashMap::default(),
            edges: Vec::new(),
            connected: FxHashSet::default(),
        }
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

impl File<'_, '_, '_, '_> {
    /// Remembers the reference of a node that includes a file.
    pub(super) fn note_include(&mut self, id: TreeId, node: &Node) {
        if !matches!(node.class(), Some(Class::File | Class::WWWInline))
            || node.entry("name").is_none()
        {
            return;
        }
        if let Some(name) = node.text("name") {
            let pending = Pending {
                node: NodeId(self.base + id.0),
                file: self.index,
                name: Arc::clone(name),
                pos: node.pos,
            };
            self.builder.includes.pending.push(pending);
        }
    }
}

impl Builder<'_> {
    /// Follows all references, those of files just read included.
    pub(super) fn load_includes(&mut self) {
        let mut next = 0;
        while next < self.includes.pending.len() {
            self.follow(next);
            next += 1;
        }
    }

    fn follow(&mut self, index: usize) {
        let Pending {
            node,
            file,
            ref name,
            pos,
        } = self.includes.pending[index];
        let name = Arc::clone(name);
        let folder = self.files[file as usize].folder.clone();
        let loader = self.includes.loader;
        let found = loader.find(&folder, &name).map_err(|e| e.to_string());
        match found.and_then(|id| self.included(id, file)) {
            Ok(root) => self.nodes[node.0 as usize].children = vec![root],
            Err(why) => {
                // An inline that brings its own stand-in loses little.
                let includer = &self.nodes[node.0 as usize];
                let is_inline = includer.class() == Some(Class::WWWInline);
                let stand_in = is_inline.then(|| includer.node_field("alternateRep"));
                let stand_in = stand_in.flatten();
                self.nodes[node.0 as usize].children = stand_in.into_iter().collect();
                self.diagnostics.push(Diagnostic {
                    severity: match stand_in {
                        Some(_) => Severity::Warning,
                        None => Severity::Error,
                    },
                    code: "include",
                    message: format!("`{name}` is not included: {why}"),
                    hint: if name.contains("://") { String::new() } else { "it is looked for beside this file, then beside the first file, then in the --search folders".to_owned() },
                    file: Arc::clone(&self.files[file as usize].name),
                    pos,
                    snippet: None,
                });
            }
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

    fn included(&mut self, id: PathBuf, from: u32) -> Result<NodeId, String> {
        let known = self.includes.known.get(&id).copied();
        if let Some((file, root)) = known {
            // What is connected already was found to be without a circle.
            let is_new = !self.includes.connected.contains(&(from, file));
            if is_new && self.includes.reaches(file, from) {
                return Err(format!(
                    "`{}`, which was found for it, includes this file, and that would never end",
                    self.files[file as usize].name
                ));
            }
            self.includes.connect(from, file);
            return Ok(root);
        }
        if self.files.len() >= MAX_FILES {
            return Err(format!("more than {MAX_FILES} files"));
        }
        let bytes = self.includes.loader.read(&id).map_err(|e| e.to_string())?;
        let file = self.files.len() as u32;
        self.includes.connect(from, file);
        let name = self.shown(&id);
        let folder = id.parent().unwrap_or(Path::new("")).to_owned();
        // As in SoFile: what stands at the top of the file leaks into the one that includes it.
        let root = self.file(&bytes, name, &folder, Class::Group);
        self.includes.known.insert(id, (file, root));
        Ok(root)
    }
}
