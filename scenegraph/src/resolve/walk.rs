//! The traversal itself: which nodes are visited, in which order, with which state.

use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc;

use glam::{DAffine3, DVec3};
use iv_parser::{Dialect, Severity, SourcePos};
use rustc_hash::FxHashMap;

use crate::graph::{Graph, Kind, Node, NodeId};
use crate::registry::{Class, Family, Support};
use crate::remarks::Remarks;
use crate::scene::{self, Placement, Scene, Shown};
use crate::shape::{MadeFaces, Measure, ShapeMaker};

use super::alternatives::{Choice, Others};
use super::builder::Builder;
use super::profiles::Profiles;
use super::state::State;
use super::variants::Variants;
use super::{ResolveLimits, ResolveOptions, not_supported, transforms};

/// What a group restores when it ends.
pub(super) enum Keep {
    /// The whole state.
    All(Box<State>),
    /// The matrix.
    Matrix {
        base: usize,
        relative: DAffine3,
        units_m: f64,
    },
    /// Nothing: what it sets leaks to its following siblings.
    Nothing,
}

/// A group to be traversed.
pub(super) struct Opening {
    pub node: NodeId,
    pub children: Range<usize>,
    pub keep: Keep,
    pub copies: Option<Copies>,
    /// When all that is in it is shown.
    pub shown: Shown,
    /// Which children are shown, if not all are.
    pub choice: Option<(Range<usize>, Choice)>,
}

impl Opening {
    pub fn new(node: NodeId, children: Range<usize>, keep: Keep) -> Self {
        Self {
            node,
            children,
            keep,
            copies: None,
            shown: Shown::Always,
            choice: None,
        }
    }
}

/// A group being traversed.
pub(super) struct Open {
    pub node: NodeId,
    /// Children still to visit: positions in the node's list.
    next: usize,
    end: usize,
    keep: Keep,
    copies: Option<Copies>,
    /// Whether what is in it can come again.
    shared: bool,
    /// The children that are not shown, if they are visited too.
    pub others: Option<Box<Others>>,
}

/// The copies of an `Array` or `MultipleCopy` still to come.
pub(super) struct Copies {
    next: u64,
    total: u64,
}

/// `name` of a `WWWAnchor` that has none.
const UNDEFINED_URL: &str = "<Undefined URL>";

/// The frame of an open group.
pub(super) struct Frame {
    node: NodeId,
    parent_base: usize,
    parent_from_local: DAffine3,
    world_from_local: DAffine3,
    /// Made when something in it is placed.
    scene_node: Option<scene::NodeId>,
    notes: Vec<Arc<str>>,
    shown: Shown,
}

pub(super) struct Walk<'g> {
    pub graph: &'g Graph,
    pub options: &'g ResolveOptions,
    /// Those of this model.
    pub limits: ResolveLimits,
    pub state: State,
    pub builder: Builder,
    pub remarks: Remarks,
    pub shapes: ShapeMaker,
    pub profiles: Profiles,
    pub variants: Variants,
    /// What shared nodes of VRML 2 give by rule.
    pub made: FxHashMap<NodeId, Option<Rc<MadeFaces>>>,
    /// Whether groups have to look for lights of VRML 2.
    pub has_vrml_lights: bool,
    /// For each node whether it is the child of several.
    several_parents: Vec<bool>,
    pub stack: Vec<Open>,
    frames: Vec<Frame>,
    pub steps: usize,
    /// How many open groups are not shown.
    pub not_shown: usize,
    /// The text of the Info that was visited last, and how deep it stood.
    hint: Option<(usize, Arc<str>)>,
}

impl<'g> Walk<'g> {
    pub fn new(graph: &'g Graph, options: &'g ResolveOptions) -> Self {
        let dialect = graph.files.first().map(|f| f.header.dialect);
        let mut builder = Builder::default();
        let mut state = State::new(dialect == Some(Dialect::Vrml1));
        if dialect == Some(Dialect::Vrml2) {
            // Only lights bring ambient light (ISO 14772-1, 4.14).
            state.environment.ambient_intensity = 0.0;
        }
        builder.light_set(state.lights);
        builder.environment(&state.environment);
        Self {
            graph,
            options,
            limits: options.limits.of(graph),
            state,
            builder,
            remarks: Remarks::default(),
            shapes: ShapeMaker::default(),
            profiles: Profiles::default(),
            variants: Variants::default(),
            made: FxHashMap::default(),
            has_vrml_lights: graph
                .nodes()
                .iter()
                .any(|n| n.class() == Some(Class::VRMLDirectionalLight)),
            several_parents: several_parents(graph),
            stack: Vec::new(),
            frames: Vec::new(),
            steps: 0,
            not_shown: 0,
            hint: None,
        }
    }

