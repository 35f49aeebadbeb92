//! Ear clipping of weakly simple polygons, exact and in near-linear time for usual input.
//!
//! Source: Meisters, *Polygons have ears* (1975); the treatment of bridges and coincident
//! points follows Held, *FIST* (2001), but decides by exact predicates.

use super::plane::orient;
use super::point_tree::PointTree;
use super::ring::{Ring, is_void, turn};
use glam::DVec2;

/// The work budget: points and tree nodes looked at per vertex of the polygon. Spirals,
/// combs, fractals and sheets of holes of 100,000 vertices need 30 to 240, spikes of random
/// length around one centre 400; large tangles of random crossing edges exhaust it.
pub const STEPS_PER_VERTEX: u64 = 512;

/// Below this many vertices, looking at each is quicker than a tree.
const TREE_MIN_LEN: usize = 48;

const NONE: u32 = u32::MAX;

/// How clipping ended.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Clipped {
    /// Every triangle is an ear.
    All,
    /// Some corners had to be cut although something was in the way.
    ByForce,
    /// The budget ran out and the rest was fanned.
    OutOfBudget,
}

/// A vertex of the ring while it is being clipped.
#[derive(Clone, Copy)]
struct Vertex {
    prev: u32,
    /// `NONE` once it is clipped.
    next: u32,
    /// The round in which a neighbour was clipped.
    touched: u32,
    is_queued: bool,
    /// As in [`Ring`]. Vertices that do not turn left can be in the way of others; clipped
    /// ones are marked as turning left.
    turn: i8,
}

/// Scratch memory of the clipping.
#[derive(Default)]
pub(super) struct EarClipper {
    vertices: Vec<Vertex>,
    /// The corners to test in this round and in the next.
    queue: Vec<u32>,
    next_queue: Vec<u32>,
    tree: PointTree,
}

impl EarClipper {
    /// Appends the triangles of a ring of at least three points.
    pub(super) fn clip(&mut self, ring: &Ring, out: &mut Vec<[u32; 3]>) -> Clipped {
        let n = ring.len() as u32;
        self.vertices.clear();
        self.vertices.extend((0..n).map(|i| Vertex {
            prev: if i == 0 { n - 1 } else { i - 1 },
            next: if i + 1 == n { 0 } else { i + 1 },
            touched: 0,
            is_queued: false,
            turn: ring.turns[i as usize],
        }));
        self.next_queue.clear();
        let has_tree = ring.len() >= TREE_MIN_LEN;
        if has_tree {
            let turns = &ring.turns;
            self.tree.build(&ring.points, |i| turns[i as usize] <= 0);
        }
        let clipping = Clipping {
            ring,
            out,
            scratch: self,
            has_tree,
            remaining: ring.len(),
            head: 0,
            cursor: 0,
            round: 0,
            has_progressed: false,
            steps: 0,
        };
        clipping.run()
    }
}

/// One run over one ring.
struct Clipping<'a> {
    ring: &'a Ring,
    out: &'a mut Vec<[u32; 3]>,
    scratch: &'a mut EarClipper,
    has_tree: bool,
    remaining: usize,
    /// Some vertex that is not clipped.
    head: u32,
    /// Where in the queue.
    cursor: usize,
    round: u32,
    /// Whether a vertex was clipped since all were queued.
    has_progressed: bool,
    steps: u64,
}

