//! Inventor to Inventor, text or binary. Works on the syntax alone: unknown nodes, names, connections
//! and references to other files stay as they are.

use std::io;
use std::path::Path;
use std::sync::Arc;

use convert::command::model::Opened;
use convert::command::{atomic, model};
use iv_parser::{Diagnostic, Limits, Problem, Severity, Source, SourcePos, Tree};
use scenegraph::RegistryLayout;

use super::references;

/// A text and what is wrong with it.
pub struct Text<'a> {
    bytes: &'a [u8],
    tree: Tree<'a>,
    /// Problems in order of place.
    pub diagnostics: Vec<Diagnostic>,
}

impl<'a> Text<'a> {
    /// Reads a text; `name` is shown in diagnostics.
    pub fn of(bytes: &'a [u8], name: &Arc<str>) -> Self {
        let parse = iv_parser::parse_any(bytes, &RegistryLayout, &Limits::default());
        let source = Source {
            name,
            file: 0,
            bytes,
        };
        // What the parser says about bytes of another format means nothing.
        let (problems, dropped) = match scenegraph::is_other_text(&parse) {
            Some(problem) => (vec![problem], 0),
            None => (parse.problems, parse.problems_dropped),
        };
        let mut diagnostics = source.diagnostics(problems);
        if dropped > 0 {
            diagnostics.push(Diagnostic {
                severity: Severity::Warning,
                code: "more-problems",
                message: format!("{dropped} more problems are not shown"),
                hint: String::new(),
                file: Arc::clone(name),
                pos: SourcePos::default(),
                snippet: None,
            });
        }
        Self {
            bytes,
            tree: parse.tree,
            diagnostics,
        }
    }

    /// Whether nothing of it could be read.
    pub fn is_unsupported(&self) -> bool {
        model::is_unsupported(&self.diagnostics)
    }

    /// What it refers to and would no longer find when it is written into the folder `to`.
    pub fn left_behind(&self, name: &Arc<str>, from: &Opened, to: &Path) -> Vec<Diagnostic> {
        self.placed(name, references::left_behind(&self.tree, from, to))
    }

    fn placed(&self, name: &Arc<str>, problems: Vec<Problem>) -> Vec<Diagnostic> {
        let source = Source {
            name,
            file: 0,
            bytes: self.bytes,
        };
        source.diagnostics(problems)
    }

    /// Whether it can be written as a binary file.
    pub fn has_binary_form(&self) -> bool {
        iv_parser::has_binary_form(&self.tree.header)
    }

    /// Number of nodes written in it.
    pub fn node_count(&self) -> usize {
        self.tree.node_count()
    }

    /// Writes it as text, laid out anew, or as a binary file. Returns its length, and what could
    /// not be kept.
    ///
    /// # Errors
    ///
    /// As [`atomic::write`].
    pub fn write(
        &self,
        path: &Path,
        name: &Arc<str>,
        is_binary: bool,
    ) -> io::Result<(u64, Vec<Diagnostic>)> {
        let mut lost = Vec::new();
        let length = atomic::write(path, |out| {
            if !is_binary {
                return iv_parser::print(&self.tree, &RegistryLayout, out);
            }
            lost = iv_parser::print_binary(&self.tree, &RegistryLayout, out)?;
            Ok(())
        })?;
        Ok((length, self.placed(name, lost)))
    }
}
