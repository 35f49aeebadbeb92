//! Switches that set the look of what follows them: each state is a variant.
//!
//! A hidden child that holds nothing but materials, colours, textures and light models is applied to
//! a copy of the look that the Switch began with, a [`Fork`]. Forks travel in the state beside its
//! own look; nodes that set the look set that of the forks too. A shape whose mesh is the same in a
//! fork gets the fork's material as that of the variant.
//!
//! Each variant changes the state of one Switch, all others stand as in the file.

use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc;

use iv_parser::{Severity, SourcePos};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::graph::{Graph, Kind, NodeId};
use crate::registry::Class;
use crate::remarks::Remarks;
use crate::scene::{LightModel, MaterialId, Variant};
use crate::shape::{Attributes, Job, Made, ShapeMaker};

use super::state::{MaterialState, State};
use super::walk::Walk;

/// Most variants of a scene, the states that Switches are in among them.
pub const MAX_VARIANTS: usize = 32;

/// Most nodes of a child of a Switch that is taken for a look.
const MAX_LOOK_NODES: usize = 256;

/// What a variant changes.
#[derive(Clone, Copy, Debug)]
struct Look {
    material: MaterialState,
    light_model: LightModel,
    texture: Option<NodeId>,
}

impl Look {
    fn of(state: &State) -> Self {
        Self {
            material: state.material,
            light_model: state.light_model,
            texture: state.texture,
        }
    }

    fn put(self, state: &mut State) {
        state.material = self.material;
        state.light_model = self.light_model;
        state.texture = self.texture;
    }
}

/// The look in another variant.
#[derive(Clone, Copy, Debug)]
pub struct Fork {
    variant: u32,
    look: Look,
}

/// The looks in other variants; none as a rule.
pub type Forks = Option<Rc<Vec<Fork>>>;

/// Adds forks; those of the same variant take the place of older ones.
pub fn add(forks: &mut Forks, new: Vec<Fork>) {
    if new.is_empty() {
        return;
    }
    let mut all = forks.as_deref().cloned().unwrap_or_default();
    all.retain(|old| !new.iter().any(|fork| fork.variant == old.variant));
    all.extend(new);
    *forks = Some(Rc::new(all));
}

/// The variants of a Switch: one for each child, by its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Looks {
    /// Not asked for yet.
    Unknown,
    /// There are too many.
    None,
    /// The number of the first.
    From(u32),
}

/// Classes that set the look and nothing else.
fn sets_look(class: Class) -> bool {
    matches!(
        class,
        Class::Material
            | Class::BaseColor
            | Class::PackedColor
            | Class::Texture2
            | Class::LightModel
    )
}

/// The nodes of a child that does nothing but set the look; `None` if it does more, or nothing.
pub fn look_nodes(graph: &Graph, child: NodeId) -> Option<Vec<NodeId>> {
    let mut found = Vec::new();
    let mut open = vec![child];
    let mut visited = 0;
    while let Some(id) = open.pop() {
        visited += 1;
        let node = graph.node(id);
        let Kind::Known(class) = node.kind else {
            return None;
        };
        match class.acts_as() {
            Class::Group => open.extend(node.children.iter().rev()),
            Class::Label | Class::Info => {}
            class if sets_look(class) => found.push(id),
            _ => return None,
        }
        if visited + open.len() > MAX_LOOK_NODES {
            return None;
        }
    }
    (!found.is_empty()).then_some(found)
}

/// All variants, as they are found.
#[derive(Default)]
pub struct Variants {
    list: Vec<Variant>,
    switches: FxHashMap<NodeId, Looks>,
    /// The variants of each Switch.
    ranges: Vec<Range<usize>>,
    names: FxHashSet<Arc<str>>,
    /// Materials of instances, all together.
    pub entries: usize,
    /// The first Switch that gives some.
    first: SourcePos,
}

