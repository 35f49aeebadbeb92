//! A cross section that is swept along a spine, scaled by a profile and turned by a twist: the
//! `GeneralizedCylinder` of SGI's modeller noodle. Gives rows of points; not faces, not normals.

use glam::{DMat3, DQuat, DVec3};

/// The curves. A value is at the height at which the profile has it: heights from the profile's
/// lowest to its highest point are the way along the spine and through the twist.
#[derive(Clone, Copy, Debug)]
pub struct Curves<'a> {
    /// x scales the cross section, y is a height.
    pub profile: &'a [DVec3],
    /// Points of what is swept, about the y axis.
    pub cross_section: &'a [DVec3],
    /// Where the sweep goes.
    pub spine: &'a [DVec3],
    /// x turns the cross section about its y axis, in radians; y is a height.
    pub twist: &'a [DVec3],
    /// The spine's last point is its first.
    pub is_spine_closed: bool,
    /// Rows and points a row at the least, where the curves have fewer.
    pub least: [usize; 2],
}

/// Most rows, most points in a row, and most steps of looking spine points up in the profile.
const LIMITS: [usize; 3] = [4096, 65_536, 10_000_000];

/// The rows of the surface, all of one length; `None` with fewer than two points in the profile or
/// the cross section, with no spine, or beyond the limits.
pub fn rows(curves: &Curves<'_>) -> Option<Vec<Vec<DVec3>>> {
    let too_few = curves.profile.len() < 2 || curves.cross_section.len() < 2;
    if too_few || curves.spine.is_empty() {
        return None;
    }
    let heights = Span::of(curves.profile.iter().map(|p| p.y));
    let spine = Spine::new(curves.spine, curves.is_spine_closed, heights.length);
    let profile = full_profile(curves, &spine, &heights)?;
    let section = refined(curves.cross_section, curves.least[1], LIMITS[1])?;
    if profile.len().saturating_mul(section.len()) > LIMITS[2] {
        return None;
    }
    let twist = Twist::new(curves.twist);
    let row = |point: &DVec3| {
        let along = (point.y - heights.low) / heights.length;
        let (center, turn) = spine.at(along);
        let turn = turn * DQuat::from_rotation_y(twist.at(along));
        let place = |p: &DVec3| center + turn * (*p * point.x);
        section.iter().map(place).collect()
    };
    Some(profile.iter().map(row).collect())
}

/// An interval that is never empty.
struct Span {
    low: f64,
    length: f64,
}

impl Span {
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values {
            low = low.min(value);
            high = high.max(value);
        }
        let length = if high > low { high - low } else { 1.0 };
        Self { low, length }
    }
}

/// The profile with a point at the height of every point of the spine.
fn full_profile(curves: &Curves<'_>, spine: &Spine<'_>, heights: &Span) -> Option<Vec<DVec3>> {
    let mut profile = curves.profile.to_vec();
    if profile.len().saturating_mul(curves.spine.len()) > LIMITS[2] {
        return None;
    }
    for along in &spine.along {
        let height = heights.low + along * heights.length;
        let mut crossed = Vec::with_capacity(profile.len() + 1);
        for pair in profile.windows(2) {
            crossed.push(pair[0]);
            let [from, to] = [pair[0].y - height, pair[1].y - height];
            if from * to < 0.0 {
                crossed.push(pair[0].lerp(pair[1], from / (from - to)));
            }
        }
        crossed.extend(profile.last());
        if crossed.len() > LIMITS[0] {
            return None;
        }
        profile = crossed;
    }
    if curves.least[0] > curves.profile.len() {
        return subdivided(
            &profile,
            length_of(curves.profile),
            curves.least[0],
            LIMITS[0],
        );
    }
    Some(profile)
}

fn refined(curve: &[DVec3], least: usize, limit: usize) -> Option<Vec<DVec3>> {
    if least > curve.len() {
        return subdivided(curve, length_of(curve), least, limit);
    }
    (curve.len() <= limit).then(|| curve.to_vec())
}

fn length_of(curve: &[DVec3]) -> f64 {
    curve.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

/// The curve with no piece longer than its length over `count`; a rest is at each piece's end.
fn subdivided(curve: &[DVec3], length: f64, count: usize, limit: usize) -> Option<Vec<DVec3>> {
    let step = length / count as f64;
    let mut points = Vec::new();
    for pair in curve.windows(2) {
        let piece = pair[0].distance(pair[1]);
        let steps = if step > 0.0 { piece / step } else { 0.0 };
        if steps.is_nan() || points.len() as f64 + steps >= limit as f64 {
            return None;
        }
        points.push(pair[0]);
        // What rounding leaves of a whole number of steps is no piece of its own.
        let whole = (steps - 1e-6).ceil().max(1.0) as usize;
        let inner = (1..whole).map(|i| pair[0].lerp(pair[1], i as f64 / steps));
        points.extend(inner);
    }
    points.extend(curve.last());
    Some(points)
}

struct Spine<'a> {
    points: &'a [DVec3],
    /// For each point the part of the spine's length that lies before it.
    along: Vec<f64>,
    turns: Vec<DQuat>,
    /// The height of what has a spine of one place.
    height: f64,
}

