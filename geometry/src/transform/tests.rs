//! Decomposition: exact cases by table, accuracy on random matrices of every rank and size.

use super::*;
use crate::test_rng::Rng;

fn diagonal(x: f64, y: f64, z: f64) -> DMat3 {
    DMat3::from_diagonal(DVec3::new(x, y, z))
}

/// The largest element-wise error, over the largest element.
fn relative_error(actual: &DMat3, expected: &DMat3) -> f64 {
    let elements = |m: &DMat3| m.to_cols_array();
    let norm = elements(expected)
        .iter()
        .fold(0.0_f64, |m, x| m.max(x.abs()));
    // Scaled first: the difference of subnormal numbers has no digits to lose.
    elements(actual)
        .iter()
        .zip(elements(expected))
        .fold(0.0_f64, |m, (a, e)| m.max((a / norm - e / norm).abs()))
}

#[test]
fn exact_matrices_decompose_exactly() {
    let id = DQuat::IDENTITY;
    let half_turn_z = DQuat::from_xyzw(0.0, 0.0, 1.0, 0.0);
    let quarter_turn_x_axes = DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y);
    let quarter_turn_x = DQuat::from_xyzw(0.5_f64.sqrt(), 0.0, 0.0, 0.5_f64.sqrt());
    let only_y = DMat3::from_cols(DVec3::Y * 3.0, DVec3::ZERO, DVec3::ZERO);
    let quarter_turn_z = DQuat::from_xyzw(0.0, 0.0, 0.5_f64.sqrt(), 0.5_f64.sqrt());
    let almost_one = 1.0 + f64::EPSILON;
    let rows = [
        (DMat3::IDENTITY, id, [1.0, 1.0, 1.0]),
        (diagonal(2.0, 0.1, 1e-9), id, [2.0, 0.1, 1e-9]),
        (diagonal(almost_one, 1.0, 1.0), id, [almost_one, 1.0, 1.0]),
        (diagonal(-1.0, 1.0, 1.0), id, [-1.0, 1.0, 1.0]),
        (diagonal(1.0, -3.0, 1.0), id, [1.0, -3.0, 1.0]),
        (diagonal(0.1, 0.2, -0.3), id, [0.1, 0.2, -0.3]),
        (diagonal(-1.0, -2.0, -3.0), id, [-1.0, -2.0, -3.0]),
        (diagonal(-1.0, -2.0, 3.0), half_turn_z, [1.0, 2.0, 3.0]),
        (diagonal(1e200, 1e-200, 1.0), id, [1e200, 1e-200, 1.0]),
        (diagonal(5e-324, 1e308, 1.0), id, [5e-324, 1e308, 1.0]),
        (diagonal(1.0, 0.0, 2.0), id, [1.0, 0.0, 2.0]),
        (diagonal(0.0, 0.0, 7.0), id, [0.0, 0.0, 7.0]),
        (diagonal(3.0, 0.0, 0.0), id, [3.0, 0.0, 0.0]),
        (only_y, quarter_turn_z, [3.0, 0.0, 0.0]),
        (DMat3::ZERO, id, [0.0, 0.0, 0.0]),
        (quarter_turn_x_axes, quarter_turn_x, [1.0, 1.0, 1.0]),
        (diagonal(f64::NAN, 1.0, 1.0), id, [1.0, 1.0, 1.0]),
    ];
    for (linear, rotation, scale) in rows {
        let translation = DVec3::new(2.6e6, -1.25, 0.1);
        let m = DAffine3::from_mat3_translation(linear, translation);
        let Decomposition::Trs(trs) = decompose(&m) else {
            panic!("{linear:?} does not shear");
        };
        assert_eq!(trs.translation, translation);
        assert_eq!(trs.scale.to_array(), scale, "{linear:?}");
        // Bits, so that a negative zero counts as wrong.
        if rotation == id {
            assert_eq!(
                trs.rotation.to_array().map(f64::to_bits),
                rotation.to_array().map(f64::to_bits),
                "{linear:?}"
            );
        }
        assert!(
            trs.rotation.abs_diff_eq(rotation, f64::EPSILON),
            "{linear:?}"
        );
    }
}

