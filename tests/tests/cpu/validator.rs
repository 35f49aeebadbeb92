//! Every output is free of errors and warnings of the Khronos validator.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use convert::{Container, Options, write_file};
use serde_json::Value;

use super::models::{Model, corpus, samples};

const INSTALL: &str = "npm ci --prefix tests/tools";

/// Converts a model to `out/NUMBER.glb` or `.gltf`.
fn converted(model: &Model, container: Container, out: &Path, number: usize) -> PathBuf {
    let options = Options {
        container,
        ..Options::default()
    };
    let extension = match container {
        Container::Glb => "glb",
        Container::GltfBin | Container::GltfEmbedded => "gltf",
        Container::Html => "html",
    };
    let path = out.join(format!("{number}.{extension}"));
    let written = write_file(&model.scene(), &options, &model.images(), &path);
    assert!(written.is_ok(), "{}: {written:?}", model.name);
    path
}

/// One line of the validator for each file, in their order.
pub fn validate(files: &[PathBuf], folder: &Path) -> Vec<Value> {
    let list = folder.join("names.txt");
    let names: String = files
        .iter()
        .map(|file| format!("{}\n", file.display()))
        .collect();
    fs::write(&list, names).expect("a list of names");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tools/validate.mjs");
    let run = Command::new("node")
        .arg(script)
        .arg("--list")
        .arg(&list)
        .output();
    let run = run.unwrap_or_else(|why| panic!("node is needed ({why}); then run: {INSTALL}"));
    assert!(
        matches!(run.status.code(), Some(0 | 1)),
        "the validator does not run; install it with: {INSTALL}\n{}",
        String::from_utf8_lossy(&run.stderr)
    );
    let text = String::from_utf8(run.stdout).expect("text");
    let lines = text.lines().map(serde_json::from_str);
    let lines: Vec<Value> = lines.collect::<Result<_, _>>().expect("a line of JSON");
    assert_eq!(lines.len(), files.len());
    lines
}

pub fn is_clean(line: &Value) -> bool {
    line["errors"] == 0 && line["warnings"] == 0
}

#[test]
fn outputs_have_no_errors_and_no_warnings() {
    let folder = tempfile::tempdir().expect("a folder for outputs");
    let (samples, corpus) = (samples(), corpus());
    let glb = samples.iter().chain(&corpus).map(|m| (m, Container::Glb));
    let gltf = samples.iter().map(|m| (m, Container::GltfBin));
    let embedded = samples.iter().map(|m| (m, Container::GltfEmbedded));
    let jobs: Vec<_> = glb.chain(gltf).chain(embedded).collect();
    let files: Vec<PathBuf> = jobs
        .iter()
        .enumerate()
        .map(|(number, (model, container))| converted(model, *container, folder.path(), number))
        .collect();
    let lines = validate(&files, folder.path());
    let faults: Vec<String> = jobs
        .iter()
        .zip(&lines)
        .filter(|(_, line)| !is_clean(line))
        .map(|((model, container), line)| format!("{} as {container:?}: {line}", model.name))
        .collect();
    assert!(
        faults.is_empty(),
        "{} of {} outputs:\n{}",
        faults.len(),
        files.len(),
        faults.join("\n")
    );
}

/// The judge itself: a missing `.bin`, a warning and a file of another kind are told apart.
#[test]
fn the_validator_finds_faults() {
    let folder = tempfile::tempdir().expect("a folder for outputs");
    let rows = [
        ("sound.gltf", r#"{"asset":{"version":"2.0"}}"#, [0, 0]),
        (
            "no_bin.gltf",
            r#"{"asset":{"version":"2.0"},"buffers":[{"uri":"none.bin","byteLength":4}]}"#,
            [1, 0],
        ),
        (
            "cutoff_without_mask.gltf",
            r#"{"asset":{"version":"2.0"},"materials":[{"alphaCutoff":0.5}]}"#,
            [0, 1],
        ),
        ("other.glb", "no glTF at all", [1, 0]),
    ];
    let files = rows.map(|(name, text, _)| {
        let path = folder.path().join(name);
        fs::write(&path, text).expect("a file to judge");
        path
    });
    for (line, (name, _, want)) in validate(&files, folder.path()).iter().zip(rows) {
        let got = [&line["errors"], &line["warnings"]].map(|n| n.as_u64().unwrap_or(99));
        assert_eq!(got, want, "{name}: {line}");
    }
}
