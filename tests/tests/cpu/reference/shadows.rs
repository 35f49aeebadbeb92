//! Shadows whose outlines are known.

use glam::DVec3;
use tests::reference::{RefCamera, RefLens, RefOptions, render};
use tests::shadow_scenes::{far_by_coordinates, far_by_transform, scene_of};

use super::{BACKGROUND, WALL, difference, parallel, picture, to_origin};

const SIZE: [u32; 2] = [120, 120];
const HEIGHT: f64 = 1.0;
/// Half the side of the square that casts the shadow.
const HALF: f64 = 0.6;

/// What each pixel of a parallel view onto a large wall shows under a square that floats before it.
fn check_square(light: &str, towards: impl Fn(DVec3) -> DVec3, area: f64) {
    let body = format!(
        "{light} ShapeHints {{ vertexOrdering COUNTERCLOCKWISE }}
        Scale {{ scaleFactor 5 5 1 }} {WALL}
        Scale {{ scaleFactor 0.06 0.06 1 }} Translation {{ translation 0 0 {HEIGHT} }} {WALL}"
    );
    let view = 3.0;
    let image = picture(&body, &parallel(view), SIZE);
    let [width, height] = SIZE.map(f64::from);
    let mut dark = 0;
    for (i, &lit) in image.lit.iter().enumerate() {
        let [x, y] = [i % SIZE[0] as usize, i / SIZE[0] as usize].map(|n| n as f64 + 0.5);
        let p = DVec3::new(2.0 * x / width - 1.0, 1.0 - 2.0 * y / height, 0.0) * view;
        let inside = |p: DVec3| p.x.abs() < HALF && p.y.abs() < HALF;
        let object = u32::from(inside(p));
        assert_eq!(image.object[i], Some(object), "{light}: {p}");
        // The point of the way to the light at the height of the square.
        let to_light = towards(p);
        let shadowed = inside(p + to_light * (HEIGHT / to_light.z));
        dark += u32::from(shadowed);
        let expected = object == 1 || !shadowed;
        assert_eq!(lit == 1, expected, "{light}: {p}");
        // Inventor's defaults for ambient light, 0.2 of 0.2, are all that is left in the shadow.
        let is_dark = difference(image.color[i], [0.04; 3]) < 1e-12;
        assert_eq!(is_dark, !expected, "{light}: {p}");
    }
    // The count of pixel centres in a square errs by less than its circumference in pixels.
    let pixel = 2.0 * view / height;
    let got = f64::from(dark) * pixel * pixel;
    assert!(
        (got - area).abs() < 4.0 * area.sqrt() * pixel,
        "{light}: {got} for {area}"
    );
}

#[test]
fn shadow_of_a_square() {
    let side = 2.0 * HALF;
    // Similar triangles: the light is 3 above the wall, so the shadow is larger by 3 / (3 - 1).
    let lamp = DVec3::new(0.23, -0.41, 3.0);
    let area = (side * 1.5).powi(2);
    check_square("PointLight { location 0.23 -0.41 3 }", |p| lamp - p, area);
    let sun = DVec3::new(0.5, -0.3, 1.0);
    check_square(
        "DirectionalLight { direction -0.5 0.3 -1 }",
        |_| sun,
        side.powi(2),
    );
}

#[test]
fn which_side_is_lit() {
    let lamp = |z: f64| format!("PointLight {{ location 0.3 0.2 {z} }}\n");
    let front = [0.0, 0.0, 5.0];
    // The same triangles again, turned, shifted in their plane, and ones without area.
    let more = "Scale { scaleFactor -1 1 1 } Rotation { rotation 0 0 1 0.7 }
        Coordinate3 { point [ -2 -2 0, 2 -2 0, 2 2 0, -2 2 0, 0 0 1, 0 0 2, 0 0 3 ] }
        IndexedFaceSet { coordIndex [ 3, 2, 1, 0, -1, 0, 1, 2, 3, -1, 4, 5, 6, -1, 4, 4, 5, -1 ] }";
    let rows = [
        ("light on the eye's side", lamp(2.0), front, 1),
        ("light on the other side", lamp(-2.0), front, 0),
        ("eye and light behind", lamp(-2.0), [0.0, 0.1, -5.0], 1),
        ("light in the plane", lamp(0.0), front, 1),
        (
            "sun in the plane",
            "DirectionalLight { direction 1 0 0 }".to_owned(),
            front,
            1,
        ),
        (
            "sun behind",
            "DirectionalLight { direction 1 0 0.001 }".to_owned(),
            front,
            0,
        ),
    ];
    for (name, light, eye, lit) in rows {
        for wall in [WALL.to_owned(), WALL.repeat(2), format!("{WALL}{more}")] {
            let image = picture(&format!("{light}{wall}"), &to_origin(eye), [1, 1]);
            assert_eq!(image.lit, [lit], "{name}");
        }
    }
}

