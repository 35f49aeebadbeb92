//! Materials, vertex colours and texture coordinates against what glTF's specification makes of
//! them: factors are linear light, and what is mirrored is not scattered.

use scenegraph::scene::{Faces, LightModel, Material, Mesh, Texture, TextureModel, Topology};
use serde_json::Value;

use super::read::{Arrays, numbers};

/// Factors are written as f32, and a comparison takes the product of up to three of them.
const FACTOR_ULPS: f64 = 2.0 * f32::EPSILON as f64;
/// Half a step of a normalized unsigned short, and its way through f32.
const COLOR_STEP: f64 = 0.5 / 65535.0 + f32::EPSILON as f64;

/// What is different, in words.
pub fn difference(
    json: &Value,
    material: &Material,
    texture: Option<&Texture>,
    mesh: &Mesh,
    arrays: &Arrays,
) -> Option<String> {
    let look = Look::of(json, texture, mesh);
    let rows = [
        ("name", json["name"].as_str() == material.name.as_deref()),
        ("light", look.light_is_right(material, mesh)),
        ("base colour", look.base_is_right(material)),
        ("opacity", look.opacity_is_right(material, mesh)),
        ("emission", look.emission_is_right(material)),
        ("sides", look.sides_are_right(material)),
        ("attributes", look.attributes_are_right(mesh, arrays)),
    ];
    let wrong = rows.iter().find(|(_, right)| !right);
    wrong.map(|(what, _)| format!("{what}: {json} for {material:?}"))
}

/// A glTF material on a mesh of the scene.
struct Look<'j> {
    json: &'j Value,
    unlit: bool,
    /// The texture's model, where the texture shows.
    model: Option<TextureModel>,
    colored: bool,
}

impl<'j> Look<'j> {
    fn of(json: &'j Value, texture: Option<&Texture>, mesh: &Mesh) -> Self {
        let shown = !json["pbrMetallicRoughness"]["baseColorTexture"].is_null();
        Self {
            json,
            unlit: !json["extensions"]["KHR_materials_unlit"].is_null(),
            model: texture.filter(|_| shown).map(|texture| texture.model),
            colored: !mesh.colors_srgb.is_empty(),
        }
    }

    /// The texture alone is what one sees. An opaque decal is such a texture too.
    fn is_replaced(&self) -> bool {
        match self.model {
            Some(TextureModel::Replace) => true,
            Some(TextureModel::Decal) => self.unlit,
            _ => false,
        }
    }

    fn light_is_right(&self, material: &Material, mesh: &Mesh) -> bool {
        let can_be_lit = mesh.topology == Topology::Triangles || !mesh.normals.is_empty();
        let lit = material.light_model == LightModel::Phong && can_be_lit;
        self.unlit == (!lit || self.is_replaced())
    }

    /// Head on, in linear light.
    fn mirrored(&self) -> f64 {
        let specular = &self.json["extensions"]["KHR_materials_specular"];
        if self.unlit || specular.is_null() {
            return 0.0;
        }
        let factor = specular["specularFactor"].as_f64().unwrap_or(1.0);
        let color = numbers(&specular["specularColorFactor"]);
        let largest = color.into_iter().reduce(f64::max).unwrap_or(1.0);
        factor * largest
    }

    fn base(&self) -> [f64; 4] {
        let list = numbers(&self.json["pbrMetallicRoughness"]["baseColorFactor"]);
        list.try_into().unwrap_or([1.0; 4])
    }

    /// Scattered light is Inventor's diffuse colour, unless that is more than can be left.
    fn base_is_right(&self, material: &Material) -> bool {
        let from_elsewhere =
            self.colored || self.model.is_some_and(|m| m != TextureModel::Modulate);
        let left = 1.0 - self.mirrored();
        let [r, g, b, _] = self.base();
        let right = |(base, srgb): (f64, f64)| {
            let want = linear(srgb);
            let scattered = base * left;
            (scattered - want).abs() <= FACTOR_ULPS || (base == 1.0 && want > scattered)
        };
        if from_elsewhere {
            [r, g, b] == [1.0; 3]
        } else {
            [r, g, b].into_iter().zip(material.diffuse_srgb).all(right)
        }
    }

