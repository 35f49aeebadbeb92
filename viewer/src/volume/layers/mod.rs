//! An upper bound of the count that any point can get, so that a stencil buffer with few bits
//! does not wrap. Not an exact maximum.
//!
//! Along a ray from the light the count only grows, so the most that a point on the ray can
//! get is the number `N` of casting triangles that the ray meets. `N` is a function on the
//! sphere of directions from the light (on a plane, for a light at infinity) that is constant
//! but for jumps at silhouette sides, by one at each. So on a convex cell of directions
//!
//! ```text
//! N <= N(reference point of the cell) + sides that touch the cell and have the reference
//!                                       point on their outer side
//! ```
//!
//! because the straight way from the reference point to any other crosses a side at most
//! once, and inwards only from its outer side. Cells are the faces of a cube around the light,
//! or the box of the projection; the cell with the largest bound is cut until that
//! bound is small enough or a budget is used up. The reference value of a cell is found by
//! walking from that of the parent or a neighbour. Rounding only makes the bound larger: a
//! crossing that is not certain counts, and a side that is near a cell touches it.

mod cell;
mod roots;

use std::collections::BinaryHeap;

use glam::{DAffine3, DVec4};

use crate::volume::layers::cell::{Cell, walk};
use crate::volume::layers::roots::{Root, roots};
use crate::volume::light::Light;
use crate::volume::topology::CasterMesh;

/// A caster whose volume [`layer_bound`] looks at.
#[derive(Clone, Copy, Debug)]
pub struct LayerCaster<'a> {
    /// The mesh.
    pub mesh: &'a CasterMesh,
    /// The signs of its triangles, from [`crate::volume::facing()`].
    pub signs: &'a [i8],
    /// The sides by the silhouette method, from [`crate::volume::extract()`].
    pub sides: &'a [u32],
    /// From the mesh's frame to that of the light given to [`layer_bound`].
    pub frame_from_local: DAffine3,
}

/// How far beside a cell a side still touches it, relative to the cell's coordinates: what a
/// device may be off by in some four roundings of `f32`.
const DEVICE_ERROR: f64 = 1.0 / (1 << 20) as f64;

/// The most that sides are looked at for each side, and in all: about a second's work.
const LOOKS_PER_SIDE: usize = 256;
const MAX_LOOKS: usize = 1 << 23;

/// Sides for each part that a cell is cut into.
const SIDES_PER_PART: f64 = 2.0;

