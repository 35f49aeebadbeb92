//! The table of docs/OPTIONS.md: how large outputs are, and how far off, measured on three models.

use std::fmt::Write;
use std::path::Path;

use convert::{Options, Quantize, ReadLimits, read_gltf};
use glam::{DAffine3, DVec3};
use scenegraph::scene::{Mesh, Scene};

use crate::read::convert_with;
use crate::reading::OneFile;
use crate::scenes::{Build, Images, material, shift, turn};
use crate::vertices::{plain, sheet};

const BEGIN: &str = "<!-- measured -->\n";
const END: &str = "<!-- end -->\n";

/// One surface of 10 m, 500 parts of 36 vertices, 500 copies of a part of 400.
fn models() -> [(&'static str, Scene); 3] {
    let curved = |size, extent, at| Mesh {
        normals: sheet(size, extent, at).normals,
        ..plain(sheet(size, extent, at))
    };
    let frame = |i: u32| {
        let i = f64::from(i);
        shift(i * 0.7, i % 7.0, (i * 1.3).sin() * 9.0) * turn(DVec3::new(1.0, i, 2.0), i)
    };
    let surface = Build::one(curved(60, 10.0, DVec3::ZERO), material());
    let (mut parts, mut copies) = (Build::new(), Build::new());
    for i in 0..500 {
        let part = curved(6, 0.1 + f64::from(i) * 0.002, DVec3::ZERO);
        parts.instance(None, Some(&format!("Part {i}")), frame(i), part, material());
        copies.instance(
            None,
            Some("Screw"),
            frame(i),
            curved(20, 0.5, DVec3::ZERO),
            material(),
        );
    }
    [
        ("surface", surface.scene),
        ("parts", parts.scene),
        ("copies", copies.scene),
    ]
}

fn rows() -> Vec<(&'static str, Options)> {
    let quantized = |tolerance: f64| Options {
        optimize: true,
        quantize: Some(Quantize::within(tolerance)),
        ..Options::default()
    };
    let compressed = |options: Options| Options {
        compress: true,
        ..options
    };
    let all = Options {
        instancing: true,
        ..compressed(quantized(1e-4))
    };
    vec![
        ("none", Options::default()),
        (
            "`--optimize`",
            Options {
                optimize: true,
                ..Options::default()
            },
        ),
        (
            "`--instancing`",
            Options {
                instancing: true,
                ..Options::default()
            },
        ),
        ("`--compress meshopt`", compressed(Options::default())),
        ("`--quantize --tolerance 0.1mm`", quantized(1e-4)),
        ("`--quantize --tolerance 1mm`", quantized(1e-3)),
        (
            "`--quantize --tolerance 0.1mm --compress meshopt`",
            compressed(quantized(1e-4)),
        ),
        (
            "`--quantize --tolerance 1mm --compress meshopt`",
            compressed(quantized(1e-3)),
        ),
        ("the same at 0.1mm with `--instancing`", all),
    ]
}

/// Places of the vertices of the first instances; all of one model are alike.
fn places(scene: &Scene) -> Vec<DVec3> {
    let of_instance = |instance: &scenegraph::scene::Instance| {
        let mesh = &scene.meshes[instance.mesh.index()];
        let at: DAffine3 = instance.placement.world_from_local;
        let all =
            (0..mesh.positions.len() as u32).map(move |i| at.transform_point3(mesh.p_in_local(i)));
        all.collect::<Vec<_>>()
    };
    scene
        .instances
        .iter()
        .take(9)
        .flat_map(of_instance)
        .collect()
}

fn farthest(want: &[DVec3], got: &[DVec3]) -> f64 {
    let nearest = |p: &DVec3| {
        got.iter()
            .map(|q| q.distance_squared(*p))
            .fold(f64::INFINITY, f64::min)
    };
    want.iter().map(nearest).fold(0.0, f64::max).sqrt()
}

fn table() -> String {
    let models = models();
    let mut out = String::from("| options |");
    for (name, _) in &models {
        let _ = write!(out, " {name} | off by |");
    }
    out.push_str("\n| --- |");
    out.push_str(&" --: | --: |".repeat(models.len()));
    let mut whole = [0.0; 3];
    for (words, options) in rows() {
        let _ = write!(out, "\n| {words} |");
        for (k, (_, scene)) in models.iter().enumerate() {
            let bytes = convert_with(scene, &options, &Images::default()).bytes;
            let loader = OneFile(Vec::new());
            let limits = ReadLimits::default();
            let got = read_gltf(&bytes, "m", Path::new(""), &loader, &limits)
                .unwrap()
                .scene;
            let worst = farthest(&places(scene), &places(&got));
            if let Some(quantize) = options.quantize {
                assert!(worst <= quantize.tolerance, "{words}: {worst}");
            }
            if words == "none" {
                whole[k] = bytes.len() as f64;
            }
            let share = bytes.len() as f64 / whole[k] * 100.0;
            let _ = match worst {
                worst if worst < 1e-12 => write!(out, " {share:.0} % | 0 |"),
                worst if worst < 1e-5 => write!(out, " {share:.0} % | < 0.01 mm |"),
                worst => write!(out, " {share:.0} % | {:.2} mm |", worst * 1e3),
            };
        }
    }
    out.push('\n');
    out
}

/// Whether two texts have the same words, and numbers within 2 % of 100: other systems have other
/// sines, and the lengths of generator and extras change.
fn is_near(a: &str, b: &str) -> bool {
    let same = |(a, b): (&str, &str)| match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) if a.fract() == 0.0 && b.fract() == 0.0 => (a - b).abs() <= 2.0,
        (Ok(a), Ok(b)) => (a - b).abs() <= 0.02,
        _ => a == b,
    };
    let (a, b) = (a.split_whitespace(), b.split_whitespace());
    a.clone().count() == b.clone().count() && a.zip(b).all(same)
}

#[test]
fn the_table_is_up_to_date() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/OPTIONS.md");
    let on_disk = std::fs::read_to_string(path).unwrap();
    let (start, end) = (
        on_disk.find(BEGIN).unwrap() + BEGIN.len(),
        on_disk.find(END).unwrap(),
    );
    let made = [&on_disk[..start], &table(), &on_disk[end..]].concat();
    if std::env::var_os("UPDATE_DOCS").is_some() {
        std::fs::write(path, &made).unwrap();
    } else {
        assert!(
            is_near(&on_disk, &made),
            "run the tests with UPDATE_DOCS=1; measured:\n{made}"
        );
    }
}
