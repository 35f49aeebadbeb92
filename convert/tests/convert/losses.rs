//! What is reported as lost.

use convert::LossKind;
use glam::{DAffine3, DVec3};
use scenegraph::scene::{
    Beam, Environment, EnvironmentId, Faces, Fog, FogType, LightId, LightKind, LightModel,
    LightSetId, Material, Projection, ViewportMapping,
};
use serde_json::{Value, json};

use crate::read::convert;
use crate::scenes::{Build, at_line, lines, material, points, scale, triangle};

const ID: DAffine3 = DAffine3::IDENTITY;

fn two_shapes() -> Build {
    let mut build = Build::one(triangle(), material());
    build.shape(None, None, ID);
    build
}

fn point() -> LightKind {
    LightKind::Point { location: DVec3::X }
}

fn fog() -> Environment {
    let fog = Fog {
        fog_type: FogType::Haze,
        color_srgb: [1.0, 0.0, 0.0],
        visibility: 50.0,
    };
    Environment {
        fog: Some(fog),
        ..Environment::default()
    }
}

#[test]
fn each_loss_is_reported_once_with_its_count() {
    use LossKind::*;
    type Make = fn() -> Build;
    let rows: [(&[(LossKind, u32)], Make); 16] = [
        (&[], two_shapes),
        (&[(Fog, 2)], || {
            let mut build = two_shapes();
            build.scene.environments[0] = fog();
            build
        }),
        (&[(AmbientLight, 2)], || {
            let mut build = two_shapes();
            build.scene.environments[0].ambient_intensity = 1.0;
            build
        }),
        (&[(AmbientLight, 1)], || {
            let bright = Material {
                ambient_srgb: [0.1, 0.9, 0.1],
                ..material()
            };
            Build::one(triangle(), bright)
        }),
        (&[(LightScope, 1)], || {
            let mut build = two_shapes();
            build.light(
                None,
                ID,
                LightKind::Directional {
                    direction: DVec3::X,
                },
            );
            build.scene.light_sets.push(Vec::new());
            build.scene.instances[1].light_set = LightSetId(1);
            build
        }),
        // Light does not matter to what is not lit.
        (&[], || {
            let unlit = Material {
                light_model: LightModel::BaseColor,
                faces: Faces::BothOneSidedLighting,
                ..material()
            };
            let mut build = Build::one(triangle(), unlit);
            build.light(
                None,
                ID,
                LightKind::Directional {
                    direction: DVec3::X,
                },
            );
            build.scene.light_sets[0].clear();
            build
        }),
        (&[(LightAttenuation, 2)], || {
            let mut build = two_shapes();
            build.light(None, ID, point());
            build.light(None, ID, point());
            build
        }),
        (&[(LightAttenuation, 1), (SpotDropOff, 1)], || {
            let mut build = two_shapes();
            build.light(
                None,
                ID,
                LightKind::Spot {
                    location: DVec3::X,
                    direction: DVec3::Y,
                    drop_off_rate: 0.5,
                    cut_off_angle_rad: 0.5,
                },
            );
            build
        }),
        // A beam is glTF's own cone, but for the exponent of its ramp.
        (&[(LightAttenuation, 1)], || spot_with_beam(2.0)),
        (&[(LightAttenuation, 1), (SpotDropOff, 1)], || {
            spot_with_beam(1.0)
        }),
        (&[(OneSidedLighting, 1)], || {
            let faces = Faces::BothOneSidedLighting;
            Build::one(
                triangle(),
                Material {
                    faces,
                    ..material()
                },
            )
        }),
        (&[(LineWidth, 1), (LinePattern, 1)], || {
            let dashed = Material {
                line_width_px: 2.0,
                line_pattern: 0xff00,
                point_size_px: 3.0,
                ..material()
            };
            Build::one(lines(), dashed)
        }),
        (&[(PointSize, 1)], || {
            let dots = Material {
                line_width_px: 2.0,
                point_size_px: 3.0,
                ..material()
            };
            Build::one(points(), dots)
        }),
        (&[], || {
            let one = Material {
                line_width_px: 1.0,
                point_size_px: 1.0,
                ..material()
            };
            let mut build = Build::one(points(), one.clone());
            build.instance(None, None, ID, lines(), one);
            build
        }),
        (&[(ViewportMapping, 1)], || {
            let mut build = two_shapes();
            build.camera(None, ID, Projection::Orthographic { height: 2.0 });
            build.camera(None, ID, Projection::Orthographic { height: 2.0 });
            build.scene.cameras[1].viewport_mapping = self::ViewportMapping::CropViewport;
            build
        }),
        (&[(CameraFrame, 1)], || {
            let mut build = two_shapes();
            let stretch = scale(1.0, 2.0, 1.0);
            build.camera(None, stretch, Projection::Orthographic { height: 2.0 });
            build
        }),
    ];
    for (want, make) in rows {
        let report = convert(&make().scene).report;
        let got: Vec<_> = report
            .losses
            .iter()
            .map(|loss| (loss.kind, loss.count))
            .collect();
        assert_eq!(got, want);
    }
}

