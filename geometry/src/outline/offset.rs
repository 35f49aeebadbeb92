//! Where corners go when every edge moves outward by one unit.

use glam::DVec2;

use super::area::Area;

/// How far a sharp corner may go: a corner of less than 29 degrees is not moved to where its
/// edges meet.
pub const MITER_LIMIT: f64 = 4.0;

/// For each corner of the area the vector that it moves by when all edges move outward by one, so
/// that they stay parallel to themselves; at most [`MITER_LIMIT`] long.
#[must_use]
pub fn miters(area: &Area) -> Vec<DVec2> {
    let mut out = Vec::with_capacity(area.corners.len());
    for range in area.loop_ranges() {
        let corners = &area.corners[range];
        let count = corners.len();
        for i in 0..count {
            let before = corners[(i + count - 1) % count].p;
            let after = corners[(i + 1) % count].p;
            let a = outward((corners[i].p - before).normalize_or_zero());
            let b = outward((after - corners[i].p).normalize_or_zero());
            // |a + b|² = 2 (1 + a·b), so this is as long as 1 / cos(half the turn).
            let miter = (a + b) / (1.0 + a.dot(b));
            out.push(if miter.is_finite() && miter.length() <= MITER_LIMIT {
                miter
            } else {
                (a + b).normalize_or(a) * MITER_LIMIT
            });
        }
    }
    out
}

/// The normal of an edge that has the area to its left.
pub(super) fn outward(direction: DVec2) -> DVec2 {
    DVec2::new(direction.y, -direction.x)
}