#[test]
fn a_light_in_a_triangles_plane_is_not_shadowed_by_it() {
    // A wall at a right angle to that looked at, between the point and the lamp's foot; the lamp
    // moves through its plane x = 1.
    let across = "Translation { translation 1 0 0 } Rotation { rotation 0 1 0 1.5707963267948966 }";
    let rows = [(0.99, 1), (1.0, 1), (1.01, 0)];
    for (x, lit) in rows {
        let body = format!("PointLight {{ location {x} 0.1 1 }} {WALL}{across}{WALL}");
        let image = picture(&body, &to_origin([0.0, 0.0, 5.0]), [1, 1]);
        assert_eq!(image.lit, [lit], "{x}");
    }
}

#[test]
fn a_triangle_shadows_itself_up_to_its_edge() {
    // A thing far away makes the rounding of coordinates 1e-8, so that a ray from just before the
    // wall would get by the edge without meeting the wall.
    let body = format!(
        "DirectionalLight {{ direction 1 0 1e-6 }} Translation {{ translation 1.95 0 0 }} {WALL}
        Translation {{ translation 1e7 0 0 }} {WALL}"
    );
    let image = picture(&body, &to_origin([0.0, 0.0, 5.0]), [1, 1]);
    assert_eq!((image.object[0], image.lit[0]), (Some(0), 0));
}

#[test]
fn all_opaque_things_cast() {
    let light = "DirectionalLight { direction 0.3 0.1 -1 }";
    let roof = |before: &str| {
        format!(
            "Separator {{ {before} Translation {{ translation 0 0 1 }} Scale {{ scaleFactor 3 3 1 }} {WALL} }}"
        )
    };
    let rows = [
        ("", 0),
        ("LightModel { model BASE_COLOR }", 0),
        ("ShapeHints { vertexOrdering CLOCKWISE shapeType SOLID }", 0),
        ("Material { transparency 0.01 }", 1),
        ("DrawStyle { style LINES }", 1),
    ];
    for (before, lit) in rows {
        // Seen from below the roof.
        let camera = to_origin([0.0, 0.0, 0.5]);
        let image = picture(&format!("{light}{WALL}{}", roof(before)), &camera, [1, 1]);
        assert_eq!((image.object[0], image.lit[0]), (Some(0), lit), "{before}");
    }
    // The roof comes before the light: the light does not reach it, but it casts.
    let body = format!("{}{light}{WALL}", roof(""));
    assert_eq!(picture(&body, &to_origin([0.0, 0.0, 0.5]), [1, 1]).lit, [0]);
}

#[test]
fn each_light_has_a_bit_and_shadows_can_be_left_out() {
    let body = format!(
        "PointLight {{ location 0 0 2 }} PointLight {{ location 0 0 -2 }}
        DirectionalLight {{ direction 0 0 -1 }} DirectionalLight {{ direction 0 0 1 }} {WALL}"
    );
    let scene = scene_of(&format!("#Inventor V2.1 ascii\n{body}"));
    let camera = to_origin([0.0, 0.0, 5.0]);
    let mut options = RefOptions::of(&scene);
    for (shadows, lit) in [(true, 0b0101), (false, 0b1111)] {
        options.shadows = shadows;
        let image = render(&scene, &camera, [1, 1], BACKGROUND, &options);
        assert_eq!(image.lit, [lit]);
    }
}

#[test]
fn nothing_changes_far_away() {
    // Offsets on a grid of which the scene's coordinates are multiples: exact in f64.
    let near = far_by_coordinates(DVec3::ZERO);
    let size = [160, 120];
    let view = |text: &str, camera: &RefCamera| {
        let scene = scene_of(text);
        render(&scene, camera, size, BACKGROUND, &RefOptions::of(&scene))
    };
    for offset in [DVec3::new(1e3, 0.0, -1e4), DVec3::new(2.6e6, 431.0, 1.2e6)] {
        for far in [far_by_coordinates(offset), far_by_transform(offset)] {
            for ((_, camera), (_, far_camera)) in near.cameras.iter().zip(&far.cameras) {
                let (a, b) = (view(&near.text, camera), view(&far.text, far_camera));
                let edge = a.near_edge(1);
                for i in (0..edge.len()).filter(|&i| !edge[i]) {
                    assert_eq!(
                        (a.object[i], a.lit[i]),
                        (b.object[i], b.lit[i]),
                        "{offset} {i}"
                    );
                    // Colours vary by less than 1 a unit of length; 2.6e6 is known to 2^-31.
                    assert!(difference(a.color[i], b.color[i]) < 1e-6, "{offset} {i}");
                }
                assert!(a.lit.contains(&1) && a.lit.contains(&0));
            }
        }
    }
}

#[test]
fn what_is_behind_the_eye_is_not_seen() {
    for lens in [
        RefLens::Perspective {
            tan_half_height: 0.1,
        },
        RefLens::Orthographic { half_height: 0.1 },
    ] {
        let away = RefCamera::look_at(DVec3::Z, DVec3::Z * 2.0, DVec3::Y, lens);
        let image = picture(WALL, &away, [1, 1]);
        assert_eq!(image.object, [None]);
        assert_eq!(image.color, [BACKGROUND]);
        assert_eq!((image.lit[0], image.depth[0]), (0, f64::INFINITY));
    }
}
