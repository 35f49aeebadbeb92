//! `ComputeBoundingBox`: the box around what a node draws when it is traversed by itself, as
//! SoGetBoundingBoxAction finds it. The extents of text in pixels need a window, and do not count.
//!
//! `boxCenter` is the middle of the box, `objectCenter` the mean of the centres of what the node
//! holds, group by group; the centre of a shape is here the middle of its own box.

use geometry::bounds::Aabb;
use glam::DVec3;
use iv_parser::Severity;
use rustc_hash::{FxHashMap, FxHashSet};

use super::Link;
use crate::graph::{FieldValue, Graph, Node, NodeId};
use crate::lower::Builder;
use crate::registry::Class;
use crate::resolve::{Geometry, ResolveLimits, ResolveOptions, Resolved, resolve};

/// Most nodes of a model that boxes are made of: each takes a look at all nodes.
const MAX_BOXES: usize = 20;

/// Most nodes visited for one box.
const MAX_STEPS: usize = 200_000;

/// Most parts that one box is made of.
const MAX_ITEMS: usize = 100_000;

/// A box that was made.
#[derive(Clone, Copy, Default)]
struct Extent {
    min: DVec3,
    max: DVec3,
    object_center: DVec3,
}

/// The boxes made so far.
#[derive(Default)]
pub(super) struct Boxes {
    /// By node.
    known: FxHashMap<NodeId, Option<Extent>>,
    /// Nodes whose inside has been listed.
    listed: FxHashSet<NodeId>,
}

impl Boxes {
    /// All nodes below the one that the engine is given, if it was not asked for before: their
    /// fields must have their values first.
    pub fn newly_inside(&mut self, nodes: &[Node], engine: NodeId) -> Vec<NodeId> {
        let Some(root) = root_of(&nodes[engine.0 as usize]) else {
            return Vec::new();
        };
        if self.listed.len() >= MAX_BOXES || !self.listed.insert(root) {
            return Vec::new();
        }
        let mut seen = FxHashSet::default();
        let mut open = vec![root];
        let mut inside = Vec::new();
        while let Some(id) = open.pop() {
            if seen.insert(id) {
                inside.push(id);
                open.extend(nodes[id.0 as usize].handles());
            }
        }
        inside
    }

    /// An output of the engine that a link leads to.
    pub fn output(&mut self, builder: &mut Builder<'_>, link: &Link) -> Option<FieldValue> {
        let engine = &builder.nodes[link.master.0 as usize];
        // A path says more than a node, and its nodes are not kept.
        if engine.entry("path").is_some() {
            return None;
        }
        let extent = match root_of(engine) {
            None => Extent::default(),
            Some(root) => self.extent(builder, root)?,
        };
        let numbers = match &*link.output {
            "min" => extent.min,
            "max" => extent.max,
            "boxCenter" => 0.5 * extent.min + 0.5 * extent.max,
            "objectCenter" => extent.object_center,
            _ => return None,
        };
        Some(FieldValue::from_numbers(&numbers.to_array()))
    }

    fn extent(&mut self, builder: &mut Builder<'_>, root: NodeId) -> Option<Extent> {
        if let Some(known) = self.known.get(&root) {
            return *known;
        }
        if self.known.len() >= MAX_BOXES {
            return None;
        }
        let graph = Graph {
            nodes: std::mem::take(&mut builder.nodes),
            root,
            files: std::mem::take(&mut builder.files),
            fonts: Vec::new(),
            pictures: FxHashMap::default(),
            diagnostics: Vec::new(),
        };
        let options = ResolveOptions {
            geometry: Geometry::Measure,
            // SoGetBoundingBoxAction, like SoCallbackAction, minds no DrawStyle.
            like_coin: true,
            limits: ResolveLimits {
                steps: MAX_STEPS,
                items: MAX_ITEMS,
                ..ResolveLimits::default()
            },
            ..ResolveOptions::default()
        };
        let resolved = resolve(&graph, &options);
        builder.nodes = graph.nodes;
        builder.files = graph.files;
        let cut_short = |d: &iv_parser::Diagnostic| d.severity == Severity::Error;
        let is_whole = !resolved.diagnostics.iter().any(cut_short);
        let found = is_whole.then(|| extent_of(&resolved));
        self.known.insert(root, found);
        found
    }
}

/// The node that an engine is given, if it makes boxes.
fn root_of(engine: &Node) -> Option<NodeId> {
    let is_one = engine.class() == Some(Class::ComputeBoundingBox);
    is_one.then(|| engine.node_field("node")).flatten()
}

/// A sum of centres.
#[derive(Clone, Copy, Default)]
struct Centers {
    sum: DVec3,
    count: u32,
}

impl Centers {
    fn add(&mut self, center: DVec3) {
        self.sum += center;
        self.count += 1;
    }

    fn mean(&self) -> DVec3 {
        self.sum / f64::from(self.count.max(1))
    }
}

/// The box around what was resolved; zeros if there is nothing.
fn extent_of(resolved: &Resolved) -> Extent {
    let scene = &resolved.scene;
    let mut whole = Aabb::EMPTY;
    // One for each node, and one for the scene.
    let mut centers = vec![Centers::default(); scene.nodes.len() + 1];
    let top = scene.nodes.len();
    for instance in &scene.instances {
        let measure = &resolved.measures[instance.mesh.index()];
        let placement = &instance.placement;
        let own = measure.bounds.transformed(&placement.world_from_local);
        if own.is_empty() {
            continue;
        }
        whole.include(own.min);
        whole.include(own.max);
        let at = placement.node.map_or(top, |node| node.index());
        centers[at].add(own.center());
    }
    // Parents stand before their children.
    for i in (0..top).rev() {
        if centers[i].count > 0 {
            let parent = scene.nodes[i].parent.map_or(top, |node| node.index());
            let mean = centers[i].mean();
            centers[parent].add(mean);
        }
    }
    if whole.is_empty() {
        return Extent::default();
    }
    Extent {
        min: whole.min,
        max: whole.max,
        object_center: centers[top].mean(),
    }
}
