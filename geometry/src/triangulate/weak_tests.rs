//! Triangulation of weakly simple loops: random regions of unit cells with holes joined by
//! bridges. Their areas are whole numbers, and nearly all their points lie on straight lines.

use super::tests::check_cover;
use super::*;
use crate::test_rng::Rng;
use std::collections::BTreeSet;

type Point = (i32, i32);

const NEIGHBOURS: [Point; 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

/// A square of cells with holes and dents eaten into it, connected by edges, and with a
/// boundary that touches itself in points only if it may.
fn random_region(rng: &mut Rng, size: i32, may_touch: bool) -> BTreeSet<Point> {
    let mut cells: BTreeSet<Point> = (0..size * size).map(|i| (i % size, i / size)).collect();
    for _ in 0..rng.below(size.pow(2) as u64) {
        let cell = (rng.below(size as u64) as i32, rng.below(size as u64) as i32);
        let existed = cells.remove(&cell);
        let is_bad = !is_connected(&cells) || (!may_touch && touches_itself(&cells, cell));
        if existed && is_bad {
            cells.insert(cell);
        }
    }
    cells
}

fn is_connected(cells: &BTreeSet<Point>) -> bool {
    let mut unseen = cells.clone();
    let mut open: Vec<Point> = unseen.pop_first().into_iter().collect();
    while let Some((x, y)) = open.pop() {
        open.extend(
            NEIGHBOURS
                .into_iter()
                .filter_map(|(dx, dy)| unseen.take(&(x + dx, y + dy))),
        );
    }
    unseen.is_empty() && !cells.is_empty()
}

/// Whether two cells around `cell` meet in a corner only.
fn touches_itself(cells: &BTreeSet<Point>, (x, y): Point) -> bool {
    [(0, 0), (1, 0), (0, 1), (1, 1)]
        .into_iter()
        .any(|(dx, dy)| {
            let (cx, cy) = (x + dx, y + dy);
            let has = |dx, dy| cells.contains(&(cx - dx, cy - dy));
            (has(0, 0) && has(1, 1) && !has(1, 0) && !has(0, 1))
                || (!has(0, 0) && !has(1, 1) && has(1, 0) && has(0, 1))
        })
}

/// The boundary loops in unit steps, cells to the left. Where a loop meets itself or another
/// it stays with its cell.
fn boundaries(cells: &BTreeSet<Point>) -> Vec<Vec<Point>> {
    // By start and direction.
    let mut steps = BTreeSet::new();
    for &(x, y) in cells {
        for (from, direction, beyond) in [
            ((x, y), (1, 0), (x, y - 1)),
            ((x + 1, y), (0, 1), (x + 1, y)),
            ((x + 1, y + 1), (-1, 0), (x, y + 1)),
            ((x, y + 1), (0, -1), (x - 1, y)),
        ] {
            if !cells.contains(&beyond) {
                steps.insert((from, direction));
            }
        }
    }
    let mut loops = Vec::new();
    while let Some((start, first_direction)) = steps.pop_first() {
        let mut points = vec![start];
        let (mut p, mut d) = (start, first_direction);
        loop {
            p = (p.0 + d.0, p.1 + d.1);
            let turns = [(-d.1, d.0), d, (d.1, -d.0)];
            let Some(next) = turns.into_iter().find(|&next| steps.remove(&(p, next))) else {
                break;
            };
            points.push(p);
            d = next;
        }
        loops.push(points);
    }
    loops
}

/// Joins holes to the outer loop, each by a bridge from its leftmost point to the left. The
/// loops come sorted by their leftmost point, the outer one first.
fn bridged(loops: Vec<Vec<Point>>) -> Vec<Point> {
    let mut loops = loops.into_iter();
    let mut joined = loops.next().unwrap();
    for hole in loops {
        // Loops start at their smallest point.
        let (hx, hy) = hole[0];
        let (mut x, y) = (hx, hy);
        while !joined.contains(&(x, y)) {
            x -= 1;
        }
        let at = occurrence_open_to_the_right(&joined, (x, y));
        let mut detour: Vec<Point> = vec![(x, y)];
        detour.extend(&hole);
        detour.push((hx, hy));
        joined.splice(at..at, detour);
    }
    joined
}

/// Which of a point's places in the loop has the polygon on the side of positive x.
fn occurrence_open_to_the_right(joined: &[Point], p: Point) -> usize {
    let n = joined.len();
    let angle = |q: Point| {
        let a = f64::from(q.1 - p.1).atan2(f64::from(q.0 - p.0));
        if a <= 0.0 {
            a + std::f64::consts::TAU
        } else {
            a
        }
    };
    // Turning clockwise from positive x, one must meet the outgoing edge before the incoming.
    (0..n)
        .filter(|&i| joined[i] == p)
        .find(|&i| angle(joined[(i + 1) % n]) >= angle(joined[(i + n - 1) % n]))
        .unwrap()
}

/// Leaves out some of the points on straight lines, but none that the loop visits twice.
fn thinned(points: Vec<Point>, rng: &mut Rng) -> Vec<Point> {
    let n = points.len();
    let is_straight = |i: usize| {
        let (a, b, c) = (points[(i + n - 1) % n], points[i], points[(i + 1) % n]);
        (a.0 == b.0 && b.0 == c.0) || (a.1 == b.1 && b.1 == c.1)
    };
    (0..n)
        .filter(|&i| {
            let once = points.iter().filter(|&&p| p == points[i]).count() == 1;
            !(once && is_straight(i) && rng.below(3) > 0)
        })
        .map(|i| points[i])
        .collect()
}

#[test]
fn bridged_regions_are_covered() {
    let mut rng = Rng(11);
    let mut triangulator = Triangulator::new();
    let mut out = Vec::new();
    let mut hole_count = 0;
    for round in 0..2000 {
        // Now and then one with hundreds of points.
        let size = if round % 50 == 0 {
            20
        } else {
            2 + rng.below(9) as i32
        };
        let cells = random_region(&mut rng, size, round % 3 == 0);
        let loops = boundaries(&cells);
        hole_count += loops.len() - 1;
        let mut points = bridged(loops);
        if round % 2 == 0 {
            points = thinned(points, &mut rng);
        }
        let start = rng.below(points.len() as u64) as usize;
        points.rotate_left(start);
        // A shear with whole numbers keeps the areas.
        let (kx, ky) = [(0, 0), (1, 0), (0, -1), (2, 3)][round % 4];
        let points: Vec<DVec3> = points
            .iter()
            .map(|&(x, y)| {
                let (x, y) = (x + kx * y, y);
                DVec3::new(f64::from(x), f64::from(y + ky * x), 0.0)
            })
            .collect();
        out.clear();
        let outcome = triangulator.triangulate(&points, &mut out);
        assert_eq!(outcome, Outcome::Triangulated, "{points:?}");
        let repeated = (0..points.len())
            .filter(|&i| points[i] == points[(i + 1) % points.len()])
            .count();
        assert_eq!(
            check_cover(&points, &out),
            points.len() - repeated - 2,
            "{points:?}"
        );
        let twice_area: f64 = out
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|i| points[i as usize]);
                (b - a).cross(c - a).z
            })
            .sum();
        assert_eq!(twice_area, 2.0 * cells.len() as f64, "{points:?}");
    }
    assert!(hole_count > 2000, "{hole_count}");
}

