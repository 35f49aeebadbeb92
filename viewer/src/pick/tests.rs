//! Special cases of picking, as rows. The f64 ray tracer judges the rest (crate `tests`).

use std::path::Path;
use std::sync::Arc;

use glam::{DVec3, DVec4};
use scenegraph::scene::{Faces, Scene};
use scenegraph::{FileLoader, ResolveOptions, load, resolve};

use super::*;
use crate::content::Content;
use crate::texture::Images;
use crate::view::{DepthRange, Lens, Region, View, looking};

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

fn scene_of(body: &str) -> Scene {
    let text = format!("#Inventor V2.1 ascii\n{body}");
    let loader = FileLoader::default();
    let graph = load(text.as_bytes(), "scene.iv", Path::new("."), &loader);
    resolve(&graph, &ResolveOptions::default()).scene
}

fn picker_of(scene: Scene) -> (Picker, Content) {
    let content = Content::new(&scene, &Images::none());
    (Picker::new(Arc::new(scene), &content), content)
}

const PERSPECTIVE: Lens = Lens::Perspective {
    tan_half_height: 0.5,
};
const PARALLEL: Lens = Lens::Orthographic { half_height: 5.0 };

/// From (0, 0, 10) along -Z. With [`region`] a unit at Z = 0 is 10 pixels, and the origin is at
/// (100, 50).
fn view(lens: Lens) -> View {
    View {
        eye: v(0.0, 0.0, 10.0),
        orientation: looking(DVec3::NEG_Z, DVec3::Y).unwrap(),
        lens,
    }
}

fn region() -> Region {
    Region::whole(200, 100)
}

/// A square of side 4 through the origin, its front to +Z.
const WALL: &str = "Coordinate3 { point [ -2 -2 0, 2 -2 0, 2 2 0, -2 2 0 ] }
    IndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1 ] }\n";
const SOLID: &str = "ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType SOLID }\n";
/// From (-3, 1) to (3, 1), four pixels wide.
const LINE: &str = "DrawStyle { lineWidth 4 } LightModel { model BASE_COLOR }
    Coordinate3 { point [ -3 1 0, 3 1 0 ] } LineSet { }\n";
/// At (1, 0), six pixels wide.
const POINT: &str = "DrawStyle { pointSize 6 } LightModel { model BASE_COLOR }
    Coordinate3 { point [ 1 0 0 ] } PointSet { }\n";

fn at(z: f64, body: &str) -> String {
    format!("Separator {{ Translation {{ translation 0 0 {z} }} {body} }}\n")
}

fn pick_in(body: &str, lens: Lens, pixel: [f64; 2], options: &PickOptions) -> Option<Hit> {
    let scene = scene_of(body);
    assert_eq!(scene.check(), Vec::new());
    let (mut picker, _) = picker_of(scene);
    let aim = picker.aim(&view(lens), &region(), pixel)?;
    picker.pick(&aim, |_| true, options)
}

fn near(a: DVec3, b: DVec3) -> bool {
    // Coordinates are below 32 and go through a few roundings.
    (a - b).length() < 1e-13
}

/// Name, body, lens, pixel, tolerance; instance and place.
type Row<'a> = (
    &'a str,
    String,
    Lens,
    [f64; 2],
    f64,
    Option<(u32, [f64; 3])>,
);

