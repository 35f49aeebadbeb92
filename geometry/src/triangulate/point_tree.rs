//! A k-d tree over points of the plane, some of them active, that tells whether one is
//! in a triangle. The points are fixed; activity changes.
//!
//! A tree rather than a grid: its cost does not depend on how the points are spread.

use super::plane::orient;
use glam::DVec2;

/// Points per leaf, at most.
const LEAF_SIZE: usize = 8;

/// More than the levels of a tree of `u32::MAX` points.
const MAX_LEVELS: usize = 32;

#[derive(Clone, Copy)]
struct Node {
    min: DVec2,
    max: DVec2,
    /// Range in `order`.
    start: u32,
    end: u32,
    active: u32,
}

const NO_NODE: Node = Node {
    min: DVec2::INFINITY,
    max: DVec2::NEG_INFINITY,
    start: 0,
    end: 0,
    active: 0,
};

/// See the module. Nodes are numbered as in a binary heap: the root is 1, the children of `k`
/// are `2k` and `2k + 1`.
#[derive(Default)]
pub(super) struct PointTree {
    nodes: Vec<Node>,
    order: Vec<u32>,
    leaf_of_point: Vec<u32>,
}

impl PointTree {
    /// Starts afresh with these points.
    pub(super) fn build(&mut self, points: &[DVec2], is_active: impl Fn(u32) -> bool) {
        let leaf_count = points.len().div_ceil(LEAF_SIZE).next_power_of_two();
        self.order.clear();
        self.order.extend(0..points.len() as u32);
        self.leaf_of_point.clear();
        self.leaf_of_point.resize(points.len(), 0);
        self.nodes.clear();
        self.nodes.resize(2 * leaf_count, NO_NODE);
        self.nodes[1].end = points.len() as u32;
        // Parents come before their children.
        for k in 1..2 * leaf_count {
            let range = self.nodes[k].start as usize..self.nodes[k].end as usize;
            let members = &mut self.order[range];
            for &i in members.iter() {
                self.nodes[k].min = self.nodes[k].min.min(points[i as usize]);
                self.nodes[k].max = self.nodes[k].max.max(points[i as usize]);
            }
            if k < leaf_count {
                self.split(k, points);
            } else {
                for &i in members.iter() {
                    self.leaf_of_point[i as usize] = k as u32;
                    self.nodes[k].active += u32::from(is_active(i));
                }
            }
        }
        for k in (1..leaf_count).rev() {
            self.nodes[k].active = self.nodes[2 * k].active + self.nodes[2 * k + 1].active;
        }
    }

    /// Divides a node's points evenly along the longer side of its box.
    fn split(&mut self, k: usize, points: &[DVec2]) {
        let Node {
            min,
            max,
            start,
            end,
            ..
        } = self.nodes[k];
        let size = max - min;
        let axis = usize::from(size.y > size.x);
        let members = &mut self.order[start as usize..end as usize];
        let half = members.len() / 2;
        if half > 0 {
            let key = |i: u32| points[i as usize][axis];
            members
                .select_nth_unstable_by(half, |&i, &j| key(i).total_cmp(&key(j)).then(i.cmp(&j)));
        }
        let middle = start + half as u32;
        self.nodes[2 * k].start = start;
        self.nodes[2 * k].end = middle;
        self.nodes[2 * k + 1].start = middle;
        self.nodes[2 * k + 1].end = end;
    }

    /// Activates or deactivates a point that was not, or was, active.
    pub(super) fn set_active(&mut self, point: u32, active: bool) {
        let mut k = self.leaf_of_point[point as usize] as usize;
        while k > 0 {
            let count = &mut self.nodes[k].active;
            *count = if active {
                *count + 1
            } else {
                count.saturating_sub(1)
            };
            k /= 2;
        }
    }

    /// Whether `accept` is true of a point in a counter-clockwise triangle. It is asked about
    /// points near the triangle, inactive ones included. Adds the nodes and points looked at
    /// to `steps`.
    pub(super) fn any_near(
        &self,
        triangle: [DVec2; 3],
        steps: &mut u64,
        mut accept: impl FnMut(u32) -> bool,
    ) -> bool {
        let leaf_count = self.nodes.len() / 2;
        // Of each level at most one node waits, and of the last two.
        let mut waiting = [0_usize; MAX_LEVELS + 1];
        waiting[0] = 1;
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let k = waiting[count];
            let node = &self.nodes[k];
            *steps += 1;
            if node.active == 0 || is_box_outside(node.min, node.max, triangle) {
                continue;
            }
            if k < leaf_count {
                waiting[count] = 2 * k + 1;
                waiting[count + 1] = 2 * k;
                count += 2;
                continue;
            }
            let members = &self.order[node.start as usize..node.end as usize];
            *steps += members.len() as u64;
            if members.iter().any(|&i| accept(i)) {
                return true;
            }
        }
        false
    }
}

/// Whether one of the triangle's bounds or edges has the whole box strictly outside.
fn is_box_outside(min: DVec2, max: DVec2, [a, b, c]: [DVec2; 3]) -> bool {
    if min.cmpgt(a.max(b).max(c)).any() || max.cmplt(a.min(b).min(c)).any() {
        return true;
    }
    [(a, b), (b, c), (c, a)].into_iter().any(|(p, q)| {
        // The corner of the box that is farthest to the left of the edge.
        let corner = DVec2::new(
            if p.y < q.y { min.x } else { max.x },
            if p.x < q.x { max.y } else { min.y },
        );
        orient(p, q, corner) < 0.0
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_rng::Rng;

    #[test]
    fn finds_an_active_point_if_there_is_one() {
        let mut rng = Rng(13);
        let mut tree = PointTree::default();
        for round in 0..200 {
            // Few values, so that points coincide and lie on edges.
            let mut random_point = || {
                (rng.vec3() * if round % 2 == 0 { 5.0 } else { 50.0 })
                    .round()
                    .truncate()
            };
            let points: Vec<DVec2> = (0..1 + round).map(|_| random_point()).collect();
            let mut triangle = [random_point(), random_point(), random_point()];
            let cross = |[a, b, c]: [DVec2; 3]| (b - a).perp_dot(c - a);
            if cross(triangle) < 0.0 {
                triangle.reverse();
            }
            if cross(triangle) == 0.0 {
                continue;
            }
            let [a, b, c] = triangle;
            let is_inside = |i: u32| {
                let p = points[i as usize];
                cross([a, b, p]) >= 0.0 && cross([b, c, p]) >= 0.0 && cross([c, a, p]) >= 0.0
            };
            let mut active: Vec<bool> = points.iter().map(|p| p.x > 0.0).collect();
            tree.build(&points, |i| active[i as usize]);
            for i in 0..=2 * points.len() {
                let accept = |i: u32| active[i as usize] && is_inside(i);
                let expected = (0..points.len() as u32).any(accept);
                let mut steps = 0;
                let found = tree.any_near(triangle, &mut steps, accept);
                assert_eq!(found, expected, "{triangle:?} {points:?}");
                // With nothing active it costs one look at the root.
                assert!(steps > 0 && (active.contains(&true) || steps == 1));
                // Activate all, then deactivate all.
                let (i, on) = (i % points.len(), i < points.len());
                if active[i] != on {
                    active[i] = on;
                    tree.set_active(i as u32, on);
                }
            }
        }
    }
}
