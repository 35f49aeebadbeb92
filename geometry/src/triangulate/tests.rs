//! Triangulation of simple, degenerate and hostile loops, judged by areas and counts.

use super::*;
use crate::test_rng::Rng;
use std::f64::consts::TAU;

/// Checks the triangles against the loop by vectors alone: each turns the loop's way, and
/// the areas add up. Returns their number.
#[track_caller]
pub(super) fn check_cover(points: &[DVec3], triangles: &[[u32; 3]]) -> usize {
    let area_of = |corners: &[DVec3]| {
        let mut sum = DVec3::ZERO;
        for i in 0..corners.len() {
            let j = (i + 1) % corners.len();
            sum += (corners[i] - corners[0]).cross(corners[j] - corners[0]);
        }
        sum
    };
    let whole = area_of(points);
    // Along the axis of projection, where the tests' polygons may be bent.
    let axis = whole.abs().max_position();
    let sum: f64 = triangles
        .iter()
        .map(|t| {
            let area = area_of(&t.map(|i| points[i as usize]))[axis] / whole[axis];
            assert!(area > 0.0, "{t:?} has share {area:e} of {points:?}");
            area
        })
        .sum();
    assert!(
        (sum - 1.0).abs() < 1e-9,
        "the areas sum to {sum} of {points:?}"
    );
    triangles.len()
}

fn flat(points: &[(f64, f64)]) -> Vec<DVec3> {
    points.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect()
}

fn triangulate(points: &[DVec3]) -> (Outcome, Vec<[u32; 3]>) {
    let mut out = Vec::new();
    let outcome = Triangulator::new().triangulate(points, &mut out);
    (outcome, out)
}

#[test]
fn small_polygons() {
    let square = [(0., 0.), (1., 0.), (1., 1.), (0., 1.)];
    type Row<'a> = (&'a [(f64, f64)], &'a [[u32; 3]]);
    let rows: [Row<'_>; 13] = [
        (&[(0., 0.), (1., 0.), (0., 1.)], &[[0, 1, 2]]),
        (
            &[(0., 0.), (1., 0.), (0., 1.), (0., 0.), (0., 0.)],
            &[[0, 1, 2]],
        ),
        (&square, &[[0, 1, 2], [0, 2, 3]]),
        // A clockwise loop keeps its order: its normal points the other way.
        (
            &[(0., 0.), (0., 1.), (1., 1.), (1., 0.)],
            &[[0, 1, 2], [0, 2, 3]],
        ),
        // Concave four-gons, with the dent at each corner.
        (
            &[(1., 1.), (0., 4.), (0., 0.), (4., 0.)],
            &[[0, 1, 2], [0, 2, 3]],
        ),
        (
            &[(0., 4.), (0., 0.), (4., 0.), (1., 1.)],
            &[[1, 2, 3], [1, 3, 0]],
        ),
        (
            &[(0., 0.), (4., 0.), (1., 1.), (0., 4.)],
            &[[0, 1, 2], [0, 2, 3]],
        ),
        // A triangle with a straight corner, at each place.
        (
            &[(0., 0.), (1., 0.), (2., 0.), (0., 2.)],
            &[[1, 2, 3], [1, 3, 0]],
        ),
        (
            &[(1., 0.), (2., 0.), (0., 2.), (0., 0.)],
            &[[0, 1, 2], [0, 2, 3]],
        ),
        // A repeated point and a spike leave a triangle.
        (&[(0., 0.), (1., 0.), (1., 0.), (0., 1.)], &[[0, 1, 3]]),
        (&[(0., 0.), (3., 0.), (1., 0.), (0., 1.)], &[[0, 2, 3]]),
        // Convex: fans of the first point that makes no empty triangle.
        (
            &[(0., 0.), (2., 0.), (3., 1.), (2., 2.), (0., 2.)],
            &[[0, 1, 2], [0, 2, 3], [0, 3, 4]],
        ),
        (
            &[(0., 0.), (1., 0.), (2., 0.), (2., 2.), (0., 2.)],
            &[[1, 2, 3], [1, 3, 4], [1, 4, 0]],
        ),
    ];
    for (points, expected) in rows {
        let points = flat(points);
        // Along each axis, both ways up, and at sizes whose products leave the range of f64.
        for turn in 0..3 {
            for scale in [1.0, 1e-200, 1e200, 3.0] {
                let turned = |p: DVec3| match turn {
                    0 => p,
                    1 => DVec3::new(p.z, p.x, p.y),
                    _ => DVec3::new(p.y, p.z, p.x),
                };
                let points: Vec<DVec3> = points.iter().map(|&p| turned(p) * scale).collect();
                let (outcome, triangles) = triangulate(&points);
                assert_eq!(outcome, Outcome::Triangulated, "{points:?}");
                assert_eq!(triangles, expected, "{points:?}");
            }
        }
    }
}

