//! glTF's materials as Inventor's.
//!
//! Where the file has Inventor's own values, those (see `settled`). Else the inverse of what the writer does:
//! with alpha = roughness^2, c2 = (1 - sqrt(2) alpha^2) / (1 - alpha^2) gives the exponent
//! -2 / log2(c2) of the cosine power that is as wide as the GGX lobe, and ks = F0 / (4 alpha^2)
//! its height; both are clamped to 0 to 1. F0 is that of the dielectric part and of the metallic
//! part by their shares. What is mirrored is not scattered, so the diffuse colour is the base
//! colour times 1 - F0 of the dielectric; a metal keeps its base colour there, because nothing but
//! lights is mirrored. The ambient colour is a quarter of the diffuse one, as Inventor's defaults
//! are.

use std::f64::consts::SQRT_2;

use gltf::json::Index;
use gltf::json::extensions::texture::TextureTransform;
use gltf::json::material::{AlphaMode, Material as JsonMaterial};
use gltf::json::mesh::Semantic;
use gltf::json::texture::Info;
use gltf::json::validation::Checked;
use iv_parser::SourcePos;
use scenegraph::scene::{Faces, LightModel, Material, MaterialId, Topology};

use super::budget::Budget;
use super::buffers::Buffers;
use super::document::Document;
use super::error::ReadError;
use super::iv::Iv;
use super::made_by::MadeBy;
use super::mesh::{UvTransform, Wants};
use super::settled::{Mixing, Use, settled};
use super::texture::Textures;
use super::topology::topology;
use crate::Materials as Choice;
use crate::color::{srgb_from_linear, unit};

/// Share of Inventor's default ambient colour in its diffuse one: 0.2 of 0.8.
const AMBIENT_SHARE: f64 = 0.25;
/// Reflection head on of what states no index of refraction, 1.5.
const DEFAULT_F0: f64 = 0.04;

/// The materials of a file; those of the scene are made when something shows them.
pub(crate) struct Materials<'a> {
    document: &'a Document<'a>,
    made_by: MadeBy,
    /// What each is on.
    uses: Vec<Use>,
    looks: Vec<Option<Look>>,
    pub(crate) textures: Textures<'a>,
    pub(crate) materials: Vec<Material>,
}

#[derive(Clone, Debug)]
struct Look {
    wants: Wants,
    material: Material,
    /// Number of the glTF texture, and whether it was mixed with the colour already.
    texture: Option<(usize, bool)>,
    id: Option<MaterialId>,
}

impl<'a> Materials<'a> {
    pub(crate) fn new(document: &'a Document<'a>, made_by: MadeBy, textures: Textures<'a>) -> Self {
        Self {
            document,
            made_by,
            uses: uses(document),
            // The last is that of primitives without one.
            looks: vec![None; document.root.materials.len() + 1],
            textures,
            materials: Vec::new(),
        }
    }

    /// What a material wants of the mesh it is on.
    pub(crate) fn wants(&mut self, index: Option<Index<JsonMaterial>>) -> Result<Wants, ReadError> {
        Ok(self.look(index)?.wants)
    }

    /// A material without its texture, and the number of that.
    pub(crate) fn seen(
        &mut self,
        index: Index<JsonMaterial>,
    ) -> Result<(Material, Option<usize>), ReadError> {
        let look = self.look(Some(index))?;
        let texture = look.texture.map(|(number, _)| number);
        Ok((look.material.clone(), texture))
    }

    /// The material of the scene.
    pub(crate) fn material(
        &mut self,
        index: Option<Index<JsonMaterial>>,
        buffers: &Buffers,
        budget: &mut Budget,
    ) -> Result<MaterialId, ReadError> {
        let look = self.look(index)?;
        if let Some(id) = look.id {
            return Ok(id);
        }
        let (mut material, texture) = (look.material.clone(), look.texture);
        material.texture = match texture {
            Some((number, mixed)) => self.textures.texture(number, mixed, buffers, budget)?,
            None => None,
        };
        let id = MaterialId(self.materials.len() as u32);
        self.materials.push(material);
        self.look(index)?.id = Some(id);
        Ok(id)
    }