#[test]
fn rotated_matrices_keep_unit_scale() {
    let mut rng = Rng(1);
    for _ in 0..1000 {
        let mut linear = DMat3::IDENTITY;
        // A chain as deep as the bound is derived for.
        for _ in 0..16 {
            let axis = rng.vec3().normalize();
            linear *= DMat3::from_axis_angle(axis, 3.0 * rng.signed());
        }
        for (mirror, expected) in [(DVec3::ONE, 1.0), (DVec3::new(1.0, -1.0, 1.0), -1.0)] {
            let m = DAffine3::from_mat3(linear * DMat3::from_diagonal(mirror));
            let Decomposition::Trs(trs) = decompose(&m) else {
                panic!("a rotation does not shear: {linear:?}");
            };
            assert_eq!(trs.scale.abs(), DVec3::ONE, "{linear:?}");
            assert_eq!(trs.scale.element_product(), expected);
            assert!(relative_error(&trs.to_affine().matrix3, &m.matrix3) < gamma(64));
        }
    }
}

/// A random matrix of the given rank, or less.
fn random_matrix(rng: &mut Rng, rank: u32) -> DMat3 {
    (0..rank).fold(DMat3::ZERO, |m, _| {
        let (a, b) = (rng.vec3(), rng.vec3());
        m + DMat3::from_cols(a * b.x, a * b.y, a * b.z)
    })
}

#[test]
fn any_matrix_is_reconstructed() {
    // Three products of quaternion, scale and quaternion, at some ten roundings each.
    const FEW_ULPS: f64 = gamma(32);
    let mut rng = Rng(2);
    let mut sheared = 0;
    for round in 0..40000 {
        let mut linear = random_matrix(&mut rng, round % 4);
        if round % 5 == 0 {
            // Badly scaled columns.
            linear *= diagonal(1e-9, 1.0, 1e-150);
        }
        if round % 7 == 0 {
            linear.y_axis = linear.x_axis;
        }
        linear *= [1.0, 1e-200, 1e200, 1e-290][round as usize % 11 % 4];
        let m = DAffine3::from_mat3(linear);
        let parts = decompose(&m);
        if let Decomposition::Sheared { outer, inner } = parts {
            sheared += 1;
            for q in [outer.rotation, inner] {
                assert!((q.length() - 1.0).abs() < gamma(8), "{q:?}");
                assert!(q.w >= 0.0);
            }
        }
        if linear != DMat3::ZERO {
            let error = relative_error(&parts.to_affine().matrix3, &linear);
            assert!(error <= FEW_ULPS, "{error:e} {linear:?} {parts:?}");
        }
    }
    assert!(sheared > 20_000);
}

#[test]
fn shear_is_told_from_rounding() {
    let shear = |s: f64| {
        DAffine3::from_mat3(DMat3::from_cols(
            DVec3::X,
            DVec3::new(s, 1.0, 0.0),
            DVec3::Z,
        ))
    };
    for (s, max_cosine, is_trs) in [
        (0.0, 0.0, true),
        (f64::EPSILON, ORTHOGONAL_COSINE, true),
        (1e-13, ORTHOGONAL_COSINE, false),
        (1e-13, 1e-6, true),
        (1e-5, 1e-6, false),
        (1.0, ORTHOGONAL_COSINE, false),
    ] {
        let parts = decompose_within(&shear(s), max_cosine);
        assert_eq!(
            matches!(parts, Decomposition::Trs(_)),
            is_trs,
            "{s} {max_cosine}"
        );
    }
}

#[test]
fn nearly_diagonal_shear_keeps_its_axes() {
    let m = DAffine3::from_mat3(DMat3::from_cols(
        DVec3::new(3.0, 1e-6, 0.0),
        DVec3::new(0.0, -2.0, 0.0),
        DVec3::Z,
    ));
    let Decomposition::Sheared { outer, inner } = decompose(&m) else {
        panic!("shears");
    };
    assert!(
        outer.scale.abs_diff_eq(DVec3::new(3.0, -2.0, 1.0), 1e-9),
        "{outer:?}"
    );
    assert!(outer.rotation.abs_diff_eq(DQuat::IDENTITY, 1e-5));
    assert!(inner.abs_diff_eq(DQuat::IDENTITY, 1e-5));
}

