//! Materials, textures, lights, cameras, groups and their state.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use glam::DVec3;
use scenegraph::scene::{
    Faces, Fog, FogType, LightKind, LightModel, Material, Projection, TextureSource, Wrap,
};
use tests::measure::totals;

use super::{Library, scene_of, scene_with};

fn material(text: &str) -> Material {
    let (scene, codes) = scene_of(text);
    assert!(codes.is_empty(), "{text}: {codes:?}");
    let instance = scene.instances.first().expect("a shape");
    scene.materials[instance.material.index()].clone()
}

#[test]
fn materials() {
    let all = "Shape { geometry Box { } appearance Appearance { material DEF Skin Material {
        diffuseColor .5 .25 1 ambientIntensity .5 specularColor .1 .2 .3 emissiveColor .4 0 0
        shininess .7 transparency .25 } } }";
    let found = material(all);
    assert_eq!(found.name.as_deref(), Some("Skin"));
    assert_eq!(found.diffuse_srgb, [0.5, 0.25, 1.0]);
    assert_eq!(found.ambient_srgb, [0.25, 0.125, 0.5]);
    assert_eq!(found.specular_srgb, [0.1, 0.2, 0.3]);
    assert_eq!(found.emissive_srgb, [0.4, 0.0, 0.0]);
    assert_eq!((found.shininess, found.transparency), (0.7, 0.25));
    assert_eq!(found.light_model, LightModel::Phong);
}

/// Text, lit, diffuse colour.
type Look = (&'static str, bool, [f64; 3]);

const LOOKS: &[Look] = &[
    ("Shape { geometry Box { } }", false, [1.0; 3]),
    (
        "Shape { geometry Box { } appearance Appearance { } }",
        false,
        [1.0; 3],
    ),
    (
        "Shape { geometry Box { } appearance Appearance { material Material { } } }",
        true,
        [0.8; 3],
    ),
    // Lines and points show the emissive colour and are not lit.
    (
        "Shape { geometry PointSet { coord Coordinate { point [ 0 0 0 ] } }
            appearance Appearance { material Material { emissiveColor 0 1 0 } } }",
        false,
        [0.0, 1.0, 0.0],
    ),
    (
        "Shape { geometry IndexedLineSet { coord Coordinate { point [ 0 0 0, 1 0 0 ] } coordIndex [ 0 1 ] } }",
        false,
        [1.0; 3],
    ),
    // A grey picture multiplies, a coloured one replaces.
    (
        "Shape { geometry Box { } appearance Appearance { material Material { diffuseColor 1 0 0 }
            texture PixelTexture { image 1 1 1 0x80 } } }",
        true,
        [1.0, 0.0, 0.0],
    ),
    (
        "Shape { geometry Box { } appearance Appearance { material Material { diffuseColor 1 0 0 }
            texture PixelTexture { image 1 1 3 0x80ff80 } } }",
        true,
        [1.0; 3],
    ),
    // Nothing leaks from one shape to the next, nor from Inventor's nodes around them.
    (
        "Shape { } Material { diffuseColor 0 0 1 } Shape { geometry Box { } }",
        false,
        [1.0; 3],
    ),
];

#[test]
fn looks() {
    for (text, lit, diffuse) in LOOKS {
        let (scene, _) = scene_of(text);
        let instance = scene.instances.last().expect("a shape");
        let found = &scene.materials[instance.material.index()];
        assert_eq!(found.light_model == LightModel::Phong, *lit, "{text}");
        assert_eq!(found.diffuse_srgb, *diffuse, "{text}");
    }
}

#[test]
fn sides() {
    let faces = |fields: &str| {
        let text = format!(
            "Shape {{ geometry IndexedFaceSet {{ {fields}
                coord Coordinate {{ point [ 0 0 0, 1 0 0, 0 1 0 ] }} coordIndex [ 0 1 2 ] }} }}"
        );
        material(&text).faces
    };
    assert_eq!(faces(""), Faces::FrontOnly);
    assert_eq!(faces("solid FALSE"), Faces::BothTwoSidedLighting);
    assert_eq!(faces("ccw FALSE"), Faces::FrontOnly);
}

