//! Closed forms, measured chords, borders and bad input of curves and surfaces. Trims are in
//! `trim_tests.rs`. The oracle evaluates the definition (Cox and de Boor's recurrence), term by
//! term, and shares nothing with the code it judges.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use glam::{DVec3, DVec4};

use super::*;
use crate::test_rng::Rng;

/// The basis function number `i` of a degree by its recursive definition; of the last span the
/// upper end counts.
fn cox_de_boor(knots: &[f64], i: usize, degree: usize, t: f64) -> f64 {
    if degree == 0 {
        let last = knots
            .iter()
            .rposition(|&k| k < knots[knots.len() - 1])
            .unwrap();
        let at_end = t == knots[last + 1] && i == last;
        return f64::from(u8::from((knots[i] <= t && t < knots[i + 1]) || at_end));
    }
    let part = |from: usize, to: usize, x: f64| {
        let width = knots[to] - knots[from];
        if width > 0.0 { x / width } else { 0.0 }
    };
    part(i, i + degree, t - knots[i]) * cox_de_boor(knots, i, degree - 1, t)
        + part(i + 1, i + degree + 1, knots[i + degree + 1] - t)
            * cox_de_boor(knots, i + 1, degree - 1, t)
}

/// A net with its knots, as written.
#[derive(Clone)]
pub(super) struct Net {
    pub points: Vec<DVec4>,
    pub u_count: usize,
    pub u: Vec<f64>,
    pub v: Vec<f64>,
}

impl Net {
    pub fn surface(&self) -> Surface {
        Surface::new(
            self.points.clone(),
            self.u_count,
            self.u.clone(),
            self.v.clone(),
        )
        .unwrap()
    }

    /// The place by definition.
    fn place(&self, u: f64, v: f64) -> DVec3 {
        let v_count = self.points.len() / self.u_count;
        let degrees = (self.u.len() - self.u_count - 1, self.v.len() - v_count - 1);
        let mut h = DVec4::ZERO;
        for (k, point) in self.points.iter().enumerate() {
            let (i, j) = (k % self.u_count, k / self.u_count);
            h += *point
                * cox_de_boor(&self.u, i, degrees.0, u)
                * cox_de_boor(&self.v, j, degrees.1, v);
        }
        h.truncate() / h.w
    }
}

pub(super) fn chord(chord: f64) -> Fineness {
    Fineness {
        chord,
        turn_rad: f64::INFINITY,
        most_points: usize::MAX,
    }
}

pub(super) fn area(mesh: &SurfaceMesh) -> f64 {
    let area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| mesh.points[v as usize]);
        (b - a).cross(c - a).length() / 2.0
    };
    mesh.triangles.iter().map(area).sum()
}

const CIRCLE_KNOTS: [f64; 12] = [0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.];

/// The nine points of a unit circle about z, with weights.
fn circle() -> Vec<DVec4> {
    let corners = [
        (1, 0),
        (1, 1),
        (0, 1),
        (-1, 1),
        (-1, 0),
        (-1, -1),
        (0, -1),
        (1, -1),
        (1, 0),
    ];
    corners
        .iter()
        .enumerate()
        .map(|(k, &(x, y))| {
            let w = if k % 2 == 0 { 1.0 } else { FRAC_1_SQRT_2 };
            DVec4::new(f64::from(x) * w, f64::from(y) * w, 0.0, w)
        })
        .collect()
}

/// A profile of weighted (radius, height, w) points turned about z.
fn turned(profile: &[(f64, f64, f64)], v: Vec<f64>) -> Net {
    let mut points = Vec::new();
    for &(r, z, w) in profile {
        for c in circle() {
            points.push(DVec4::new(c.x * r * w, c.y * r * w, z * c.w * w, c.w * w));
        }
    }
    Net {
        points,
        u_count: 9,
        u: CIRCLE_KNOTS.to_vec(),
        v,
    }
}

fn sphere() -> Net {
    let h = FRAC_1_SQRT_2;
    let profile = [
        (0., -1., 1.),
        (1., -1., h),
        (1., 0., 1.),
        (1., 1., h),
        (0., 1., 1.),
    ];
    turned(&profile, vec![0., 0., 0., 1., 1., 2., 2., 2.])
}

/// Radii 3 and 1.
fn torus() -> Net {
    let around: Vec<(f64, f64, f64)> = circle()
        .iter()
        .map(|c| (3.0 + c.x / c.w, c.y / c.w, c.w))
        .collect();
    turned(&around, CIRCLE_KNOTS.to_vec())
}

