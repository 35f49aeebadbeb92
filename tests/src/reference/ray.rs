//! Rays and their intersection with triangles, watertight along shared edges: Woop, Benthin and
//! Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013, in f64.
//!
//! An edge function is the difference of two rounded products. Rounding is monotone, so its sign
//! is that of the exact difference, or it is zero; and two triangles that share an edge compute it
//! from the same sheared corners. Zero counts as inside, so a ray cannot slip between the two, and
//! the paper's second computation with more digits is not needed: it would only tell apart which
//! of the two is hit. Nor is its swap of axes, as both windings are hit. All this holds as long as no
//! product underflows.

use glam::DVec3;

/// A half line, with the shear that turns it into +Z.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Not zero; need not have unit length: `t` counts in its lengths.
    pub direction: DVec3,
    axes: [usize; 3],
    shear: [f64; 3],
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The point is `origin + t * direction`.
    pub t: f64,
    /// Weights of the three corners; not negative, their sum is 1.
    pub weights: [f64; 3],
}

impl Ray {
    /// A ray along `direction`.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        let z = direction.abs().max_position();
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        let along = direction[z];
        Self {
            origin,
            direction,
            axes: [x, y, z],
            shear: [direction[x] / along, direction[y] / along, 1.0 / along],
        }
    }

    /// The crossing with the triangle's inside or edge, on either side of the origin. `None` for a
    /// triangle seen exactly edge-on, and for one without area.
    pub fn cross(&self, corners: &[DVec3; 3]) -> Option<Crossing> {
        let [a, b, c] = corners.map(|p| self.sheared(p));
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
        let sum = u + v + w;
        if !inside || sum == 0.0 {
            return None;
        }
        let weights = [u / sum, v / sum, w / sum];
        let t = self.shear[2] * (weights[0] * a[2] + weights[1] * b[2] + weights[2] * c[2]);
        Some(Crossing { t, weights })
    }

    /// `p` in the frame where the ray is the Z axis; Z itself is not scaled.
    fn sheared(&self, p: DVec3) -> [f64; 3] {
        let q = (p - self.origin).to_array();
        let [x, y, z] = self.axes;
        let [sx, sy, _] = self.shear;
        [q[x] - sx * q[z], q[y] - sy * q[z], q[z]]
    }
}
