//! Inventor's Phong material as glTF metallic-roughness, so that both look alike.
//!
//! OpenGL's exponent is n = 128 * shininess. GGX with alpha = roughness^2 falls to half its
//! height at the angle where cos^n does when, with c2 = 2^(-2/n),
//! alpha^2 = (1 - c2) / (sqrt(2) - c2). Head on, under the light that makes Inventor's highlight
//! ks, GGX gives F0 / (4 alpha^2); so F0 = min(1, 4 alpha^2 ks) gives the same height.
//! `KHR_materials_ior` with `ior` 0 frees F0 from the index of refraction, and `specularFactor`
//! bounds the reflection at grazing angles too, which Phong does not have. What is mirrored is not
//! scattered, so the base colour is divided by 1 - F0.

use std::f64::consts::SQRT_2;

use scenegraph::scene::{Faces, LightModel, Material, MaterialId};

use crate::color::{linear_rgb_from_srgb, unit};
use crate::extras;
use crate::image::Alpha;
use crate::json::Json;
use crate::options::Materials;
use crate::texture::{Role, Shown};

/// Whether a mesh has colours of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum VertexColors {
    None,
    Opaque,
    /// Some alpha is below 1.
    Translucent,
}

/// What a material's look depends on besides the material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Surroundings {
    pub(crate) colors: VertexColors,
    /// Only then a texture shows.
    pub(crate) texcoords: bool,
    /// Lines and points without normals are not lit.
    pub(crate) can_be_lit: bool,
}

/// `alphaMode`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum AlphaMode {
    Opaque,
    Mask,
    Blend,
}

/// `KHR_materials_specular`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Specular {
    pub(crate) factor: f64,
    pub(crate) color_linear: [f64; 3],
}

/// A glTF material.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GltfMaterial {
    pub(crate) source: MaterialId,
    pub(crate) base_color_linear: [f64; 4],
    pub(crate) texture: Option<u32>,
    pub(crate) emissive_linear: [f64; 3],
    pub(crate) roughness: f64,
    /// `None` when nothing is mirrored.
    pub(crate) specular: Option<Specular>,
    /// Without extensions for what it mirrors.
    pub(crate) is_simple: bool,
    pub(crate) unlit: bool,
    pub(crate) alpha_mode: AlphaMode,
    pub(crate) double_sided: bool,
    /// Whether it reads `COLOR_0`.
    pub(crate) reads_colors: bool,
}

impl GltfMaterial {
    pub(crate) fn new(
        source: MaterialId,
        material: &Material,
        surroundings: Surroundings,
        texture: Option<Shown>,
        look: Materials,
    ) -> Self {
        let role = texture.map(|t| t.role);
        let replaced = role == Some(Role::Replace);
        let unlit = replaced
            || material.light_model == LightModel::BaseColor
            || !surroundings.can_be_lit
            || look == Materials::Unlit;
        let reads_colors = !replaced && surroundings.colors != VertexColors::None;
        let texture_alpha = texture.map_or(Alpha::Opaque, |t| t.alpha);

        let (roughness, f0) = lobe(material);
        let f0 = if look == Materials::Simple {
            [0.0; 3]
        } else {
            f0
        };
        let f0_max = f0.into_iter().fold(0.0, f64::max);
        let [r, g, b] = if reads_colors || matches!(role, Some(Role::Replace | Role::Diffuse)) {
            [1.0; 3]
        } else {
            linear_rgb_from_srgb(color_srgb(material, look))
        };
        let scattered = |v: f64| {
            if unlit || v == 0.0 {
                v
            } else {
                (v / (1.0 - f0_max)).min(1.0)
            }
        };
        // A replacing texture's own alpha stands in place of the material's.
        let own_alpha = reads_colors || (replaced && texture_alpha != Alpha::Opaque);
        let opacity = if own_alpha {
            1.0
        } else {
            1.0 - unit(material.transparency)
        };

        let translucent =
            opacity < 1.0 || (reads_colors && surroundings.colors == VertexColors::Translucent);
        Self {
            source,
            base_color_linear: [scattered(r), scattered(g), scattered(b), opacity],
            texture: texture.map(|t| t.index),
            emissive_linear: if unlit {
                [0.0; 3]
            } else {
                linear_rgb_from_srgb(material.emissive_srgb)
            },
            roughness,
            specular: (f0_max > 0.0).then(|| Specular {
                factor: f0_max,
                color_linear: f0.map(|v| v / f0_max),
            }),
            is_simple: look == Materials::Simple,
            unlit,
            alpha_mode: match texture_alpha {
                _ if translucent => AlphaMode::Blend,
                Alpha::Blend => AlphaMode::Blend,
                Alpha::Mask => AlphaMode::Mask,
                Alpha::Opaque => AlphaMode::Opaque,
            },
            double_sided: material.faces != Faces::FrontOnly,
            reads_colors,
        }
    }

