//! Rays and triangles: nothing slips between triangles, and the nearest one is found.

use glam::DVec3;
use scenegraph::scene::Scene;
use tests::measure::primitives;
use tests::reference::{Ray, RefOptions, Reference};
use tests::shadow_scenes::scene_of;

use super::{parallel, picture, to_origin};

/// A fine sphere of radius 1.
const BALL: &str = "#Inventor V2.1 ascii\nComplexity { value 1 } Sphere { }";
/// The same, no coordinate of which is a round number.
const CROOKED_BALL: &str = "#Inventor V2.1 ascii\nComplexity { value 0.4 }
    Transform { translation 0.123 -0.456 0.0789 rotation 1 2 3 0.777 scaleFactor 1.1 0.9 0.7 } Sphere { }";

/// The triangles of a scene.
fn triangles(scene: &Scene) -> Vec<[DVec3; 3]> {
    let corners = |p: tests::measure::Primitive| [0, 1, 2].map(|i| p.corners[i].p_in_world);
    primitives(scene).map(corners).collect()
}

#[test]
fn no_ray_leaves_a_closed_sphere() {
    for (text, eyes) in [
        (BALL, [[0.0, 0.0, 0.0], [0.25, 0.0, 0.0], [0.1, 0.2, 0.3]]),
        (
            CROOKED_BALL,
            [[0.123, -0.456, 0.0789], [0.0, -0.25, 0.0], [0.4, -0.3, 0.2]],
        ),
    ] {
        let scene = scene_of(text);
        let options = RefOptions::of(&scene);
        let reference = Reference::new(&scene, &options);
        for eye in eyes.map(DVec3::from) {
            for [a, b, c] in triangles(&scene) {
                // Corners, edges, and a point inside.
                let targets = [
                    a,
                    a.midpoint(b),
                    a.lerp(b, 0.3),
                    a.lerp(c, 0.9),
                    (a + b + c) / 3.0,
                ];
                for target in targets {
                    let hit = reference.first_hit(eye, target - eye);
                    let t = hit.map_or(f64::NAN, |(_, at)| at.t);
                    assert!((t - 1.0).abs() < 1e-12, "from {eye} to {target}: {t}");
                }
            }
        }
    }
}

#[test]
fn crossings_in_closed_form() {
    let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]].map(DVec3::from);
    let inside = Some((3.0, [0.5, 0.25, 0.25]));
    let rows = [
        ("front", [1.0, 1.0, 3.0], [0.0, 0.0, -1.0], inside),
        ("back", [1.0, 1.0, -3.0], [0.0, 0.0, 1.0], inside),
        ("slanted", [-2.0, 1.0, 3.0], [1.0, 0.0, -1.0], inside),
        ("twice as long", [1.0, 1.0, 6.0], [0.0, 0.0, -2.0], inside),
        (
            "behind",
            [1.0, 1.0, 3.0],
            [0.0, 0.0, 1.0],
            Some((-3.0, [0.5, 0.25, 0.25])),
        ),
        (
            "edge",
            [2.0, 0.0, 1.0],
            [0.0, 0.0, -1.0],
            Some((1.0, [0.5, 0.5, 0.0])),
        ),
        (
            "corner",
            [0.0, 4.0, 1.0],
            [0.0, 0.0, -1.0],
            Some((1.0, [0.0, 0.0, 1.0])),
        ),
        ("beside", [3.0, 3.0, 3.0], [0.0, 0.0, -1.0], None),
        ("just beside", [2.0, -1e-300, 3.0], [0.0, 0.0, -1.0], None),
        ("parallel", [-1.0, 1.0, 3.0], [1.0, 0.0, 0.0], None),
        ("in its plane", [-1.0, 1.0, 0.0], [1.0, 0.0, 0.0], None),
        ("no direction", [1.0, 1.0, 3.0], [0.0, 0.0, 0.0], None),
        ("no number", [1.0, f64::NAN, 3.0], [0.0, 0.0, -1.0], None),
    ];
    for (name, origin, direction, expected) in rows {
        let ray = Ray::new(DVec3::from(origin), DVec3::from(direction));
        // Every order of the corners, which turns the triangle round as well.
        for order in [
            [0, 1, 2],
            [1, 2, 0],
            [2, 0, 1],
            [0, 2, 1],
            [2, 1, 0],
            [1, 0, 2],
        ] {
            let at = ray.cross(&order.map(|i| corners[i]));
            let got = at.map(|at| (at.t, at.weights));
            let wanted =
                expected.map(|(t, weights): (f64, [f64; 3])| (t, order.map(|i| weights[i])));
            assert_eq!(got, wanted, "{name} {order:?}");
        }
    }
}

