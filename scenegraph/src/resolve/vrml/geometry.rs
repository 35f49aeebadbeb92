//! Geometry nodes: their fields become state, under which the shape is drawn as Inventor's like it.

use std::rc::Rc;

use crate::graph::{Node, NodeId};
use crate::registry::Class;
use crate::resolve::state::{Binding, ColorSource, Ordering, TexCoords};
use crate::resolve::walk::Walk;
use crate::scene::LightModel;
use crate::shape::{Complaint, MadeFaces, ShapeMaker, elevation_grid, extrusion};

/// Inventor's shape that draws a geometry.
fn drawn_as(class: Class) -> Option<Class> {
    Some(match class {
        Class::VRMLBox => Class::Cube,
        Class::VRMLSphere => Class::Sphere,
        Class::VRMLCone => Class::Cone,
        Class::VRMLCylinder => Class::Cylinder,
        Class::VRMLIndexedFaceSet | Class::VRMLElevationGrid | Class::VRMLExtrusion => {
            Class::IndexedFaceSet
        }
        Class::VRMLIndexedLineSet => Class::IndexedLineSet,
        Class::VRMLPointSet => Class::PointSet,
        Class::VRMLText => class,
        _ => return None,
    })
}

/// Whether a class is a geometry of VRML 2 that is drawn.
pub(super) fn is_geometry(class: Class) -> bool {
    drawn_as(class).is_some()
}

impl Walk<'_> {
    /// Adds a geometry, which is placed and named as the node `shape`.
    pub(super) fn vrml_geometry(&mut self, id: NodeId, shape: NodeId) {
        let graph = self.graph;
        let node = graph.node(id);
        let Some(class) = node.class() else { return };
        let Some(drawn_as) = drawn_as(class) else {
            if ShapeMaker::knows(class) {
                self.shape_as(class, id, shape, None);
            } else {
                self.remarks.warn(
                    "wrong-class",
                    &format!("a Shape has a {} for its geometry", node.class_name()),
                    "the Shape was left out",
                    node.pos,
                );
            }
            return;
        };
        let before = self.state.clone();
        let made = match class {
            Class::VRMLElevationGrid => self.made(id, elevation_grid),
            Class::VRMLExtrusion => self.made(id, extrusion),
            _ => None,
        };
        let is_given = drawn_as != Class::IndexedFaceSet || class == Class::VRMLIndexedFaceSet;
        if (made.is_some() || is_given) && self.set_state(class, node) {
            self.shape_as(drawn_as, id, shape, made.as_deref());
        }
        self.state = before;
    }

    /// What a geometry's rule makes, once for each node.
    fn made(
        &mut self,
        id: NodeId,
        rule: fn(&Node) -> Result<MadeFaces, Complaint>,
    ) -> Option<Rc<MadeFaces>> {
        if let Some(known) = self.made.get(&id) {
            return known.clone();
        }
        let node = self.graph.node(id);
        let made = match rule(node) {
            Ok(made) => Some(Rc::new(made)),
            Err(complaint) => {
                let hint = "it was left out";
                self.remarks.warn("bad-shape", complaint, hint, node.pos);
                None
            }
        };
        if self.is_shared(id) {
            self.made.insert(id, made.clone());
        }
        made
    }

    /// Sets the state that a geometry's fields stand for; false if there is nothing to draw.
    fn set_state(&mut self, class: Class, node: &Node) -> bool {
        let has = |field: &str| class.spec().field(field.as_bytes()).is_some();
        if has("coord") {
            let classes = [Class::VRMLCoordinate, Class::Coordinate3];
            self.state.coordinates = self.part(node, "coord", &classes);
            if self.state.coordinates.is_none() {
                return false;
            }
        }
        if has("ccw") {
            self.state.hints.ordering = match node.flag("ccw") {
                true => Ordering::CounterClockwise,
                false => Ordering::Clockwise,
            };
            self.state.hints.solid = node.flag("solid");
            self.state.hints.crease_angle_rad = node.number("creaseAngle");
        }
        if class == Class::VRMLText {
            self.state.font = self.part(node, "fontStyle", &[Class::VRMLFontStyle]);
            let graph = self.graph;
            let size = |id: NodeId| graph.node(id).number("size");
            self.state.font_size = self.state.font.map_or(1.0, size);
        }
        self.state.normals = None;
        if has("normal") {
            let normals = self.part(node, "normal", &[Class::VRMLNormal, Class::Normal]);
            let graph = self.graph;
            self.state.normals = normals.filter(|&n| !graph.node(n).numbers("vector").is_empty());
            self.state.normal_binding = by(node.flag("normalPerVertex"));
        }
        if has("texCoord") {
            let classes = [Class::VRMLTextureCoordinate, Class::TextureCoordinate2];
            let list = self.part(node, "texCoord", &classes);
            self.state.texcoords = list.map_or(TexCoords::Default, TexCoords::List);
        }
        let lines = matches!(class, Class::VRMLIndexedLineSet | Class::VRMLPointSet);
        if lines {
            self.glow();
        }
        if has("color")
            && let Some(color) = self.part(node, "color", &[Class::VRMLColor])
            && !self.graph.node(color).numbers("color").is_empty()
        {
            // A coloured texture hides what is under it.
            if lines || self.state.texture.is_none() || !self.is_white() {
                self.state.material.diffuse = ColorSource::Color(color);
                self.state.material_binding = match class {
                    Class::VRMLPointSet => Binding::PerVertex,
                    _ => by(node.flag("colorPerVertex")),
                };
            }
        }
        true
    }

    fn is_white(&self) -> bool {
        self.state.material.diffuse == ColorSource::White
    }

    /// Lines and points are not lit: they show the emissive colour (ISO 14772-1, 6.24 and 6.36).
    fn glow(&mut self) {
        self.state.light_model = LightModel::BaseColor;
        self.state.texture = None;
        self.state.normals = None;
        if let Some(material) = self.state.material.node {
            let is_vrml = self.graph.node(material).class() == Some(Class::VRMLMaterial);
            if is_vrml {
                self.state.material.diffuse = ColorSource::Emissive(material);
            }
        }
    }
}

fn by(vertex: bool) -> Binding {
    match vertex {
        true => Binding::PerVertexIndexed,
        false => Binding::PerFaceIndexed,
    }
}
