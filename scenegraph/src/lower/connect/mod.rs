//! Connected fields without a value of their own: they get what their master has when the model is
//! opened. A field with a value keeps it, as in Coin, which takes the master's only once it
//! changes.
//!
//! Masters are fields of nodes, and outputs of engines that do not wait for time or events. Chains
//! are followed from their ends; in a circle one field keeps its default.

mod boxes;
mod calculator;
mod convert;
mod decompose;
mod engine;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use iv_parser::Severity;
use rustc_hash::FxHashMap;

use super::Builder;
use crate::graph::{FieldEntry, FieldValue, Node, NodeId};
use crate::registry::{Class, Family};

use boxes::Boxes;

/// Numbers that all connected fields of a model get: a small file can ask for any number of copies.
const MAX_NUMBERS: usize = 10_000_000;

/// Work that the Calculators of a model may make, as `calculator::work` tells it: some seconds.
const MAX_CALCULATED: usize = 20_000_000;

/// A field that is connected and has no value.
#[derive(Clone)]
pub(super) struct Link {
    pub slave: NodeId,
    /// Position in the class's list.
    pub field: u16,
    pub ignored: bool,
    pub master: NodeId,
    pub output: String,
}

/// Fields that stand in no class's list: the inputs of Gate, SelectOne and Concatenate, of the
/// type that the node names. The last one of a name counts.
pub(super) type Inputs = FxHashMap<NodeId, Vec<(Arc<str>, FieldValue)>>;

/// How far a link is.
#[derive(Clone, Copy, PartialEq)]
enum Progress {
    New,
    Open,
    Done,
}

/// Gives connected fields their values; all nodes are in the graph.
pub(super) fn settle(builder: &mut Builder<'_>, mut links: Vec<Link>, inputs: Inputs) {
    // The last one written wins, as with values.
    let mut last: FxHashMap<(NodeId, u16), usize> = FxHashMap::default();
    for (i, link) in links.iter().enumerate() {
        last.insert((link.slave, link.field), i);
    }
    let mut number = 0..;
    links.retain(|link| number.next() == last.get(&(link.slave, link.field)).copied());
    let mut masters = Masters {
        inputs,
        boxes: Boxes::default(),
        known: FxHashMap::default(),
        room: MAX_NUMBERS,
        work: MAX_CALCULATED,
    };
    let mut of_node: FxHashMap<NodeId, Vec<usize>> = FxHashMap::default();
    for (i, link) in links.iter().enumerate() {
        of_node.entry(link.slave).or_default().push(i);
    }
    let mut progress = vec![Progress::New; links.len()];
    let mut stack = Vec::new();
    for first in 0..links.len() {
        stack.push(first);
        while let Some(&at) = stack.last() {
            let link = &links[at];
            match progress[at] {
                Progress::New => {
                    progress[at] = Progress::Open;
                    let nodes = &builder.nodes;
                    let before = needed(nodes, link, &links, of_node.get(&link.master));
                    stack.extend(before.filter(|&i| progress[i] == Progress::New));
                    let boxed = masters.boxes.newly_inside(nodes, link.master);
                    let inside = boxed.iter().filter_map(|id| of_node.get(id)).flatten();
                    stack.extend(inside.copied().filter(|&i| progress[i] == Progress::New));
                }
                Progress::Open => {
                    progress[at] = Progress::Done;
                    stack.pop();
                    give(builder, link, &mut masters);
                }
                Progress::Done => {
                    stack.pop();
                }
            }
        }
    }
}

/// The links of the master that its output depends on.
fn needed<'l>(
    nodes: &'l [Node],
    link: &'l Link,
    links: &'l [Link],
    of_master: Option<&'l Vec<usize>>,
) -> impl Iterator<Item = usize> + 'l {
    let class = nodes[link.master.0 as usize].class();
    let is_engine = class.is_some_and(|c| c.spec().family == Family::Engine);
    let field = class.and_then(|c| c.spec().field(link.output.as_bytes()));
    let depends = move |&&i: &&usize| {
        is_engine || field.is_some_and(|(index, _)| usize::from(links[i].field) == index)
    };
    of_master.into_iter().flatten().filter(depends).copied()
}

/// What masters have, as far as it was asked for.
struct Masters {
    inputs: Inputs,
    boxes: Boxes,
    /// Outputs of engines.
    known: FxHashMap<(NodeId, String), Option<FieldValue>>,
    /// Numbers that may still be given.
    room: usize,
    /// Work that Calculators may still make.
    work: usize,
}

fn give(builder: &mut Builder<'_>, link: &Link, masters: &mut Masters) {
    let slave = &builder.nodes[link.slave.0 as usize];
    let Some((class, spec)) = slave
        .class()
        .and_then(|c| Some((c, c.spec().fields.get(usize::from(link.field))?)))
    else {
        return;
    };
    let found = masters.output(builder, link);
    let value = found.and_then(|value| convert::to_type(&value, spec.field_type));
    let value = value.or_else(|| link.ignored.then(|| super::read_default(spec)));
    let Some(value) = value else {
        let message = format!(
            "`{}.{}` is connected to another field",
            class.name(),
            spec.name
        );
        let hint = "that gives no value that can be known beforehand; the field keeps its default";
        builder.late_problem(Severity::Warning, "connection", message, hint, link.slave);
        return;
    };
    builder.nodes[link.slave.0 as usize]
        .fields
        .push(FieldEntry {
            index: link.field,
            ignored: link.ignored,
            value,
        });
}

impl Masters {
    fn output(&mut self, builder: &mut Builder<'_>, link: &Link) -> Option<FieldValue> {
        let master = &builder.nodes[link.master.0 as usize];
        let spec = master.class()?.spec();
        let value = if spec.class == Class::ComputeBoundingBox {
            self.boxes.output(builder, link)?
        } else if spec.family == Family::Engine {
            let inputs = &self.inputs;
            let key = (link.master, link.output.clone());
            if master.class() == Some(Class::Calculator) && !self.known.contains_key(&key) {
                self.work = self.work.checked_sub(calculator::work(master))?;
            }
            let input = |name: &str| {
                let mut all = inputs.get(&link.master)?.iter().rev();
                all.find(|(own, _)| **own == *name)
                    .map(|(_, value)| value.clone())
            };
            let made = || engine::output(master, &link.output, &input);
            self.known.entry(key).or_insert_with(made).clone()?
        } else {
            let (_, field) = spec.field(link.output.as_bytes())?;
            master.value(field.name).clone()
        };
        let size = value.numbers().len() + value.ints().len() + value.texts().len();
        self.room = self.room.checked_sub(size)?;
        Some(value)
    }
}