    pub fn run(&mut self) {
        self.visit(self.graph.root);
        while let Some(open) = self.stack.last_mut() {
            if open.next < open.end {
                let index = open.next;
                open.next += 1;
                match &open.others {
                    Some(others) if !others.shown.contains(&index) => self.visit_other(index),
                    _ => {
                        let child = self.graph.node(open.node).children[index];
                        self.visit(child);
                    }
                }
            } else if open.copies.as_ref().is_some_and(|c| c.next < c.total) {
                self.next_copy();
            } else if let Some(open) = self.stack.pop() {
                self.leave(open);
            }
        }
    }

    pub fn finish(mut self) -> (Scene, Vec<Measure>, Remarks) {
        let (mut scene, measures) = self.builder.finish(&mut self.remarks);
        scene.variants = self.variants.finish(&mut self.remarks);
        (scene, measures, self.remarks)
    }

    fn visit(&mut self, id: NodeId) {
        self.steps += 1;
        if self.steps > self.limits.steps {
            let what = format!("its nodes occur more than {} times", self.limits.steps);
            return self.stop("too-many-nodes", &what, self.graph.node(id).pos);
        }
        let graph = self.graph;
        let node = graph.node(id);
        let depth = self.stack.len();
        let hint = self.hint.take().filter(|(at, _)| *at == depth);
        let hint = hint.map(|(_, text)| text);
        let class = match node.kind {
            Kind::Known(class) => class,
            Kind::Unknown(_) if self.options.like_coin => return,
            Kind::Unknown(_) => return self.open(id, 0, node.children.len(), true),
        };
        let spec = class.spec();
        if matches!(
            class,
            Class::Rotor | Class::Pendulum | Class::Shuttle | Class::Blinker
        ) {
            let text = format!("{} is shown at the start of its motion", spec.name);
            self.left_out(&text, node);
        }
        let class = class.acts_as();
        let done = match class.spec().family {
            Family::Transform => transforms::apply(class, node, &mut self.state, &mut self.remarks),
            Family::Appearance | Family::Property => {
                self.property_of_forks(class, id);
                self.property(class, id)
            }
            Family::Shape => self.shape(class, id),
            Family::Group => {
                self.group(class, id, node);
                true
            }
            Family::Light => self.light(class, id, hint.as_deref()),
            Family::Camera => self.camera(class, id),
            Family::Vrml => self.vrml(class, id, node),
            Family::Kit if class != Class::InteractionKit => {
                self.kit(class, id, node.children.len());
                true
            }
            Family::Kit | Family::Dragger => {
                let text = format!("{} is a handle of an editor, and left out", spec.name);
                self.remarks
                    .add(Severity::Note, "dragger", &text, "", node.pos);
                true
            }
            Family::Information => {
                self.note(class, node);
                true
            }
            _ => false,
        };
        if !done && spec.support != Support::Kept {
            not_supported(&mut self.remarks, spec.name, node.pos);
        }
    }

    /// Ends the walk, because the model is larger than it may be.
    pub(super) fn stop(&mut self, code: &'static str, what: &str, pos: SourcePos) {
        let message = format!("the model becomes too large: {what}");
        let hint = "what comes behind was left out; the limit grows with what is written";
        self.remarks.add(Severity::Error, code, &message, hint, pos);
        for open in &mut self.stack {
            open.next = open.end;
            open.copies = None;
        }
    }

    /// `Label` and `Info` belong to the group they stand in.
    fn note(&mut self, class: Class, node: &Node) {
        let field = match class {
            Class::Label => "label",
            Class::Info => "string",
            _ => return,
        };
        if let (Class::Info, Some(text)) = (class, node.text(field)) {
            self.hint = Some((self.stack.len(), Arc::clone(text)));
        }
        if let (Some(frame), Some(text)) = (self.frames.last_mut(), node.text(field)) {
            frame.notes.push(Arc::clone(text));
        }
    }

