//! `Shape` and what its `appearance` says: material, texture, texture transform.

use std::sync::Arc;

use glam::{DMat3, DVec2};

use crate::graph::{FieldValue, Node, NodeId};
use crate::lower::picture_name;
use crate::registry::Class;
use crate::resolve::not_supported;
use crate::resolve::state::{ColorSource, State};
use crate::resolve::walk::Walk;
use crate::scene::{LightModel, Texture, TextureId, TextureModel, TextureSource, Wrap};

/// Components of a texture: up to two multiply with the colours under it, more stand in their
/// place; an alpha stands in place of the material's transparency (ISO 14772-1, table 4.5).
#[derive(Clone, Copy, PartialEq, Eq)]
struct Picture {
    components: u8,
}

impl Picture {
    fn is_colored(self) -> bool {
        self.components > 2
    }

    fn has_alpha(self) -> bool {
        self.components.is_multiple_of(2)
    }
}

impl Walk<'_> {
    pub(super) fn vrml_shape(&mut self, id: NodeId, node: &Node) {
        let Some(geometry) = node.node_field("geometry") else {
            return;
        };
        let before = self.state.clone();
        let fresh = State::new(false);
        self.state = State {
            coordinates: None,
            normals: None,
            texcoords: fresh.texcoords,
            normal_binding: fresh.normal_binding,
            material_binding: fresh.material_binding,
            texcoord_binding: fresh.texcoord_binding,
            material: fresh.material,
            light_model: LightModel::BaseColor,
            hints: fresh.hints,
            texture: None,
            texture_transform: fresh.texture_transform,
            forks: None,
            ..self.state.clone()
        };
        // Without a material a shape is white and not lit.
        self.state.material.diffuse = ColorSource::White;
        let appearance = self.part(node, "appearance", &[Class::VRMLAppearance]);
        if let Some(appearance) = appearance {
            self.appearance(self.graph.node(appearance));
        }
        self.vrml_geometry(geometry, id);
        self.state = before;
    }

    /// The node in a field, if it is of one of these classes; says so if it is of another one.
    pub(super) fn part(&mut self, node: &Node, field: &str, classes: &[Class]) -> Option<NodeId> {
        let id = node.node_field(field)?;
        let found = self.graph.node(id);
        if found.class().is_some_and(|c| classes.contains(&c)) {
            return Some(id);
        }
        self.remarks.warn(
            "wrong-class",
            &format!(
                "`{field}` of {} holds a {}",
                node.class_name(),
                found.class_name()
            ),
            "it was left out",
            found.pos,
        );
        None
    }

    fn appearance(&mut self, appearance: &Node) {
        let material = self.part(appearance, "material", &[Class::VRMLMaterial]);
        if let Some(id) = material {
            let node = self.graph.node(id);
            let share = node.number("ambientIntensity").clamp(0.0, 1.0);
            let state = &mut self.state;
            state.light_model = LightModel::Phong;
            state.material.node = Some(id);
            state.material.diffuse = ColorSource::Material(id);
            state.material.transparency = ColorSource::Material(id);
            state.material.ambient = node.triple("diffuseColor").map(|v| v * share);
            state.material.specular = node.triple("specularColor");
            state.material.emissive = node.triple("emissiveColor");
            state.material.shininess = node.number("shininess").clamp(0.0, 1.0);
        }
        let textures = [
            Class::VRMLImageTexture,
            Class::VRMLPixelTexture,
            Class::VRMLMovieTexture,
            Class::Texture2,
        ];
        let Some(texture) = self.part(appearance, "texture", &textures) else {
            return;
        };
        let node = self.graph.node(texture);
        let Some(picture) = self.picture(texture, node) else {
            return;
        };
        self.state.texture = Some(texture);
        if picture.has_alpha() {
            self.state.material.transparency = ColorSource::Default;
        }
        if picture.is_colored() {
            self.state.material.diffuse = ColorSource::White;
            let share = material.map_or(0.0, |id| self.graph.node(id).number("ambientIntensity"));
            self.state.material.ambient = [share.clamp(0.0, 1.0); 3];
        }
        let transforms = [Class::VRMLTextureTransform];
        if let Some(transform) = self.part(appearance, "textureTransform", &transforms) {
            self.state.texture_transform = texture_transform(self.graph.node(transform));
        }
    }

    /// What a texture is; `None` if it shows nothing. What a file holds that nobody could look at
    /// is taken as coloured, as nearly all are.
    fn picture(&mut self, id: NodeId, node: &Node) -> Option<Picture> {
        let components = match node.class() {
            Some(Class::VRMLPixelTexture) => match node.value("image") {
                FieldValue::Image(Some(image)) => image.components,
                _ => return None,
            },
            Some(Class::VRMLMovieTexture) => {
                not_supported(&mut self.remarks, "MovieTexture", node.pos);
                return None;
            }
            Some(Class::Texture2) => 1,
            _ if node.value("url").texts().is_empty() => return None,
            _ => self.graph.pictures.get(&id).copied().unwrap_or(3),
        };
        Some(Picture { components })
    }
}

impl Walk<'_> {
    /// The texture of an `ImageTexture` or `PixelTexture`.
    pub(in crate::resolve) fn vrml_texture(&mut self, id: NodeId) -> TextureId {
        let graph = self.graph;
        let node = graph.node(id);
        let wrap = |field: &str| match node.flag(field) {
            true => Wrap::Repeat,
            false => Wrap::Clamp,
        };
        let source = || match node.class() {
            Some(Class::VRMLPixelTexture) => match node.value("image") {
                FieldValue::Image(Some(image)) => Some(TextureSource::Inline(Arc::clone(image))),
                _ => None,
            },
            _ => picture_name(node.value("url").texts()).map(|name| TextureSource::File {
                name: Arc::clone(name),
                beside: graph.files[node.pos.file as usize].folder.clone(),
            }),
        };
        self.builder.texture(id, || Texture {
            name: node.name.clone(),
            source: source().unwrap_or(TextureSource::File {
                name: "".into(),
                beside: "".into(),
            }),
            wrap_s: wrap("repeatS"),
            wrap_t: wrap("repeatT"),
            model: TextureModel::Modulate,
            blend_color_srgb: [0.0; 3],
            pos: node.pos,
        })
    }
}

/// `-C * S * R * C * T` on texture coordinates as columns (ISO 14772-1, 6.49): they are moved,
/// then rotated and scaled about `center`.
fn texture_transform(node: &Node) -> DMat3 {
    let pair = |field: &str| match node.numbers(field) {
        [x, y, ..] => DVec2::new(*x, *y),
        _ => DVec2::ZERO,
    };
    let center = pair("center");
    DMat3::from_translation(-center)
        * DMat3::from_scale(pair("scale"))
        * DMat3::from_angle(node.number("rotation"))
        * DMat3::from_translation(center + pair("translation"))
}
