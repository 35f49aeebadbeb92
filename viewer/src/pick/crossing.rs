//! Triangles, segments and points in the frame of an aim, where the ray is the Z axis.
//!
//! Triangles are tested as by Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT
//! 2(1), 2013, with the shear in the matrix that brought the corners here. Two triangles that share
//! an edge of a mesh compute its function from the same rounded corners. It is the difference of two
//! rounded products, so its sign is that of the exact difference or it is zero, and zero is inside:
//! no ray slips between the two. The paper's second computation with more digits would only tell
//! which of the two is hit.

use glam::DVec3;

/// Where the ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Z there.
    pub depth: f64,
    /// Weights of the corners; not negative, their sum is 1.
    pub weights: [f64; 3],
    /// The corners are in counter-clockwise order as seen along the ray.
    pub is_ccw: bool,
}

/// The crossing with a triangle's inside or edge, on either side of the origin. `None` for one that
/// is seen exactly edge-on, has no area or holds what is no number.
pub fn cross(corners: &[DVec3; 3]) -> Option<Crossing> {
    let [a, b, c] = corners;
    let u = c.x * b.y - c.y * b.x;
    let v = a.x * c.y - a.y * c.x;
    let w = b.x * a.y - b.y * a.x;
    let is_inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
    let sum = u + v + w;
    if !is_inside || sum == 0.0 {
        return None;
    }
    let weights = [u / sum, v / sum, w / sum];
    let depth = weights[0] * a.z + weights[1] * b.z + weights[2] * c.z;
    let is_finite = depth.is_finite() && weights.iter().all(|x| x.is_finite());
    is_finite.then_some(Crossing {
        depth,
        weights,
        // Y points down.
        is_ccw: sum > 0.0,
    })
}

/// A place on a line or a point, and how far beside what is drawn of it the ray passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beside {
    /// Z of the place.
    pub depth: f64,
    /// From 0 at the first end to 1 at the second.
    pub along: f64,
    /// The place in the image, pixels to the right and down of the ray.
    pub offset_px: [f64; 2],
    /// Distance in the image from what is drawn; 0 on it.
    pub outside_px: f64,
}

/// The place on a segment that is nearest to the ray in the image. `near` is where a perspective
/// view cuts it off; positive. It is drawn as a rectangle `half_px` to either side, without caps.
pub fn beside_segment(
    [mut a, mut b]: [DVec3; 2],
    half_px: f64,
    near: f64,
    is_perspective: bool,
) -> Option<Beside> {
    let (mut from, mut to) = (0.0, 1.0);
    if is_perspective {
        let cut = |p: DVec3, q: DVec3| (near - p.z) / (q.z - p.z);
        match (a.z < near, b.z < near) {
            (true, true) => return None,
            (true, false) => from = cut(a, b),
            (false, true) => to = 1.0 - cut(b, a),
            (false, false) => {}
        }
        (a, b) = (a.lerp(b, from), a.lerp(b, to));
        // What is left begins at near but for rounding, which must not leave a depth of nothing.
        (a.z, b.z) = (a.z.max(near), b.z.max(near));
    }
    let flat = |p: DVec3| {
        let share = if is_perspective { 1.0 / p.z } else { 1.0 };
        p.truncate() * share
    };
    let (p, q) = (flat(a), flat(b));
    let length = (q - p).length();
    let unit = (q - p) / length;
    let (along_px, across_px) = if length > 0.0 {
        (-p.dot(unit), p.perp_dot(unit).abs() - half_px)
    } else {
        // Seen along its length nothing of it is drawn.
        (0.0, p.length())
    };
    let clamped = along_px.clamp(0.0, length.max(0.0));
    let share = if length > 0.0 { clamped / length } else { 0.0 };
    // What is linear in the image is 1 / Z.
    let inner = if is_perspective {
        let (wa, wb) = ((1.0 - share) / a.z, share / b.z);
        wb / (wa + wb)
    } else {
        share
    };
    let place = p.lerp(q, share);
    let beside = Beside {
        depth: a.z + (b.z - a.z) * inner,
        along: (from + (to - from) * inner).clamp(0.0, 1.0),
        offset_px: place.to_array(),
        outside_px: (along_px - clamped).hypot(across_px.max(0.0)),
    };
    (beside.depth.is_finite() && place.is_finite() && beside.outside_px.is_finite())
        .then_some(beside)
}

/// As [`beside_segment`], for a point that is drawn as a square.
pub fn beside_point(p: DVec3, half_px: f64, near: f64, is_perspective: bool) -> Option<Beside> {
    if p.z < near {
        return None;
    }
    let offset_px = super::aim::offset_px(p, is_perspective)?;
    let [x, y] = offset_px.map(|x| (x.abs() - half_px).max(0.0));
    Some(Beside {
        depth: p.z,
        along: 0.0,
        offset_px,
        outside_px: x.hypot(y),
    })
}
