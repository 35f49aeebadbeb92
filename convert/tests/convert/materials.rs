//! Inventor's Phong values as metallic-roughness.

use glam::DAffine3;
use scenegraph::scene::{Faces, LightModel, Material, Mesh};
use serde_json::{Value, json};

use crate::read::{Converted, convert, numbers};
use crate::scenes::{Build, material, triangle};

fn written(material: Material) -> Value {
    convert(&Build::one(triangle(), material).scene).json["materials"][0].clone()
}

#[test]
fn the_default_material_has_no_highlight() {
    let want = json!([{
        "pbrMetallicRoughness": {
            // ((0.8 + 0.055) / 1.055)^2.4
            "baseColorFactor": [0.60382736, 0.60382736, 0.60382736, 1],
            "metallicFactor": 0,
            // The guide's table for shininess 0.2: 0.580.
            "roughnessFactor": 0.5796795,
        },
        "doubleSided": true,
        "extensions": {"KHR_materials_specular": {"specularFactor": 0}},
        "extras": {"iv": {"vertexOrdering": "COUNTERCLOCKWISE"}},
    }]);
    let Converted { json, .. } = convert(&Build::one(triangle(), material()).scene);
    assert_eq!(json["extensionsUsed"], json!(["KHR_materials_specular"]));
    let near = |got: &Value, want: &Value| {
        let (got, want) = (got.as_f64().unwrap(), want.as_f64().unwrap());
        (got - want).abs() < 1e-4
    };
    let got = &json["materials"][0]["pbrMetallicRoughness"];
    let base = &want[0]["pbrMetallicRoughness"];
    assert!(
        near(&got["roughnessFactor"], &base["roughnessFactor"]),
        "{got}"
    );
    assert!(
        near(&got["baseColorFactor"][0], &base["baseColorFactor"][0]),
        "{got}"
    );
    assert_eq!(got["metallicFactor"], 0);
    for key in ["doubleSided", "extensions", "extras"] {
        assert_eq!(json["materials"][0][key], want[0][key]);
    }
}

/// GGX at half vector angle `h`, over its value at 0.
fn ggx_share(roughness: f64, cos_h: f64) -> f64 {
    let alpha_squared = roughness.powi(4);
    let f = |c: f64| 1.0 / (c * c * (alpha_squared - 1.0) + 1.0).powi(2);
    f(cos_h) / f(1.0)
}

#[test]
fn the_highlight_is_as_wide_and_as_high_as_inventors() {
    for shininess in [0.02, 0.1, 0.2, 0.4, 0.8, 1.0] {
        let specular_srgb = [0.1, 0.05, 0.025];
        let got = written(Material {
            shininess,
            specular_srgb,
            ..material()
        });
        let roughness = got["pbrMetallicRoughness"]["roughnessFactor"]
            .as_f64()
            .unwrap();
        // Half height of cos^n.
        let cos_half = 0.5_f64.powf(1.0 / (128.0 * shininess));
        assert!(
            (ggx_share(roughness, cos_half) - 0.5).abs() < 1e-5,
            "{shininess}"
        );
        assert_eq!(got["extensions"]["KHR_materials_ior"]["ior"], 0);
        let specular = &got["extensions"]["KHR_materials_specular"];
        let factor = specular["specularFactor"].as_f64().unwrap();
        let tint = numbers(&specular["specularColorFactor"]);
        // Head on GGX is 1 / (pi alpha^2), times F0 / 4, under the light pi.
        for (tint, ks) in tint.into_iter().zip(specular_srgb) {
            let height = factor * tint / (4.0 * roughness.powi(4));
            assert!((height - ks).abs() < 1e-5, "{shininess}: {height}");
        }
    }
}

#[test]
fn extreme_values_stay_in_range() {
    let odd = [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e-9, 1.0, 1e300];
    for value in odd {
        let material = Material {
            diffuse_srgb: [value; 3],
            specular_srgb: [value, 1.0, 0.0],
            emissive_srgb: [value; 3],
            shininess: value,
            transparency: value,
            ..material()
        };
        let got = written(material);
        let base = &got["pbrMetallicRoughness"];
        let lists = [
            &base["baseColorFactor"],
            &got["emissiveFactor"],
            &got["extensions"]["KHR_materials_specular"]["specularColorFactor"],
        ];
        for list in lists.into_iter().filter(|list| list.is_array()) {
            assert!(
                numbers(list).iter().all(|v| (0.0..=1.0).contains(v)),
                "{value}: {list}"
            );
        }
        let roughness = base["roughnessFactor"].as_f64().unwrap();
        assert!((0.3..=1.0).contains(&roughness), "{value}: {roughness}");
    }
}

#[test]
fn what_is_mirrored_is_not_scattered() {
    // Shininess 0 has the widest lobe: alpha^2 = 1 / sqrt(2), F0 = 2 sqrt(2) ks.
    let f0 = 8.0_f64.sqrt() * 0.1;
    let got = written(Material {
        diffuse_srgb: [0.5, 1.0, 0.0],
        specular_srgb: [0.1; 3],
        shininess: 0.0,
        ..material()
    });
    let base = numbers(&got["pbrMetallicRoughness"]["baseColorFactor"]);
    assert!(
        (base[0] - 0.214_041_14 / (1.0 - f0)).abs() < 1e-6,
        "{base:?}"
    );
    assert_eq!(base[1..], [1.0, 0.0, 1.0]);
    assert_eq!(
        got["extensions"]["KHR_materials_specular"]["specularColorFactor"],
        Value::Null
    );
}

