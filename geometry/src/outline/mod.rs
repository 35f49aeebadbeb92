//! Outlines of lines and curves in the plane as areas: flattened, united, triangulated. Letters
//! are drawn so. Not for polygons of files, which have corners that must stay as they are: those
//! are in [`triangulate`](crate::triangulate).
//!
//! ```text
//! contours ─► flatten ─► polylines with tangents ─► fill ─► loops and triangles ─► offsets
//! ```

mod area;
mod flatten;
mod offset;
#[cfg(test)]
mod tests;

pub use area::{Area, Corner, MAX_COORDINATE, fill};
pub use flatten::{Contour, MAX_CURVE_PIECES, Polyline, Segment, flatten};
pub use offset::{MITER_LIMIT, miters};
