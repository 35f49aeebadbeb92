//! One polynomial piece of a curve or surface: its Bezier points, and bounds of its derivatives.
//! A curve is a surface of degree 0 in `v`. Parameters run from 0 to 1.

use glam::{DVec3, DVec4, Vec4Swizzles};

use super::MAX_ORDER;
use super::knots::Knots;

/// Halvings in each direction before rational pieces are bounded. The bounds take extremes of the
/// parts of a quotient one by one; on a quarter of the piece these are nearly the same.
const HALVINGS: usize = 2;

/// What a Bezier point is made of: factors of the span's control points.
pub(super) type Row = [f64; MAX_ORDER];

/// Homogeneous control points of a piece, `u` fastest: `(p + 1) * (q + 1)` for degrees `p`, `q`.
#[derive(Clone)]
pub(super) struct Patch {
    p: usize,
    q: usize,
    points: Vec<DVec4>,
}

/// Bounds of the lengths of a piece's derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Bounds {
    pub u: f64,
    pub v: f64,
    pub uu: f64,
    pub uv: f64,
    pub vv: f64,
    /// How far the control polygons along `u` and along `v` turn, in radians.
    pub turn_u_rad: f64,
    pub turn_v_rad: f64,
}

/// Multiplications that bounding a piece of these degrees takes, roughly.
pub(super) fn bound_work(p: usize, q: usize) -> usize {
    let points = (p + 1) * (q + 1);
    4 * points * (p + q + 2) + (1 << (2 * HALVINGS)) * points * (p + q + 16)
}

/// The Bezier combinations of a span, one row for each point.
pub(super) fn combinations(knots: &Knots, span: usize) -> Vec<Row> {
    let mut rows = vec![[0.0; MAX_ORDER]; knots.order()];
    for (k, row) in rows.iter_mut().enumerate() {
        knots.bezier_combination(span, k, row);
    }
    rows
}

impl Patch {
    /// From rows of combinations and the control points they combine: point (i, j) is `at(i, j)`.
    pub fn new(u: &[Row], v: &[Row], at: impl Fn(usize, usize) -> DVec4) -> Self {
        let (nu, nv) = (u.len(), v.len());
        let combine = |row: &Row, points: &mut dyn Iterator<Item = DVec4>| {
            points
                .zip(row)
                .fold(DVec4::ZERO, |sum, (p, &factor)| sum + p * factor)
        };
        let mut along_u = Vec::with_capacity(nu * nv);
        for j in 0..nv {
            along_u.extend(
                u.iter()
                    .map(|row| combine(row, &mut (0..nu).map(|i| at(i, j)))),
            );
        }
        let mut points = Vec::with_capacity(nu * nv);
        for row in v {
            points.extend((0..nu).map(|i| combine(row, &mut (0..nv).map(|j| along_u[j * nu + i]))));
        }
        Self {
            p: nu - 1,
            q: nv - 1,
            points,
        }
    }

    fn at(&self, i: usize, j: usize) -> DVec4 {
        self.points[j * (self.p + 1) + i]
    }

    /// The control points with their weights divided out.
    pub fn projected(&self) -> impl Iterator<Item = DVec3> {
        self.points.iter().map(|h| h.xyz() / h.w)
    }

    /// Bounds of the derivatives all over the piece.
    pub fn bounds(&self) -> Bounds {
        let rational = self.points.iter().any(|h| h.w != self.points[0].w);
        let mut bounds = if rational {
            let mut parts = vec![self.clone()];
            for _ in 0..HALVINGS {
                parts = parts.iter().flat_map(Self::halves_u).collect();
                parts = parts.iter().flat_map(Self::halves_v).collect();
            }
            let mut worst = Bounds::default();
            for part in &parts {
                let b = part.own_bounds();
                worst.u = worst.u.max(b.u);
                worst.v = worst.v.max(b.v);
                worst.uu = worst.uu.max(b.uu);
                worst.uv = worst.uv.max(b.uv);
                worst.vv = worst.vv.max(b.vv);
            }
            // Back from the parameters of the parts.
            let per_part = (1_u32 << HALVINGS) as f64;
            worst.u *= per_part;
            worst.v *= per_part;
            worst.uu *= per_part * per_part;
            worst.uv *= per_part * per_part;
            worst.vv *= per_part * per_part;
            worst
        } else {
            self.own_bounds()
        };
        (bounds.turn_u_rad, bounds.turn_v_rad) = self.turns_rad();
        bounds
    }

