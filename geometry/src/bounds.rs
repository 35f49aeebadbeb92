//! The axis-aligned bounding box. Not a culling structure: no planes, no rays.

use glam::{DAffine3, DVec3};

/// An axis-aligned box, both ends included. Empty when `min > max` on any axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// The smallest coordinate on each axis.
    pub min: DVec3,
    /// The largest coordinate on each axis.
    pub max: DVec3,
}

impl Default for Aabb {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl Aabb {
    /// The box of no points; the neutral element of [`Aabb::union`].
    pub const EMPTY: Self = Self {
        min: DVec3::INFINITY,
        max: DVec3::NEG_INFINITY,
    };

    /// Whether the box holds no point.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        // The negation makes a box with NaN bounds empty as well.
        !self.min.cmple(self.max).all()
    }

    /// Grows the box to hold `p`. A point with a non-finite coordinate is ignored.
    pub fn include(&mut self, p: DVec3) {
        if p.is_finite() {
            self.min = self.min.min(p);
            self.max = self.max.max(p);
        }
    }

    /// The smallest box that holds both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        match (self.is_empty(), other.is_empty()) {
            (true, true) => Self::EMPTY,
            (true, false) => *other,
            (false, true) => *self,
            (false, false) => Self {
                min: self.min.min(other.min),
                max: self.max.max(other.max),
            },
        }
    }

    /// The midpoint; zero for an empty box.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        if self.is_empty() {
            return DVec3::ZERO;
        }
        // Halving first keeps boxes near the largest numbers from overflowing.
        self.min * 0.5 + self.max * 0.5
    }

    /// The edge lengths; zero for an empty box.
    #[must_use]
    pub fn size(&self) -> DVec3 {
        if self.is_empty() {
            return DVec3::ZERO;
        }
        self.max - self.min
    }

    /// The eight corners; bit 0 of the index chooses `max` on x, bit 1 on y, bit 2 on z.
    /// The corners of an empty box are not points of space and mean nothing.
    #[must_use]
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            let pick = |bit: usize, min: f64, max: f64| if i & bit == 0 { min } else { max };
            DVec3::new(
                pick(1, self.min.x, self.max.x),
                pick(2, self.min.y, self.max.y),
                pick(4, self.min.z, self.max.z),
            )
        })
    }

    /// The box around this box's image, where `self` is in local and the result in world
    /// coordinates. Empty when `self` is empty; corners mapped to non-finite points are
    /// ignored.
    #[must_use]
    pub fn transformed(&self, world_from_local: &DAffine3) -> Self {
        let mut image = Self::EMPTY;
        if !self.is_empty() {
            for corner in self.corners() {
                image.include(world_from_local.transform_point3(corner));
            }
        }
        image
    }
}