    fn look(&mut self, index: Option<Index<JsonMaterial>>) -> Result<&mut Look, ReadError> {
        let last = self.looks.len() - 1;
        let number = index.map_or(last, |index| index.value());
        let default = JsonMaterial::default();
        let source = match index {
            None => &default,
            Some(_) => {
                let found = self.document.root.materials.get(number);
                found.ok_or(ReadError::broken("material", number, "it does not exist"))?
            }
        };
        let own = match index {
            Some(_) => self.made_by.values(&source.extras),
            None => None,
        };
        let (textures, on) = (&self.textures, self.uses[number]);
        let look = self.made_by.materials;
        let make = || Look::new(source, own, on, look, textures);
        Ok(self.looks[number].get_or_insert_with(make))
    }
}

impl Look {
    fn new(
        source: &JsonMaterial,
        own: Option<Iv>,
        on: Use,
        look: Choice,
        textures: &Textures,
    ) -> Self {
        let unlit = is_unlit(source);
        let texture = source.pbr_metallic_roughness.base_color_texture.as_ref();
        let number = texture.map(|info| info.index.value());
        let mixed = number.is_some_and(|number| !unlit && textures.is_mixed(number));
        let opaque = matches!(source.alpha_mode, Checked::Valid(AlphaMode::Opaque));
        let shown = from_gltf(source);
        let mixing = match number {
            None => Mixing::None,
            Some(number) if textures.is_modulated(number) => Mixing::Multiply,
            Some(_) => Mixing::Other,
        };
        let (mut material, recolored) = match own {
            Some(iv) => settled(from_inventor(&iv), &shown, on, mixing, look),
            None => (shown, false),
        };
        material.name = source.name.as_deref().map(Into::into);
        if mixed && !recolored {
            // The image holds the colour, which must not come in twice.
            material.diffuse_srgb = [1.0; 3];
        }
        Self {
            wants: Wants {
                lit: !unlit,
                texcoords: texture.map(texcoords),
                base_color_linear: source.pbr_metallic_roughness.base_color_factor.0,
                opaque,
            },
            material,
            texture: number.map(|number| (number, mixed)),
            id: None,
        }
    }
}

/// The set of coordinates, and their transform as the extension orders it: scale, rotation,
/// offset.
fn texcoords(info: &Info) -> (u32, UvTransform) {
    let extensions = info.extensions.as_ref();
    let Some(transform) = extensions.and_then(|e| e.texture_transform.as_ref()) else {
        return (info.tex_coord, UvTransform::IDENTITY);
    };
    let TextureTransform {
        offset,
        rotation,
        scale,
        tex_coord,
        ..
    } = transform;
    let ([x, y], [sx, sy]) = (offset.0, scale.0);
    let (sin, cos) = rotation.0.sin_cos();
    let rows = [[cos * sx, sin * sy, x], [-sin * sx, cos * sy, y]];
    (tex_coord.unwrap_or(info.tex_coord), UvTransform(rows))
}

fn from_inventor(iv: &Iv) -> Material {
    let ordered = iv.word("vertexOrdering") == Some("COUNTERCLOCKWISE");
    let solid = iv.word("shapeType") == Some("SOLID");
    let pattern = iv.index("linePattern").and_then(|p| u16::try_from(p).ok());
    Material {
        name: None,
        ambient_srgb: iv.triple("ambientColor", [0.2; 3]),
        diffuse_srgb: iv.triple("diffuseColor", [0.8; 3]),
        specular_srgb: iv.triple("specularColor", [0.0; 3]),
        emissive_srgb: iv.triple("emissiveColor", [0.0; 3]),
        shininess: iv.number("shininess", 0.2),
        transparency: iv.number("transparency", 0.0),
        light_model: match iv.word("lightModel") {
            Some("BASE_COLOR") => LightModel::BaseColor,
            _ => LightModel::Phong,
        },
        faces: match (ordered, solid) {
            (_, true) => Faces::FrontOnly,
            (true, false) => Faces::BothTwoSidedLighting,
            (false, false) => Faces::BothOneSidedLighting,
        },
        texture: None,
        line_width_px: iv.number("lineWidth", 0.0),
        point_size_px: iv.number("pointSize", 0.0),
        line_pattern: pattern.unwrap_or(0xffff),
        style_pos: SourcePos::default(),
        pos: SourcePos::default(),
    }
}

fn is_unlit(source: &JsonMaterial) -> bool {
    let extensions = source.extensions.as_ref();
    extensions.is_some_and(|e| e.unlit.is_some())
}

