//! Shapes: from the state to an instance with a mesh and a material.

use std::sync::Arc;

use geometry::transform::largest_stretch;

use crate::graph::{FieldValue, NodeId};
use crate::registry::Class;
use crate::scene::{
    Faces, Instance, LightModel, LightSetId, Material, Mesh, Texture, TextureId, TextureModel,
    TextureSource, Wrap,
};
use crate::shape::{
    Attributes, Job, Made, MadeFaces, Measure, ShapeMaker, has_profiles, is_closed, is_nurbs,
    is_screen_text, is_text,
};

use super::Geometry;
use super::state::{Ordering, State, Style};
use super::walk::Walk;

/// Digits of a chord behind its first: it becomes smaller by at most 1/16.
const CHORD_BITS: u32 = 4;

impl Walk<'_> {
    /// Adds a shape; false if it is none that is drawn here.
    pub(super) fn shape(&mut self, class: Class, id: NodeId) -> bool {
        if !ShapeMaker::knows(class) {
            return false;
        }
        if !(self.options.like_coin && is_screen_text(class)) {
            self.shape_as(class, id, id, None);
        }
        true
    }

    /// Adds the shape `id`, drawn as one of `class`, or as the faces made for it, and placed and
    /// named as the node `placed`.
    pub(super) fn shape_as(
        &mut self,
        class: Class,
        id: NodeId,
        placed: NodeId,
        made: Option<&MadeFaces>,
    ) {
        if self.options.like_coin && is_screen_text(class) {
            return;
        }
        let style = if self.options.like_coin {
            Style::Filled
        } else {
            self.state.draw_style.style
        };
        if style == Style::Invisible {
            let node = self.graph.node(id);
            self.left_out("shapes of the DrawStyle INVISIBLE are left out", node);
            return;
        }
        // What cannot be placed is not made.
        if !self.can_place(self.graph.node(id)) {
            return;
        }
        let graph = self.graph;
        let state = self.state.clone();
        let Some(profiles) = self.profiles_of(class, id) else {
            return;
        };
        let job = Job {
            graph,
            class,
            node: id,
            state: &state,
            lit: state.light_model == LightModel::Phong,
            style,
            shared: self.is_shared(id) || self.is_shared(placed),
            made,
            fans: self.options.like_coin,
            chord: self.local_chord(class),
            profiles,
        };
        let attributes = Attributes::of(&job);
        let builder = &mut self.builder;
        let geometry = self.options.geometry;
        let keep = |mesh: Mesh| match geometry {
            Geometry::Build => builder.mesh(mesh),
            Geometry::Measure => builder.measure(Measure::of(&mesh)),
        };
        let made = self.shapes.mesh(&job, &attributes, &mut self.remarks, keep);
        if self.shapes.made_bytes() > self.limits.geometry_bytes {
            let limit = self.limits.geometry_bytes >> 20;
            let what = format!("its geometry takes more than {limit} MiB");
            self.stop("too-much-geometry", &what, graph.node(id).pos);
        }
        if let Some(made) = made {
            let mut placement = self.place(placed);
            if placement.name.is_none() {
                placement.name = graph.node(id).name.clone();
            }
            let material = self.material(&job, &attributes, &made);
            let light_set = self.builder.light_set(state.lights).unwrap_or_else(|| {
                self.remarks.warn(
                    "too-many-lights",
                    "too many shapes are each lit by too many lights",
                    "the rest is taken as lit by none of them",
                    placement.pos,
                );
                LightSetId(0)
            });
            self.builder.instance(Instance {
                placement,
                mesh: made.mesh,
                material,
                light_set,
                environment: state.environment_id,
            });
            if is_text(class) {
                let strings = graph.node(id).value("string").texts().to_vec();
                self.builder.text(strings, is_screen_text(class));
            }
            self.shape_in_variants(&job, &made);
        }
    }

    /// The profiles that shape a shape; `None` if there are too many.
    fn profiles_of(&mut self, class: Class, id: NodeId) -> Option<Vec<NodeId>> {
        if !has_profiles(class) {
            return Some(Vec::new());
        }
        let nodes = self.profiles.nodes(self.state.profiles);
        if nodes.is_none() {
            self.remarks.warn(
                "bad-nurbs",
                &format!("{class:?} has too many profiles"),
                "it was left out",
                self.graph.node(id).pos,
            );
        }
        nodes
    }

    /// The chord asked for in the shape's own frame, for shapes that follow it. A little smaller
    /// than it may be, so that places that differ by rounding share a mesh.
    fn local_chord(&self, class: Class) -> Option<f64> {
        let chord = self.options.chord.filter(|_| is_nurbs(class))?;
        let local = chord / largest_stretch(&self.world().matrix3);
        let kept_bits = !0 << (52 - CHORD_BITS);
        Some(f64::from_bits(local.to_bits() & kept_bits))
    }

    pub(super) fn material(
        &mut self,
        job: &Job<'_>,
        attributes: &Attributes<'_>,
        made: &Made,
    ) -> crate::scene::MaterialId {
        let state = job.state;
        let graph = self.graph;
        let node = state.material.node.map(|id| graph.node(id));
        let texture = if made.textured { state.texture } else { None };
        let texture = texture.map(|id| self.texture(id));
        let material = &state.material;
        let is_primitive = is_closed(job.class, attributes);
        self.builder.material(Material {
            name: node.and_then(|n| n.name.clone()),
            ambient_srgb: unit_color(material.ambient),
            diffuse_srgb: attributes.colors.diffuse_srgb(0),
            specular_srgb: unit_color(material.specular),
            emissive_srgb: unit_color(material.emissive),
            shininess: material.shininess,
            transparency: attributes.colors.transparency(0),
            // What has no normals cannot be lit.
            light_model: if made.lit {
                state.light_model
            } else {
                LightModel::BaseColor
            },
            faces: if is_primitive && job.style == Style::Filled {
                Faces::FrontOnly
            } else {
                faces(state)
            },
            texture,
            line_width_px: state.draw_style.line_width_px,
            point_size_px: state.draw_style.point_size_px,
            line_pattern: state.draw_style.line_pattern,
            style_pos: state.draw_style.pos,
            pos: node.map(|n| n.pos).unwrap_or_default(),
        })
    }

    fn texture(&mut self, id: NodeId) -> TextureId {
        let graph = self.graph;
        let node = graph.node(id);
        if node.class() != Some(Class::Texture2) {
            return self.vrml_texture(id);
        }
        let wrap = |field: &str| {
            if node.word(field) == "CLAMP" {
                Wrap::Clamp
            } else {
                Wrap::Repeat
            }
        };
        let file = node.text("filename").filter(|name| !name.is_empty());
        self.builder.texture(id, || Texture {
            name: node.name.clone(),
            source: match (file, node.value("image")) {
                (Some(name), _) => TextureSource::File {
                    name: Arc::clone(name),
                    beside: graph.files[node.pos.file as usize].folder.clone(),
                },
                (None, FieldValue::Image(Some(image))) => TextureSource::Inline(Arc::clone(image)),
                (None, _) => TextureSource::File {
                    name: "".into(),
                    beside: "".into(),
                },
            },
            wrap_s: wrap("wrapS"),
            wrap_t: wrap("wrapT"),
            model: match node.word("model") {
                "DECAL" => TextureModel::Decal,
                "BLEND" => TextureModel::Blend,
                "REPLACE" => TextureModel::Replace,
                _ => TextureModel::Modulate,
            },
            blend_color_srgb: unit_color(node.triple("blendColor")),
            pos: node.pos,
        })
    }
}

fn unit_color(color: [f64; 3]) -> [f64; 3] {
    color.map(|v| v.clamp(0.0, 1.0))
}

/// Culling and two-sided lighting (SoShapeHintsElement).
fn faces(state: &State) -> Faces {
    match (state.hints.ordering, state.hints.solid) {
        (Ordering::Unknown, _) => Faces::BothOneSidedLighting,
        (_, true) => Faces::FrontOnly,
        (_, false) => Faces::BothTwoSidedLighting,
    }
}