impl FromIterator<DVec3> for Aabb {
    fn from_iter<I: IntoIterator<Item = DVec3>>(points: I) -> Self {
        let mut bounds = Self::EMPTY;
        for p in points {
            bounds.include(p);
        }
        bounds
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    fn v(x: f64, y: f64, z: f64) -> DVec3 {
        DVec3::new(x, y, z)
    }

    #[test]
    fn include_keeps_finite_points_only() {
        type MinMax = Option<(DVec3, DVec3)>;
        let rows: [(&[DVec3], MinMax); 5] = [
            (&[], None),
            (&[DVec3::NAN, v(0.0, f64::INFINITY, 0.0)], None),
            (
                &[v(1.0, 2.0, 3.0)],
                Some((v(1.0, 2.0, 3.0), v(1.0, 2.0, 3.0))),
            ),
            (
                &[v(1.0, -2.0, 3.0), v(f64::NAN, 9.0, 9.0), v(-1.0, 2.0, 0.0)],
                Some((v(-1.0, -2.0, 0.0), v(1.0, 2.0, 3.0))),
            ),
            (
                &[v(9.0, 9.0, f64::NEG_INFINITY), v(0.0, 0.0, 0.0)],
                Some((DVec3::ZERO, DVec3::ZERO)),
            ),
        ];
        for (points, expected) in rows {
            let bounds: Aabb = points.iter().copied().collect();
            assert_eq!(bounds.is_empty(), expected.is_none(), "{points:?}");
            if let Some((min, max)) = expected {
                assert_eq!(bounds, Aabb { min, max }, "{points:?}");
            }
        }
    }

    #[test]
    fn union_has_empty_as_neutral_element() {
        let a = Aabb {
            min: v(0.0, 0.0, 0.0),
            max: v(1.0, 1.0, 1.0),
        };
        let b = Aabb {
            min: v(-1.0, 0.5, 2.0),
            max: v(0.5, 3.0, 4.0),
        };
        let ab = Aabb {
            min: v(-1.0, 0.0, 0.0),
            max: v(1.0, 3.0, 4.0),
        };
        // Empty although two of its axes are ordered.
        let inverted = Aabb {
            min: v(5.0, 0.0, 0.0),
            max: v(4.0, 9.0, 9.0),
        };
        for (left, right, expected) in [
            (a, b, ab),
            (b, a, ab),
            (a, Aabb::EMPTY, a),
            (Aabb::EMPTY, a, a),
            (a, inverted, a),
            (inverted, inverted, Aabb::EMPTY),
        ] {
            assert_eq!(left.union(&right), expected, "{left:?} {right:?}");
        }
    }

    #[test]
    fn center_and_size() {
        let big = v(1.5e308, 0.0, 1.0);
        for (bounds, center, size) in [
            (Aabb::EMPTY, DVec3::ZERO, DVec3::ZERO),
            (
                Aabb {
                    min: v(1.0, 2.0, 3.0),
                    max: v(3.0, 2.0, 7.0),
                },
                v(2.0, 2.0, 5.0),
                v(2.0, 0.0, 4.0),
            ),
            (Aabb { min: big, max: big }, big, DVec3::ZERO),
        ] {
            assert_eq!(bounds.center(), center);
            assert_eq!(bounds.size(), size);
        }
    }

    #[test]
    fn corners_are_indexed_by_bits() {
        let corners = Aabb {
            min: v(0.0, 1.0, 2.0),
            max: v(10.0, 11.0, 12.0),
        }
        .corners();
        assert_eq!(corners[0], v(0.0, 1.0, 2.0));
        assert_eq!(corners[1], v(10.0, 1.0, 2.0));
        assert_eq!(corners[2], v(0.0, 11.0, 2.0));
        assert_eq!(corners[4], v(0.0, 1.0, 12.0));
        assert_eq!(corners[7], v(10.0, 11.0, 12.0));
    }

    #[test]
    fn transformed_holds_the_image() {
        let cube = Aabb {
            min: DVec3::splat(-1.0),
            max: DVec3::splat(1.0),
        };
        let turn_z = DQuat::from_xyzw(0.0, 0.0, 0.5_f64.sqrt(), 0.5_f64.sqrt());
        let rows = [
            (
                Aabb {
                    min: DVec3::ZERO,
                    max: v(1.0, 2.0, 3.0),
                },
                DAffine3::from_rotation_translation(turn_z, v(10.0, 0.0, 0.0)),
                Aabb {
                    min: v(8.0, 0.0, 0.0),
                    max: v(10.0, 1.0, 3.0),
                },
            ),
            (
                cube,
                DAffine3::from_scale(v(-2.0, 0.0, 3.0)),
                Aabb {
                    min: v(-2.0, 0.0, -3.0),
                    max: v(2.0, 0.0, 3.0),
                },
            ),
        ];
        for (local, world_from_local, expected) in rows {
            let world = local.transformed(&world_from_local);
            assert!(world.min.abs_diff_eq(expected.min, 1e-14), "{world:?}");
            assert!(world.max.abs_diff_eq(expected.max, 1e-14), "{world:?}");
        }
        let nan = DAffine3::from_translation(DVec3::NAN);
        assert!(cube.transformed(&nan).is_empty());
        assert!(Aabb::EMPTY.transformed(&DAffine3::IDENTITY).is_empty());
    }
}
