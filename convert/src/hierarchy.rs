//! The scene's groups and items as glTF nodes, as few as will do.
//!
//! A group whose only content is one node becomes one with it, unless both have a name or both
//! say something in their extras, or unless the product of their transforms shears while neither
//! does. glTF's transforms cannot shear; one that does becomes two nodes, the inner one a rotation.
//!
//! A light keeps its place in the hierarchy if its group's frame is a rotation with uniform
//! scale, a camera if it is a rotation. Otherwise it stands at the root in world coordinates:
//! viewers that take a node's frame for a rotation then still get the right direction.

use std::sync::Arc;

use geometry::transform::{Decomposition, Trs, decompose};
use glam::{DAffine3, DMat3, DQuat, DVec3};
use scenegraph::scene::{Link, NodeId, Placement, Scene, Shown, Text};

use crate::alternatives::{self, Limits, View};
use crate::bounds::Bounds;
use crate::extras::{Said, Scope};
use crate::formats::Formats;
use crate::frame::{is_rotation, stretch, uniform_scale};
use crate::instancing::{self, Copies, Frames, alike};
use crate::json::Json;
use crate::layout::Needs;
use crate::{camera, extras, light};

/// What a node shows, by glTF index.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Content {
    #[default]
    Nothing,
    Mesh(u32),
    /// Copies of a mesh, and the number of their batch.
    Copies(u32, usize),
    Light(u32),
    Camera(u32),
}

/// What of the scene a glTF node shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Item {
    Instance(usize),
    Light(usize),
    Camera(usize),
}

/// What of the scene a glTF node was made of: groups that became one, and what they hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Origin {
    /// The outermost and the innermost group.
    pub(crate) groups: Option<(NodeId, NodeId)>,
    pub(crate) item: Option<Item>,
    /// A node whose transform glTF needs two nodes for.
    pub(crate) is_split: bool,
}

/// A node being put together.
#[derive(Default)]
struct Draft<'s> {
    origin: Origin,
    name: Option<&'s str>,
    class: Option<&'s str>,
    notes: Vec<&'s str>,
    link: Option<&'s Link>,
    scope: Scope,
    text: Option<&'s Text>,
    parent_from_local: DAffine3,
    content: Content,
    children: Vec<usize>,
    is_hidden: bool,
    /// Coarser levels, which are no children, and their limits.
    levels: Vec<usize>,
    limits: Limits,
}

/// The nodes to be written.
pub(crate) struct Hierarchy<'s> {
    drafts: Vec<Draft<'s>>,
    roots: Vec<usize>,
    pub(crate) copies: Copies,
}

/// A member of a group while the groups are not put together yet.
#[derive(Clone, Copy)]
enum Member {
    Group(usize),
    Item(usize),
}

impl<'s> Hierarchy<'s> {
    /// `meshes` are the glTF meshes of the instances, `formats` and `needs` those of the scene's
    /// meshes.
    pub(crate) fn new(
        scene: &'s Scene,
        formats: &[Formats],
        needs: &[Option<Needs>],
        meshes: &[u32],
    ) -> Self {
        let mut builder = Builder::new(scene, needs);
        let mut texts = scene.texts.iter().peekable();
        for (i, (instance, &mesh)) in scene.instances.iter().zip(meshes).enumerate() {
            let origin = scene.meshes[instance.mesh.index()].origin;
            let placement = &instance.placement;
            let mut local = placement.parent_from_local * DAffine3::from_translation(origin);
            if let Some(step) = formats[instance.mesh.index()].positions.step() {
                local.matrix3 *= f64::from(step);
            }
            let item = (Item::Instance(i), Content::Mesh(mesh));
            builder.add_item(placement.node, &placement.name, local, item);
            builder.set_scope(Scope {
                light_set: instance.light_set.0,
                environment: instance.environment.0,
            });
            let text = texts.next_if(|text| text.instance as usize == i);
            builder.set_text(text);
        }
        let frames = builder.group_frames();
        for (i, light) in scene.lights.iter().enumerate() {
            let keeps = |linear: &DMat3| uniform_scale(linear).is_some();
            builder.add_view(
                &light.placement,
                (Item::Light(i), Content::Light(i as u32)),
                |frame| light::frame(&light.kind, frame),
                |node| keeps(&frames[node.index()].matrix3),
            );
        }
        for (i, camera) in scene.cameras.iter().enumerate() {
            builder.add_view(
                &camera.placement,
                (Item::Camera(i), Content::Camera(i as u32)),
                |frame| camera::frame(camera, frame),
                |node| is_rotation(&frames[node.index()].matrix3),
            );
        }
        builder.finish()
    }

