//! Trimmed surfaces: areas known in closed form, borders, and loops that are wrong.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use glam::{DVec2, DVec3, DVec4};

use super::tests::{Net, area, chord};
use super::*;
use crate::test_rng::Rng;

/// The square from 0 to 4, bent to `z = bend * x^2`, in parameters from 0 to 1, of a few spans.
fn sheet(bend: f64) -> Surface {
    let mut points = Vec::new();
    for y in [0.0, 4.0] {
        // Bezier points of z = x^2 over 0..4, with a knot in the middle.
        for (x, z) in [(0.0, 0.0), (1.0, 0.0), (3.0, 8.0), (4.0, 16.0)] {
            points.push(DVec4::new(x, y, z * bend, 1.0));
        }
    }
    Net {
        points,
        u_count: 4,
        u: vec![0., 0., 0., 0.5, 1., 1., 1.],
        v: vec![0., 0., 1., 1.],
    }
    .surface()
}

fn rectangle(low: f64, high: f64) -> TrimLoop {
    let corners = [
        (low, low),
        (high, low),
        (high, high),
        (low, high),
        (low, low),
    ];
    TrimLoop {
        pieces: vec![TrimPiece::Line(corners.map(DVec2::from).to_vec())],
    }
}

/// A full circle in the parameters.
fn circle(x: f64, y: f64, radius: f64) -> TrimLoop {
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
    let point = |(k, &(a, b)): (usize, &(i32, i32))| {
        let w = if k % 2 == 0 { 1.0 } else { FRAC_1_SQRT_2 };
        let p = DVec2::new(x, y) + radius * DVec2::new(f64::from(a), f64::from(b));
        DVec4::new(p.x * w, p.y * w, 0.0, w)
    };
    let points = corners.iter().enumerate().map(point).collect();
    let knots = vec![0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.];
    TrimLoop {
        pieces: vec![TrimPiece::Curve(Curve::new(points, knots).unwrap())],
    }
}

/// The loop the other way around.
fn reversed(trim: &TrimLoop) -> TrimLoop {
    let piece = |piece: &TrimPiece| match piece {
        TrimPiece::Line(points) => TrimPiece::Line(points.iter().rev().copied().collect()),
        TrimPiece::Curve(curve) => {
            let points = curve.points.iter().rev().copied().collect();
            let knots = vec![0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.];
            TrimPiece::Curve(Curve::new(points, knots).unwrap())
        }
    };
    TrimLoop {
        pieces: trim.pieces.iter().rev().map(piece).collect(),
    }
}

fn all_reversed(loops: &[TrimLoop]) -> Vec<TrimLoop> {
    loops.iter().map(reversed).collect()
}

#[test]
fn areas_are_those_of_what_is_left_of_the_loops() {
    let border = rectangle(0.0, 1.0);
    let hole = |x, y, r| reversed(&circle(x, y, r));
    let many = || {
        let holes = (0..9).map(|k| {
            hole(
                f64::from(k % 3) * 0.3 + 0.2,
                f64::from(k / 3) * 0.3 + 0.2,
                0.1,
            )
        });
        std::iter::once(border.clone())
            .chain(holes)
            .collect::<Vec<_>>()
    };
    let two_pieces = TrimLoop {
        pieces: vec![
            TrimPiece::Line(vec![DVec2::new(0.1, 0.1), DVec2::new(0.9, 0.1)]),
            TrimPiece::Line(vec![DVec2::new(0.9, 0.9), DVec2::new(0.1, 0.9)]),
        ],
    };
    let off_by_a_digit = rectangle(1e-8, 1.0 - 1e-8);
    let c = |r: f64| PI * r * r;
    let rows: Vec<(&str, Vec<TrimLoop>, f64)> = vec![
        ("the border", vec![border.clone()], 1.0),
        ("nearly the border", vec![off_by_a_digit], 1.0),
        ("beyond the border", vec![rectangle(-3.0, 9.0)], 1.0),
        ("a smaller square", vec![rectangle(0.25, 0.75)], 0.25),
        ("along the knot", vec![rectangle(0.0, 0.5)], 0.25),
        ("a disc", vec![circle(0.5, 0.5, 0.3)], c(0.3)),
        (
            "a disc over the border",
            vec![circle(0.0, 0.5, 0.3)],
            c(0.3) / 2.0,
        ),
        (
            "a hole",
            vec![border.clone(), hole(0.5, 0.5, 0.3)],
            1.0 - c(0.3),
        ),
        (
            "a hole, no outer loop",
            vec![hole(0.5, 0.5, 0.3)],
            1.0 - c(0.3),
        ),
        ("nine holes", many(), 1.0 - 9.0 * c(0.1)),
        (
            "an island in a hole",
            vec![border.clone(), hole(0.5, 0.5, 0.4), circle(0.5, 0.5, 0.2)],
            1.0 - c(0.4) + c(0.2),
        ),
        (
            "two islands",
            vec![circle(0.25, 0.5, 0.2), circle(0.75, 0.5, 0.2)],
            2.0 * c(0.2),
        ),
        ("open pieces", vec![two_pieces], 0.64),
        (
            "the border, turned around",
            all_reversed(std::slice::from_ref(&border)),
            1.0,
        ),
        (
            "nine holes, all turned around",
            all_reversed(&many()),
            1.0 - 9.0 * c(0.1),
        ),
        ("nothing", vec![TrimLoop::default()], 1.0),
    ];
    for (name, loops, part) in rows {
        for tolerance in [0.05, 0.005] {
            let mesh = sheet(0.0)
                .triangles(&chord(tolerance), (&[], &[]), &loops)
                .unwrap();
            assert_eq!(mesh.trim_crossings, 0, "{name}");
            assert!(mesh.chord_bound <= tolerance, "{name}");
            // A chord apart from all of the loops' length, at most.
            let length = 4.0 * 4.0 + 2.0 * PI * 4.0 * 0.9;
            let error = (area(&mesh) - 16.0 * part).abs();
            assert!(
                error <= tolerance * length + 1e-6,
                "{name}: {}",
                area(&mesh) / 16.0
            );
            assert!(error <= 0.02 || tolerance > 0.01, "{name}: {error}");
            let up = mesh.triangles.iter().all(|t| {
                let [a, b, c] = t.map(|v| mesh.points[v as usize]);
                (b - a).cross(c - a).z >= 0.0
            });
            assert!(up, "{name}");
        }
    }
}