impl<'a> Spine<'a> {
    fn new(points: &'a [DVec3], is_closed: bool, height: f64) -> Self {
        let mut along = vec![0.0];
        let mut length = 0.0;
        for pair in points.windows(2) {
            length += pair[0].distance(pair[1]);
            along.push(length);
        }
        if length > 0.0 {
            along.iter_mut().for_each(|a| *a /= length);
        } else {
            along = vec![0.0];
        }
        Self {
            points,
            turns: turns(points, is_closed),
            along,
            height,
        }
    }

    /// Place and rotation at a part of the length.
    fn at(&self, along: f64) -> (DVec3, DQuat) {
        if self.along.len() < 2 {
            return (DVec3::Y * along * self.height, DQuat::IDENTITY);
        }
        let last = self.along.len() - 1;
        let next = self.along.partition_point(|&a| a < along).clamp(1, last);
        let (from, to) = (self.along[next - 1], self.along[next]);
        let part = if to > from {
            ((along - from) / (to - from)).clamp(0.0, 1.0)
        } else {
            0.0
        };
        (
            self.points[next - 1].lerp(self.points[next], part),
            self.turns[next - 1].slerp(self.turns[next], part),
        )
    }
}

/// A unit vector across two directions; `None` if they lie in one line.
fn across(a: DVec3, b: DVec3) -> Option<DVec3> {
    a.normalize_or_zero()
        .cross(b.normalize_or_zero())
        .try_normalize()
}

/// The rotation whose z axis is `z` and whose y axis comes closest to `y`.
fn frame(y: DVec3, z: DVec3) -> Option<DQuat> {
    let x = across(y, z)?;
    Some(DQuat::from_mat3(&DMat3::from_cols(x, z.cross(x), z)))
}

/// A rotation at each point: z across the bend there, leaning the way it leaned before, y along.
fn turns(points: &[DVec3], is_closed: bool) -> Vec<DQuat> {
    let count = points.len();
    let all = |turn| vec![turn; count];
    let straight = |y: DVec3| DQuat::from_rotation_arc(DVec3::Y, y);
    let Some(begin) = points.iter().find_map(|p| (*p - points[0]).try_normalize()) else {
        return all(DQuat::IDENTITY);
    };
    // The first bend anywhere tells how it all leans.
    let bend =
        |i: usize, before: DVec3, after: DVec3| across(after - points[i], before - points[i]);
    let bends = |i: usize| match i {
        0 if is_closed && count > 2 => bend(0, points[count - 2], points[1]),
        i if i > 0 && i + 1 < count => bend(i, points[i - 1], points[i + 1]),
        _ => None,
    };
    let Some(first) = (0..count).find_map(bends) else {
        return all(straight(begin));
    };
    let mut lean = if first.z < 0.0 { -first } else { first };
    let mut turns: Vec<DQuat> = Vec::with_capacity(count);
    for i in 0..count {
        if let Some(z) = bends(i) {
            lean = if z.dot(lean) < 0.0 { -z } else { z };
        }
        let along = match i {
            0 if is_closed && count > 2 => points[1] - points[count - 2],
            0 => begin,
            i if i + 1 < count => points[i + 1] - points[i - 1],
            _ => points[i] - points[i - 1],
        };
        let before = turns.last().copied();
        turns.push(match (before, i + 1 == count && is_closed) {
            (Some(_), true) => turns[0],
            _ => frame(along, lean)
                .or(before)
                .unwrap_or_else(|| straight(begin)),
        });
    }
    turns
}

struct Twist<'a> {
    points: &'a [DVec3],
    heights: Span,
}

impl<'a> Twist<'a> {
    fn new(points: &'a [DVec3]) -> Self {
        let heights = Span::of(points.iter().map(|p| p.y));
        Self { points, heights }
    }

    /// The angle at a part of the height, in radians.
    fn at(&self, along: f64) -> f64 {
        let height = self.heights.low + along.clamp(0.0, 1.0) * self.heights.length;
        let piece = self.points.windows(2).find(|pair| {
            let [a, b] = [pair[0].y, pair[1].y];
            a.min(b) <= height && height <= a.max(b)
        });
        piece.map_or(0.0, |pair| {
            let rise = pair[1].y - pair[0].y;
            let part = if rise == 0.0 {
                0.0
            } else {
                (height - pair[0].y) / rise
            };
            pair[0].x + part * (pair[1].x - pair[0].x)
        })
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, TAU};

    use super::*;

