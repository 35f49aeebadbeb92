//! What a shader depends on, of material, geometry and environment; nothing of lights or passes.

use scenegraph::scene::{
    Environment, Faces, FogType, LightModel, Material, Mesh, Scene, TextureId, TextureModel,
    Topology,
};

use crate::texture::Images;

/// What the vertices make.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Primitive {
    /// Filled triangles.
    Triangles,
    /// Segments some pixels wide.
    Lines,
    /// Squares some pixels wide.
    Points,
}

/// `Texture2.model`, ordered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum TextureUseModel {
    /// Shaded colour times texture.
    Modulate,
    /// Texture over the shaded colour by its alpha.
    Decal,
    /// Between the shaded colour and the blend colour.
    Blend,
    /// The texture alone.
    Replace,
}

/// How a texture enters the shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TextureUse {
    /// How it meets the shaded colour.
    pub model: TextureUseModel,
    /// Its image has an alpha channel.
    pub has_alpha: bool,
}

/// The kind of fog, ordered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FogUse {
    /// Linear.
    Haze,
    /// Exponential.
    Fog,
    /// Exponential squared.
    Smoke,
}

/// What the shader of an object depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Look {
    /// What the vertices make.
    pub primitive: Primitive,
    /// Alpha below one somewhere: drawn after all opaque objects, blended.
    pub is_transparent: bool,
    /// Lights reach it.
    pub is_lit: bool,
    /// The normal is turned on back faces.
    pub is_two_sided: bool,
    /// The specular colour is not black.
    pub is_specular: bool,
    /// Vertices have colours in place of the material's.
    pub has_colors: bool,
    /// The texture, if any.
    pub texture: Option<TextureUse>,
    /// The fog it stands in, if any.
    pub fog: Option<FogUse>,
}

impl Look {
    /// Of a mesh under a material. `texture` is what is shown, decoded in `images`.
    pub fn of(
        scene: &Scene,
        mesh: &Mesh,
        material: &Material,
        environment: &Environment,
        texture: Option<TextureId>,
        images: &Images,
    ) -> Self {
        let texture_use = texture.map(|id| TextureUse {
            model: match scene.textures[id.index()].model {
                TextureModel::Modulate => TextureUseModel::Modulate,
                TextureModel::Decal => TextureUseModel::Decal,
                TextureModel::Blend => TextureUseModel::Blend,
                TextureModel::Replace => TextureUseModel::Replace,
            },
            has_alpha: images.get(id).is_some_and(|image| image.has_alpha),
        });
        let is_replaced = texture_use.is_some_and(|t| t.model == TextureUseModel::Replace);
        let is_lit =
            material.light_model == LightModel::Phong && !mesh.normals.is_empty() && !is_replaced;
        let base_alpha_below_one = if mesh.colors_srgb.is_empty() {
            material.transparency > 0.0
        } else {
            mesh.colors_srgb.iter().any(|color| color[3] < 1.0)
        };
        let primitive = match mesh.topology {
            Topology::Triangles => Primitive::Triangles,
            Topology::Lines => Primitive::Lines,
            Topology::Points => Primitive::Points,
        };
        Self {
            primitive,
            is_transparent: match texture_use {
                Some(TextureUse {
                    model: TextureUseModel::Replace,
                    has_alpha: true,
                }) => true,
                Some(used) => {
                    base_alpha_below_one || used.has_alpha && used.model != TextureUseModel::Decal
                }
                None => base_alpha_below_one,
            },
            is_lit,
            is_two_sided: is_lit
                && primitive == Primitive::Triangles
                && material.faces == Faces::BothTwoSidedLighting,
            is_specular: is_lit && material.specular_srgb.iter().any(|&c| c > 0.0),
            has_colors: !mesh.colors_srgb.is_empty() && !is_replaced_whole(texture_use),
            texture: texture_use,
            fog: environment.fog.map(|fog| match fog.fog_type {
                FogType::Haze => FogUse::Haze,
                FogType::Fog => FogUse::Fog,
                FogType::Smoke => FogUse::Smoke,
            }),
        }
    }
}

/// Whether nothing of the colour below the texture is seen.
fn is_replaced_whole(texture: Option<TextureUse>) -> bool {
    texture.is_some_and(|t| t.model == TextureUseModel::Replace && t.has_alpha)
}