/// A random net of bounded degrees with random knots, some repeated, and random weights.
fn random_net(rng: &mut Rng) -> Net {
    let mut axis = || {
        let order = 2 + rng.below(4) as usize;
        let count = order + rng.below(4) as usize;
        let mut knots = vec![0.0; count + order];
        for k in 1..knots.len() {
            let clamped = k < order || k > count;
            let repeat = (order..count).contains(&k)
                && rng.below(3) == 0
                && knots[k + 1 - order] < knots[k - 1];
            let step = if clamped || repeat {
                0.0
            } else {
                0.1 + rng.signed().abs()
            };
            knots[k] = knots[k - 1] + step;
        }
        (count, knots)
    };
    let ((u_count, u), (v_count, v)) = (axis(), axis());
    let rational = rng.below(2) == 0;
    let points = (0..u_count * v_count)
        .map(|k| {
            let p = DVec3::new((k % u_count) as f64, (k / u_count) as f64, 0.0) + rng.vec3();
            let w = if rational {
                1.0 + 0.8 * rng.signed()
            } else {
                1.0
            };
            (p * w).extend(w)
        })
        .collect();
    Net {
        points,
        u_count,
        u,
        v,
    }
}

#[test]
fn places_are_those_of_the_definition() {
    let mut rng = Rng(3);
    let nets = (0..40)
        .map(|_| random_net(&mut rng))
        .chain([sphere(), torus()]);
    for net in nets.collect::<Vec<_>>() {
        let surface = net.surface();
        let ((u0, u1), (v0, v1)) = (surface.domain_u(), surface.domain_v());
        for k in 0..100 {
            let (s, t) = match k {
                0 => (0.0, 0.0),
                1 => (1.0, 1.0),
                _ => (rng.signed().abs(), rng.signed().abs()),
            };
            let (u, v) = (u0 + (u1 - u0) * s, v0 + (v1 - v0) * t);
            let error = surface.point(u, v).p.distance(net.place(u, v));
            assert!(error < 1e-12 * surface.diagonal(), "{u} {v} {error:e}");
        }
    }
}

#[test]
fn basis_functions_sum_to_one_and_their_derivatives_to_zero() {
    let mut rng = Rng(5);
    for _ in 0..50 {
        let net = random_net(&mut rng);
        let knots = knots::Knots::new(net.u.clone(), net.u_count).unwrap();
        for &span in knots.spans() {
            let (low, high) = knots.ends(span);
            for k in 0..=8 {
                let basis = knots.basis(span, low + (high - low) * f64::from(k) / 8.0);
                let sum: f64 = basis.value.iter().sum();
                let slopes: f64 = basis.derivative.iter().sum();
                assert!((sum - 1.0).abs() < 1e-14, "{sum}");
                assert!(slopes.abs() < 1e-11 / (high - low), "{slopes}");
                assert!(basis.value.iter().all(|b| *b >= -1e-15));
            }
        }
    }
}

#[test]
fn derivatives_are_limits_of_differences() {
    let mut rng = Rng(7);
    for _ in 0..40 {
        let net = random_net(&mut rng);
        let surface = net.surface();
        // Mostly inside a piece.
        let ((u0, u1), (v0, v1)) = (surface.domain_u(), surface.domain_v());
        let (u, v) = (u0 + (u1 - u0) * 0.3719, v0 + (v1 - v0) * 0.6143);
        let here = surface.point(u, v);
        let h = 1e-6 * (u1 - u0).min(v1 - v0);
        let du = (net.place(u + h, v) - net.place(u - h, v)) / (2.0 * h);
        let dv = (net.place(u, v + h) - net.place(u, v - h)) / (2.0 * h);
        let scale = 1.0 + here.du.length() + here.dv.length();
        assert!(here.du.distance(du) < 1e-5 * scale, "{} {du}", here.du);
        assert!(here.dv.distance(dv) < 1e-5 * scale, "{} {dv}", here.dv);
    }
}

#[test]
fn round_shapes_are_round_and_have_their_area() {
    let distance_from_ring = |p: DVec3| DVec3::new(p.truncate().length() - 3.0, p.z, 0.0).length();
    type Row<'a> = (&'a str, Net, f64, &'a dyn Fn(DVec3) -> f64);
    let rows: [Row<'_>; 2] = [
        ("sphere", sphere(), 4.0 * PI, &|p: DVec3| p.length()),
        ("torus", torus(), 4.0 * PI * PI * 3.0, &distance_from_ring),
    ];
    for (name, net, true_area, radius) in rows {
        for tolerance in [0.1, 0.01, 0.001] {
            let mesh = net
                .surface()
                .triangles(&chord(tolerance), (&[], &[]), &[])
                .unwrap();
            assert!(
                mesh.points.iter().all(|&p| (radius(p) - 1.0).abs() < 1e-14),
                "{name}"
            );
            let found = area(&mesh);
            // Chords of r (1 - cos) shorten both directions by at most a third of it each.
            assert!(
                found < true_area && found > true_area * (1.0 - 1.5 * tolerance),
                "{name} {found}"
            );
            for t in &mesh.triangles {
                let [a, b, c] = t.map(|v| mesh.points[v as usize]);
                let middle = radius((a + b + c) / 3.0);
                assert!(middle >= 1.0 - tolerance, "{name} {middle}");
            }
        }
    }
}

