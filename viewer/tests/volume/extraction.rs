//! Sides and caps against blocked segments, and the conservation of what flows along sides.

use std::collections::BTreeMap;

use proptest::prelude::*;
use viewer::volume::{CastRule, CasterMesh, Method, Volume, extract, facing};

use crate::oracle::{Case, blockers, orientation, volume_count};
use crate::soups::{case, directions, points};

const METHODS: [Method; 3] = [
    Method::Silhouette,
    Method::ReferenceEdge,
    Method::PerTriangle,
];
const RULES: [CastRule; 2] = [CastRule::BothSigns, CastRule::OneSignWhereClosed];

fn volume_of(case: &Case, mesh: &CasterMesh, method: Method, rule: CastRule) -> Volume {
    let mut signs = Vec::new();
    facing(mesh, case.light(), case.mirrored, rule, &mut signs);
    let mut volume = Volume::default();
    extract(
        mesh,
        method,
        &signs,
        case.light(),
        case.mirrored,
        &mut volume,
    );
    volume
}

/// What flows out of each vertex less what flows in, along directed edges.
fn outflow(edges: impl Iterator<Item = (u32, u32)>) -> BTreeMap<u32, i64> {
    let mut flow = BTreeMap::new();
    for (from, to) in edges {
        *flow.entry(from).or_default() += 1;
        *flow.entry(to).or_default() -= 1;
    }
    flow.retain(|_, &mut net| net != 0);
    flow
}

/// Net count of each directed edge, under its ascending name.
fn net(edges: impl Iterator<Item = (u32, u32)>) -> BTreeMap<(u32, u32), i64> {
    let mut net = BTreeMap::new();
    for (a, b) in edges {
        *net.entry((a.min(b), a.max(b))).or_default() += if a < b { 1 } else { -1 };
    }
    net.retain(|_, &mut count| count != 0);
    net
}

fn directed_sides(mesh: &CasterMesh, volume: &Volume) -> Vec<(u32, u32)> {
    let directed = |side: &u32| {
        let [a, b, ..] = mesh.edges[(side >> 1) as usize];
        if side & 1 == 0 { (a, b) } else { (b, a) }
    };
    volume.sides.iter().map(directed).collect()
}

fn cap_boundary(mesh: &CasterMesh, volume: &Volume) -> Vec<(u32, u32)> {
    let run = |t: &u32| {
        let [a, b, c, _] = mesh.triangles[*t as usize];
        [(a, b), (b, c), (c, a)]
    };
    let forward = volume.cap_pos.iter().flat_map(run);
    let backward = volume.cap_neg.iter().flat_map(run).map(|(a, b)| (b, a));
    forward.chain(backward).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    #[test]
    fn a_point_is_in_a_volume_iff_it_is_blocked(
        case in case(),
        points in points(),
        directions in directions(),
    ) {
        let mesh = case.mesh();
        let triangles = case.world_triangles();
        for method in METHODS {
            for rule in RULES {
                let volume = volume_of(&case, &mesh, method, rule);
                let drawn = case.volume_triangles(&mesh, &volume);
                for &p in &points {
                    let Some(blockers) = blockers(&triangles, case.world_light(), p) else {
                        continue;
                    };
                    let Some(count) = directions
                        .iter()
                        .find_map(|&u| volume_count(&drawn, p, u))
                    else {
                        continue;
                    };
                    prop_assert_eq!(count > 0, blockers > 0, "{:?} {:?} {:?}", method, rule, p);
                    prop_assert!(count >= 0);
                    if rule == CastRule::BothSigns || method == Method::ReferenceEdge {
                        prop_assert_eq!(count, blockers as i128, "{:?} {:?}", method, p);
                    }
                }
            }
        }
    }

    #[test]
    fn signs_are_exact(case in case()) {
        let mesh = case.mesh();
        let mut signs = Vec::new();
        facing(&mesh, case.light(), case.mirrored, CastRule::BothSigns, &mut signs);
        for (&[a, b, c, _], &s) in mesh.triangles.iter().zip(&signs) {
            let [a, b, c] = [a, b, c].map(|v| case.mesh_point(&mesh, v));
            prop_assert_eq!(i128::from(s), -orientation([a, b, c, case.world_light()]));
        }
    }

    #[test]
    fn sides_are_the_boundary_of_the_caps(case in case()) {
        let mesh = case.mesh();
        for method in METHODS {
            for rule in RULES {
                let volume = volume_of(&case, &mesh, method, rule);
                let sides = directed_sides(&mesh, &volume);
                let caps = cap_boundary(&mesh, &volume);
                prop_assert_eq!(outflow(sides.iter().copied()), BTreeMap::new());
                prop_assert_eq!(net(sides.into_iter()), net(caps.into_iter()));
            }
        }
    }

    #[test]
    fn silhouettes_have_no_side_twice_over(case in case()) {
        let mesh = case.mesh();
        let sides = volume_of(&case, &mesh, Method::Silhouette, CastRule::BothSigns).sides;
        let distinct = net(directed_sides(&mesh, &Volume { sides: sides.clone(), ..Volume::default() }).into_iter());
        prop_assert_eq!(sides.len() as i64, distinct.values().map(|m| m.abs()).sum::<i64>());
    }
}

