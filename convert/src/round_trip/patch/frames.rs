//! Names and transforms of parts.

use geometry::transform::{Decomposition, decompose};
use glam::{DAffine3, DMat3, DVec3};
use iv_parser::NodeId as TreeId;
use scenegraph::legal_name;
use scenegraph::scene::NodeId;

use super::places::Ahead;
use super::text::{tidy, tidy_triple, transform_text, triple_text};
use super::{No, Patcher};
use crate::hierarchy::{Item, Origin};

impl Patcher<'_, '_, '_> {
    pub(super) fn name(&mut self, at: usize, to: usize) -> Result<(), No> {
        let origin = self.origin(at)?;
        let new = self.is.nodes[to].name.as_deref().and_then(legal_name);
        let new = new.ok_or("a name was removed")?.into_owned();
        let old = self.was.objects.nodes[at].name.as_deref();
        let named = |group: &&NodeId| self.scene.nodes[group.index()].name.as_deref() == old;
        let (groups, _) = self.groups(&origin);
        let group = match old {
            Some(_) => groups.iter().find(named),
            None => groups.last(),
        };
        let (pos, occurrence) = match (group, origin.item) {
            (Some(&group), _) => self.group_place(group),
            (None, Some(Item::Instance(i))) => self.instance_place(i),
            (None, Some(item)) => (self.item_pos(item), (0, 1)),
            (None, None) => return Err("a name stands nowhere in the source".to_owned()),
        };
        let node = self.node_at(pos)?;
        match occurrence {
            (_, 1) => self.edits.rename(node, &new),
            _ => {
                let place = self.place(node, occurrence);
                self.wrap(&place, &format!("DEF {new} "), &Ahead::Nothing)?;
            }
        }
        Ok(())
    }

    pub(super) fn frame(&mut self, at: usize, to: usize) -> Result<(), No> {
        let origin = self.origin(at)?;
        if origin.is_split {
            return Err("a sheared transform was edited".to_owned());
        }
        let old = self.was.objects.nodes[at].parent_from_local;
        let new = self.is.nodes[to].parent_from_local;
        match origin.item {
            Some(Item::Light(i)) => return self.move_light(i, self.frames_of[at] * new),
            Some(Item::Camera(i)) => return self.move_camera(i, self.frames_of[at] * new),
            _ => {}
        }
        if origin.groups.is_some() {
            return self.move_group(&origin, old, new);
        }
        let Some(Item::Instance(i)) = origin.item else {
            return Err("a transform stands nowhere in the source".to_owned());
        };
        // local * change * rest = new, where local * rest = old.
        let local = self.scene.instances[i].placement.parent_from_local;
        let change = tidy(local.inverse() * new * old.inverse() * local)?;
        let (pos, occurrence) = self.instance_place(i);
        let node = self.node_at(pos)?;
        let place = self.place(node, occurrence);
        self.wrap(&place, "", &Ahead::Change(change))
    }

    fn move_group(&mut self, origin: &Origin, old: DAffine3, new: DAffine3) -> Result<(), No> {
        let (groups, ahead) = self.groups(origin);
        let (Some(&outer), Some(&inner)) = (groups.last(), groups.first()) else {
            return Err("a transform stands nowhere in the source".to_owned());
        };
        let frame_of = |group: NodeId| self.scene.nodes[group.index()].parent_from_local;
        let (pos, occurrence) = self.group_place(outer);
        // A change inside would be one of the members' frames, not of the group's.
        if self.is_vrml2() || occurrence.1 > 1 || origin.item.is_none() {
            // outside * change * rest = new, where outside * rest = old. VRML 2.0 has its
            // transforms in the group itself, Inventor ahead of it.
            let outside = match self.is_vrml2() {
                true => ahead,
                false => ahead * frame_of(outer),
            };
            let change = tidy(outside.inverse() * new * old.inverse() * outside)?;
            let node = self.node_at(pos)?;
            let own = frame_of(outer);
            let is_only = self.is_vrml2() && occurrence.1 == 1;
            if is_only && self.moves_by_itself(node, own, &change)? {
                return Ok(());
            }
            let place = self.place(node, occurrence);
            return self.wrap(&place, "", &Ahead::Change(change));
        }
        // outside * change * rest = new, where outside * rest = old.
        let product = |frame, group: &NodeId| frame_of(*group) * frame;
        let outside = ahead * groups.iter().fold(DAffine3::IDENTITY, product);
        let change = tidy(outside.inverse() * new * old.inverse() * outside)?;
        let node = self.node_at(self.scene.nodes[inner.index()].pos)?;
        self.move_contents(node, &change)
    }

    /// Moves a `Transform` of VRML 2.0 by its own fields, if they will do. `own` is its frame.
    fn moves_by_itself(
        &mut self,
        node: TreeId,
        own: DAffine3,
        change: &DAffine3,
    ) -> Result<bool, No> {
        if self.class(node) != "Transform" {
            return Ok(false);
        }
        let center = self.triple_or(node, "center", DVec3::ZERO);
        let old = self.triple_or(node, "translation", DVec3::ZERO);
        let (Some(center), Some(old)) = (center, old) else {
            return Ok(false);
        };
        if change.matrix3 == DMat3::IDENTITY {
            let moved = tidy_triple(old + change.translation);
            self.set(node, "translation", &triple_text(moved))?;
            return Ok(true);
        }
        let frame = *change * own;
        let is_turned = self.edits.field(node, "scaleOrientation").is_some();
        let Decomposition::Trs(trs) = decompose(&frame) else {
            return Ok(false);
        };
        if is_turned || trs.scale.min_element() <= 0.0 {
            return Ok(false);
        }
        let (axis, angle_rad) = trs.rotation.to_axis_angle();
        let moved = frame.translation + frame.matrix3 * center - center;
        self.set(node, "translation", &triple_text(tidy_triple(moved)))?;
        let rotation = format!("{} {angle_rad}", triple_text(axis));
        self.set(node, "rotation", &rotation)?;
        if trs.scale != DVec3::ONE || self.edits.field(node, "scale").is_some() {
            self.set(node, "scale", &triple_text(trs.scale))?;
        }
        Ok(true)
    }

    /// As [`Self::triple`], or the default of a field that is not there.
    fn triple_or(&self, node: TreeId, field: &str, default: DVec3) -> Option<DVec3> {
        match self.edits.field(node, field) {
            None => Some(default),
            Some(_) => self.triple(node, field),
        }
    }

    /// Moves all in a group: by its first transform where that can take the change in, else by one
    /// more ahead of it.
    fn move_contents(&mut self, group: TreeId, change: &DAffine3) -> Result<(), No> {
        let first = self.tree.items(group).iter().find_map(|item| match item {
            iv_parser::Item::Child(iv_parser::Child::Node(id)) => {
                let says_nothing = matches!(self.class(*id), "Label" | "Info");
                (!says_nothing).then_some(*id)
            }
            _ => None,
        });
        let is_translation = change.matrix3 == DMat3::IDENTITY;
        if let Some(first) = first
            && self.tree.node(first).def.is_none()
            && is_translation
            && matches!(self.class(first), "Translation" | "Transform")
            && let Some(old) = self.triple(first, "translation")
        {
            let moved = tidy_triple(old + change.translation);
            return self.set(first, "translation", &triple_text(moved));
        }
        match self.edits.insert_first(group, &transform_text(change)) {
            true => Ok(()),
            false => Err("a group has no body".to_owned()),
        }
    }
}
