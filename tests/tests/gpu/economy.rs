//! What a frame leaves out, read from its plan and its report. Not what it looks like, but for
//! pictures that must stay the same.

use glam::DVec3;
use tests::reference::{RefCamera, RefLens};
use tests::shadow_scenes::scene_of;
use viewer::frame::{PassKind, Plan, Settings, Shadows, Skip, SkipReason};

use super::device::{Shot, Stage};

const SIZE: [u32; 2] = [64, 48];
const FLOOR: &str = "Separator { Coordinate3 { point [ -3 0 3, 3 0 3, 3 0 -3, -3 0 -3 ] } \
                     IndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1 ] } }\n";
const CUBE: &str = "Separator { Translation { translation 0 1 0 } \
                    Cube { width 1 height 1 depth 1 } }\n";
const SUN: &str = "DirectionalLight { direction -0.3 -1 -0.2 }\n";
/// Behind the camera of `over`, apart from what it sees under any light of these tests.
const BEHIND: &str = "Separator { Translation { translation 9 5 20 } Cube { } }\n";

fn text(body: &[&str]) -> String {
    format!("#Inventor V2.1 ascii\n{}", body.concat())
}

fn stage(body: &[&str]) -> Stage {
    Stage::new(scene_of(&text(body)))
}

fn at(eye: [f64; 3], target: [f64; 3]) -> RefCamera {
    let lens = RefLens::Perspective {
        tan_half_height: 0.5,
    };
    RefCamera::look_at(DVec3::from(eye), DVec3::from(target), DVec3::Y, lens)
}

/// The cube and most of the floor, from above.
fn over() -> RefCamera {
    at([3.0, 4.0, 5.0], [0.0, 0.5, 0.0])
}

fn shoot(stage: &mut Stage, camera: &RefCamera) -> Shot {
    stage.shoot(camera, SIZE, &Settings::default())
}

#[test]
fn lights_that_add_nothing_add_no_pass() {
    let weakening = "Environment { attenuation 1 0 0 }\n";
    let plain = shoot(&mut stage(&[weakening, SUN, FLOOR, CUBE]), &over());
    let nothing = SkipReason::LightReachesNothing;
    // A second light, and why it is skipped; nothing is skipped that is not in the scene at all.
    let rows = [
        ("PointLight { location 1 3 1 on FALSE }", None),
        (
            "PointLight { location 1 3 1 color 0 0 0 }",
            Some(SkipReason::BlackLight),
        ),
        (
            "PointLight { location 1 3 1 intensity 0 }",
            Some(SkipReason::BlackLight),
        ),
        ("PointLight { location 0 100 0 }", Some(nothing)),
        (
            "SpotLight { location 0 9 0 direction 0 1 0 }",
            Some(nothing),
        ),
        (
            "Separator { PointLight { location 1 3 1 } Translation { translation 9 5 20 } Cube { } }",
            Some(nothing),
        ),
    ];
    for (light, reason) in rows {
        let shot = shoot(&mut stage(&[weakening, SUN, light, FLOOR, CUBE]), &over());
        assert_eq!(shot.plan.brief(), plain.plan.brief(), "{light}");
        let skipped: Vec<_> = reason.map(|reason| (1, reason)).into_iter().collect();
        assert_eq!(shot.plan.skipped_lights, skipped, "{light}");
        assert!(shot.rgba == plain.rgba, "{light}: another picture");
    }
    // The same lamp within reach does add passes.
    let lamp = "PointLight { location 0 10 0 }\n";
    let lit = shoot(&mut stage(&[weakening, SUN, lamp, FLOOR, CUBE]), &over());
    assert_eq!(lit.plan.passes.len(), plain.plan.passes.len() + 2);
}

#[test]
fn textures_cost_those_who_have_them() {
    let texture = "Texture2 { image 1 2 3 0xff0000 0x00ff00 }\n";
    for (texture, images) in [("", 0), (texture, 1)] {
        let mut stage = stage(&[texture, SUN, FLOOR, CUBE]);
        shoot(&mut stage, &over());
        let renderer = stage.renderer();
        assert_eq!(renderer.texture_count(), images, "{texture}");
        assert_eq!(renderer.textured_shaders() > 0, images > 0, "{texture}");
    }
}

#[test]
fn what_was_made_is_kept() {
    let scene = [SUN, FLOOR, CUBE];
    let nearby = over().moved(DVec3::new(0.1, 0.2, -0.1));
    let mut stage = stage(&scene);
    // Camera; pipelines and shaders are made; lights whose volumes are made and kept.
    let rows = [
        (over(), true, [1, 0]),
        (over(), false, [0, 1]),
        (nearby, false, [0, 1]),
        (over(), false, [0, 1]),
    ];
    let mut pictures = Vec::new();
    for (i, (camera, compiles, volumes)) in rows.into_iter().enumerate() {
        let shot = shoot(&mut stage, &camera);
        let report = &shot.report;
        assert_eq!(report.pipelines.pipelines > 0, compiles, "frame {i}");
        assert_eq!(report.pipelines.shaders > 0, compiles, "frame {i}");
        assert_eq!(
            [report.volumes_made, report.volumes_kept],
            volumes,
            "frame {i}"
        );
        pictures.push(shot.rgba);
    }
    assert!(pictures[0] == pictures[1] && pictures[0] == pictures[3]);
    assert!(pictures[0] != pictures[2]);
}