fn check(rows: &[Row<'_>]) {
    for (name, body, lens, pixel, tolerance_px, expected) in rows {
        let options = PickOptions {
            tolerance_px: *tolerance_px,
            cut: None,
        };
        let hit = pick_in(body, *lens, *pixel, &options);
        let got = hit.map(|hit| (hit.instance, hit.p_in_world));
        match (got, expected) {
            (None, None) => {}
            (Some((i, p)), Some((j, q))) => {
                assert!(i == *j && near(p, DVec3::from(*q)), "{name}: {i} at {p}");
            }
            _ => panic!("{name}: {got:?}"),
        }
    }
}

#[test]
fn triangles() {
    let wall = || WALL.to_owned();
    let two = format!("{}{}", at(-1.0, WALL), at(1.0, WALL));
    let turned =
        |about: &str| format!("Separator {{ {SOLID} Rotation {{ rotation {about} }} {WALL} }}");
    let scaled = |by: &str, body: &str| format!("Scale {{ scaleFactor {by} }} {body}");
    let (per, par) = (PERSPECTIVE, PARALLEL);
    let middle = [100.0, 50.0];
    let front = format!("{SOLID}{WALL}");
    let rows = [
        (
            "inside",
            wall(),
            per,
            [105.0, 47.0],
            0.0,
            Some((0, [0.5, 0.3, 0.0])),
        ),
        (
            "inside, parallel",
            wall(),
            par,
            [105.0, 47.0],
            0.0,
            Some((0, [0.5, 0.3, 0.0])),
        ),
        (
            "on the diagonal",
            wall(),
            per,
            middle,
            0.0,
            Some((0, [0.0; 3])),
        ),
        (
            "on a corner",
            wall(),
            per,
            [120.0, 30.0],
            0.0,
            Some((0, [2.0, 2.0, 0.0])),
        ),
        (
            "on an edge",
            wall(),
            par,
            [120.0, 44.0],
            0.0,
            Some((0, [2.0, 0.6, 0.0])),
        ),
        ("beside", wall(), per, [120.000_001, 50.0], 0.0, None),
        (
            "beside with a tolerance",
            wall(),
            per,
            [121.0, 50.0],
            5.0,
            None,
        ),
        (
            "the nearer",
            two.clone(),
            per,
            middle,
            0.0,
            Some((1, [0.0, 0.0, 1.0])),
        ),
        (
            "the nearer, parallel",
            two,
            par,
            middle,
            0.0,
            Some((1, [0.0, 0.0, 1.0])),
        ),
        ("behind the eye", at(11.0, WALL), per, middle, 0.0, None),
        (
            "behind the eye is drawn",
            at(11.0, WALL),
            par,
            middle,
            0.0,
            Some((0, [0.0, 0.0, 11.0])),
        ),
        (
            "seen edge-on",
            "Coordinate3 { point [ -2 0 -2, 2 0 -2, 0 0 2 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] }"
                .to_owned(),
            par,
            middle,
            0.0,
            None,
        ),
        (
            "front",
            front.clone(),
            per,
            middle,
            0.0,
            Some((0, [0.0; 3])),
        ),
        (
            "back",
            turned("0 1 0 3.141592653589793"),
            per,
            middle,
            0.0,
            None,
        ),
        (
            "front, mirrored",
            scaled("-1 1 1", &front),
            per,
            middle,
            0.0,
            Some((0, [0.0; 3])),
        ),
        (
            "back, mirrored",
            scaled("1 1 -1", &front),
            per,
            middle,
            0.0,
            None,
        ),
        (
            "flattened",
            scaled("1 1 0", "Cube { }"),
            per,
            [103.0, 50.0],
            0.0,
            Some((0, [0.3, 0.0, 0.0])),
        ),
        (
            "flattened to nothing",
            scaled("0 0 0", "Cube { }"),
            per,
            middle,
            0.0,
            None,
        ),
        (
            "through it, in part behind the eye",
            "Coordinate3 { point [ -50 -1 90, 50 -1 90, 0 -1 -90 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] }"
                .to_owned(),
            per,
            [100.0, 60.0],
            0.0,
            Some((0, [0.0, -1.0, 0.0])),
        ),
        ("nothing at all", String::new(), per, middle, 9.0, None),
        (
            "outside of the image",
            at(-50.0, &scaled("99 99 1", WALL)),
            per,
            [200.5, 50.0],
            0.0,
            None,
        ),
    ];
    check(&rows);
}

#[test]
fn lines_and_points() {
    let (per, par) = (PERSPECTIVE, PARALLEL);
    let line = || LINE.to_owned();
    let point = || POINT.to_owned();
    let end_on =
        "LightModel { model BASE_COLOR } Coordinate3 { point [ 0 0 0, 0 0 5 ] } LineSet { }";
    let through_eye = "LightModel { model BASE_COLOR } DrawStyle { lineWidth 4 }
        Coordinate3 { point [ 0 -1 20, 0 -1 0 ] } LineSet { }";
    let before = |z: f64, body: &str| format!("{WALL}{}", at(z, body));
    let on_line = Some((0, [0.5, 1.0, 0.0]));
    let on_point = Some((0, [1.0, 0.0, 0.0]));
    let rows = [
        ("in the width", line(), per, [105.0, 41.9], 0.0, on_line),
        (
            "in the width, parallel",
            line(),
            par,
            [105.0, 38.1],
            0.0,
            on_line,
        ),
        ("beside the width", line(), per, [105.0, 42.1], 0.0, None),
        (
            "within the tolerance",
            line(),
            per,
            [105.0, 44.9],
            3.0,
            on_line,
        ),
        (
            "beyond the tolerance",
            line(),
            per,
            [105.0, 45.1],
            3.0,
            None,
        ),
        (
            "before the end",
            line(),
            per,
            [70.1, 40.0],
            0.0,
            Some((0, [-2.99, 1.0, 0.0])),
        ),
        ("behind the end", line(), per, [69.9, 40.0], 0.0, None),
        (
            "near the end",
            line(),
            par,
            [67.1, 44.0],
            5.0,
            Some((0, [-3.0, 1.0, 0.0])),
        ),
        ("not so near the end", line(), par, [65.0, 44.1], 5.0, None),
        (
            "along itself",
            end_on.to_owned(),
            par,
            [100.4, 50.0],
            0.0,
            None,
        ),
        (
            "in part behind the eye",
            through_eye.to_owned(),
            per,
            [101.0, 60.0],
            0.0,
            Some((0, [0.0, -1.0, 0.0])),
        ),
        ("square", point(), per, [112.9, 47.1], 0.0, on_point),
        ("beside the square", point(), per, [113.1, 50.0], 0.0, None),
        (
            "near the square",
            point(),
            par,
            [116.0, 54.0],
            3.2,
            on_point,
        ),
        ("not so near", point(), par, [115.4, 55.4], 3.2, None),
        (
            "point behind the eye",
            at(12.0, POINT),
            per,
            [100.0, 50.0],
            90.0,
            None,
        ),
        // Drawn nearer by 2^-13 of the distance, 0.0012 here.
        (
            "on a face",
            before(0.0, LINE),
            per,
            [105.0, 41.0],
            0.0,
            Some((1, [0.5, 1.0, 0.0])),
        ),
        (
            "point on a face",
            before(0.0, POINT),
            per,
            [110.0, 50.0],
            0.0,
            Some((1, [1.0, 0.0, 0.0])),
        ),
        (
            "hardly behind a face",
            before(-0.001, POINT),
            per,
            [110.0, 50.0],
            0.0,
            Some((1, [1.0, 0.0, -0.001])),
        ),
        (
            "behind a face",
            before(-0.0015, POINT),
            per,
            [110.0, 50.0],
            0.0,
            Some((0, [1.0, 0.0, 0.0])),
        ),
        (
            "hidden, with a tolerance",
            before(-1.0, LINE),
            per,
            [105.0, 42.0],
            5.0,
            Some((0, [0.5, 0.8, 0.0])),
        ),
        (
            "on a face, with a tolerance",
            before(0.0, LINE),
            per,
            [105.0, 45.0],
            5.0,
            Some((1, [0.5, 1.0, 0.0])),
        ),
        (
            "beside a face that hides a part",
            before(-1.0, LINE),
            par,
            [121.0, 42.0],
            5.0,
            Some((1, [2.1, 1.0, -1.0])),
        ),
    ];
    check(&rows);
}

#[test]
fn what_is_drawn_wins_in_one_place() {
    let glass = |body: &str| format!("Separator {{ Material {{ transparency 0.5 }} {body} }}\n");
    let plain = |body: &str| format!("Separator {{ {body} }}\n");
    // The same place in another frame, off by roundings.
    let again = format!(
        "Separator {{ Rotation {{ rotation 1 1 0 .7 }} Rotation {{ rotation 1 1 0 -.7 }} {WALL} }}\n"
    );
    let rows = [
        ("first of two", format!("{}{}", plain(WALL), plain(WALL)), 0),
        ("first of two frames", format!("{}{again}", plain(WALL)), 0),
        (
            "first of two frames, turned about",
            format!("{again}{}", plain(WALL)),
            0,
        ),
        (
            "opaque of both",
            format!("{}{}", glass(WALL), plain(WALL)),
            1,
        ),
        (
            "last of two transparent ones",
            format!("{}{}", glass(WALL), glass(WALL)),
            1,
        ),
    ];
    for (name, body, instance) in rows {
        let (mut picker, content) = picker_of(scene_of(&body));
        for [x, y] in [[100.0, 50.0], [103.3, 47.7], [111.1, 62.3], [117.7, 31.3]] {
            let aim = picker.aim(&view(PERSPECTIVE), &region(), [x, y]).unwrap();
            let hit = picker
                .pick(&aim, |_| true, &PickOptions::default())
                .unwrap();
            let drawn = content.objects[hit.object as usize].instance;
            assert_eq!((hit.instance, drawn), (instance, instance), "{name}");
            // What is not shown is not in the way.
            let other = picker.pick(&aim, |i| i != hit.object, &PickOptions::default());
            assert_eq!(other.map(|hit| hit.instance), Some(1 - instance), "{name}");
        }
    }
}

#[test]
fn sections() {
    let two = format!("{}{}{}", at(-1.0, WALL), at(1.0, WALL), at(2.0, LINE));
    let rows = [
        (DVec4::new(0.0, 0.0, -1.0, 9.0), Some(1)),
        (DVec4::new(0.0, 0.0, -1.0, 0.5), Some(0)),
        (DVec4::new(0.0, 0.0, -1.0, -5.0), None),
        (DVec4::new(0.0, 1.0, 0.0, 0.0), Some(1)),
        (DVec4::new(0.0, -1.0, 0.0, -1.0), None),
        (DVec4::NAN, Some(1)),
    ];
    for (cut, instance) in rows {
        let options = PickOptions {
            cut: Some(cut),
            ..PickOptions::default()
        };
        let hit = pick_in(&two, PERSPECTIVE, [105.0, 49.0], &options);
        assert_eq!(hit.map(|hit| hit.instance), instance, "{cut}");
        // The line's place is asked for, not the pixel's.
        let line = DVec4::new(1.0, 0.0, 0.0, -2.9);
        let options = PickOptions {
            cut: Some(line),
            tolerance_px: 1.0,
        };
        let hit = pick_in(&at(0.0, LINE), PARALLEL, [128.0, 40.0], &options);
        assert_eq!(hit, None);
        assert!(pick_in(&at(0.0, LINE), PARALLEL, [129.5, 40.0], &options).is_some());
    }
}

#[test]
fn what_a_hit_says() {
    let turned = "Translation { translation 1e6 -2e6 3e6 } Scale { scaleFactor 2 -3 0.5 }
        Coordinate3 { point [ 0 0 0, 4 0 0, 0 4 4 ] } IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] }";
    let scene = scene_of(turned);
    let (mut picker, _) = picker_of(scene);
    let base = v(1e6, -2e6, 3e6);
    let corners = [base, base + v(8.0, 0.0, 0.0), base + v(0.0, -12.0, 2.0)];
    let target = base + v(2.0, -3.0, 0.5);
    let eye = target + v(3.0, 4.0, 12.0);
    let aim = Aim::along(eye, (target - eye) * 5.0).unwrap();
    let hit = picker
        .pick(&aim, |_| true, &PickOptions::default())
        .unwrap();
    // A rounding at three million is 5e-10.
    let close = |a: DVec3, b: DVec3| (a - b).length() < 4e-9;
    assert!((hit.distance - 13.0).abs() < 4e-9 && hit.depth == hit.distance);
    assert!(close(hit.p_in_world, target), "{hit:?}");
    let Part::Triangle {
        corners: c,
        weights,
        normal,
    } = hit.part
    else {
        panic!("{hit:?}");
    };
    assert_eq!(c, corners);
    for (got, wanted) in weights.into_iter().zip([0.5, 0.25, 0.25]) {
        assert!((got - wanted).abs() < 1e-9, "{weights:?}");
    }
    // Counter-clockwise in the file, clockwise in its mirrored frame: the normal of the front is
    // against the cross product of the world's edges.
    let wanted = -v(8.0, 0.0, 0.0).cross(v(0.0, -12.0, 2.0)).normalize();
    assert!((normal - wanted).length() < 1e-12, "{normal}");
    assert!(picker.mesh_bytes() > 0);
    let backwards = Aim::along(eye, eye - target).unwrap();
    assert_eq!(
        picker.pick(&backwards, |_| true, &PickOptions::default()),
        None
    );
}

