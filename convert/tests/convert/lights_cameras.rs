//! Lights and cameras: units, directions, clipping.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use glam::{DAffine3, DQuat, DVec3};
use scenegraph::scene::{Camera, Environment, LightKind, Mesh, Projection, ViewportMapping};
use serde_json::{Value, json};

use crate::read::{Converted, convert};
use crate::reading::read;
use crate::scenes::{Build, material, scale, shift, triangle, turn};

const DOWN: LightKind = LightKind::Directional {
    direction: DVec3::NEG_Y,
};

fn point(x: f64) -> LightKind {
    LightKind::Point {
        location: DVec3::new(x, 0.0, 0.0),
    }
}

fn spot(drop_off_rate: f64, cut_off_angle_rad: f64) -> LightKind {
    LightKind::Spot {
        location: DVec3::new(0.0, 10.0, 0.0),
        direction: DVec3::NEG_Y,
        drop_off_rate,
        cut_off_angle_rad,
    }
}

/// A triangle whose box is centred at the origin, 2 x 2 x 0.
fn centered() -> Build {
    let mut build = Build::new();
    build.shape(None, None, shift(-1.0, -1.0, 0.0) * scale(2.0, 2.0, 1.0));
    build
}

fn light(converted: &Converted, index: usize) -> &Value {
    converted.at(&format!("/extensions/KHR_lights_punctual/lights/{index}"))
}

#[test]
fn a_radius_that_ends_in_the_scene_is_a_range() {
    // The scene is within a ball of radius sqrt 2 about the origin.
    let rows = [
        (point(10.0), Some(9.0), Some(9.0)),
        (point(10.0), Some(11.0), Some(11.0)),
        (point(10.0), Some(11.5), None),
        (point(10.0), None, None),
        (point(10.0), Some(0.0), None),
        (spot(0.0, 0.5), Some(3.0), Some(3.0)),
    ];
    for (kind, radius_in_world, wanted) in rows {
        let mut build = centered();
        build.light(None, DAffine3::IDENTITY, kind);
        build.scene.lights[0].radius_in_world = radius_in_world;
        let converted = convert(&build.scene);
        let found = light(&converted, 0).get("range").and_then(Value::as_f64);
        assert_eq!(found, wanted, "{radius_in_world:?}");
        let model = read(&converted.json, &converted.bin).unwrap();
        let again = model.scene.lights[0].radius_in_world;
        assert_eq!(again, wanted, "{radius_in_world:?}");
    }
}

#[test]
fn intensities_follow_the_formulas() {
    let environment = |attenuation| Environment {
        attenuation,
        ..Environment::default()
    };
    let rows = [
        (DOWN, [0.0, 0.0, 1.0], 1.0, PI),
        (DOWN, [1.0, 2.0, 3.0], 0.5, 0.5 * PI),
        (point(10.0), [0.0, 0.0, 1.0], 1.0, 100.0 * PI),
        (point(10.0), [1.0, 0.0, 0.0], 1.0, PI),
        (
            point(10.0),
            [0.5, 2.0, 30.0],
            0.25,
            // 0.5 * 36 + 2 * 6 + 30 is twice 30.
            0.25 * 36.0 * PI / 60.0,
        ),
        // Half is at 4 of 10; at 20, behind the centre; at 1, nearer than a quarter of the way.
        (point(10.0), [1.0, 0.0, 16.0], 1.0, 16.0 * PI / 32.0),
        (point(10.0), [0.0, 0.5, 10.0], 1.0, 100.0 * PI / 15.0),
        (point(10.0), [0.0, 1.0, 1.0], 1.0, 6.25 * PI / 3.5),
        (spot(0.0, 0.5), [0.0, 1.0, 0.0], 1.0, 2.5 * PI),
        // No attenuation that can be: half is nowhere.
        (point(10.0), [-1.0, 0.0, 1000.0], 1.0, 100.0 * PI / 900.0),
        // At the centre: the distance of the radius, here half the diagonal of 2 x 2.
        (point(0.0), [0.0, 0.0, 1.0], 1.0, 2.0 * PI),
        // No attenuation at all, no light, and numbers beyond use.
        (point(10.0), [0.0; 3], 1.0, 100.0 * PI),
        (point(10.0), [0.0, 0.0, 1.0], -1.0, 0.0),
        (point(1e100), [0.0, 0.0, 1.0], 1.0, 1e30),
    ];
    for (kind, attenuation, intensity, want) in rows {
        let mut build = centered();
        build.light(None, DAffine3::IDENTITY, kind);
        build.scene.environments[0] = environment(attenuation);
        build.scene.lights[0].intensity = intensity;
        let converted = convert(&build.scene);
        let got = light(&converted, 0)["intensity"].as_f64().unwrap();
        assert!(
            (got - want).abs() <= 1e-6 * want,
            "{attenuation:?}: {got} {want}"
        );
    }
}

