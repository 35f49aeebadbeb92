use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use super::*;

const TAN: f64 = 0.5;

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

fn unit_box(center: DVec3) -> Aabb {
    Aabb {
        min: center - 1.0,
        max: center + 1.0,
    }
}

/// An eye ten units before the box, looking along +Y.
fn before(center: DVec3, lens: Lens) -> Navigator {
    let view = View {
        eye: center - v(0.0, 10.0, 0.0),
        orientation: Standard::Front.orientation(Up::Z),
        lens,
    };
    Navigator::new(view, &unit_box(center), Up::Z)
}

fn perspective() -> Lens {
    Lens::Perspective {
        tan_half_height: TAN,
    }
}

fn parallel() -> Lens {
    Lens::Orthographic { half_height: 3.0 }
}

/// Where a point falls: parts of half the image's height from its middle.
fn place(view: &View, p: DVec3) -> DVec2 {
    let p = view.p_in_view(p);
    match view.lens {
        Lens::Perspective { tan_half_height } => p.truncate() / (-p.z * tan_half_height),
        Lens::Orthographic { half_height } => p.truncate() / half_height,
    }
}

/// Far from the origin f64 itself gives way by 1e-10.
const CENTERS: [DVec3; 2] = [DVec3::ZERO, DVec3::new(2_600_000.0, 1_200_000.0, 400.0)];

#[test]
fn standard_views_show_their_sides() {
    // Direction of the eye as seen from the model, and the top of the image, with +Z up.
    let rows = [
        (Standard::Front, v(0.0, -1.0, 0.0), DVec3::Z),
        (Standard::Back, v(0.0, 1.0, 0.0), DVec3::Z),
        (Standard::Left, v(-1.0, 0.0, 0.0), DVec3::Z),
        (Standard::Right, v(1.0, 0.0, 0.0), DVec3::Z),
        (Standard::Top, v(0.0, 0.0, 1.0), DVec3::Y),
        (Standard::Bottom, v(0.0, 0.0, -1.0), DVec3::NEG_Y),
    ];
    for (standard, from, top) in rows {
        let z_up = standard.orientation(Up::Z);
        assert!((z_up * DVec3::Z - from).length() < 1e-12, "{standard:?}");
        assert!((z_up * DVec3::Y - top).length() < 1e-12, "{standard:?}");
        // +Y up: z becomes y, and the front, -y, becomes +z.
        let turned = |p: DVec3| v(p.x, p.z, -p.y);
        let y_up = standard.orientation(Up::Y);
        assert!((y_up * DVec3::Z - turned(from)).length() < 1e-12);
        assert!((y_up * DVec3::Y - turned(top)).length() < 1e-12);
    }
    assert_eq!(Standard::ALL.len(), 7);
}

#[test]
fn orbiting_keeps_the_pivot_and_the_horizon() {
    for center in CENTERS {
        for lens in [perspective(), parallel()] {
            let mut navigator = before(center, lens);
            let pivot = navigator.pivot();
            assert!((pivot - center).length() < 1e-9);
            for step in 0..100 {
                navigator.orbit(DVec2::new(0.31, 0.07 * f64::from(step % 5 - 2)), pivot);
            }
            assert!((navigator.pivot() - pivot).length() < 1e-8);
            assert!(
                navigator.view.right().z.abs() < 1e-9,
                "the horizon is level"
            );
            // Dragging right turns the eye to the left of the model.
            let mut right = before(center, lens);
            right.orbit(DVec2::new(FRAC_PI_2, 0.0), pivot);
            assert!((right.view.eye - center - v(-10.0, 0.0, 0.0)).length() < 1e-8);
            // Dragging down shows the top.
            let mut down = before(center, lens);
            down.orbit(DVec2::new(0.0, FRAC_PI_4), pivot);
            assert!(down.view.eye.z > center.z + 7.0);
            down.orbit(DVec2::new(0.0, 3.0), pivot);
            assert!(down.view.up().z > 0.0, "not over the top");
        }
    }
}

