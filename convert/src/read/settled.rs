//! A material of which the file has both Inventor's values and glTF's: Inventor's, but for those of
//! which glTF's say that they were edited.
//!
//! What the writer makes of Inventor's values is made again, and both are read back as any glTF is.
//! What the material is on (vertex colours, a texture) is known as far as the file tells; where
//! several things are possible, the one that explains most of the file counts.

use gltf::json::material::Material as JsonMaterial;
use scenegraph::scene::{LightModel, Material, MaterialId};

use super::material::from_gltf;
use crate::Materials;
use crate::alike::{alike, all_alike};
use crate::image::Alpha;
use crate::json::Json;
use crate::material::{GltfMaterial, Surroundings, VertexColors};
use crate::texture::{Role, Shown};

/// What a material is on.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Use {
    /// Some mesh has colours of its own.
    pub(crate) has_colors: bool,
    /// Something is lit: triangles, or what has normals.
    pub(crate) is_lit: bool,
}

/// How a texture may make the surface: what `TextureModel` says, where there is a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mixing {
    None,
    Multiply,
    /// `DECAL`, `BLEND` or `REPLACE`: with or without the colour, by the image.
    Other,
}

/// `own` where nothing was edited, else with what the file shows. The second value says whether the
/// diffuse colour was edited.
pub(crate) fn settled(
    own: Material,
    shown: &Material,
    on: Use,
    mixing: Mixing,
    look: Materials,
) -> (Material, bool) {
    let made = possible(on, mixing).into_iter();
    let made = made.filter_map(|(surroundings, texture)| {
        let gltf = GltfMaterial::new(MaterialId(0), &own, surroundings, texture, look);
        let mut json = Json::with_capacity(256);
        gltf.write(&mut json, &own, false);
        let source: JsonMaterial = serde_json::from_slice(&json.into_bytes()).ok()?;
        let read = from_gltf(&source);
        Some(Edited::between(&read, shown))
    });
    // The first of equals.
    let edited = made.min_by_key(Edited::count).unwrap_or_default();
    let settled = Material {
        diffuse_srgb: pick(edited.diffuse, own.diffuse_srgb, shown.diffuse_srgb),
        specular_srgb: pick(edited.specular, own.specular_srgb, shown.specular_srgb),
        emissive_srgb: pick(edited.emissive, own.emissive_srgb, shown.emissive_srgb),
        shininess: pick(edited.shininess, own.shininess, shown.shininess),
        transparency: pick(edited.transparency, own.transparency, shown.transparency),
        light_model: pick(edited.light_model, own.light_model, shown.light_model),
        faces: pick(edited.faces, own.faces, shown.faces),
        ..own
    };
    (settled, edited.diffuse)
}

fn pick<T>(edited: bool, own: T, shown: T) -> T {
    if edited { shown } else { own }
}

/// What the writer may have had before it.
fn possible(on: Use, mixing: Mixing) -> Vec<(Surroundings, Option<Shown>)> {
    let surroundings = Surroundings {
        // How much of them shows through is not the material's.
        colors: if on.has_colors {
            VertexColors::Opaque
        } else {
            VertexColors::None
        },
        texcoords: mixing != Mixing::None,
        can_be_lit: on.is_lit,
    };
    let shown = |role, alpha| {
        let index = 0;
        Some(Shown { index, role, alpha })
    };
    let textures = match mixing {
        Mixing::None => vec![None],
        Mixing::Multiply => vec![shown(Role::Multiply, Alpha::Opaque)],
        Mixing::Other => vec![
            shown(Role::Diffuse, Alpha::Opaque),
            shown(Role::Replace, Alpha::Opaque),
            shown(Role::Replace, Alpha::Blend),
        ],
    };
    textures.into_iter().map(|t| (surroundings, t)).collect()
}

/// Which values differ.
#[derive(Clone, Copy, Debug, Default)]
struct Edited {
    diffuse: bool,
    specular: bool,
    emissive: bool,
    shininess: bool,
    transparency: bool,
    light_model: bool,
    faces: bool,
}

impl Edited {
    fn between(made: &Material, shown: &Material) -> Self {
        // Of what is not lit, neither highlights nor a glow of its own show.
        let lit = shown.light_model == LightModel::Phong;
        Self {
            diffuse: !all_alike(&made.diffuse_srgb, &shown.diffuse_srgb),
            specular: lit && !all_alike(&made.specular_srgb, &shown.specular_srgb),
            emissive: lit && !all_alike(&made.emissive_srgb, &shown.emissive_srgb),
            shininess: lit && !alike(made.shininess, shown.shininess),
            transparency: !alike(made.transparency, shown.transparency),
            light_model: made.light_model != shown.light_model,
            faces: made.faces != shown.faces,
        }
    }

    fn count(&self) -> usize {
        [
            self.diffuse,
            self.specular,
            self.emissive,
            self.shininess,
            self.transparency,
            self.light_model,
            self.faces,
        ]
        .into_iter()
        .filter(|edited| *edited)
        .count()
    }
}
