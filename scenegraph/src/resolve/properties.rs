//! Property nodes: those that only write into the state.

use geometry::transform::normal_matrix;
use glam::{DMat3, DVec2, DVec3};
use iv_parser::Dialect;

use crate::graph::{FieldValue, Node, NodeId};
use crate::registry::Class;
use crate::scene::{Environment, Fog, FogType, LightModel};
use crate::shape::has_texcoords;

use super::state::{Binding, ColorSource, Ordering, ProfileList, State, Style, TexCoords};
use super::walk::Walk;

impl Walk<'_> {
    /// Applies a property node; false if it is none.
    pub(super) fn property(&mut self, class: Class, id: NodeId) -> bool {
        let graph = self.graph;
        let node = graph.node(id);
        let state = &mut self.state;
        match class {
            Class::Coordinate3 | Class::Coordinate4 => {
                if !node.is_ignored("point") {
                    state.coordinates = Some(id);
                }
            }
            Class::ProfileCoordinate2 | Class::ProfileCoordinate3 => {
                if !node.is_ignored("point") {
                    state.profile_coordinates = Some(id);
                }
            }
            Class::LinearProfile | Class::NurbsProfile => {
                if node.word("linkage") == "START_FIRST" {
                    state.profiles = ProfileList::default();
                }
                state.profiles = self.profiles.add(state.profiles, id);
            }
            Class::Normal => {
                if !node.is_ignored("vector") {
                    state.normals = (!node.numbers("vector").is_empty()).then_some(id);
                }
            }
            Class::TextureCoordinate2 | Class::TextureCoordinate3 if node.is_ignored("point") => {}
            Class::TextureCoordinate2 | Class::TextureCoordinate3 => {
                let given = !node.numbers("point").is_empty();
                state.texcoords = if given {
                    TexCoords::List(id)
                } else {
                    TexCoords::Default
                };
            }
            Class::TextureCoordinateDefault => state.texcoords = TexCoords::Default,
            Class::TextureCoordinatePlane | Class::TextureCoordinateObject => {
                state.texcoords = TexCoords::Function(id);
            }
            Class::VertexProperty => vertex_property(node, id, state),
            Class::NormalBinding | Class::MaterialBinding | Class::TextureCoordinateBinding
                if node.is_ignored("value") => {}
            Class::LightModel if node.is_ignored("model") => {}
            Class::NormalBinding => {
                state.normal_binding =
                    Binding::from_word(node.word("value"), Binding::PerVertexIndexed);
            }
            Class::MaterialBinding => {
                state.material_binding = Binding::from_word(node.word("value"), Binding::Overall);
            }
            Class::TextureCoordinateBinding => {
                state.texcoord_binding =
                    Binding::from_word(node.word("value"), Binding::PerVertexIndexed);
            }
            Class::Material => {
                let file = &graph.files[node.pos.file as usize];
                material(node, id, state);
                if file.header.dialect == Dialect::Vrml1 {
                    light_beforehand(node, id, state);
                }
            }
            Class::BaseColor => {
                if !node.numbers("rgb").is_empty() && !node.is_ignored("rgb") {
                    state.material.diffuse = ColorSource::Base(id);
                }
            }
            Class::PackedColor => {
                if !node.ints("orderedRGBA").is_empty() && !node.is_ignored("orderedRGBA") {
                    state.material.diffuse = ColorSource::Packed(id);
                }
            }
            Class::LightModel => {
                state.light_model = match node.word("model") {
                    "BASE_COLOR" => LightModel::BaseColor,
                    _ => LightModel::Phong,
                };
            }
            Class::ShapeHints => {
                let file = &graph.files[node.pos.file as usize];
                shape_hints(node, state, file.header.dialect == Dialect::Vrml1);
            }
            Class::Complexity => {
                if node.word("type") == "BOUNDING_BOX" {
                    self.remarks.warn(
                        "bounding-box",
                        "Complexity asks for boxes in place of shapes",
                        "the shapes themselves were used",
                        node.pos,
                    );
                }
                if !node.is_ignored("value") {
                    state.complexity = node.number("value").clamp(0.0, 1.0);
                }
            }
            Class::DrawStyle => draw_style(node, state),
            // Picture, wrapping and model are one element of the state, which the picture's fields
            // stand for (SGI's SoTexture2).
            Class::Texture2 if node.is_ignored("filename") || node.is_ignored("image") => {}
            Class::Texture2 => {
                let image = matches!(node.value("image"), FieldValue::Image(Some(_)));
                let file = node.text("filename").is_some_and(|name| !name.is_empty());
                // An empty Texture2 turns texturing off.
                state.texture = (image || file).then_some(id);
            }
            Class::Texture2Transform => {
                state.texture_transform *= texture_transform(node);
            }
            Class::TextureMatrixTransform if node.is_ignored("matrix") => {}
            Class::TextureMatrixTransform => {
                if let Ok(m) = <[f64; 16]>::try_from(node.numbers("matrix")) {
                    state.texture_transform *= DMat3::from_cols(
                        DVec3::new(m[0], m[1], m[3]),
                        DVec3::new(m[4], m[5], m[7]),
                        DVec3::new(m[12], m[13], m[15]),
                    );
                }
            }
            Class::ClipPlane => self.clip_plane(node),
            Class::Environment => self.environment(node),
            Class::Font | Class::FontStyle => {
                if !node.is_ignored("name") {
                    state.font = Some(id);
                }
                if !node.is_ignored("size") {
                    state.font_size = node.number("size");
                }
            }
            _ => return false,
        }
        true
    }

    /// Says that a plane cuts nothing off, and where it would.
    fn clip_plane(&mut self, node: &Node) {
        if !node.flag("on") {
            return;
        }
        let &[x, y, z, distance] = node.numbers("plane") else {
            return;
        };
        let world = self.world();
        let normal = DVec3::new(x, y, z).normalize_or_zero();
        let [a, b, c] = normal_matrix(&world)
            .mul_vec3(normal)
            .normalize_or_zero()
            .to_array();
        let [px, py, pz] = world.transform_point3(distance * normal).to_array();
        let message = format!(
            "a ClipPlane cuts nothing off: the plane through ({px:.6}, {py:.6}, {pz:.6}) that keeps \
             what lies towards ({a:.6}, {b:.6}, {c:.6})"
        );
        let hint = "glTF has no such planes; what it hides in Inventor is shown";
        let pos = node.pos;
        self.remarks.warn("clip-plane", &message, hint, pos);
    }

    fn environment(&mut self, node: &Node) {
        let before = &self.state.environment;
        let fog = match node.word("fogType") {
            _ if node.is_ignored("fogType") => before.fog,
            "HAZE" => Some(fog(node, FogType::Haze, before)),
            "FOG" => Some(fog(node, FogType::Fog, before)),
            "SMOKE" => Some(fog(node, FogType::Smoke, before)),
            _ => None,
        };
        let triple = |field: &str, before: [f64; 3]| {
            if node.is_ignored(field) {
                before
            } else {
                node.triple(field)
            }
        };
        let environment = Environment {
            ambient_intensity: if node.is_ignored("ambientIntensity") {
                before.ambient_intensity
            } else {
                node.number("ambientIntensity")
            },
            ambient_color_srgb: triple("ambientColor", before.ambient_color_srgb),
            attenuation: triple("attenuation", before.attenuation),
            fog,
            pos: node.pos,
        };
        self.state.environment_id = self.builder.environment(&environment);
        self.state.environment = environment;
    }
}

