//! Pure numerics shared by the scene graph, the converter and the viewer.
//!
//! Conventions, valid for every function of this crate:
//!
//! - Space is right-handed. A face is seen from the front when its corners run
//!   counter-clockwise; its normal follows the right-hand rule.
//! - Matrices act on column vectors (`p_out = M * p_in`); `world_from_local` maps local
//!   points to world points.
//! - Lengths have no unit. Angles are in radians and say so in their names.
//! - Coordinates and transforms are `f64`; `f32` appears only where a result is stored.
//! - Functions are total: NaN, infinities, empty and contradictory input give a documented
//!   value, never a panic, and the cost of every call is bounded.
//! - Results depend on the input alone: no hash order, no randomness, no threads.
//!
//! | module | what it answers |
//! | --- | --- |
//! | [`bounds`] | the axis-aligned box around points |
//! | [`transform`] | a matrix as translation, rotation and scale; normal matrices; mirroring |
//! | [`triangulate`] | a polygon as triangles |
//! | [`normal`] | face normals and crease-angle vertex normals |
//! | [`outline`] | closed curves of the plane as areas: letters |
//! | [`weld`] | which vertices are bitwise equal |
//! | [`local_origin`] | the point that `f32` positions should be stored relative to |
//! | [`generalized_cylinder`] | a cross section swept along a spine |
//! | [`nurbs`] | rational B-spline curves and surfaces as segments and triangles |
//! | [`num`] | rounding bounds |
//!
//! Nothing here knows of nodes, files or materials.

pub mod bounds;
pub mod generalized_cylinder;
pub mod local_origin;
mod newell;
pub mod normal;
pub mod num;
pub mod nurbs;
pub mod outline;
#[cfg(test)]
mod test_rng;
pub mod transform;
pub mod triangulate;
pub mod weld;
