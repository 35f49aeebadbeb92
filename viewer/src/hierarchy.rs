//! A hierarchy of boxes over numbered things, for rays on the device and for picking. Knows no
//! triangles and no rays: who walks it says which boxes are entered.

use glam::Vec3;

/// A box of the hierarchy, as `wgsl/rays.wgsl` reads it too. The first child of an inner node is
/// the next node.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Node {
    /// Least corner; above `high` if nothing is in it.
    pub low: [f32; 3],
    /// Of an inner node the second child, of a leaf the first place in [`Hierarchy::order`].
    pub first: u32,
    /// Greatest corner.
    pub high: [f32; 3],
    /// Things in a leaf; 0 for an inner node.
    pub count: u32,
}

/// The box of a thing. Coordinates may be infinite; those that are no number hold nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least corner.
    pub low: Vec3,
    /// Greatest corner.
    pub high: Vec3,
}

impl Bounds {
    /// Holds nothing.
    pub const EMPTY: Self = Self {
        low: Vec3::INFINITY,
        high: Vec3::NEG_INFINITY,
    };

    /// Grows to hold `p`.
    pub fn add(&mut self, p: Vec3) {
        self.low = self.low.min(p);
        self.high = self.high.max(p);
    }
}

/// Boxes over things. Its depth is at most 32, as each node is halved.
#[derive(Clone, Debug, Default)]
pub struct Hierarchy {
    /// The root is the first. There is one even if there are no things.
    pub nodes: Vec<Node>,
    /// The numbers of the things, so that those of a leaf stand together.
    pub order: Vec<u32>,
}

/// One who goes through a hierarchy.
pub trait Walk {
    /// How near a box is, if it is to be entered. Of two boxes the nearer is entered first.
    fn enter(&mut self, node: &Node) -> Option<f64>;
    /// Whether what is this near still matters.
    fn is_wanted(&self, nearness: f64) -> bool;
    /// A thing of a box that was entered.
    fn visit(&mut self, thing: u32);
}

struct Item {
    low: Vec3,
    high: Vec3,
    thing: u32,
}

impl Hierarchy {
    /// Over things numbered in the order of their boxes, at most `leaf` in a leaf. Halves at the
    /// median of the longest axis of the middles. Takes n log n time; a node takes 32 bytes, and
    /// there are fewer than 4 n / `leaf` of them.
    pub fn new(boxes: impl IntoIterator<Item = Bounds>, leaf: usize) -> Self {
        let mut items: Vec<Item> = (0..=u32::MAX)
            .zip(boxes)
            .map(|(thing, Bounds { low, high })| Item { low, high, thing })
            .collect();
        let mut nodes = Vec::new();
        // A range to build, and the node whose second child it is.
        let mut open = vec![(0..items.len(), None::<usize>)];
        while let Some((range, parent)) = open.pop() {
            let index = nodes.len();
            if let Some(parent) = parent {
                let parent: &mut Node = &mut nodes[parent];
                parent.first = index as u32;
            }
            let here = &mut items[range.clone()];
            let mut bounds = Bounds::EMPTY;
            let mut middles = Bounds::EMPTY;
            for item in here.iter() {
                bounds.add(item.low);
                bounds.add(item.high);
                middles.add(item.low + item.high);
            }
            let is_leaf = here.len() <= leaf.max(1);
            nodes.push(Node {
                low: bounds.low.to_array(),
                first: range.start as u32,
                high: bounds.high.to_array(),
                count: if is_leaf { here.len() as u32 } else { 0 },
            });
            if is_leaf {
                continue;
            }
            let axis = (middles.high - middles.low).max_position();
            let half = here.len() / 2;
            here.select_nth_unstable_by(half, |a, b| {
                (a.low[axis] + a.high[axis]).total_cmp(&(b.low[axis] + b.high[axis]))
            });
            let middle = range.start + half;
            // The first child is the next node, so it is taken from the stack first.
            open.push((middle..range.end, Some(index)));
            open.push((range.start..middle, None));
        }
        Self {
            nodes,
            order: items.iter().map(|item| item.thing).collect(),
        }
    }

