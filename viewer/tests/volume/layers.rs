//! Bounds of the count: never too small, and small where it matters; parts and their union.

use std::ops::{Range, RangeInclusive};

use glam::{DAffine3, DVec3, DVec4};
use proptest::prelude::*;
use viewer::volume::{
    CastRule, CasterMesh, LayerCaster, Method, Volume, bisect, extract, facing, layer_bound, split,
};

use crate::models::Model;
use crate::oracle::{Case, Point, SCALE, blockers, volume_count};
use crate::soups::{case, crowd, directions, points};

fn signs_and_volume(case: &Case, mesh: &CasterMesh, rule: CastRule) -> (Vec<i8>, Volume) {
    let mut signs = Vec::new();
    facing(mesh, case.light(), case.mirrored, rule, &mut signs);
    let mut volume = Volume::default();
    let (light, method) = (case.light(), Method::Silhouette);
    extract(mesh, method, &signs, light, case.mirrored, &mut volume);
    (signs, volume)
}

/// The bound in the oracle's world.
fn world_bound(case: &Case, mesh: &CasterMesh, rule: CastRule) -> u32 {
    let (signs, volume) = signs_and_volume(case, mesh, rule);
    let mirror = if case.mirrored { -1.0 } else { 1.0 };
    let caster = LayerCaster {
        mesh,
        signs: &signs,
        sides: &volume.sides,
        frame_from_local: DAffine3::from_scale(DVec3::new(mirror, 1.0, 1.0) * SCALE as f64),
    };
    let light = DVec4::from(case.world_light().map(|x| x as f64));
    layer_bound(&[caster], light, 0)
}

/// Points so far out that they are behind everything.
fn far([x, y, z, w]: Point) -> Point {
    [x * 50, y * 50, z * 50, w]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(150) })]

    #[test]
    fn no_point_has_more_than_the_bound(case in prop_oneof![case(), crowd()], points in points()) {
        let bound = world_bound(&case, &case.mesh(), CastRule::BothSigns) as usize;
        let triangles = case.world_triangles();
        for p in points.into_iter().flat_map(|p| [p, far(p)]) {
            let count = blockers(&triangles, case.world_light(), p).unwrap_or(0);
            prop_assert!(count <= bound, "{} > {}", count, bound);
        }
    }

    #[test]
    fn parts_have_the_shadow_of_the_whole(
        case in prop_oneof![case(), crowd()],
        points in points(),
        directions in directions(),
        limit in 1_u32..5,
        one_sign in any::<bool>(),
    ) {
        let rule = if one_sign { CastRule::OneSignWhereClosed } else { CastRule::BothSigns };
        let mesh = case.mesh();
        let ranges = split(&mesh, case.light(), rule, limit);
        let covered: Vec<usize> = ranges.iter().cloned().flatten().collect();
        prop_assert_eq!(covered, (0..mesh.triangles.len()).collect::<Vec<_>>());
        let parts: Vec<CasterMesh> = ranges.into_iter().map(|range| mesh.part(range)).collect();
        let triangles = case.world_triangles();
        for p in points.into_iter().flat_map(|p| [p, far(p)]) {
            let Some(blockers) = blockers(&triangles, case.world_light(), p) else {
                continue;
            };
            let mut shadowed = Some(false);
            for part in &parts {
                let (_, volume) = signs_and_volume(&case, part, rule);
                let drawn = case.volume_triangles(part, &volume);
                let count = directions.iter().find_map(|&u| volume_count(&drawn, p, u));
                prop_assert!(count.unwrap_or(0) <= limit.into());
                shadowed = shadowed.and_then(|s| Some(s || count? > 0));
            }
            prop_assert!(shadowed.is_none_or(|s| s == (blockers > 0)));
        }
    }
}

/// The bound of one model, and its triangle count.
fn bound_of(model: &Model, light: [f64; 4], rule: CastRule, limit: u32) -> u32 {
    let mesh = CasterMesh::new(&model.positions, &model.indices);
    let light = DVec4::from(light);
    let (mut signs, mut volume) = (Vec::new(), Volume::default());
    facing(&mesh, light, false, rule, &mut signs);
    extract(&mesh, Method::Silhouette, &signs, light, false, &mut volume);
    let caster = LayerCaster {
        mesh: &mesh,
        signs: &signs,
        sides: &volume.sides,
        frame_from_local: DAffine3::IDENTITY,
    };
    layer_bound(&[caster], light, limit)
}

#[test]
fn bounds_are_near_known_maxima() {
    let mut stack = Model::default();
    (0..300).for_each(|layer| stack.add_quad(layer as f32));
    let mut grid = Model::default();
    for i in 0..100_u8 {
        grid.add_sphere(
            [f32::from(i % 10) * 3.0, f32::from(i / 10) * 3.0, 0.0],
            1.0,
            20,
            11,
        );
    }
    let mut shells = Model::default();
    (1..=5).for_each(|radius| shells.add_sphere([0.0; 3], radius as f32, 24, 12));
    type Row<'a> = (&'a str, &'a Model, [f64; 4], u32, RangeInclusive<u32>);
    let rows: [Row<'_>; 8] = [
        ("stack", &stack, [0.0, 0.0, 1.0, 0.0], 127, 300..=300),
        ("stack", &stack, [0.3, 0.2, 1.0, 0.0], 0, 7..=100),
        ("stack", &stack, [0.1, 0.2, 400.0, 1.0], 127, 300..=310),
        ("grid", &grid, [0.3, 0.5, 1.0, 0.0], 127, 1..=127),
        ("grid", &grid, [13.0, 14.0, 9.0, 1.0], 127, 1..=127),
        (
            "grid along a row",
            &grid,
            [1.0, 0.0, 0.0, 0.0],
            127,
            10..=127,
        ),
        ("shells", &shells, [0.0, 0.1, 0.2, 1.0], 0, 5..=5),
        (
            "shells from outside",
            &shells,
            [0.0, 0.1, 9.0, 1.0],
            0,
            5..=7,
        ),
    ];
    for (name, model, light, limit, expected) in rows {
        let bound = bound_of(model, light, CastRule::default(), limit);
        assert!(expected.contains(&bound), "{name} {light:?}: {bound}");
    }
}

#[test]
fn all_directions_are_bounded() {
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let mut stack = Model::default();
            (0..40).for_each(|layer| stack.add_quad(1.0 + layer as f32 / 80.0));
            for p in &mut stack.positions {
                p.rotate_right(axis + 1);
                p[axis] *= sign;
            }
            let light = [0.01, 0.02, 0.03, 1.0];
            let bound = bound_of(&stack, light, CastRule::BothSigns, 39);
            assert!((40..=60).contains(&bound), "{axis} {sign}: {bound}");
        }
    }
}

#[test]
fn pieces_fit_or_are_single() {
    // Each piece by its end.
    let rows: [(Range<usize>, usize, &[usize]); 4] = [
        (0..0, 3, &[]),
        (0..3, 3, &[3]),
        (2..8, 2, &[3, 5, 6, 8]),
        (0..2, 0, &[1, 2]),
    ];
    for (whole, most, expected) in rows {
        let pieces = bisect(whole.clone(), |range| range.len() <= most);
        let ends: Vec<usize> = pieces.iter().map(|piece| piece.end).collect();
        assert_eq!(ends, expected);
        let covered: Vec<usize> = pieces.into_iter().flatten().collect();
        assert_eq!(covered, whole.collect::<Vec<_>>());
    }
}