#[test]
fn a_bent_sheet_with_a_hole_keeps_its_chord_and_has_no_cracks() {
    let surface = sheet(0.5);
    let loops = [rectangle(0.0, 1.0), reversed(&circle(0.45, 0.5, 0.3))];
    let tolerance = 0.01;
    let mesh = surface
        .triangles(&chord(tolerance), (&[], &[]), &loops)
        .unwrap();
    for t in &mesh.triangles {
        let q = t
            .iter()
            .map(|&v| mesh.parameters[v as usize])
            .sum::<DVec2>()
            / 3.0;
        let p = t.iter().map(|&v| mesh.points[v as usize]).sum::<DVec3>() / 3.0;
        assert!(surface.point(q.x, q.y).p.distance(p) <= tolerance);
        // z = 0.5 x^2, wherever the point is.
        assert!(t.iter().all(|&v| {
            let p = mesh.points[v as usize];
            (p.z - 0.5 * p.x * p.x).abs() < 1e-12
        }));
    }
    // Edges of one triangle only are on the border or on the circle: none is inside.
    let mut uses = std::collections::BTreeMap::new();
    for t in &mesh.triangles {
        for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            *uses.entry((a.min(b), a.max(b))).or_insert(0) += 1;
        }
    }
    let mut around = 0;
    for (&(a, b), &count) in &uses {
        assert!(count <= 2);
        if count == 2 {
            continue;
        }
        let ends = [a, b].map(|v| mesh.parameters[v as usize]);
        let on_border = ends
            .iter()
            .all(|q| q.min_element() == 0.0 || q.max_element() == 1.0);
        let off = |q: &DVec2| (q.distance(DVec2::new(0.45, 0.5)) - 0.3).abs();
        assert!(on_border || ends.iter().all(|q| off(q) < 2e-3), "{ends:?}");
        around += usize::from(!on_border);
    }
    assert!(around > 20);
}

#[test]
fn wrong_loops_cost_no_more_than_their_surface() {
    let surface = sheet(0.5);
    let fineness = chord(0.05);
    let mut rng = Rng(17);
    let star: Vec<DVec2> = (0..200)
        .map(|_| DVec2::new(rng.signed(), rng.signed()))
        .collect();
    let line = |points: Vec<DVec2>| TrimLoop {
        pieces: vec![TrimPiece::Line(points)],
    };
    let crossing = [line(star), circle(0.3, 0.5, 0.25), circle(0.6, 0.5, 0.25)];
    let mesh = surface.triangles(&fineness, (&[], &[]), &crossing).unwrap();
    assert!(mesh.trim_crossings > 0);
    assert!(mesh.points.iter().all(|p| p.is_finite()));
    let degenerate = [
        line(vec![DVec2::splat(0.5); 3]),
        line(vec![DVec2::ZERO, DVec2::ONE]),
        line(Vec::new()),
    ];
    let whole = surface
        .triangles(&fineness, (&[], &[]), &[rectangle(0.0, 1.0)])
        .unwrap();
    let same = surface
        .triangles(&fineness, (&[], &[]), &degenerate)
        .unwrap();
    assert!((area(&whole) - area(&same)).abs() < 1e-9);
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        let loops = [line(vec![DVec2::ZERO, DVec2::X, DVec2::new(bad, 1.0)])];
        let refused = surface.triangles(&fineness, (&[], &[]), &loops);
        assert_eq!(refused.err(), Some(NurbsError::Magnitude));
    }
    // A zigzag across the whole grid, finer than the limit.
    let zigzag = (0..MAX_POLYLINE_POINTS + 1)
        .map(|k| DVec2::new((k % 2) as f64, k as f64 / MAX_POLYLINE_POINTS as f64))
        .collect();
    let refused = surface.triangles(&fineness, (&[], &[]), &[line(zigzag)]);
    assert_eq!(refused.err(), Some(NurbsError::TrimTooIntricate));
}

/// A hole. Inserted along the curve, each of its points undoes the triangles of all those before it:
/// minutes.
#[test]
fn a_long_spiral_takes_no_longer_than_a_circle() {
    let turn = |k: u32| {
        let (share, radius) = (f64::from(k) / 60_000.0, 0.45);
        let direction = DVec2::from_angle(1.8 * PI * share);
        DVec2::splat(0.5) + direction * radius * (0.02 + 0.98 * share)
    };
    let points: Vec<DVec2> = (0..60_000).rev().map(turn).collect();
    let next = points.iter().cycle().skip(1);
    let doubled: f64 = points.iter().zip(next).map(|(p, q)| p.perp_dot(*q)).sum();
    let spiral = TrimLoop {
        pieces: vec![TrimPiece::Line(points)],
    };
    let start = std::time::Instant::now();
    let mesh = sheet(0.0)
        .triangles(&chord(0.05), (&[], &[]), &[spiral])
        .unwrap();
    let took = start.elapsed();
    assert!((area(&mesh) - 16.0 * (1.0 + doubled / 2.0)).abs() < 1e-6);
    assert!(took.as_secs() < 15, "{took:?}");
}
