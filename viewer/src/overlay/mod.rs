//! What is drawn over a picture to explain it: edges, normals, silhouettes, a grid, the area where
//! a section plane cuts. Plain data, made on the CPU from a scene; nothing here draws.

mod cut;
mod guides;
mod lines;

use std::sync::Arc;

use geometry::bounds::Aabb;
use glam::DVec3;
use rustc_hash::FxHashMap;
use scenegraph::scene::{MeshId, Scene, Topology};

use crate::content::positions::positions;
use crate::content::{Content, Object};
use crate::volume::topology::CasterMesh;

pub use cut::caps;
pub use guides::{axes, grid, marks};
pub use lines::{edges, normals, silhouettes};

/// Segments and corners of one kind at most: 128 MiB on the device. What is more is left out.
pub const MOST: usize = 1 << 22;

/// A segment, two pixels wide.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Segment {
    /// One end, in the frame of the object.
    pub a: [f32; 3],
    /// Index into [`Content::objects`], or their number for the anchor.
    pub object: u32,
    /// The other end.
    pub b: [f32; 3],
    /// Red, green, blue, alpha, display-referred.
    pub rgba: [u8; 4],
}

/// A corner of a triangle; three in a row are one.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Corner {
    /// In the frame of the object.
    pub p: [f32; 3],
    /// As in [`Segment`].
    pub object: u32,
    /// Red, green, blue, alpha, display-referred.
    pub rgba: [u8; 4],
}

/// A list that is compared by identity: lists are long, and made anew when they change.
#[derive(Debug)]
pub struct Shared<T>(pub Arc<[T]>);

impl<T> Default for Shared<T> {
    fn default() -> Self {
        Self(Arc::new([]))
    }
}

impl<T> Clone for Shared<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<T> From<Vec<T>> for Shared<T> {
    fn from(list: Vec<T>) -> Self {
        Self(list.into())
    }
}

impl<T> PartialEq for Shared<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0.is_empty() && other.0.is_empty()
    }
}

/// All that is drawn over a picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overlay {
    /// Tinted: positions in `Scene::instances`, ascending.
    pub selected: Vec<u32>,
    /// The edges of all triangles.
    pub has_wireframe: bool,
    /// The corners of all triangles.
    pub has_corners: bool,
    /// The sides of the shadow volumes that were counted.
    pub has_volumes: bool,
    /// Segments.
    pub segments: Shared<Segment>,
    /// Triangles where a section plane cuts solids: three corners each.
    pub caps: Shared<Corner>,
}

impl Overlay {
    /// Whether nothing is drawn.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// Where the frame of the anchor is: for what belongs to no object.
pub fn anchor(content: &Content) -> DVec3 {
    if content.bounds.is_empty() {
        DVec3::ZERO
    } else {
        content.bounds.center()
    }
}

/// A point of the world in the frame of the anchor.
fn from_anchor(anchor: DVec3, p_in_world: DVec3) -> [f32; 3] {
    (p_in_world - anchor).as_vec3().to_array()
}

/// The topology of meshes, found when first asked for.
#[derive(Default)]
pub struct Meshes(FxHashMap<MeshId, CasterMesh>);

impl Meshes {
    /// The mesh of an object, in the frame of its stored positions; `None` for lines and points.
    pub fn of(&mut self, scene: &Scene, object: &Object) -> Option<&CasterMesh> {
        let mesh = &scene.meshes[object.mesh.index()];
        (mesh.topology == Topology::Triangles).then(|| {
            let made = || CasterMesh::new(&positions(mesh), &mesh.indices);
            &*self.0.entry(object.mesh).or_insert_with(made)
        })
    }
}

/// The objects that are shown, with their indices.
fn shown(content: &Content) -> impl Iterator<Item = (u32, &Object)> {
    (0..)
        .zip(&content.objects)
        .filter(|(_, object)| !object.is_hidden)
}

/// The first three of four coordinates.
fn xyz(p: &[f32; 4]) -> [f32; 3] {
    [p[0], p[1], p[2]]
}

fn as_f64(p: &[f32; 4]) -> DVec3 {
    DVec3::new(p[0].into(), p[1].into(), p[2].into())
}

/// The diagonal of a box; 0 for an empty one.
fn diagonal(bounds: &Aabb) -> f64 {
    if bounds.is_empty() {
        0.0
    } else {
        bounds.size().length()
    }
}