#[test]
fn the_reference_distance_is_in_the_world() {
    let mut build = centered();
    let g = build.group(None, None, scale(1e-3, 1e-3, 1e-3));
    build.light(Some(g), DAffine3::IDENTITY, point(5000.0));
    let got = light(&convert(&build.scene), 0)["intensity"]
        .as_f64()
        .unwrap();
    assert!((got - 25.0 * PI).abs() < 1e-4, "{got}");
    // A mesh's own origin counts: the centre is at x = 50.
    let far = Mesh {
        origin: DVec3::new(49.5, -0.5, 0.0),
        ..triangle()
    };
    let mut build = Build::one(far, material());
    build.light(None, DAffine3::IDENTITY, point(40.0));
    let got = light(&convert(&build.scene), 0)["intensity"]
        .as_f64()
        .unwrap();
    assert!((got - 100.0 * PI).abs() < 1e-4, "{got}");
    // Without a scene there is no centre.
    let mut build = Build::new();
    build.light(None, DAffine3::IDENTITY, point(5000.0));
    let got = light(&convert(&build.scene), 0)["intensity"]
        .as_f64()
        .unwrap();
    assert!((got - PI).abs() < 1e-6, "{got}");
}

#[test]
fn cones_are_legal_and_soft_where_the_power_falls() {
    for (drop_off_rate, cut_off, inner, outer) in [
        (0.0, FRAC_PI_4, 0.999 * FRAC_PI_4, FRAC_PI_4),
        // cos^12.8 is 0.9 where cos is 0.9^(1/12.8).
        (0.1, 1.0, 0.9_f64.powf(1.0 / 12.8).acos(), 1.0),
        (1.0, FRAC_PI_4, 0.9_f64.powf(1.0 / 128.0).acos(), FRAC_PI_4),
        (0.1, 0.05, 0.999 * 0.05, 0.05),
        (0.0, 3.0, 0.999 * FRAC_PI_2, FRAC_PI_2),
        (0.0, -1.0, 0.999e-4, 1e-4),
    ] {
        let mut build = centered();
        build.light(None, DAffine3::IDENTITY, spot(drop_off_rate, cut_off));
        let converted = convert(&build.scene);
        let cone = &light(&converted, 0)["spot"];
        let got = |key: &str| cone[key].as_f64().unwrap();
        assert!((got("innerConeAngle") - inner).abs() < 1e-12, "{cone}");
        assert!((got("outerConeAngle") - outer).abs() < 1e-12, "{cone}");
    }
}

#[test]
fn lights_shine_where_the_scene_points_them() {
    let tilt = turn(DVec3::new(1.0, -2.0, 0.5), 1.1);
    let direction = DVec3::new(0.2, -0.9, 0.4).normalize();
    let location = DVec3::new(3.0, -4.0, 5.0);
    let kinds = [
        LightKind::Directional { direction },
        LightKind::Point { location },
        LightKind::Spot {
            location,
            direction,
            drop_off_rate: 0.0,
            cut_off_angle_rad: 0.5,
        },
    ];
    // group, item; whether it stays under its group
    let frames = [
        (DAffine3::IDENTITY, DAffine3::IDENTITY, true),
        (shift(1e6, 2.0, 3.0) * tilt, scale(1.0, 2.0, 3.0), true),
        (tilt * scale(1e-3, 1e-3, 1e-3), tilt, true),
        (scale(1.0, 2.0, 3.0) * tilt, tilt, false),
        (scale(1.0, 1.0, -1.0), tilt, false),
        (scale(1.0, 0.0, 1.0), DAffine3::IDENTITY, false),
    ];
    for kind in kinds {
        for (group, item, stays) in frames {
            let mut build = Build::new();
            let g = build.group(None, Some("g"), group);
            build.shape(Some(g), Some("a"), DAffine3::IDENTITY);
            build.light(Some(g), item, kind.clone());
            let converted = convert(&build.scene);
            let placed = &converted.placed_with("/extensions/KHR_lights_punctual")[0];
            let world = group * item;
            let shines = placed
                .world_from_local
                .transform_vector3(DVec3::NEG_Z)
                .normalize();
            if !matches!(kind, LightKind::Point { .. }) {
                let want = world.transform_vector3(direction).normalize();
                assert!((shines - want).length() < 1e-14, "{shines} {want}");
            }
            if !matches!(kind, LightKind::Directional { .. }) {
                let want = world.transform_point3(location);
                let got = placed.world_from_local.translation;
                assert!((got - want).length() <= 1e-15 * want.length().max(10.0) * 4.0);
            }
            let children = crate::read::indices(&converted.nodes()[0]["children"]);
            assert_eq!(children.contains(&placed.index), stays, "{group}");
        }
    }
}

