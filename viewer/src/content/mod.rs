//! A resolved scene arranged for drawing: objects in a fixed order that keeps equal shaders,
//! textures and meshes together, each with what the planner asks about it.
//!
//! Knows no camera and no GPU. An object is one instance of the scene; hidden or empty instances
//! have none.

mod edits;
mod lights;
mod look;
pub mod positions;
mod surface;

use geometry::bounds::Aabb;
use glam::DAffine3;
use scenegraph::scene::{EnvironmentId, Faces, MaterialId, MeshId, Scene, TextureId, Topology};

pub use edits::{Edits, FaceEdit, LightEdit};
pub use lights::{LightShape, SpotFade, WorldLight, world_lights};
pub use look::{FogUse, Look, Primitive, TextureUse, TextureUseModel};
pub use surface::{Surface, SurfaceFog};

use crate::bounds::SceneBounds;
use crate::texture::Images;

/// One thing to draw.
#[derive(Clone, Debug)]
pub struct Object {
    /// Index into [`Scene::instances`].
    pub instance: u32,
    /// What is drawn.
    pub mesh: MeshId,
    /// Triangles, segments or points of it.
    pub primitives: u32,
    /// Index into [`Content::surfaces`].
    pub surface: u32,
    /// The texture shown, if any.
    pub texture: Option<TextureId>,
    /// What the shader depends on.
    pub look: Look,
    /// The user does not want to see it; nor its shadow.
    pub is_hidden: bool,
    /// Back faces are not drawn.
    pub is_culled: bool,
    /// `world_from_local` turns right into left, and so front into back.
    pub is_mirrored: bool,
    /// From the frame of the mesh's stored positions, its origin included.
    pub world_from_mesh: DAffine3,
    /// Box in the world.
    pub bounds: Aabb,
    /// Index into [`Scene::light_sets`].
    pub light_set: u32,
}

impl Object {
    /// Whether it throws shadows: opaque triangles that are shown do.
    pub fn is_caster(&self) -> bool {
        self.look.primitive == Primitive::Triangles && !self.look.is_transparent && !self.is_hidden
    }
}

/// A scene arranged for drawing.
#[derive(Clone, Debug, Default)]
pub struct Content {
    /// Opaque objects first; equal looks, textures and meshes stand together.
    pub objects: Vec<Object>,
    /// Distinct pairs of material and environment.
    pub surfaces: Vec<Surface>,
    /// What each of them is made of.
    pub surface_ids: Vec<(MaterialId, EnvironmentId)>,
    /// The lights of the scene, in its order.
    pub lights: Vec<WorldLight>,
    /// Which lights reach an object, by [`Object::light_set`]; indices into `lights`, ascending.
    pub light_sets: Vec<Vec<u32>>,
    /// All objects.
    pub bounds: Aabb,
}

impl Content {
    /// Arranges `scene`. `images` says which textures exist and have alpha.
    pub fn new(scene: &Scene, images: &Images) -> Self {
        let boxes = SceneBounds::new(scene).instances;
        let mut surfaces = surface::Surfaces::default();
        let mut content = Self {
            lights: world_lights(scene),
            light_sets: light_sets(scene),
            ..Self::default()
        };
        for (i, (instance, bounds)) in scene.instances.iter().zip(boxes).enumerate() {
            let mesh = &scene.meshes[instance.mesh.index()];
            let material = &scene.materials[instance.material.index()];
            if mesh.indices.is_empty() {
                continue;
            }
            let texture = material
                .texture
                .filter(|id| !mesh.texcoords.is_empty() && images.get(*id).is_some());
            let environment = &scene.environments[instance.environment.index()];
            let look = Look::of(scene, mesh, material, environment, texture, images);
            let local = instance.placement.world_from_local;
            content.objects.push(Object {
                instance: u32::try_from(i).unwrap_or(u32::MAX),
                mesh: instance.mesh,
                primitives: u32::try_from(mesh.primitive_count()).unwrap_or(u32::MAX),
                surface: surfaces.index_of(scene, instance.material, instance.environment),
                texture,
                look,
                is_hidden: false,
                is_culled: material.faces == Faces::FrontOnly
                    && mesh.topology == Topology::Triangles,
                is_mirrored: local.matrix3.determinant() < 0.0,
                world_from_mesh: local * DAffine3::from_translation(positions::place(mesh)),
                bounds,
                light_set: instance.light_set.0,
            });
            content.bounds = content.bounds.union(&bounds);
        }
        (content.surfaces, content.surface_ids) = surfaces.finish();
        content.sort();
        content
    }

    /// Stable, so that equal objects keep the order they have.
    fn sort(&mut self) {
        self.objects.sort_by_key(|object| {
            (
                object.look.is_transparent,
                object.look,
                object.is_culled,
                object.is_mirrored,
                object.texture,
                object.mesh,
                object.instance,
            )
        });
    }

    /// How many objects, from the first on, are opaque.
    pub fn opaque_count(&self) -> usize {
        self.objects
            .partition_point(|object| !object.look.is_transparent)
    }
}

fn light_sets(scene: &Scene) -> Vec<Vec<u32>> {
    let mut sets = Vec::new();
    for set in &scene.light_sets {
        let mut indices: Vec<u32> = set.iter().map(|id| id.0).collect();
        indices.sort_unstable();
        indices.dedup();
        sets.push(indices);
    }
    sets
}