    /// Whether some node is hidden, and whether some has levels.
    pub(crate) fn alternatives(&self) -> [bool; 2] {
        let any = |has: fn(&Draft<'_>) -> bool| self.drafts.iter().any(has);
        [
            any(|draft| draft.is_hidden),
            any(|draft| !draft.levels.is_empty()),
        ]
    }

    /// Whether there is nothing to write.
    pub(crate) fn is_empty(&self) -> bool {
        self.roots.is_empty()
    }

    /// Makes one node of copies of a mesh. `corners` are those of each glTF mesh's box, `tolerance`
    /// how far a point may move in the world.
    pub(crate) fn gather_copies(&mut self, corners: &[[DVec3; 8]], tolerance: Option<f64>) {
        let mut open = vec![(None, DAffine3::IDENTITY)];
        while let Some((parent, world_from_parent)) = open.pop() {
            let children = match parent {
                None => std::mem::take(&mut self.roots),
                Some(parent) => {
                    let parent: &mut Draft = &mut self.drafts[parent];
                    std::mem::take(&mut parent.children)
                }
            };
            let tolerance = tolerance.map(|t| t / stretch(&world_from_parent.matrix3));
            let mut kept = Vec::with_capacity(children.len());
            for group in alike(&children, |child| self.drafts[child].key_of_copy()) {
                match self.as_copies(&group, corners, tolerance) {
                    Some(draft) => {
                        self.drafts.push(draft);
                        kept.push(self.drafts.len() - 1);
                    }
                    None => kept.extend(group),
                }
            }
            for &child in &kept {
                let draft = &self.drafts[child];
                for &node in std::iter::once(&child).chain(&draft.levels) {
                    let node = (node, &self.drafts[node]);
                    if !node.1.children.is_empty() {
                        open.push((Some(node.0), world_from_parent * node.1.parent_from_local));
                    }
                }
            }
            match parent {
                None => self.roots = kept,
                Some(parent) => self.drafts[parent].children = kept,
            }
        }
    }

    /// One node for some that are alike; `None` if they stay as they are.
    fn as_copies(
        &mut self,
        group: &[usize],
        corners: &[[DVec3; 8]],
        tolerance: Option<f64>,
    ) -> Option<Draft<'s>> {
        if group.len() < instancing::MIN_COPIES {
            return None;
        }
        let first = &self.drafts[group[0]];
        let Content::Mesh(mesh) = first.content else {
            return None;
        };
        let frames: Vec<DAffine3> = group
            .iter()
            .map(|&i| self.drafts[i].parent_from_local)
            .collect();
        let frames = Frames::new(&frames, &corners[mesh as usize], tolerance)?;
        let batch = self.copies.add(&frames);
        Some(Draft {
            name: first.name,
            class: first.class,
            scope: first.scope,
            // It has no origin: it stands for no single place of the source.
            parent_from_local: DAffine3::from_translation(frames.middle),
            content: Content::Copies(mesh, batch),
            ..Draft::default()
        })
    }

    /// `scenes` and `nodes`; gives the number of nodes. Children follow their parents, and those
    /// of one parent stand together.
    /// The copies' accessors begin at `first_copy`.
    pub(crate) fn write(
        &self,
        json: &mut Json,
        scene: &Scene,
        first_copy: usize,
        with_extras: bool,
        source: Option<&str>,
    ) -> usize {
        // A scene without nodes is legal, but readers refuse it.
        if self.is_empty() {
            return 0;
        }
        json.key("scene").u64(0);
        json.key("scenes").array(|json| {
            json.object(|json| {
                json.array_unless_empty("nodes", 0..self.roots.len(), Json::usize);
                if with_extras {
                    extras::scene(json, scene, source);
                }
            });
        });
        let mut queue: Vec<Part> = self.roots.iter().copied().map(Part::Whole).collect();
        json.key("nodes").array(|json| {
            let mut next = 0;
            while next < queue.len() {
                let first_child = queue.len();
                let part = queue[next];
                self.write_node(json, part, &mut queue, first_child, first_copy, with_extras);
                next += 1;
            }
        });
        queue.len()
    }

