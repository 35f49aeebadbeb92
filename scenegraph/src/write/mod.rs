//! A resolved scene as Inventor V2.1 text: the way back for models that were never Inventor's, or
//! no longer are.
//!
//! The scene has no state left in it, so the text needs little: a Separator for each group and each
//! shape, with what the shape needs inside it; what is used several times is defined once. Names
//! that Inventor cannot write are changed, and kept in a `Label`. Lights stand ahead of the shapes
//! they reach, cameras at the top; both are written in the frame they then stand in.
//!
//! Hidden groups stand in a Switch that shows nothing, coarser levels in an LOD.
//!
//! Not kept: the classes of groups other than Separator, variants, and which places of a file a scene came
//! from. Files of images are the caller's business: it says what each texture is called.

mod cameras;
mod groups;
mod levels;
mod lights;
mod look;
mod names;
mod shape;
mod text;

use std::sync::Arc;

use crate::scene::{Image, Scene};

use groups::Writer;
pub use names::legal as legal_name;

/// Where the pixels of a texture are, for the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ImageForm {
    /// In a file of this name, as seen from the text.
    File(String),
    /// In the text.
    Inline(Arc<Image>),
    /// Nowhere: the texture is left out.
    Missing,
}

/// A scene as text, and what could not be written as it is.
#[derive(Clone, Debug, Default)]
pub struct SceneText {
    /// ASCII but for names and notes, which are UTF-8.
    pub text: Vec<u8>,
    /// Names that were changed; each stands in a `Label` beside.
    pub renamed: usize,
    /// Shapes or groups that more lights reach than in the scene.
    pub lit_by_more: usize,
}

/// Writes a scene. `images` are those of its textures, in their order; textures beyond them are
/// left out.
///
/// Numbers read back as they are: positions as the f64 sum of a mesh's origin and its f32, all other
/// f32 as the shortest text of that f32, transforms as f64.
#[must_use]
pub fn write_scene(scene: &Scene, images: &[ImageForm]) -> SceneText {
    Writer::new(scene, images).write()
}

/// One mesh as a shape node, without anything around it, indented by `depth` levels; vertex colours
/// are left out.
#[must_use]
pub fn write_shape(mesh: &crate::scene::Mesh, depth: usize) -> Vec<u8> {
    let mut text = text::Text::default();
    text.indent_by(depth);
    shape::write(&mut text, mesh, None, &shape::Palette::default());
    text.into_bytes()
}
