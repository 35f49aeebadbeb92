//! What is written as glTF and read again is the scene that was written.

mod compare;

use std::panic::catch_unwind;
use std::time::{Duration, Instant};

use convert::{Options, write_glb};
use scenegraph::scene::{Scene, TextureId, TextureSource};
use tests::fuzz_body;
use tests::mutate::{Rng, mutate};

use super::models::{Model, samples};
use compare::{Values, differences};

/// The file, and what is left of the scene in it: textures whose images are missing are not.
fn glb(scene: &Scene, extras: bool, model: &Model) -> (Vec<u8>, Scene) {
    let options = Options {
        extras,
        ..Options::default()
    };
    let mut bytes = Vec::new();
    let written = write_glb(scene, &options, &model.images(), &mut bytes);
    let report = match written {
        Ok(report) => report,
        Err(error) => panic!("{}: {error}", model.name),
    };
    let mut left = scene.clone();
    let missing = |source: &TextureSource| match source {
        TextureSource::File { name, .. } => report.warnings.iter().any(|w| w.name == **name),
        _ => false,
    };
    for material in &mut left.materials {
        let texture = |id: &TextureId| &scene.textures[id.index()].source;
        material.texture = material.texture.filter(|id| !missing(texture(id)));
    }
    (bytes, left)
}

fn read(bytes: &[u8], model: &Model) -> Scene {
    match fuzz_body::read_gltf(bytes) {
        Ok(read) => {
            assert_eq!(read.warnings, [""; 0], "{}", model.name);
            read.scene
        }
        Err(error) => panic!("{}: {error}", model.name),
    }
}

/// The differences of all samples, by a check of one.
fn check(of: impl Fn(&Model) -> Vec<String>) {
    let mut faults = Vec::new();
    for model in samples() {
        let found = of(&model);
        faults.extend(found.iter().take(3).map(|d| format!("{}: {d}", model.name)));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn with_extras_all_of_inventors_values_come_back() {
    check(|model| {
        let (bytes, scene) = glb(&model.scene(), true, model);
        let back = read(&bytes, model);
        differences(&scene, &back, Values::Inventors)
    });
}

#[test]
fn without_extras_shapes_and_looks_come_back() {
    check(|model| {
        let (bytes, scene) = glb(&model.scene(), false, model);
        let back = read(&bytes, model);
        let mut found = differences(&scene, &back, Values::Looks);
        // What was read is all that glTF holds: a second round loses nothing.
        let again = read(&glb(&back, false, model).0, model);
        found.extend(differences(&back, &again, Values::Again));
        found
    });
}

/// Mutations of the text in a container whose lengths are right, and of the container.
#[test]
fn mutated_files_end() {
    const SLOW: Duration = Duration::from_secs(2);
    const ROUNDS: usize = 1500;
    let mut files: Vec<Vec<u8>> = Vec::new();
    for model in samples() {
        let bytes = glb(&model.scene(), true, &model).0;
        if bytes.len() < 40_000 {
            files.push(bytes);
        }
    }
    assert!(files.len() > 10);
    let texts: Vec<Vec<u8>> = files.iter().map(|bytes| spaced(parts(bytes).0)).collect();
    let mut rng = Rng::new(1);
    let mut readable = 0;
    for _ in 0..ROUNDS {
        let i = rng.below(files.len());
        let input = if rng.below(4) == 0 {
            mutate(&mut rng, &files[i], &files)
        } else {
            joined(&mutate(&mut rng, &texts[i], &texts), parts(&files[i]).1)
        };
        let start = Instant::now();
        let result = catch_unwind(|| fuzz_body::read_gltf(&input).is_ok());
        let took = start.elapsed();
        if result.is_err() || took > SLOW {
            let path = std::env::temp_dir().join("gltf-input.glb");
            std::fs::write(&path, &input).expect("a temporary folder");
            panic!("{} ({took:?})", path.display());
        }
        readable += usize::from(result.unwrap_or(false));
    }
    // Most mutations break the text; some must reach what is behind it.
    assert!(readable > ROUNDS / 50, "{readable}");
}

/// The text and all behind it.
fn parts(glb: &[u8]) -> (&[u8], &[u8]) {
    let length = glb[12..16].try_into().map_or(0, u32::from_le_bytes);
    glb[20..].split_at(length as usize)
}

/// With blanks around what a mutation takes for tokens.
fn spaced(text: &[u8]) -> Vec<u8> {
    let text = String::from_utf8_lossy(text);
    text.replace(':', ": ").into_bytes()
}

fn joined(text: &[u8], rest: &[u8]) -> Vec<u8> {
    let words = [2, 20 + text.len() + rest.len(), text.len()];
    let mut out = b"glTF".to_vec();
    out.extend(words.iter().flat_map(|&word| (word as u32).to_le_bytes()));
    out.extend(b"JSON");
    out.extend(text);
    out.extend(rest);
    out
}