#[test]
fn a_circle_is_divided_little_more_than_it_must_be() {
    for tolerance in [0.1, 0.01, 0.001, 0.0001] {
        let curve = Curve::new(circle(), CIRCLE_KNOTS.to_vec()).unwrap();
        let line = curve.polyline(&chord(tolerance)).unwrap();
        let fewest = PI / (1.0 - tolerance).acos();
        let count = (line.points.len() - 1) as f64;
        assert!(
            count >= fewest && count < 1.5 * fewest + 4.0,
            "{tolerance}: {count} of {fewest}"
        );
        assert!(line.points.iter().all(|p| (p.length() - 1.0).abs() < 1e-15));
        for pair in line.points.windows(2) {
            assert!(((pair[0] + pair[1]) / 2.0).length() >= 1.0 - tolerance);
        }
        assert_eq!(line.points.first(), line.points.last());
    }
}

/// Every triangle is sampled, and compared with the surface at the same parameters, which is at
/// least as far as the nearest place.
fn largest_error(net: &Net, mesh: &SurfaceMesh) -> f64 {
    let mut worst = 0.0_f64;
    for t in &mesh.triangles {
        let p = t.map(|v| mesh.points[v as usize]);
        let st = t.map(|v| mesh.parameters[v as usize]);
        for (a, b) in [(1, 0), (0, 1), (0, 0), (1, 1), (2, 1), (1, 2), (3, 0)] {
            let (a, b) = (f64::from(a) / 3.0, f64::from(b) / 3.0);
            let c = 1.0 - a - b;
            let q = st[0] * a + st[1] * b + st[2] * c;
            let flat = p[0] * a + p[1] * b + p[2] * c;
            worst = worst.max(net.surface().point(q.x, q.y).p.distance(flat));
        }
    }
    worst
}

#[test]
fn chords_of_random_surfaces_are_kept() {
    let mut rng = Rng(11);
    let mut tightest = 0.0_f64;
    for k in 0..40 {
        let net = random_net(&mut rng);
        let surface = net.surface();
        let tolerance = surface.diagonal() * [0.05, 0.01, 0.002][k % 3];
        let mesh = surface
            .triangles(&chord(tolerance), (&[], &[]), &[])
            .unwrap();
        assert_eq!(mesh.chord_bound, tolerance);
        let error = largest_error(&net, &mesh);
        assert!(error <= tolerance, "{k}: {error} of {tolerance}");
        tightest = tightest.max(error / tolerance);
    }
    assert!(tightest > 0.2, "the bound wastes triangles: {tightest}");
}

/// How many edges belong to one triangle only, places compared bit by bit.
fn open_edges(mesh: &SurfaceMesh) -> usize {
    let mut count = std::collections::BTreeMap::new();
    let key = |v: u32| {
        (mesh.points[v as usize] + DVec3::ZERO)
            .to_array()
            .map(f64::to_bits)
    };
    for t in &mesh.triangles {
        for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            let (a, b) = (key(a), key(b));
            *count.entry((a.min(b), a.max(b))).or_insert(0) += 1;
        }
    }
    count.values().filter(|&&n| n != 2).count()
}

#[test]
fn closed_surfaces_close() {
    // A torus of unclamped knots: rows and columns repeat, and nothing is interpolated.
    let count = 8;
    let ring = |k: usize, n: usize| PI * 2.0 * k as f64 / n as f64;
    let mut points = Vec::new();
    for j in 0..count + 3 {
        for i in 0..count + 3 {
            let (a, b) = (ring(i % count, count), ring(j % count, count));
            let r = 3.0 + b.cos();
            points.push(DVec4::new(r * a.cos(), r * a.sin(), b.sin(), 1.0));
        }
    }
    let knots: Vec<f64> = (0..count + 7).map(|k| k as f64 * 0.1).collect();
    let periodic = Net {
        points,
        u_count: count + 3,
        u: knots.clone(),
        v: knots,
    };
    for (name, net) in [
        ("sphere", sphere()),
        ("torus", torus()),
        ("periodic", periodic),
    ] {
        let mesh = net
            .surface()
            .triangles(&chord(0.01), (&[], &[]), &[])
            .unwrap();
        assert_eq!(open_edges(&mesh), 0, "{name}");
        assert!(mesh.triangles.len() > 100, "{name}");
    }
}

