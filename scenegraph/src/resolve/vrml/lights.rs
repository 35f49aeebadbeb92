//! Lights. A `DirectionalLight` lights its group, what stands before it too; the others light
//! everything within their radius, wherever they stand.

use std::ops::Range;

use glam::DVec3;

use crate::graph::{Node, NodeId};
use crate::registry::Class;
use crate::resolve::transforms::unit;
use crate::resolve::walk::Walk;
use crate::scene::{Environment, Light, LightKind};

impl Walk<'_> {
    /// Adds the directional lights of a VRML group that is being opened.
    pub(in crate::resolve) fn lights_of_group(&mut self, group: NodeId, shown: Range<usize>) {
        if !self.has_vrml_lights || !self.is_vrml_group(group) {
            return;
        }
        let graph = self.graph;
        for &child in &graph.node(group).children[shown] {
            if graph.node(child).class() == Some(Class::VRMLDirectionalLight) {
                self.vrml_directional_light(child);
            }
        }
    }

    pub(super) fn vrml_directional_light(&mut self, id: NodeId) {
        let node = self.graph.node(id);
        if !node.flag("on") || self.drops_views(node) || !self.can_place(node) {
            return;
        }
        let direction = unit(DVec3::from(node.triple("direction"))).unwrap_or(DVec3::NEG_Z);
        let light = self.vrml_light(id, LightKind::Directional { direction });
        self.state.lights = self.builder.light(light, self.state.lights);
        let ambient = node.number("ambientIntensity").clamp(0.0, 1.0);
        if ambient > 0.0 {
            self.add_ambient(node.triple("color").map(|v| v * ambient));
        }
    }

    pub(super) fn vrml_point_light(&mut self, class: Class, id: NodeId) {
        let node = self.graph.node(id);
        if !node.flag("on") || self.drops_views(node) || !self.can_place(node) {
            return;
        }
        let location = DVec3::from(node.triple("location"));
        let kind = match class {
            Class::VRMLPointLight => LightKind::Point { location },
            _ => LightKind::Spot {
                location,
                direction: unit(DVec3::from(node.triple("direction"))).unwrap_or(DVec3::NEG_Z),
                drop_off_rate: drop_off_rate(node),
                cut_off_angle_rad: node
                    .number("cutOffAngle")
                    .clamp(0.0, std::f64::consts::FRAC_PI_2),
            },
        };
        let mut light = self.vrml_light(id, kind);
        let world = light.placement.world_from_local;
        let center = world.transform_point3(location);
        let radius = node.number("radius").max(0.0) * self.largest_scale();
        light.radius_in_world = Some(radius).filter(|r| r.is_finite());
        let ambient = self.ambient_of(node, class == Class::VRMLPointLight);
        self.builder.light_for_all(light, center, radius, ambient);
    }

    /// The ambient light that a light brings to what is in its radius. The scene's ambient light is
    /// the same all over a shape, so that of a light which fades is left out.
    fn ambient_of(&mut self, node: &Node, is_point: bool) -> [f64; 3] {
        let ambient = node.number("ambientIntensity").clamp(0.0, 1.0);
        if ambient == 0.0 {
            return [0.0; 3];
        }
        let [constant, linear, quadratic] = node.triple("attenuation").map(|v| v.max(0.0));
        if !is_point || linear > 0.0 || quadratic > 0.0 {
            self.remarks.warn(
                "light-ambient",
                "the ambient light of a light that fades with distance or angle is left out",
                "set ambientIntensity of a light with attenuation 1 0 0, or of a DirectionalLight",
                node.pos,
            );
            return [0.0; 3];
        }
        let share = if constant > 0.0 {
            ambient / constant
        } else {
            ambient
        };
        node.triple("color").map(|v| v.clamp(0.0, 1.0) * share)
    }

    fn vrml_light(&mut self, id: NodeId, kind: LightKind) -> Light {
        let node = self.graph.node(id);
        let environment = match kind {
            LightKind::Directional { .. } => self.state.environment_id,
            _ => {
                let [constant, linear, quadratic] = node.triple("attenuation").map(|v| v.max(0.0));
                let attenuation = match [quadratic, linear, constant] {
                    // No attenuation at all would divide by zero.
                    [0.0, 0.0, 0.0] => [0.0, 0.0, 1.0],
                    given => given,
                };
                self.builder.environment(&Environment {
                    attenuation,
                    ..self.state.environment.clone()
                })
            }
        };
        Light {
            placement: self.place(id),
            kind,
            color_srgb: node.triple("color").map(|v| v.clamp(0.0, 1.0)),
            intensity: node.number("intensity").clamp(0.0, 1.0),
            beam: None,
            radius_in_world: None,
            environment,
        }
    }

    /// Adds to the ambient light of what comes next in its scope.
    fn add_ambient(&mut self, color: [f64; 3]) {
        let mut environment = self.state.environment.clone();
        let before = environment.ambient_intensity;
        let sum = |i: usize| environment.ambient_color_srgb[i] * before + color[i];
        environment.ambient_color_srgb = [sum(0), sum(1), sum(2)].map(|v| v.min(1.0));
        environment.ambient_intensity = 1.0;
        self.state.environment_id = self.builder.environment(&environment);
        self.state.environment = environment;
    }
}

/// OpenGL's exponent, over 128, for a light that is full within `beamWidth` and falls to nothing
/// at `cutOffAngle`: the one that halves it midway between them.
fn drop_off_rate(node: &Node) -> f64 {
    let (beam, cut_off) = (node.number("beamWidth"), node.number("cutOffAngle"));
    if beam >= cut_off {
        return 0.0;
    }
    let middle = ((beam.max(0.0) + cut_off) / 2.0).cos();
    if middle <= 0.0 || middle >= 1.0 {
        return 1.0;
    }
    (0.5_f64.ln() / middle.ln() / 128.0).clamp(0.0, 1.0)
}
