//! Closed solids with outward, counter-clockwise faces: prisms over an outline with openings, and
//! turned bodies. Faces may be concave; an opening is joined to the outline by a bridge edge, as
//! Inventor's faces have no holes.

use std::collections::BTreeMap;

/// Points in metres and faces as point indices, counter-clockwise seen from outside.
pub(crate) struct Solid {
    pub(crate) points: Vec<[f64; 3]>,
    pub(crate) faces: Vec<Vec<usize>>,
}

impl Solid {
    /// Moves every point. `place` must keep the handedness, or the faces turn inward.
    pub(crate) fn mapped(mut self, place: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        for point in &mut self.points {
            *point = place(*point);
        }
        self
    }

    /// True if every edge is walked as often in one direction as in the other.
    pub(crate) fn is_closed(&self) -> bool {
        let mut balance: BTreeMap<(usize, usize), i32> = BTreeMap::new();
        for face in &self.faces {
            let ends = face.iter().cycle().skip(1);
            for (&a, &b) in face.iter().zip(ends) {
                *balance.entry((a.min(b), a.max(b))).or_default() += if a < b { 1 } else { -1 };
            }
        }
        balance.values().all(|&walks| walks == 0)
    }

    /// Signed volume, positive when the faces look outward: the divergence theorem over fans.
    /// Concave faces and bridges are fine, as the terms are signed.
    pub(crate) fn volume(&self) -> f64 {
        let mut six_volumes = 0.0;
        for face in &self.faces {
            for pair in face[1..].windows(2) {
                let [a, b, c] = [face[0], pair[0], pair[1]].map(|i| self.points[i]);
                six_volumes += a[0] * (b[1] * c[2] - b[2] * c[1])
                    + a[1] * (b[2] * c[0] - b[0] * c[2])
                    + a[2] * (b[0] * c[1] - b[1] * c[0]);
            }
        }
        six_volumes / 6.0
    }
}

/// A rectangular opening in a wall or frame, in metres from the wall's lower left corner.
#[derive(Clone, Copy)]
pub(crate) struct Opening {
    pub(crate) left: f64,
    pub(crate) width: f64,
    pub(crate) sill: f64,
    pub(crate) head: f64,
}

/// A counter-clockwise ring over plane points. A ring that walks to an opening and back visits
/// the two ends of the bridge twice.
pub(crate) struct Outline {
    points: Vec<[f64; 2]>,
    ring: Vec<usize>,
}

impl Outline {
    /// A plain polygon, counter-clockwise.
    pub(crate) fn polygon(points: Vec<[f64; 2]>) -> Self {
        let ring = (0..points.len()).collect();
        Self::ring(points, ring)
    }

    /// A ring given by indices; a bridge's two ends appear twice.
    pub(crate) fn ring(points: Vec<[f64; 2]>, ring: Vec<usize>) -> Self {
        Self { points, ring }
    }

    /// A rectangle from (0, 0) with `openings` ordered left to right, none above another. One with
    /// sill 0 is a notch in the lower edge; any other hangs on a bridge from the lower edge.
    pub(crate) fn wall(width: f64, height: f64, openings: &[Opening]) -> Self {
        let mut outline = Self::polygon(vec![[0.0, 0.0]]);
        for opening in openings {
            let (left, right) = (opening.left, opening.left + opening.width);
            let (sill, head) = (opening.sill, opening.head);
            let foot = outline.push([left, 0.0]);
            let is_window = sill > 0.0;
            let corner = if is_window {
                outline.push([left, sill])
            } else {
                foot
            };
            outline.push([left, head]);
            outline.push([right, head]);
            outline.push([right, sill]);
            if is_window {
                outline.ring.extend([corner, foot]);
            }
        }
        outline.push([width, 0.0]);
        outline.push([width, height]);
        outline.push([0.0, height]);
        outline
    }

    fn push(&mut self, point: [f64; 2]) -> usize {
        let index = self.points.len();
        self.points.push(point);
        self.ring.push(index);
        index
    }

    /// The ring's edges, each from its start to its end.
    fn edges(&self) -> impl Iterator<Item = (usize, usize)> {
        let ends = self.ring.iter().cycle().skip(1);
        self.ring.iter().copied().zip(ends.copied())
    }
}

/// The body between `outline` at w = 0 and at w = `depth`; points are (u, v, w). Bridges get no
/// side faces: they are walked in both directions.
pub(crate) fn prism(outline: &Outline, depth: f64) -> Solid {
    let count = outline.points.len();
    let layer = |w: f64| outline.points.iter().map(move |&[u, v]| [u, v, w]);
    let points = layer(0.0).chain(layer(depth)).collect();
    let front: Vec<usize> = outline.ring.iter().map(|i| i + count).collect();
    let back: Vec<usize> = outline.ring.iter().rev().copied().collect();
    let mut faces = vec![front, back];
    for (a, b) in outline.edges() {
        if !outline.edges().any(|edge| edge == (b, a)) {
            faces.push(vec![a, b, b + count, a + count]);
        }
    }
    Solid { points, faces }
}

/// A body turned about +Z: `profile` is (radius, z) from bottom to top, `sides` the facets round.
pub(crate) fn lathe(profile: &[[f64; 2]], sides: usize) -> Solid {
    let mut points = Vec::with_capacity(profile.len() * sides);
    for &[radius, z] in profile {
        for side in 0..sides {
            let (sin, cos) = (std::f64::consts::TAU * side as f64 / sides as f64).sin_cos();
            points.push([radius * cos, radius * sin, z]);
        }
    }
    let last_ring = (profile.len() - 1) * sides;
    let bottom = (0..sides).rev().collect();
    let top = (last_ring..last_ring + sides).collect();
    let mut faces: Vec<Vec<usize>> = vec![bottom, top];
    for low in (0..last_ring).step_by(sides) {
        let high = low + sides;
        for side in 0..sides {
            let next = (side + 1) % sides;
            faces.push(vec![low + side, low + next, high + next, high + side]);
        }
    }
    Solid { points, faces }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check_closed(name: &str, solid: &Solid, expected_volume: f64) {
        assert!(solid.is_closed(), "{name}: open edges");
        let volume = solid.volume();
        assert!(
            (volume - expected_volume).abs() < 1e-9,
            "{name}: volume {volume}, expected {expected_volume}"
        );
    }

    #[test]
    fn solids_are_closed_and_face_outward() {
        let door = Opening {
            left: 0.5,
            width: 1.0,
            sill: 0.0,
            head: 2.0,
        };
        let window = Opening {
            left: 2.0,
            width: 1.5,
            sill: 1.0,
            head: 2.0,
        };
        let square = || Outline::polygon(vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
        let area_of_12_gon = 3.0;
        let rows = [
            ("cube", prism(&square(), 3.0), 12.0),
            ("plain wall", prism(&Outline::wall(4.0, 3.0, &[]), 0.5), 6.0),
            ("door", prism(&Outline::wall(4.0, 3.0, &[door]), 0.5), 5.0),
            (
                "window",
                prism(&Outline::wall(4.0, 3.0, &[window]), 0.5),
                5.25,
            ),
            (
                "both",
                prism(&Outline::wall(4.0, 3.0, &[door, window]), 0.5),
                4.25,
            ),
            (
                "turned",
                lathe(&[[1.0, 0.0], [1.0, 2.0]], 12),
                2.0 * area_of_12_gon,
            ),
        ];
        for (name, solid, expected_volume) in &rows {
            check_closed(name, solid, *expected_volume);
        }
    }
}