#[test]
fn a_ball_turns_over_the_top() {
    let mut navigator = before(DVec3::ZERO, perspective());
    navigator.turning = Turning::Ball;
    navigator.orbit(DVec2::new(0.0, std::f64::consts::PI), DVec3::ZERO);
    assert!((navigator.view.eye - v(0.0, 10.0, 0.0)).length() < 1e-9);
    assert!(navigator.view.up().z < -0.999);
    navigator.level();
    assert!(navigator.view.up().z > 0.999);
}

#[test]
fn panning_moves_the_picture_by_its_height() {
    for lens in [perspective(), parallel()] {
        let mut navigator = before(DVec3::ZERO, lens);
        let p = v(0.3, 0.0, -0.2);
        let from = place(&navigator.view, p);
        navigator.pan(DVec2::new(0.25, -0.125));
        let moved = place(&navigator.view, p) - from;
        assert!((moved - DVec2::new(0.5, -0.25)).length() < 1e-12, "{moved}");
    }
}

#[test]
fn zooming_keeps_the_point_in_its_place() {
    for center in CENTERS {
        for lens in [perspective(), parallel()] {
            let mut navigator = before(center, lens);
            let p = center + v(0.7, -0.5, 0.4);
            let from = place(&navigator.view, p);
            for factor in [0.5, 0.9, 2.0, 1e-3] {
                navigator.zoom(factor, p);
                let to = place(&navigator.view, p);
                assert!((to - from).length() < 1e-6, "{factor}: {from} {to}");
            }
            assert!(navigator.half_height() < 0.01);
            let before = navigator;
            for factor in [0.0, -1.0, f64::NAN, f64::INFINITY] {
                navigator.zoom(factor, p);
            }
            assert_eq!(navigator, before);
        }
    }
}

#[test]
fn a_millimetre_in_a_kilometre() {
    let mut navigator = before(DVec3::ZERO, perspective());
    navigator.show_all(
        &Aabb {
            min: DVec3::splat(-500.0),
            max: DVec3::splat(500.0),
        },
        1.0,
    );
    let screw = v(123.456, -77.7, 0.001);
    let from = place(&navigator.view, screw);
    for _ in 0..200 {
        navigator.zoom(0.9, screw);
    }
    assert!(navigator.distance < 1e-5 && (place(&navigator.view, screw) - from).length() < 1e-6);
    let eye = navigator.view.eye;
    navigator.fly(v(0.0, 0.0, 1e-6));
    assert!((navigator.view.eye - eye).length() > 0.9e-6);
}

#[test]
fn changing_the_lens_keeps_sizes_at_the_pivot() {
    let mut navigator = before(DVec3::ZERO, perspective());
    let p = v(0.4, 0.0, 0.3);
    let from = place(&navigator.view, p);
    navigator.change_lens(TAN);
    assert!(matches!(navigator.view.lens, Lens::Orthographic { .. }));
    assert!((place(&navigator.view, p) - from).length() < 1e-12);
    navigator.change_lens(0.2);
    assert!((place(&navigator.view, p) - from).length() < 1e-12);
    assert!((navigator.distance - 25.0).abs() < 1e-9);
}

#[test]
fn seeking_looks_at_the_point() {
    let mut navigator = before(DVec3::ZERO, perspective());
    let p = v(2.0, 1.0, 1.0);
    navigator.seek(p);
    assert!(place(&navigator.view, p).length() < 1e-12);
    assert!((navigator.pivot() - p).length() < 1e-12);
    assert!(navigator.view.right().z.abs() < 1e-12);
    let before = navigator;
    navigator.seek(navigator.view.eye);
    navigator.seek(v(f64::NAN, 0.0, 0.0));
    assert_eq!(navigator, before);
}

#[test]
fn everything_is_shown_from_any_side() {
    for center in CENTERS {
        for lens in [perspective(), parallel()] {
            for standard in Standard::ALL {
                for aspect in [0.5, 2.0] {
                    let mut navigator = before(center, lens);
                    navigator.show_from(standard, &unit_box(center), aspect);
                    let places = unit_box(center)
                        .corners()
                        .map(|p| place(&navigator.view, p));
                    let fill = places.iter().fold(0.0_f64, |most, p| {
                        most.max(p.y.abs()).max(p.x.abs() / aspect)
                    });
                    assert!((0.85..0.95).contains(&fill), "{standard:?} {aspect} {fill}");
                }
            }
        }
    }
}
