//! Objects behind others are left out, and the picture stays the same to the bit.

use glam::DVec3;
use tests::reference::{RefCamera, RefLens};
use tests::shadow_scenes::scene_of;
use viewer::frame::{Occlusion, PassKind, Plan, Settings, Shadows, SkipReason};

use super::device::{Shot, Stage};

const SIZE: [u32; 2] = [203, 149];
const PERSPECTIVE: RefLens = RefLens::Perspective {
    tan_half_height: 0.5,
};

/// A wall with a window before rows of cubes, a floor, a lamp on either side of the wall, thick
/// lines on top of the wall, a sphere that looks around its edge, glass on both sides; before it a
/// triangle that stands there twice, in two colours.
fn house() -> String {
    let mut text = String::from(
        "#Inventor V2.1 ascii\n\
         DirectionalLight { direction 0.4 -1 -0.7 }\n\
         PointLight { location 1 3 4 } PointLight { location 0 2.5 -6 color 1 0.6 0.3 }\n\
         Separator { Coordinate3 { point [ -9 0 9, 9 0 9, 9 0 -19, -9 0 -19 ] } \
         IndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1 ] } }\n\
         Separator { Coordinate3 { point [ -3 0 0, 3 0 0, 3 3 0, -3 3 0, -2 1 0, -1 1 0, -1 2 0, \
         -2 2 0 ] } IndexedFaceSet { coordIndex [ 0, 1, 5, 4, -1, 1, 2, 6, 5, -1, 2, 3, 7, 6, -1, \
         3, 0, 4, 7, -1 ] } }\n\
         Separator { DrawStyle { lineWidth 5 } Translation { translation 0 3.02 -0.3 } \
         Coordinate3 { point [ -3 0 0, 3 0 0 ] } IndexedLineSet { coordIndex [ 0, 1, -1 ] } }\n\
         Separator { Translation { translation 3 1 -2 } Sphere { radius 0.4 } }\n\
         Separator { Material { transparency 0.5 diffuseColor 0 1 0 } \
         Translation { translation 1 1 2 } Cube { } }\n\
         Separator { Material { transparency 0.5 diffuseColor 1 0 0 } \
         Translation { translation 1 1 -2 } Cube { width 0.5 height 0.5 depth 0.5 } }\n",
    );
    text.push_str(
        "Separator { Material { diffuseColor [ 1 0 0, 0 1 0 ] } MaterialBinding { value PER_FACE } \
         Coordinate3 { point [ 0 2 0.4, 2 2 0.4, 1 2.8 0.4 ] } \
         IndexedFaceSet { coordIndex [ 0, 1, 2, -1, 0, 1, 2, -1 ] } }\n",
    );
    for i in 0..60 {
        let (x, y, z) = (i % 10, i / 10 % 3, i / 30);
        text.push_str(&format!(
            "Separator {{ Material {{ diffuseColor {} 0.5 0.8 }} \
             Translation {{ translation {} {} {} }} Cube {{ width 0.3 height 0.4 depth 0.3 }} }}\n",
            f64::from(x) / 9.0,
            f64::from(x) * 0.5 - 2.3,
            0.4 + 0.8 * f64::from(y),
            -1.0 - f64::from(z),
        ));
    }
    text
}

fn camera(eye: [f64; 3], target: [f64; 3], lens: RefLens) -> RefCamera {
    RefCamera::look_at(DVec3::from(eye), DVec3::from(target), DVec3::Y, lens)
}

/// A way around the wall, seen as one goes, and then views of other kinds.
fn cameras() -> Vec<RefCamera> {
    let mut cameras: Vec<RefCamera> = (0..9)
        .map(|i| {
            let angle = -1.0 + 0.5 * f64::from(i);
            let eye = [8.0 * angle.sin(), 1.5, 8.0 * angle.cos()];
            camera(eye, [0.0, 1.2, -1.0], PERSPECTIVE)
        })
        .collect();
    cameras.push(camera([-1.5, 1.5, 1.0], [-1.5, 1.4, -3.0], PERSPECTIVE));
    cameras.push(camera([0.0, 1.5, 0.02], [0.5, 1.4, 3.0], PERSPECTIVE));
    let parallel = RefLens::Orthographic { half_height: 2.5 };
    cameras.push(camera([0.5, 2.0, 9.0], [0.0, 1.2, 0.0], parallel));
    cameras.push(camera([0.0, 1.5, 900.0], [0.0, 1.5, 0.0], parallel));
    cameras
}

fn hidden(plan: &Plan) -> usize {
    let firsts = plan
        .passes
        .iter()
        .filter(|pass| matches!(pass.kind, PassKind::First { .. }));
    let skips = firsts.flat_map(|pass| &pass.skipped);
    skips
        .filter(|skip| skip.reason == SkipReason::Occluded)
        .map(|skip| skip.count)
        .sum()
}

/// The most objects that were hidden in any view.
fn compare(text: &str, settings: &Settings) -> usize {
    let mut stage = Stage::new(scene_of(text));
    let mut shoot = |camera: &RefCamera, occlusion| {
        let settings = Settings {
            occlusion,
            ..settings.clone()
        };
        stage.shoot(camera, SIZE, &settings)
    };
    let mut most = 0;
    for (i, camera) in cameras().iter().enumerate() {
        let all = shoot(camera, Occlusion::Off);
        assert_eq!(hidden(&all.plan), 0);
        // Once from where the last view left off, and once from what is right already.
        let mut before = 0;
        for time in 0..2 {
            let some = shoot(camera, Occlusion::On);
            let differing = differing(&all, &some);
            assert!(differing == 0, "view {i}, time {time}: {differing} pixels");
            assert_eq!(some.plan.passes.len(), some.report.passes.len());
            // What was hidden is asked about again, and stays so.
            let hidden = hidden(&some.plan);
            assert!(hidden >= before, "view {i}: {before}, then {hidden} hidden");
            before = hidden;
            most = most.max(hidden);
        }
    }
    most
}

