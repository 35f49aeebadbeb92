//! The report, and that nothing depends on the number of threads.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::place::{IMAGE, Place, samples, without_summary};

#[test]
fn a_report_holds_it_all() {
    let lost = "Separator { USE Lid Environment { fogType FOG fogVisibility 9 } Cube { wide 2 } Cube { } }";
    let place = Place::new()
        .model("lost.iv", lost)
        .model("image.iv", IMAGE)
        .file("x3d.wrl", "#X3D V3.0 utf8\n");
    let run = place.run("lost.iv gone.iv image.iv x3d.wrl --report r.json");
    assert_eq!(run.code, 2);
    let report = place.json("r.json");
    let column = |word: &str| lost.find(word).unwrap() + 1;
    let bytes = |name: &str| fs::metadata(place.path(name)).unwrap().len();
    // JSON pointer, value.
    let rows: [(&str, Value); 24] = [
        ("/totals/converted", 2.into()),
        ("/totals/failed", 2.into()),
        ("/totals/losses", 1.into()),
        ("/totals/errors", 2.into()),
        ("/totals/warnings", 2.into()),
        ("/inputs/0/path", "lost.iv".into()),
        ("/inputs/0/output", "lost.glb".into()),
        ("/inputs/0/status", "converted".into()),
        ("/inputs/0/error", Value::Null),
        ("/inputs/0/bytes_in", bytes("lost.iv").into()),
        ("/inputs/0/bytes_out", bytes("lost.glb").into()),
        ("/inputs/0/counts/instances", 2.into()),
        ("/inputs/0/diagnostics/0/code", "unknown-name".into()),
        ("/inputs/0/diagnostics/0/severity", "error".into()),
        ("/inputs/0/diagnostics/0/line", 2.into()),
        ("/inputs/0/diagnostics/1/code", "unknown-field".into()),
        ("/inputs/0/diagnostics/1/column", column("wide").into()),
        ("/inputs/0/losses/0/code", "fog".into()),
        ("/inputs/0/losses/0/count", 2.into()),
        ("/inputs/0/losses/0/column", column("Environment").into()),
        ("/inputs/1/status", "failed".into()),
        ("/inputs/1/counts", Value::Null),
        ("/inputs/2/warnings/0/code", "image".into()),
        ("/inputs/3/diagnostics/0/code", "unsupported-format".into()),
    ];
    for (pointer, want) in rows {
        let got = report.pointer(pointer);
        assert_eq!(got, Some(&want), "{pointer}: {report:#}");
    }
    assert!(report.get("seconds").is_none());
    assert_eq!(place.run("lost.iv --report t.json --timings").code, 0);
    assert!(place.json("t.json")["inputs"][0]["seconds"].is_f64());
}

#[test]
fn outputs_and_messages_do_not_depend_on_the_number_of_threads() {
    let data = samples().canonicalize().unwrap();
    let results = ["1", "4", "4"].map(|jobs| {
        let place = Place::new();
        let args = format!("--out-dir out --report r.json --jobs {jobs}");
        let run = place.run_on(&args, &data);
        assert_eq!(run.code, 0, "{}", run.err);
        (without_summary(&run.err).to_owned(), place.files())
    });
    let [one, four, again] = results;
    assert!(one.1.len() > 40);
    assert_eq!(one.0, four.0);
    assert!(one.1 == four.1 && four.1 == again.1);
    // Messages are in the order of the inputs.
    let files: Vec<&str> = one
        .0
        .lines()
        .filter_map(|l| l.strip_prefix(data.to_str()?))
        .collect();
    let paths: Vec<&str> = files
        .iter()
        .filter_map(|l| l.split_once(".iv:"))
        .map(|(p, _)| p)
        .collect();
    assert!(paths.len() > 20);
    assert!(paths.iter().map(Path::new).is_sorted(), "{paths:?}");
}