/// Fog of an Environment; colour and visibility marked as ignored are those of the fog before it.
fn fog(node: &Node, fog_type: FogType, before: &Environment) -> Fog {
    let kept = |field: &str| before.fog.filter(|_| node.is_ignored(field));
    Fog {
        fog_type,
        color_srgb: kept("fogColor").map_or_else(|| node.triple("fogColor"), |f| f.color_srgb),
        visibility: kept("fogVisibility")
            .map_or_else(|| node.number("fogVisibility"), |f| f.visibility),
    }
}

/// Fields that hold something take the place of the state's.
fn vertex_property(node: &Node, id: NodeId, state: &mut State) {
    if !node.numbers("vertex").is_empty() {
        state.coordinates = Some(id);
    }
    if !node.numbers("normal").is_empty() {
        state.normals = Some(id);
        state.normal_binding =
            Binding::from_word(node.word("normalBinding"), Binding::PerVertexIndexed);
    }
    if has_texcoords(node) {
        state.texcoords = TexCoords::List(id);
    }
    if !node.ints("orderedRGBA").is_empty() {
        state.material.diffuse = ColorSource::Packed(id);
        state.material_binding = Binding::from_word(node.word("materialBinding"), Binding::Overall);
    }
}

/// A Material sets all six properties, those not written to their defaults; an empty list or an
/// ignored field leaves the state alone (Coin's SoMaterial).
fn material(node: &Node, id: NodeId, state: &mut State) {
    let sets = |field: &str| !node.is_ignored(field) && !node.numbers(field).is_empty();
    let material = &mut state.material;
    material.node = Some(id);
    if sets("diffuseColor") {
        material.diffuse = ColorSource::Material(id);
    }
    if sets("transparency") {
        material.transparency = ColorSource::Material(id);
    }
    if sets("ambientColor") {
        material.ambient = node.triple("ambientColor");
    }
    if sets("specularColor") {
        material.specular = node.triple("specularColor");
    }
    if sets("emissiveColor") {
        material.emissive = node.triple("emissiveColor");
    }
    if sets("shininess") {
        material.shininess = node.number("shininess").clamp(0.0, 1.0);
    }
}