    /// With `S = A / w` and all points moved so that the piece's middle is the origin:
    /// `S_u = (A_u - w_u S) / w`, `S_uu = (A_uu - 2 w_u S_u - w_uu S) / w`, and
    /// `S_uv = (A_uv - w_u S_v - w_v S_u - w_uv S) / w`. Each part is bounded by its own Bezier
    /// points (convex hull, positive weights), which are differences of the piece's.
    fn own_bounds(&self) -> Bounds {
        let mut low = DVec3::INFINITY;
        let mut high = DVec3::NEG_INFINITY;
        for p in self.projected() {
            low = low.min(p);
            high = high.max(p);
        }
        let center = low * 0.5 + high * 0.5;
        let min_w = self.points.iter().fold(f64::INFINITY, |m, h| m.min(h.w));
        let moved: Vec<DVec4> = self
            .points
            .iter()
            .map(|h| (h.xyz() - center * h.w).extend(h.w))
            .collect();
        let radius = moved
            .iter()
            .fold(0.0_f64, |m, h| m.max(h.xyz().length() / h.w));
        let u = difference(&moved, self.p, self.q, Along::U);
        let v = difference(&moved, self.p, self.q, Along::V);
        let uu = difference(&u, self.p.saturating_sub(1), self.q, Along::U);
        let vv = difference(&v, self.p, self.q.saturating_sub(1), Along::V);
        let uv = difference(&u, self.p.saturating_sub(1), self.q, Along::V);
        let [u, v, uu, uv, vv] = [u, v, uu, uv, vv].map(|d| extremes(&d));
        let s_u = (u.0 + u.1 * radius) / min_w;
        let s_v = (v.0 + v.1 * radius) / min_w;
        Bounds {
            u: s_u,
            v: s_v,
            uu: (uu.0 + 2.0 * u.1 * s_u + uu.1 * radius) / min_w,
            uv: (uv.0 + u.1 * s_v + v.1 * s_u + uv.1 * radius) / min_w,
            vv: (vv.0 + 2.0 * v.1 * s_v + vv.1 * radius) / min_w,
            ..Bounds::default()
        }
    }

    /// The largest total turn of the control polygons along `u`, and along `v`.
    fn turns_rad(&self) -> (f64, f64) {
        let (nu, nv) = (self.p + 1, self.q + 1);
        let at = |i: usize, j: usize| {
            let h = self.at(i, j);
            h.xyz() / h.w
        };
        let rows = (0..nv).map(|j| turn_rad((0..nu).map(|i| at(i, j))));
        let columns = (0..nu).map(|i| turn_rad((0..nv).map(|j| at(i, j))));
        (rows.fold(0.0, f64::max), columns.fold(0.0, f64::max))
    }

    fn halves_u(&self) -> [Self; 2] {
        self.halves(self.q + 1, self.p, |line, k| line * (self.p + 1) + k)
    }

    fn halves_v(&self) -> [Self; 2] {
        self.halves(self.p + 1, self.q, |line, k| k * (self.p + 1) + line)
    }

    /// De Casteljau's scheme at the middle, on each line of `degree + 1` points.
    fn halves(
        &self,
        lines: usize,
        degree: usize,
        index: impl Fn(usize, usize) -> usize,
    ) -> [Self; 2] {
        let (mut low, mut high) = (self.clone(), self.clone());
        for line in 0..lines {
            let mut run = [DVec4::ZERO; MAX_ORDER];
            for (k, slot) in run.iter_mut().enumerate().take(degree + 1) {
                *slot = self.points[index(line, k)];
            }
            for step in 0..=degree {
                low.points[index(line, step)] = run[0];
                high.points[index(line, degree - step)] = run[degree - step];
                for k in 0..degree - step {
                    run[k] = (run[k] + run[k + 1]) * 0.5;
                }
            }
        }
        [low, high]
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Along {
    U,
    V,
}

/// The Bezier points of a derivative along one parameter; none for degree 0.
fn difference(points: &[DVec4], p: usize, q: usize, along: Along) -> Vec<DVec4> {
    let width = p + 1;
    let (degree, nu, nv, step) = match along {
        Along::U => (p, p, q + 1, 1),
        Along::V => (q, p + 1, q, width),
    };
    let mut out = Vec::with_capacity(nu * nv);
    if points.len() < width * (q + 1) {
        return out;
    }
    for j in 0..nv {
        for i in 0..nu {
            let k = j * width + i;
            out.push((points[k + step] - points[k]) * degree as f64);
        }
    }
    out
}

/// The largest length of the first three components, and of the fourth.
fn extremes(points: &[DVec4]) -> (f64, f64) {
    points.iter().fold((0.0, 0.0), |(a, w), h| {
        (f64::max(a, h.xyz().length()), f64::max(w, h.w.abs()))
    })
}

/// The sum of the angles between successive legs; legs without length are passed over.
fn turn_rad(points: impl Iterator<Item = DVec3>) -> f64 {
    let mut total = 0.0;
    let mut last: Option<DVec3> = None;
    let mut leg: Option<DVec3> = None;
    for p in points {
        if let Some(step) = last.and_then(|q| (p - q).try_normalize()) {
            if let Some(before) = leg {
                total += before.cross(step).length().atan2(before.dot(step));
            }
            leg = Some(step);
        }
        last = Some(p);
    }
    total
}
