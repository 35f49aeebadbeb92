//! Rational B-spline (NURBS) curves and surfaces: evaluated, and cut into segments and triangles
//! that stay within a chord tolerance. Trim loops cut pieces out of a surface's domain.
//!
//! Conventions are those of OpenGL's GLU: the order is the degree plus one; there are as many knots
//! as control points plus the order; the domain runs from the knot number `order - 1` to the knot
//! number `count - order`; control points are homogeneous, (x w, y w, z w, w); those of a surface
//! stand with `u` fastest; the front is where `dS/du x dS/dv` points.
//!
//! | file | what it does |
//! | --- | --- |
//! | `knots.rs` | knot vectors, their spans, basis functions |
//! | `bezier.rs` | one polynomial piece: its control points and bounds of its derivatives |
//! | `curve.rs`, `surface.rs` | checked data, and evaluation |
//! | `divide.rs` | how often each span is divided |
//! | `outline.rs` | trim loops as polygons, and what lies inside |
//! | `cells.rs` | trim polygons cut along the grid; triangles of a cell |
//! | `mesh.rs` | the triangles of a surface |

mod bezier;
mod cells;
mod curve;
mod divide;
mod knots;
mod mesh;
mod outline;
mod surface;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod trim_tests;

pub use curve::{Curve, Polyline};
pub use mesh::SurfaceMesh;
pub use outline::{TrimLoop, TrimPiece};
pub use surface::{Surface, SurfacePoint};

use std::fmt;

/// The highest order, as in GLU.
pub const MAX_ORDER: usize = 24;

/// The most control points of a curve or a surface.
pub const MAX_CONTROL_POINTS: usize = 1 << 18;

/// The most work that finding the derivatives' bounds may be, in multiplications: a few seconds.
pub const MAX_BOUND_WORK: usize = 1 << 31;

/// The most products of basis functions that the vertices of a mesh may ask for: about a million
/// vertices of a bicubic surface. A tolerance that asks for more is widened.
pub const MAX_VERTEX_WORK: usize = 1 << 24;

/// The most points of a flattened curve, or of all trim loops of a surface together. A tolerance
/// that asks for more is widened.
pub const MAX_POLYLINE_POINTS: usize = 1 << 18;

/// The most places where trim loops may cross the lines of the grid.
pub const MAX_TRIM_CUTS: usize = 1 << 20;

/// The most edges looked at to tell inside from outside.
pub const MAX_TRIM_WORK: usize = 1 << 30;

/// The largest magnitude of knots and control points. Bounds of second derivatives, which multiply
/// five such numbers, then stay within `f64`.
pub const MAX_MAGNITUDE: f64 = 1e45;

/// Weights lie between this and its inverse.
pub const MIN_WEIGHT: f64 = 1e-30;

/// Points nearer than this part of the control net's diagonal count as one where a surface closes
/// or ends in a point, and trim points nearer than this part of the domain to a grid line lie on
/// it. Inventor's numbers are `f32`, so those meant to be equal may differ by 2^-23 of themselves.
pub const COINCIDENT: f64 = 1.0 / (1_u64 << 22) as f64;

/// How finely curved shapes are cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// The largest distance between a segment or triangle and what it stands for. Positive.
    pub chord: f64,
    /// The largest angle, in radians, that the control polygon of a span turns by for each of its
    /// parts, so that small round parts of large shapes look round; infinite to let the chord
    /// alone decide. Never divides a span more than 16 times as finely as the chord asks for.
    pub turn_rad: f64,
    /// The most points; the chord is widened to keep it, but for one part a span.
    /// [`MAX_VERTEX_WORK`] and [`MAX_POLYLINE_POINTS`] hold as well.
    pub most_points: usize,
}

/// Why there is no curve or surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NurbsError {
    /// The number of knots less the number of control points is not an order from 2 to
    /// [`MAX_ORDER`], or there are fewer control points than the order.
    Order,
    /// Knots decrease.
    DecreasingKnots,
    /// A knot occurs more often than the order says, or all of the domain is one knot.
    RepeatedKnots,
    /// There are fewer or more control points than the counts say.
    PointCount,
    /// A weight is zero, or weights differ in sign, or are out of range.
    Weight,
    /// A number is not finite or beyond [`MAX_MAGNITUDE`].
    Magnitude,
    /// More control points or work than the limits of this module.
    TooLarge,
    /// The tolerance is not positive.
    Tolerance,
    /// Trim loops cross the grid, or each other, too often.
    TrimTooIntricate,
}

impl fmt::Display for NurbsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Order => "the number of knots does not fit the number of control points",
            Self::DecreasingKnots => "its knots decrease",
            Self::RepeatedKnots => "a knot is repeated too often",
            Self::PointCount => "it has fewer control points than it says",
            Self::Weight => "a weight is zero, or weights have different signs",
            Self::Magnitude => "a number is not finite or too large",
            Self::TooLarge => "it has too many control points",
            Self::Tolerance => "the chord tolerance is not positive",
            Self::TrimTooIntricate => "its trimming curves are too intricate",
        })
    }
}

impl std::error::Error for NurbsError {}
