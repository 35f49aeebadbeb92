//! Picking, against the f64 ray tracer, which shares no code with it: at random pixels both see the
//! same instance at the same depth.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::sync::Arc;

use glam::{DAffine3, DMat3, DQuat, DVec3};
use scenegraph::scene::{Scene, Topology};
use tests::reference::{RefCamera, RefImage, RefLens, RefOptions, Reference};
use tests::shadow_scenes::scene_of;
use viewer::content::{Content, Primitive};
use viewer::pick::{Part, PickOptions, Picker};
use viewer::texture::Images;
use viewer::view::{Lens, Region, View};

const SIZE: [u32; 2] = [640, 480];
const PIXELS: usize = 1000;

/// By how much a depth may be off, relative to the largest coordinates it is made of: both sides
/// round matrix, product, offset, weights and sum, and the ray's direction. Divided by the cosine at
/// which the surface is seen, as a plane that is moved by d is met d / cosine farther.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Pseudo-random numbers below `n` (Knuth's MMIX).
struct Random(u64);

impl Random {
    fn below(&mut self, n: u32) -> u32 {
        self.0 = (self.0)
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % u64::from(n)) as u32
    }
}

/// The same scene without glass, as the tracer's picture knows opaque surfaces only.
fn opaque(mut scene: Scene) -> Scene {
    for material in &mut scene.materials {
        material.transparency = 0.0;
        material.texture = None;
    }
    for mesh in &mut scene.meshes {
        mesh.colors_srgb.clear();
    }
    scene
}

/// The picture without lights, which nobody asks about.
fn traced(scene: &Scene, camera: &RefCamera) -> RefImage {
    let options = RefOptions {
        shadows: false,
        ..RefOptions::of(scene)
    };
    Reference::new(scene, &options).render(camera, SIZE, [0.0; 3])
}

fn view_of(camera: &RefCamera) -> View {
    let axes = DMat3::from_cols(camera.right, camera.up, -camera.forward);
    View {
        eye: camera.eye,
        orientation: DQuat::from_mat3(&axes).normalize(),
        lens: match camera.lens {
            RefLens::Perspective { tan_half_height } => Lens::Perspective { tan_half_height },
            RefLens::Orthographic { half_height } => Lens::Orthographic { half_height },
        },
    }
}

/// What came out: pixels with a hit, and those where another instance is in the same place.
#[derive(Debug, Default)]
struct Outcome {
    hits: usize,
    shared: usize,
    instances: BTreeSet<u32>,
}

/// Compares [`PIXELS`] random pixels.
fn compare(scene: Scene, camera: &RefCamera, seed: u64) -> Outcome {
    let scene = opaque(scene);
    let image = traced(&scene, camera);
    let content = Content::new(&scene, &Images::none());
    let mut picker = Picker::new(Arc::new(scene.clone()), &content);
    let view = view_of(camera);
    let region = Region::whole(SIZE[0], SIZE[1]);
    // The tracer has no lines and points.
    let is_shown = |i: u32| content.objects[i as usize].look.primitive == Primitive::Triangles;
    let mut random = Random(seed);
    let mut outcome = Outcome::default();
    for _ in 0..PIXELS {
        let [x, y] = SIZE.map(|n| random.below(n));
        let at = (y * SIZE[0] + x) as usize;
        let pixel = [f64::from(x) + 0.5, f64::from(y) + 0.5];
        let aim = picker.aim(&view, &region, pixel).expect("in the image");
        let hit = picker.pick(&aim, is_shown, &PickOptions::default());
        let (Some(hit), Some(instance)) = (hit, image.object[at]) else {
            assert_eq!(hit.map(|hit| hit.instance), image.object[at], "{x} {y}");
            continue;
        };
        outcome.hits += 1;
        outcome.instances.insert(hit.instance);
        let normal = DVec3::from(image.facet[at].normal);
        let towards = aim.ray().direction;
        let largest = camera.eye.abs().max_element() + hit.distance;
        let tolerance = ROUNDING * largest / normal.dot(towards).abs();
        let expected = image.depth[at];
        assert!(
            (hit.depth - expected).abs() <= tolerance,
            "{x} {y}: {} instead of {expected}, {:e}",
            hit.depth,
            (hit.depth - expected) / tolerance
        );
        // What is there is on the ray, and in the plane that was hit.
        let on_ray = aim.ray().origin + towards * hit.distance;
        assert!((hit.p_in_world - on_ray).length() <= tolerance, "{x} {y}");
        if hit.instance == instance {
            let Part::Triangle { normal: own, .. } = hit.part else {
                panic!("{hit:?}");
            };
            // On an edge either triangle is right.
            if hit.primitive == image.facet[at].id.1 {
                let cosine = own.dot(normal).abs();
                assert!((cosine - 1.0).abs() < 1e-9, "{x} {y}: {own} {normal}");
            }
        } else {
            // Two in one place. The tracer takes the first of the scene, picking the first that
            // is drawn: that one must be alone in meeting the ray there too.
            outcome.shared += 1;
            let options = RefOptions::of(&scene);
            let mut alone = scene.clone();
            alone.instances = vec![scene.instances[hit.instance as usize].clone()];
            let lone = Reference::new(&alone, &options);
            let own = lone.first_hit(aim.ray().origin, towards);
            let distance = own.map_or(f64::NAN, |(_, at)| at.t);
            assert!((distance - hit.distance).abs() <= tolerance, "{x} {y}");
            let order = |instance: u32| {
                let of = |object: &viewer::content::Object| object.instance == instance;
                content.objects.iter().position(of)
            };
            assert!(order(hit.instance) < order(instance), "{x} {y}");
        }
    }
    outcome
}