#[test]
fn a_light_without_direction_is_finite() {
    let mut build = centered();
    let flat = scale(0.0, 0.0, 0.0);
    build.light(
        None,
        flat,
        LightKind::Directional {
            direction: DVec3::X,
        },
    );
    build.light(None, flat, spot(0.5, 0.5));
    convert(&build.scene);
}

#[test]
fn light_extras_hold_inventors_own_values() {
    let mut build = centered();
    build.light(None, DAffine3::IDENTITY, spot(0.25, 0.5));
    build.light(None, DAffine3::IDENTITY, point(3.0));
    build.scene.lights[0].color_srgb = [1.0, 0.5, 0.0];
    build.scene.lights[0].intensity = 0.75;
    build.scene.environments.push(Environment {
        attenuation: [0.0, 1.0, 2.0],
        ..Environment::default()
    });
    build.scene.lights[0].environment = scenegraph::scene::EnvironmentId(1);
    let converted = convert(&build.scene);
    assert_eq!(
        light(&converted, 0)["extras"]["iv"],
        json!({
            "intensity": 0.75,
            "color": [1, 0.5, 0],
            "attenuation": [0, 1, 2],
            "dropOffRate": 0.25,
            "cutOffAngle": 0.5,
            "environment": 1,
            "referenceDistance": 2.5,
        })
    );
    let color = crate::read::numbers(&light(&converted, 0)["color"]);
    assert!((color[1] - 0.214_041).abs() < 1e-6);
    // Of a light that does not fade, the distance to the centre.
    let extras = &light(&converted, 1)["extras"]["iv"];
    assert_eq!(*extras, json!({ "referenceDistance": 3 }));
}

const PERSPECTIVE: Projection = Projection::Perspective {
    height_angle_rad: FRAC_PI_4,
};

fn camera_of(change: impl FnOnce(&mut Camera)) -> Value {
    let mut build = centered();
    build.camera(None, DAffine3::IDENTITY, PERSPECTIVE);
    change(&mut build.scene.cameras[0]);
    convert(&build.scene).json["cameras"][0].clone()
}

#[test]
fn perspective_cameras_keep_a_chosen_range_and_make_a_missing_one() {
    let range = |near, far, z| {
        let got = camera_of(|camera| {
            (camera.near_distance, camera.far_distance) = (near, far);
            camera.position = DVec3::new(0.0, 0.0, z);
        });
        let lens = &got["perspective"];
        (lens["znear"].as_f64().unwrap(), lens["zfar"].as_f64())
    };
    assert_eq!(range(0.5, 20.0, 5.0), (0.5, Some(20.0)));
    // Inventor's default says nothing: nine tenths of the way to the scene.
    for (near, far) in [
        (1.0, 10.0),
        (0.0, 20.0),
        (-1.0, 5.0),
        (5.0, 5.0),
        (9.0, 3.0),
    ] {
        assert_eq!(range(near, far, 5.0), (4.5, None));
    }
    // Inside the scene's box, before it, and at no depth.
    for z in [0.0, -5.0] {
        let (near, far) = range(1.0, 10.0, z);
        assert!(near > 0.0 && near < 1e-2 && far.is_none());
    }
}