/// VRML 1 has no LightModel. There a Material says that its shapes are lit beforehand by having
/// more emissive than diffuse colours (Coin's SoMaterial::getMaterialType), or by reflecting
/// nothing at all (VRML 1.0, Material); any other Material says that they are lit.
fn light_beforehand(node: &Node, id: NodeId, state: &mut State) {
    let values = |field: &str| (!node.is_ignored(field)).then(|| node.numbers(field));
    let is_black = |field: &str| values(field).is_some_and(|v| v.iter().all(|&v| v == 0.0));
    let emissive = values("emissiveColor").unwrap_or(&[]);
    let diffuse = values("diffuseColor").unwrap_or(&[]);
    let glows_only =
        !is_black("emissiveColor") && is_black("diffuseColor") && is_black("specularColor");
    state.light_model = if emissive.len() > diffuse.len() || (glows_only && !emissive.is_empty()) {
        state.material.diffuse = ColorSource::Emissive(id);
        LightModel::BaseColor
    } else {
        LightModel::Phong
    };
}

fn shape_hints(node: &Node, state: &mut State, vrml1: bool) {
    if !node.is_ignored("vertexOrdering") {
        state.hints.ordering = match node.word("vertexOrdering") {
            "CLOCKWISE" => Ordering::Clockwise,
            "COUNTERCLOCKWISE" => Ordering::CounterClockwise,
            _ => Ordering::Unknown,
        };
    }
    if !node.is_ignored("shapeType") {
        state.hints.solid = node.word("shapeType") == "SOLID";
    }
    if !node.is_ignored("creaseAngle") {
        let default = if vrml1 { 0.5 } else { 0.0 };
        let given = node.entry("creaseAngle").is_some();
        state.hints.crease_angle_rad = if given {
            node.number("creaseAngle")
        } else {
            default
        };
    }
}

fn draw_style(node: &Node, state: &mut State) {
    let style = &mut state.draw_style;
    style.pos = node.pos;
    if !node.is_ignored("style") {
        style.style = match node.word("style") {
            "LINES" => Style::Lines,
            "POINTS" => Style::Points,
            "INVISIBLE" => Style::Invisible,
            _ => Style::Filled,
        };
    }
    if !node.is_ignored("lineWidth") {
        style.line_width_px = node.number("lineWidth").max(0.0);
    }
    if !node.is_ignored("pointSize") {
        style.point_size_px = node.number("pointSize").max(0.0);
    }
    if !node.is_ignored("linePattern") {
        style.line_pattern = node.int("linePattern") as u16;
    }
}

/// Scale, then rotate, about `center`; then translate (Coin's SoTexture2Transform). A field marked
/// as ignored does nothing.
fn texture_transform(node: &Node) -> DMat3 {
    let pair = |field: &str, without: DVec2| match node.numbers(field) {
        [x, y, ..] if !node.is_ignored(field) => DVec2::new(*x, *y),
        _ => without,
    };
    let center = pair("center", DVec2::ZERO);
    let angle_rad = if node.is_ignored("rotation") {
        0.0
    } else {
        node.number("rotation")
    };
    DMat3::from_translation(pair("translation", DVec2::ZERO) + center)
        * DMat3::from_angle(angle_rad)
        * DMat3::from_scale(pair("scaleFactor", DVec2::ONE))
        * DMat3::from_translation(-center)
}
