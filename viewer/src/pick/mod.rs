//! What lies under a pixel: rays into the scene as it is drawn, in f64, without a device.
//!
//! A [`Picker`] keeps a hierarchy of boxes over the objects, and one over each mesh that a ray has
//! come near. An [`Aim`] is a ray with all that the image adds to it: how wide a pixel is, where the
//! view begins, how much nearer lines are drawn. A [`Hit`] says what is there, and [`snap()`] which
//! corner or edge of it was meant.
//!
//! It knows no lights, no textures and no caps of a section: glass is hit like all else, whatever
//! its transparency.

mod aim;
mod crossing;
mod mesh_boxes;
mod picker;
mod search;
mod snap;

pub use aim::{Aim, Ray, pixel_of};
pub use picker::Picker;
pub use snap::{Feature, Snap, snap};

use glam::{DVec3, DVec4};

/// What counts as hit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PickOptions {
    /// How far beside their drawn width lines and points are hit, pixels. They are then preferred
    /// to the surface at the pixel, if they are not hidden where they are.
    pub tolerance_px: f64,
    /// A section: points p of the world with `xyz . p + w < 0` are not drawn.
    pub cut: Option<DVec4>,
}

impl PickOptions {
    /// Whether a point of the world is drawn.
    pub(super) fn shows(&self, p_in_world: DVec3) -> bool {
        // Not `>= 0`: a plane that is no number cuts nothing.
        !self
            .cut
            .is_some_and(|cut| cut.dot(p_in_world.extend(1.0)) < 0.0)
    }
}

/// What is hit, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index into [`crate::content::Content::objects`].
    pub object: u32,
    /// Index into [`scenegraph::scene::Scene::instances`].
    pub instance: u32,
    /// Number of the triangle, segment or point in its mesh.
    pub primitive: u32,
    /// The point hit: on the triangle, on the middle line of a segment, or the point itself.
    pub p_in_world: DVec3,
    /// Of that point along the ray from its origin, world units. In a parallel view it may be
    /// negative, as what is behind the eye is drawn too.
    pub distance: f64,
    /// Of that point along the view direction, world units. That of the ray if it comes from no
    /// view.
    pub depth: f64,
    /// The part of the mesh that is hit.
    pub part: Part,
}

/// A triangle, segment or point in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Part {
    /// A triangle.
    Triangle {
        /// Its corners in the world, in the mesh's order.
        corners: [DVec3; 3],
        /// Weights of the corners at the point hit (barycentric coordinates); not negative, their
        /// sum is 1.
        weights: [f64; 3],
        /// Geometric normal of the front side in the world; unit length.
        normal: DVec3,
    },
    /// A segment of a line.
    Segment {
        /// Its ends in the world.
        ends: [DVec3; 2],
        /// The point hit, from 0 at the first end to 1 at the second.
        along: f64,
    },
    /// A point.
    Point,
}

#[cfg(test)]
mod tests;
