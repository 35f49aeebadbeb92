//! Which files are written, and which are not.

use std::fs;
use std::process::Command;

use crate::place::{CUBE, FOG, Place, Run};

#[test]
fn nothing_is_written_for_what_cannot_be_read_or_is_refused() {
    let place = Place::new()
        .file("x3d.wrl", "#X3D V3.0 utf8\nShape { }\n")
        .model("a.iv", CUBE)
        .model("b/a.iv", FOG);
    let before = place.files();
    // Arguments, what the messages contain.
    let rows = [
        ("x3d.wrl", "error[unsupported-format]"),
        ("gone.iv --out-dir out", "gone.iv: error"),
        ("a.iv --format iv", "`a.iv` would be written over itself"),
        ("a.iv -o ./b/../a.iv", "would be written over itself"),
        ("b --out-dir b --format iv", "would be written over itself"),
        (
            "b/a.iv a.iv --out-dir . --format iv",
            "`./a.iv` is an input and would be overwritten by the output of `b/a.iv`",
        ),
        (
            "a.iv b/a.iv --out-dir out",
            "`a.iv` and `b/a.iv` would both be written to `out/a.glb`",
        ),
        (
            "a.iv --report a.iv",
            "`a.iv` is an input and cannot be the report",
        ),
        (
            "a.iv --report ./a.glb",
            "`./a.glb` is an output and cannot be the report",
        ),
        (
            "a.iv -o a.bin --format gltf",
            "cannot be both the glTF text and its .bin",
        ),
    ];
    for (args, needle) in rows {
        let run = place.run(args);
        assert_eq!(run.code, 2, "{args}: {}", run.err);
        assert!(run.err.contains(needle), "{args}: {}", run.err);
        assert_eq!(place.files(), before, "{args}");
    }
}

