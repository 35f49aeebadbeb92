//! A hierarchy of boxes over triangles: binned splits by the surface area heuristic (Wald, "On fast
//! Construction of SAH-based Bounding Volume Hierarchies", 2007), in halves where that fails or
//! goes too deep.

use glam::DVec3;

use super::ray::Ray;

/// Boxes over numbered things.
pub struct Bvh {
    nodes: Vec<Node>,
    /// The numbers, so that those of a leaf stand together.
    order: Vec<u32>,
}

#[derive(Clone, Copy)]
struct Node {
    bounds: Bounds,
    /// A leaf's first place in `order`, or the first of two children.
    first: u32,
    /// Things in a leaf; 0 for an inner node.
    count: u32,
}

/// An axis-aligned box.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Least corner.
    pub low: DVec3,
    /// Greatest corner.
    pub high: DVec3,
}

impl Bounds {
    /// Holds nothing.
    pub const EMPTY: Self = Self {
        low: DVec3::INFINITY,
        high: DVec3::NEG_INFINITY,
    };

    /// Grows to hold `p`.
    pub fn add(&mut self, p: DVec3) {
        self.low = self.low.min(p);
        self.high = self.high.max(p);
    }

    /// Grows to hold `other`.
    pub fn join(&mut self, other: &Self) {
        self.low = self.low.min(other.low);
        self.high = self.high.max(other.high);
    }

    /// The middle.
    pub fn centre(&self) -> DVec3 {
        self.low.midpoint(self.high)
    }

    fn half_area(&self) -> f64 {
        let size = (self.high - self.low).max(DVec3::ZERO);
        size.x * size.y + size.y * size.z + size.z * size.x
    }
}

const LEAF: usize = 4;
const BINS: usize = 16;
/// Deeper than this, nodes are halved: with 2^32 things the depth stays below 48 + 32.
const SAH_DEPTH: u32 = 48;
const STACK: usize = 96;

impl Bvh {
    /// Over the boxes of things, numbered in their order.
    pub fn new(boxes: &[Bounds]) -> Self {
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = vec![leaf(boxes, &order, 0)];
        let mut open = vec![(0_usize, 0_u32)];
        while let Some((at, depth)) = open.pop() {
            let (first, count) = (nodes[at].first as usize, nodes[at].count as usize);
            if count <= LEAF {
                continue;
            }
            let own = &mut order[first..first + count];
            let left = split(boxes, own, depth);
            let child = nodes.len();
            nodes.push(leaf(boxes, &own[..left], first));
            nodes.push(leaf(boxes, &own[left..], first + left));
            nodes[at].first = child as u32;
            nodes[at].count = 0;
            open.extend([(child, depth + 1), (child + 1, depth + 1)]);
        }
        Self { nodes, order }
    }

    /// Offers the things whose boxes the ray meets between 0 and `t_max`, roughly front to back.
    /// `offer` may lower `t_max`, and ends the walk by giving false.
    pub fn walk(&self, ray: &Ray, t_max: f64, mut offer: impl FnMut(u32, &mut f64) -> bool) {
        let inverse = ray.direction.recip();
        let enter = |node: &Node, t_max: f64| enter(&node.bounds, ray.origin, inverse, t_max);
        let mut t_max = t_max;
        let mut stack = [(0_u32, f64::INFINITY); STACK];
        let mut height = 0;
        if let Some(t) = enter(&self.nodes[0], t_max) {
            stack[0] = (0, t);
            height = 1;
        }
        while height > 0 {
            height -= 1;
            let (at, t) = stack[height];
            if t > t_max {
                continue;
            }
            let node = &self.nodes[at as usize];
            if node.count > 0 {
                let range = node.first as usize..(node.first + node.count) as usize;
                for &thing in &self.order[range] {
                    if !offer(thing, &mut t_max) {
                        return;
                    }
                }
                continue;
            }
            let children = [node.first, node.first + 1];
            let [a, b] = children.map(|i| enter(&self.nodes[i as usize], t_max).map(|t| (i, t)));
            let (near, far) = match (a, b) {
                (Some(a), Some(b)) if b.1 < a.1 => (Some(b), Some(a)),
                _ => (a, b),
            };
            for entry in [far, near].into_iter().flatten() {
                stack[height] = entry;
                height += 1;
            }
        }
    }
}