#[test]
fn normals_are_those_of_the_shape_at_poles_and_seams_too() {
    let mesh = sphere()
        .surface()
        .triangles(&chord(0.01), (&[], &[]), &[])
        .unwrap();
    for (p, n) in mesh.points.iter().zip(&mesh.normals) {
        assert!(p.dot(*n) > 1.0 - 1e-8, "{p} {n}");
    }
    let [a, b, c] = mesh.triangles[mesh.triangles.len() / 2].map(|v| mesh.points[v as usize]);
    assert!(
        (b - a).cross(c - a).dot(a) > 0.0,
        "triangles turn as normals do"
    );
}

#[test]
fn edges_of_a_surface_are_sharp_and_joined() {
    // Two planes that meet at a right angle, of degree 1: four points where they meet.
    let points = [
        (0., 0., 0.),
        (1., 0., 0.),
        (1., 0., 1.),
        (0., 1., 0.),
        (1., 1., 0.),
        (1., 1., 1.),
    ];
    let net = Net {
        points: points
            .iter()
            .map(|&(x, y, z)| DVec4::new(x, y, z, 1.0))
            .collect(),
        u_count: 3,
        u: vec![0., 0., 1., 2., 2.],
        v: vec![0., 0., 1., 1.],
    };
    let mesh = net
        .surface()
        .triangles(&chord(0.01), (&[], &[]), &[])
        .unwrap();
    assert_eq!((mesh.points.len(), mesh.triangles.len()), (8, 4));
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|v| mesh.points[v as usize]);
        let flat = (b - a).cross(c - a).normalize();
        assert!(
            t.iter()
                .all(|&v| mesh.normals[v as usize].distance(flat) < 1e-12)
        );
    }
    // A knot as often as the order tears: two squares that do not meet.
    let mut torn = net.clone();
    torn.points.splice(
        1..2,
        [DVec4::new(1., 0., 0., 1.), DVec4::new(1., 0., 5., 1.)],
    );
    torn.points.splice(
        5..6,
        [DVec4::new(1., 1., 0., 1.), DVec4::new(1., 1., 5., 1.)],
    );
    torn.u_count = 4;
    torn.u = vec![0., 0., 1., 1., 2., 2.];
    let mesh = torn
        .surface()
        .triangles(&chord(0.01), (&[], &[]), &[])
        .unwrap();
    let lowest = |t: &[u32; 3]| t.map(|v| mesh.points[v as usize].z);
    assert_eq!(area(&mesh), 1.0 + 4.0);
    assert!(mesh.triangles.iter().all(|t| {
        let z = lowest(t);
        z == [0.0; 3] || z.iter().all(|&z| z >= 1.0)
    }));
}

#[test]
fn a_saddle_is_divided_by_its_twist() {
    let z = [0.0, 1.0, 1.0, 0.0];
    let points = (0..4).map(|k| DVec4::new(f64::from(k % 2), f64::from(k / 2), z[k as usize], 1.0));
    let net = Net {
        points: points.collect(),
        u_count: 2,
        u: vec![0., 0., 1., 1.],
        v: vec![0., 0., 1., 1.],
    };
    let mesh = net
        .surface()
        .triangles(&chord(0.01), (&[], &[]), &[])
        .unwrap();
    let error = largest_error(&net, &mesh);
    assert!(error <= 0.01 && error > 0.004, "{error}");
}

#[test]
fn turns_divide_what_is_small_beside_the_chord() {
    let curve = Curve::new(circle(), CIRCLE_KNOTS.to_vec()).unwrap();
    let rows = [
        (0.5, PI / 16.0, 32),
        (2.0, f64::INFINITY, 4),
        (1e3, PI / 16.0, 4),
    ];
    for (chord, turn_rad, segments) in rows {
        let fineness = Fineness {
            chord,
            turn_rad,
            most_points: usize::MAX,
        };
        let line = curve.polyline(&fineness).unwrap();
        assert_eq!(line.points.len() - 1, segments, "{chord} {turn_rad}");
    }
}

