//! What depends on the view: z-pass and culling.

use geometry::bounds::Aabb;
use glam::{DVec3, DVec4};
use proptest::prelude::*;
use viewer::volume::{CastRule, count_at_infinity, facing, volume_may_touch, zpass_is_safe};

use crate::oracle::{Point, SCALE, blockers};
use crate::soups::{case, directions, light};

fn to_dvec3([x, y, z, _]: Point) -> DVec3 {
    DVec3::new(x as f64, y as f64, z as f64)
}

/// A near rectangle of a perspective camera around the origin, and the eye.
fn camera() -> impl Strategy<Value = ([Point; 4], Point)> {
    let vector = || prop::array::uniform3(-60_i128..=60);
    let place = prop::array::uniform3(-6 * SCALE as i64..=6 * SCALE as i64);
    (place, vector(), vector(), vector()).prop_map(|(eye, ahead, right, up)| {
        let eye = eye.map(i128::from);
        let corner = |r: i128, u: i128| {
            let x = |i: usize| eye[i] + 3 * ahead[i] + r * right[i] + u * up[i];
            [x(0), x(1), x(2), 1]
        };
        let corners = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
        (corners, [eye[0], eye[1], eye[2], 1])
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    #[test]
    fn safe_views_begin_outside_all_volumes(case in case(), (near, eye) in camera()) {
        let triangles = case.world_triangles();
        let bounds: Aabb = triangles.iter().flatten().map(|&p| to_dvec3(p)).collect();
        let light = case.world_light();
        let light_f64 = DVec4::from(light.map(|x| x as f64));
        if zpass_is_safe(&bounds, to_dvec3(eye), near.map(to_dvec3), light_f64) {
            for corner in near.into_iter().chain([eye]) {
                prop_assert_eq!(blockers(&triangles, light, corner).unwrap_or(0), 0);
            }
        }
    }

    #[test]
    fn the_point_at_infinity_is_in_as_many_volumes_as_block_it(
        case in case(),
        directions in directions(),
    ) {
        let mesh = case.mesh();
        let mut signs = Vec::new();
        let rule = CastRule::BothSigns;
        facing(&mesh, case.light(), case.mirrored, rule, &mut signs);
        for u in directions {
            let Some(expected) = blockers(&case.world_triangles(), case.world_light(), u) else {
                continue;
            };
            let mut local = to_dvec3(u);
            local.x *= if case.mirrored { -1.0 } else { 1.0 };
            let count = count_at_infinity(&mesh, &signs, local, case.light());
            prop_assert_eq!(count as usize, expected);
        }
    }

    #[test]
    fn only_volumes_outside_a_plane_are_culled(
        (a, b) in (prop::array::uniform3(-5_i64..=5), prop::array::uniform3(-5_i64..=5)),
        light in light(),
        planes in prop::collection::vec(prop::array::uniform4(-5_i64..=5), 1..4),
    ) {
        let vector = |v: [i64; 3]| DVec3::from(v.map(|x| x as f64));
        let bounds: Aabb = [vector(a), vector(b)].into_iter().collect();
        let light = light.map(i64::from);
        // Corners, and points behind them at distances growing beyond all planes.
        let mut samples = Vec::new();
        for pick in 0..8 {
            let corner = [0, 1, 2].map(|i| if pick >> i & 1 == 0 { a[i] } else { b[i] });
            for t in [0, 1, 100_000] {
                samples.push([0, 1, 2].map(|i| corner[i] + t * (corner[i] * light[3] - light[i])));
            }
        }
        let expected = planes.iter().all(|[x, y, z, d]| {
            samples.iter().any(|s| x * s[0] + y * s[1] + z * s[2] + d >= 0)
        });
        let planes: Vec<DVec4> = planes.iter().map(|p| DVec4::from(p.map(|x| x as f64))).collect();
        let light = DVec4::from(light.map(|x| x as f64));
        prop_assert_eq!(volume_may_touch(&bounds, light, &planes), expected);
    }
}

#[test]
fn plain_views_are_safe() {
    // A camera at x = -10 that looks along x, and a unit box around the origin.
    let bounds: Aabb = [DVec3::splat(-0.5), DVec3::splat(0.5)]
        .into_iter()
        .collect();
    let eye = DVec3::new(-10.0, 0.0, 0.0);
    let near = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(y, z)| eye + DVec3::new(0.1, y * 0.1, z * 0.1));
    let rows = [
        ("sun above", [0.0, 0.0, 1.0, 0.0], true),
        ("sun behind the eye", [-1.0, 0.0, 0.0, 0.0], true),
        ("sun behind the box", [1.0, 0.0, 0.0, 0.0], false),
        ("sun past the box", [1.0, 0.0, 0.07, 0.0], true),
        ("sun just not past the box", [1.0, 0.0, 0.05, 0.0], false),
        ("lamp above", [0.0, 0.0, 5.0, 1.0], true),
        ("lamp at the eye", [-10.0, 0.0, 0.0, 1.0], true),
        ("lamp behind the box", [5.0, 0.0, 0.0, 1.0], false),
        ("lamp past the box", [5.0, 0.0, 1.0, 1.0], true),
        ("lamp in the box", [0.0, 0.0, 0.0, 1.0], false),
        ("lamp nowhere", [f64::NAN, 0.0, 0.0, 1.0], false),
    ];
    for (name, light, expected) in rows {
        assert_eq!(
            zpass_is_safe(&bounds, eye, near, light.into()),
            expected,
            "{name}"
        );
        assert!(
            !zpass_is_safe(&Aabb::EMPTY, eye, near, light.into()),
            "{name}"
        );
    }
    let around: Aabb = [eye - 1.0, eye + 1.0].into_iter().collect();
    assert!(!zpass_is_safe(
        &around,
        eye,
        near,
        [0.0, 0.0, 1.0, 0.0].into()
    ));
    // Clear of the view by little: a device's rounding must not bridge it.
    let light = DVec4::new(0.0, 0.0, 1.0, 0.0);
    for (gap, expected) in [(0.0, false), (1e-7, false), (1e-6, false), (1e-3, true)] {
        let beside: Aabb = [
            DVec3::new(-11.0, 0.1 + gap, -9.0),
            DVec3::new(1.0, 2.0, 9.0),
        ]
        .into_iter()
        .collect();
        assert_eq!(zpass_is_safe(&beside, eye, near, light), expected, "{gap}");
    }
}

#[test]
fn looking_at_the_sun_starts_in_shadow() {
    let mesh =
        viewer::volume::CasterMesh::new(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[0, 1, 2]);
    let rows = [
        (DVec3::NEG_Z, &[1_i8][..], 1),
        (DVec3::new(0.0, 1e-9, -5.0), &[1], 1),
        (DVec3::new(0.0, 1e-3, -1.0), &[1], 0),
        (DVec3::Z, &[1], 0),
        (DVec3::X, &[1], 0),
        (DVec3::NEG_Z, &[0], 0),
        (DVec3::NEG_Z, &[], 0),
        (DVec3::ZERO, &[1], 0),
    ];
    for (viewer, signs, expected) in rows {
        let light = DVec4::new(0.0, 0.0, 2.0, 0.0);
        assert_eq!(
            count_at_infinity(&mesh, signs, viewer, light),
            expected,
            "{viewer}"
        );
    }
}

#[test]
fn parallel_planes_cull_and_odd_input_does_not() {
    let bounds: Aabb = [DVec3::splat(0.1), DVec3::splat(0.3)].into_iter().collect();
    let down = DVec4::new(0.0, 0.0, 1.0, 0.0);
    let rows = [
        (down, DVec4::new(1.0, 0.0, 0.0, -0.4), false),
        (down, DVec4::new(1.0, 0.0, 0.0, -0.3), true),
        (down, DVec4::new(0.0, 0.0, 1.0, -0.4), false),
        (down, DVec4::new(0.0, 0.0, -1.0, -99.0), true),
        (down, DVec4::new(f64::NAN, 0.0, 1.0, -0.4), true),
        (DVec4::NAN, DVec4::new(0.0, 0.0, -1.0, 9.0), false),
    ];
    for (light, plane, expected) in rows {
        assert_eq!(
            volume_may_touch(&bounds, light, &[plane]),
            expected,
            "{light} {plane}"
        );
    }
    assert!(!volume_may_touch(&Aabb::EMPTY, down, &[]));
}