#[test]
fn loops_may_touch_corners_and_edges() {
    // The number of triangles is what it takes: where a loop parts the polygon, or its points
    // lie in the middle of other edges, it is less than the number of points less two.
    type Row<'a> = (&'a [Point], usize, f64);
    let rows: [Row<'_>; 4] = [
        // A hole that starts in the corner (0, 0) and crosses the diagonal that would cut the
        // corner off; the bridge to it is elsewhere.
        (
            &[
                (0, 0),
                (2, 0),
                (10, 0),
                (10, 10),
                (6, 4),
                (0, 0),
                (4, 6),
                (6, 4),
                (10, 10),
                (0, 10),
                (0, 2),
            ],
            7,
            90.0,
        ),
        // A hole that touches the middle of the lowest edge.
        (
            &[
                (0, 0),
                (4, 0),
                (4, 4),
                (3, 2),
                (2, 0),
                (1, 2),
                (3, 2),
                (4, 4),
                (0, 4),
            ],
            6,
            14.0,
        ),
        // A bridge to one hole that runs along the edge of another, which hangs on it.
        (
            &[
                (0, 0),
                (10, 0),
                (10, 10),
                (0, 10),
                (0, 5),
                (7, 5),
                (8, 6),
                (8, 4),
                (7, 5),
                (5, 5),
                (5, 3),
                (3, 3),
                (3, 5),
                (0, 5),
            ],
            12,
            95.0,
        ),
        // The same, with a bridge of its own.
        (
            &[
                (0, 0),
                (10, 0),
                (10, 10),
                (0, 10),
                (0, 5),
                (7, 5),
                (8, 6),
                (8, 4),
                (7, 5),
                (0, 5),
                (3, 5),
                (5, 5),
                (5, 3),
                (3, 3),
                (3, 5),
                (0, 5),
            ],
            12,
            95.0,
        ),
    ];
    for (loop_points, count, area) in rows {
        let mut points: Vec<DVec3> = loop_points
            .iter()
            .map(|&(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.0))
            .collect();
        for turn in 0..2 * points.len() {
            points.rotate_left(1);
            if turn == points.len() {
                // The mirror image, its order reversed to be counter-clockwise again.
                points.reverse();
                points.iter_mut().for_each(|p| p.x = -p.x);
            }
            let mut out = Vec::new();
            let outcome = Triangulator::new().triangulate(&points, &mut out);
            assert_eq!(outcome, Outcome::Triangulated, "{points:?}");
            assert_eq!(check_cover(&points, &out), count, "{points:?}");
            assert_eq!(newell_normal(&points).z, 2.0 * area);
        }
    }
}
