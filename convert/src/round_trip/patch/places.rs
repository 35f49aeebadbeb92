//! Which nodes of the text the scene's objects come from, and where these stand.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use glam::{DAffine3, DVec3};
use iv_parser::{Dialect, LineCounter, NodeId as TreeId, SourcePos, Tree};
use scenegraph::scene::{MaterialId, NodeId, Scene};

use super::text::{transform_text, vrml_transform_text};
use super::{No, Patcher};
use crate::hierarchy::{Item, Origin};
use crate::read::Objects;

/// The tree's nodes by line and column.
pub(super) fn nodes_by_place(tree: &Tree<'_>) -> BTreeMap<(u32, u32), TreeId> {
    let mut lines = LineCounter::new(0);
    let ids = (0..tree.node_count() as u32).map(TreeId);
    let mut starts: Vec<(usize, TreeId)> = ids
        .map(|id| (tree.node(id).span.start as usize, id))
        .collect();
    starts.sort_by_key(|(start, _)| *start);
    let place = |(start, id)| {
        let pos = lines.position(tree.source, start);
        ((pos.line, pos.column), id)
    };
    starts.into_iter().map(place).collect()
}

/// The frame of each glTF node's parent in the world.
pub(super) fn world_frames(objects: &Objects) -> Vec<DAffine3> {
    let mut frames = vec![DAffine3::IDENTITY; objects.nodes.len()];
    let mut seen = BTreeSet::new();
    let mut open = objects.roots.clone();
    while let Some(at) = open.pop() {
        let Some(node) = objects.nodes.get(at).filter(|_| seen.insert(at)) else {
            continue;
        };
        let world_from_local = frames[at] * node.parent_from_local;
        for &child in &node.children {
            if let Some(frame) = frames.get_mut(child) {
                *frame = world_from_local;
            }
        }
        open.extend(&node.children);
    }
    frames
}

/// What of the scene comes from the same node of the text, or has the same material.
pub(super) struct Occurrences {
    groups: BTreeMap<SourcePos, Vec<usize>>,
    instances: BTreeMap<SourcePos, Vec<usize>>,
    by_material: BTreeMap<usize, Vec<usize>>,
}

impl Occurrences {
    pub(super) fn of(scene: &Scene) -> Self {
        let mut all = Self {
            groups: BTreeMap::new(),
            instances: BTreeMap::new(),
            by_material: BTreeMap::new(),
        };
        for (i, node) in scene.nodes.iter().enumerate() {
            all.groups.entry(node.pos).or_default().push(i);
        }
        for (i, instance) in scene.instances.iter().enumerate() {
            let pos = instance.placement.pos;
            all.instances.entry(pos).or_default().push(i);
            let material = instance.material.index();
            all.by_material.entry(material).or_default().push(i);
        }
        all
    }

    /// Shapes that have a material.
    pub(super) fn of_material(&self, id: MaterialId) -> Vec<usize> {
        let found = self.by_material.get(&id.index());
        found.cloned().unwrap_or_default()
    }
}

/// Which it is of how many; all ascend.
fn occurrence(all: Option<&Vec<usize>>, i: usize) -> (usize, usize) {
    let all = all.map_or(&[][..], Vec::as_slice);
    (all.partition_point(|&other| other < i), all.len())
}

/// What comes to stand ahead of a place of the text.
pub(super) enum Ahead {
    Nothing,
    /// A change of frame.
    Change(DAffine3),
    /// Inventor's nodes.
    Nodes(String),
}

