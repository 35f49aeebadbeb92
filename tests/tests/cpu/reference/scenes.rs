//! The scenes made for shadows hold what they are made for.

use std::collections::BTreeMap;
use std::path::Path;

use glam::DVec3;
use scenegraph::{FileLoader, ResolveOptions, load, resolve};
use tests::measure::{primitives, totals};
use tests::reference::{Ray, RefImage, RefOptions, Reference};
use tests::shadow_scenes::{
    GridLight, GridSize, LAYERS, ShadowScene, all, closed_room, eye_on_side_plane, light_in_plane,
    many_on_an_edge, mirrored, nested_shells, parallel_views, quad_stack, scene_of, sphere_grid,
};

use super::BACKGROUND;

const OFFSET: DVec3 = DVec3::new(1e4, -3e3, 2e4);

fn pictures(scene: &ShadowScene, size: [u32; 2]) -> Vec<(&'static str, RefImage)> {
    let resolved = scene_of(&scene.text);
    let options = RefOptions::of(&resolved);
    let reference = Reference::new(&resolved, &options);
    let picture = |camera| reference.render(camera, size, BACKGROUND);
    (scene.cameras.iter())
        .map(|(name, camera)| (*name, picture(camera)))
        .collect()
}

#[test]
fn scenes_are_read_without_a_remark_and_can_be_seen() {
    let grid = sphere_grid(GridSize::SMALL, GridLight::Directional);
    let mut names = Vec::new();
    for scene in all(OFFSET).iter().chain([&grid]) {
        let files = FileLoader::default();
        let graph = load(scene.text.as_bytes(), "scene.iv", Path::new("."), &files);
        let resolved = resolve(&graph, &ResolveOptions::default());
        let mut remarks = [graph.diagnostics, resolved.diagnostics].concat();
        // One scene is made of them.
        remarks.retain(|remark| remark.code != "degenerate");
        assert!(remarks.is_empty(), "{}: {remarks:?}", scene.name);
        assert!(!names.contains(&scene.name), "{}", scene.name);
        names.push(scene.name);
        for (camera, image) in pictures(scene, [64, 48]) {
            let seen = image.object.iter().flatten().count();
            assert!(seen > 400, "{}, {camera}: {seen}", scene.name);
        }
    }
}

#[test]
fn lit_and_dark_where_they_should_be() {
    // Share of the surface seen that the first light reaches, of all cameras together.
    let share = |scene: &ShadowScene, cameras: &[&str]| {
        let (mut seen, mut lit) = (0_u32, 0_u32);
        for (name, image) in pictures(scene, [64, 48]) {
            for (object, mask) in image.object.iter().zip(&image.lit) {
                let counts = object.is_some() && cameras.contains(&name);
                seen += u32::from(counts);
                lit += u32::from(counts && mask & 1 == 1);
            }
        }
        f64::from(lit) / f64::from(seen)
    };
    let rows = [
        (closed_room(), vec!["outside"], 0.0..=0.0),
        (closed_room(), vec!["inside"], 0.5..=0.99),
        (nested_shells(), vec!["over", "side"], 0.0..=0.0),
        (nested_shells(), vec!["inside"], 1.0..=1.0),
        (quad_stack(), vec!["over"], 0.5..=0.95),
        (parallel_views(), vec!["along"], 1.0..=1.0),
        (parallel_views(), vec!["against"], 0.0..=0.0),
        // The lamp sees no shadows.
        (eye_on_side_plane(), vec!["at the lamp"], 1.0..=1.0),
        (eye_on_side_plane(), vec!["on it"], 0.1..=0.8),
        (light_in_plane(), vec!["over"], 0.5..=0.99),
    ];
    for (scene, cameras, expected) in rows {
        let share = share(&scene, &cameras);
        assert!(
            expected.contains(&share),
            "{} {cameras:?}: {share}",
            scene.name
        );
    }
}

#[test]
fn scenes_hold_what_they_are_about() {
    // From the light to the floor there are as many layers as said, and the floor.
    for (scene, light) in [
        (quad_stack(), [0.3, 5.0, 0.2]),
        (nested_shells(), [0.0, 1.5, 0.0]),
    ] {
        let ray = Ray::new(DVec3::from(light), DVec3::new(0.01, -1.0, 0.017));
        let all = scene_of(&scene.text);
        let corners = primitives(&all).map(|p| [0, 1, 2].map(|i| p.corners[i].p_in_world));
        let crossings = corners
            .filter_map(|corners| ray.cross(&corners))
            .filter(|at| at.t > 0.0);
        assert_eq!(crossings.count(), LAYERS + 1, "{}", scene.name);
    }
    // The most triangles that have an edge in common.
    let mut edges: BTreeMap<[[u64; 3]; 2], usize> = BTreeMap::new();
    for triangle in primitives(&scene_of(&many_on_an_edge().text)) {
        let corner = |i: usize| {
            triangle.corners[i % 3]
                .p_in_world
                .to_array()
                .map(f64::to_bits)
        };
        for i in 0..3 {
            let mut edge = [corner(i), corner(i + 1)];
            edge.sort_unstable();
            *edges.entry(edge).or_default() += 1;
        }
    }
    assert_eq!(edges.values().max(), Some(&128));
    let scene = scene_of(&mirrored().text);
    let signs =
        |i: &scenegraph::scene::Instance| i.placement.world_from_local.matrix3.determinant() < 0.0;
    assert_eq!(scene.instances.iter().filter(|i| signs(i)).count(), 4);
}

#[test]
fn grids_have_as_many_triangles_as_asked_for() {
    let one_each = GridSize {
        spheres: 7,
        triangles: 7 * 288,
        shared: false,
    };
    let rows = [
        (GridSize::SMALL, 28_800, 2),
        (GridSize::MEDIUM, 96_000, 2),
        (one_each, 7 * 288, 8),
    ];
    for (size, triangles, meshes) in rows {
        let scene = scene_of(&sphere_grid(size, GridLight::Point).text);
        // And the floor.
        assert_eq!(totals(&scene).triangles, triangles + 2);
        assert_eq!(scene.meshes.len(), meshes);
        assert_eq!(scene.instances.len(), size.spheres + 1);
    }
    assert_eq!(GridSize::LARGE.sphere_triangles(), 372_000);
    assert_eq!(GridSize::HUGE.sphere_triangles(), 1_020_000);
}
