//! All triangles of one kind (opaque or transparent) in the world, and what a ray meets of them.

use std::cmp::Ordering;

use glam::DVec3;

use super::bvh::{Bounds, Bvh};
use super::light::Source;
use super::ray::{Crossing, Ray};

/// By how much a world coordinate and what is reckoned from it may err, relative to the largest
/// coordinate there is: a coordinate is a sum of four rounded products, a point within a triangle
/// one of three, a corner relative to a ray's origin one more difference. Each errs by a few units
/// of 2^-53, all of them by less than 16.
pub const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// A triangle with area.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// In the world, in the mesh's order.
    pub corners: [DVec3; 3],
    /// Index into the scene's instances.
    pub instance: u32,
    /// Its number in the mesh.
    pub number: u32,
    /// Not seen from the back; it casts shadows nevertheless.
    pub front_only: bool,
    /// The transform to the world turns the winding round.
    pub mirrored: bool,
}

/// A crossing and what is crossed.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Index into the triangles.
    pub triangle: u32,
    /// Where.
    pub at: Crossing,
    /// The ray comes from the front side.
    pub is_front: bool,
}

impl Triangle {
    /// Twice the area as a vector, counter-clockwise.
    pub fn normal(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// Whether a ray along `direction` meets the front side first. The front is counter-clockwise
    /// in the local frame, so a mirroring transform turns the winding seen.
    pub fn is_front(&self, direction: DVec3) -> bool {
        (self.normal().dot(direction) < 0.0) != self.mirrored
    }

    /// The point with these weights of the corners.
    pub fn point(&self, weights: [f64; 3]) -> DVec3 {
        let [a, b, c] = self.corners;
        a * weights[0] + b * weights[1] + c * weights[2]
    }

    /// On which side of the triangle's plane the light is: 1 on the side of [`Self::normal`], -1 on
    /// the other, 0 if that cannot be told when each coordinate is uncertain by `unit`, and the
    /// light's by [`ROUNDING`] of its own if that is more.
    ///
    /// The sign is that of the product of the two edges `e`, `f` and the vector `l` to the light.
    /// Moving a corner by `unit` changes it by at most `unit (|e| + |f|) |l|`, moving a light by
    /// `unit |e x f|`, times 2 as a vector has two ends.
    pub fn side_of(&self, source: Source, unit: f64) -> i8 {
        let [a, b, c] = self.corners;
        let normal = self.normal();
        let (l, own) = match source {
            Source::Direction(l) => (l, 0.0),
            Source::Point(p) => (p - a, unit.max(ROUNDING * p.abs().max_element())),
        };
        let reach = (b - a).length() + (c - a).length();
        let doubt = 2.0 * (unit * reach * l.length() + own * normal.length());
        let volume = normal.dot(l);
        i8::from(volume > doubt) - i8::from(volume < -doubt)
    }
}

/// Triangles and the boxes around them.
pub struct Solid {
    /// By instance, then by number.
    pub triangles: Vec<Triangle>,
    boxes: Bvh,
}

impl Solid {
    /// Over `triangles`.
    pub fn new(triangles: Vec<Triangle>) -> Self {
        let bounds = |triangle: &Triangle| {
            let mut bounds = Bounds::EMPTY;
            triangle.corners.iter().for_each(|&p| bounds.add(p));
            bounds
        };
        let boxes = Bvh::new(&triangles.iter().map(bounds).collect::<Vec<_>>());
        Self { triangles, boxes }
    }

    /// The nearest of the hits that `counts`, of equally near ones that of the first triangle.
    pub fn nearest(&self, ray: &Ray, counts: impl Fn(&Hit) -> bool) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        self.boxes.walk(ray, f64::INFINITY, |i, t_max| {
            if let Some(hit) = self.hit(i, ray).filter(&counts) {
                let key = |hit: &Hit| (hit.at.t, hit.triangle);
                if best.as_ref().is_none_or(|best| key(&hit) < key(best)) {
                    *t_max = hit.at.t;
                    best = Some(hit);
                }
            }
            true
        });
        best
    }

    /// All that is seen along the ray before `t_max`, in order of the triangles. What the ray meets
    /// on an edge or corner is seen once, not once for each triangle there.
    pub fn all_before(&self, ray: &Ray, t_max: f64) -> Vec<Hit> {
        let mut hits = Vec::new();
        self.boxes.walk(ray, t_max, |i, _| {
            let hit = self.hit(i, ray).filter(|hit| self.is_seen(hit));
            hits.extend(hit.filter(|hit| hit.at.t < t_max));
            true
        });
        hits.sort_by_key(|hit| hit.triangle);
        let mut edges = Vec::new();
        hits.retain(|hit| {
            let Some(edge) = self.edge(hit) else {
                return true;
            };
            let is_new = !edges.contains(&edge);
            edges.push(edge);
            is_new
        });
        hits
    }

    /// The edge or corner that the hit is on: its ends, with the object and the side seen.
    fn edge(&self, hit: &Hit) -> Option<(u32, bool, [DVec3; 2])> {
        let triangle = &self.triangles[hit.triangle as usize];
        let pairs = triangle.corners.into_iter().zip(hit.at.weights);
        let mut ends: Vec<DVec3> = pairs
            .filter(|pair| pair.1 > 0.0)
            .map(|pair| pair.0)
            .collect();
        ends.sort_by(|p, q| {
            p.to_array()
                .partial_cmp(&q.to_array())
                .unwrap_or(Ordering::Equal)
        });
        match ends[..] {
            [p] => Some((triangle.instance, hit.is_front, [p, p])),
            [p, q] => Some((triangle.instance, hit.is_front, [p, q])),
            _ => None,
        }
    }

    /// Whether something stands between `from` and the light. A triangle in whose plane the light
    /// lies (within `unit`, see [`Triangle::side_of`]) does not stand between.
    pub fn is_between(&self, from: DVec3, source: Source, unit: f64) -> bool {
        let (direction, t_max) = match source {
            Source::Direction(direction) => (direction, f64::INFINITY),
            Source::Point(p) => (p - from, 1.0),
        };
        let ray = Ray::new(from, direction);
        let mut found = false;
        self.boxes.walk(&ray, t_max, |i, _| {
            let triangle = &self.triangles[i as usize];
            found = ray.cross(&triangle.corners).is_some_and(|at| {
                at.t > 0.0 && at.t < t_max && triangle.side_of(source, unit) != 0
            });
            !found
        });
        found
    }

    /// Whether the side that is hit is drawn.
    pub fn is_seen(&self, hit: &Hit) -> bool {
        hit.is_front || !self.triangles[hit.triangle as usize].front_only
    }

    fn hit(&self, i: u32, ray: &Ray) -> Option<Hit> {
        let triangle = &self.triangles[i as usize];
        let at = ray.cross(&triangle.corners).filter(|at| at.t > 0.0)?;
        Some(Hit {
            triangle: i,
            at,
            is_front: triangle.is_front(ray.direction),
        })
    }
}
