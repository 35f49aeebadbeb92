//! Which brace is missing: a guess from the indentation, for the message only.

use super::{Frame, Parser};
use crate::diagnostic::Severity;
use crate::lex;
use crate::source::{LineCounter, Span};
use crate::text::text_of;
use crate::tree::Node;

/// Longest way back to the beginning of a line that is gone: machine-written lines can be
/// megabytes long, and their indentation says nothing.
const REACH: usize = 256;

impl Parser<'_> {
    /// Reports that the text ends inside bodies: at the node whose brace seems to be missing, else
    /// at the outermost open one.
    pub(super) fn report_missing_brace(&mut self) {
        let outermost = self.frames.iter().find_map(|frame| match frame {
            Frame::Body { node, .. } => Some(self.tree.node(*node)),
            _ => None,
        });
        let suspect = self.closed_too_far_out();
        let Some(node) = suspect.or(outermost) else {
            return;
        };
        let class = text_of(node.class);
        let (message, hint) = if suspect.is_some() {
            let brace = node.span.end as usize - 1;
            let line = LineCounter::new(0).position(self.bytes, brace).line;
            (
                format!("the closing brace of this {class} seems to be missing"),
                format!(
                    "the brace in line {line}, which was taken for it, is indented like that of \
                     a node around it; what was open at the end was closed"
                ),
            )
        } else {
            (
                format!("the text ends before the closing brace of this {class}"),
                "the open nodes were closed; the file may be cut off".to_owned(),
            )
        };
        let span = Span {
            start: node.span.start,
            end: node.span.start + node.class.len() as u32,
        };
        self.problem(Severity::Warning, "missing-brace", &message, &hint, span);
    }

    /// The node closed first of those whose closing brace begins a line that is indented less than
    /// the line where the node begins.
    fn closed_too_far_out(&self) -> Option<&Node<'_>> {
        let is_too_far_out = |node: &&Node<'_>| {
            let end = node.span.end as usize;
            // Open nodes end behind their opening brace so far.
            if end == 0 || self.bytes.get(end - 1) != Some(&b'}') {
                return false;
            }
            let (Some((own, _)), Some((closing, first))) = (
                self.line_of(node.span.start as usize),
                self.line_of(end - 1),
            ) else {
                return false;
            };
            // Tabs and blanks are not compared with each other.
            first == end - 1 && closing.len() < own.len() && own.starts_with(closing)
        };
        let nodes = self.tree.nodes.iter();
        nodes.filter(is_too_far_out).min_by_key(|n| n.span.end)
    }

    /// The indentation of the line of byte `at`, and where it ends.
    fn line_of(&self, at: usize) -> Option<(&[u8], usize)> {
        let from = at.saturating_sub(REACH);
        let is_end = |b: &u8| matches!(b, b'\n' | b'\r');
        let start = match self.bytes[from..at].iter().rposition(is_end) {
            Some(i) => from + i + 1,
            None if from == 0 => 0,
            None => return None,
        };
        let is_indent = |b: &&u8| lex::is_blank(**b);
        let len = self.bytes[start..=at].iter().take_while(is_indent).count();
        Some((&self.bytes[start..start + len], start + len))
    }
}
