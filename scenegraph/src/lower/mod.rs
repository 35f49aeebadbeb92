//! Syntax to scene graph: classes and fields get their meaning, names become shared handles, old
//! versions are upgraded, included files are read.
//!
//! Never fails: what cannot be used is reported and left out. Nodes of the tree and nodes of the
//! graph correspond one to one, so no traversal is needed; only what upgrading adds comes behind.

mod connect;
mod decimal;
mod expand;
mod include;
#[cfg(test)]
mod kit_tests;
mod kits;
mod late;
mod names;
mod node;
mod pictures;
mod proto;
mod schema;
mod swept;
mod upgrade;
mod value;

use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;

use iv_parser::{
    Child, Diagnostic, Dialect, Form, LineCounter, Problem, Severity, Source, SourcePos, Span, Tree,
};

use rustc_hash::FxHashMap;

use crate::graph::{Graph, Kind, Node, NodeId, SourceFile};
use crate::loader::Loader;
use crate::registry::Class;

use expand::Expansion;
use include::Includes;
use late::Late;
use names::{Names, Reference, Scope};
use proto::Protos;

pub(crate) use pictures::picture_name;
pub use schema::RegistryLayout;
pub(crate) use value::read_default;

/// Reads a model and all it includes, with the default limits of the parser.
///
/// `name` is shown in diagnostics; references are looked for in `folder` first, which should be a
/// canonical path: `folder` and the last part of `name` tell a file that includes itself.
pub fn load(bytes: &[u8], name: &str, folder: &Path, loader: &dyn Loader) -> Graph {
    load_with(bytes, name, folder, loader, &iv_parser::Limits::default())
}

/// As [`load`], with limits.
pub fn load_with(
    bytes: &[u8],
    name: &str,
    folder: &Path,
    loader: &dyn Loader,
    limits: &iv_parser::Limits,
) -> Graph {
    let mut builder = Builder {
        nodes: Vec::new(),
        files: Vec::new(),
        diagnostics: Vec::new(),
        includes: Includes::new(loader),
        protos: Protos::default(),
        expansion: Expansion::default(),
        late: Late::default(),
        limits: *limits,
    };
    let root = builder.file(bytes, name.into(), folder, Class::Separator);
    builder.includes.know_root(name, folder, root);
    builder.complete();
    builder.settle_late();
    let pictures = builder.look_at_pictures();
    Graph {
        fonts: Vec::new(),
        pictures,
        nodes: builder.nodes,
        root,
        files: builder.files,
        diagnostics: iv_parser::collapsed(builder.diagnostics),
    }
}

struct Builder<'l> {
    nodes: Vec<Node>,
    files: Vec<SourceFile>,
    diagnostics: Vec<Diagnostic>,
    includes: Includes<'l>,
    protos: Protos,
    expansion: Expansion,
    late: Late,
    limits: iv_parser::Limits,
}

impl Builder<'_> {
    /// Adds one file; returns its root: the only Separator at its top, or one group of class
    /// `around` around all that is there.
    fn file(&mut self, bytes: &[u8], name: Arc<str>, folder: &Path, around: Class) -> NodeId {
        let index = self.files.len() as u32;
        let (bytes, packing) = unpacked(bytes, &self.includes.unpack_limits());
        let bytes = &*bytes;
        let mut parsed = iv_parser::parse_any(bytes, &RegistryLayout, &self.limits);
        if let Some(problem) = packing {
            // Of what did not come out nothing else can be said.
            parsed.problems.retain(|_| !bytes.is_empty());
            parsed.problems.push(problem);
        }
        let header = parsed.tree.header;
        self.files.push(SourceFile {
            name: Arc::clone(&name),
            folder: folder.to_owned(),
            header,
        });
        let mut problems = parsed.problems;
        let mut dropped = parsed.problems_dropped;
        let is_foreign = problems.iter().any(|p| p.code == "unsupported-format");
        let without_header = problems.iter().any(|p| p.code == "no-header");
        // Without a header and without a single known class it is some other text.
        let nothing_known = without_header && !has_known_class(&parsed.tree);
        let readable = !is_foreign && !nothing_known;
        let root = if readable {
            let mut file = File {
                index,
                tree: &parsed.tree,
                names: Names::of(&parsed.tree),
                base: self.nodes.len() as u32,
                lines: LineCounter::new(index),
                owner: iv_parser::NodeId(0),
                scope: None,
                vrml2: header.dialect == Dialect::Vrml2,
                routes: 0,
                guesses: FxHashMap::default(),
                dropped: 0,
                problems: &mut problems,
                builder: self,
            };
            file.nodes();
            file.report_routes();
            let root = file.root(around);
            dropped += file.dropped;
            root
        } else {
            dropped = 0;
            if !is_foreign {
                problems.clear();
                problems.push(unreadable());
            }
            self.add(Node {
                kind: Kind::Known(Class::Separator),
                name: None,
                fields: Vec::new(),
                children: Vec::new(),
                pos: SourcePos {
                    file: index,
                    line: 1,
                    column: 1,
                },
            })
        };
        let source = Source {
            name: &name,
            file: index,
            bytes,
        };
        dropped += problems.len().saturating_sub(self.limits.problems);
        problems.truncate(self.limits.problems);
        self.diagnostics.extend(source.diagnostics(problems));
        if dropped > 0 {
            self.diagnostics.push(Diagnostic {
                severity: Severity::Warning,
                code: "more-problems",
                message: format!("{dropped} more problems are not shown"),
                hint: String::new(),
                file: name,
                pos: SourcePos {
                    file: index,
                    line: 0,
                    column: 0,
                },
                snippet: None,
            });
        }
        root
    }

    fn add(&mut self, node: Node) -> NodeId {
        self.nodes.push(node);
        NodeId(self.nodes.len() as u32 - 1)
    }
}

