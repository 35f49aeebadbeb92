//! The same input gives the same bytes: again, in other threads, and from another folder. What the
//! command does with several jobs is tested with the command.

use std::fs;
use std::path::Path;
use std::thread;

use convert::{Options, write_glb, write_gltf};

use super::models::{Model, corpus, samples};

/// `.glb`, `.gltf` and `.bin`.
type Outputs = [Vec<u8>; 3];

fn outputs(model: &Model) -> Outputs {
    let (scene, images, options) = (model.scene(), model.images(), Options::default());
    let mut outputs = Outputs::default();
    let [glb, gltf, bin] = &mut outputs;
    write_glb(&scene, &options, &images, glb).expect("a GLB");
    write_gltf(&scene, &options, &images, "model.bin", gltf, bin).expect("a glTF and its bin");
    outputs
}

fn assert_same(model: &Model, first: &Outputs, again: &Outputs) {
    for (name, (first, again)) in [".glb", ".gltf", ".bin"]
        .iter()
        .zip(first.iter().zip(again))
    {
        let differs = first.iter().zip(again).position(|(a, b)| a != b);
        let lengths = [first.len(), again.len()];
        assert!(
            first == again,
            "{} as {name}: bytes differ from {differs:?}, lengths {lengths:?}",
            model.name
        );
    }
}

#[test]
fn again() {
    for model in samples().iter().chain(&corpus()) {
        assert_same(model, &outputs(model), &outputs(model));
    }
}

/// Each thread begins elsewhere in the list, so that different models are made at the same time.
#[test]
fn in_threads() {
    const THREADS: usize = 4;
    let models = samples();
    let first: Vec<Outputs> = models.iter().map(outputs).collect();
    let convert_from = &|start: usize| {
        for i in 0..models.len() {
            let i = (start + i) % models.len();
            assert_same(&models[i], &first[i], &outputs(&models[i]));
        }
    };
    let starts = (0..THREADS).map(|thread| thread * models.len() / THREADS);
    thread::scope(|scope| {
        for start in starts {
            scope.spawn(move || convert_from(start));
        }
    });
}

#[test]
fn from_another_folder() {
    let folder = tempfile::tempdir().expect("a folder for copies");
    copy(&samples::data_dir(), folder.path());
    for model in samples() {
        let path = folder.path().join(&model.name);
        let copy = Model {
            name: path.display().to_string(),
            path,
            source: folder.path().to_owned(),
        };
        assert_same(&model, &outputs(&model), &outputs(&copy));
    }
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder") {
        let entry = entry.expect("an entry");
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), target).expect("a copy");
        }
    }
}