#[test]
fn degenerate_loops() {
    let line: Vec<(f64, f64)> = (0..9)
        .map(|i| (f64::from(i * 4 % 9), f64::from(i * 8 % 18)))
        .collect();
    for points in [
        flat(&[]),
        flat(&[(0., 0.)]),
        flat(&[(0., 0.), (1., 0.)]),
        flat(&[(0., 0.), (1., 1.), (2., 2.)]),
        flat(&[(0., 0.), (1., 1.), (1., 1.)]),
        flat(&[(0., 0.), (1., 0.), (0., 0.), (1., 0.)]),
        flat(&[(0., 0.), (1., 0.), (2., 0.), (3., 0.)]),
        flat(&[(1., 2.); 6]),
        flat(&line),
        flat(&[(0., 0.), (1., 0.), (1., 1.), (1., 0.), (0., 0.), (0., 1.)]),
        flat(&[(0., 0.), (1., 0.), (f64::NAN, 1.)]),
        flat(&[(0., 0.), (1., 0.), (1., f64::INFINITY), (0., 1.)]),
        flat(&[
            (0., 0.),
            (1., 0.),
            (1., 1.),
            (0., 1.),
            (f64::NEG_INFINITY, 0.),
        ]),
    ] {
        assert_eq!(
            triangulate(&points),
            (Outcome::Degenerate, vec![]),
            "{points:?}"
        );
    }
}

#[test]
fn slivers_are_kept() {
    // Heights of the last bit: not zero, though no area computed in f64 shows it reliably.
    let up = 1.0_f64.next_up();
    for (points, count) in [
        (flat(&[(0., 1.), (1., 1.), (0.5, up)]), 1),
        (flat(&[(0., 1.), (1., 1.), (1., up), (0., up)]), 2),
        (
            flat(&[(0., 1.), (0.5, 1.), (1., 1.), (1., up), (0., up)]),
            3,
        ),
    ] {
        let mut reversed = points.clone();
        reversed.reverse();
        for points in [points, reversed] {
            let (outcome, triangles) = triangulate(&points);
            assert_eq!(outcome, Outcome::Triangulated, "{points:?}");
            assert_eq!(check_cover(&points, &triangles), count);
        }
    }
}

#[test]
fn flat_slivers_turn_the_right_way() {
    // Two chains of whole numbers one unit apart on a steep line: an area that products of
    // f64 cannot show, not even its sign.
    let mut rng = Rng(12);
    for round in 0..200 {
        let k = 3 + rng.below(300) as usize;
        let lower: Vec<[i64; 2]> = (0..k)
            .map(|i| {
                [
                    i as i64 * (1 << 30) + rng.below(1 << 30) as i64,
                    rng.below(1 << 52) as i64,
                ]
            })
            .collect();
        let mut whole = lower.clone();
        whole.extend(lower.iter().rev().map(|&[x, y]| [x, y + 1]));
        if round % 2 == 1 {
            whole.reverse();
        }
        let sign = if round % 2 == 1 { -1 } else { 1 };
        let points: Vec<DVec3> = whole
            .iter()
            .map(|p| DVec3::new(p[0] as f64, p[1] as f64, 0.0))
            .collect();
        let (outcome, triangles) = triangulate(&points);
        assert_eq!(outcome, Outcome::Triangulated, "{points:?}");
        assert_eq!(triangles.len(), points.len() - 2);
        for t in triangles {
            let [a, b, c] = t.map(|i| whole[i as usize].map(i128::from));
            let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            assert!(area * sign > 0, "{t:?} {points:?}");
        }
    }
}

#[test]
fn repetitions_and_spikes_leave_a_convex_fan() {
    let octagon: Vec<DVec3> = star(8, |_| 1.0);
    let out_and_back = |p: DVec3, tip: DVec3| vec![p, tip, p];
    for extra in [
        vec![octagon[0], octagon[0]],
        out_and_back(octagon[0], octagon[0] * 2.0),
        out_and_back(octagon[0], DVec3::ZERO),
        // A spike with a kink, and one over a neighbouring edge.
        vec![
            octagon[0],
            octagon[0] * 2.0,
            DVec3::Y * 5.0,
            octagon[0] * 2.0,
            octagon[0],
        ],
        out_and_back(octagon[0], octagon[1]),
    ] {
        let mut points = extra;
        points.extend(&octagon[1..]);
        for _ in 0..points.len() {
            points.rotate_left(1);
            let (outcome, triangles) = triangulate(&points);
            assert_eq!(outcome, Outcome::Triangulated, "{points:?}");
            assert_eq!(check_cover(&points, &triangles), 6);
            assert!(
                triangles.iter().all(|t| t[0] == triangles[0][0]),
                "{triangles:?}"
            );
        }
    }
}

/// A polygon with a corner in each of `n` directions at distances given by `radius`.
fn star(n: usize, mut radius: impl FnMut(usize) -> f64) -> Vec<DVec3> {
    (0..n)
        .map(|i| {
            let (sin, cos) = (TAU * i as f64 / n as f64).sin_cos();
            DVec3::new(cos, sin, 0.0) * radius(i)
        })
        .collect()
}

