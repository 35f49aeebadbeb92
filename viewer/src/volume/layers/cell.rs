//! Sides and cells in the space of directions from a light, and how they lie to each other.
//! Every doubt is left to the caller: signs are 0 where rounding leaves them open.

use std::ops::Range;

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

    /// One of `divisions` times `divisions` parts.
    pub(super) fn part(&self, divisions: usize, [column, row]: [usize; 2]) -> Self {
        let at = |x: usize, y: usize| {
            let fraction = DVec2::new(x as f64, y as f64) / divisions as f64;
            self.min + (self.max - self.min) * fraction
        };
        Self {
            min: at(column, row),
            max: at(column + 1, row + 1),
        }
    }

    /// The columns and rows of the parts that a side and a margin may touch: those of the box
    /// around its projection, or all if it is not in front of the light altogether.
    pub(super) fn span(&self, divisions: usize, side: &Side, margin: f64) -> [Range<usize>; 2] {
        if side.from.z <= 0.0 || side.to.z <= 0.0 {
            return [0..divisions, 0..divisions];
        }
        let (from, to) = (side.from.xy() / side.from.z, side.to.xy() / side.to.z);
        // Twice, so that the rounding of these few operations does not matter.
        let (low, high) = (from.min(to) - 2.0 * margin, from.max(to) + 2.0 * margin);
        let scale = divisions as f64 / (self.max - self.min);
        let first = ((low - self.min) * scale).floor();
        let last = ((high - self.min) * scale).floor();
        // Conversions saturate, so what is outside ends up at the nearest part.
        let range = |first: f64, last: f64| {
            (first as usize).min(divisions - 1)..(last as usize).min(divisions - 1) + 1
        };
        [range(first.x, last.x), range(first.y, last.y)]
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