    pub(crate) fn write(&self, json: &mut Json, material: &Material, with_extras: bool) {
        json.object(|json| {
            if let Some(name) = &material.name {
                json.key("name").str(name);
            }
            self.write_base(json);
            if self.emissive_linear != [0.0; 3] {
                json.key("emissiveFactor")
                    .f32s(&self.emissive_linear.map(|v| v as f32));
            }
            match self.alpha_mode {
                AlphaMode::Opaque => {}
                AlphaMode::Mask => json.key("alphaMode").str("MASK"),
                AlphaMode::Blend => json.key("alphaMode").str("BLEND"),
            }
            if self.double_sided {
                json.key("doubleSided").bool(true);
            }
            json.object_unless_empty("extensions", |json| self.write_extensions(json));
            if with_extras {
                extras::material(json, material);
            }
        });
    }

    fn write_base(&self, json: &mut Json) {
        json.key("pbrMetallicRoughness").object(|json| {
            if self.base_color_linear != [1.0; 4] {
                json.key("baseColorFactor")
                    .f32s(&self.base_color_linear.map(|v| v as f32));
            }
            if let Some(texture) = self.texture {
                json.key("baseColorTexture")
                    .object(|json| json.key("index").u64(texture.into()));
            }
            json.key("metallicFactor").u64(0);
            if !self.unlit {
                json.key("roughnessFactor").f32(self.roughness as f32);
            }
        });
    }

    fn write_extensions(&self, json: &mut Json) {
        if self.unlit {
            json.key("KHR_materials_unlit").object(|_| {});
            return;
        }
        if self.is_simple {
            return;
        }
        if self.specular.is_some() {
            json.key("KHR_materials_ior")
                .object(|json| json.key("ior").u64(0));
        }
        json.key("KHR_materials_specular")
            .object(|json| match self.specular {
                None => json.key("specularFactor").u64(0),
                Some(Specular {
                    factor,
                    color_linear,
                }) => {
                    if factor != 1.0 {
                        json.key("specularFactor").f32(factor as f32);
                    }
                    if color_linear != [1.0; 3] {
                        json.key("specularColorFactor")
                            .f32s(&color_linear.map(|v| v as f32));
                    }
                }
            });
    }
}

/// The colour under white light, display-referred. Without light that emitted is in it.
fn color_srgb(material: &Material, look: Materials) -> [f64; 3] {
    match look {
        Materials::Unlit if material.light_model == LightModel::Phong => {
            let (diffuse, emissive) = (material.diffuse_srgb, material.emissive_srgb);
            std::array::from_fn(|i| unit(diffuse[i]) + unit(emissive[i]))
        }
        _ => material.diffuse_srgb,
    }
}

/// Roughness, and the reflection head on.
fn lobe(material: &Material) -> (f64, [f64; 3]) {
    let exponent = 128.0 * unit(material.shininess);
    // An exponent of 0 gives 2^-inf = 0.
    let c2 = (-2.0 / exponent).exp2();
    let alpha_squared = (1.0 - c2) / (SQRT_2 - c2);
    let f0 = material
        .specular_srgb
        .map(|ks| (4.0 * alpha_squared * unit(ks)).min(1.0));
    (alpha_squared.sqrt().sqrt(), f0)
}
