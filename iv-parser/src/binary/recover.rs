//! Going on behind what cannot be read.

use super::{Fault, Frame, Reader};
use crate::diagnostic::Severity;
use crate::source::Span;
use crate::text::text_of;

/// How far before the place where reading failed the next node is looked for, as what was read
/// last may have been misread. More would cost more time the more there is to misread.
const REREAD: usize = 256;

impl Reader<'_, '_> {
    /// Ends what is open where nothing more can be read, and goes on at the next node.
    ///
    /// A node counts as read however little of it was, so that the numbers of children around it
    /// stay right. `start` is where the step began.
    pub(super) fn recover(&mut self, fault: Fault, start: usize) {
        let stop = self.words.at;
        let wanted = match fault {
            Fault::End => {
                let hint = "what had been read was kept; the file may have been cut off";
                let message = "the file ends in the middle of a node";
                self.problem(
                    Severity::Error,
                    "cut-off",
                    message,
                    hint,
                    self.span_from(start),
                );
                self.words.at += self.words.left();
                return self.close_down_to(0);
            }
            Fault::Bad(wanted) => wanted,
        };
        let inside = self.frames.iter().rev().find_map(|frame| match frame {
            Frame::Fields(body) => Some(body.node),
            Frame::Head { node, .. } | Frame::Children { node, .. } | Frame::Path { node, .. } => {
                Some(*node)
            }
            _ => None,
        });
        let class = inside.map(|node| text_of(self.tree.node(node).class));
        // Every place is tried, as pictures can move all that follows by one to three bytes.
        let from = stop.saturating_sub(REREAD).max(start + 1);
        let file_end = stop + self.words.left();
        let next = (from..file_end).find(|&at| self.is_node(self.words.from(at)));
        let end = next.unwrap_or(file_end);
        self.words.at = end;
        self.close_down_to(self.frame_that_goes_on());
        let message = match class {
            Some(class) => format!("in a node of class {class}, {wanted} was expected here"),
            None => format!("{wanted} was expected here"),
        };
        let hint = match next {
            Some(next) => format!("reading went on at byte {next}, with the next known node"),
            None => "no node was found behind it; the file may have been cut off".to_owned(),
        };
        let span = Span::new(stop.min(end), end);
        self.problem(Severity::Error, "unreadable", &message, &hint, span);
    }

    /// How many frames there are up to the innermost one that can take a node.
    fn frame_that_goes_on(&self) -> usize {
        let takes_node = |frame: &Frame| matches!(frame, Frame::Children { left: 1.., .. });
        self.frames
            .iter()
            .rposition(takes_node)
            .map_or(0, |index| index + 1)
    }

    fn close_down_to(&mut self, count: usize) {
        while self.frames.len() > count
            && let Some(frame) = self.frames.pop()
        {
            match frame {
                Frame::Fields(body) => {
                    self.described.truncate(body.described);
                    self.close_node(body.node, body.items);
                }
                Frame::Head { node, items }
                | Frame::Children { node, items, .. }
                | Frame::Path { node, items } => {
                    self.close_node(node, items);
                }
                Frame::Nodes {
                    field,
                    atoms,
                    is_list,
                    ..
                } => self.close_nodes(field, atoms, is_list),
                Frame::Master(field) => {
                    self.tree.fields[field.0 as usize].connection = None;
                }
            }
        }
    }
}
