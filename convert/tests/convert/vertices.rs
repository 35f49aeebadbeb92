//! Numbers in fewer bits, shared vertices, and their order: measured on the output, against the
//! scene, in f64.

use convert::{Options, Quantize, Weld};
use glam::{DAffine3, DVec3};
use scenegraph::scene::{Faces, Material, Mesh, Scene, TextureId};

use crate::decode::{Corner, check_bounds, corners, elements};
use crate::read::{Converted, convert_with};
use crate::scenes::{Build, Images, file_texture, material, png, scale, shift, triangle, turn};

/// A wavy sheet of `size` by `size` vertices with all attributes.
pub fn sheet(size: u32, extent: f64, origin: DVec3) -> Mesh {
    let share = |i: u32| f64::from(i) / f64::from(size - 1);
    let grid = || (0..size).flat_map(|i| (0..size).map(move |j| (share(i), share(j))));
    let height = |u: f64, v: f64| 0.1 * (9.0 * u).sin() * (7.0 * v).cos();
    let positions = grid().map(|(u, v)| {
        let p = DVec3::new(u - 0.5, v - 0.5, height(u, v)) * extent;
        p.as_vec3().to_array()
    });
    let normals = grid().map(|(u, v)| {
        let slope = |a: f64, b: f64| (height(a, b) - height(u, v)) / 1e-6;
        let n = DVec3::new(-slope(u + 1e-6, v), -slope(u, v + 1e-6), 1.0).normalize();
        n.as_vec3().to_array()
    });
    let quads = (0..size - 1).flat_map(|i| (0..size - 1).map(move |j| i * size + j));
    Mesh {
        origin,
        positions: positions.collect(),
        normals: normals.collect(),
        texcoords: grid().map(|(u, v)| [u as f32, v as f32]).collect(),
        colors_srgb: grid().map(|(u, _)| [u as f32, 0.2, 1.0, 0.75]).collect(),
        indices: quads
            .flat_map(|a| [a, a + 1, a + size, a + size, a + 1, a + size + 1])
            .collect(),
        ..triangle()
    }
}

fn textured() -> Material {
    Material {
        texture: Some(TextureId(0)),
        faces: Faces::FrontOnly,
        ..material()
    }
}

fn placed(mesh: Mesh, at: DAffine3) -> Build {
    let mut build = Build::new();
    build.scene.textures.push(file_texture("a.png"));
    build.instance(None, None, at, mesh, textured());
    build
}

fn converted(scene: &Scene, options: &Options) -> Converted {
    let images = Images::with(&[("a.png", png(&[[1, 2, 3, 255]; 4]))]);
    let converted = convert_with(scene, options, &images);
    check_bounds(&converted);
    converted
}

fn quantized(tolerance: f64) -> Options {
    Options {
        quantize: Some(Quantize::within(tolerance)),
        ..Options::default()
    }
}

fn source(scene: &Scene) -> Vec<Vec<DVec3>> {
    let of = |instance: &scenegraph::scene::Instance| {
        let mesh = &scene.meshes[instance.mesh.index()];
        let at = &instance.placement.world_from_local;
        mesh.indices
            .iter()
            .map(|&i| at.transform_point3(mesh.p_in_local(i)))
            .collect()
    };
    scene.instances.iter().map(of).collect()
}

/// Component types of all positions.
fn position_types(converted: &Converted) -> Vec<u64> {
    let accessors = converted.json["accessors"].as_array().unwrap();
    let of_positions = accessors.iter().filter(|a| a.get("min").is_some());
    of_positions
        .map(|a| a["componentType"].as_u64().unwrap())
        .collect()
}

const BYTES: u64 = 5121;
const SHORTS: u64 = 5123;
const FLOATS: u64 = 5126;

