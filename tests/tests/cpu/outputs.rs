//! What the options of a conversion make of the samples and of the corpus: valid files, in which a
//! decoder of others finds every corner where it was.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use convert::{Options, Quantize, TextureFormat, Up, write_file};
use glam::DVec3;
use scenegraph::scene::Scene;

use super::models::{Model, corpus, samples};
use super::validator::{is_clean, validate};

/// Every how many-th file of the corpus is taken.
const CORPUS_STEP: usize = 40;

fn rows() -> Vec<(&'static str, Options)> {
    let with = |change: fn(&mut Options)| {
        let mut options = Options::default();
        change(&mut options);
        options
    };
    vec![
        ("optimize", with(|o| o.optimize = true)),
        (
            "quantize",
            with(|o| o.quantize = Some(Quantize::within(1e-3))),
        ),
        ("compress", with(|o| o.compress = true)),
        ("instancing", with(|o| o.instancing = true)),
        ("webp", with(|o| o.textures = TextureFormat::Webp)),
        (
            "all",
            with(|o| {
                o.quantize = Some(Quantize::within(5e-3));
                o.compress = true;
                o.instancing = true;
                o.textures = TextureFormat::Webp;
                o.up = Up::Z;
                o.threads = 2;
            }),
        ),
    ]
}

/// The places of all corners, as the scene has them.
fn corners(scene: &Scene, up: Up) -> Vec<DVec3> {
    let turned = |p: DVec3| match up {
        Up::Y => p,
        Up::Z => DVec3::new(p.x, p.z, -p.y),
    };
    let of_instance = |instance: &scenegraph::scene::Instance| -> Vec<DVec3> {
        let mesh = &scene.meshes[instance.mesh.index()];
        let at = &instance.placement.world_from_local;
        let places = mesh
            .indices
            .iter()
            .map(|&i| at.transform_point3(mesh.p_in_local(i)));
        places.map(turned).collect()
    };
    scene.instances.iter().flat_map(of_instance).collect()
}

/// The farthest that a place is from the nearest of `others`, if that is below `reach`.
fn distance(places: &[DVec3], others: &[DVec3], reach: f64) -> f64 {
    let cell = |p: DVec3| (p / reach).floor().as_i64vec3();
    let mut cells: HashMap<glam::I64Vec3, Vec<DVec3>> = HashMap::new();
    for &other in others {
        let members = cells.entry(cell(other)).or_default();
        if members.last() != Some(&other) {
            members.push(other);
        }
    }
    let around = |k: i64| (-1..=1).map(move |d| k + d);
    let nearest = |p: &DVec3| {
        let at = cell(*p);
        let near = around(at.x).flat_map(|x| around(at.y).map(move |y| (x, y)));
        let near = near.flat_map(|(x, y)| around(at.z).map(move |z| glam::I64Vec3::new(x, y, z)));
        let members = near.filter_map(|cell| cells.get(&cell)).flatten();
        members
            .map(|q| q.distance(*p))
            .fold(f64::INFINITY, f64::min)
    };
    places.iter().map(nearest).fold(0.0, f64::max)
}

/// Decodes files; those that cannot be decoded have an error in words.
fn decode(files: &[PathBuf], folder: &Path) -> Vec<Result<Vec<DVec3>, String>> {
    let list = folder.join("decode.txt");
    let names: String = files
        .iter()
        .map(|file| format!("{}\n", file.display()))
        .collect();
    fs::write(&list, names).expect("a list of names");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tools/corners.mjs");
    let run = Command::new("node")
        .arg(script)
        .arg("--list")
        .arg(&list)
        .output();
    let run = run.expect("node is needed");
    assert!(
        run.status.success(),
        "glTF-Transform does not run; install it with: npm ci --prefix tests/tools\n{}",
        String::from_utf8_lossy(&run.stderr)
    );
    let words = String::from_utf8(run.stdout).expect("text");
    let words: Vec<&str> = words.lines().collect();
    assert_eq!(words.len(), files.len());
    let read = |(file, words): (&PathBuf, &&str)| {
        if !words.is_empty() {
            return Err((**words).to_owned());
        }
        let bytes = fs::read(format!("{}.corners", file.display())).expect("corners");
        let (numbers, _) = bytes.as_chunks::<8>();
        let numbers: Vec<f64> = numbers.iter().map(|b| f64::from_le_bytes(*b)).collect();
        Ok(numbers.chunks_exact(3).map(DVec3::from_slice).collect())
    };
    files.iter().zip(&words).map(read).collect()
}

/// What is wrong with one output.
fn fault(scene: &Scene, options: &Options, decoded: &Result<Vec<DVec3>, String>) -> Option<String> {
    let got = match decoded {
        Ok(got) => got,
        Err(words) => return Some(words.clone()),
    };
    let want = corners(scene, options.up);
    let largest = want
        .iter()
        .map(|p| p.abs().max_element())
        .fold(0.0, f64::max);
    // glTF-Transform holds matrices in f64; copies are f32 about the middle of all.
    let rounding = largest * if options.instancing { 1e-6 } else { 1e-12 } + 1e-12;
    let bound = options
        .quantize
        .map_or(rounding, |q| q.tolerance + 1e-12 * largest);
    // Triangles that fall together are dropped, so only without tolerance are there as many.
    if options.quantize.is_none() && want.len() != got.len() {
        return Some(format!("{} corners are {}", want.len(), got.len()));
    }
    let reach = 2.0 * bound;
    let worst = distance(got, &want, reach).max(distance(&want, got, reach));
    (worst > bound).then(|| format!("a corner is off by {worst}, beyond {bound}"))
}

#[test]
fn outputs_of_all_options_are_valid_and_hold_every_corner() {
    let folder = tempfile::tempdir().expect("a folder for outputs");
    let mut models = samples();
    models.extend(corpus().into_iter().step_by(CORPUS_STEP));
    let rows = rows();
    let scenes: Vec<(Model, Scene)> = models.into_iter().map(|m| (m.clone(), m.scene())).collect();
    let jobs: Vec<_> = scenes
        .iter()
        .flat_map(|pair| rows.iter().map(move |row| (pair, row)))
        .collect();
    let files: Vec<PathBuf> = jobs
        .iter()
        .enumerate()
        .map(|(number, ((model, scene), (name, options)))| {
            let path = folder.path().join(format!("{number}.glb"));
            let written = write_file(scene, options, &model.images(), &path);
            assert!(written.is_ok(), "{} {name}: {written:?}", model.name);
            path
        })
        .collect();
    let judged = validate(&files, folder.path());
    let decoded = decode(&files, folder.path());
    let mut faults = Vec::new();
    for (((pair, row), line), decoded) in jobs.iter().zip(&judged).zip(&decoded) {
        let ((model, scene), (name, options)) = (pair, row);
        if !is_clean(line) {
            faults.push(format!("{} {name}: {line}", model.name));
        }
        if let Some(words) = fault(scene, options, decoded) {
            faults.push(format!("{} {name}: {words}", model.name));
        }
    }
    assert!(
        faults.is_empty(),
        "{} faults:\n{}",
        faults.len(),
        faults.join("\n")
    );
}