    fn opacity_is_right(&self, material: &Material, mesh: &Mesh) -> bool {
        let [.., opacity] = self.base();
        let want = 1.0 - material.transparency;
        let as_material = (opacity - want).abs() <= FACTOR_ULPS;
        // A replacing texture may have alpha of its own.
        let right = if self.is_replaced() {
            as_material || opacity == 1.0
        } else if self.colored {
            opacity == 1.0
        } else {
            as_material
        };
        let half_step = 0.5 / 65535.0;
        let some = |c: &[f32; 4]| 1.0 - f64::from(c[3]) > half_step;
        let translucent =
            opacity < 1.0 || (!self.is_replaced() && mesh.colors_srgb.iter().any(some));
        let mode = self.json["alphaMode"].as_str().unwrap_or("OPAQUE");
        let mode_is_right = match (translucent, self.model) {
            (true, _) => mode == "BLEND",
            (false, None) => mode == "OPAQUE",
            (false, Some(_)) => true,
        };
        right && mode_is_right
    }

    fn emission_is_right(&self, material: &Material) -> bool {
        let list = numbers(&self.json["emissiveFactor"]);
        let got: [f64; 3] = list.try_into().unwrap_or([0.0; 3]);
        let want = if self.unlit {
            [0.0; 3]
        } else {
            material.emissive_srgb.map(linear)
        };
        let near = |(got, want): (f64, f64)| (got - want).abs() <= FACTOR_ULPS;
        got.into_iter().zip(want).all(near)
    }

    fn sides_are_right(&self, material: &Material) -> bool {
        let double_sided = self.json["doubleSided"].as_bool().unwrap_or(false);
        double_sided == (material.faces != Faces::FrontOnly)
    }

    /// What the material reads is there, and nothing else.
    fn attributes_are_right(&self, mesh: &Mesh, arrays: &Arrays) -> bool {
        let reads_colors = self.colored && !self.is_replaced();
        arrays.normals.is_empty() == (self.unlit || mesh.normals.is_empty())
            && arrays.texcoords.is_empty() == self.model.is_none()
            && arrays.colors_linear.is_empty() != reads_colors
    }
}

/// T goes up in Inventor and down in glTF.
pub fn texcoord_differs(mesh: &Mesh, arrays: &Arrays, want: u32, got: u32) -> Option<String> {
    let got = arrays.texcoords.get(got as usize)?;
    let [s, t] = mesh.texcoords[want as usize];
    let down = 1.0 - f64::from(t);
    // One subtraction in f32.
    let bound = down.abs() * f64::from(f32::EPSILON);
    let agrees = got[0] == s && (f64::from(got[1]) - down).abs() <= bound;
    (!agrees).then(|| format!("texture coordinates {got:?} for {:?}", [s, t]))
}

/// Linear light in sixteen bits.
pub fn color_differs(mesh: &Mesh, arrays: &Arrays, want: u32, got: u32) -> Option<String> {
    let got = arrays.colors_linear.get(got as usize)?.map(f64::from);
    let [r, g, b, alpha] = mesh.colors_srgb[want as usize].map(f64::from);
    let want = [linear(r), linear(g), linear(b), alpha];
    let near = |(got, want): (f64, f64)| (got - want).abs() <= COLOR_STEP;
    let agrees = got.into_iter().zip(want).all(near);
    (!agrees).then(|| format!("colour {got:?} for {want:?}"))
}

/// Linear light of a display value, by the inverse of the standard's encoding: the value that
/// encodes to it, found by halving.
pub fn linear(srgb: f64) -> f64 {
    let encoded = |v: f64| {
        if v <= 0.003_130_8 {
            12.92 * v
        } else {
            1.055 * v.powf(1.0 / 2.4) - 0.055
        }
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if encoded(middle) < srgb {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}