#[test]
fn no_point_moves_by_more_than_the_tolerance() {
    let far = DVec3::new(2_600_000.0, 1_200_000.0, 450.0);
    let rows = [
        (10.0, DVec3::ZERO, DAffine3::IDENTITY, 1e-3, SHORTS),
        (10.0, DVec3::ZERO, DAffine3::IDENTITY, 0.05, BYTES),
        (10.0, DVec3::ZERO, DAffine3::IDENTITY, 1e-4, FLOATS),
        (10.0, DVec3::ZERO, DAffine3::IDENTITY, 1e-9, FLOATS),
        (10.0, far, DAffine3::IDENTITY, 1e-3, SHORTS),
        (
            10.0,
            DVec3::ZERO,
            DAffine3::from_translation(far),
            1e-3,
            SHORTS,
        ),
        (
            10.0,
            DVec3::ONE,
            turn(DVec3::new(1.0, 2.0, 3.0), 0.7),
            1e-3,
            SHORTS,
        ),
        (10.0, DVec3::ONE, scale(30.0, 1.0, 0.2), 0.03, SHORTS),
        (10.0, DVec3::ONE, scale(-1e-3, 1e-3, 1e-3), 1e-6, SHORTS),
        (
            10.0,
            far,
            turn(DVec3::Y, 1.0) * scale(3.0, 1.0, 2.0),
            0.01,
            SHORTS,
        ),
        (1e-6, DVec3::ZERO, DAffine3::IDENTITY, 1e-10, SHORTS),
        (1e8, DVec3::ZERO, DAffine3::IDENTITY, 1e4, SHORTS),
    ];
    for (extent, origin, at, tolerance, form) in rows {
        let build = placed(sheet(30, extent, origin), at);
        let got = converted(&build.scene, &quantized(tolerance));
        assert_eq!(position_types(&got), [form], "{extent} {tolerance}");
        let (want, got) = (source(&build.scene), corners(&got));
        assert_eq!(want[0].len(), got[0].len());
        let errors = want[0]
            .iter()
            .zip(&got[0])
            .map(|(p, c)| p.distance(c.p_in_world));
        let worst = errors.fold(0.0, f64::max);
        // Coordinates of millions of metres have f64 steps of their own.
        let rounding = 4.0 * f64::EPSILON * far.length();
        assert!(
            worst <= tolerance + rounding,
            "{extent} {origin} {tolerance}: {worst}"
        );
        // The tolerance is used, and not a hundredth of it.
        assert!(
            form == FLOATS || worst > tolerance * 0.3,
            "{extent} {tolerance}: {worst}"
        );
    }
}

#[test]
fn meshes_that_touch_still_do() {
    // The right edge of the first is the left one of the second, whose origin and place differ.
    let left = sheet(30, 10.0, DVec3::new(0.0, 0.0, 0.1));
    let mut right = sheet(30, 10.0, DVec3::new(6.123, 0.0, 0.0));
    let step = 29 * 30;
    for j in 0..30 {
        let edge = left.p_in_local(step + j) - DVec3::new(3.877, 0.0, -77.7);
        right.positions[j as usize] = (edge - right.origin).as_vec3().to_array();
    }
    let mut build = placed(left, DAffine3::IDENTITY);
    build.instance(None, None, shift(3.877, 0.0, -77.7), right, textured());
    for tolerance in [0.001, 0.003, 0.02] {
        let got = converted(&build.scene, &quantized(tolerance));
        let (want, got) = (source(&build.scene), corners(&got));
        let mut touching = 0;
        for (p, a) in want[0].iter().zip(&got[0]) {
            for (q, b) in want[1].iter().zip(&got[1]) {
                if p.distance(*q) < 1e-6 {
                    touching += 1;
                    let gap = a.p_in_world.distance(b.p_in_world);
                    // The sum of place and grid line is rounded once.
                    assert!(gap < 1e-13, "{tolerance}: {p} {gap}");
                }
            }
        }
        assert!(touching > 30, "{touching}");
    }
}