fn differing(a: &Shot, b: &Shot) -> usize {
    let pixels = a.rgba.as_chunks::<4>().0.iter();
    let others = b.rgba.as_chunks::<4>().0;
    pixels.zip(others).filter(|(a, b)| a != b).count()
}

#[test]
fn what_lies_behind_is_left_out_and_the_picture_stays() {
    let house = house();
    let unlit = house.replace("Light {", "Light { on FALSE");
    let standard = Settings::default();
    let with = |change: fn(&mut Settings)| {
        let mut settings = Settings::default();
        change(&mut settings);
        settings
    };
    // The last number: objects that are hidden at least, in one of the views.
    let rows = [
        ("volumes", &house, standard.clone(), 30),
        ("four samples", &house, with(|s| s.samples = 4), 30),
        (
            "no shadows",
            &house,
            with(|s| s.shadows = Shadows::None),
            30,
        ),
        (
            "maps",
            &house,
            with(|s| s.shadows = Shadows::Map { size: 256 }),
            30,
        ),
        ("rays", &house, with(|s| s.shadows = Shadows::Rays), 30),
        ("headlight", &unlit, standard, 30),
        (
            "shown volumes, which are not asked about",
            &house,
            with(|s| s.overlay.has_volumes = true),
            0,
        ),
        (
            "cut open",
            &house,
            with(|s| s.section = Some(DVec3::X.extend(-0.6))),
            10,
        ),
    ];
    for (name, text, settings, least) in rows {
        let most = compare(text, &settings);
        assert!(most >= least, "{name}: at most {most} are hidden");
    }
}

#[test]
fn what_peeks_out_is_drawn_and_lights_of_hidden_rooms_are_not() {
    let cube = |x: f64, z: f64| {
        format!(
            "Separator {{ Translation {{ translation {x} 0 {z} }} \
             Cube {{ width 1 height 1 depth 1 }} }}\n"
        )
    };
    let wall = "Separator { Cube { width 6 height 6 depth 0.1 } }\n";
    let room = "Separator { PointLight { location 0 2 -5 } Translation { translation 0 0 -5 } \
                Cube { } }\n";
    let front = camera([0.0, 0.0, 10.0], [0.0, 0.0, 0.0], PERSPECTIVE);
    let shoot = |body: &[&str], occlusion| {
        let text = format!(
            "#Inventor V2.1 ascii\nDirectionalLight {{ direction -0.2 -0.1 -1 }}\n{}",
            body.concat()
        );
        let settings = Settings {
            occlusion,
            ..Settings::default()
        };
        let mut stage = Stage::new(scene_of(&text));
        stage.shoot(&front, SIZE, &settings)
    };
    let behind = cube(0.0, -2.0);
    // At this distance the wall ends 3.15 to the right; a tile is a tenth of it.
    let peeking = cube(3.2, -2.0);
    let inside = cube(2.0, -2.0);
    let shot = shoot(&[wall, &behind, &peeking, &inside], Occlusion::On);
    assert_eq!(hidden(&shot.plan), 2, "{}", shot.plan.brief());
    let brief = shot.plan.brief();
    assert!(
        brief.starts_with("depth x4; volumes 0 ") && brief.ends_with("first + light 0 x2"),
        "{brief}"
    );

    let all = shoot(&[wall, room], Occlusion::Off);
    let some = shoot(&[wall, room], Occlusion::On);
    assert!(all.plan.brief().contains("light 1"), "{}", all.plan.brief());
    assert!(
        !some.plan.brief().contains("light 1"),
        "{}",
        some.plan.brief()
    );
    let reason = SkipReason::LightReachesNothing;
    assert_eq!(some.plan.skipped_lights, [(1, reason)]);
    assert_eq!(differing(&all, &some), 0);

    // A line that lies behind the wall, but is thicker than what the wall hides of it.
    let line = "Separator { DrawStyle { lineWidth 40 } Coordinate3 { point [ -1 2.7 -1, \
                1 2.7 -1 ] } IndexedLineSet { coordIndex [ 0, 1, -1 ] } }\n";
    let all = shoot(&[wall, line], Occlusion::Off);
    let some = shoot(&[wall, line], Occlusion::On);
    assert_eq!((hidden(&some.plan), differing(&all, &some)), (0, 0));
    let thin = shoot(&[wall, &line.replace("40", "1")], Occlusion::On);
    assert_eq!(hidden(&thin.plan), 1);

    // A line in the wall, so little that it is drawn before it.
    let line = "Separator { Coordinate3 { point [ -1 0.1 0.0489, 1 0.1 0.0489 ] } \
                IndexedLineSet { coordIndex [ 0, 1, -1 ] } }\n";
    let all = shoot(&[wall, line], Occlusion::Off);
    assert!(differing(&all, &shoot(&[wall], Occlusion::Off)) > 10);
    assert_eq!(differing(&all, &shoot(&[wall, line], Occlusion::On)), 0);

    // Nobody asks where it cannot pay.
    let auto = shoot(&[wall, &behind], Occlusion::Auto);
    let off = shoot(&[wall, &behind], Occlusion::Off);
    assert_eq!(auto.plan, off.plan);
}