    /// What the nodes that [`Self::write`] writes were made of, in the same order.
    pub(crate) fn origins(&self) -> Vec<Origin> {
        let mut queue: Vec<Part> = self.roots.iter().copied().map(Part::Whole).collect();
        let mut origins = Vec::new();
        while let Some(&part) = queue.get(origins.len()) {
            let (draft, is_inner) = match part {
                Part::Whole(draft) => (draft, false),
                Part::Inner(draft, _) => (draft, true),
            };
            let node = &self.drafts[draft];
            let splits_to = match decompose(&node.parent_from_local) {
                Decomposition::Sheared { inner, .. } if !is_inner => Some(inner),
                _ => None,
            };
            match splits_to {
                Some(inner) => queue.push(Part::Inner(draft, inner)),
                None => queue.extend(node.children.iter().copied().map(Part::Whole)),
            }
            queue.extend(node.levels_of(!is_inner).map(Part::Whole));
            origins.push(Origin {
                is_split: is_inner || splits_to.is_some(),
                ..node.origin
            });
        }
        origins
    }

    fn write_node(
        &self,
        json: &mut Json,
        part: Part,
        queue: &mut Vec<Part>,
        first_child: usize,
        first_copy: usize,
        with_extras: bool,
    ) {
        let (draft, inner_rotation) = match part {
            Part::Whole(index) => (index, None),
            Part::Inner(index, rotation) => (index, Some(rotation)),
        };
        let node = &self.drafts[draft];
        let (trs, splits_to) = match inner_rotation {
            Some(rotation) => (rotation_only(rotation), None),
            None => match decompose(&node.parent_from_local) {
                Decomposition::Trs(trs) => (trs, None),
                Decomposition::Sheared { outer, inner } => (outer, Some(inner)),
            },
        };
        json.object(|json| {
            if let (Some(name), None) = (node.name, inner_rotation) {
                json.key("name").str(name);
            }
            write_transform(json, &trs);
            let whole = inner_rotation.is_none();
            match splits_to {
                Some(inner) => queue.push(Part::Inner(draft, inner)),
                None => {
                    node.content.write(json);
                    queue.extend(node.children.iter().copied().map(Part::Whole));
                }
            }
            let children = first_child..queue.len();
            queue.extend(node.levels_of(whole).map(Part::Whole));
            let levels = children.end..queue.len();
            json.object_unless_empty("extensions", |json| {
                if splits_to.is_none() {
                    node.content.write_extension(json, &self.copies, first_copy);
                }
                if node.is_hidden && whole {
                    alternatives::write_hidden(json);
                }
                if !levels.is_empty() {
                    alternatives::write_levels(json, levels);
                }
            });
            json.array_unless_empty("children", children, Json::usize);
            if whole {
                node.write_extras(json, with_extras);
            }
        });
    }
}

/// A glTF node: a draft, or the inside of one that shears.
#[derive(Clone, Copy)]
enum Part {
    Whole(usize),
    Inner(usize, DQuat),
}

struct Builder<'s, 'n> {
    scene: &'s Scene,
    drafts: Vec<Draft<'s>>,
    /// By group; the last entry is the world.
    members: Vec<Vec<Member>>,
    needs: &'n [Option<Needs>],
    view: View,
    /// The boxes in the world of what groups show, made when they are asked for.
    bounds: Option<Vec<Option<Bounds>>>,
}

impl<'s, 'n> Builder<'s, 'n> {
    fn new(scene: &'s Scene, needs: &'n [Option<Needs>]) -> Self {
        let mut builder = Self {
            scene,
            drafts: Vec::with_capacity(scene.instances.len()),
            members: vec![Vec::new(); scene.nodes.len() + 1],
            needs,
            view: View::of(scene),
            bounds: None,
        };
        for (i, node) in scene.nodes.iter().enumerate() {
            builder.members_of(node.parent).push(Member::Group(i));
        }
        builder
    }

    fn members_of(&mut self, node: Option<NodeId>) -> &mut Vec<Member> {
        let world = self.scene.nodes.len();
        &mut self.members[node.map_or(world, NodeId::index)]
    }

    fn add_item(
        &mut self,
        group: Option<NodeId>,
        name: &'s Option<Arc<str>>,
        parent_from_local: DAffine3,
        (shown, content): (Item, Content),
    ) {
        let item = Member::Item(self.drafts.len());
        self.members_of(group).push(item);
        self.drafts.push(Draft {
            origin: Origin {
                item: Some(shown),
                ..Origin::default()
            },
            name: name.as_deref(),
            parent_from_local,
            content,
            ..Draft::default()
        });
    }

    /// The scope of the item added last.
    fn set_scope(&mut self, scope: Scope) {
        if let Some(draft) = self.drafts.last_mut() {
            draft.scope = scope;
        }
    }

    /// What the item added last spells.
    fn set_text(&mut self, text: Option<&'s Text>) {
        if let Some(draft) = self.drafts.last_mut() {
            draft.text = text;
        }
    }