#[test]
fn other_attributes_keep_their_bounds() {
    let build = placed(sheet(30, 10.0, DVec3::ZERO), DAffine3::IDENTITY);
    let exact = corners(&converted(&build.scene, &Options::default()));
    for (degrees, bits) in [(0.5, 5120), (0.1, 5122), (0.0, 5126)] {
        let options = Options {
            quantize: Some(Quantize {
                normal_tolerance_rad: f64::to_radians(degrees),
                ..Quantize::within(1e-3)
            }),
            ..Options::default()
        };
        let got = converted(&build.scene, &options);
        let normals = got.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"]
            .as_u64()
            .unwrap();
        assert_eq!(
            got.json["accessors"][normals as usize]["componentType"],
            bits
        );
        let got = corners(&got);
        let mut widest = 0.0_f64;
        for (want, got) in exact[0].iter().zip(&got[0]) {
            let unit = |n: &[f64]| DVec3::from_slice(n).normalize();
            let (a, b) = (unit(&want.normal), unit(&got.normal));
            widest = widest.max(2.0 * (a.distance(b) * 0.5).asin().to_degrees());
            for (a, b) in want.texcoord.iter().zip(&got.texcoord) {
                assert!((a - b).abs() <= 0.5 / 65535.0 + 1e-9);
            }
            assert_eq!(want.color_linear.len(), got.color_linear.len());
            for (a, b) in want.color_linear.iter().zip(&got.color_linear) {
                assert!((a - b).abs() <= 0.5 / 255.0 + 0.5 / 65535.0);
            }
        }
        // Normals of f32 are of unit length within 1e-7.
        assert!(widest <= degrees + 1e-5, "{widest} > {degrees}");
    }
}

#[test]
fn texture_coordinates_beyond_the_image_stay_floats() {
    let mut mesh = sheet(30, 10.0, DVec3::ZERO);
    mesh.texcoords[7] = [-0.25, 3.0];
    let build = placed(mesh, DAffine3::IDENTITY);
    let want = corners(&converted(&build.scene, &Options::default()));
    let got = corners(&converted(&build.scene, &quantized(1e-3)));
    let texcoords = |corners: &[Vec<Corner>]| -> Vec<Vec<f64>> {
        corners[0].iter().map(|c| c.texcoord.clone()).collect()
    };
    assert_eq!(texcoords(&want), texcoords(&got));
}

/// With nothing but positions to tell vertices apart.
pub fn plain(mesh: Mesh) -> Mesh {
    Mesh {
        normals: vec![[0.0, 0.0, 1.0]; mesh.positions.len()],
        texcoords: Vec::new(),
        colors_srgb: Vec::new(),
        ..mesh
    }
}

#[test]
fn what_falls_together_is_welded() {
    // As fine as the f32 of the source, and a coarse grid.
    for (tolerance, fewest, most) in [(1e-3, 3600, 3600), (1.0, 50, 2000)] {
        let build = placed(plain(sheet(60, 10.0, DVec3::ZERO)), DAffine3::IDENTITY);
        let got = converted(&build.scene, &quantized(tolerance));
        let count = elements(&got.json, &got.bin, 0).len();
        assert!((fewest..=most).contains(&count), "{tolerance}: {count}");
    }
    // A part smaller than the grid keeps its place.
    let dot = plain(sheet(30, 1e-3, DVec3::new(5.0, 0.0, 0.0)));
    let dot = placed(dot, DAffine3::IDENTITY);
    let got = converted(&dot.scene, &quantized(1.0));
    let corners = corners(&got);
    assert_eq!(corners[0].len(), 3);
    assert!(
        corners[0]
            .iter()
            .all(|c| c.p_in_world.distance(DVec3::new(5.0, 0.0, 0.0)) <= 1.0)
    );
}

#[test]
fn small_parts_used_often_stay_floats() {
    let mut build = Build::new();
    for i in 0..50 {
        build.shape(None, None, shift(f64::from(i), 0.0, 0.0));
    }
    let got = converted(&build.scene, &quantized(1e-3));
    assert_eq!(position_types(&got), [FLOATS]);
    assert!(got.nodes().iter().all(|node| node.get("scale").is_none()));
}

