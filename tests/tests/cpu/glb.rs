//! What stands in a GLB is what stands in the scene, read back by other code than wrote it.

mod compare;
mod material;
mod read;
mod views;

use convert::{Options, write_glb};
use scenegraph::scene::Scene;

use super::models::{Model, corpus, samples};
use compare::differences;
use read::Glb;

fn converted(scene: &Scene, model: &Model) -> Glb {
    let mut bytes = Vec::new();
    let written = write_glb(scene, &Options::default(), &model.images(), &mut bytes);
    assert!(written.is_ok(), "{}: {written:?}", model.name);
    Glb::read(&bytes)
}

fn check(models: &[Model]) {
    let mut faults = Vec::new();
    for model in models {
        let scene = model.scene();
        let differences = differences(&scene, &converted(&scene, model));
        faults.extend(
            differences
                .iter()
                .take(3)
                .map(|d| format!("{}: {d}", model.name)),
        );
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn samples_are_the_same_in_the_glb() {
    check(&samples());
}

#[test]
fn the_corpus_is_the_same_in_the_glb() {
    check(&corpus());
}
