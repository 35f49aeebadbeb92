//! How surfaces look: Inventor's own values, nothing converted.

use std::path::PathBuf;
use std::sync::Arc;

use iv_parser::SourcePos;

use super::TextureId;

/// `LightModel.model`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LightModel {
    /// Unlit: the diffuse colour as it is.
    BaseColor,
    /// Lit.
    Phong,
}

/// What `ShapeHints` says about the two sides of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Faces {
    /// Ordering not known: both sides are drawn, lit with the normal as it is.
    BothOneSidedLighting,
    /// Ordering known, not solid: both sides are drawn, the back lit with the turned normal.
    BothTwoSidedLighting,
    /// Ordering known and solid: back faces are not drawn.
    FrontOnly,
}

/// Inventor's material and all else that a shape's look depends on. Colours are display-referred
/// (sRGB), 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// DEF name of the `Material` node.
    pub name: Option<Arc<str>>,
    /// `ambientColor[0]`.
    pub ambient_srgb: [f64; 3],
    /// `diffuseColor[0]`; where the mesh has colours they stand in its place.
    pub diffuse_srgb: [f64; 3],
    /// `specularColor[0]`.
    pub specular_srgb: [f64; 3],
    /// `emissiveColor[0]`.
    pub emissive_srgb: [f64; 3],
    /// 0 to 1; OpenGL's exponent is 128 times this.
    pub shininess: f64,
    /// 0 opaque to 1 invisible.
    pub transparency: f64,
    /// Lit or not.
    pub light_model: LightModel,
    /// Which sides are drawn and how they are lit.
    pub faces: Faces,
    /// The texture on it.
    pub texture: Option<TextureId>,
    /// `DrawStyle.lineWidth` in pixels; 0 = default.
    pub line_width_px: f64,
    /// `DrawStyle.pointSize` in pixels; 0 = default.
    pub point_size_px: f64,
    /// `DrawStyle.linePattern`; 0xffff = solid.
    pub line_pattern: u16,
    /// Where the `DrawStyle` node stands; line 0 when its values are defaults.
    pub style_pos: SourcePos,
    /// Where the `Material` node stands; line 0 when all values are defaults.
    pub pos: SourcePos,
}

/// `wrapS`, `wrapT`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// Repeat.
    Repeat,
    /// Clamp to edge.
    Clamp,
}

/// `Texture2.model`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TextureModel {
    /// Shaded colour times texture.
    Modulate,
    /// Texture over the shaded colour by its alpha.
    Decal,
    /// Between the shaded colour and `blend_color_srgb` by the texture's intensity.
    Blend,
    /// The texture alone.
    Replace,
}

/// An image given in the file (`SFImage`).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA.
    pub components: u8,
    /// `width * height * components` bytes, rows from bottom to top.
    pub bytes: Vec<u8>,
}

/// Where the pixels come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TextureSource {
    /// In the file.
    Inline(Arc<Image>),
    /// In memory, as an image file, not decoded yet.
    Encoded {
        /// The file; its first bytes tell the format, whatever it is called.
        bytes: Arc<[u8]>,
        /// As the source calls it.
        name: Option<Arc<str>>,
    },
    /// A file of its own, not opened yet.
    File {
        /// As written in the source.
        name: Arc<str>,
        /// Folder of the file that names it, to search in first.
        beside: PathBuf,
    },
}

/// `Texture2`, resolved.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// DEF name of the node.
    pub name: Option<Arc<str>>,
    /// The pixels.
    pub source: TextureSource,
    /// Across.
    pub wrap_s: Wrap,
    /// Up.
    pub wrap_t: Wrap,
    /// How it meets the shaded colour.
    pub model: TextureModel,
    /// For [`TextureModel::Blend`].
    pub blend_color_srgb: [f64; 3],
    /// Where the node stands.
    pub pos: SourcePos,
}
