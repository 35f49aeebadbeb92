//! Remarks made while resolving, one for each kind and subject, with a count.

use std::sync::Arc;

use iv_parser::{Diagnostic, Severity, SourcePos};
use rustc_hash::FxHashMap;

/// Different messages that are kept; of each further code there is one more.
const MAX_KINDS: usize = 500;

/// Collects remarks; repeated ones are counted, not kept.
#[derive(Debug, Default)]
pub struct Remarks {
    list: Vec<Remark>,
    index: FxHashMap<(&'static str, String), usize>,
}

#[derive(Debug)]
struct Remark {
    severity: Severity,
    code: &'static str,
    message: String,
    hint: &'static str,
    pos: SourcePos,
    count: usize,
}

impl Remarks {
    /// A warning about `pos`. Those of the same code and message are counted as one.
    pub fn warn(&mut self, code: &'static str, message: &str, hint: &'static str, pos: SourcePos) {
        self.add(Severity::Warning, code, message, hint, pos);
    }

    /// As [`Self::warn`], with any severity.
    pub fn add(
        &mut self,
        severity: Severity,
        code: &'static str,
        message: &str,
        hint: &'static str,
        pos: SourcePos,
    ) {
        self.count(severity, code, message, hint, pos, 1);
    }

    /// As [`Self::add`], of so many things at once.
    pub fn count(
        &mut self,
        severity: Severity,
        code: &'static str,
        message: &str,
        hint: &'static str,
        pos: SourcePos,
        count: usize,
    ) {
        // A message that is another one each time must not fill up memory.
        let is_full = self.list.len() >= MAX_KINDS;
        let message = match is_full && !self.index.contains_key(&(code, message.to_owned())) {
            true => "there is more of this kind",
            false => message,
        };
        let key = (code, message.to_owned());
        if let Some(&i) = self.index.get(&key) {
            self.list[i].count += count;
            return;
        }
        self.index.insert(key, self.list.len());
        self.list.push(Remark {
            severity,
            code,
            message: message.to_owned(),
            hint,
            pos,
            count,
        });
    }

    /// All remarks in order of first occurrence.
    pub fn into_diagnostics(self, files: &[Arc<str>]) -> Vec<Diagnostic> {
        let finish = |remark: Remark| {
            let times = match remark.count {
                1 => String::new(),
                n => format!(" ({n} times, first here)"),
            };
            Diagnostic {
                severity: remark.severity,
                code: remark.code,
                message: remark.message + &times,
                hint: remark.hint.to_owned(),
                file: files
                    .get(remark.pos.file as usize)
                    .cloned()
                    .unwrap_or_else(|| "".into()),
                pos: remark.pos,
                snippet: None,
            }
        };
        self.list.into_iter().map(finish).collect()
    }
}
