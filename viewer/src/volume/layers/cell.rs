//! Sides and cells in the space of directions from a light, and how they lie to each other.
//! Every doubt is left to the caller: signs are 0 where rounding leaves them open.

use glam::{DVec2, DVec3, Vec3Swizzles};

use crate::volume::exact::DETERMINANT_BOUND;

/// The plane of two directions, with what is needed to bound the rounding of its signs.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    normal: DVec3,
    permanent: DVec3,
}

impl Plane {
    pub(super) fn new(a: DVec3, b: DVec3) -> Self {
        let (left, right) = (a.yzx() * b.zxy(), a.zxy() * b.yzx());
        Self {
            normal: left - right,
            permanent: left.abs() + right.abs(),
        }
    }

    /// The sign of the determinant `(a, b, c)`; 0 if rounding leaves it open.
    pub(super) fn side_of(&self, c: DVec3) -> i8 {
        let determinant = c.dot(self.normal);
        let bound = DETERMINANT_BOUND * c.abs().dot(self.permanent);
        i8::from(determinant > bound) - i8::from(determinant < -bound)
    }
}

/// A side as seen from the light, in coordinates of which only the direction matters.
#[derive(Clone, Copy)]
pub(super) struct Side {
    pub(super) from: DVec3,
    pub(super) to: DVec3,
    /// Directions of negative sign are inside.
    pub(super) plane: Plane,
    pub(super) count: u32,
}

impl Side {
    pub(super) fn new(from: DVec3, to: DVec3, count: u32) -> Self {
        Self {
            from,
            to,
            plane: Plane::new(from, to),
            count,
        }
    }
}

/// A rectangle of directions `(x, y, 1)`.
#[derive(Clone, Copy)]
pub(super) struct Cell {
    pub(super) min: DVec2,
    pub(super) max: DVec2,
}

impl Cell {
    /// A point inside that is on no symmetry of a model.
    pub(super) fn reference(&self) -> DVec3 {
        let across = self.max - self.min;
        (self.min + across * DVec2::new(0.463_251, 0.528_417)).extend(1.0)
    }

    pub(super) fn quarter(&self, quarter: usize) -> Self {
        let middle = self.min.midpoint(self.max);
        let (mut min, mut max) = (self.min, self.max);
        for axis in 0..2 {
            if quarter >> axis & 1 == 0 {
                max[axis] = middle[axis];
            } else {
                min[axis] = middle[axis];
            }
        }
        Self { min, max }
    }

    /// False only if the side is clear of the cell and a margin around it.
    pub(super) fn may_touch(&self, side: &Side, margin: f64) -> bool {
        let (min, max) = (self.min - margin, self.max + margin);
        let outside = |p: DVec3| {
            [
                p.x < min.x * p.z,
                p.x > max.x * p.z,
                p.y < min.y * p.z,
                p.y > max.y * p.z,
            ]
        };
        let (from, to) = (outside(side.from), outside(side.to));
        if (0..4).any(|i| from[i] && to[i]) {
            return false;
        }
        let sign_at = |x: f64, y: f64| side.plane.side_of(DVec3::new(x, y, 1.0));
        let first = sign_at(min.x, min.y);
        first == 0
            || sign_at(max.x, max.y) != first
            || sign_at(min.x, max.y) != first
            || sign_at(max.x, min.y) != first
    }
}

/// An upper bound of `N` at `to` from one at `from`, the sides being all that may cross the
/// shorter arc between the two directions.
pub(super) fn walk<'a>(
    value: u64,
    sides: impl Iterator<Item = &'a Side>,
    from: DVec3,
    to: DVec3,
) -> u64 {
    let (mut inwards, mut outwards) = (0_u64, 0_u64);
    let way = Plane::new(from, to);
    for side in sides {
        // Two arcs cross if these four have one sign, which is -1 for a crossing inwards
        // (the criterion of the library S2).
        let ends = [-side.plane.side_of(from), side.plane.side_of(to)];
        if ends[0] * ends[1] < 0 {
            continue;
        }
        let [a, b] = ends;
        let signs = [a, b, -way.side_of(side.to), way.side_of(side.from)];
        if !signs.contains(&1) {
            inwards += u64::from(side.count);
        } else if signs == [1; 4] {
            outwards += u64::from(side.count);
        }
    }
    (value + inwards).saturating_sub(outwards)
}