#[test]
fn no_ray_leaves_a_closed_sphere() {
    // Towards corners and edges, where boxes and triangles end.
    for (place, tolerance) in [("0 0 0", 1e-13), ("1e6 -2e6 3e6", 4e-9)] {
        let mut scene = scene_of(&format!(
            "Complexity {{ value 0.7 }} Translation {{ translation {place} }} Transform {{
            rotation 1 2 3 0.777 scaleFactor -1.1 0.9 0.7 }} Sphere {{ }}"
        ));
        // Seen from the inside.
        scene.materials[0].faces = Faces::BothTwoSidedLighting;
        let mesh = &scene.meshes[0];
        let world = scene.instances[0].placement.world_from_local;
        let corners: Vec<DVec3> = (mesh.indices.iter())
            .map(|&i| world.transform_point3(mesh.p_in_local(i)))
            .collect();
        let (mut picker, _) = picker_of(scene);
        for eye in [v(0.0, 0.0, 0.0), v(0.1, 0.2, 0.3)] {
            let eye = world.transform_point3(eye);
            for abc in corners.chunks_exact(3) {
                for target in [abc[0], abc[0].midpoint(abc[1]), abc[0].lerp(abc[2], 0.9)] {
                    let aim = Aim::along(eye, target - eye).unwrap();
                    let hit = picker.pick(&aim, |_| true, &PickOptions::default());
                    let distance = hit.map_or(f64::NAN, |hit| hit.distance);
                    let expected = (target - eye).length();
                    assert!(
                        (distance - expected).abs() < tolerance,
                        "{target}: {distance}"
                    );
                }
            }
        }
    }
}

