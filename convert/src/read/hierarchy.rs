//! The nodes of a file as groups and items of the scene, on an explicit stack.
//!
//! A node without children that holds one item and says nothing else is that item; any other is a
//! group. A node must have one parent and is visited once, so the walk ends.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DAffine3;
use gltf::json::Index;
use gltf::json::Node as JsonNode;
use iv_parser::SourcePos;
use scenegraph::scene::{
    Camera, Coarser, Environment, EnvironmentId, Instance, Light, LightSetId, MaterialId, MeshId,
    Node, NodeId, Placement, Shown, Text,
};

use super::budget::Budget;
use super::buffers::Buffers;
use super::camera::camera;
use super::document::{Document, ExactCamera, ExactNode};
use super::error::ReadError;
use super::frame::{copies, parent_from_local};
use super::iv::Iv;
use super::light::Lamp;
use super::made_by::MadeBy;
use super::material::Materials;
use super::mesh::Meshes;

/// The class of a group that does not name its own.
const GROUP_CLASS: &str = "Separator";

/// The scene being made.
pub(crate) struct Walk<'a> {
    pub(crate) document: &'a Document<'a>,
    pub(crate) buffers: &'a Buffers<'a>,
    pub(crate) made_by: MadeBy,
    pub(crate) meshes: Meshes<'a>,
    pub(crate) materials: Materials<'a>,
    pub(crate) budget: Budget,
    pub(crate) environments: Vec<Environment>,
    /// How many light sets the file has.
    pub(crate) light_sets: usize,
    pub(crate) nodes: Vec<Node>,
    pub(crate) instances: Vec<Instance>,
    pub(crate) texts: Vec<Text>,
    /// With the number of each in the file.
    pub(crate) lights: Vec<(usize, Light)>,
    /// By which number light sets call each; `None` for a light that came after them.
    pub(crate) numbers_in_sets: BTreeMap<usize, Option<usize>>,
    pub(crate) cameras: Vec<(usize, Camera)>,
    classes: Vec<Arc<str>>,
    visited: Vec<bool>,
    /// Nodes that are roots or children, or levels already.
    in_hierarchy: Vec<bool>,
    /// Whether hidden nodes and coarser levels are read too.
    pub(crate) with_alternatives: bool,
    /// How many parts were passed over, because they are hidden or coarser levels.
    pub(crate) passed_over: usize,
    /// How many lights were, because they are in such parts.
    pub(crate) hidden_lights: usize,
}

/// A node still to be visited.
struct Open {
    node: usize,
    parent: Option<NodeId>,
    world_from_parent: DAffine3,
    depth: usize,
    /// It is a coarser level than what `parent` shows.
    level: Option<Coarser>,
    /// It is hidden or a coarser level, or below such a node.
    not_shown: bool,
}

/// Something to be placed.
enum Item {
    Shape(MeshId, MaterialId),
    Light(usize, Lamp),
    Camera(usize),
}

impl<'a> Walk<'a> {
    pub(crate) fn new(
        document: &'a Document<'a>,
        buffers: &'a Buffers<'a>,
        made_by: MadeBy,
        materials: Materials<'a>,
        budget: Budget,
    ) -> Self {
        Self {
            document,
            buffers,
            made_by,
            meshes: Meshes::new(document, buffers),
            materials,
            budget,
            environments: Vec::new(),
            light_sets: 0,
            nodes: Vec::new(),
            instances: Vec::new(),
            texts: Vec::new(),
            lights: Vec::new(),
            numbers_in_sets: BTreeMap::new(),
            cameras: Vec::new(),
            classes: vec![GROUP_CLASS.into()],
            visited: vec![false; document.root.nodes.len()],
            in_hierarchy: vec![false; document.root.nodes.len()],
            with_alternatives: false,
            passed_over: 0,
            hidden_lights: 0,
        }
    }