    /// A light or camera: under its group if `keeps` says so, else at the root.
    fn add_view(
        &mut self,
        placement: &'s Placement,
        content: (Item, Content),
        frame_in: impl Fn(&DAffine3) -> DAffine3,
        keeps: impl Fn(NodeId) -> bool,
    ) {
        let group = placement.node.filter(|&node| keeps(node));
        let frame = match group {
            Some(_) => frame_in(&placement.parent_from_local),
            None => frame_in(&placement.world_from_local),
        };
        self.add_item(group, &placement.name, frame, content);
    }

    /// The groups' frames in the world, needed for lights and cameras only.
    fn group_frames(&self) -> Vec<DAffine3> {
        let mut frames: Vec<DAffine3> = Vec::new();
        if self.scene.lights.is_empty() && self.scene.cameras.is_empty() {
            return frames;
        }
        frames.reserve(self.scene.nodes.len());
        for node in &self.scene.nodes {
            let world_from_parent = node
                .parent
                .map_or(DAffine3::IDENTITY, |p| frames[p.index()]);
            frames.push(world_from_parent * node.parent_from_local);
        }
        frames
    }

    /// Groups from the last to the first, so that children are done before their parents.
    fn finish(mut self) -> Hierarchy<'s> {
        let mut done: Vec<Option<usize>> = vec![None; self.scene.nodes.len()];
        let world = self.members.pop().unwrap_or_default();
        for i in (0..self.scene.nodes.len()).rev() {
            let children = self.children_of(i, &done);
            done[i] = self.put_together(i, children);
        }
        let roots = resolved(&world, &done);
        Hierarchy {
            drafts: self.drafts,
            roots,
            copies: Copies::default(),
        }
    }

    /// The children of a group; where some of its members are coarser levels, the finest alone, with
    /// which they go.
    fn children_of(&mut self, group: usize, done: &[Option<usize>]) -> Vec<usize> {
        let mut members = std::mem::take(&mut self.members[group]);
        let nodes = &self.scene.nodes;
        let level = |member: &Member| match *member {
            Member::Group(group) => Some((done[group]?, nodes[group].level()?)),
            Member::Item(_) => None,
        };
        let (levels, coarser): (Vec<_>, Vec<_>) = members.iter().filter_map(level).unzip();
        if levels.is_empty() {
            return resolved(&members, done);
        }
        members.retain(|member| level(member).is_none());
        let finest = resolved(&members, done);
        let own = match *finest {
            [only] if !self.drafts[only].is_hidden && self.drafts[only].levels.is_empty() => only,
            _ => {
                self.drafts.push(Draft {
                    children: finest,
                    ..Draft::default()
                });
                self.drafts.len() - 1
            }
        };
        let limits = Limits::new(coarser, self.radius_of(group), &self.view);
        self.drafts[own].levels = levels;
        self.drafts[own].limits = limits;
        vec![own]
    }

    /// Half the diagonal of the box in the world of what a group shows; 0 for nothing.
    fn radius_of(&mut self, group: usize) -> f64 {
        let (scene, needs) = (self.scene, self.needs);
        let bounds = self
            .bounds
            .get_or_insert_with(|| Bounds::by_node(scene, needs));
        bounds[group].map_or(0.0, |bounds| bounds.radius())
    }

    /// The draft of a group: its only child, its own, or none when it says and holds nothing.
    fn put_together(&mut self, group: usize, children: Vec<usize>) -> Option<usize> {
        let node = &self.scene.nodes[group];
        let id = NodeId(group as u32);
        let draft = Draft {
            origin: Origin {
                groups: Some((id, id)),
                ..Origin::default()
            },
            name: node.name.as_deref(),
            class: extras::notable_class(&node.class),
            notes: node.notes.iter().map(|note| &**note).collect(),
            link: node.link.as_deref(),
            parent_from_local: node.parent_from_local,
            is_hidden: node.shown == Shown::Hidden,
            children,
            ..Draft::default()
        };
        match *draft.children {
            // An empty level says that nothing is shown from there on.
            [] if draft.name.is_none() && draft.notes.is_empty() && node.level().is_none() => {
                return None;
            }
            [only] if draft.can_merge_with(&self.drafts[only]) => {
                self.drafts[only].take_in(draft);
                return Some(only);
            }
            _ => {}
        }
        self.drafts.push(draft);
        Some(self.drafts.len() - 1)
    }
}

fn resolved(members: &[Member], done: &[Option<usize>]) -> Vec<usize> {
    let draft_of = |&member: &Member| match member {
        Member::Group(group) => done[group],
        Member::Item(item) => Some(item),
    };
    members.iter().filter_map(draft_of).collect()
}