#[test]
fn extraction_appends() {
    let mesh = CasterMesh::new(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[0, 1, 2]);
    let light = glam::DVec4::new(0.0, 0.0, 1.0, 0.0);
    let mut volume = Volume {
        sides: vec![7],
        cap_pos: vec![8],
        cap_neg: vec![9],
    };
    extract(&mesh, Method::Silhouette, &[1], light, false, &mut volume);
    // The edges are 01, 02 and 12; the triangle runs 0 -> 1, 2 -> 0 and 1 -> 2.
    assert_eq!(volume.sides, [7, 0, 3, 4]);
    assert_eq!(volume.cap_pos, [8, 0]);
    assert_eq!(volume.cap_neg, [9]);
}

#[test]
fn closed_convex_solids_cast_with_one_sign() {
    let positions = [
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    let outwards = [
        0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5,
    ];
    let inwards: Vec<u32> = outwards.iter().rev().copied().collect();
    // Each light with the sign that casts for the solid with its faces outwards.
    let rows = [
        ([0.1, 0.2, 5.0, 1.0], 1),
        ([0.1, 0.2, 5.0, 0.0], 1),
        ([9.0, 0.2, 0.1, 1.0], 1),
        ([0.1, 0.2, 0.1, 1.0], -1),
    ];
    for (light, expected) in rows {
        for (indices, turned) in [(&outwards[..], 1), (&inwards, -1)] {
            for (mirrored, seen) in [(false, 1), (true, -1)] {
                let mesh = CasterMesh::new(&positions, indices);
                let mut signs = Vec::new();
                facing(
                    &mesh,
                    light.into(),
                    mirrored,
                    CastRule::default(),
                    &mut signs,
                );
                let unexpected = -(expected * turned * seen) as i8;
                assert!(signs.iter().any(|&s| s != 0), "{light:?}");
                assert!(
                    !signs.contains(&unexpected),
                    "{light:?} {turned} {mirrored}"
                );
            }
        }
    }
}

#[test]
fn lights_without_a_place_cast_nothing() {
    let mesh = CasterMesh::new(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[0, 1, 2]);
    let mut signs = Vec::new();
    for light in [
        [f64::NAN, 0.0, 0.0, 1.0],
        [f64::INFINITY, 0.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, f64::NAN],
        [0.0; 4],
    ] {
        facing(&mesh, light.into(), false, CastRule::BothSigns, &mut signs);
        assert_eq!(signs, [0], "{light:?}");
    }
    for (light, expected) in [
        ([0.0, 0.0, 1e300, 1.0], 1),
        ([0.0, 0.0, -1e-300, 0.0], -1),
        ([0.0, 0.0, 1e300, 1e-300], 1),
        ([0.0, 0.0, 1e300, -1e-300], -1),
        ([0.0, 0.0, -3.0, -1.0], 1),
        ([5.0, 5.0, 1e-300, 1.0], 1),
    ] {
        facing(&mesh, light.into(), false, CastRule::BothSigns, &mut signs);
        assert_eq!(signs, [expected], "{light:?}");
    }
}