#[test]
fn triangles_without_area_are_not_hit() {
    let text = "#Inventor V2.1 ascii
        Scale { scaleFactor 1 1 0 } Coordinate3 { point [ 0 0 0, 3 1 5, 6 2 -4 ] }
        IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] }";
    let scene = scene_of(text);
    let flat = triangles(&scene);
    assert_eq!(flat.len(), 1);
    let options = RefOptions::of(&scene);
    let reference = Reference::new(&scene, &options);
    let mut by_rounding = 0;
    for i in 0..1000 {
        let origin = DVec3::new(0.1, 0.7, 0.3) * f64::from(i);
        let direction = flat[0][2] * (f64::from(i) / 1000.0) - origin;
        let ray = Ray::new(origin, direction);
        by_rounding += usize::from(ray.cross(&flat[0]).is_some());
        assert_eq!(reference.first_hit(origin, direction), None);
    }
    assert!(by_rounding > 0);
}

#[test]
fn the_nearest_of_all_is_found() {
    // Boxes of every size, one in another.
    let boxes: String = (0..60)
        .map(|i| {
            let [x, y, z] = [7 * i % 11, 5 * i % 13, 3 * i % 7].map(|n| n as f64 / 4.0 - 1.0);
            let size = 0.05 + (i % 9) as f64 * 0.1;
            format!(
                "Separator {{ Transform {{ translation {x} {y} {z} rotation 1 2 3 {i} }}
                Cube {{ width {size} height 0.2 depth 0.3 }} }}\n"
            )
        })
        .collect();
    let scene = scene_of(&format!("#Inventor V2.1 ascii\n{boxes}"));
    let triangles = triangles(&scene);
    let options = RefOptions::of(&scene);
    let reference = Reference::new(&scene, &options);
    let mut hits = 0;
    for i in 0..4000 {
        let [a, b, c] = [i % 17, i % 23, i % 29].map(|n| f64::from(n) / 7.0 - 1.5);
        let (origin, direction) = (
            DVec3::new(4.0 * a, b, c),
            DVec3::new(0.3 - a, c - b, 0.2 - c),
        );
        let ray = Ray::new(origin, direction);
        let all = triangles.iter().filter_map(|corners| ray.cross(corners));
        let nearest = all
            .map(|at| at.t)
            .filter(|&t| t > 0.0)
            .min_by(f64::total_cmp);
        let got = reference.first_hit(origin, direction).map(|(_, at)| at.t);
        assert_eq!(got, nearest, "{origin} {direction}");
        hits += usize::from(got.is_some());
    }
    assert!((1000..3900).contains(&hits), "{hits}");
}

#[test]
fn outline_of_a_sphere() {
    // 64 slices and 32 bands; a triangle is nowhere nearer to the centre than the product of the
    // cosines of half a slice and half a band.
    let half_step = std::f64::consts::PI / 64.0;
    let inner = half_step.cos().powi(2);
    let distance: f64 = 5.0;
    // Tangents of the half angle of the cone around a sphere, over that of half the view.
    let view = 0.3;
    let seen = |radius: f64| radius / (distance * distance - radius * radius).sqrt() / view;
    let mut camera = to_origin([0.0, 3.0, 4.0]);
    camera.lens = tests::reference::RefLens::Perspective {
        tan_half_height: view,
    };
    let rows = [
        (camera, [seen(inner), seen(1.0)]),
        (parallel(1.3), [inner / 1.3, 1.0 / 1.3]),
    ];
    for (camera, [sure, possible]) in rows {
        let size = [150, 100];
        let image = picture("Complexity { value 1 } Sphere { }", &camera, size);
        let mut unsure = 0;
        for (i, object) in image.object.iter().enumerate() {
            let [x, y] = [i % 150, i / 150].map(|n| n as f64 + 0.5);
            let radius = (x - 75.0).hypot(y - 50.0) / 50.0;
            match object {
                _ if radius > sure && radius < possible => unsure += 1,
                Some(_) => assert!(radius <= possible, "{radius}"),
                None => assert!(radius >= sure, "{radius}"),
            }
        }
        assert!(unsure < 60, "{unsure}");
        // The nearest point, to within the chord.
        let middle = image.depth[50 * 150 + 75];
        let nearest = camera.eye.length() - 1.0;
        assert!((nearest..nearest + 0.01).contains(&middle), "{middle}");
    }
}