    /// Goes through all boxes that are wanted, nearer ones first.
    pub fn walk(&self, walk: &mut impl Walk) {
        if self.order.is_empty() {
            return;
        }
        let mut open: Vec<(u32, f64)> = Vec::with_capacity(64);
        open.extend(walk.enter(&self.nodes[0]).map(|nearness| (0, nearness)));
        while let Some((at, nearness)) = open.pop() {
            if !walk.is_wanted(nearness) {
                continue;
            }
            let node = &self.nodes[at as usize];
            if node.count > 0 {
                let range = node.first as usize..(node.first + node.count) as usize;
                for &thing in &self.order[range] {
                    walk.visit(thing);
                }
                continue;
            }
            let [a, b] = [at + 1, node.first].map(|child| {
                let nearness = walk.enter(&self.nodes[child as usize]);
                nearness.map(|nearness| (child, nearness))
            });
            // The last is taken first.
            match (a, b) {
                (Some(a), Some(b)) if b.1 < a.1 => open.extend([a, b]),
                _ => open.extend([b, a].into_iter().flatten()),
            }
        }
    }

    /// Bytes of memory.
    pub fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice()) + size_of_val(self.order.as_slice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Enters all boxes that hold a place on X, and notes what is there.
    struct At(f32, Vec<u32>);

    impl Walk for At {
        fn enter(&mut self, node: &Node) -> Option<f64> {
            (node.low[0] <= self.0 && self.0 <= node.high[0]).then_some(0.0)
        }
        fn is_wanted(&self, _: f64) -> bool {
            true
        }
        fn visit(&mut self, thing: u32) {
            self.1.push(thing);
        }
    }

    fn boxed(x: f32, size: f32) -> Bounds {
        Bounds {
            low: Vec3::splat(x),
            high: Vec3::splat(x + size),
        }
    }

    #[test]
    fn each_thing_is_in_one_leaf_and_within_its_boxes() {
        for count in [0_usize, 1, 2, 3, 4, 5, 9, 100, 1000] {
            for leaf in [0, 1, 4, 8] {
                let boxes: Vec<_> = (0..count)
                    .map(|i| boxed((i * 7 % 13) as f32, (i % 5) as f32))
                    .collect();
                let hierarchy = Hierarchy::new(boxes.iter().copied(), leaf);
                let mut order = hierarchy.order.clone();
                order.sort_unstable();
                assert!(order.iter().copied().eq(0..count as u32));
                let leaves = hierarchy.nodes.iter().filter(|node| node.count > 0);
                assert!(
                    leaves
                        .clone()
                        .all(|node| node.count as usize <= leaf.max(1))
                );
                assert_eq!(leaves.map(|node| node.count as usize).sum::<usize>(), count);
                for x in [0.0, 3.5, 12.0] {
                    let mut at = At(x, Vec::new());
                    hierarchy.walk(&mut at);
                    let found = |i: usize| at.1.iter().filter(|&&j| j as usize == i).count();
                    for (i, b) in boxes.iter().enumerate() {
                        let is_there = b.low.x <= x && x <= b.high.x;
                        assert!(found(i) <= 1 && (found(i) == 1 || !is_there), "{i} at {x}");
                    }
                }
            }
        }
    }

    #[test]
    fn any_numbers_end() {
        let strange = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, 0.0];
        let boxes = (0..500).map(|i| boxed(strange[i % 5], strange[i / 5 % 5]));
        let hierarchy = Hierarchy::new(boxes, 2);
        assert_eq!(hierarchy.order.len(), 500);
        hierarchy.walk(&mut At(0.0, Vec::new()));
        // All in one place: halves all the same.
        assert!(
            Hierarchy::new((0..4096).map(|_| boxed(1.0, 1.0)), 1)
                .nodes
                .len()
                < 2 * 4096
        );
    }
}