    /// Visits all below the roots, in their order.
    pub(crate) fn run(&mut self, roots: &[Index<JsonNode>]) -> Result<(), ReadError> {
        let mut stack = Vec::new();
        let push = |stack: &mut Vec<Open>, children: &[Index<JsonNode>], open: &Open| {
            stack.extend(children.iter().rev().map(|child| Open {
                node: child.value(),
                ..*open
            }));
        };
        let children = self.document.root.nodes.iter();
        let children = children.filter_map(|node| node.children.as_ref()).flatten();
        for child in children.chain(roots) {
            if let Some(slot) = self.in_hierarchy.get_mut(child.value()) {
                *slot = true;
            }
        }
        let world = Open {
            node: 0,
            parent: None,
            world_from_parent: DAffine3::IDENTITY,
            depth: 1,
            level: None,
            not_shown: false,
        };
        push(&mut stack, roots, &world);
        while let Some(mut open) = stack.pop() {
            self.budget.check_depth(open.depth)?;
            self.open_levels(&mut open, &mut stack)?;
            if let Some(below) = self.visit(&open)? {
                let children = self.document.root.nodes[open.node].children.as_deref();
                push(&mut stack, children.unwrap_or_default(), &below);
            }
        }
        Ok(())
    }

    /// Adds a node; gives what its children hang on, if it has any.
    fn visit(&mut self, open: &Open) -> Result<Option<Open>, ReadError> {
        let number = open.node;
        let broken = |reason| ReadError::broken("node", number, reason);
        let document = self.document;
        let (Some(source), Some(visited)) = (
            document.root.nodes.get(number),
            self.visited.get_mut(number),
        ) else {
            return Err(broken("it does not exist"));
        };
        if std::mem::replace(visited, true) {
            return Err(broken("it has several parents, or is below itself"));
        }
        self.budget.take_items(1)?;
        let none = ExactNode::default();
        let exact = document.exact.nodes.get(number).unwrap_or(&none);
        let parent_from_local = parent_from_local(exact);
        let world_from_local = open.world_from_parent * parent_from_local;
        if !(parent_from_local.is_finite() && world_from_local.is_finite()) {
            return Err(broken("its transform is not finite"));
        }
        let iv = Iv::of(&source.extras).unwrap_or_default();
        let is_hidden = exact.is_hidden() && open.level.is_none();
        let not_shown = open.not_shown || is_hidden;
        if not_shown && !self.with_alternatives {
            self.passed_over += 1;
        }
        let with_shapes = !not_shown || self.with_alternatives;
        let (copies, mut items) = self.items(source, with_shapes)?;
        if not_shown {
            // Cameras are not hidden (KHR_node_visibility); of lights a scene has those that shine.
            let before = items.len();
            items.retain(|item| !matches!(item, Item::Light(..)));
            self.hidden_lights += before - items.len();
        }
        let shown = match open.level {
            _ if !self.with_alternatives => Shown::Always,
            Some(coarser) => Shown::Level(coarser),
            None if is_hidden => Shown::Hidden,
            None => Shown::Always,
        };
        let name: Option<Arc<str>> = source.name.as_deref().map(Into::into);
        let has_children = source.children.as_ref().is_some_and(|c| !c.is_empty());
        let notes: Vec<Arc<str>> = (iv.list("notes").iter())
            .filter_map(|note| Some(note.as_str()?.into()))
            .collect();
        let link = iv.link().map(Arc::new);
        let says_more = !notes.is_empty()
            || link.is_some()
            || iv.word("type").is_some()
            || shown != Shown::Always;
        // The words of a text belong to one shape; of several it is not known to which.
        if let ([Item::Shape(..)], [_]) = (&*items, &*copies) {
            self.text(&iv);
        }
        let mut placement = Placement {
            node: open.parent,
            parent_from_local,
            world_from_local,
            name,
            pos: SourcePos::default(),
        };
        if !has_children && !says_more && (items.len(), copies.len()) == (1, 1) {
            placement.parent_from_local = parent_from_local * copies[0];
            placement.world_from_local = world_from_local * copies[0];
            for item in items {
                self.place(item, placement.clone(), &iv)?;
            }
            return Ok(None);
        }
        if !has_children && !says_more && items.is_empty() && placement.name.is_none() {
            return Ok(None);
        }
        let class = self.class(iv.word("type"));
        let group = NodeId(self.nodes.len() as u32);
        self.nodes.push(Node {
            parent: open.parent,
            name: placement.name.take(),
            class,
            notes,
            link,
            parent_from_local,
            shown,
            pos: SourcePos::default(),
        });
        placement.node = Some(group);
        self.place_all(items, &copies, &placement, &iv)?;
        Ok(has_children.then_some(Open {
            node: number,
            parent: Some(group),
            world_from_parent: world_from_local,
            depth: open.depth + 1,
            level: None,
            not_shown,
        }))
    }

