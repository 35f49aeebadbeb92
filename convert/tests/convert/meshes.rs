//! Attributes, indices and accessors.

use glam::DAffine3;
use scenegraph::scene::{Faces, LightModel, Material, Mesh, TextureId, Topology};
use serde_json::json;

use crate::read::{Converted, convert, convert_with};
use crate::scenes::{
    Build, Images, file_texture, lines, material, png, points, textured_triangle, triangle,
};

/// Names of the attributes of each mesh.
fn attributes(converted: &Converted) -> Vec<Vec<String>> {
    let meshes = converted.json["meshes"].as_array().unwrap();
    let names = |mesh: &serde_json::Value| {
        let attributes = mesh["primitives"][0]["attributes"].as_object().unwrap();
        attributes.keys().cloned().collect()
    };
    meshes.iter().map(names).collect()
}

fn colored(colors_srgb: [[f32; 4]; 3]) -> Mesh {
    Mesh {
        colors_srgb: colors_srgb.to_vec(),
        ..textured_triangle()
    }
}

#[test]
fn all_arrays_read_back_as_they_are_in_the_scene() {
    let positions: Vec<[f32; 3]> = (0..70_000)
        .map(|i| [i as f32 * 0.1, -(i as f32), 1.0 / (1.0 + i as f32)])
        .collect();
    let indices = (0..60_000).rev().chain([69_999, 0, 1]).collect();
    let big = Mesh {
        normals: vec![[0.6, 0.0, 0.8]; positions.len()],
        texcoords: positions.iter().map(|&[x, y, _]| [x, y * 0.25]).collect(),
        colors_srgb: Vec::new(),
        indices,
        positions,
        ..triangle()
    };
    let small = colored([[1.0, 0.5, 0.0, 1.0], [0.2, 0.2, 0.2, 0.5], [1.0; 4]]);
    let mut build = Build::textured(file_texture("a.png"), material());
    let textured = build.scene.materials[0].clone();
    for mesh in [big, small] {
        build.instance(None, None, DAffine3::IDENTITY, mesh, textured.clone());
    }
    let images = Images::with(&[("a.png", png(&[[1, 2, 3, 255]]))]);
    let converted = convert_with(&build.scene, &Default::default(), &images);
    let gltf = converted.gltf();
    for (mesh, source) in gltf.meshes().zip(&build.scene.meshes) {
        let primitive = mesh.primitives().next().unwrap();
        let reader = primitive.reader(|_| Some(&converted.bin));
        assert!(
            reader
                .read_positions()
                .unwrap()
                .eq(source.positions.iter().copied())
        );
        assert!(
            reader
                .read_normals()
                .unwrap()
                .eq(source.normals.iter().copied())
        );
        let texcoords = reader.read_tex_coords(0).unwrap().into_f32();
        assert!(texcoords.eq(source.texcoords.iter().map(|&[s, t]| [s, 1.0 - t])));
        match reader.read_indices() {
            Some(indices) => assert!(indices.into_u32().eq(source.indices.iter().copied())),
            None => assert!(
                source
                    .indices
                    .iter()
                    .copied()
                    .eq(0..source.positions.len() as u32)
            ),
        }
        let bounds = primitive.bounding_box();
        for axis in 0..3 {
            let values = || source.positions.iter().map(|p| p[axis]);
            assert_eq!(bounds.min[axis], values().fold(f32::INFINITY, f32::min));
            assert_eq!(bounds.max[axis], values().fold(f32::NEG_INFINITY, f32::max));
        }
    }
}

#[test]
fn vertex_colours_are_linear_with_sixteen_bits_and_straight_alpha() {
    let mesh = colored([
        [1.0, 0.0, 0.5, 1.0],
        [0.2, 0.04, 2.0, 0.25],
        [0.2, 0.04, 2.0, 0.25],
    ]);
    let converted = convert(&Build::one(mesh, material()).scene);
    let gltf = converted.gltf();
    let primitive = gltf.meshes().next().unwrap().primitives().next().unwrap();
    let reader = primitive.reader(|_| Some(&converted.bin));
    let colors: Vec<_> = reader.read_colors(0).unwrap().into_rgba_u16().collect();
    // 65535 times ((0.5 + 0.055) / 1.055)^2.4 = 0.214041, 0.2 -> 0.033105, 0.04 / 12.92.
    let second = [2170, 203, 65535, 16384];
    assert_eq!(colors, [[65535, 0, 14027, 65535], second, second]);
}

