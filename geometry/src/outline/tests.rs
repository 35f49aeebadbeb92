//! Flattening against the true curves, areas against closed forms, borders against triangles.

use std::collections::BTreeMap;

use glam::DVec2;

use super::*;

fn v(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

fn polygon(points: &[(f64, f64)]) -> Polyline {
    let start = points.first().map_or(DVec2::ZERO, |&(x, y)| v(x, y));
    let segments = points.iter().skip(1).map(|&(x, y)| Segment::Line(v(x, y)));
    let contour = Contour {
        start,
        segments: segments.collect(),
    };
    flatten(&contour, 1.0)
}

fn square(x: f64, y: f64, side: f64) -> Vec<(f64, f64)> {
    vec![(x, y), (x + side, y), (x + side, y + side), (x, y + side)]
}

fn reversed(mut points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.reverse();
    points
}

fn cross(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// The area of the triangles, each of which must be positive; and that of the loops.
fn areas(area: &Area) -> (f64, f64) {
    let p = |i: u32| area.corners[i as usize].p;
    let of_triangles = area.triangles.iter().map(|&[a, b, c]| {
        let double = cross(p(a), p(b), p(c));
        assert!(double > 0.0, "triangle {a} {b} {c} has area {double}");
        double / 2.0
    });
    let of_loops = area.loop_ranges().map(|range| {
        let corners = &area.corners[range];
        let next = corners.iter().cycle().skip(1);
        let terms = corners
            .iter()
            .zip(next)
            .map(|(a, b)| a.p.perp_dot(b.p) / 2.0);
        terms.sum::<f64>()
    });
    (of_triangles.sum(), of_loops.sum())
}

/// Every edge of a triangle has its opposite in another one or in the border, never both.
fn assert_closed(area: &Area) {
    let key = |i: u32| {
        let p = area.corners[i as usize].p;
        (p.x.to_bits(), p.y.to_bits())
    };
    let mut edges: BTreeMap<_, i32> = BTreeMap::new();
    let mut count = |a: u32, b: u32, n: i32| {
        *edges.entry((key(a), key(b))).or_default() += n;
        *edges.entry((key(b), key(a))).or_default() -= n;
    };
    for &[a, b, c] in &area.triangles {
        for (a, b) in [(a, b), (b, c), (c, a)] {
            count(a, b, 1);
        }
    }
    for range in area.loop_ranges() {
        for i in range.clone() {
            let next = if i + 1 == range.end {
                range.start
            } else {
                i + 1
            };
            count(i as u32, next as u32, -1);
        }
    }
    assert!(edges.values().all(|&n| n == 0), "the border does not fit");
}

#[test]
fn polygons_fill_where_they_wind() {
    let overlapping = [square(0.0, 0.0, 2.0), square(1.0, 1.0, 2.0)];
    type Row<'a> = (&'a str, &'a [Vec<(f64, f64)>], f64, usize);
    let rows: &[Row<'_>] = &[
        ("nothing", &[], 0.0, 0),
        ("square", &[square(0.0, 0.0, 2.0)], 4.0, 1),
        ("clockwise", &[reversed(square(0.0, 0.0, 2.0))], 4.0, 1),
        (
            "hole",
            &[square(0.0, 0.0, 4.0), reversed(square(1.0, 1.0, 2.0))],
            12.0,
            2,
        ),
        (
            "hole of a hole",
            &[
                square(0.0, 0.0, 4.0),
                reversed(square(1.0, 1.0, 2.0)),
                square(1.5, 1.5, 1.0),
            ],
            13.0,
            3,
        ),
        (
            "same way inside",
            &[square(0.0, 0.0, 4.0), square(1.0, 1.0, 2.0)],
            16.0,
            1,
        ),
        ("overlap", &overlapping, 7.0, 1),
        (
            "apart",
            &[square(0.0, 0.0, 1.0), square(5.0, 0.0, 1.0)],
            2.0,
            2,
        ),
        (
            "common edge",
            &[square(0.0, 0.0, 1.0), square(1.0, 0.0, 1.0)],
            2.0,
            1,
        ),
        (
            "common corner",
            &[square(0.0, 0.0, 1.0), square(1.0, 1.0, 1.0)],
            2.0,
            2,
        ),
        (
            "bow tie",
            &[vec![(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)]],
            2.0,
            2,
        ),
        ("line", &[vec![(0.0, 0.0), (2.0, 2.0)]], 0.0, 0),
        (
            "doubled points",
            &[vec![(0.0, 0.0), (0.0, 0.0), (2.0, 0.0), (2.0, 2.0)]],
            2.0,
            1,
        ),
        (
            "too far",
            &[square(1e9, 0.0, 2.0), square(0.0, 0.0, 1.0)],
            1.0,
            1,
        ),
        (
            "no number",
            &[vec![(f64::NAN, 0.0), (1.0, 0.0), (0.0, 1.0)]],
            0.0,
            0,
        ),
    ];
    for (name, contours, wanted, loops) in rows {
        let lines: Vec<_> = contours.iter().map(|points| polygon(points)).collect();
        let area = fill(&lines, 1.0 / 64.0);
        let (of_triangles, of_loops) = areas(&area);
        assert_eq!((of_triangles, of_loops), (*wanted, *wanted), "{name}");
        assert_eq!(area.loops.len(), *loops, "{name}");
        assert_closed(&area);
    }
}

#[test]
fn chords_stay_within_the_tolerance() {
    let start = v(0.0, 0.0);
    let curves = [
        Segment::Quadratic(v(10.0, 20.0), v(30.0, 0.0)),
        Segment::Cubic(v(0.0, 30.0), v(30.0, -40.0), v(30.0, 10.0)),
    ];
    for segment in curves {
        let at = |t: f64| {
            let s = 1.0 - t;
            match segment {
                Segment::Line(to) => start.lerp(to, t),
                Segment::Quadratic(a, to) => a * (2.0 * s * t) + to * (t * t),
                Segment::Cubic(a, b, to) => {
                    a * (3.0 * s * s * t) + b * (3.0 * s * t * t) + to * (t * t * t)
                }
            }
        };
        let mut counts = Vec::new();
        for tolerance in [5.0, 0.5, 0.05, 0.0] {
            let contour = Contour {
                start,
                segments: vec![segment],
            };
            let line = flatten(&contour, tolerance);
            let mut corners = line.points.clone();
            corners.rotate_right(1);
            let distance = |p: DVec2| {
                let chords = corners.windows(2).map(|w| {
                    let along = ((p - w[0]).dot(w[1] - w[0]) / (w[1] - w[0]).length_squared())
                        .clamp(0.0, 1.0);
                    p.distance(w[0].lerp(w[1], along))
                });
                chords.fold(f64::INFINITY, f64::min)
            };
            let worst = (0..=999).map(|i| distance(at(f64::from(i) / 999.0)));
            let worst = worst.fold(0.0, f64::max);
            counts.push(line.points.len());
            // Without a tolerance the number of chords ends it.
            let allowed = if tolerance > 0.0 { tolerance } else { 0.02 };
            assert!(worst <= allowed, "{worst} for {tolerance}");
            assert!(
                worst > 0.1 * tolerance,
                "{worst} for {tolerance}: far too fine"
            );
        }
        assert!(counts.is_sorted());
        // The end of the curve, and the line that closes it.
        assert_eq!(counts[3], MAX_CURVE_PIECES as usize + 1);
    }
}

#[test]
fn smooth_joints_have_one_direction_and_corners_two() {
    // A stadium: two straight sides, two half circles of quadratics.
    let contour = Contour {
        start: v(0.0, 0.0),
        segments: vec![
            Segment::Line(v(10.0, 0.0)),
            Segment::Quadratic(v(15.0, 0.0), v(15.0, 5.0)),
            Segment::Quadratic(v(15.0, 10.0), v(10.0, 10.0)),
            Segment::Line(v(0.0, 10.0)),
        ],
    };
    let rows = [
        ("as drawn", contour.clone()),
        ("clockwise", clockwise(&contour)),
    ];
    for (name, contour) in rows {
        let area = fill(&[flatten(&contour, 0.01)], 1.0 / 4096.0);
        let mut creases: Vec<DVec2> = Vec::new();
        for corner in &area.corners {
            let [comes, leaves] = corner.tangents;
            if comes.dot(leaves) < 0.999 {
                creases.push(corner.p);
            }
            // On the arc the directions are the circle's to within the quadratic's own error, not
            // the chords'.
            let from_middle = corner.p - v(10.0, 5.0);
            if corner.p.x > 10.0 {
                let outward = v(comes.y, -comes.x);
                assert!(outward.dot(from_middle) > 0.0, "{name}");
            }
        }
        creases.sort_by(|a, b| a.y.total_cmp(&b.y));
        assert_eq!(creases, [v(0.0, 0.0), v(0.0, 10.0)], "{name}");
        let straight = area.corners.iter().find(|c| c.p == v(10.0, 0.0)).unwrap();
        assert_eq!(straight.tangents, [DVec2::X; 2], "{name}");
    }
}

/// The same contour, the other way round.
fn clockwise(contour: &Contour) -> Contour {
    let mut starts = vec![contour.start];
    starts.extend(contour.segments.iter().map(|s| match *s {
        Segment::Line(to) | Segment::Quadratic(_, to) | Segment::Cubic(_, _, to) => to,
    }));
    let backward = contour.segments.iter().zip(&starts).rev();
    let segments = backward.map(|(s, &to)| match *s {
        Segment::Line(_) => Segment::Line(to),
        Segment::Quadratic(a, _) => Segment::Quadratic(a, to),
        Segment::Cubic(a, b, _) => Segment::Cubic(b, a, to),
    });
    Contour {
        start: starts.last().copied().unwrap_or_default(),
        segments: segments.collect(),
    }
}

#[test]
fn offsets_keep_edges_parallel() {
    let corner_of = |points: &[(f64, f64)]| {
        let area = fill(&[polygon(points)], 1.0 / 64.0);
        let miters = miters(&area);
        (area, miters)
    };
    let (area, moves) = corner_of(&square(0.0, 0.0, 2.0));
    for (corner, by) in area.corners.iter().zip(&moves) {
        assert_eq!(*by, (corner.p - v(1.0, 1.0)), "at {}", corner.p);
    }
    // A hole grows smaller: outward is away from the area.
    let lines = [square(0.0, 0.0, 4.0), reversed(square(1.0, 1.0, 2.0))];
    let area = fill(&lines.map(|points| polygon(&points)), 1.0 / 64.0);
    for (corner, by) in area.corners.iter().zip(miters(&area)).skip(4) {
        assert_eq!(by, v(2.0, 2.0) - corner.p, "at {}", corner.p);
    }
    let (area, moves) = corner_of(&[(0.0, 0.0), (100.0, 1.0), (0.0, 2.0)]);
    let tip = area.corners.iter().position(|c| c.p.x == 100.0).unwrap();
    assert!((moves[tip] - v(MITER_LIMIT, 0.0)).length() < 1e-12);
}