/// The bytes of a file that is a gzip or bzip2 stream, and what is wrong with it.
fn unpacked<'b>(bytes: &'b [u8], limits: &unpack::Limits) -> (Cow<'b, [u8]>, Option<Problem>) {
    match unpack::unpack(bytes, limits) {
        None => (bytes.into(), None),
        Some(Ok(unpacked)) => {
            let problem = unpacked.damage.map(|why| Problem {
                severity: Severity::Error,
                code: "damaged",
                message: format!("the file cannot be unpacked to its end: {why}"),
                hint: "what came out before was read".to_owned(),
                span: Span::default(),
            });
            (unpacked.bytes.into(), problem)
        }
        Some(Err(why)) => {
            // What it is packed in stands before it: no model in itself.
            let problem = Problem {
                severity: Severity::Error,
                code: "unsupported-format",
                message: format!("the file cannot be unpacked: {why}"),
                hint: String::new(),
                span: Span::default(),
            };
            ([].as_slice().into(), Some(problem))
        }
    }
}

/// Says that bytes are no model: there is neither a header nor a single known class.
pub fn is_other_text(parse: &iv_parser::Parse<'_>) -> Option<Problem> {
    let without_header = parse.problems.iter().any(|p| p.code == "no-header");
    (without_header && !has_known_class(&parse.tree)).then(unreadable)
}

fn has_known_class(tree: &Tree<'_>) -> bool {
    let mut nodes = (0..tree.node_count() as u32).map(|i| tree.node(iv_parser::NodeId(i)));
    nodes.any(|node| Class::from_name(node.class).is_some())
}

fn unreadable() -> Problem {
    Problem {
        severity: Severity::Error,
        code: "unsupported-format",
        message: "this is not an Inventor file".to_owned(),
        hint: "it has neither a header nor a node of a known class".to_owned(),
        span: Span::default(),
    }
}

/// One file while it is being added.
struct File<'b, 't, 'a, 'l> {
    index: u32,
    tree: &'t Tree<'a>,
    names: Names<'t>,
    /// Graph node of the tree's node 0.
    base: u32,
    lines: LineCounter,
    /// The node being added.
    owner: iv_parser::NodeId,
    /// The PROTO it stands in.
    scope: Scope,
    /// The file is VRML 2.
    vrml2: bool,
    /// ROUTEs met so far.
    routes: usize,
    /// Hints for the unknown classes met so far.
    guesses: FxHashMap<String, String>,
    /// Problems that were not kept.
    dropped: usize,
    problems: &'b mut Vec<Problem>,
    builder: &'b mut Builder<'l>,
}

impl<'a> File<'_, '_, 'a, '_> {
    fn root(&mut self, around: Class) -> NodeId {
        self.scope = None;
        let roots = self.tree.children_of_root().to_vec();
        let children: Vec<NodeId> = roots.iter().filter_map(|&c| self.child(c)).collect();
        if let [only] = children[..]
            && self.builder.nodes[only.0 as usize].kind == Kind::Known(Class::Separator)
        {
            return only;
        }
        // A library of prototypes needs nothing else.
        let is_library = |c: &Child<'_>| {
            matches!(c, Child::Node(id)
                if matches!(self.tree.node(*id).form, Form::Proto | Form::ExternProto))
        };
        if children.is_empty() && !roots.iter().any(is_library) {
            self.problem(
                Severity::Warning,
                "empty",
                "the file holds no nodes".to_owned(),
                "",
                Span::default(),
            );
        }
        self.builder.add(Node {
            kind: Kind::Known(around),
            name: None,
            fields: Vec::new(),
            children,
            pos: SourcePos {
                file: self.index,
                line: 1,
                column: 1,
            },
        })
    }

    /// The handle of a child, or `None` with a problem.
    fn child(&mut self, child: Child<'a>) -> Option<NodeId> {
        match child {
            Child::Null => None,
            Child::Node(id) if self.tree.node(id).form != Form::Node => None,
            Child::Node(id) => Some(NodeId(self.base + id.0)),
            Child::Use(name, span) => self.reference(name, span),
        }
    }

    fn reference(&mut self, name: &[u8], span: Span) -> Option<NodeId> {
        let shown = iv_parser::text_of(&name[..name.len().min(80)]);
        let (code, message, hint) = match self.names.find(self.tree, name, span, self.scope) {
            Reference::Node(id) => return Some(NodeId(self.base + id.0)),
            Reference::Cycle => (
                "cycle",
                format!("`{shown}` is used inside its own definition"),
                "a node cannot hold itself; this USE was left out",
            ),
            Reference::Later => (
                "used-before-def",
                format!("`{shown}` is used before it is defined"),
                "DEF must stand before USE; this USE was left out",
            ),
            Reference::Unknown => (
                "unknown-name",
                format!("no node is called `{shown}`"),
                "this USE was left out; names are case-sensitive and end at a blank",
            ),
        };
        self.problem(Severity::Error, code, message, hint, span);
        None
    }

    fn problem(
        &mut self,
        severity: Severity,
        code: &'static str,
        message: String,
        hint: &str,
        span: Span,
    ) {
        self.problems.push(Problem {
            severity,
            code,
            message,
            hint: hint.to_owned(),
            span,
        });
    }
}