/// A corridor that winds inwards `turns` times, with `n` points.
pub(super) fn spiral(n: usize, turns: f64) -> Vec<DVec3> {
    let wall = |i: usize, offset: f64| {
        let t = i as f64 / (n / 2) as f64;
        let (sin, cos) = (TAU * turns * t).sin_cos();
        DVec3::new(cos, sin, 0.0) * (turns * (1.0 - t) + 1.0 + offset)
    };
    let outer = (0..n / 2).map(|i| wall(i, 0.25));
    let inner = (0..n - n / 2).rev().map(|i| wall(i, -0.25));
    outer.chain(inner).collect()
}

/// Teeth that all reach down to near one base line.
fn comb(n: usize) -> Vec<DVec3> {
    let mut points = vec![DVec3::new(0.0, -1.0, 0.0), DVec3::new(n as f64, -1.0, 0.0)];
    points.extend(
        (0..n)
            .rev()
            .map(|i| DVec3::new(i as f64, if i % 2 == 0 { 9.0 } else { 0.0 }, 0.0)),
    );
    points
}

#[test]
fn simple_polygons_are_covered() {
    let mut rng = Rng(8);
    let mut random_star = |n| star(n, |_| rng.signed().abs() + 0.01);
    let polygons = [
        star(7, |_| 1.0),
        star(10, |i| 1.0 + (i % 2) as f64),
        star(1000, |i| 1.0 + (i % 2) as f64),
        random_star(20),
        random_star(47),
        random_star(48),
        random_star(300),
        random_star(5000),
        spiral(60, 2.0),
        spiral(3000, 20.0),
        comb(30),
        comb(2000),
    ];
    let tilt = glam::DQuat::from_xyzw(0.5, 0.5, -0.1, 0.7).normalize();
    for points in polygons {
        let bent: Vec<DVec3> = points
            .iter()
            .map(|&p| p + DVec3::Z * 0.05 * (p.x * 7.0).sin())
            .collect();
        let far: Vec<DVec3> = points
            .iter()
            .map(|&p| tilt * p + DVec3::splat(1e5))
            .collect();
        let mut reversed = points.clone();
        reversed.reverse();
        for points in [points, bent, far, reversed] {
            let (outcome, triangles) = triangulate(&points);
            assert_eq!(outcome, Outcome::Triangulated, "{} points", points.len());
            assert_eq!(check_cover(&points, &triangles), points.len() - 2);
        }
    }
}

#[test]
fn crossing_loops_are_told() {
    for (points, triangle_count) in [
        // A bow-tie: one lobe each way.
        (flat(&[(0., 0.), (1., 1.), (1., 0.), (0., 1.)]), 2),
        (flat(&[(0., 0.), (2., 2.), (2., 0.), (0., 1.)]), 2),
        // Pentagram: every turn is to the left, but it goes round twice.
        (
            star(5, |_| 1.0)
                .iter()
                .cycle()
                .step_by(2)
                .take(5)
                .copied()
                .collect(),
            3,
        ),
        // All ears, but round twice.
        (
            flat(&[(-4., -3.), (4., 1.), (4., -5.), (1., 0.), (4., -1.)]),
            2,
        ),
        // Two squares, one after the other, around the same centre.
        (
            flat(&[
                (0., 0.),
                (3., 0.),
                (3., 3.),
                (0., 3.),
                (1., 1.2),
                (2., 1.1),
                (2.1, 2.),
                (0.9, 2.),
            ]),
            6,
        ),
    ] {
        let (outcome, triangles) = triangulate(&points);
        assert_eq!(outcome, Outcome::SelfIntersecting, "{points:?}");
        assert_eq!(triangles.len(), triangle_count, "{points:?}");
    }
}

#[test]
fn hostile_loops_end() {
    let mut rng = Rng(9);
    let mut triangulator = Triangulator::new();
    let mut out = Vec::new();
    for round in 0..3000_u64 {
        let n = 3 + rng.below(if round % 100 == 0 { 600 } else { 30 });
        // Few values, so that points coincide and line up.
        let values = 1 + rng.below(6) as i32;
        let points: Vec<DVec3> = (0..n)
            .map(|_| {
                (rng.vec3() * f64::from(values)).round() * DVec3::new(1.0, 1.0, (round % 2) as f64)
            })
            .collect();
        out.clear();
        let outcome = triangulator.triangulate(&points, &mut out);
        assert_eq!(outcome == Outcome::Degenerate, out.is_empty(), "{points:?}");
        assert!(out.len() <= points.len() - 2, "{points:?}");
        assert!(out.iter().flatten().all(|&i| u64::from(i) < n));
        // What earlier polygons left behind changes nothing.
        assert_eq!(triangulate(&points), (outcome, out.clone()), "{points:?}");
    }
}

#[test]
fn the_budget_ends_tangles() {
    let mut rng = Rng(10);
    let tangle: Vec<DVec3> = (0..5000).map(|_| rng.vec3()).collect();
    let (outcome, triangles) = triangulate(&tangle);
    assert_eq!(outcome, Outcome::BudgetExceeded);
    assert!(triangles.len() <= tangle.len() - 2);
}