#[test]
fn another_light_has_other_volumes() {
    let lamp = |x: f64| format!("PointLight {{ location {x} 4 1 }}\n");
    let [here, there] = [0.0, 1.0].map(|x| {
        let shot = shoot(&mut stage(&[&lamp(x), FLOOR, CUBE]), &over());
        assert_eq!((shot.report.volumes_made, shot.report.volumes_kept), (1, 0));
        shot.rgba
    });
    assert!(here != there, "the shadow stayed");
}

/// What the first pass of a kind skips.
fn skipped(plan: &Plan, is_it: fn(&PassKind) -> bool) -> Vec<(SkipReason, usize)> {
    let pass = plan.passes.iter().find(|pass| is_it(&pass.kind));
    let list = &pass.expect("there is such a pass").skipped;
    list.iter()
        .map(|&Skip { reason, count }| (reason, count))
        .collect()
}

#[test]
fn what_is_skipped_is_counted() {
    let is_first = |kind: &PassKind| matches!(kind, PassKind::First { .. });
    let is_light = |kind: &PassKind| matches!(kind, PassKind::Light { .. });
    let is_volumes = |kind: &PassKind| matches!(kind, PassKind::Volumes { .. });
    let is_transparent = |kind: &PassKind| matches!(kind, PassKind::Transparent);
    let behind = SkipReason::OutOfView;
    let caps = SkipReason::CapsNotNeeded;
    let unlit = format!("Separator {{ LightModel {{ model BASE_COLOR }} {CUBE} }}\n");
    let scoped = format!("Separator {{ {SUN} {CUBE} }}\n");
    let glass = "Separator { Material { transparency 0.5 } \
                 Separator { Translation { translation 9 5 20 } Cube { } } \
                 Translation { translation 1 1 1 } Cube { } }\n";
    // A lamp that shines some four units far; another light stands before it, in the first pass.
    let weak = "Environment { attenuation 100 0 0 } PointLight { location -2 1 2 }\n";
    let lamp = "PointLight { location 0 4 0 }\n";
    let far = "Separator { Translation { translation -9 0 -9 } Sphere { radius 0.5 } }\n";
    type Row<'a> = (
        &'a str,
        Vec<&'a str>,
        fn(&PassKind) -> bool,
        Vec<(SkipReason, usize)>,
    );
    let rows: Vec<Row<'_>> = vec![
        ("all in view", vec![SUN, FLOOR, CUBE], is_first, vec![]),
        (
            "two behind",
            vec![SUN, FLOOR, BEHIND, BEHIND],
            is_first,
            vec![(behind, 2)],
        ),
        (
            "behind, lit",
            vec![lamp, SUN, FLOOR, BEHIND, BEHIND],
            is_light,
            vec![(behind, 2)],
        ),
        (
            "shadows behind",
            vec![SUN, FLOOR, BEHIND, BEHIND],
            is_volumes,
            vec![(SkipReason::ShadowOutOfView, 2), (caps, 1)],
        ),
        (
            "not lit",
            vec![lamp, SUN, FLOOR, &unlit],
            is_light,
            vec![(SkipReason::Unlit, 1)],
        ),
        (
            "not in scope",
            vec![lamp, &scoped, FLOOR],
            is_light,
            vec![(SkipReason::OutOfScope, 1)],
        ),
        (
            "beyond the lamp",
            vec![SUN, weak, FLOOR, far],
            is_light,
            vec![(SkipReason::OutOfReach, 1)],
        ),
        (
            "casts nothing",
            vec![weak, FLOOR, far],
            is_volumes,
            vec![(SkipReason::CasterOutOfReach, 1), (caps, 1)],
        ),
        (
            "glass",
            vec![SUN, FLOOR, glass],
            is_transparent,
            vec![(behind, 1)],
        ),
    ];
    for (name, body, is_it, mut expected) in rows {
        let shot = shoot(&mut stage(&body), &over());
        let mut found = skipped(&shot.plan, is_it);
        found.sort();
        expected.sort();
        assert_eq!(found, expected, "{name}: {}", shot.plan.brief());
    }
}

#[test]
fn light_without_shadow_joins_the_first_pass() {
    // Lit lines, far from all that casts shadows, with a lamp that shines on them alone.
    let lines = "Separator { Translation { translation 0 0 -30 } \
                 Environment { attenuation 100 0 0 } PointLight { location 0 0 1 } \
                 Normal { vector 0 0 1 } NormalBinding { value OVERALL } \
                 Coordinate3 { point [ -5 0 0, 5 0 0 ] } LineSet { } }\n";
    let camera = at([0.0, 3.0, 12.0], [0.0, 0.0, 0.0]);
    let shot = shoot(&mut stage(&[SUN, FLOOR, lines]), &camera);
    assert_eq!(
        shot.plan.brief(),
        "first + light 1 x2; volumes 0 z-fail x0 z-pass x1; light 0 x2"
    );
    // A caster beside the lamp takes it back out.
    let caster = "Separator { Translation { translation 0 0 -29.5 } Cube { } }\n";
    let shot = shoot(&mut stage(&[SUN, FLOOR, lines, caster]), &camera);
    assert!(
        shot.plan.brief().starts_with("depth x3; volumes 0 "),
        "{}",
        shot.plan.brief()
    );
}

