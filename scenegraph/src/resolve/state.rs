//! The traversal state, as a value.
//!
//! A Separator keeps a copy and puts it back; everything else writes into it. Pieces that are
//! large in the source are held by the node that set them, so a copy is a few hundred bytes.

use glam::{DAffine3, DMat3};
use iv_parser::SourcePos;

use crate::graph::NodeId;
use crate::scene::{Environment, EnvironmentId, LightModel};

use super::variants::Forks;

/// How values attach to geometry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binding {
    /// One value for all.
    Overall,
    /// One for each part.
    PerPart,
    /// One for each part, by index.
    PerPartIndexed,
    /// One for each face.
    PerFace,
    /// One for each face, by index.
    PerFaceIndexed,
    /// One for each vertex, in order.
    PerVertex,
    /// One for each vertex, by index.
    PerVertexIndexed,
}

impl Binding {
    /// From Inventor's word; `default` for `DEFAULT` and `NONE`.
    pub fn from_word(word: &str, default: Self) -> Self {
        match word {
            "OVERALL" => Self::Overall,
            "PER_PART" => Self::PerPart,
            "PER_PART_INDEXED" => Self::PerPartIndexed,
            "PER_FACE" => Self::PerFace,
            "PER_FACE_INDEXED" => Self::PerFaceIndexed,
            "PER_VERTEX" => Self::PerVertex,
            "PER_VERTEX_INDEXED" => Self::PerVertexIndexed,
            _ => default,
        }
    }
}

/// `ShapeHints.vertexOrdering`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Ordering {
    /// Not known.
    Unknown,
    /// Faces are clockwise seen from outside.
    Clockwise,
    /// Faces are counter-clockwise seen from outside.
    CounterClockwise,
}

/// `ShapeHints`.
#[derive(Clone, Copy, Debug)]
pub struct Hints {
    pub ordering: Ordering,
    pub solid: bool,
    pub crease_angle_rad: f64,
}

/// Which node's which list gives the diffuse colours or the transparencies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ColorSource {
    /// Inventor's default.
    Default,
    /// White: a VRML 2 Shape without a material, or under a coloured texture.
    White,
    /// VRML 2 `Color.color`.
    Color(NodeId),
    /// `Material.diffuseColor`, `Material.transparency`.
    Material(NodeId),
    /// `Material.emissiveColor` of a material that is lit beforehand.
    Emissive(NodeId),
    /// `BaseColor.rgb`.
    Base(NodeId),
    /// `PackedColor.orderedRGBA` or `VertexProperty.orderedRGBA`.
    Packed(NodeId),
}

/// The material but for the diffuse colour and transparency lists.
#[derive(Clone, Copy, Debug)]
pub struct MaterialState {
    /// The node that set these, for its name and place.
    pub node: Option<NodeId>,
    pub diffuse: ColorSource,
    pub transparency: ColorSource,
    pub ambient: [f64; 3],
    pub specular: [f64; 3],
    pub emissive: [f64; 3],
    pub shininess: f64,
}

/// Where texture coordinates come from when the shape has none of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TexCoords {
    /// The shape's bounding box.
    Default,
    /// `TextureCoordinate2`, `TextureCoordinate3` or `VertexProperty`.
    List(NodeId),
    /// `TextureCoordinatePlane` or `TextureCoordinateObject`.
    Function(NodeId),
}

/// `DrawStyle.style`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Style {
    Filled,
    Lines,
    Points,
    Invisible,
}

/// `DrawStyle`.
#[derive(Clone, Copy, Debug)]
pub struct DrawStyle {
    pub style: Style,
    pub line_width_px: f64,
    pub point_size_px: f64,
    pub line_pattern: u16,
    pub pos: SourcePos,
}

/// A list of lights, held by the builder: 0 is the empty one. Lists share their beginnings, so
/// that adding a light costs the same however many there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct LightList(pub u32);

/// A list of profile nodes, held by the walk: 0 is the empty one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ProfileList(pub u32);

/// All that a node can leave to those after it.
#[derive(Clone, Debug)]
pub struct State {
    /// Number of open frames that `relative` is relative to; 0 is the world.
    pub base: usize,
    /// The current transform in the frame `base`.
    pub relative: DAffine3,
    /// `Units` in metres.
    pub units_m: f64,
    /// Which copy or child the nearest group around chose, for `Switch` to inherit.
    pub choice: i32,
    pub coordinates: Option<NodeId>,
    /// `ProfileCoordinate2` or `ProfileCoordinate3`.
    pub profile_coordinates: Option<NodeId>,
    pub profiles: ProfileList,
    pub normals: Option<NodeId>,
    pub texcoords: TexCoords,
    pub normal_binding: Binding,
    pub material_binding: Binding,
    pub texcoord_binding: Binding,
    pub material: MaterialState,
    pub light_model: LightModel,
    pub hints: Hints,
    pub complexity: f64,
    pub draw_style: DrawStyle,
    /// The `Font` or `FontStyle` that names the font.
    pub font: Option<NodeId>,
    pub font_size: f64,
    /// The `Texture2` in force.
    pub texture: Option<NodeId>,
    /// Applied to texture coordinates (s, t, 1).
    pub texture_transform: DMat3,
    /// The lights that reach what comes next.
    pub lights: LightList,
    pub environment: Environment,
    pub environment_id: EnvironmentId,
    /// Looks in other variants.
    pub forks: Forks,
}

impl State {
    /// Inventor's defaults.
    pub fn new(vrml1: bool) -> Self {
        Self {
            base: 0,
            relative: DAffine3::IDENTITY,
            units_m: 1.0,
            choice: -1,
            coordinates: None,
            profile_coordinates: None,
            profiles: ProfileList::default(),
            normals: None,
            texcoords: TexCoords::Default,
            normal_binding: Binding::PerVertexIndexed,
            material_binding: Binding::Overall,
            texcoord_binding: Binding::PerVertexIndexed,
            material: MaterialState {
                node: None,
                diffuse: ColorSource::Default,
                transparency: ColorSource::Default,
                ambient: [0.2; 3],
                specular: [0.0; 3],
                emissive: [0.0; 3],
                shininess: 0.2,
            },
            light_model: LightModel::Phong,
            hints: Hints {
                ordering: Ordering::Unknown,
                solid: false,
                // VRML 1 smooths by default, Inventor does not.
                crease_angle_rad: if vrml1 { 0.5 } else { 0.0 },
            },
            complexity: 0.5,
            draw_style: DrawStyle {
                style: Style::Filled,
                line_width_px: 0.0,
                point_size_px: 0.0,
                line_pattern: 0xffff,
                pos: SourcePos::default(),
            },
            font: None,
            // SGI's; Coin's is 12.
            font_size: 10.0,
            texture: None,
            texture_transform: DMat3::IDENTITY,
            lights: LightList::default(),
            environment: Environment::default(),
            environment_id: EnvironmentId(0),
            forks: None,
        }
    }

    /// Multiplies a transform onto the current one: later transforms are inner.
    pub fn transform(&mut self, local: &DAffine3) {
        self.relative *= *local;
    }
}