    const LINE: [DVec3; 2] = [DVec3::new(1.0, -1.0, 0.0), DVec3::new(1.0, 1.0, 0.0)];
    const UP: [DVec3; 2] = [DVec3::new(0.0, -1.0, 0.0), DVec3::new(0.0, 1.0, 0.0)];
    const CORNER: [DVec3; 2] = [DVec3::new(1.0, 0.0, 1.0), DVec3::new(1.0, 0.0, -1.0)];

    fn curves() -> Curves<'static> {
        Curves {
            profile: &LINE,
            cross_section: &CORNER,
            spine: &UP,
            twist: &UP,
            is_spine_closed: false,
            least: [1, 1],
        }
    }

    fn check(curves: &Curves<'_>, expected: &[[[f64; 3]; 2]]) {
        let rows = rows(curves).expect("rows");
        assert_eq!(rows.len(), expected.len(), "{rows:?}");
        for (row, expected) in rows.iter().zip(expected) {
            for (p, expected) in row.iter().zip(expected) {
                assert!(p.distance(DVec3::from(*expected)) < 1e-12, "{rows:?}");
            }
        }
    }

    #[test]
    fn straight_scaled_twisted() {
        check(
            &curves(),
            &[
                [[1.0, -1.0, 1.0], [1.0, -1.0, -1.0]],
                [[1.0, 1.0, 1.0], [1.0, 1.0, -1.0]],
            ],
        );
        let cone = [DVec3::new(2.0, 5.0, 0.0), DVec3::new(0.5, 6.0, 0.0)];
        check(
            &Curves {
                profile: &cone,
                ..curves()
            },
            &[
                [[2.0, -1.0, 2.0], [2.0, -1.0, -2.0]],
                [[0.5, 1.0, 0.5], [0.5, 1.0, -0.5]],
            ],
        );
        let quarter = [DVec3::ZERO, DVec3::new(FRAC_PI_2, 9.0, 0.0)];
        check(
            &Curves {
                twist: &quarter,
                ..curves()
            },
            &[
                [[1.0, -1.0, 1.0], [1.0, -1.0, -1.0]],
                [[1.0, 1.0, -1.0], [-1.0, 1.0, -1.0]],
            ],
        );
    }

    #[test]
    fn spine_that_bends() {
        // Up and then to the left: the row at the bend stands across the mean direction.
        let bent = [DVec3::ZERO, DVec3::Y * 2.0, DVec3::new(-2.0, 2.0, 0.0)];
        let s = 0.5_f64.sqrt();
        check(
            &Curves {
                spine: &bent,
                ..curves()
            },
            &[
                [[1.0, 0.0, 1.0], [1.0, 0.0, -1.0]],
                [[s, 2.0 + s, 1.0], [s, 2.0 + s, -1.0]],
                [[-2.0, 3.0, 1.0], [-2.0, 3.0, -1.0]],
            ],
        );
    }

    #[test]
    fn closed_spine_ends_where_it_begins() {
        let ring: Vec<DVec3> = (0..=12)
            .map(|i| {
                DVec3::new(
                    (TAU * f64::from(i % 12) / 12.0).cos(),
                    (TAU * f64::from(i % 12) / 12.0).sin(),
                    0.0,
                )
            })
            .collect();
        let rows = rows(&Curves {
            spine: &ring,
            is_spine_closed: true,
            ..curves()
        })
        .expect("rows");
        assert_eq!(rows.len(), 13);
        for (first, last) in rows[0].iter().zip(&rows[12]) {
            assert!(first.distance(*last) < 1e-12);
        }
    }

    #[test]
    fn least_numbers_of_rows_and_columns() {
        let rows_of = |least| rows(&Curves { least, ..curves() }).map(|r| [r.len(), r[0].len()]);
        assert_eq!(rows_of([1, 1]), Some([2, 2]));
        assert_eq!(rows_of([4, 10]), Some([5, 11]));
        assert_eq!(rows_of([usize::MAX, 1]), None);
        assert_eq!(rows_of([1, usize::MAX]), None);
    }

    #[test]
    fn nothing_from_too_little() {
        let point = [DVec3::ONE];
        assert!(
            rows(&Curves {
                profile: &point,
                ..curves()
            })
            .is_none()
        );
        assert!(
            rows(&Curves {
                cross_section: &point,
                ..curves()
            })
            .is_none()
        );
        assert!(
            rows(&Curves {
                spine: &[],
                ..curves()
            })
            .is_none()
        );
        // A spine of one place stands up along y; no twist is none.
        check(
            &Curves {
                spine: &point,
                twist: &[],
                ..curves()
            },
            &[
                [[1.0, 0.0, 1.0], [1.0, 0.0, -1.0]],
                [[1.0, 2.0, 1.0], [1.0, 2.0, -1.0]],
            ],
        );
    }
}