#[test]
fn pixels_and_rays() {
    let oblique = looking(v(1.0, 2.0, -3.0), v(0.1, 0.2, 1.0)).unwrap();
    let stretched = Region {
        x: 30,
        y: 7,
        width: 120,
        height: 90,
        aspect: 0.7,
    };
    for lens in [PERSPECTIVE, PARALLEL] {
        for orientation in [view(lens).orientation, oblique] {
            let view = View {
                eye: v(1e6, 2.0, -3.0),
                orientation,
                lens,
            };
            for region in [region(), stretched, Region::cropped(200, 100, 0.5)] {
                for pixel in [[100.0, 50.0], [30.0, 7.0], [149.5, 96.5], [90.25, 33.0]] {
                    let ray = Ray::through_pixel(&view, &region, pixel).unwrap();
                    let p = ray.origin + ray.direction * 20.0;
                    // By the matrix that the renderer draws with.
                    let range = DepthRange {
                        near: 1.0,
                        far: 99.0,
                    };
                    let clip =
                        view.clip_from_view(region.aspect, range) * view.p_in_view(p).extend(1.0);
                    let drawn = [
                        f64::from(region.x)
                            + f64::from(region.width) * (0.5 + 0.5 * clip.x / clip.w),
                        f64::from(region.y)
                            + f64::from(region.height) * (0.5 - 0.5 * clip.y / clip.w),
                    ];
                    let back = pixel_of(&view, &region, p).unwrap();
                    for axis in 0..2 {
                        // A rounding at a million, 1e-10, times some ten pixels a unit.
                        assert!(
                            (drawn[axis] - pixel[axis]).abs() < 1e-8,
                            "{drawn:?} {pixel:?}"
                        );
                        assert!(
                            (back[axis] - pixel[axis]).abs() < 1e-8,
                            "{back:?} {pixel:?}"
                        );
                    }
                }
            }
            let behind = pixel_of(&view, &region(), view.eye - view.forward() * 3.0);
            assert_eq!(behind.is_some(), lens == PARALLEL);
        }
    }
}