    fn group(&mut self, class: Class, id: NodeId, node: &Node) {
        let count = node.children.len();
        match class {
            Class::Group | Class::File | Class::WWWInline => self.open(id, 0, count, false),
            Class::Separator
            | Class::Annotation
            | Class::Selection
            | Class::ExtSelection
            | Class::LocateHighlight
            | Class::WWWAnchor => self.open(id, 0, count, true),
            Class::TransformSeparator => self.open_transform(id, count),
            Class::Switch | Class::Blinker => {
                let (first, end) = self.chosen(class, node);
                if class == Class::Blinker {
                    if end - first < count {
                        let text = "a Switch hides some of its children, which are left out";
                        self.left_out(text, node);
                    }
                    return self.open(id, first, end, false);
                }
                self.open_choice(id, first..end, Choice::Switch, false);
            }
            // Children of a level-of-detail group go from fine to coarse.
            Class::LOD | Class::LevelOfDetail => {
                self.open_choice(id, 0..count.min(1), Choice::Levels, false);
            }
            Class::Array | Class::MultipleCopy => {
                let total = if count == 0 { 0 } else { copies(class, node) };
                let keep = Keep::All(Box::new(self.state.clone()));
                self.push(Opening {
                    copies: Some(Copies { next: 0, total }),
                    ..Opening::new(id, count..count, keep)
                });
            }
            Class::PathSwitch => not_supported(&mut self.remarks, class.name(), node.pos),
            _ => self.open(id, 0, count, false),
        }
    }

    /// A node kit, whose parts are its children. A kit that holds a Separator keeps its state to
    /// itself; of a camera or a light the transform ends with the kit.
    fn kit(&mut self, class: Class, id: NodeId, count: usize) {
        match class {
            Class::BaseKit | Class::AppearanceKit | Class::NodeKitListPart => {
                self.open(id, 0, count, false);
            }
            Class::CameraKit | Class::LightKit => self.open_transform(id, count),
            _ => self.open(id, 0, count, true),
        }
    }

    /// A group that restores the matrix only.
    fn open_transform(&mut self, id: NodeId, count: usize) {
        let State {
            base,
            relative,
            units_m,
            ..
        } = self.state;
        let keep = Keep::Matrix {
            base,
            relative,
            units_m,
        };
        self.push(Opening::new(id, 0..count, keep));
    }

    /// Says that something the source hides, or changes over time, is not in the scene.
    pub(super) fn left_out(&mut self, text: &str, node: &Node) {
        self.remarks
            .add(Severity::Note, "hidden", text, "", node.pos);
    }

    /// The range of children that a `Switch` shows.
    fn chosen(&mut self, class: Class, node: &Node) -> (usize, usize) {
        let count = node.children.len();
        let which = if node.is_ignored("whichChild") {
            -1
        } else {
            node.int("whichChild")
        };
        let which = match which {
            -2 if self.state.choice >= 0 && count > 0 => {
                (self.state.choice as usize % count) as i32
            }
            -2 => self.state.choice,
            -1 if class == Class::Blinker => 0,
            other => other,
        };
        if node.is_ignored("whichChild") || node.int("whichChild") != -2 {
            self.state.choice = which;
        }
        match usize::try_from(which) {
            Ok(i) if i < count => (i, i + 1),
            Err(_) if which == -3 => (0, count),
            _ => (0, 0),
        }
    }

    /// Opens all of a group's children; behind them the state is `before`, which may be another
    /// one than the current.
    pub(super) fn open_before(&mut self, id: NodeId, count: usize, before: State) {
        if count == 0 {
            self.state = before;
        } else {
            self.push(Opening::new(id, 0..count, Keep::All(Box::new(before))));
        }
    }

    pub(super) fn open(&mut self, id: NodeId, first: usize, end: usize, isolates: bool) {
        if first == end {
            return;
        }
        let keep = if isolates {
            Keep::All(Box::new(self.state.clone()))
        } else {
            Keep::Nothing
        };
        self.push(Opening::new(id, first..end, keep));
    }

    /// Opens a group; false if it is nested too deeply, and then nothing of it is left.
    pub(super) fn push(&mut self, opening: Opening) -> bool {
        let Opening {
            node,
            children,
            keep,
            copies,
            shown,
            choice,
        } = opening;
        if self.stack.len() >= self.limits.depth {
            let pos = self.graph.node(node).pos;
            self.remarks.add(
                Severity::Error,
                "too-deep",
                &format!("groups are nested more than {} deep", self.limits.depth),
                "the contents of the innermost were left out",
                pos,
            );
            if let Keep::All(state) = keep {
                self.state = *state;
            }
            return false;
        }
        self.frames.push(Frame {
            node,
            parent_base: self.state.base,
            parent_from_local: self.state.relative,
            world_from_local: self.world(),
            scene_node: None,
            notes: Vec::new(),
            shown,
        });
        self.state.base = self.frames.len();
        self.state.relative = DAffine3::IDENTITY;
        let shared = copies.is_some() || self.is_shared(node);
        let lit = choice
            .as_ref()
            .map_or(&children, |(shown, _)| shown)
            .clone();
        let others =
            choice.map(|(shown, choice)| Box::new(Others::new(shown, choice, self.state.clone())));
        self.stack.push(Open {
            node,
            next: children.start,
            end: children.end,
            keep,
            copies,
            shared,
            others,
        });
        self.lights_of_group(node, lit);
        true
    }

