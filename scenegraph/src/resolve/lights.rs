//! Lights and cameras.

use glam::DVec3;

use crate::graph::{Node, NodeId};
use crate::registry::Class;
use crate::scene::{Camera, Light, LightKind, Projection, ViewportMapping};

use super::hints;
use super::transforms::{rotation, unit};
use super::walk::Walk;

impl Walk<'_> {
    /// Adds a light, which reaches all that comes after it in its scope; false if it is none.
    /// `hint` is the text of an Info right before it.
    pub(super) fn light(&mut self, class: Class, id: NodeId, hint: Option<&str>) -> bool {
        let node = self.graph.node(id);
        let direction = || unit(DVec3::from(node.triple("direction"))).unwrap_or(DVec3::NEG_Z);
        let location = || DVec3::from(node.triple("location"));
        let kind = match class {
            Class::DirectionalLight => LightKind::Directional {
                direction: direction(),
            },
            Class::PointLight => LightKind::Point {
                location: location(),
            },
            Class::SpotLight => LightKind::Spot {
                location: location(),
                direction: direction(),
                drop_off_rate: node.number("dropOffRate").clamp(0.0, 1.0),
                cut_off_angle_rad: node.number("cutOffAngle").clamp(0.0, std::f64::consts::PI),
            },
            _ => return false,
        };
        if !node.flag("on") {
            return true;
        }
        if self.drops_views(node) || !self.can_place(node) {
            return true;
        }
        let placement = self.place(id);
        let beam = match (&kind, hint) {
            (
                LightKind::Spot {
                    cut_off_angle_rad, ..
                },
                Some(text),
            ) => hints::beam(text, *cut_off_angle_rad),
            _ => None,
        };
        let light = Light {
            placement,
            kind,
            color_srgb: node.triple("color"),
            intensity: node.number("intensity"),
            beam,
            radius_in_world: None,
            environment: self.state.environment_id,
        };
        self.state.lights = self.builder.light(light, self.state.lights);
        true
    }

    /// Adds a camera; false if it is none.
    pub(super) fn camera(&mut self, class: Class, id: NodeId) -> bool {
        let node = self.graph.node(id);
        let projection = match class {
            Class::PerspectiveCamera | Class::ReversePerspectiveCamera => Projection::Perspective {
                height_angle_rad: node.number("heightAngle"),
            },
            Class::OrthographicCamera => Projection::Orthographic {
                height: node.number("height"),
            },
            Class::FrustumCamera => frustum(node),
            _ => return false,
        };
        if self.drops_views(node) || !self.can_place(node) {
            return true;
        }
        let placement = self.place(id);
        let camera = Camera {
            placement,
            position: DVec3::from(node.triple("position")),
            orientation: rotation(node, "orientation", &mut self.remarks),
            aspect_ratio: node.number("aspectRatio"),
            near_distance: node.number("nearDistance"),
            far_distance: node.number("farDistance"),
            focal_distance: node.number("focalDistance"),
            projection,
            viewport_mapping: match node.word("viewportMapping") {
                "LEAVE_ALONE" => ViewportMapping::LeaveAlone,
                "ADJUST_CAMERA" => ViewportMapping::AdjustCamera,
                _ => ViewportMapping::CropViewport,
            },
        };
        self.builder.camera(camera);
        true
    }
}

/// Coin's FrustumCamera gives the sides at the near distance; the symmetric part is kept.
fn frustum(node: &Node) -> Projection {
    let half = (node.number("top") - node.number("bottom")) / 2.0;
    let near = node.number("nearDistance");
    Projection::Perspective {
        height_angle_rad: 2.0 * half.abs().atan2(near.abs()),
    }
}