/// A number that no point's count exceeds, in the volumes of all these casters of one light
/// together. Refined until it is at most `limit`, or until that is found to be impossible or
/// too much work; so a result above `limit` may be far too large, and 0 asks for all that can
/// be done.
///
/// The light is in the frame that `frame_from_local` leads to. 0 for a light that is not
/// finite, because it casts nothing.
#[must_use]
pub fn layer_bound(casters: &[LayerCaster<'_>], light: DVec4, limit: u32) -> u32 {
    let casting: usize = casters
        .iter()
        .flat_map(|caster| caster.signs)
        .filter(|&&s| s != 0)
        .count();
    // More than all casting triangles is not possible; few of them need no search.
    let most = u32::try_from(casting).unwrap_or(u32::MAX);
    let Some(light) = Light::new(light) else {
        return 0;
    };
    if most <= limit {
        return most;
    }
    refine(&roots(casters, light), limit).min(most)
}

/// A cell with what touches it.
struct Node {
    bound: u64,
    /// The index of the root that the cell is in.
    root: usize,
    cell: Cell,
    /// Not less than `N` at the cell's reference point.
    reference: u64,
    /// Indices of sides of the root.
    touching: Vec<u32>,
}

impl Node {
    /// The whole of a root.
    fn whole(number: usize, root: &Root) -> Self {
        let mut node = Self {
            bound: 0,
            root: number,
            cell: root.cell,
            reference: root.reference,
            touching: (0..).zip(&root.sides).map(|(i, _)| i).collect(),
        };
        node.bound = node.bound_of(root);
        node
    }

    /// Parts along each axis when the cell is cut: so many that few sides touch each part,
    /// but not so many that long sides are looked at too often.
    fn divisions(&self, root: &Root) -> usize {
        let count = self.touching.len();
        let mut divisions = ((count as f64 / SIDES_PER_PART).sqrt() as usize).clamp(2, 256);
        while divisions > 2 && self.looks(root, divisions) > count * 8 {
            divisions /= 2;
        }
        divisions
    }

    /// How many pairs of a side and a part have to be looked at.
    fn looks(&self, root: &Root, divisions: usize) -> usize {
        let sides = self.touching.iter().map(|&i| &root.sides[i as usize]);
        let spans = sides.map(|side| self.cell.span(divisions, side, root.margin));
        spans
            .map(|[columns, rows]| columns.len() * rows.len())
            .sum()
    }

    fn cut(&self, root: &Root, divisions: usize) -> Vec<Self> {
        let side = |&i: &u32| &root.sides[i as usize];
        // Row by row, every second row backwards: so neighbours in order are neighbours.
        let place = |index: usize| {
            let (row, column) = (index / divisions, index % divisions);
            [
                if row % 2 == 0 {
                    column
                } else {
                    divisions - 1 - column
                },
                row,
            ]
        };
        let mut parts: Vec<Self> = (0..divisions * divisions)
            .map(|index| Self {
                bound: 0,
                root: self.root,
                cell: self.cell.part(divisions, place(index)),
                reference: 0,
                touching: Vec::new(),
            })
            .collect();
        for i in &self.touching {
            let [columns, rows] = self.cell.span(divisions, side(i), root.margin);
            for row in rows {
                for column in columns.clone() {
                    let column = if row % 2 == 0 {
                        column
                    } else {
                        divisions - 1 - column
                    };
                    let part = &mut parts[row * divisions + column];
                    if part.cell.may_touch(side(i), root.margin) {
                        part.touching.push(*i);
                    }
                }
            }
        }
        // The straight way to the first part is in this cell; the ones after it are in two
        // neighbours.
        let mut at = self.cell.reference();
        let mut reference = self.reference;
        let mut passed = self.touching.clone();
        for (index, part) in parts.iter_mut().enumerate() {
            if index > 0 {
                passed.extend(&part.touching);
                passed.sort_unstable();
                passed.dedup();
            }
            let next = part.cell.reference();
            reference = walk(reference, passed.iter().map(side), at, next);
            part.reference = reference;
            part.bound = part.bound_of(root).min(self.bound);
            at = next;
            passed.clone_from(&part.touching);
        }
        parts
    }

    fn bound_of(&self, root: &Root) -> u64 {
        let at = self.cell.reference();
        let sides = self.touching.iter().map(|&i| &root.sides[i as usize]);
        let inwards = sides.filter(|side| side.plane.side_of(at) >= 0);
        self.reference + inwards.map(|side| u64::from(side.count)).sum::<u64>()
    }
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Node {}

impl PartialOrd for Node {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Node {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.bound.cmp(&other.bound)
    }
}

/// Cuts the cell with the largest bound until that is small enough.
fn refine(roots: &[Root], limit: u32) -> u32 {
    let limit = u64::from(limit);
    let total: usize = roots.iter().map(|root| root.sides.len()).sum();
    let mut looks_left = total.saturating_mul(LOOKS_PER_SIDE).min(MAX_LOOKS);
    let nodes = roots.iter().enumerate();
    let mut open: BinaryHeap<Node> = nodes.map(|(i, root)| Node::whole(i, root)).collect();
    // The largest bound among cells that need not be cut.
    let mut settled = 0;
    while let Some(node) = open.pop() {
        let root = &roots[node.root];
        let size = (node.cell.max - node.cell.min).max_element();
        let small = size < 4.0 * root.margin || node.touching.is_empty();
        let divisions = node.divisions(root);
        let looks = node.looks(root, divisions);
        if node.bound <= limit || small || looks > looks_left {
            settled = settled.max(node.bound);
            break;
        }
        looks_left -= looks;
        for part in node.cut(root, divisions) {
            if part.bound > limit {
                open.push(part);
            } else {
                settled = settled.max(part.bound);
            }
        }
    }
    u32::try_from(settled).unwrap_or(u32::MAX)
}
