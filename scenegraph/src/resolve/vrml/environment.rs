//! `Viewpoint`, `Fog` and `WorldInfo`: what is said about the whole scene.

use std::sync::Arc;

use glam::DVec3;
use iv_parser::Severity;

use crate::graph::{Node, NodeId};
use crate::resolve::transforms::rotation;
use crate::resolve::walk::Walk;
use crate::scene::{Camera, Fog, FogType, Projection, ViewportMapping};

impl Walk<'_> {
    /// A camera. `fieldOfView` is that of the smaller side of the window, which is what
    /// `ADJUST_CAMERA` makes of a height angle at an aspect ratio of 1.
    pub(super) fn viewpoint(&mut self, id: NodeId) {
        let node = self.graph.node(id);
        if self.drops_views(node) || !self.can_place(node) {
            return;
        }
        let mut placement = self.place(id);
        let description = node.text("description").filter(|text| !text.is_empty());
        placement.name = placement.name.or_else(|| description.map(Arc::clone));
        let angle = node.number("fieldOfView");
        self.builder.camera(Camera {
            placement,
            position: DVec3::from(node.triple("position")),
            orientation: rotation(node, "orientation", &mut self.remarks),
            aspect_ratio: 1.0,
            // Inventor's defaults, which say nothing.
            near_distance: 1.0,
            far_distance: 10.0,
            focal_distance: 5.0,
            projection: Projection::Perspective {
                height_angle_rad: angle.clamp(0.0, std::f64::consts::PI),
            },
            viewport_mapping: ViewportMapping::AdjustCamera,
        });
    }

    /// The first fog that hides anything is that of the whole scene.
    pub(super) fn vrml_fog(&mut self, node: &Node) {
        if self.drops_views(node) {
            return;
        }
        let scale = self.largest_scale();
        let visibility = node.number("visibilityRange") * scale;
        if visibility <= 0.0 || !visibility.is_finite() {
            return;
        }
        let fog_type = match node.text("fogType").map(|text| &**text) {
            Some("EXPONENTIAL") => FogType::Fog,
            _ => FogType::Haze,
        };
        self.builder.fog_for_all(Fog {
            fog_type,
            color_srgb: node.triple("color").map(|v| v.clamp(0.0, 1.0)),
            visibility,
        });
    }

    /// The scene has no place for a background, as Inventor has none: it is the viewer's.
    pub(super) fn background(&mut self, node: &Node) {
        let [r, g, b] = node.triple("skyColor");
        let message =
            format!("the Background is left to the viewer; its sky begins as {r} {g} {b}");
        let hint = "neither Inventor nor glTF has backgrounds";
        self.remarks.warn("background", &message, hint, node.pos);
    }

    /// How a viewer moves says nothing about a picture, and the headlight is the viewer's.
    pub(super) fn navigation_info(&mut self, node: &Node) {
        let message = match node.flag("headlight") {
            true => "NavigationInfo has no effect on a static picture",
            false => "NavigationInfo turns the headlight off, which is left to the viewer",
        };
        self.remarks
            .add(Severity::Note, "no-effect", message, "", node.pos);
    }

    /// Title and remarks become notes of the group.
    pub(super) fn world_info(&mut self, node: &Node) {
        let title = node.value("title").texts();
        let info = node.value("info").texts();
        let texts = title.iter().chain(info).filter(|text| !text.is_empty());
        self.add_notes(texts.cloned());
    }
}
