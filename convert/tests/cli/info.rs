//! `--info`.

use std::fs;
use std::path::Path;
use std::process::Stdio;

use serde_json::Value;

use crate::place::{Place, UNKNOWN_USE, samples};

#[test]
fn info_agrees_with_the_text_and_with_the_conversion() {
    let place = Place::new().sample("structure/flange_bolts.iv", "f.iv");
    let run = place.run("--info f.iv --json");
    assert_eq!(run.code, 0);
    // The part is defined in a Switch that shows nothing.
    assert!(
        run.err.starts_with("f.iv:6:15: note[hidden]"),
        "{}",
        run.err
    );
    let info: Value = serde_json::from_str(&run.out).unwrap();
    let content = &info["inputs"][0]["content"];
    let text = fs::read_to_string(place.path("f.iv")).unwrap();
    for class in [
        "Separator",
        "Translation",
        "Cylinder",
        "Switch",
        "Material",
        "Complexity",
    ] {
        let count = text.matches(&format!("{class} {{")).count();
        assert_eq!(content["nodes"]["by_class"][class], count, "{class}");
    }
    assert_eq!(content["nodes"]["total"], text.matches(" {").count());
    // Two cylinders in each of the 40 bolts and two in the flange.
    assert_eq!(content["meshes"]["unique"], 4);
    assert_eq!(content["meshes"]["instanced"], 82);
    // The flange's radius; the lowest bolt's end, and the pipe's.
    assert_eq!(
        content["bounds"]["min"],
        serde_json::json!([-210.0, -28.0, -210.0])
    );
    assert_eq!(
        content["bounds"]["max"],
        serde_json::json!([210.0, 162.0, 210.0])
    );
    assert_eq!(place.run("f.iv --report r.json").code, 0);
    let (unique, drawn) = triangles(&place.path("f.glb"));
    for counts in [content, &place.json("r.json")["inputs"][0]["counts"]] {
        assert_eq!(counts["triangles"]["unique"], unique);
        assert_eq!(counts["triangles"]["instanced"], drawn);
    }
}

/// Triangles of a glTF: stored, and drawn by all nodes with a mesh.
fn triangles(path: &Path) -> (u64, u64) {
    let document = gltf::Gltf::open(path).unwrap();
    let of = |mesh: gltf::Mesh<'_>| -> usize {
        mesh.primitives()
            .map(|p| {
                let corners = p.indices().or(p.get(&gltf::Semantic::Positions));
                corners.unwrap().count() / 3
            })
            .sum()
    };
    let unique = document.meshes().map(of).sum::<usize>();
    let drawn = document
        .nodes()
        .filter_map(|n| n.mesh())
        .map(of)
        .sum::<usize>();
    (unique as u64, drawn as u64)
}

#[test]
fn info_counts_what_is_written_and_says_what_is_not() {
    // Sound triangles, then: collapsed ones, a polygon on a line, indices that nothing has.
    let body = "Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0, 2 0 0, 3 0 0 ] } \
                IndexedFaceSet { coordIndex [ 0,1,2,-1, 0,1,1,-1, 0,1,3,4,-1, 0,1,9,-1 ] } \
                Complexity { value 0.1 } Sphere { } Text3 { string \"ab\" }";
    let place = Place::new().model("bad.iv", body);
    let info = place.run("--info bad.iv --json");
    let info_json: Value = serde_json::from_str(&info.out).unwrap();
    let convert = place.run("bad.iv --report r.json");
    let report = place.json("r.json");
    assert_eq!(convert.code, 0, "{}", convert.err);
    let (unique, drawn) = triangles(&place.path("bad.glb"));
    let counts = &info_json["inputs"][0]["content"]["triangles"];
    assert_eq!(counts["unique"], unique);
    assert_eq!(counts["instanced"], drawn);
    let said = |input: &Value| -> Vec<(String, String)> {
        let list = input["inputs"][0]["diagnostics"].as_array().unwrap();
        let text = |v: &Value| v.as_str().unwrap().to_owned();
        list.iter()
            .map(|d| (text(&d["code"]), text(&d["message"])))
            .collect()
    };
    assert_eq!(said(&info_json), said(&report));
    let wanted = "triangles without an area are left out (3 times, first here)";
    let found = said(&report);
    assert!(
        found.contains(&("degenerate".into(), wanted.into())),
        "{found:?}"
    );
    assert!(
        found.iter().any(|(code, _)| code == "bad-index"),
        "{found:?}"
    );
}

#[test]
fn info_lists_files_textures_lights_and_cameras() {
    // Sample, JSON pointer below its content, value.
    let rows = [
        (
            "structure/include_part.iv",
            "/files/1/name",
            Value::from(samples().join("structure/bolt_part.iv").to_str().unwrap()),
        ),
        (
            "structure/vrml_1_0.iv",
            "/files/0/format",
            "VRML V1.0 ascii".into(),
        ),
        ("lights/three_kinds.iv", "/lights/spot", 1.into()),
        ("lights/cameras.iv", "/cameras/perspective", 1.into()),
        (
            "textures/wrap_modes.iv",
            "/textures/0/file",
            "orientation.png".into(),
        ),
        (
            "textures/inline_image.iv",
            "/textures/0/components",
            3.into(),
        ),
        ("shapes/site_plan.iv", "/triangles/unique", 0.into()),
        ("shapes/site_plan.iv", "/points/unique", 3.into()),
    ];
    let place = Place::new();
    for (sample, pointer, want) in rows {
        let run = place.run_on("--info --json", &samples().join(sample));
        let info: Value = serde_json::from_str(&run.out).unwrap();
        let content = &info["inputs"][0]["content"];
        assert_eq!(
            content.pointer(pointer),
            Some(&want),
            "{sample}: {content:#}"
        );
    }
    let place = place
        .model("a.iv", UNKNOWN_USE)
        .model("none.iv", "OrthographicCamera { }");
    let run = place.run("--info a.iv gone.iv none.iv");
    assert_eq!(run.code, 2);
    for needle in [
        "a.iv\n  format      Inventor V2.1 ascii, ",
        "  size        2  2  2\n",
        "remarks     1 error\n",
        "nothing is drawn",
        "cameras     1 orthographic\n",
    ] {
        assert!(run.out.contains(needle), "no `{needle}` in {}", run.out);
    }
    assert!(run.err.contains("error[unknown-name]") && run.err.contains("gone.iv: error: "));
    assert_eq!(place.names(), ["a.iv", "none.iv"]);
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let place = Place::new();
    let mut command = place.command("--info --json");
    let mut child = command
        .arg(samples())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{err}");
    assert!(
        !err.contains("panicked") && !err.contains("cannot print"),
        "{err}"
    );
}