    /// The innermost group.
    pub(super) fn group_around(&self) -> Option<NodeId> {
        self.stack.last().map(|open| open.node)
    }

    /// Adds notes to the innermost group.
    pub(super) fn add_notes(&mut self, notes: impl Iterator<Item = Arc<str>>) {
        if let Some(frame) = self.frames.last_mut() {
            frame.notes.extend(notes);
        }
    }

    /// How long the current frame makes a unit at the most.
    pub(super) fn largest_scale(&self) -> f64 {
        let world = self.world();
        let axes = [world.x_axis, world.y_axis, world.z_axis];
        axes.map(DVec3::length).into_iter().fold(0.0, f64::max)
    }

    /// Whether a node can be visited again: it has several parents, or something around it has.
    pub(super) fn is_shared(&self, id: NodeId) -> bool {
        self.several_parents[id.0 as usize] || self.stack.last().is_some_and(|open| open.shared)
    }

    fn leave(&mut self, open: Open) {
        let depth = self.frames.len();
        self.keep_empty_level();
        let Some(frame) = self.frames.pop() else {
            return;
        };
        if frame.shown != Shown::Always {
            self.leave_other(open.node, frame.shown, frame.scene_node.is_some());
        }
        if let Some(node) = frame.scene_node {
            self.builder.set_notes(node, frame.notes);
        }
        let leaks = matches!(open.keep, Keep::Nothing);
        match open.keep {
            Keep::All(state) => self.state = *state,
            Keep::Matrix {
                base,
                relative,
                units_m,
            } => {
                self.state.base = base;
                self.state.relative = relative;
                self.state.units_m = units_m;
            }
            // A ResetTransform inside has left the frame already.
            Keep::Nothing if self.state.base == depth => {
                self.state.base = frame.parent_base;
                self.state.relative = frame.parent_from_local * self.state.relative;
            }
            Keep::Nothing => {}
        }
        if let Some(others) = open.others.filter(|_| leaks) {
            self.leave_choice(*others);
        }
    }

    /// Begins the next copy of the innermost `Array` or `MultipleCopy`.
    fn next_copy(&mut self) {
        self.steps += 1;
        let depth = self.frames.len();
        let Some(Open {
            node,
            next,
            keep: Keep::All(saved),
            copies: Some(copies),
            ..
        }) = self.stack.last_mut()
        else {
            return;
        };
        let index = copies.next;
        copies.next += 1;
        *next = 0;
        self.state = (**saved).clone();
        self.state.base = depth;
        self.state.relative = DAffine3::IDENTITY;
        self.state.choice = index.min(i32::MAX as u64) as i32;
        let graph = self.graph;
        let node = graph.node(*node);
        let local = if node.class() == Some(Class::Array) {
            DAffine3::from_translation(array_offset(node, index))
        } else {
            let at = index as usize * 16;
            let numbers = node.numbers("matrix").get(at..at + 16);
            let matrix = numbers.and_then(|m| <&[f64; 16]>::try_from(m).ok());
            matrix.map_or(DAffine3::IDENTITY, |m| {
                transforms::affine(m, node, &mut self.remarks)
            })
        };
        self.state.transform(&local);
    }

    /// The current transform in the world.
    pub(super) fn world(&self) -> DAffine3 {
        let frame = self.state.base.checked_sub(1).map(|i| &self.frames[i]);
        frame.map_or(self.state.relative, |f| {
            f.world_from_local * self.state.relative
        })
    }

    /// Whether something of the current state can be placed; says so if not.
    pub(super) fn can_place(&mut self, node: &Node) -> bool {
        if !self.world().is_finite() {
            self.remarks.add(
                Severity::Error,
                "transform-overflow",
                "transforms multiply to something without a finite value",
                "what they place was left out",
                node.pos,
            );
            return false;
        }
        if self.builder.items() >= self.limits.items {
            let limit = self.limits.items;
            let what = format!("more than {limit} shapes, groups, lights and cameras");
            self.stop("too-many-items", &what, node.pos);
            return false;
        }
        true
    }