#[test]
fn the_largest_stretch_is_that_of_the_longest_axis() {
    let mut rng = Rng(29);
    for _ in 0..100 {
        let (before, after) = (random_matrix(&mut rng, 3), random_matrix(&mut rng, 3));
        let turn = |m: &DMat3| DMat3::from_quat(DQuat::from_mat3(m).normalize());
        let scale = rng.vec3() * 5.0;
        let m = turn(&before) * DMat3::from_diagonal(scale) * turn(&after);
        let found = largest_stretch(&m);
        let longest = scale.abs().max_element();
        assert!(
            (found - longest).abs() <= 1e-13 * longest,
            "{found} {longest}"
        );
    }
    assert_eq!(largest_stretch(&DMat3::ZERO), 0.0);
}

#[test]
fn mirroring_is_exact() {
    // Rows of integers whose determinant is exactly what the third column decides.
    let big = 2.0_f64.powi(52) + 1.0;
    let plane = |x: f64| {
        DMat3::from_cols(
            DVec3::new(big, big + 1.0, 0.0),
            DVec3::new(big - 1.0, big + x, 0.0),
            DVec3::Z,
        )
    };
    for (linear, expected) in [
        (DMat3::IDENTITY, false),
        (diagonal(-1.0, 1.0, 1.0), true),
        (diagonal(-1.0, -1.0, 1.0), false),
        (diagonal(-1e-200, 1e-200, 1e-200), true),
        (diagonal(-1e200, 1e200, 1e200), true),
        (diagonal(-1.0, 0.0, 1.0), false),
        (diagonal(f64::NAN, -1.0, 1.0), false),
        // Determinants big*(big+x) - (big-1)*(big+1) = 1 + x*big.
        (plane(0.0), false),
        (plane(-1.0), true),
        // Determinant of two multiples of one vector, one ulp apart.
        (
            DMat3::from_cols(
                DVec3::new(0.1, 0.3, 0.0),
                DVec3::new(0.2, 0.6, 0.0),
                DVec3::Z,
            ),
            false,
        ),
        (
            DMat3::from_cols(
                DVec3::new(0.1, 0.3, 0.0),
                DVec3::new(0.2, 0.6_f64.next_down(), 0.0),
                DVec3::Z,
            ),
            true,
        ),
    ] {
        let m = DAffine3::from_mat3(linear);
        assert_eq!(is_mirroring(&m), expected, "{linear:?}");
    }
}

#[test]
fn normals_stay_perpendicular() {
    let mut rng = Rng(3);
    for round in 0..1000 {
        let scale = [1.0, 1e200, 1e-200, -1.0][round % 4];
        let m = DAffine3::from_mat3(random_matrix(&mut rng, 2 + round as u32 % 2) * scale);
        let (u, v) = (rng.vec3(), rng.vec3());
        let n_in_world = (normal_matrix(&m) * u.cross(v)).normalize();
        let unit = |p: DVec3| {
            m.transform_vector3(p)
                / m.matrix3
                    .to_cols_array()
                    .iter()
                    .fold(0.0_f64, |a, x| a.max(x.abs()))
        };
        let (u, v) = (unit(u), unit(v));
        assert!(
            n_in_world.dot(u).abs() < 1e-9 && n_in_world.dot(v).abs() < 1e-9,
            "{m:?}"
        );
        // The image's own normal, unless the matrix turned it inside out.
        let image_normal = if is_mirroring(&m) {
            v.cross(u)
        } else {
            u.cross(v)
        };
        if round % 2 == 1 {
            assert!(n_in_world.dot(image_normal) > 0.0, "{m:?}");
        }
    }
}

#[test]
fn normal_matrix_of_special_matrices() {
    for (linear, expected) in [
        (DMat3::IDENTITY, DMat3::IDENTITY),
        (diagonal(-1.0, 1.0, 1.0), diagonal(-1.0, 1.0, 1.0)),
        (
            diagonal(2.0, 2.0, 0.0),
            DMat3::from_cols(DVec3::ZERO, DVec3::ZERO, DVec3::Z),
        ),
        (diagonal(1e200, 1e-200, 1.0), diagonal(0.0, 1.0, 1e-200)),
        (diagonal(1.0, 0.0, 0.0), DMat3::ZERO),
        (diagonal(f64::INFINITY, 0.0, 0.0), DMat3::IDENTITY),
    ] {
        let n = normal_matrix(&DAffine3::from_mat3(linear));
        let max = n
            .to_cols_array()
            .iter()
            .fold(0.0_f64, |a, x| a.max(x.abs()));
        let n = if max > 0.0 { n * (1.0 / max) } else { n };
        assert!(n.abs_diff_eq(expected, 1e-15), "{linear:?} {n:?}");
    }
}