#[test]
fn a_loss_stands_where_its_cause_does() {
    use LossKind::*;
    type Make = fn() -> Build;
    // Shapes and lights stand at line 10; what comes from defaults stands nowhere.
    let rows: [(LossKind, u32, &str, Make); 8] = [
        (LineWidth, 33, "4.5 pixels", || {
            let wide = Material {
                line_width_px: 4.5,
                pos: at_line(7),
                style_pos: at_line(33),
                ..material()
            };
            Build::one(lines(), wide)
        }),
        (LineWidth, 10, "4.5 pixels", || {
            let wide = Material {
                line_width_px: 4.5,
                ..material()
            };
            Build::one(lines(), wide)
        }),
        (Fog, 44, "Haze", || {
            let mut build = two_shapes();
            build.scene.environments[0] = Environment {
                pos: at_line(44),
                ..fog()
            };
            build
        }),
        (Fog, 10, "Haze", || {
            let mut build = two_shapes();
            build.scene.environments[0] = fog();
            build
        }),
        (AmbientLight, 44, "0.10", || {
            let mut build = two_shapes();
            build.scene.environments[0].ambient_intensity = 0.5;
            build.scene.environments[0].pos = at_line(44);
            build
        }),
        (AmbientLight, 33, "0.18", || {
            let bright = Material {
                ambient_srgb: [0.1, 0.9, 0.1],
                pos: at_line(33),
                ..material()
            };
            let mut build = Build::one(triangle(), bright);
            build.scene.environments[0].pos = at_line(44);
            build
        }),
        (LightScope, 13, "Lamp", || {
            let mut build = two_shapes();
            for line in [12, 13, 14] {
                build.light(None, ID, point());
                let light = build.scene.lights.last_mut().unwrap();
                light.placement.pos = at_line(line);
                light.placement.name = (line == 13).then(|| "Lamp".into());
            }
            build.scene.light_sets[0] = vec![LightId(2), LightId(0), LightId(0)];
            build
        }),
        (LightScope, 12, "PointLight", || {
            let mut build = two_shapes();
            build.light(None, ID, point());
            build.scene.light_sets[0].clear();
            build
        }),
    ];
    for (kind, line, detail, make) in rows {
        let losses = convert(&make().scene).report.losses;
        let loss = losses.iter().find(|loss| loss.kind == kind).unwrap();
        assert_eq!((loss.pos, &*loss.detail), (at_line(line), detail));
    }
}

#[test]
fn environments_are_in_the_scenes_extras() {
    let mut build = two_shapes();
    build.scene.environments.push(Environment {
        ambient_intensity: 0.5,
        ambient_color_srgb: [0.0, 0.0, 1.0],
        attenuation: [0.0, 1.0, 0.0],
        ..fog()
    });
    build.scene.instances[1].environment = EnvironmentId(1);
    let want = json!({"iv": {"environments": [{}, {
        "ambientIntensity": 0.5,
        "ambientColor": [0, 0, 1],
        "attenuation": [0, 1, 0],
        "fogType": "HAZE",
        "fogColor": [1, 0, 0],
        "fogVisibility": 50,
    }]}});
    let converted = convert(&build.scene);
    assert_eq!(converted.at("/scenes/0/extras"), &want);
    let scopes = converted.nodes().iter().map(|node| node.get("extras"));
    let in_second = json!({"iv": {"environment": 1}});
    assert!(scopes.eq([None, Some(&in_second)]));
}

#[test]
fn light_sets_are_in_extras_unless_all_lights_reach_all() {
    let mut build = two_shapes();
    build.light(
        None,
        DAffine3::IDENTITY,
        LightKind::Directional {
            direction: DVec3::X,
        },
    );
    assert_eq!(convert(&build.scene).at("/scenes/0/extras"), &Value::Null);
    build.scene.light_sets.push(Vec::new());
    build.scene.instances[0].light_set = LightSetId(1);
    let converted = convert(&build.scene);
    assert_eq!(
        converted.at("/scenes/0/extras/iv/lightSets"),
        &json!([[0], []])
    );
    assert_eq!(
        converted.at("/nodes/0/extras"),
        &json!({"iv": {"lightSet": 1}})
    );
    assert_eq!(converted.at("/nodes/1/extras"), &Value::Null);
}

fn spot_with_beam(exponent: f64) -> Build {
    let mut build = two_shapes();
    build.light(
        None,
        ID,
        LightKind::Spot {
            location: DVec3::X,
            direction: DVec3::Y,
            drop_off_rate: 0.5,
            cut_off_angle_rad: 0.5,
        },
    );
    build.scene.lights[0].beam = Some(Beam {
        inner_angle_rad: 0.25,
        exponent,
    });
    build
}