#[test]
fn snapping() {
    // A triangle of 40 pixels; hit, tolerance; place, whether it is a vertex, distance.
    let rows = [
        (
            PERSPECTIVE,
            [117.0, 66.0],
            6.0,
            Some(([2.0, -2.0, 0.0], true, 5.0)),
        ),
        (
            PERSPECTIVE,
            [117.0, 66.0],
            4.5,
            Some(([2.0, -1.6, 0.0], false, 3.0)),
        ),
        (
            PARALLEL,
            [117.0, 66.0],
            3.5,
            Some(([2.0, -1.6, 0.0], false, 3.0)),
        ),
        (PARALLEL, [117.0, 66.0], 2.5, None),
        (
            PARALLEL,
            [100.0, 50.0],
            0.0,
            Some(([0.0, 0.0, 0.0], false, 0.0)),
        ),
        (PERSPECTIVE, [117.0, 66.0], f64::NAN, None),
    ];
    for (lens, pixel, tolerance_px, expected) in rows {
        let hit = pick_in(WALL, lens, pixel, &PickOptions::default()).unwrap();
        let snapped = snap(&hit, tolerance_px, &view(lens), &region());
        match (snapped, expected) {
            (None, None) => {}
            (Some(snap), Some((p, is_vertex, distance))) => {
                assert!(near(snap.p_in_world, DVec3::from(p)), "{snap:?}");
                assert_eq!(snap.feature == Feature::Vertex, is_vertex, "{snap:?}");
                assert!((snap.distance_px - distance).abs() < 1e-11, "{snap:?}");
            }
            _ => panic!("{pixel:?} {tolerance_px}: {snapped:?}"),
        }
    }
    let options = PickOptions::default();
    let line = pick_in(LINE, PERSPECTIVE, [128.0, 41.0], &options).unwrap();
    let snapped = snap(&line, 3.0, &view(PERSPECTIVE), &region()).unwrap();
    assert!(snapped.feature == Feature::Vertex && near(snapped.p_in_world, v(3.0, 1.0, 0.0)));
    let snapped = snap(&line, 1.0, &view(PERSPECTIVE), &region()).unwrap();
    assert!(snapped.feature != Feature::Vertex && near(snapped.p_in_world, v(2.8, 1.0, 0.0)));
}