#[test]
fn base_color_is_unlit_and_shows_the_diffuse_colour_only() {
    let got = written(Material {
        light_model: LightModel::BaseColor,
        emissive_srgb: [1.0; 3],
        specular_srgb: [1.0; 3],
        diffuse_srgb: [1.0, 0.0, 0.5],
        ..material()
    });
    assert_eq!(got["extensions"], json!({"KHR_materials_unlit": {}}));
    assert_eq!(got["emissiveFactor"], Value::Null);
    let base = numbers(&got["pbrMetallicRoughness"]["baseColorFactor"]);
    assert!((base[2] - 0.214_041).abs() < 1e-6);
    assert_eq!(base[..2], [1.0, 0.0]);
}

#[test]
fn emission_is_linear() {
    let got = written(Material {
        emissive_srgb: [1.0, 0.5, 0.0],
        ..material()
    });
    let emissive = numbers(&got["emissiveFactor"]);
    assert!((emissive[1] - 0.214_041).abs() < 1e-6);
    assert_eq!((emissive[0], emissive[2]), (1.0, 0.0));
}

#[test]
fn transparency_blends_and_vertex_colours_stand_in_place_of_the_materials() {
    let glass = Material {
        transparency: 0.25,
        ..material()
    };
    let colors = |alpha: f32| Mesh {
        colors_srgb: vec![[1.0, 0.0, 0.0, alpha]; 3],
        ..triangle()
    };
    for (mesh, material, mode, factor) in [
        (triangle(), material(), Value::Null, Some(1.0)),
        (triangle(), glass.clone(), json!("BLEND"), Some(0.75)),
        (colors(1.0), glass, Value::Null, None),
        (colors(0.5), material(), json!("BLEND"), None),
        // Rounds to 65535 of 65535.
        (colors(0.999_999), material(), Value::Null, None),
    ] {
        let converted = convert(&Build::one(mesh, material).scene);
        let got = &converted.json["materials"][0];
        assert_eq!(got["alphaMode"], mode);
        assert_eq!(
            got["pbrMetallicRoughness"]["baseColorFactor"][3].as_f64(),
            factor
        );
    }
}

#[test]
fn faces_say_which_sides_are_drawn() {
    for (faces, double_sided, extras) in [
        (Faces::BothOneSidedLighting, json!(true), Value::Null),
        (
            Faces::BothTwoSidedLighting,
            json!(true),
            json!({"iv": {"vertexOrdering": "COUNTERCLOCKWISE"}}),
        ),
        (
            Faces::FrontOnly,
            Value::Null,
            json!({"iv": {"vertexOrdering": "COUNTERCLOCKWISE", "shapeType": "SOLID"}}),
        ),
    ] {
        let got = written(Material {
            faces,
            ..material()
        });
        assert_eq!(got["doubleSided"], double_sided);
        assert_eq!(got["extras"], extras);
    }
}

#[test]
fn extras_hold_inventors_own_values() {
    let material = Material {
        name: Some("Brass".into()),
        ambient_srgb: [0.1, 0.2, 0.3],
        diffuse_srgb: [f64::from(0.7_f32), 0.5, 0.1],
        specular_srgb: [1.0; 3],
        emissive_srgb: [0.0, 0.0, 0.01],
        shininess: 0.6,
        transparency: 0.5,
        light_model: LightModel::BaseColor,
        faces: Faces::BothOneSidedLighting,
        line_width_px: 2.0,
        point_size_px: 3.5,
        line_pattern: 0xf0f0,
        ..material()
    };
    let got = written(material);
    assert_eq!(got["name"], "Brass");
    assert_eq!(
        got["extras"]["iv"],
        json!({
            "ambientColor": [0.1, 0.2, 0.3],
            "diffuseColor": [0.7, 0.5, 0.1],
            "specularColor": [1, 1, 1],
            "emissiveColor": [0, 0, 0.01],
            "shininess": 0.6,
            "transparency": 0.5,
            "lightModel": "BASE_COLOR",
            "lineWidth": 2,
            "pointSize": 3.5,
            "linePattern": 0xf0f0,
        })
    );
}

#[test]
fn materials_come_in_the_order_of_their_first_use() {
    let mut build = Build::new();
    for name in ["b", "a", "b"] {
        let material = Material {
            name: Some(name.into()),
            ..material()
        };
        build.instance(None, None, DAffine3::IDENTITY, triangle(), material);
    }
    let converted = convert(&build.scene);
    let names: Vec<_> = converted
        .gltf()
        .materials()
        .map(|m| m.name().map(str::to_owned))
        .collect();
    assert_eq!(names, [Some("b".to_owned()), Some("a".to_owned())]);
}