    /// Puts a group around a node that has coarser levels, and the levels beside it.
    fn open_levels(&mut self, open: &mut Open, stack: &mut Vec<Open>) -> Result<(), ReadError> {
        let document = self.document;
        let Some(exact) = document.exact.nodes.get(open.node) else {
            return Ok(());
        };
        // A node is the level of one part only, and has no other place.
        let mut levels = Vec::new();
        for (place, node) in exact.coarser_levels().enumerate() {
            if let Some(slot @ false) = self.in_hierarchy.get_mut(node) {
                *slot = true;
                levels.push((place, node));
            }
        }
        if levels.is_empty() {
            return Ok(());
        }
        // Of a hidden part it cannot be said where its levels would be.
        if !self.with_alternatives || exact.is_hidden() {
            self.passed_over += 1;
            return Ok(());
        }
        self.budget.take_items(levels.len() + 1)?;
        let source = document.root.nodes.get(open.node);
        let iv = source.and_then(|source| Iv::of(&source.extras));
        let iv = iv.unwrap_or_default();
        let class = self.class(Some("LOD"));
        let limit = |index: usize| {
            let number = |key: &str| iv.list(key).get(index)?.as_f64().filter(|v| *v >= 0.0);
            let distance = number("range").map(Coarser::Beyond);
            distance.or_else(|| number("screenArea").map(Coarser::Below))
        };
        let group = NodeId(self.nodes.len() as u32);
        self.nodes.push(Node {
            parent: open.parent,
            name: None,
            class,
            notes: Vec::new(),
            link: None,
            parent_from_local: DAffine3::IDENTITY,
            shown: open.level.take().map_or(Shown::Always, Shown::Level),
            pos: SourcePos::default(),
        });
        open.parent = Some(group);
        open.depth += 1;
        stack.extend(levels.into_iter().rev().map(|(place, node)| Open {
            node,
            level: Some(limit(place).unwrap_or(Coarser::Never)),
            not_shown: true,
            ..*open
        }));
        Ok(())
    }

    /// What a node holds, and the frames of the copies of its mesh.
    fn items(
        &mut self,
        source: &JsonNode,
        with_shapes: bool,
    ) -> Result<(Vec<DAffine3>, Vec<Item>), ReadError> {
        let document = self.document;
        let mut items = Vec::new();
        let mut frames = vec![DAffine3::IDENTITY];
        if let Some(index) = source.mesh.filter(|_| with_shapes) {
            let missing = ReadError::broken("mesh", index.value(), "it does not exist");
            let mesh = document.root.get(index).ok_or(missing)?;
            frames = copies(source, document, self.buffers, &mut self.budget)?;
            let shown: &[_] = if frames.is_empty() {
                &[]
            } else {
                &mesh.primitives
            };
            for primitive in shown {
                self.budget.take_items(frames.len())?;
                let wants = self.materials.wants(primitive.material)?;
                let made = self.meshes.primitive(primitive, &wants, &mut self.budget)?;
                if let Some(mesh) = made {
                    let material = self.materials.material(
                        primitive.material,
                        self.buffers,
                        &mut self.budget,
                    )?;
                    items.push(Item::Shape(mesh, material));
                }
            }
        }
        let extensions = source.extensions.as_ref();
        if let Some(light) = extensions.and_then(|e| e.khr_lights_punctual.as_ref()) {
            let index = light.light;
            let missing = ReadError::broken("light", index.value(), "it does not exist");
            let light = document.root.get(index).ok_or(missing)?;
            let lamp = Lamp::new(light, self.made_by);
            items.extend(lamp.map(|lamp| Item::Light(index.value(), lamp)));
        }
        items.extend(source.camera.map(|camera| Item::Camera(camera.value())));
        Ok((frames, items))
    }