#[test]
fn any_numbers_end() {
    let strange = [f64::NAN, f64::INFINITY, -1e300, 0.0, 1e-300, 50.0];
    let mut scene = scene_of(&format!("{}{LINE}{POINT}", at(0.0, WALL)));
    let mut broken = scene.clone();
    for mesh in &mut broken.meshes {
        mesh.positions[0] = [f32::NAN, f32::INFINITY, 0.0];
        mesh.indices.push(7_000_000);
    }
    for instance in &mut broken.instances {
        instance.placement.world_from_local.translation.x = f64::INFINITY;
    }
    scene.instances[0]
        .placement
        .world_from_local
        .matrix3
        .x_axis
        .x = f64::NAN;
    for scene in [scene, broken, Scene::default()] {
        let (mut picker, _) = picker_of(scene);
        for a in strange {
            for b in strange {
                let lens = [
                    Lens::Perspective { tan_half_height: a },
                    PARALLEL,
                    PERSPECTIVE,
                ];
                for lens in lens {
                    let view = View {
                        eye: v(b, 0.0, 10.0),
                        ..view(lens)
                    };
                    let options = PickOptions {
                        tolerance_px: a,
                        cut: Some(DVec4::new(b, a, 1.0, 0.0)),
                    };
                    let pixel = [a.clamp(0.0, 200.0), 50.0];
                    for aim in [
                        picker.aim(&view, &region(), pixel),
                        picker.aim(&view, &region(), [a, b]),
                        Aim::along(v(a, b, 1.0), v(b, 1.0, a)),
                    ] {
                        let Some(aim) = aim else { continue };
                        let hit = picker.pick(&aim, |_| true, &options);
                        hit.and_then(|hit| snap(&hit, a, &view, &region()));
                    }
                }
            }
        }
    }
}
