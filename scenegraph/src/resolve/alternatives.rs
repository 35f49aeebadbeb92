//! What a model has besides what it shows, for those who ask for it
//! ([`ResolveOptions::alternatives`](super::ResolveOptions)): children that a Switch hides, and
//! coarser levels of detail.
//!
//! Each is visited with the state that its group began with, in a group of its own that says when
//! it is shown, and leaves no state behind: what follows goes on as without it. Its lights and
//! cameras are left out. A child that only sets the look of what follows it becomes a variant; see
//! `variants`.

use std::ops::Range;

use iv_parser::Severity;

use crate::graph::{Node, NodeId};
use crate::registry::Class;
use crate::scene::{Coarser, Shown};

use super::state::State;
use super::variants::{self, Fork, Looks};
use super::walk::{Keep, Opening, Walk};

/// What kind of group chooses among its children.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Choice {
    Switch,
    /// Children go from fine to coarse.
    Levels,
}

/// The children that a group does not show, while it is open.
pub(super) struct Others {
    pub shown: Range<usize>,
    choice: Choice,
    /// The state that the group began with.
    pub before: State,
    /// Looks that follow the group, besides the one that its shown child leaves.
    forks: Vec<Fork>,
    looks: Looks,
}

impl Others {
    pub fn new(shown: Range<usize>, choice: Choice, before: State) -> Self {
        Self {
            shown,
            choice,
            before,
            forks: Vec::new(),
            looks: Looks::Unknown,
        }
    }
}

impl Walk<'_> {
    /// Opens a group that shows only some of its children; the others are left out, or kept for
    /// those who want them.
    pub(super) fn open_choice(
        &mut self,
        id: NodeId,
        shown: Range<usize>,
        choice: Choice,
        isolates: bool,
    ) {
        let node = self.graph.node(id);
        let count = node.children.len();
        if shown.len() >= count {
            return self.open(id, 0, count, isolates);
        }
        if !self.options.alternatives {
            let text = match choice {
                Choice::Switch => "a Switch hides some of its children, which are left out",
                Choice::Levels => "of levels of detail only the finest is used",
            };
            self.left_out(text, node);
            return self.open(id, shown.start, shown.end, isolates);
        }
        let keep = if isolates {
            Keep::All(Box::new(self.state.clone()))
        } else {
            Keep::Nothing
        };
        self.push(Opening {
            choice: Some((shown, choice)),
            ..Opening::new(id, 0..count, keep)
        });
    }

    /// Visits a child of the innermost group that the group does not show.
    pub(super) fn visit_other(&mut self, index: usize) {
        let graph = self.graph;
        let Some((group, others)) = self.innermost_choice() else {
            return;
        };
        let (choice, mut before) = (others.choice, others.before.clone());
        let node = graph.node(group);
        if choice == Choice::Switch {
            before.choice = i32::try_from(index).unwrap_or(i32::MAX);
        }
        let child = node.children[index];
        if choice == Choice::Switch
            && let Some(list) = variants::look_nodes(graph, child)
        {
            return self.add_fork(group, index, before, &list);
        }
        let after = std::mem::replace(&mut self.state, before);
        let shown = match choice {
            Choice::Switch => Shown::Hidden,
            Choice::Levels => Shown::Level(self.begins(node, index)),
        };
        let keep = Keep::All(Box::new(after));
        self.not_shown += 1;
        let opened = self.push(Opening {
            shown,
            ..Opening::new(group, index..index + 1, keep)
        });
        if !opened {
            self.not_shown -= 1;
        }
    }

    /// The innermost group that is open, and what it does not show.
    pub(super) fn innermost_choice(&mut self) -> Option<(NodeId, &mut Others)> {
        let open = self.stack.last_mut()?;
        Some((open.node, open.others.as_deref_mut()?))
    }

    /// The look that a hidden child gives to what follows.
    fn add_fork(&mut self, group: NodeId, index: usize, before: State, list: &[NodeId]) {
        self.steps += list.len();
        let graph = self.graph;
        let Some((_, others)) = self.innermost_choice() else {
            return;
        };
        let (looks, shown) = (others.looks, others.shown.clone());
        let looks = match looks {
            Looks::Unknown => self.variants.of_switch(graph, group, &shown),
            known => known,
        };
        let fork = match looks {
            Looks::From(first) => Some(self.fork(first + index as u32, before, list)),
            Looks::Unknown | Looks::None => None,
        };
        if looks == Looks::None {
            self.remarks.warn(
                "too-many-variants",
                "the Switches of this model give more looks than can be kept",
                "the others are left out",
                graph.node(group).pos,
            );
        }
        if let Some((_, others)) = self.innermost_choice() {
            others.looks = looks;
            others.forks.extend(fork);
        }
    }

    /// Ends the group of a child that is not shown, and says what became of it.
    pub(super) fn leave_other(&mut self, group: NodeId, shown: Shown, holds_something: bool) {
        self.not_shown -= 1;
        let node = self.graph.node(group);
        let (code, text) = match (shown, holds_something) {
            (Shown::Level(_), true) => ("kept", "coarser levels of detail are kept, as levels"),
            (Shown::Level(_), false) => ("hidden", "a coarser level of detail shows nothing"),
            (_, true) => ("kept", "children that a Switch hides are kept, hidden"),
            (_, false) => (
                "hidden",
                "a child that a Switch hides shows nothing itself, and is left out",
            ),
        };
        self.remarks.add(Severity::Note, code, text, "", node.pos);
    }

    /// Puts the looks that a Switch may leave behind into the state.
    pub(super) fn leave_choice(&mut self, others: Others) {
        variants::add(&mut self.state.forks, others.forks);
    }

    /// Whether lights and cameras are left out here: what hangs in parts that are not shown must
    /// not light those that are. Says so.
    pub(super) fn drops_views(&mut self, node: &Node) -> bool {
        if self.not_shown == 0 {
            return false;
        }
        self.left_out(
            "lights and cameras in parts that are not shown are left out",
            node,
        );
        true
    }

    /// Where a level takes the place of the finer one before it.
    fn begins(&self, node: &Node, index: usize) -> Coarser {
        let limits = |field: &str| node.numbers(field).get(index.wrapping_sub(1)).copied();
        let sound = |limit: f64| limit.is_finite() && limit >= 0.0;
        match node.class().map(Class::acts_as) {
            Some(Class::LevelOfDetail) => limits("screenArea")
                .filter(|area| sound(*area))
                .map_or(Coarser::Never, Coarser::Below),
            // VRML 2 measures in the level's own frame (ISO 14772-1, 6.26), Inventor in the world
            // (SoLOD).
            Some(Class::VRMLLOD) => limits("range")
                .map(|range| range * self.largest_scale())
                .filter(|range| sound(*range))
                .map_or(Coarser::Never, Coarser::Beyond),
            _ => limits("range")
                .filter(|range| sound(*range))
                .map_or(Coarser::Never, Coarser::Beyond),
        }
    }
}