    /// Where something of the current state hangs; to be asked for after [`Self::can_place`].
    pub(super) fn place(&mut self, id: NodeId) -> Placement {
        let node = self.graph.node(id);
        Placement {
            node: self.scene_node(self.state.base),
            parent_from_local: self.state.relative,
            world_from_local: self.world(),
            name: node.name.clone(),
            pos: node.pos,
        }
    }

    /// A level that shows nothing says that nothing is shown from there on, so it has a node too.
    fn keep_empty_level(&mut self) {
        let Some(frame) = self.frames.last() else {
            return;
        };
        let around = frame.parent_base.checked_sub(1).map(|i| &self.frames[i]);
        if matches!(frame.shown, Shown::Level(_))
            && around.is_some_and(|around| around.scene_node.is_some())
            && self.builder.items() < self.limits.items
        {
            self.scene_node(self.frames.len());
        }
    }

    /// The scene's node for the frame number `base`, made with all those around it if need be.
    fn scene_node(&mut self, base: usize) -> Option<scene::NodeId> {
        let mut missing = Vec::new();
        let mut at = base;
        while at > 0 && self.frames[at - 1].scene_node.is_none() {
            missing.push(at - 1);
            at = self.frames[at - 1].parent_base;
        }
        let mut parent = at.checked_sub(1).and_then(|i| self.frames[i].scene_node);
        for i in missing.into_iter().rev() {
            let frame = &mut self.frames[i];
            let node = self.graph.node(frame.node);
            // The group of a child that is not shown has no node of its own in the source.
            let is_own = frame.shown == Shown::Always;
            let class = if is_own { node.class_name() } else { "Group" };
            let class = self.builder.class_name(class);
            let made = self.builder.node(scene::Node {
                parent,
                name: node.name.clone().filter(|_| is_own),
                class,
                notes: Vec::new(),
                link: link_of(node).map(Arc::new),
                parent_from_local: frame.parent_from_local,
                shown: frame.shown,
                pos: node.pos,
            });
            frame.scene_node = Some(made);
            parent = Some(made);
        }
        parent
    }
}

fn several_parents(graph: &Graph) -> Vec<bool> {
    let mut has_one = vec![false; graph.nodes().len()];
    let mut has_more = has_one.clone();
    let handles = graph.nodes().iter().flat_map(Node::handles);
    for child in handles {
        let index = child.0 as usize;
        has_more[index] |= std::mem::replace(&mut has_one[index], true);
    }
    has_more
}

fn copies(class: Class, node: &Node) -> u64 {
    if class == Class::MultipleCopy {
        return (node.numbers("matrix").len() / 16) as u64;
    }
    let count = |field: &str| node.int(field).max(0) as u64;
    count("numElements1")
        .saturating_mul(count("numElements2"))
        .saturating_mul(count("numElements3"))
}

/// Direction 1 varies fastest; `origin` says whether the first, the middle or the last copy stays
/// in place.
fn array_offset(node: &Node, index: u64) -> DVec3 {
    let mut offset = DVec3::ZERO;
    let mut rest = index;
    for (elements, separation) in [
        ("numElements1", "separation1"),
        ("numElements2", "separation2"),
        ("numElements3", "separation3"),
    ] {
        let count = node.int(elements).max(1) as u64;
        let shift = match node.word("origin") {
            "CENTER" => (count - 1) as f64 / 2.0,
            "LAST" => (count - 1) as f64,
            _ => 0.0,
        };
        offset += DVec3::from(node.triple(separation)) * ((rest % count) as f64 - shift);
        rest /= count;
    }
    offset
}

/// Where a group leads. An address that nobody gave is none.
fn link_of(node: &Node) -> Option<scene::Link> {
    let (urls, parameters): (_, &[Arc<str>]) = match node.class()? {
        Class::WWWAnchor => (node.value("name").texts(), &[]),
        Class::VRMLAnchor => (node.value("url").texts(), node.value("parameter").texts()),
        _ => return None,
    };
    let is_given = |url: &&Arc<str>| !url.is_empty() && &***url != UNDEFINED_URL;
    let urls: Vec<Arc<str>> = urls.iter().filter(is_given).cloned().collect();
    (!urls.is_empty()).then(|| scene::Link {
        urls,
        description: node.text("description").cloned().unwrap_or_default(),
        parameters: parameters.to_vec(),
        tells_point: node.class() == Some(Class::WWWAnchor) && node.word("map") == "POINT",
    })
}