#[test]
fn textures() {
    let text = "Shape { geometry Box { } appearance Appearance {
        texture ImageTexture { url [ \"http://x.org/a.png\" \"b.png\" ] repeatS FALSE } } }";
    let (scene, _) = scene_of(text);
    let texture = &scene.textures[0];
    let TextureSource::File { name, .. } = &texture.source else {
        panic!("{texture:?}")
    };
    assert_eq!(&**name, "b.png");
    assert_eq!(
        (texture.wrap_s, texture.wrap_t),
        (Wrap::Clamp, Wrap::Repeat)
    );
}

#[test]
fn one_mesh_for_many_uses() {
    let rows = [
        (
            "DEF A Shape { geometry Sphere { } } Transform { translation 3 0 0 children USE A }",
            2,
        ),
        (
            "PROTO P [ field SFVec3f at 0 0 0 ] {
                Transform { translation IS at children Shape { geometry Box { } } } }
             P { } P { at 3 0 0 }",
            2,
        ),
        (
            "Shape { geometry DEF S Extrusion { } } Shape { geometry USE S } Shape { geometry USE S }",
            3,
        ),
        (
            "DEF G Group { children Shape { geometry ElevationGrid { xDimension 2 zDimension 2 height [ 0 0 0 0 ] } } } USE G",
            2,
        ),
    ];
    for (text, instances) in rows {
        let (scene, _) = scene_of(text);
        assert_eq!(scene.instances.len(), instances, "{text}");
        assert_eq!(scene.meshes.len(), 1, "{text}");
    }
}

/// Groups: text, the number of boxes drawn, the codes of remarks.
#[test]
fn groups() {
    const BOX: &str = "Shape { geometry Box { } }";
    let rows: &[(&str, usize, &[&str])] = &[
        ("Group { children [ B B ] }", 2, &[]),
        ("Anchor { children [ B ] url \"x\" }", 1, &[]),
        ("Collision { children [ B ] proxy B }", 1, &[]),
        ("Billboard { children B }", 1, &["hidden"]),
        ("Switch { choice [ B ] }", 0, &["hidden"]),
        ("Switch { choice [ B B ] whichChoice 1 }", 1, &["hidden"]),
        ("Switch { choice [ B ] whichChoice 0 }", 1, &[]),
        (
            "Switch { choice [ B ] whichChoice 2147483647 }",
            0,
            &["hidden"],
        ),
        (
            "LOD { level [ B Group { children [ B B ] } ] }",
            1,
            &["hidden"],
        ),
        ("Group { children Cube { } }", 1, &[]),
        (
            "#Inventor V2.1 ascii\nVRMLGroup { children VRMLShape { geometry VRMLBox { } } }",
            1,
            &[],
        ),
        (
            "TimeSensor { } Script { url \"x\" field SFNode n B } B",
            1,
            &["no-effect", "no-effect"],
        ),
        (
            "DEF A Group { } DEF B Group { } ROUTE A.x TO B.y",
            0,
            &["route"],
        ),
        ("Background { }", 0, &["background"]),
    ];
    for (text, boxes, wanted) in rows {
        let text = format!("{text} ")
            .replace("B ", &format!("{BOX} "))
            .replace(&format!("DEF {BOX}"), "DEF B");
        let (scene, codes) = scene_of(&text);
        assert_eq!(totals(&scene).triangles, 12 * boxes, "{text}");
        assert_eq!(codes, *wanted, "{text}");
    }
}

/// Scaled about the centre, turned about it, moved; inner groups are relative.
#[test]
fn transforms() {
    let point = "Shape { geometry PointSet { coord Coordinate { point [ 1 0 0 ] } } }";
    let rows = [
        (
            "Transform { translation 1 2 3 children P }",
            [2.0, 2.0, 3.0],
        ),
        (
            "Transform { scale 2 1 1 center -1 0 0 children P }",
            [3.0, 0.0, 0.0],
        ),
        (
            "Transform { rotation 0 0 1 1.5707963267948966 center 0 1 0 children P }",
            [1.0, 2.0, 0.0],
        ),
        (
            "Transform { translation 1 0 0 children Transform { scale 2 2 2 children P } }",
            [3.0, 0.0, 0.0],
        ),
        (
            "Transform { scale 3 1 1 scaleOrientation 0 0 1 1.5707963267948966 children P }",
            [1.0, 0.0, 0.0],
        ),
        (
            "Group { children [ Transform { translation 5 0 0 children Group { } } P ] }",
            [1.0, 0.0, 0.0],
        ),
    ];
    for (text, wanted) in rows {
        let (scene, _) = scene_of(
            &text
                .replace('P', point)
                .replace(&format!("{point}ointSet"), "PointSet"),
        );
        let [low, _] = totals(&scene).bounds.expect("a point");
        assert!(low.abs_diff_eq(DVec3::from(wanted), 1e-6), "{text}: {low}");
    }
}

/// The lights of each shape, by their intensity in tenths.
fn lights(text: &str) -> Vec<Vec<u32>> {
    let (scene, codes) = scene_of(text);
    assert!(codes.is_empty(), "{text}: {codes:?}");
    let of = |set: &Vec<scenegraph::scene::LightId>| {
        let tenths =
            |l: &scenegraph::scene::LightId| (scene.lights[l.index()].intensity * 10.0).round();
        set.iter().map(|l| tenths(l) as u32).collect()
    };
    let set = |i: &scenegraph::scene::Instance| of(&scene.light_sets[i.light_set.index()]);
    scene.instances.iter().map(set).collect()
}

#[test]
fn who_is_lit() {
    let rows: &[(&str, &[&[u32]])] = &[
        // Siblings on both sides and below, not outside.
        (
            "B Group { children [ B DirectionalLight { intensity .1 } Group { children B } ] }",
            &[&[], &[1], &[1]],
        ),
        ("B DirectionalLight { intensity .2 }", &[&[2]]),
        ("DirectionalLight { on FALSE } B", &[&[]]),
        // Everything in the scene within the radius.
        ("B Group { children PointLight { intensity .3 } }", &[&[3]]),
        (
            "B Transform { translation 500 0 0 children B } PointLight { intensity .3 radius 9 }",
            &[&[3], &[]],
        ),
        (
            "B Transform { scale 60 60 60 children SpotLight { intensity .4 radius 9 } }
             Transform { translation 500 0 0 children B }",
            &[&[4], &[4]],
        ),
        (
            "PointLight { intensity .5 } DirectionalLight { intensity .6 } B Group { children [ DirectionalLight { intensity .7 } B ] }",
            &[&[6, 5], &[6, 5, 7]],
        ),
    ];
    for (text, wanted) in rows {
        let text = format!(" {text} ").replace(" B ", " Shape { geometry Box { } } ");
        assert_eq!(lights(&text), *wanted, "{text}");
    }
}

#[test]
fn light_values() {
    let (scene, _) = scene_of(
        "SpotLight { location 1 2 3 direction 0 -2 0 attenuation 1 2 3 beamWidth .3 cutOffAngle .5 }
         SpotLight { } Shape { geometry Box { } }",
    );
    let LightKind::Spot {
        location,
        direction,
        drop_off_rate,
        cut_off_angle_rad,
    } = scene.lights[0].kind
    else {
        panic!("{:?}", scene.lights[0])
    };
    assert_eq!(
        (location, direction),
        (DVec3::new(1.0, 2.0, 3.0), DVec3::NEG_Y)
    );
    assert_eq!(cut_off_angle_rad, 0.5);
    // Half as bright midway between the beam's edge and the cut-off.
    let middle = 0.4_f64.cos().powf(128.0 * drop_off_rate);
    assert!((middle - 0.5).abs() < 1e-9, "{middle}");
    let attenuation = scene.environments[scene.lights[0].environment.index()].attenuation;
    assert_eq!(attenuation, [3.0, 2.0, 1.0]);
    let LightKind::Spot { drop_off_rate, .. } = scene.lights[1].kind else {
        panic!("{:?}", scene.lights[1])
    };
    assert_eq!(drop_off_rate, 0.0);
}

/// Without lights that say so there is no ambient light.
#[test]
fn ambient_light() {
    let ambient = |text: &str| {
        let (scene, _) = scene_of(text);
        let environment = &scene.environments[scene.instances[0].environment.index()];
        environment
            .ambient_color_srgb
            .map(|v| v * environment.ambient_intensity)
    };
    assert_eq!(ambient("Shape { geometry Box { } }"), [0.0; 3]);
    let lit = "Shape { geometry Box { } } DirectionalLight { ambientIntensity .5 color 1 .5 0 }";
    assert_eq!(ambient(lit), [0.5, 0.25, 0.0]);
}

#[test]
fn viewpoints() {
    let (scene, _) = scene_of(
        "Transform { translation 1 0 0 children Viewpoint { description \"front\" } }
         DEF Side Viewpoint { position 1 2 3 fieldOfView 1 orientation 0 1 0 1.5707963267948966 }",
    );
    let [first, second] = &scene.cameras[..] else {
        panic!("{:?}", scene.cameras)
    };
    assert_eq!(first.placement.name.as_deref(), Some("front"));
    assert_eq!(first.position, DVec3::new(0.0, 0.0, 10.0));
    assert_eq!(first.placement.world_from_local.translation, DVec3::X);
    let angle = |camera: &scenegraph::scene::Camera| match camera.projection {
        Projection::Perspective { height_angle_rad } => height_angle_rad,
        Projection::Orthographic { .. } => f64::NAN,
    };
    assert!((angle(first) - FRAC_PI_4).abs() < 1e-6);
    assert_eq!(
        (angle(second), second.placement.name.as_deref()),
        (1.0, Some("Side"))
    );
    let forward = second.orientation * DVec3::NEG_Z;
    assert!(
        forward.abs_diff_eq(DVec3::NEG_X, 1e-9),
        "{forward} {FRAC_PI_2}"
    );
}

#[test]
fn the_first_fog_counts() {
    let fog = |text: &str| {
        let (scene, _) = scene_of(text);
        scene.environments[scene.instances[0].environment.index()].fog
    };
    let wanted = Fog {
        fog_type: FogType::Fog,
        color_srgb: [1.0, 0.0, 0.0],
        visibility: 40.0,
    };
    let text = "Shape { geometry Box { } } Fog { } Transform { scale 2 2 2 children
        Fog { fogType \"EXPONENTIAL\" visibilityRange 20 color 1 0 0 } } Fog { visibilityRange 3 }";
    assert_eq!(fog(text), Some(wanted));
    assert_eq!(fog("Shape { geometry Box { } } Fog { }"), None);
}

#[test]
fn the_title_becomes_a_note() {
    let (scene, _) =
        scene_of("WorldInfo { title \"Lamp\" info [ \"a\" \"b\" ] } Shape { geometry Box { } }");
    let notes: Vec<&str> = scene.nodes[0].notes.iter().map(|n| &**n).collect();
    assert_eq!(notes, ["Lamp", "a", "b"]);
}

/// The first URL that is there; what follows `#` names a viewpoint.
#[test]
fn inlines() {
    const BOX: &str = "#VRML V2.0 utf8\nShape { geometry Box { } }";
    let library = Library(&[
        ("a.wrl", BOX),
        ("b.iv", "#Inventor V2.1 ascii\nCube { } Cube { }"),
    ]);
    let rows: &[(&str, usize, &[&str])] = &[
        (
            "Inline { url [ \"gone.wrl\" \"a.wrl#front\" \"b.iv\" ] }",
            1,
            &[],
        ),
        ("Inline { url \"b.iv\" } Inline { url \"a.wrl\" }", 3, &[]),
        ("Inline { url \"gone.wrl\" }", 0, &["include"]),
        ("Inline { }", 0, &[]),
        ("Inline { url \"main.wrl\" }", 0, &["include"]),
    ];
    for (text, boxes, wanted) in rows {
        let (scene, codes) = scene_with(text, &library);
        assert_eq!(totals(&scene).triangles, 12 * boxes, "{text}");
        assert_eq!(codes, *wanted, "{text}");
    }
}