impl Patcher<'_, '_, '_> {
    pub(super) fn is_vrml2(&self) -> bool {
        self.tree.header.dialect == Dialect::Vrml2
    }

    pub(super) fn node_at(&self, pos: SourcePos) -> Result<TreeId, No> {
        if pos.file != 0 {
            return Err("what was edited stands in an included file".to_owned());
        }
        let found = self.nodes.get(&(pos.line, pos.column));
        found
            .copied()
            .ok_or_else(|| "what was edited has no node of its own".to_owned())
    }

    pub(super) fn class(&self, node: TreeId) -> &str {
        let class = std::str::from_utf8(self.tree.node(node).class).unwrap_or_default();
        class.strip_prefix("So").unwrap_or(class)
    }

    pub(super) fn origin(&self, at: usize) -> Result<Origin, No> {
        let found = self.was.origins.nodes.get(at).copied();
        found.ok_or_else(|| "a node has no origin".to_owned())
    }

    pub(super) fn set(&mut self, node: TreeId, field: &str, value: &str) -> Result<(), No> {
        match self.edits.set_field(node, field, value) {
            true => Ok(()),
            false => Err(format!("`{field}` is connected to another field")),
        }
    }

    /// A group around a place of the text, with something ahead of what stands there; once, however
    /// often it is asked for.
    pub(super) fn wrap(
        &mut self,
        place: &Range<usize>,
        def: &str,
        ahead: &Ahead,
    ) -> Result<(), No> {
        let (before, behind) = match (self.is_vrml2(), ahead) {
            (false, Ahead::Nothing) => ("Separator { ".to_owned(), " }"),
            (false, Ahead::Change(change)) => {
                (format!("Separator {{ {} ", transform_text(change)), " }")
            }
            (false, Ahead::Nodes(nodes)) => (format!("Separator {{ {nodes} "), " }"),
            (true, Ahead::Nothing) => ("Group { children [ ".to_owned(), " ] }"),
            (true, Ahead::Change(change)) => {
                let fields = vrml_transform_text(change)?;
                (format!("Transform {{ {fields} children [ "), " ] }")
            }
            (true, Ahead::Nodes(_)) => return Err("VRML 2.0 has no such nodes".to_owned()),
        };
        if self.wrapped.insert((place.start, before.clone())) {
            let before = format!("{def}{before}");
            self.edits.wrap_reference(place, &before, behind);
        }
        Ok(())
    }

    /// Where the text has the `nth` of `count` occurrences of a node in the scene: each is written
    /// once, or all come from one place, which is then meant for all.
    pub(super) fn place(&self, node: TreeId, (nth, count): (usize, usize)) -> Range<usize> {
        let mut places = self.edits.references(node);
        let at = if places.len() == count { nth } else { 0 };
        places.swap_remove(at)
    }

    /// Where a group comes from, and which of how many of its node it is.
    pub(super) fn group_place(&self, group: NodeId) -> (SourcePos, (usize, usize)) {
        let pos = self.scene.nodes[group.index()].pos;
        let all = self.occurrences.groups.get(&pos);
        (pos, occurrence(all, group.index()))
    }

    /// As [`Self::group_place`], of a shape.
    pub(super) fn instance_place(&self, i: usize) -> (SourcePos, (usize, usize)) {
        let pos = self.scene.instances[i].placement.pos;
        (pos, occurrence(self.occurrences.instances.get(&pos), i))
    }

    pub(super) fn item_pos(&self, item: Item) -> SourcePos {
        match item {
            Item::Instance(i) => self.scene.instances[i].placement.pos,
            Item::Light(i) => self.scene.lights[i].placement.pos,
            Item::Camera(i) => self.scene.cameras[i].placement.pos,
        }
    }

    /// The groups of an origin that stand in the text, from the innermost outwards, and the frame of
    /// the one around them that the writer made, if any.
    pub(super) fn groups(&self, origin: &Origin) -> (Vec<NodeId>, DAffine3) {
        let mut groups = Vec::new();
        let mut ahead = DAffine3::IDENTITY;
        let Some((outer, inner)) = origin.groups else {
            return (groups, ahead);
        };
        let mut at = Some(inner);
        while let Some(group) = at {
            let node = &self.scene.nodes[group.index()];
            match node.pos.is_known() {
                true => groups.push(group),
                false => ahead = node.parent_from_local * ahead,
            }
            at = node.parent.filter(|_| group != outer);
        }
        (groups, ahead)
    }

    /// Three numbers of a field; `None` unless it has just them and nothing else plays a part.
    pub(super) fn triple(&self, node: TreeId, field: &str) -> Option<DVec3> {
        let field = self.edits.field(node, field)?;
        if field.ignored || field.connection.is_some() {
            return None;
        }
        match self.numbers(&field.value)?[..] {
            [x, y, z] => Some(DVec3::new(x, y, z)),
            _ => None,
        }
    }

    pub(super) fn numbers(&self, value: &iv_parser::Value) -> Option<Vec<f64>> {
        let iv_parser::Value::Numbers { numbers, .. } = value else {
            return None;
        };
        let ints = self.tree.ints(numbers);
        let floats = self.tree.floats(numbers).map(<[f64]>::to_vec);
        floats.or_else(|| Some(ints?.iter().map(|&i| f64::from(i)).collect()))
    }
}