impl Variants {
    /// The variants of a Switch that shows the children `shown`.
    pub fn of_switch(&mut self, graph: &Graph, id: NodeId, shown: &Range<usize>) -> Looks {
        if let Some(&known) = self.switches.get(&id) {
            return known;
        }
        let node = graph.node(id);
        // Without a shown child the state of the file is one more.
        let states = node.children.len() + usize::from(shown.is_empty());
        let first = self.list.len();
        let looks = if first + states > MAX_VARIANTS {
            Looks::None
        } else {
            for (index, child) in node.children.iter().enumerate() {
                let own = graph.node(*child).name.clone();
                self.add(own.unwrap_or_else(|| numbered(node.name.as_deref(), index)));
            }
            if shown.is_empty() {
                let group = node.name.as_deref().unwrap_or("Switch");
                self.add(format!("{group} none").into());
            }
            if self.ranges.is_empty() {
                self.first = node.pos;
            }
            self.ranges.push(first..self.list.len());
            Looks::From(first as u32)
        };
        self.switches.insert(id, looks);
        looks
    }

    fn add(&mut self, wanted: Arc<str>) {
        let mut name = Arc::clone(&wanted);
        let mut number = 2;
        while !self.names.insert(Arc::clone(&name)) {
            name = format!("{wanted} {number}").into();
            number += 1;
        }
        self.list.push(Variant {
            name,
            materials: Vec::new(),
        });
    }

    fn set(&mut self, variant: u32, instance: u32, material: MaterialId) {
        if let Some(variant) = self.list.get_mut(variant as usize) {
            variant.materials.push((instance, material));
            self.entries += 1;
        }
    }

    /// Those of Switches that change something.
    pub fn finish(self, remarks: &mut Remarks) -> Vec<Variant> {
        if self.entries > 0 {
            let text = "looks that Switches choose are kept, as variants of materials";
            remarks.add(Severity::Note, "kept", text, "", self.first);
        }
        let mut list: Vec<Option<Variant>> = self.list.into_iter().map(Some).collect();
        let changes =
            |variant: &Option<Variant>| variant.as_ref().is_some_and(|v| !v.materials.is_empty());
        for range in self.ranges {
            if !list[range.clone()].iter().any(changes) {
                list[range].fill(None);
            }
        }
        list.into_iter().flatten().collect()
    }
}

fn numbered(group: Option<&str>, index: usize) -> Arc<str> {
    format!("{} {index}", group.unwrap_or("Switch")).into()
}

impl Walk<'_> {
    /// The look that `list` makes of that of `before`.
    pub(super) fn fork(&mut self, variant: u32, before: State, list: &[NodeId]) -> Fork {
        let after = std::mem::replace(&mut self.state, before);
        for &id in list {
            if let Kind::Known(class) = self.graph.node(id).kind {
                self.property(class.acts_as(), id);
            }
        }
        let look = Look::of(&self.state);
        self.state = after;
        Fork { variant, look }
    }

    /// Applies a node to the looks of other variants, as far as it sets looks.
    pub(super) fn property_of_forks(&mut self, class: Class, id: NodeId) {
        if !sets_look(class) && class != Class::VertexProperty {
            return;
        }
        let Some(mut forks) = self.state.forks.take() else {
            return;
        };
        let before = self.state.clone();
        for fork in Rc::make_mut(&mut forks) {
            fork.look.put(&mut self.state);
            self.property(class, id);
            fork.look = Look::of(&self.state);
            self.state.clone_from(&before);
        }
        self.state.forks = Some(forks);
    }

    /// Gives the shape that was added last its materials in other variants.
    pub(super) fn shape_in_variants(&mut self, job: &Job<'_>, made: &Made) {
        let Some(forks) = self.state.forks.clone() else {
            return;
        };
        let attributes = Attributes::of(job);
        let Some((instance, own)) = self.builder.last_instance() else {
            return;
        };
        for fork in forks.iter() {
            let mut state = job.state.clone();
            fork.look.put(&mut state);
            let forked = Job {
                state: &state,
                lit: state.light_model == LightModel::Phong,
                profiles: job.profiles.clone(),
                ..*job
            };
            let forked_attributes = Attributes::of(&forked);
            if !ShapeMaker::same_mesh(job, &attributes, &forked, &forked_attributes) {
                self.remarks.add(
                    Severity::Note,
                    "hidden",
                    "a Switch changes more of a shape than its material: its other looks are \
                     left out there",
                    "colours of vertices and texture coordinates are the mesh's",
                    self.graph.node(job.node).pos,
                );
                continue;
            }
            // A material that nothing has must not be made.
            if self.builder.items() + self.variants.entries >= self.limits.items {
                break;
            }
            let material = self.material(&forked, &forked_attributes, made);
            if material != own {
                self.variants.set(fork.variant, instance, material);
            }
        }
    }
}