#[test]
fn bad_input_is_refused() {
    use NurbsError as E;
    let net = Net {
        points: vec![DVec4::W; 9],
        u_count: 3,
        u: vec![0., 0., 0., 1., 1., 1.],
        v: vec![0., 0., 0., 1., 1., 1.],
    };
    let with = |change: &dyn Fn(&mut Net)| {
        let mut net = net.clone();
        change(&mut net);
        Surface::new(net.points, net.u_count, net.u, net.v).err()
    };
    type Row<'a> = (Option<E>, &'a dyn Fn(&mut Net));
    let rows: [Row<'_>; 16] = [
        (None, &|_| {}),
        (Some(E::Order), &|n| n.u.truncate(4)),
        (Some(E::Order), &|n| n.v = vec![0.0; 2]),
        (Some(E::Order), &|n| n.u.push(1.0)),
        (Some(E::PointCount), &|n| n.points.truncate(8)),
        (Some(E::PointCount), &|n| n.points.clear()),
        (Some(E::PointCount), &|n| n.u_count = 0),
        (Some(E::DecreasingKnots), &|n| n.u[3] = -1.0),
        (Some(E::RepeatedKnots), &|n| n.u = vec![0.0; 6]),
        (Some(E::RepeatedKnots), &|n| n.u[3] = 0.0),
        (Some(E::Magnitude), &|n| n.u[3] = f64::NAN),
        (Some(E::Magnitude), &|n| n.points[4].y = f64::INFINITY),
        (Some(E::Magnitude), &|n| n.points[4].y = f64::NAN),
        (Some(E::Weight), &|n| n.points[4].w = 0.0),
        (Some(E::Weight), &|n| n.points[4].w = -1.0),
        (Some(E::TooLarge), &|n| {
            n.points = vec![DVec4::W; MAX_CONTROL_POINTS + 3]
        }),
    ];
    for (k, (expected, change)) in rows.into_iter().enumerate() {
        assert_eq!(with(change), expected, "row {k}");
    }
    assert_eq!(
        with(&|n| n.points.iter_mut().for_each(|h| h.w = -1.0)),
        None
    );
    for bad in [0.0, -1.0, f64::NAN] {
        let refused = net.surface().triangles(&chord(bad), (&[], &[]), &[]);
        assert_eq!(refused.err(), Some(E::Tolerance));
    }
    assert_eq!(
        Curve::new(vec![DVec4::W; 3], vec![0.0; 3]).err(),
        Some(E::Order)
    );
}

#[test]
fn a_tolerance_beyond_the_limits_is_widened() {
    let mesh = sphere()
        .surface()
        .triangles(&chord(1e-14), (&[f64::NAN], &[]), &[])
        .unwrap();
    assert!(mesh.chord_bound > 1e-9, "{}", mesh.chord_bound);
    assert!(9 * mesh.points.len() <= 2 * MAX_VERTEX_WORK);
    let line = Curve::new(circle(), CIRCLE_KNOTS.to_vec()).unwrap();
    let line = line.polyline(&chord(1e-300)).unwrap();
    assert!(line.points.len() <= MAX_POLYLINE_POINTS + 1 && line.chord_bound > 1e-300);
    // A number of points asked for.
    for most_points in [0, 5, 100, 5000] {
        let few = Fineness {
            most_points,
            ..chord(1e-6)
        };
        let mesh = sphere().surface().triangles(&few, (&[], &[]), &[]).unwrap();
        let cells = mesh.triangles.len() / 2;
        assert!(
            cells <= most_points.max(8) && cells >= most_points / 8,
            "{cells}"
        );
        assert!(mesh.chord_bound > 1e-6 && largest_error(&sphere(), &mesh) <= mesh.chord_bound);
    }
    // Numbers near the limits.
    let huge = Net {
        points: circle()
            .iter()
            .map(|h| *h * 1e-29 + (h.truncate() * 1e44).extend(0.0))
            .collect(),
        u_count: 3,
        u: vec![0., 0., 0., 1e45, 1e45, 1e45],
        v: vec![-1e45, -1e45, -1e45, 1e-45, 1e-45, 1e-45],
    };
    let mesh = huge
        .surface()
        .triangles(&chord(1.0), (&[], &[]), &[])
        .unwrap();
    assert!(mesh.points.iter().all(|p| p.is_finite()));
    assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-9));
}

#[test]
fn lines_asked_for_are_lines_of_the_grid() {
    let net = sphere();
    let mesh = net
        .surface()
        .triangles(&chord(0.5), (&[0.3, 2.9, 9.0], &[1.7]), &[])
        .unwrap();
    let has = |f: &dyn Fn(glam::DVec2) -> bool| mesh.parameters.iter().any(|&q| f(q));
    assert!(has(&|q| q.x == 0.3) && has(&|q| q.x == 2.9) && has(&|q| q.y == 1.7));
    assert!(!has(&|q| q.x == 9.0));
}
