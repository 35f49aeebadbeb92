//! The resolved scene: what every consumer sees, and all it sees.
//!
//! No defaults, no inherited state and no Inventor rule is left in it. Guarantees (checked by
//! [`Scene::check`]):
//!
//! - every index is in range; parents stand before their children in [`Scene::nodes`];
//! - all numbers are finite; `world_from_local` of an item is the product of its own
//!   `parent_from_local` and those of its ancestors;
//! - attribute arrays of a mesh are empty or as long as its positions; normals have unit length;
//! - front faces are counter-clockwise, whatever order the source has;
//! - meshes, materials and textures are shared by index, and none is unused;
//! - texts belong to instances in ascending order;
//! - lights that are off and shapes that are not drawn are not in it;
//! - only where [`ResolveOptions::alternatives`](crate::ResolveOptions::alternatives) asked for them
//!   are there nodes that are not always [`Shown`] and [`Variant`]s; no light hangs below such a
//!   node, a level has a parent, limits of levels are finite and not negative, and variants name
//!   instances in ascending order, none without a material of its own.

mod check;
mod light;
mod link;
mod material;
mod mesh;
mod shown;
mod subset;
mod text;

pub use check::Fault;
pub use light::{
    Beam, Camera, Environment, Fog, FogType, Light, LightKind, Projection, ViewportMapping,
};
pub use link::Link;
pub use material::{
    Faces, Image, LightModel, Material, Texture, TextureModel, TextureSource, Wrap,
};
pub use mesh::{Mesh, Topology};
pub use shown::{Coarser, Shown, Variant, is_below};
pub use text::Text;

use std::sync::Arc;

use glam::DAffine3;
use iv_parser::SourcePos;

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident),* $(,)?) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub u32);

        impl $name {
            /// The index as an array position.
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

ids! {
    /// Index into [`Scene::nodes`].
    NodeId,
    /// Index into [`Scene::meshes`].
    MeshId,
    /// Index into [`Scene::materials`].
    MaterialId,
    /// Index into [`Scene::textures`].
    TextureId,
    /// Index into [`Scene::lights`].
    LightId,
    /// Index into [`Scene::light_sets`].
    LightSetId,
    /// Index into [`Scene::environments`].
    EnvironmentId,
}

/// A whole model, resolved.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// The grouping of the source, parents before children.
    pub nodes: Vec<Node>,
    /// What is drawn, in traversal order.
    pub instances: Vec<Instance>,
    /// Shared geometry.
    pub meshes: Vec<Mesh>,
    /// Shared materials.
    pub materials: Vec<Material>,
    /// Shared textures; images are not decoded, and files are not opened.
    pub textures: Vec<Texture>,
    /// One for each occurrence of a light that is on.
    pub lights: Vec<Light>,
    /// One for each occurrence of a camera.
    pub cameras: Vec<Camera>,
    /// Which lights reach an instance: lists of indices into `lights`, in traversal order.
    pub light_sets: Vec<Vec<LightId>>,
    /// Ambient light, and fog.
    pub environments: Vec<Environment>,
    /// What instances spell, in their order.
    pub texts: Vec<Text>,
    /// Other looks: instances that a variant does not name keep their own material in it.
    pub variants: Vec<Variant>,
    /// The files read, by [`SourcePos::file`].
    pub files: Vec<Arc<str>>,
}

/// A named place in the hierarchy: a group of the source that holds something visible.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// The group around it.
    pub parent: Option<NodeId>,
    /// The DEF name as written, without the `+N` suffix.
    pub name: Option<Arc<str>>,
    /// Inventor class name, such as `Separator`.
    pub class: Arc<str>,
    /// Texts of `Label` and `Info` nodes directly in this group.
    pub notes: Vec<Arc<str>>,
    /// Where it leads, if it is an anchor.
    pub link: Option<Arc<Link>>,
    /// Its frame in that of `parent` (the world for a root).
    pub parent_from_local: DAffine3,
    /// When it is shown.
    pub shown: Shown,
    /// Where it stands in the source.
    pub pos: SourcePos,
}

/// Where an item hangs in the hierarchy.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// The group that holds it; `None` for the world itself.
    pub node: Option<NodeId>,
    /// Its frame in that of `node`.
    pub parent_from_local: DAffine3,
    /// Its frame in the world: all transforms up to the root, multiplied in f64.
    pub world_from_local: DAffine3,
    /// The DEF name of the shape, light or camera node itself.
    pub name: Option<Arc<str>>,
    /// Where it stands in the source.
    pub pos: SourcePos,
}

/// One occurrence of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// Where it is.
    pub placement: Placement,
    /// What is drawn.
    pub mesh: MeshId,
    /// With which material.
    pub material: MaterialId,
    /// Lit by which lights.
    pub light_set: LightSetId,
    /// In which ambient light and fog.
    pub environment: EnvironmentId,
}