impl<'s> Draft<'s> {
    /// What nodes must have in common to be copies; `None` if this one is more than a mesh.
    fn key_of_copy(&self) -> Option<(u32, Option<&'s str>, Option<&'s str>, Scope)> {
        match self.content {
            Content::Mesh(mesh)
                // Viewers turn the faces of a whole batch by its node alone.
                if self.children.is_empty()
                    && self.notes.is_empty()
                    && self.link.is_none()
                    && !self.is_hidden
                    && self.levels.is_empty()
                    && self.text.is_none()
                    && self.parent_from_local.matrix3.determinant() > 0.0 =>
            {
                Some((mesh, self.name, self.class, self.scope))
            }
            _ => None,
        }
    }
}

impl Draft<'_> {
    /// The coarser levels of a node; of one that becomes two, the outer one has them.
    fn levels_of(&self, is_outer: bool) -> impl Iterator<Item = usize> {
        self.levels.iter().copied().filter(move |_| is_outer)
    }

    fn write_extras(&self, json: &mut Json, with_extras: bool) {
        if with_extras {
            let notes = self.notes.iter().copied();
            let (link, text) = (self.link, self.text);
            let node = Said {
                class: self.class,
                link,
                text,
                scope: self.scope,
            };
            extras::node(json, notes, &node, &self.limits);
        } else {
            json.object_unless_empty("extras", |json| self.limits.write_coverage(json));
        }
    }

    fn can_merge_with(&self, child: &Self) -> bool {
        // A part that is switched keeps a node of its own, and so does what chooses.
        if child.is_hidden || !child.levels.is_empty() {
            return false;
        }
        let both = |mine: bool, childs: bool| mine && childs;
        if both(self.name.is_some(), child.name.is_some())
            || both(self.class.is_some(), child.class.is_some())
            || both(!self.notes.is_empty(), !child.notes.is_empty())
            || both(self.link.is_some(), child.link.is_some())
        {
            return false;
        }
        // Then the product shears only if one of the two does, and splits as that one would.
        let (outer, inner) = (&self.parent_from_local, &child.parent_from_local);
        if outer.matrix3 == DMat3::IDENTITY || inner.matrix3 == DMat3::IDENTITY {
            return (*outer * *inner).is_finite();
        }
        let product = *outer * *inner;
        product.is_finite() && matches!(decompose(&product), Decomposition::Trs(_))
    }
}

impl<'s> Draft<'s> {
    /// Becomes one with the group around it.
    fn take_in(&mut self, group: Draft<'s>) {
        let inside = self.origin.groups.or(group.origin.groups);
        let outside = group.origin.groups.or(self.origin.groups);
        self.origin.groups = outside.zip(inside).map(|((o, _), (_, i))| (o, i));
        self.parent_from_local = group.parent_from_local * self.parent_from_local;
        self.name = group.name.or(self.name);
        self.class = group.class.or(self.class);
        self.link = group.link.or(self.link);
        self.is_hidden |= group.is_hidden;
        if self.notes.is_empty() {
            self.notes = group.notes;
        }
    }
}

impl Content {
    fn write(self, json: &mut Json) {
        match self {
            Self::Mesh(index) | Self::Copies(index, _) => json.key("mesh").u64(index.into()),
            Self::Camera(index) => json.key("camera").u64(index.into()),
            Self::Nothing | Self::Light(_) => {}
        }
    }

    /// What of it is an extension of the node.
    fn write_extension(self, json: &mut Json, copies: &Copies, first_copy: usize) {
        match self {
            Self::Copies(_, batch) => copies.write_batch(json, batch, first_copy),
            Self::Light(index) => json
                .key("KHR_lights_punctual")
                .object(|json| json.key("light").u64(index.into())),
            Self::Nothing | Self::Mesh(_) | Self::Camera(_) => {}
        }
    }
}

fn rotation_only(rotation: DQuat) -> Trs {
    Trs {
        translation: DVec3::ZERO,
        rotation,
        scale: DVec3::ONE,
    }
}

/// Left out are the parts that change nothing.
fn write_transform(json: &mut Json, trs: &Trs) {
    if trs.translation != DVec3::ZERO {
        json.key("translation").f64s(&trs.translation.to_array());
    }
    if trs.rotation != DQuat::IDENTITY {
        json.key("rotation").f64s(&trs.rotation.to_array());
    }
    if trs.scale != DVec3::ONE {
        json.key("scale").f64s(&trs.scale.to_array());
    }
}