#[test]
fn camera_values_are_made_legal() {
    let odd = [f64::MIN_POSITIVE, 0.0, -1.0, 4.0, 1e300, -1e300];
    for value in odd {
        for projection in [
            Projection::Perspective {
                height_angle_rad: value,
            },
            Projection::Orthographic { height: value },
        ] {
            let got = camera_of(|camera| {
                camera.projection = projection;
                camera.aspect_ratio = value;
                camera.near_distance = value;
                camera.far_distance = -value;
                camera.focal_distance = value;
                camera.viewport_mapping = ViewportMapping::LeaveAlone;
            });
            if let Some(lens) = got["perspective"].as_object() {
                let number = |key: &str| lens[key].as_f64().unwrap();
                assert!(number("yfov") > 0.0 && number("yfov") < PI);
                assert!(number("aspectRatio") > 0.0 && number("znear") > 0.0);
            } else {
                let number = |key: &str| got["orthographic"][key].as_f64().unwrap();
                assert!(number("xmag") > 0.0 && number("ymag") > 0.0, "{got}");
                assert!(
                    number("znear") >= 0.0 && number("zfar") > number("znear"),
                    "{got}"
                );
            }
        }
    }
}

#[test]
fn lengths_of_a_scaled_camera_are_in_world_units() {
    let mut build = centered();
    let milli = build.group(None, None, scale(1e-3, 1e-3, 1e-3));
    build.camera(
        Some(milli),
        DAffine3::IDENTITY,
        Projection::Orthographic { height: 4000.0 },
    );
    let camera = &mut build.scene.cameras[0];
    (camera.near_distance, camera.far_distance) = (500.0, 20_000.0);
    camera.position.z = 5000.0;
    let converted = convert(&build.scene);
    let lens = &converted.json["cameras"][0]["orthographic"];
    for (key, want) in [("ymag", 2.0), ("xmag", 3.0), ("znear", 0.5), ("zfar", 20.0)] {
        assert!((lens[key].as_f64().unwrap() - want).abs() < 1e-12, "{lens}");
    }
    let placed = &converted.placed_with("/camera")[0];
    crate::read::assert_near(&placed.world_from_local, &shift(0.0, 0.0, 5.0));
}

#[test]
fn cameras_look_where_the_scene_points_them() {
    let tilt = turn(DVec3::new(1.0, -2.0, 0.5), 1.1);
    for (group, stays) in [
        (DAffine3::IDENTITY, true),
        (shift(1e6, 2.0, 3.0) * tilt, true),
        (scale(1.0, 2.0, 3.0) * tilt, false),
        (scale(-1.0, 1.0, 1.0) * tilt, false),
    ] {
        let mut build = centered();
        let g = build.group(None, Some("g"), group);
        build.shape(Some(g), Some("a"), DAffine3::IDENTITY);
        build.camera(Some(g), tilt, PERSPECTIVE);
        let orientation = DQuat::from_axis_angle(DVec3::Y, 2.0);
        build.scene.cameras[0].orientation = orientation;
        let converted = convert(&build.scene);
        let placed = &converted.placed_with("/camera")[0];
        let world = group * tilt;
        let got = placed.world_from_local;
        let unit = |v: DVec3| v.normalize();
        let want = unit(world.transform_vector3(orientation * DVec3::NEG_Z));
        assert!((got.transform_vector3(DVec3::NEG_Z) - want).length() < 1e-14);
        // Upright: no part of the source's up is sideways.
        let up = unit(world.transform_vector3(orientation * DVec3::Y));
        assert!(got.transform_vector3(DVec3::X).dot(up).abs() < 1e-14);
        assert!(got.transform_vector3(DVec3::Y).dot(up) > 0.0);
        let eye = world.transform_point3(DVec3::new(0.0, 0.0, 5.0));
        assert!((got.translation - eye).length() < 1e-9);
        let nested =
            !crate::read::indices(&converted.at("/scenes/0/nodes").clone()).contains(&placed.index);
        assert_eq!(nested, stays, "{group}");
    }
}

#[test]
fn camera_extras_hold_inventors_own_values() {
    let got = camera_of(|camera| {
        camera.aspect_ratio = 1.25;
        camera.near_distance = 0.5;
        camera.far_distance = 100.0;
        camera.focal_distance = 7.0;
        camera.viewport_mapping = ViewportMapping::LeaveAlone;
    });
    assert_eq!(got["perspective"]["aspectRatio"], 1.25);
    assert_eq!(
        got["extras"]["iv"],
        json!({
            "aspectRatio": 1.25,
            "nearDistance": 0.5,
            "farDistance": 100,
            "focalDistance": 7,
            "viewportMapping": "LEAVE_ALONE",
        })
    );
    let plain = camera_of(|camera| camera.aspect_ratio = 1.0);
    assert_eq!(plain.get("extras"), None);
    assert_eq!(plain["perspective"].get("aspectRatio"), None);
}