/// A write that fails half-way: the system lets no file grow beyond 4 or 8 KiB.
#[cfg(unix)]
#[test]
fn a_failed_write_leaves_the_old_file_and_no_other() {
    for (output, old) in [("out.glb", "old"), ("out.gltf", "old"), ("out.iv", "old")] {
        let place = Place::new()
            .sample("pavilion.iv", "pavilion.iv")
            .file(output, old);
        let before = place.files();
        let script = format!(r#"trap '' XFSZ; ulimit -f 8; exec "$0" pavilion.iv -o {output}"#);
        let run = Run::of(
            Command::new("sh")
                .args(["-c", &script, env!("CARGO_BIN_EXE_ivconvert")])
                .current_dir(place.folder.path()),
        );
        assert_eq!(run.code, 2, "{}", run.err);
        assert!(
            run.err.contains("pavilion.iv: error: cannot write out."),
            "{}",
            run.err
        );
        assert_eq!(place.files(), before, "{output}");
    }
}

#[test]
fn formats() {
    let place = Place::new().sample("structure/flange_bolts.iv", "a.iv");
    assert_eq!(place.run("a.iv").code, 0);
    assert_eq!(place.run("a.iv -o web/b.gltf").code, 0);
    assert_eq!(place.run("a.iv -o web/b.iv").code, 0);
    assert_eq!(place.run("a.iv -o small.glb --no-extras").code, 0);
    let want = [
        "a.glb",
        "a.iv",
        "small.glb",
        "web/b.bin",
        "web/b.gltf",
        "web/b.iv",
    ];
    assert_eq!(place.names(), want);
    let glb = gltf::Gltf::open(place.path("a.glb")).unwrap();
    let text = gltf::Gltf::open(place.path("web/b.gltf")).unwrap();
    assert_eq!(glb.meshes().count(), text.meshes().count());
    assert_eq!(glb.nodes().count(), text.nodes().count());
    let bytes = |name: &str| fs::read(place.path(name)).unwrap();
    let has_extras = |name: &str| bytes(name).windows(6).any(|w| w == b"extras");
    assert!(has_extras("a.glb") && !has_extras("small.glb"));
    // Text written anew means the same.
    assert_eq!(place.run("web/b.iv -o again.glb").code, 0);
    assert!(bytes("web/b.iv") != bytes("a.iv"));
    assert!(bytes("again.glb") == bytes("a.glb"));
}

/// Hidden parts are written when they are asked for, come back as Switches, and with the source as
/// the text they were in.
#[test]
fn alternatives_are_kept_on_demand() {
    let place = Place::new().model("a.iv", "Cube { } Switch { DEF Part Sphere { } }");
    let has = |name: &str, word: &str| {
        let bytes = fs::read(place.path(name)).unwrap();
        bytes.windows(word.len()).any(|w| w == word.as_bytes())
    };
    let plain = place.run("a.iv -o plain.glb");
    assert!(plain.err.contains("note[hidden]") && !has("plain.glb", "Part"));
    let kept = place.run("a.iv -o kept.glb --alternatives --round-trip");
    assert!(kept.err.contains("note[kept]"), "{}", kept.err);
    assert!(has("kept.glb", "KHR_node_visibility") && has("kept.glb", "Part"));
    assert_eq!(place.run("kept.glb -o back.iv").code, 0);
    assert!(fs::read(place.path("back.iv")).unwrap() == fs::read(place.path("a.iv")).unwrap());
    assert_eq!(place.run("a.iv -o anew.glb --alternatives").code, 0);
    assert_eq!(place.run("anew.glb -o anew.iv").code, 0);
    assert!(has("anew.iv", "Switch {") && has("anew.iv", "DEF Part"));
    assert_eq!(place.run("a.iv -o b.iv --alternatives").code, 2);
}

/// Nobody can make files in `/proc`.
#[cfg(target_os = "linux")]
#[test]
fn an_error_names_the_output_and_no_temporary_file() {
    let place = Place::new().model("a.iv", CUBE);
    let rows = [
        "a.iv -o /proc/a.glb",
        "a.iv -o /proc/a.gltf",
        "a.iv -o /proc/a.iv",
        "a.iv --report /proc/a.json",
    ];
    for args in rows {
        let run = place.run(args);
        assert_eq!(run.code, 2, "{args}: {}", run.err);
        assert!(
            run.err.contains("error: cannot write /proc/a."),
            "{args}: {}",
            run.err
        );
        assert!(
            !run.err.contains(".ivory-") && !run.err.contains(".ivconvert-"),
            "{args}: {}",
            run.err
        );
    }
}

#[test]
fn text_in_another_folder_says_what_it_leaves_behind() {
    let place = Place::new()
        .model(
            "a.iv",
            "Separator { Texture2 { filename \"img/wood.png\" } Cube { }\n\
             Texture2 { filename img\\stone.png } Texture2 { filename \"gone.png\" }\n\
             File { name \"part.iv\" } File { name \"part.iv\" } WWWAnchor { name \"web.iv\" } }",
        )
        .model("part.iv", CUBE)
        .model("web.iv", CUBE)
        .model("both/part.iv", CUBE)
        .file("img/wood.png", "")
        .file("img/stone.png", "")
        .file("both/img/wood.png", "");
    // Output, what is left behind: line and name.
    let rows: [(&str, &[(u64, &str)]); 5] = [
        ("b.iv", &[]),
        ("./new/../b.iv", &[]),
        (
            "new/b.iv",
            &[(2, "img/wood.png"), (3, "img\\stone.png"), (4, "part.iv")],
        ),
        ("both/b.iv", &[(3, "img\\stone.png")]),
        ("b.glb", &[]),
    ];
    for (output, want) in rows {
        let run = place.run(&format!("a.iv -o {output} --report r.json"));
        assert_eq!(run.code, 0, "{}", run.err);
        let report = place.json("r.json");
        let warnings = report["inputs"][0]["warnings"].as_array().unwrap();
        let got: Vec<(u64, &str)> = warnings
            .iter()
            .filter(|warning| warning["code"] == "left-behind")
            .map(|warning| {
                let message = warning["message"].as_str().unwrap();
                let name = message.split('`').nth(1).unwrap();
                (warning["line"].as_u64().unwrap(), name)
            })
            .collect();
        assert_eq!(got, want, "{output}");
    }
}
