//! The numbers a shader needs of a material in its environment.

use rustc_hash::FxHashMap;
use scenegraph::scene::{EnvironmentId, MaterialId, Scene};

/// Fog as numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceFog {
    /// Its colour.
    pub color_srgb: [f64; 3],
    /// Distance at which it hides all; 0 means the far end of the scene.
    pub visibility: f64,
}

/// A material in an environment.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Emitted, and reflected of the ambient light.
    pub constant_srgb: [f64; 3],
    /// Diffuse colour; vertex colours stand in its place.
    pub diffuse_srgb: [f64; 3],
    /// Specular colour.
    pub specular_srgb: [f64; 3],
    /// Specular exponent: 128 times Inventor's shininess.
    pub exponent: f64,
    /// 1 - transparency.
    pub alpha: f64,
    /// Colour of a BLEND texture.
    pub blend_srgb: [f64; 3],
    /// Line width or point size, in pixels; at least 1.
    pub line_width_px: f64,
    /// Size of points, in pixels; at least 1.
    pub point_size_px: f64,
    /// `DrawStyle.linePattern`.
    pub line_pattern: u16,
    /// Fog, if any.
    pub fog: Option<SurfaceFog>,
}

/// Collects distinct pairs.
#[derive(Default)]
pub struct Surfaces {
    index: FxHashMap<(MaterialId, EnvironmentId), u32>,
    list: Vec<Surface>,
    ids: Vec<(MaterialId, EnvironmentId)>,
}

impl Surfaces {
    /// The index of the pair's surface.
    pub fn index_of(
        &mut self,
        scene: &Scene,
        material: MaterialId,
        environment: EnvironmentId,
    ) -> u32 {
        *self
            .index
            .entry((material, environment))
            .or_insert_with(|| {
                let index = u32::try_from(self.list.len()).unwrap_or(u32::MAX);
                self.list.push(surface(scene, material, environment, 1.0));
                self.ids.push((material, environment));
                index
            })
    }

    /// The surfaces in the order of first use, and what each is made of.
    pub fn finish(self) -> (Vec<Surface>, Vec<(MaterialId, EnvironmentId)>) {
        (self.list, self.ids)
    }
}

/// The numbers of a pair, with so many times the ambient light.
pub fn surface(
    scene: &Scene,
    material: MaterialId,
    environment: EnvironmentId,
    ambient_factor: f64,
) -> Surface {
    let material = &scene.materials[material.index()];
    let environment = &scene.environments[environment.index()];
    let ambient = |i: usize| {
        material.emissive_srgb[i]
            + material.ambient_srgb[i]
                * environment.ambient_intensity
                * ambient_factor
                * environment.ambient_color_srgb[i]
    };
    Surface {
        constant_srgb: [ambient(0), ambient(1), ambient(2)],
        diffuse_srgb: material.diffuse_srgb,
        specular_srgb: material.specular_srgb,
        exponent: 128.0 * material.shininess,
        alpha: 1.0 - material.transparency,
        blend_srgb: material
            .texture
            .map_or([0.0; 3], |id| scene.textures[id.index()].blend_color_srgb),
        line_width_px: material.line_width_px.max(1.0),
        point_size_px: material.point_size_px.max(1.0),
        line_pattern: material.line_pattern,
        fog: environment.fog.map(|fog| SurfaceFog {
            color_srgb: fog.color_srgb,
            visibility: fog.visibility,
        }),
    }
}