fn perspective(eye: DVec3, target: DVec3, tan_half_height: f64) -> RefCamera {
    let up = DVec3::new(0.01, 1.0, 0.02);
    RefCamera::look_at(eye, target, up, RefLens::Perspective { tan_half_height })
}

fn pavilion() -> Scene {
    let sample = samples::ALL
        .iter()
        .find(|sample| sample.path.ends_with("pavilion.iv"))
        .expect("in the list");
    let text = std::fs::read_to_string(samples::path_of(sample)).expect("a text");
    scene_of(&text)
}

/// Boxes, balls and cones in a heap: used many times, through each other, mirrored, sheared, culled
/// and not, and every third one twice in the same place.
fn heap() -> Scene {
    let mut text = String::from(
        "#Inventor V2.1 ascii
        Separator { DEF PART Separator { Cube { width 1.3 } Translation { translation .6 .3 .1 }
            ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType SOLID } Sphere { radius .6 } } }
        Separator { DEF OPEN Separator { Cone { parts SIDES } } }\n",
    );
    for i in 0..60 {
        let [x, y, z] = [7 * i % 11, 5 * i % 13, 3 * i % 7].map(|n| f64::from(n) * 0.7 - 3.0);
        let mirror = if i % 2 == 0 { -1.0 } else { 1.0 };
        let part = if i % 4 == 0 { "OPEN" } else { "PART" };
        // A shiny copy is drawn after a dull one, wherever it stands in the scene.
        let looks = ["Material { specularColor 1 1 1 }", "Material { }"];
        for look in &looks[usize::from(i % 3 != 0)..] {
            let _ = writeln!(
                text,
                "Separator {{ {look} Translation {{ translation {x} {y} {z} }}
                Transform {{ rotation 1 2 3 {i} scaleFactor {mirror} .8 1.2
                    scaleOrientation 3 1 2 .{i} }}
                USE {part} }}"
            );
        }
    }
    scene_of(&text)
}

#[test]
fn the_pavilion() {
    let scene = pavilion();
    let (low, high) = corners(&scene);
    let size = (high - low).length();
    let middle = low.midpoint(high);
    let outside = perspective(middle + DVec3::new(0.5, 0.45, 0.8) * size, middle, 0.4);
    let inside = perspective(middle, middle + DVec3::new(0.9, -0.1, 0.4), 0.7);
    for (seed, camera) in [outside, inside].iter().enumerate() {
        let outcome = compare(scene.clone(), camera, seed as u64);
        assert!(outcome.hits > PIXELS / 4, "{outcome:?}");
        assert!(outcome.instances.len() > 10, "{outcome:?}");
    }
}

#[test]
fn instances_through_each_other_and_mirrored() {
    let scene = heap();
    let camera = perspective(DVec3::new(6.0, 7.0, 9.0), DVec3::splat(0.6), 0.45);
    let flat = RefCamera {
        lens: RefLens::Orthographic { half_height: 5.0 },
        ..camera
    };
    for (seed, camera) in [camera, flat].iter().enumerate() {
        let outcome = compare(scene.clone(), camera, seed as u64);
        assert!(outcome.hits > PIXELS / 4, "{outcome:?}");
        assert!(outcome.instances.len() > 30, "{outcome:?}");
        assert!(outcome.shared > 20, "{outcome:?}");
    }
}

#[test]
fn a_million_metres_away() {
    let far = DVec3::new(1e6, -1e6, 1e6) + DVec3::new(0.1, 0.2, 0.3);
    let mut scene = heap();
    for instance in &mut scene.instances {
        let placement = &mut instance.placement;
        placement.world_from_local = DAffine3::from_translation(far) * placement.world_from_local;
    }
    let camera = perspective(
        far + DVec3::new(6.0, 7.0, 9.0),
        far + DVec3::splat(0.6),
        0.45,
    );
    let outcome = compare(scene, &camera, 5);
    assert!(outcome.hits > PIXELS / 4, "{outcome:?}");
}

/// The box around all vertices of triangles.
fn corners(scene: &Scene) -> (DVec3, DVec3) {
    let mut bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for instance in &scene.instances {
        let mesh = &scene.meshes[instance.mesh.index()];
        if mesh.topology != Topology::Triangles {
            continue;
        }
        for i in 0..mesh.positions.len() as u32 {
            let p = instance
                .placement
                .world_from_local
                .transform_point3(mesh.p_in_local(i));
            bounds = (bounds.0.min(p), bounds.1.max(p));
        }
    }
    bounds
}