#[test]
fn what_was_drawn_before_hides_nothing() {
    let wall =
        "Separator { Translation { translation 0 0 -3 } Cube { width 4 height 4 depth 1 } }\n";
    let glass = "Separator { Material { transparency 0.5 emissiveColor 1 1 1 } \
                 Translation { translation 0 0 9 } Cube { } }\n";
    let scene = [SUN, wall, glass];
    let to_wall = at([0.0, 0.0, 3.0], [0.0, 0.0, -3.0]);
    let to_glass = at([0.0, 0.0, 3.0], [0.0, 0.0, 9.0]);
    let mut used = stage(&scene);
    shoot(&mut used, &to_wall);
    let after = shoot(&mut used, &to_glass);
    let alone = shoot(&mut stage(&scene), &to_glass);
    let lit = alone.rgba.as_chunks::<4>().0.iter().filter(|p| p[0] > 20);
    assert!(lit.count() > 100, "{}", alone.plan.brief());
    assert!(after.rgba == alone.rgba, "{}", after.plan.brief());
}

#[test]
fn what_stands_twice_in_one_place_is_lit_once() {
    let lamps = "PointLight { location -1 4 1 } PointLight { location 2 4 1 }\n";
    for shadows in [Settings::default().shadows, Shadows::None] {
        let settings = Settings {
            shadows,
            ..Settings::default()
        };
        let shoot = |body: &[&str]| stage(body).shoot(&over(), SIZE, &settings);
        let once = shoot(&[SUN, lamps, FLOOR, CUBE]);
        let twice = shoot(&[SUN, lamps, FLOOR, FLOOR, CUBE, CUBE]);
        assert!(once.rgba == twice.rgba, "{}", once.plan.brief());
    }
}

#[test]
fn caps_where_the_eye_may_be_in_shadow() {
    let lamp = "PointLight { location 0 4 0 }\n";
    // Eye; volumes by z-fail and by z-pass. The cube is -0.5 to 0.5 around the Y axis, from 0.5 up.
    let rows = [
        ("clear", [3.0, 4.0, 5.0], [0, 2]),
        ("beside the light", [0.2, 4.0, 0.1], [0, 2]),
        ("in the cube's shadow", [0.1, 0.25, 0.3], [1, 1]),
        ("under the floor", [2.5, -1.0, 2.5], [1, 1]),
        ("under both", [0.1, -1.0, 0.1], [2, 0]),
    ];
    for (name, eye, counts) in rows {
        let camera = at(eye, [0.0, 0.4, -2.0]);
        let mut stage = stage(&[lamp, FLOOR, CUBE]);
        let by_choice = shoot(&mut stage, &camera);
        let volumes = by_choice.plan.passes.iter().flat_map(|pass| &pass.volumes);
        let z_pass = volumes.clone().filter(|volume| volume.is_z_pass).count();
        assert_eq!([volumes.count() - z_pass, z_pass], counts, "{name}");
        let always = Settings {
            allows_z_pass: false,
            ..Settings::default()
        };
        let z_fail = stage.shoot(&camera, SIZE, &always);
        assert!(
            z_fail
                .plan
                .passes
                .iter()
                .flat_map(|pass| &pass.volumes)
                .all(|volume| !volume.is_z_pass)
        );
        assert!(by_choice.rgba == z_fail.rgba, "{name}: another picture");
    }
}

#[test]
fn plans() {
    let glass = "Separator { Material { transparency 0.5 } Translation { translation 2 1 0 } \
                 Cube { } }\n";
    let lamp = "PointLight { location -1 4 1 }\n";
    let rows = [
        ("no light", vec![FLOOR, CUBE], "first + light 0 x2"),
        (
            "sun",
            vec![SUN, FLOOR, CUBE],
            "depth x2; volumes 0 z-fail x0 z-pass x2; first + light 0 x2",
        ),
        (
            "two lights, glass, and something behind",
            vec![SUN, lamp, FLOOR, CUBE, glass, BEHIND],
            "depth x2; volumes 0 z-fail x0 z-pass x2; first + light 0 x2; \
             volumes 1 z-fail x0 z-pass x2; light 1 x2; transparent x1",
        ),
    ];
    for (name, body, brief) in rows {
        let shot = shoot(&mut stage(&body), &over());
        assert_eq!(shot.plan.brief(), brief, "{name}");
        assert_eq!(
            shot.report.passes.len(),
            shot.plan.passes.len(),
            "{name}: passes that were drawn"
        );
    }
}
