//! One instance with all it needs to be shaded.

use std::collections::BTreeMap;

use glam::{DAffine3, DMat3, DVec3};
use scenegraph::scene::{
    Environment, Faces, Instance, LightId, LightModel, Material, Mesh, Scene, Texture, TextureId,
    TextureModel, Topology,
};

use super::bvh::Bounds;
use super::solid::Triangle;
use super::texture::RefTexture;

/// An instance of triangles.
pub struct Object<'a> {
    /// Its geometry.
    pub mesh: &'a Mesh,
    /// Its look.
    pub material: &'a Material,
    /// Ambient light and fog around it.
    pub environment: &'a Environment,
    /// The lights that reach it.
    pub lights: &'a [LightId],
    /// What is on it, if it has texture coordinates and the pixels are known.
    pub texture: Option<(&'a Texture, &'a RefTexture)>,
    /// Turns normals into the world; not their length.
    pub normals: DMat3,
    /// Box around its vertices in the world.
    pub bounds: Bounds,
    /// Blended over what is behind it.
    pub is_transparent: bool,
    /// Lit by lights.
    pub is_lit: bool,
}

impl<'a> Object<'a> {
    /// `instance` of `scene`.
    pub fn new(
        scene: &'a Scene,
        instance: &'a Instance,
        textures: &'a BTreeMap<TextureId, RefTexture>,
    ) -> Self {
        let mesh = &scene.meshes[instance.mesh.index()];
        let material = &scene.materials[instance.material.index()];
        let texture = material
            .texture
            .filter(|_| !mesh.texcoords.is_empty())
            .and_then(|id| Some((&scene.textures[id.index()], textures.get(&id)?)));
        let world = &instance.placement.world_from_local;
        let mut bounds = Bounds::EMPTY;
        for i in 0..mesh.positions.len() as u32 {
            bounds.add(world.transform_point3(mesh.p_in_local(i)));
        }
        Self {
            mesh,
            material,
            environment: &scene.environments[instance.environment.index()],
            lights: &scene.light_sets[instance.light_set.index()],
            texture,
            normals: normals_in_world(world),
            bounds,
            is_transparent: is_transparent(mesh, material, texture),
            is_lit: material.light_model == LightModel::Phong && !mesh.normals.is_empty(),
        }
    }

    /// Its triangles in the world, without those that have no area.
    pub fn triangles(&self, instance: &Instance, index: u32) -> impl Iterator<Item = Triangle> {
        let world = instance.placement.world_from_local;
        let front_only = self.material.faces == Faces::FrontOnly;
        let mirrored = world.matrix3.determinant() < 0.0;
        let indices = match self.mesh.topology {
            Topology::Triangles => self.mesh.indices.as_slice(),
            Topology::Lines | Topology::Points => &[],
        };
        let corners = move |of: &[u32]| {
            let place = |i: usize| world.transform_point3(self.mesh.p_in_local(of[i]));
            [place(0), place(1), place(2)]
        };
        (0..)
            .zip(indices.chunks_exact(3))
            .map(move |(number, of)| Triangle {
                corners: corners(of),
                instance: index,
                number,
                front_only,
                mirrored,
            })
            .filter(|triangle| {
                let normal = triangle.normal();
                normal.is_finite() && normal != DVec3::ZERO
            })
    }
}

/// The inverse transpose but for its length: the matrix of cofactors, with the sign of the
/// determinant. It is there for a singular matrix too.
fn normals_in_world(world: &DAffine3) -> DMat3 {
    let m = world.matrix3;
    let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
    let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    if m.determinant() < 0.0 {
        -cofactors
    } else {
        cofactors
    }
}

fn is_transparent(
    mesh: &Mesh,
    material: &Material,
    texture: Option<(&Texture, &RefTexture)>,
) -> bool {
    let by_color = if mesh.colors_srgb.is_empty() {
        material.transparency > 0.0
    } else {
        mesh.colors_srgb.iter().any(|color| color[3] < 1.0)
    };
    let by_texture = texture.is_some_and(|(texture, pixels)| {
        texture.model != TextureModel::Decal && pixels.is_transparent()
    });
    by_color || by_texture
}
