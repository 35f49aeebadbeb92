//! VRML 2 nodes: groups here, the rest in files of its own.
//!
//! No state leaks from a VRML node. A `Shape` sets the whole state from its fields and hands its
//! geometry to the code that draws Inventor's shapes; a group restores everything behind it.

mod appearance;
mod environment;
mod geometry;
mod lights;
#[cfg(test)]
mod tests;

use glam::{DAffine3, DMat3, DVec3};
use iv_parser::{Dialect, Severity};

use crate::graph::{Node, NodeId};
use crate::registry::{Class, Support};

use super::alternatives::Choice;
use super::transforms::rotation;
use super::walk::Walk;

impl Walk<'_> {
    /// Visits a node of VRML 2; false if its effect is not carried over.
    pub(super) fn vrml(&mut self, class: Class, id: NodeId, node: &Node) -> bool {
        let count = node.children.len();
        match class {
            Class::VRMLGroup | Class::VRMLAnchor | Class::VRMLCollision | Class::VRMLInline => {
                self.open(id, 0, count, true);
            }
            Class::VRMLBillboard => {
                self.left_out("a Billboard is shown as it stands in the file", node);
                self.open(id, 0, count, true);
            }
            Class::VRMLTransform => {
                let local = self.vrml_transform(node);
                self.open_moved(id, &local);
            }
            Class::VRMLSwitch => {
                let chosen = usize::try_from(node.int("whichChoice"));
                let chosen = chosen.ok().filter(|&i| i < count);
                let shown = chosen.map_or(0..0, |i| i..i + 1);
                self.open_choice(id, shown, Choice::Switch, true);
            }
            Class::VRMLLOD => self.open_choice(id, 0..count.min(1), Choice::Levels, true),
            Class::VRMLShape => self.vrml_shape(id, node),
            Class::VRMLDirectionalLight if self.stands_in_vrml() => {}
            Class::VRMLDirectionalLight => self.vrml_directional_light(id),
            Class::VRMLPointLight | Class::VRMLSpotLight => self.vrml_point_light(class, id),
            Class::VRMLViewpoint => self.viewpoint(id),
            Class::VRMLFog => self.vrml_fog(node),
            Class::VRMLWorldInfo => self.world_info(node),
            Class::VRMLBackground => self.background(node),
            Class::VRMLNavigationInfo => self.navigation_info(node),
            // A geometry without a Shape takes the state around it, as in Coin.
            _ if geometry::is_geometry(class) => self.vrml_geometry(id, id),
            _ if class.spec().support == Support::Kept => self.remarks.add(
                Severity::Note,
                "no-effect",
                &format!("{} has no effect on a static picture", class.vrml_name()),
                "",
                node.pos,
            ),
            _ if class.spec().support == Support::Planned => return false,
            _ => self.remarks.warn(
                "no-place",
                &format!("{} stands where it has no effect", class.vrml_name()),
                "it belongs into a field of another node",
                node.pos,
            ),
        }
        true
    }

    /// Opens all children of a node in a frame of their own.
    fn open_moved(&mut self, id: NodeId, local: &DAffine3) {
        let count = self.graph.node(id).children.len();
        let before = self.state.clone();
        self.state.transform(local);
        self.open_before(id, count, before);
    }

    /// Scale about `center` along `scaleOrientation`, rotate about `center`, translate (ISO
    /// 14772-1, 6.52).
    fn vrml_transform(&mut self, node: &Node) -> DAffine3 {
        let center = DVec3::from(node.triple("center"));
        let turn = DMat3::from_quat(rotation(node, "scaleOrientation", &mut self.remarks));
        let scale = DMat3::from_diagonal(DVec3::from(node.triple("scale")));
        let scale = match turn == DMat3::IDENTITY {
            true => scale,
            false => turn * scale * turn.transpose(),
        };
        let rotation = rotation(node, "rotation", &mut self.remarks);
        DAffine3::from_translation(DVec3::from(node.triple("translation")) + center)
            * DAffine3::from_quat(rotation)
            * DAffine3::from_mat3(scale)
            * DAffine3::from_translation(-center)
    }

    /// Whether the group being visited belongs to VRML 2, by its class or its file.
    fn stands_in_vrml(&self) -> bool {
        let Some(group) = self.group_around() else {
            return false;
        };
        self.is_vrml_group(group)
    }

    /// Whether a group's lights reach all that is in it.
    fn is_vrml_group(&self, group: NodeId) -> bool {
        let node = self.graph.node(group);
        let file = &self.graph.files[node.pos.file as usize];
        file.header.dialect == Dialect::Vrml2
            || node
                .class()
                .is_some_and(|c| c.spec().child_list().is_some())
    }
}
