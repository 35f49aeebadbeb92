//! The colour of one surface point.

use glam::{DVec2, DVec3, DVec4};
use scenegraph::scene::{Faces, Fog, FogType, TextureModel};

use super::light::WorldLight;
use super::object::Object;
use super::solid::{Hit, Triangle};

/// A point to shade.
pub struct Point<'a> {
    /// What it is on.
    pub object: &'a Object<'a>,
    /// Its triangle.
    pub triangle: &'a Triangle,
    /// Where on it.
    pub hit: Hit,
    /// In the world.
    pub p_in_world: DVec3,
    /// Unit vector to the viewer.
    pub to_viewer: DVec3,
    /// Along the view direction.
    pub view_depth: f64,
}

impl Point<'_> {
    /// Colour and alpha in the light of `lights`, before fog; not clamped.
    pub fn shaded<'l>(&self, lights: impl Iterator<Item = &'l WorldLight>) -> DVec4 {
        let base = self.base();
        let color = if self.object.is_lit {
            self.lit(base.truncate(), lights)
        } else {
            base.truncate()
        };
        self.textured(color.extend(base.w))
    }

    /// Diffuse colour and alpha.
    fn base(&self) -> DVec4 {
        let material = self.object.material;
        let colors = &self.object.mesh.colors_srgb;
        if colors.is_empty() {
            DVec3::from(material.diffuse_srgb).extend(1.0 - material.transparency)
        } else {
            self.interpolated(|i| DVec4::from(colors[i].map(f64::from)))
        }
    }

    fn lit<'l>(&self, diffuse: DVec3, lights: impl Iterator<Item = &'l WorldLight>) -> DVec3 {
        let (material, environment) = (self.object.material, self.object.environment);
        let specular = DVec3::from(material.specular_srgb);
        let normal = self.normal();
        let ambient = DVec3::from(material.ambient_srgb)
            * DVec3::from(environment.ambient_color_srgb)
            * environment.ambient_intensity;
        let mut sum = DVec3::from(material.emissive_srgb) + ambient;
        for light in lights {
            let (to_light, arriving) = light.at(self.p_in_world);
            let cosine = normal.dot(to_light);
            if cosine > 0.0 {
                let mirrored = 2.0 * cosine * normal - to_light;
                let highlight = mirrored.dot(self.to_viewer).max(0.0);
                let shine = highlight.powf(128.0 * material.shininess);
                sum += arriving * (diffuse * cosine + specular * shine);
            }
        }
        sum
    }

    /// The unit normal that light is reckoned with.
    fn normal(&self) -> DVec3 {
        let normals = &self.object.mesh.normals;
        let local = self.interpolated(|i| DVec3::from(normals[i].map(f64::from)).extend(0.0));
        let normal = (self.object.normals * local.truncate()).normalize_or_zero();
        let two_sided = self.object.material.faces == Faces::BothTwoSidedLighting;
        if two_sided && !self.hit.is_front {
            -normal
        } else {
            normal
        }
    }

    fn textured(&self, under: DVec4) -> DVec4 {
        let Some((texture, pixels)) = self.object.texture else {
            return under;
        };
        let texcoords = &self.object.mesh.texcoords;
        let st = self.interpolated(|i| {
            let [s, t] = texcoords[i].map(f64::from);
            DVec2::new(s, t).extend(0.0).extend(0.0)
        });
        let texel = pixels.sample([st.x, st.y], [texture.wrap_s, texture.wrap_t]);
        let (color, over) = (under.truncate(), texel.truncate());
        match texture.model {
            TextureModel::Modulate => under * texel,
            TextureModel::Decal => color.lerp(over, texel.w).extend(under.w),
            TextureModel::Blend => {
                let blend = DVec3::from(texture.blend_color_srgb);
                (color * (1.0 - over) + blend * over).extend(under.w * texel.w)
            }
            TextureModel::Replace if pixels.has_alpha => texel,
            TextureModel::Replace => over.extend(under.w),
        }
    }

    /// A vertex attribute at the point.
    fn interpolated(&self, of: impl Fn(usize) -> DVec4) -> DVec4 {
        let first = 3 * self.triangle.number as usize;
        let indices = &self.object.mesh.indices[first..first + 3];
        let pairs = indices.iter().zip(self.hit.at.weights);
        pairs.map(|(&i, weight)| of(i as usize) * weight).sum()
    }
}

/// `color` behind fog; `far` stands for a visibility of 0.
pub fn fogged(color: DVec3, fog: &Fog, view_depth: f64, far: f64) -> DVec3 {
    let visibility = if fog.visibility > 0.0 {
        fog.visibility
    } else {
        far
    };
    if visibility <= 0.0 {
        return color;
    }
    let share = view_depth / visibility;
    let left = match fog.fog_type {
        FogType::Haze => (1.0 - share).clamp(0.0, 1.0),
        FogType::Fog => (-256_f64.ln() * share).exp(),
        FogType::Smoke => (-256_f64.ln() * share * share).exp(),
    };
    DVec3::from(fog.color_srgb).lerp(color, left)
}
