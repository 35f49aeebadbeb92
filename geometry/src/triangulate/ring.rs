//! The projected loop without repeated points and spikes; its turns; the convex case.

use super::plane::{Projection, is_between, orient};
use glam::{DVec2, DVec3};

/// A closed loop in the plane. Neighbours differ, and no edge goes back on the one before.
#[derive(Default)]
pub(super) struct Ring {
    pub(super) points: Vec<DVec2>,
    /// The position of each point in the polygon given.
    pub(super) source: Vec<u32>,
    /// The turn at each point: 1 left, 0 straight on, -1 right.
    pub(super) turns: Vec<i8>,
}

/// The exact turn at `b`: 1 left, -1 right, 0 straight on or back.
pub(super) fn turn(a: DVec2, b: DVec2, c: DVec2) -> i8 {
    let sign = orient(a, b, c);
    i8::from(sign > 0.0) - i8::from(sign < 0.0)
}

/// Whether `b` can be left out without changing what the loop encloses: it repeats a
/// neighbour, or it is the tip of a spike. Points in the middle of a straight line are not.
pub(super) fn is_void(a: DVec2, b: DVec2, c: DVec2) -> bool {
    a == b || b == c || (turn(a, b, c) == 0 && !is_between(a, b, c))
}

impl Ring {
    pub(super) fn len(&self) -> usize {
        self.points.len()
    }

    /// Takes over a loop of at most `u32::MAX` points.
    pub(super) fn fill(&mut self, points: &[DVec3], projection: &Projection) {
        self.points.clear();
        self.source.clear();
        for (i, &p) in points.iter().enumerate() {
            self.push(projection.apply(p), i as u32);
        }
        self.close();
        let n = self.len();
        let at = |i: usize| self.points[i % n];
        self.turns.clear();
        self.turns
            .extend((0..n).map(|i| turn(at(i + n - 1), at(i), at(i + 1))));
    }

    fn push(&mut self, p: DVec2, source: u32) {
        while let [.., a, b] = self.points[..]
            && b != p
            && is_void(a, b, p)
        {
            self.pop();
        }
        if self.points.last() != Some(&p) {
            self.points.push(p);
            self.source.push(source);
        }
    }

    fn pop(&mut self) {
        self.points.pop();
        self.source.pop();
    }

    /// Removes repeated points and spikes where the end meets the start.
    fn close(&mut self) {
        let mut start = 0;
        while self.len() - start >= 3
            && let [first, second, ..] = self.points[start..]
            && let [.., a, b] = self.points[start..]
        {
            if is_void(a, b, first) {
                self.pop();
            } else if is_void(b, first, second) {
                start += 1;
            } else {
                break;
            }
        }
        if self.len() - start < 3 {
            start = self.len();
        }
        self.points.drain(..start);
        self.source.drain(..start);
    }

    /// Mirrors the plane, which reverses the loop's orientation but not its order.
    pub(super) fn reflect(&mut self) {
        for p in &mut self.points {
            *p = DVec2::new(p.y, p.x);
        }
        for turn in &mut self.turns {
            *turn = -*turn;
        }
    }

    /// How many times the direction of travel goes round counter-clockwise: 1 for a simple
    /// counter-clockwise polygon, 2 for a pentagram, 0 for a figure of eight.
    ///
    /// Counted exactly, as the turns that sweep over the direction just left of the x axis;
    /// no turn is a half turn.
    pub(super) fn turning_number(&self) -> i64 {
        let n = self.len();
        // Whether the direction from one point to the next is strictly between 0 and pi.
        let is_upward = |i: usize| {
            let (p, q) = (self.points[i % n], self.points[(i + 1) % n]);
            p.y < q.y
        };
        let mut upward_before = is_upward(n - 1);
        let mut count = 0;
        for (i, &turn) in self.turns.iter().enumerate() {
            let upward = is_upward(i);
            match (turn, upward_before, upward) {
                (1, false, true) => count += 1,
                (-1, true, false) => count -= 1,
                _ => {}
            }
            upward_before = upward;
        }
        count
    }

    /// If no turn is a right turn, the first point whose fan has no empty triangle; a loop
    /// that also has turning number 1 is convex, and the fan triangulates it.
    ///
    /// A fan's triangle is empty when the fan's point is on the line of an edge that does not
    /// end in it, so both neighbours of the point must be corners.
    pub(super) fn convex_fan_start(&self) -> Option<usize> {
        if self.turns.contains(&-1) {
            return None;
        }
        let n = self.len();
        (0..n).find(|&i| self.turns[(i + 1) % n] > 0 && self.turns[(i + n - 1) % n] > 0)
    }

    /// The fan of the point at `start`.
    pub(super) fn fan(&self, start: usize) -> impl Iterator<Item = [u32; 3]> {
        let n = self.len();
        let source = move |i: usize| self.source[(start + i) % n];
        (1..n - 1).map(move |i| [source(0), source(i), source(i + 1)])
    }
}
