//! Hand-computed cases of Inventor's camera rules.

use super::super::tests::{near, v};
use super::*;
use glam::DMat3;
use iv_parser::SourcePos;
use scenegraph::scene::Placement;
use std::f64::consts::{FRAC_PI_2, PI};

fn camera(projection: Projection, mapping: ViewportMapping) -> Camera {
    Camera {
        placement: Placement {
            node: None,
            parent_from_local: DAffine3::IDENTITY,
            world_from_local: DAffine3::IDENTITY,
            name: None,
            pos: SourcePos::default(),
        },
        position: v(0.0, 0.0, 1.0),
        orientation: DQuat::IDENTITY,
        aspect_ratio: 2.0,
        near_distance: 1.0,
        far_distance: 10.0,
        focal_distance: 5.0,
        projection,
        viewport_mapping: mapping,
    }
}

/// tan(heightAngle / 2) is 1.
const RIGHT_ANGLE: Projection = Projection::Perspective {
    height_angle_rad: FRAC_PI_2,
};
const HEIGHT_6: Projection = Projection::Orthographic { height: 6.0 };

fn half_of(lens: Lens) -> f64 {
    match lens {
        Lens::Perspective { tan_half_height } => tan_half_height,
        Lens::Orthographic { half_height } => half_height,
    }
}

#[test]
fn viewport_mappings() {
    use ViewportMapping::{AdjustCamera, CropViewport, LeaveAlone};
    // The camera's aspect ratio is 2. Image, expected half height (perspective; three times that
    // for the orthographic camera), expected rectangle and aspect ratio.
    let rows = [
        (AdjustCamera, (400, 100), 1.0, [0, 0, 400, 100], 4.0),
        (AdjustCamera, (100, 100), 1.0, [0, 0, 100, 100], 1.0),
        (AdjustCamera, (100, 400), 4.0, [0, 0, 100, 400], 0.25),
        (CropViewport, (400, 100), 1.0, [100, 0, 200, 100], 2.0),
        (CropViewport, (100, 100), 1.0, [0, 25, 100, 50], 2.0),
        (CropViewport, (100, 400), 1.0, [0, 175, 100, 50], 2.0),
        (LeaveAlone, (400, 100), 1.0, [0, 0, 400, 100], 2.0),
        (LeaveAlone, (100, 400), 1.0, [0, 0, 100, 400], 2.0),
    ];
    for (mapping, (width, height), half, rectangle, aspect) in rows {
        for (projection, factor) in [(RIGHT_ANGLE, 1.0), (HEIGHT_6, 3.0)] {
            let (view, r) = View::from_scene_camera(&camera(projection, mapping), width, height);
            let label = format!("{mapping:?} {width}x{height} {projection:?}");
            assert!(
                (half_of(view.lens) - half * factor).abs() < 1e-14,
                "{label}"
            );
            assert_eq!([r.x, r.y, r.width, r.height], rectangle, "{label}");
            assert_eq!(r.aspect, aspect, "{label}");
            assert_eq!(view.eye, v(0.0, 0.0, 1.0), "{label}");
        }
    }
}

#[test]
fn frames_of_cameras() {
    let frame = |x: DVec3, y: DVec3, z: DVec3| {
        DAffine3::from_mat3_translation(DMat3::from_cols(x, y, z), v(10.0, 20.0, 30.0))
    };
    // Frame, and what it makes of a camera at (0, 0, 1): eye, forward, up, half height of a
    // perspective and of an orthographic view, aspect ratio of a square image.
    let rows = [
        (
            frame(DVec3::X, DVec3::Y, DVec3::Z),
            [v(10.0, 20.0, 31.0), DVec3::NEG_Z, DVec3::Y],
            [1.0, 3.0, 1.0],
        ),
        // Uniform scale: the same picture, a larger height.
        (
            frame(DVec3::X * 1e-3, DVec3::Y * 1e-3, DVec3::Z * 1e-3),
            [v(10.0, 20.0, 30.001), DVec3::NEG_Z, DVec3::Y],
            [1.0, 0.003, 1.0],
        ),
        // Z up: x stays, y becomes z, z becomes -y.
        (
            frame(DVec3::X * 2.0, DVec3::Z * 2.0, DVec3::Y * -2.0),
            [v(10.0, 18.0, 30.0), DVec3::Y, DVec3::Z],
            [1.0, 6.0, 1.0],
        ),
        // Unequal scale: 4 across, 2 up, 8 along. A ray of slope 1 upwards has slope 2/8 now.
        (
            frame(DVec3::X * 4.0, DVec3::Y * 2.0, DVec3::Z * 8.0),
            [v(10.0, 20.0, 38.0), DVec3::NEG_Z, DVec3::Y],
            [0.25, 6.0, 2.0],
        ),
        // Mirrored: shown unmirrored.
        (
            frame(DVec3::NEG_X, DVec3::Y, DVec3::Z),
            [v(10.0, 20.0, 31.0), DVec3::NEG_Z, DVec3::Y],
            [1.0, 3.0, 1.0],
        ),
        // Up sheared along the view direction: only its part across is up.
        (
            frame(DVec3::X, v(0.0, 1.0, 5.0), DVec3::Z),
            [v(10.0, 20.0, 31.0), DVec3::NEG_Z, DVec3::Y],
            [1.0, 3.0, 1.0],
        ),
        // Up flattened: the rest still gives it.
        (
            frame(DVec3::X, DVec3::ZERO, DVec3::Z),
            [v(10.0, 20.0, 31.0), DVec3::NEG_Z, DVec3::Y],
            [1.0, 3.0, 1.0],
        ),
        // View direction flattened: the camera's own axes.
        (
            frame(DVec3::Y, DVec3::X, DVec3::ZERO),
            [v(10.0, 20.0, 30.0), DVec3::NEG_Z, DVec3::Y],
            [1.0, 3.0, 1.0],
        ),
    ];
    for (i, (world_from_local, [eye, forward, up], [tan, half, aspect])) in
        rows.into_iter().enumerate()
    {
        for (projection, expected) in [(RIGHT_ANGLE, tan), (HEIGHT_6, half)] {
            let mut camera = camera(projection, ViewportMapping::AdjustCamera);
            camera.placement.world_from_local = world_from_local;
            let (view, region) = View::from_scene_camera(&camera, 64, 64);
            assert!(near(view.eye, eye, 1e-14), "{i}: {}", view.eye);
            assert!(
                near(view.forward(), forward, 1e-14),
                "{i}: {}",
                view.forward()
            );
            assert!(near(view.up(), up, 1e-14), "{i}: {}", view.up());
            let got = half_of(view.lens);
            assert!(
                (got - expected).abs() < 1e-14 * expected.max(1.0),
                "{i}: {got}"
            );
            assert!(
                (region.aspect - aspect).abs() < 1e-14,
                "{i}: {}",
                region.aspect
            );
        }
    }
}