    /// Shapes at each of the copies, all else once.
    fn place_all(
        &mut self,
        items: Vec<Item>,
        copies: &[DAffine3],
        at: &Placement,
        iv: &Iv,
    ) -> Result<(), ReadError> {
        for item in items {
            let Item::Shape(mesh, material) = item else {
                let parent_from_local = DAffine3::IDENTITY;
                let placement = Placement {
                    parent_from_local,
                    ..at.clone()
                };
                self.place(item, placement, iv)?;
                continue;
            };
            for copy in copies {
                let placement = Placement {
                    parent_from_local: *copy,
                    world_from_local: at.world_from_local * *copy,
                    ..at.clone()
                };
                self.place(Item::Shape(mesh, material), placement, iv)?;
            }
        }
        Ok(())
    }

    fn place(&mut self, item: Item, placement: Placement, iv: &Iv) -> Result<(), ReadError> {
        if !(placement.world_from_local.is_finite() && placement.parent_from_local.is_finite()) {
            let reason = "the transform of a copy is not finite";
            let number = self.instances.len();
            return Err(ReadError::broken("instance", number, reason));
        }
        match item {
            Item::Shape(mesh, material) => {
                let environment = iv.index("environment").unwrap_or(0);
                let light_set = iv.index("lightSet").unwrap_or(0);
                let within = |i: usize, count: usize| if i < count { i as u32 } else { 0 };
                self.instances.push(Instance {
                    placement,
                    mesh,
                    material,
                    light_set: LightSetId(within(light_set, self.light_sets)),
                    environment: EnvironmentId(within(environment, self.environments.len())),
                });
            }
            Item::Light(number, lamp) => {
                let in_sets = lamp.is_in_sets.map(|own| own.unwrap_or(number));
                self.numbers_in_sets.insert(number, in_sets);
                let light = lamp.placed(placement, &mut self.environments);
                self.lights.push((number, light));
            }
            Item::Camera(number) => {
                let found = self.document.root.cameras.get(number);
                let missing = ReadError::broken("camera", number, "it does not exist");
                let none = ExactCamera::default();
                let exact = self.document.exact.cameras.get(number).unwrap_or(&none);
                let made = camera(found.ok_or(missing)?, exact, self.made_by, placement);
                self.cameras.extend(made.map(|camera| (number, camera)));
            }
        }
        Ok(())
    }

    /// What the instance about to be added spells, if anything.
    fn text(&mut self, iv: &Iv) {
        let strings = iv.list("string").iter();
        let strings: Vec<Arc<str>> = strings.filter_map(|s| Some(s.as_str()?.into())).collect();
        if !strings.is_empty() {
            self.texts.push(Text {
                instance: self.instances.len() as u32,
                strings,
                faces_viewer: iv.flag("facesViewer"),
            });
        }
    }

    /// One text for each class name.
    fn class(&mut self, name: Option<&str>) -> Arc<str> {
        let name = name.unwrap_or(GROUP_CLASS);
        if let Some(known) = self.classes.iter().find(|known| &***known == name) {
            return Arc::clone(known);
        }
        let class: Arc<str> = name.into();
        // Real files name a few; any number would make the search slow.
        if self.classes.len() < 100 {
            self.classes.push(Arc::clone(&class));
        }
        class
    }
}