/// Where the ray enters the box, if it meets it between 0 and `t_max`.
fn enter(bounds: &Bounds, origin: DVec3, inverse: DVec3, t_max: f64) -> Option<f64> {
    // Three roundings (difference, reciprocal, product) on each side; that the far side alone is
    // moved out is enough (Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013).
    const FAR: f64 = 1.0 + 4.0 * f64::EPSILON;
    let a = (bounds.low - origin).to_array();
    let b = (bounds.high - origin).to_array();
    let inverse = inverse.to_array();
    let (mut near, mut far) = (0.0_f64, t_max);
    for axis in 0..3 {
        // 0 times infinity is NaN: a ray within a side's plane. min and max then take the other
        // operand, so that the side cuts nothing off.
        let (t, s) = (a[axis] * inverse[axis], b[axis] * inverse[axis]);
        let (first, last) = if inverse[axis] < 0.0 { (s, t) } else { (t, s) };
        near = near.max(first);
        far = far.min(last * FAR);
    }
    (near <= far).then_some(near)
}

fn leaf(boxes: &[Bounds], own: &[u32], first: usize) -> Node {
    let mut bounds = Bounds::EMPTY;
    for &i in own {
        bounds.join(&boxes[i as usize]);
    }
    Node {
        bounds,
        first: first as u32,
        count: own.len() as u32,
    }
}

/// Orders `own` so that the first part, whose length is given, goes to one child.
fn split(boxes: &[Bounds], own: &mut [u32], depth: u32) -> usize {
    let mut centres = Bounds::EMPTY;
    for &i in own.iter() {
        centres.add(boxes[i as usize].centre());
    }
    let size = centres.high - centres.low;
    let axis = size.max_position();
    let along = |i: u32| boxes[i as usize].centre()[axis];
    if depth < SAH_DEPTH && size[axis] > 0.0 {
        let scale = BINS as f64 / size[axis];
        let bin = |i: u32| (((along(i) - centres.low[axis]) * scale) as usize).min(BINS - 1);
        let end = best_bin(boxes, own, bin);
        let mut left = 0;
        for i in 0..own.len() {
            if bin(own[i]) <= end {
                own.swap(i, left);
                left += 1;
            }
        }
        if left > 0 && left < own.len() {
            return left;
        }
    }
    let half = own.len() / 2;
    own.select_nth_unstable_by(half, |&a, &b| along(a).total_cmp(&along(b)).then(a.cmp(&b)));
    half
}

/// The last bin of the first child, where the sum of areas times counts is least.
fn best_bin(boxes: &[Bounds], own: &[u32], bin: impl Fn(u32) -> usize) -> usize {
    let mut bins = [(Bounds::EMPTY, 0.0); BINS];
    for &i in own {
        let (bounds, count) = &mut bins[bin(i)];
        bounds.join(&boxes[i as usize]);
        *count += 1.0;
    }
    let mut above = [0.0; BINS];
    let mut sum = (Bounds::EMPTY, 0.0);
    for i in (1..BINS).rev() {
        sum.0.join(&bins[i].0);
        sum.1 += bins[i].1;
        above[i] = sum.0.half_area() * sum.1;
    }
    let mut best = (f64::INFINITY, 0);
    sum = (Bounds::EMPTY, 0.0);
    for i in 0..BINS - 1 {
        sum.0.join(&bins[i].0);
        sum.1 += bins[i].1;
        let cost = sum.0.half_area() * sum.1 + above[i + 1];
        if cost < best.0 {
            best = (cost, i);
        }
    }
    best.1
}