/// Corners by threes, each triangle from its least corner on, sorted.
fn triangles(corners: &[Corner]) -> Vec<String> {
    let mut triangles: Vec<String> = corners
        .chunks(3)
        .map(|t| {
            let words: Vec<String> = t.iter().map(|c| format!("{c:?}")).collect();
            let turns = (0..3).map(|k| {
                [&words[k], &words[(k + 1) % 3], &words[(k + 2) % 3]]
                    .map(String::as_str)
                    .concat()
            });
            turns.min().unwrap()
        })
        .collect();
    triangles.sort();
    triangles
}

/// Vertices transformed for each triangle, with a cache of the last 16.
fn misses_per_triangle(indices: &[usize]) -> f64 {
    let mut cache = Vec::new();
    let mut misses = 0;
    for &index in indices {
        if !cache.contains(&index) {
            misses += 1;
            cache.insert(0, index);
            cache.truncate(16);
        }
    }
    f64::from(misses) * 3.0 / indices.len() as f64
}

#[test]
fn optimizing_changes_the_order_alone() {
    let mut mesh = sheet(60, 10.0, DVec3::ZERO);
    // Triangles in an order that no cache likes.
    let (chunks, _) = mesh.indices.as_chunks::<3>();
    let count = chunks.len();
    mesh.indices = (0..count).flat_map(|i| chunks[i * 1009 % count]).collect();
    let build = placed(mesh, DAffine3::IDENTITY);
    for quantize in [None, Some(Quantize::within(1e-3))] {
        let options = |optimize| Options {
            quantize,
            optimize,
            ..Options::default()
        };
        let plain = converted(&build.scene, &options(false));
        let ordered = converted(&build.scene, &options(true));
        assert_eq!(
            triangles(&corners(&plain)[0]),
            triangles(&corners(&ordered)[0])
        );
        let indices = |c: &Converted| -> Vec<usize> {
            let index = c.json["meshes"][0]["primitives"][0]["indices"]
                .as_u64()
                .unwrap();
            let indices = elements(&c.json, &c.bin, index as usize);
            indices.iter().map(|i| i[0] as usize).collect()
        };
        let (before, after) = (indices(&plain), indices(&ordered));
        assert!(misses_per_triangle(&before) > 2.0);
        assert!(
            misses_per_triangle(&after) < 0.8,
            "{}",
            misses_per_triangle(&after)
        );
        // Vertices stand in the order of their first use.
        let mut next = 0;
        for index in after {
            assert!(index <= next);
            next = next.max(index + 1);
        }
    }
}

#[test]
fn vertices_apart_are_one_for_each_corner() {
    let build = placed(sheet(20, 10.0, DVec3::ZERO), DAffine3::IDENTITY);
    let shared = corners(&converted(&build.scene, &Options::default()));
    let options = Options {
        weld: Weld::Apart,
        ..Options::default()
    };
    let apart = converted(&build.scene, &options);
    assert_eq!(
        apart.at("/meshes/0/primitives/0/indices"),
        &serde_json::Value::Null
    );
    assert_eq!(corners(&apart), shared);
}

#[test]
fn the_number_of_threads_does_not_show() {
    let mut build = placed(sheet(20, 10.0, DVec3::ZERO), DAffine3::IDENTITY);
    for i in 0..100 {
        let mesh = sheet(3 + i % 17, 1.0 + f64::from(i), DVec3::ZERO);
        build.instance(None, None, shift(f64::from(i), 0.0, 0.0), mesh, textured());
    }
    let bytes = |threads| {
        let options = Options {
            optimize: true,
            threads,
            ..quantized(1e-3)
        };
        converted(&build.scene, &options).bytes
    };
    let want = bytes(1);
    assert!([2, 3, 8].into_iter().all(|threads| bytes(threads) == want));
}

#[test]
fn a_scene_with_an_index_too_large_is_refused() {
    let mut build = Build::one(triangle(), material());
    build.scene.meshes[0].indices[1] = 3;
    let options = Options {
        optimize: true,
        ..Options::default()
    };
    let written = convert::write_glb(&build.scene, &options, &Images::default(), &mut Vec::new());
    assert!(
        matches!(written, Err(convert::Error::Scene(_))),
        "{written:?}"
    );
}
