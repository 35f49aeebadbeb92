//! Face normals by table; crease-angle normals against the rule written out corner by corner.

use super::*;
use crate::test_rng::Rng;
use std::f64::consts::{FRAC_PI_2, PI};

#[test]
fn face_normals() {
    let v = DVec3::new;
    let tilted = [v(0., 0., 0.), v(1., 0., 1.), v(1., 1., 1.), v(0., 1., 0.)];
    let unit = v(-0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt());
    let far = tilted.map(|p| p * 1e-3 + v(2.6e6, 1.2e6, 400.0));
    for (points, expected) in [
        (vec![], DVec3::ZERO),
        (vec![v(0., 0., 0.), v(1., 2., 3.)], DVec3::ZERO),
        (
            vec![v(0., 0., 0.), v(1., 2., 3.), v(2., 4., 6.)],
            DVec3::ZERO,
        ),
        (
            vec![v(0., 0., 0.), v(0.1, 0.2, 0.3), v(0.3, 0.6, 0.9)],
            DVec3::ZERO,
        ),
        (
            vec![v(0., 0., 0.), v(f64::NAN, 0., 0.), v(0., 1., 0.)],
            DVec3::ZERO,
        ),
        (vec![v(0., 0., 0.), v(1., 0., 0.), v(0., 1., 0.)], DVec3::Z),
        (tilted.to_vec(), unit),
        (tilted.map(|p| p * 1e200).to_vec(), unit),
        (tilted.map(|p| p * 1e-200).to_vec(), unit),
        (far.to_vec(), unit),
    ] {
        let n = face_normal(&points);
        // Far away the coordinates themselves are rounded to 5e-10 of 1e-3.
        assert!(n.abs_diff_eq(expected, 1e-6), "{points:?} {n}");
        assert_eq!(n == DVec3::ZERO, expected == DVec3::ZERO);
    }
}

/// The rule as it is written, for one corner.
fn expected_normal(c: &Corners, corner: usize, crease_angle_rad: f64) -> DVec3 {
    let own_face = c.corner_face[corner];
    let own = c.face_normals[own_face as usize];
    let mut sum = own;
    for other in 0..c.face_normals.len() {
        let is_near = (0..c.corner_face.len()).any(|i| {
            c.corner_face[i] as usize == other && c.corner_group[i] == c.corner_group[corner]
        });
        let n = c.face_normals[other];
        let joins = crease_angle_rad >= PI || own.dot(n) > crease_angle_rad.cos();
        if is_near && other != own_face as usize && crease_angle_rad > 0.0 && joins {
            sum += n;
        }
    }
    // Unit vectors of these tests cancel to far less, or add up to far more.
    let or = |v: DVec3, fallback| {
        if v.length() < 1e-9 {
            fallback
        } else {
            v.normalize()
        }
    };
    or(sum, or(own, DVec3::Z))
}

#[track_caller]
fn check(c: &Corners, crease_angle_rad: f64) {
    let actual = crease_normals(
        c.face_normals,
        c.corner_face,
        c.corner_group,
        c.group_count,
        crease_angle_rad,
    );
    assert_eq!(actual.len(), c.corner_face.len());
    for (corner, n) in actual.iter().enumerate() {
        let expected = expected_normal(c, corner, crease_angle_rad).as_vec3();
        let n = glam::Vec3::from_array(*n);
        assert!(
            n.abs_diff_eq(expected, 1e-6),
            "{crease_angle_rad}: {n} {expected} {c:?}"
        );
    }
}

#[test]
fn named_cases() {
    let diagonal = (DVec3::X + DVec3::Y).normalize();
    let cube_corner = [DVec3::X, DVec3::Y, DVec3::Z];
    type Row<'a> = (&'a [DVec3], &'a [u32], &'a [u32], usize);
    let rows: [Row<'_>; 7] = [
        (&cube_corner, &[0, 1, 2], &[0, 0, 0], 1),
        // Two edges, only one of them shared.
        (&cube_corner, &[0, 0, 1, 1, 2, 2], &[0, 1, 1, 2, 2, 3], 4),
        // A face that meets the vertex twice counts once.
        (&cube_corner, &[0, 1, 1, 2, 1], &[0, 0, 0, 0, 0], 1),
        // Degenerate faces, alone and in company.
        (
            &[DVec3::ZERO, DVec3::X, DVec3::Y],
            &[0, 1, 2, 0],
            &[0, 0, 0, 1],
            2,
        ),
        // Opposite normals cancel.
        (&[DVec3::X, DVec3::NEG_X], &[0, 1], &[0, 0], 1),
        // Equal normals weigh as often as they occur.
        (
            &[DVec3::X, DVec3::X, diagonal, DVec3::X],
            &[0, 1, 2, 3],
            &[0; 4],
            1,
        ),
        (&[], &[], &[], 0),
    ];
    for (face_normals, corner_face, corner_group, group_count) in rows {
        let c = Corners {
            face_normals,
            corner_face,
            corner_group,
            group_count,
        };
        for crease_angle_rad in [-1.0, 0.0, 0.5, 0.8, FRAC_PI_2, 1.6, 3.0, PI, 10.0] {
            check(&c, crease_angle_rad);
        }
    }
}