#[test]
fn only_what_a_material_reads_is_written() {
    let unlit = Material {
        light_model: LightModel::BaseColor,
        ..material()
    };
    let textured = Material {
        texture: Some(TextureId(0)),
        ..material()
    };
    let white = colored([[1.0; 4]; 3]);
    let rows = [
        (textured_triangle(), material(), &["NORMAL", "POSITION"][..]),
        (textured_triangle(), unlit.clone(), &["POSITION"]),
        (
            textured_triangle(),
            textured.clone(),
            &["NORMAL", "POSITION", "TEXCOORD_0"],
        ),
        (triangle(), textured.clone(), &["NORMAL", "POSITION"]),
        (white.clone(), unlit, &["COLOR_0", "POSITION"]),
        (
            white,
            textured,
            &["COLOR_0", "NORMAL", "POSITION", "TEXCOORD_0"],
        ),
    ];
    let images = Images::with(&[("a.png", png(&[[9; 4]]))]);
    for (mesh, material, want) in rows {
        let mut build = Build::one(mesh, material.clone());
        if material.texture.is_some() {
            build.scene.textures.push(file_texture("a.png"));
        }
        let converted = convert_with(&build.scene, &Default::default(), &images);
        assert_eq!(attributes(&converted), [want]);
        // Nothing is stored that no attribute points to.
        let used =
            want.len() + usize::from(converted.at("/meshes/0/primitives/0/indices").is_u64());
        assert_eq!(converted.json["accessors"].as_array().unwrap().len(), used);
    }
}

#[test]
fn one_mesh_in_two_materials_shares_its_accessors() {
    let red = Material {
        diffuse_srgb: [1.0, 0.0, 0.0],
        ..material()
    };
    let mut build = Build::one(triangle(), material());
    build.instance(None, None, DAffine3::IDENTITY, triangle(), red);
    build.shape(None, None, DAffine3::IDENTITY);
    let converted = convert(&build.scene);
    let nodes = [json!({"mesh": 0}), json!({"mesh": 1}), json!({"mesh": 0})];
    assert_eq!(converted.json["nodes"], json!(nodes));
    let primitive = |mesh: usize| converted.at(&format!("/meshes/{mesh}/primitives/0/attributes"));
    assert_eq!(primitive(0), primitive(1));
    assert_eq!(converted.at("/meshes/1/primitives/0/material"), 1);
    assert_eq!(converted.json["accessors"].as_array().unwrap().len(), 2);
    assert_eq!(converted.report.counts.triangles, 1);
    assert_eq!(converted.report.counts.triangles_drawn, 3);
}

#[test]
fn a_mesh_holds_what_any_of_its_materials_reads() {
    let unlit = Material {
        light_model: LightModel::BaseColor,
        ..material()
    };
    for pair in [[material(), unlit.clone()], [unlit, material()]] {
        let mut build = Build::new();
        for material in &pair {
            build.instance(None, None, DAffine3::IDENTITY, triangle(), material.clone());
        }
        let want = pair.map(|material| match material.light_model {
            LightModel::Phong => vec!["NORMAL", "POSITION"],
            LightModel::BaseColor => vec!["POSITION"],
        });
        assert_eq!(attributes(&convert(&build.scene)), want);
    }
}

#[test]
fn indices_are_as_narrow_as_restart_allows_and_left_out_when_they_count_up() {
    let with = |vertices: usize, indices: Vec<u32>| Mesh {
        positions: (0..vertices).map(|i| [i as f32, 0.0, 0.0]).collect(),
        normals: Vec::new(),
        indices,
        ..triangle()
    };
    const U16: u64 = 5123;
    const U32: u64 = 5125;
    for (mesh, want) in [
        (with(3, vec![0, 1, 2]), None),
        (with(3, vec![0, 2, 1]), Some(U16)),
        (with(4, vec![0, 1, 2]), Some(U16)),
        (with(65_535, vec![0, 1, 65_534]), Some(U16)),
        (with(65_536, vec![0, 1, 65_535]), Some(U32)),
    ] {
        let converted = convert(&Build::one(mesh, material()).scene);
        let got = converted
            .at("/meshes/0/primitives/0/indices")
            .as_u64()
            .map(|accessor| {
                converted
                    .at(&format!("/accessors/{accessor}/componentType"))
                    .as_u64()
                    .unwrap()
            });
        assert_eq!(got, want);
    }
}

#[test]
fn topologies_have_their_modes_and_lines_without_normals_are_unlit() {
    let lit_lines = Mesh {
        normals: vec![[0.0, 0.0, 1.0]; 3],
        ..lines()
    };
    for (mesh, mode, unlit) in [
        (triangle(), None, false),
        (
            Mesh {
                normals: Vec::new(),
                ..triangle()
            },
            None,
            false,
        ),
        (lines(), Some(1), true),
        (lit_lines, Some(1), false),
        (points(), Some(0), true),
    ] {
        let triangles = u64::from(mesh.topology == Topology::Triangles);
        let converted = convert(&Build::one(mesh, material()).scene);
        assert_eq!(converted.at("/meshes/0/primitives/0/mode").as_u64(), mode);
        let extensions = &converted.json["materials"][0]["extensions"];
        assert_eq!(extensions["KHR_materials_unlit"].is_object(), unlit);
        assert_eq!(converted.report.counts.triangles, triangles);
    }
}

#[test]
fn a_material_on_lit_and_unlit_shapes_becomes_two() {
    let mut build = Build::one(triangle(), material());
    for mesh in [lines(), points()] {
        build.instance(None, None, DAffine3::IDENTITY, mesh, material());
    }
    let converted = convert(&build.scene);
    assert_eq!(converted.json["materials"].as_array().unwrap().len(), 2);
    let sides = Material {
        faces: Faces::FrontOnly,
        ..material()
    };
    let converted = convert(&Build::one(triangle(), sides).scene);
    assert!(converted.at("/materials/0/doubleSided").is_null());
}