/// What each material is on; the last is for those that are on nothing.
fn uses(document: &Document) -> Vec<Use> {
    let mut uses = vec![Use::default(); document.root.materials.len() + 1];
    let meshes = document.root.meshes.iter();
    for primitive in meshes.flat_map(|mesh| &mesh.primitives) {
        let material = primitive.material.map(|index| index.value());
        let Some(on) = material.and_then(|number| uses.get_mut(number)) else {
            continue;
        };
        let has = |semantic| {
            let key = Checked::Valid(semantic);
            primitive.attributes.contains_key(&key)
        };
        let flat =
            matches!(primitive.mode, Checked::Valid(mode) if topology(mode) != Topology::Triangles);
        on.has_colors |= has(Semantic::Colors(0));
        on.is_lit |= !flat || has(Semantic::Normals);
    }
    uses
}

/// Without a name and a texture.
pub(crate) fn from_gltf(source: &JsonMaterial) -> Material {
    let unlit = is_unlit(source);
    let pbr = &source.pbr_metallic_roughness;
    let [r, g, b, alpha] = pbr.base_color_factor.0.map(f64::from);
    let base = [r, g, b].map(unit);
    let metallic = unit(pbr.metallic_factor.0.into());
    let dielectric = dielectric_f0(source);
    let mirrored = dielectric.into_iter().fold(0.0, f64::max) * (1.0 - metallic);
    let diffuse_linear = base.map(|v| if unlit { v } else { v * (1.0 - mirrored) });
    let diffuse_srgb = diffuse_linear.map(srgb_from_linear);
    let f0: [f64; 3] =
        std::array::from_fn(|i| dielectric[i] * (1.0 - metallic) + base[i] * metallic);
    let (shininess, specular_srgb) = phong(pbr.roughness_factor.0.into(), f0);
    let cutoff = source
        .alpha_cutoff
        .map_or(0.5, |cutoff| f64::from(cutoff.0));
    let alpha = match source.alpha_mode {
        Checked::Valid(AlphaMode::Blend) => unit(alpha),
        Checked::Valid(AlphaMode::Mask) if alpha < cutoff => 0.0,
        _ => 1.0,
    };
    Material {
        name: None,
        ambient_srgb: diffuse_srgb.map(|v| v * AMBIENT_SHARE),
        diffuse_srgb,
        specular_srgb,
        emissive_srgb: source.emissive_factor.0.map(|v| srgb_from_linear(v.into())),
        shininess,
        transparency: 1.0 - alpha,
        light_model: if unlit {
            LightModel::BaseColor
        } else {
            LightModel::Phong
        },
        faces: if source.double_sided {
            Faces::BothTwoSidedLighting
        } else {
            Faces::FrontOnly
        },
        texture: None,
        line_width_px: 0.0,
        point_size_px: 0.0,
        line_pattern: 0xffff,
        style_pos: SourcePos::default(),
        pos: SourcePos::default(),
    }
}

/// Reflection head on of what is not metallic (`KHR_materials_ior`, `KHR_materials_specular`). An
/// index of refraction of 0 stands for one that reflects all.
fn dielectric_f0(source: &JsonMaterial) -> [f64; 3] {
    let extensions = source.extensions.as_ref();
    let f0 = match extensions.and_then(|e| e.ior.as_ref()) {
        None => DEFAULT_F0,
        Some(ior) => {
            let ior = f64::from(ior.ior.0);
            unit(((ior - 1.0) / (ior + 1.0)).powi(2))
        }
    };
    match extensions.and_then(|e| e.specular.as_ref()) {
        None => [f0; 3],
        Some(specular) => {
            let factor = unit(specular.specular_factor.0.into());
            let color = specular.specular_color_factor.0.map(f64::from);
            color.map(|c| unit(f0 * c) * factor)
        }
    }
}

/// Shininess and specular colour of a lobe of this roughness and height.
fn phong(roughness: f64, f0: [f64; 3]) -> (f64, [f64; 3]) {
    let alpha_squared = unit(roughness).powi(4);
    let c2 = (1.0 - SQRT_2 * alpha_squared) / (1.0 - alpha_squared);
    // A lobe wider than any cosine power has no c2 above 0.
    let exponent = if c2 > 0.0 { -2.0 / c2.log2() } else { 0.0 };
    let height = |f0: f64| {
        if f0 > 0.0 {
            unit(f0 / (4.0 * alpha_squared))
        } else {
            0.0
        }
    };
    (unit(exponent / 128.0), f0.map(height))
}