#[test]
fn any_camera_gives_a_finite_view() {
    let bad = [0.0, -1.0, 1e-300, 1e300, PI, 7.0, f64::NAN, f64::INFINITY];
    for a in bad {
        for b in bad {
            for projection in [
                Projection::Perspective {
                    height_angle_rad: a,
                },
                Projection::Orthographic { height: a },
            ] {
                for mapping in [
                    ViewportMapping::AdjustCamera,
                    ViewportMapping::CropViewport,
                    ViewportMapping::LeaveAlone,
                ] {
                    let mut camera = camera(projection, mapping);
                    camera.aspect_ratio = b;
                    camera.position = v(b, 0.0, 0.0);
                    camera.orientation = DQuat::from_xyzw(a, b, 0.0, 0.0);
                    camera.placement.world_from_local = DAffine3::from_scale(v(1.0, b, a));
                    let (view, region) = View::from_scene_camera(&camera, 3, u32::MAX);
                    let half = half_of(view.lens);
                    let label = format!("{a} {b} {projection:?} {mapping:?}");
                    assert!(
                        view.eye.is_finite() && view.orientation.is_normalized(),
                        "{label}"
                    );
                    assert!(half > 0.0 && half.is_finite(), "{label}: {half}");
                    assert!(region.aspect > 0.0 && region.aspect.is_finite(), "{label}");
                    assert!(region.width >= 1 && region.height >= 1, "{label}");
                }
            }
        }
    }
}

#[test]
fn angles_without_meaning() {
    let default = 0.414_213_562_373_095;
    let rows = [
        (0.0, default),
        (-1.0, default),
        (f64::NAN, default),
        (f64::INFINITY, default),
        (PI, 1e3),
        (7.0, 1e3),
        (1e-9, 1e-6),
    ];
    for (height_angle_rad, tan) in rows {
        let projection = Projection::Perspective { height_angle_rad };
        let camera = camera(projection, ViewportMapping::AdjustCamera);
        let (view, _) = View::from_scene_camera(&camera, 10, 10);
        let got = half_of(view.lens);
        assert!((got - tan).abs() < 1e-14, "{height_angle_rad}: {got}");
    }
}

#[test]
fn finds_cameras() {
    let named = |name: Option<&str>, x: f64| {
        let mut camera = camera(RIGHT_ANGLE, ViewportMapping::AdjustCamera);
        camera.placement.name = name.map(Into::into);
        camera.position.x = x;
        camera
    };
    let scene = Scene {
        cameras: vec![
            named(None, 0.0),
            named(Some("Plan"), 1.0),
            named(Some("0"), 2.0),
            named(Some("Plan"), 3.0),
        ],
        ..Scene::default()
    };
    let rows = [
        (None, Some(0.0)),
        (Some("Plan"), Some(1.0)),
        (Some("0"), Some(2.0)),
        (Some("3"), Some(3.0)),
        (Some("4"), None),
        (Some("plan"), None),
        (Some("-1"), None),
        (Some(""), None),
    ];
    for (wanted, x) in rows {
        let found = find_camera(&scene, wanted).ok().flatten();
        assert_eq!(found.map(|c| c.position.x), x, "{wanted:?}");
    }
    let error = find_camera(&scene, Some("4")).unwrap_err();
    assert_eq!(
        error.to_string(),
        "no camera `4`; the model has 0 (no name), 1 `Plan`, 2 `0`, 3 `Plan`"
    );
    let none = Scene::default();
    assert_eq!(find_camera(&none, None), Ok(None));
    assert_eq!(
        find_camera(&none, Some("a")).unwrap_err().to_string(),
        "no camera `a`; the model has none"
    );
}