impl Clipping<'_> {
    fn run(mut self) -> Clipped {
        let max_steps = STEPS_PER_VERTEX.saturating_mul(self.ring.len() as u64);
        let mut end = Clipped::All;
        self.queue_all();
        while self.remaining >= 3 {
            if self.steps > max_steps {
                self.fan_rest();
                return Clipped::OutOfBudget;
            }
            if let Some(b) = self.pop() {
                self.visit(b);
            } else if self.has_progressed {
                // Corners are tested again when a neighbour is clipped; whether something else
                // left their way shows only now.
                self.queue_all();
            } else {
                end = Clipped::ByForce;
                if !self.force() {
                    self.fan_rest();
                    break;
                }
            }
        }
        end
    }

    fn at(&self, v: u32) -> &Vertex {
        &self.scratch.vertices[v as usize]
    }

    fn at_mut(&mut self, v: u32) -> &mut Vertex {
        &mut self.scratch.vertices[v as usize]
    }

    fn point(&self, v: u32) -> DVec2 {
        self.ring.points[v as usize]
    }

    fn emit(&mut self, corners: [u32; 3]) {
        self.out.push(corners.map(|v| self.ring.source[v as usize]));
    }

    fn queue_all(&mut self) {
        self.has_progressed = false;
        self.round += 1;
        self.cursor = 0;
        self.scratch.queue.clear();
        let mut v = self.head;
        for _ in 0..self.remaining {
            self.at_mut(v).is_queued = true;
            self.scratch.queue.push(v);
            v = self.at(v).next;
        }
        self.steps += self.remaining as u64;
    }

    fn enqueue(&mut self, v: u32) {
        if !self.at(v).is_queued {
            self.at_mut(v).is_queued = true;
            self.scratch.next_queue.push(v);
        }
    }

    /// The next vertex to visit. In each round, only one of two neighbours is clipped: going
    /// on with the other at once would make slivers that all meet in one vertex.
    fn pop(&mut self) -> Option<u32> {
        loop {
            let Some(&v) = self.scratch.queue.get(self.cursor) else {
                if self.scratch.next_queue.is_empty() {
                    return None;
                }
                std::mem::swap(&mut self.scratch.queue, &mut self.scratch.next_queue);
                self.scratch.next_queue.clear();
                self.cursor = 0;
                self.round += 1;
                continue;
            };
            self.cursor += 1;
            self.steps += 1;
            if self.at(v).next == NONE {
                continue;
            }
            if self.at(v).touched == self.round {
                self.scratch.next_queue.push(v);
                continue;
            }
            self.at_mut(v).is_queued = false;
            return Some(v);
        }
    }

    /// Clips a vertex if it is an ear.
    fn visit(&mut self, b: u32) {
        if self.at(b).turn > 0 && !self.is_blocked(b) {
            self.clip(b);
        }
    }

    /// Whether some vertex keeps a left-turning corner from being an ear.
    fn is_blocked(&mut self, b: u32) -> bool {
        let Vertex {
            prev: a, next: c, ..
        } = *self.at(b);
        let corner = [a, b, c].map(|v| self.point(v));
        let mut steps = 0;
        let is_blocked = if self.has_tree && self.remaining >= TREE_MIN_LEN {
            let blocks = |v| self.blocks(v, corner);
            self.scratch.tree.any_near(corner, &mut steps, blocks)
        } else {
            steps = self.remaining as u64;
            std::iter::successors(Some(self.at(c).next), |&v| Some(self.at(v).next))
                .take_while(|&v| v != a)
                .any(|v| self.blocks(v, corner))
        };
        self.steps += steps;
        is_blocked
    }

    /// Whether a vertex is in the way of cutting off the triangle of a left-turning corner.
    ///
    /// It suffices to ask vertices that do not turn left: if the boundary enters the triangle
    /// at all, such a vertex is the one nearest to `b`. A vertex on the edges `a b` and `b c`
    /// is in the way only if the boundary goes on from there into the triangle, as it does
    /// not along bridges; one on the new edge `c a` always is. One at `a` or `c` never is:
    /// whatever enters there has its own vertices inside.
    fn blocks(&self, v: u32, [a, b, c]: [DVec2; 3]) -> bool {
        if self.at(v).turn > 0 {
            return false;
        }
        let p = self.point(v);
        if p == a || p == c {
            return false;
        }
        let (ab, bc, ca) = (orient(a, b, p), orient(b, c, p), orient(c, a, p));
        if ab < 0.0 || bc < 0.0 || ca < 0.0 {
            return false;
        }
        let Vertex { prev, next, .. } = *self.at(v);
        [prev, next].into_iter().any(|w| {
            let q = self.point(w);
            (ab > 0.0 || orient(a, b, q) > 0.0) && (bc > 0.0 || orient(b, c, q) > 0.0)
        })
    }

    /// Emits the triangle of a vertex and removes it, and then what encloses nothing. That
    /// must not wait: both edges of a spike can look like the sides of an ear.
    fn clip(&mut self, b: u32) {
        let Vertex {
            prev: mut a,
            next: mut c,
            ..
        } = *self.at(b);
        self.emit([a, b, c]);
        self.remove(b);
        while self.remaining >= 3 {
            if self.is_void(a) {
                let before = self.at(a).prev;
                self.remove(a);
                a = before;
            } else if self.is_void(c) {
                let after = self.at(c).next;
                self.remove(c);
                c = after;
            } else {
                break;
            }
        }
    }

    fn is_void(&self, v: u32) -> bool {
        let Vertex {
            prev, next, turn, ..
        } = *self.at(v);
        turn == 0 && is_void(self.point(prev), self.point(v), self.point(next))
    }

    /// Takes a vertex out of the ring.
    fn remove(&mut self, b: u32) {
        let Vertex {
            prev: a, next: c, ..
        } = *self.at(b);
        self.set_turn(b, 1);
        self.at_mut(b).next = NONE;
        self.at_mut(a).next = c;
        self.at_mut(c).prev = a;
        self.head = c;
        self.remaining -= 1;
        self.has_progressed = true;
        for v in [a, c] {
            let round = self.round;
            self.at_mut(v).touched = round;
            let Vertex { prev, next, .. } = *self.at(v);
            self.set_turn(v, turn(self.point(prev), self.point(v), self.point(next)));
            if self.at(v).turn > 0 {
                self.enqueue(v);
            }
        }
    }

    fn set_turn(&mut self, v: u32, turn: i8) {
        let was_in_the_way = self.at(v).turn <= 0;
        let is_in_the_way = turn <= 0;
        self.at_mut(v).turn = turn;
        if self.has_tree && was_in_the_way != is_in_the_way {
            self.scratch.tree.set_active(v, is_in_the_way);
        }
    }

    /// Cuts off the next left-turning corner, whatever is in the way. False if there is none.
    fn force(&mut self) -> bool {
        let mut b = self.head;
        for _ in 0..self.remaining {
            self.steps += 1;
            let Vertex { next, turn, .. } = *self.at(b);
            if turn > 0 {
                self.clip(b);
                return true;
            }
            b = next;
        }
        false
    }

    /// Fans what is left, triangles that turn right included.
    fn fan_rest(&mut self) {
        let a = self.head;
        let mut b = self.at(a).next;
        while self.at(b).next != a {
            let c = self.at(b).next;
            if turn(self.point(a), self.point(b), self.point(c)) != 0 {
                self.emit([a, b, c]);
            }
            b = c;
        }
    }
}