#[test]
fn the_crease_angle_itself_stays_sharp() {
    // dot == cos exactly: 0 > cos(pi/2) = 6e-17 is false.
    let flat = crease_normals(&[DVec3::X, DVec3::Y], &[0, 1], &[0, 0], 1, FRAC_PI_2);
    assert_eq!(flat, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    // The cosine of the angle bit by bit, and its neighbour above.
    for (cosine, joined) in [(0.5_f64.cos(), false), (0.5_f64.cos().next_up(), true)] {
        let other = DVec3::new(cosine, (1.0 - cosine * cosine).sqrt(), 0.0);
        let n = crease_normals(&[DVec3::X, other], &[0, 1], &[0, 0], 1, 0.5);
        assert_eq!(n[0] != [1.0, 0.0, 0.0], joined);
    }
    let nan = crease_normals(&[DVec3::X, DVec3::Y], &[0, 1], &[0, 0], 1, f64::NAN);
    assert_eq!(nan, flat);
}

#[test]
fn random_fans() {
    let mut rng = Rng(7);
    for _ in 0..200 {
        let count = 1 + rng.below(12);
        let normals: Vec<DVec3> = (0..count)
            .map(|_| (rng.vec3() * 1.5).round().normalize_or_zero())
            .collect();
        let corners = rng.below(40);
        let faces: Vec<u32> = (0..corners).map(|_| rng.below(count) as u32).collect();
        let groups: Vec<u32> = (0..corners).map(|_| rng.below(5) as u32).collect();
        let c = Corners {
            face_normals: &normals,
            corner_face: &faces,
            corner_group: &groups,
            group_count: 5,
        };
        for crease_angle_rad in [0.0, 0.7, 1.5, 2.5, PI] {
            check(&c, crease_angle_rad);
        }
    }
}

#[test]
fn sparse_groups_are_as_good_as_dense_ones() {
    let face_normals = [DVec3::X, DVec3::Y, DVec3::Z];
    let corner_face = [0, 1, 2, 0, 1, 2, 2];
    let normals = |groups: [u32; 7], group_count| {
        crease_normals(&face_normals, &corner_face, &groups, group_count, PI)
    };
    let dense = normals([2, 2, 0, 0, 0, 1, 3], 3);
    let sparse = normals(
        [4_000_000_000, 4_000_000_000, 9, 9, 9, 10, u32::MAX],
        u32::MAX as usize,
    );
    assert_eq!(sparse, dense);
    assert!(dense[0] == dense[1] && dense[2] == dense[3] && dense[6] == [0.0, 0.0, 1.0]);
}

#[test]
fn bad_indices_are_harmless() {
    let actual = crease_normals(
        &[DVec3::X, DVec3::Y],
        &[0, 1, 9, 1, 0],
        &[0, 0, 0, 7],
        1,
        PI,
    );
    let half = 0.5_f32.sqrt();
    let joined = [half, half, 0.0];
    assert_eq!(actual, [joined, joined, joined, [0.0, 1.0, 0.0]]);
}

#[test]
fn equal_normals_keep_their_weight_in_a_crowd() {
    let mut normals = cone(MAX_DISTINCT_NORMALS as u32 - 1);
    for i in 0..100 {
        normals.insert(i * 4, DVec3::X);
    }
    let sum: DVec3 = normals.iter().sum();
    let faces: Vec<u32> = (0..normals.len() as u32).collect();
    let actual = crease_normals(&normals, &faces, &vec![0; faces.len()], 1, 2.5);
    for n in actual {
        let expected = sum.normalize().as_vec3();
        assert!(
            glam::Vec3::from_array(n).abs_diff_eq(expected, 1e-6),
            "{n:?} {expected}"
        );
    }
}

/// The face normals of a cone with a tip of 90 degrees.
fn cone(count: u32) -> Vec<DVec3> {
    (0..count)
        .map(|i| {
            let (sin, cos) = (2.0 * PI * f64::from(i) / f64::from(count)).sin_cos();
            DVec3::new(cos, sin, 1.0).normalize()
        })
        .collect()
}

#[test]
fn crowded_vertices() {
    let limit = MAX_DISTINCT_NORMALS as u32;
    let axis = [0.0, 0.0, 1.0];
    // Number of faces, how often each occurs, crease angle, and whether the tip is smooth.
    for (distinct, times, crease_angle_rad, smooth) in [
        (limit, 1, 2.5, true),
        (limit, 40, 2.5, true),
        (limit + 1, 1, 2.5, false),
        (100_000, 1, 2.5, false),
        (100_000, 1, PI, true),
    ] {
        let normals = cone(distinct).repeat(times);
        let faces: Vec<u32> = (0..normals.len() as u32).collect();
        let groups = vec![0; faces.len()];
        let actual = crease_normals(&normals, &faces, &groups, 1, crease_angle_rad);
        for (n, own) in actual.iter().zip(&normals) {
            let expected = if smooth {
                axis
            } else {
                own.as_vec3().to_array()
            };
            let near = n.iter().zip(expected).all(|(a, e)| (a - e).abs() < 1e-6);
            assert!(near, "{distinct} {times}: {n:?} {expected:?}");
        }
    }
}
