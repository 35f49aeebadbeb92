//! The command `ivconvert` as its users run it: the real binary in a scratch folder, judged by its
//! exit code, what it prints and the files it leaves. What is in a glTF is judged in `convert`'s
//! other tests.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

/// A scratch folder, in which the command runs.
struct Place {
    folder: tempfile::TempDir,
}

struct Run {
    code: i32,
    out: String,
    err: String,
}

impl Place {
    fn new() -> Self {
        Self {
            folder: tempfile::tempdir().unwrap(),
        }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Writes a model below the header of Inventor 2.1.
    fn model(self, name: &str, body: &str) -> Self {
        self.file(name, &format!("#Inventor V2.1 ascii\n{body}\n"))
    }

    fn file(self, name: &str, text: &str) -> Self {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
        self
    }

    /// Copies the sample `from` to `to`.
    fn sample(self, from: &str, to: &str) -> Self {
        let bytes = fs::read(samples().join(from)).unwrap();
        fs::create_dir_all(self.path(to).parent().unwrap()).unwrap();
        fs::write(self.path(to), bytes).unwrap();
        self
    }

    fn command(&self, args: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ivconvert"));
        command.current_dir(self.folder.path());
        command.args(args.split_whitespace());
        command
    }

    fn run(&self, args: &str) -> Run {
        let output = self.command(args).output().unwrap();
        Run {
            code: output.status.code().unwrap(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }

    /// All files, by their path below the folder, with their bytes; hidden ones too.
    fn files(&self) -> Vec<(String, Vec<u8>)> {
        let mut files = Vec::new();
        let mut folders = vec![self.folder.path().to_owned()];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).unwrap() {
                let entry = entry.unwrap();
                let path = entry.path();
                if entry.file_type().unwrap().is_dir() {
                    folders.push(path);
                } else if entry.file_type().unwrap().is_file() {
                    let name = path.strip_prefix(self.folder.path()).unwrap();
                    files.push((name.display().to_string(), fs::read(&path).unwrap()));
                }
            }
        }
        files.sort();
        files
    }

    fn names(&self) -> Vec<String> {
        self.files().into_iter().map(|(name, _)| name).collect()
    }

    fn json(&self, name: &str) -> Value {
        serde_json::from_slice(&fs::read(self.path(name)).unwrap()).unwrap()
    }
}

fn samples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../samples/data")
}

/// Messages without the last line, which holds the time taken.
fn without_summary(err: &str) -> &str {
    err.trim_end()
        .rsplit_once('\n')
        .map_or("", |(rest, _)| rest)
}

const CUBE: &str = "Cube { }";
const UNKNOWN_USE: &str = "Separator { Cube { } USE Lid }";
const FOG: &str = "Separator { Environment { fogType FOG fogVisibility 9 } Cube { } }";
const IMAGE: &str = "Separator { Texture2 { filename \"wood.png\" } Cube { } }";

#[test]
fn exit_codes_and_messages() {
    let place = Place::new()
        .model("cube.iv", CUBE)
        .model("use.iv", UNKNOWN_USE)
        .model("fog.iv", FOG)
        .model("image.iv", IMAGE)
        .model("empty.iv", "Separator { Label { label \"a\" } }")
        .file("v2.wrl", "#VRML V2.0 utf8\nShape { }\n")
        .file("binary.iv", "#Inventor V2.1 binary  \n\0\0\0\u{1}")
        .file("folder/notes.txt", "");
    // Arguments, exit code, what the messages contain.
    let rows: &[(&str, i32, &[&str])] = &[
        ("cube.iv", 0, &["1 converted, 0."]),
        ("cube.iv --strict", 0, &["1 converted, 0."]),
        (
            "use.iv",
            0,
            &[
                "use.iv:2:",
                ": error[unknown-name]: ",
                "| Separator",
                "^^",
                "1 error",
            ],
        ),
        (
            "use.iv --strict",
            1,
            &["error[unknown-name]", "1 converted"],
        ),
        (
            "fog.iv",
            0,
            &["fog.iv:2:57: loss[fog]: ", "1 converted, 1 loss, "],
        ),
        ("fog.iv --strict", 1, &["loss[fog]"]),
        (
            "image.iv",
            0,
            &[
                "image.iv:2:13: warning[image]: `wood.png` is left out",
                "--search",
            ],
        ),
        ("image.iv --strict", 1, &["warning[image]"]),
        (
            "empty.iv --strict",
            0,
            &["empty.iv: warning[no-geometry]", "1 converted"],
        ),
        (
            "v2.wrl",
            2,
            &[
                "error[unsupported-format]: VRML 2.0",
                "v2.wrl: error: ",
                "1 failed",
            ],
        ),
        (
            "v2.wrl --format iv -o v2.iv",
            2,
            &["error[unsupported-format]: VRML 2.0", "1 failed"],
        ),
        (
            "binary.iv",
            2,
            &["error[unsupported-format]: binary", "0 converted, 1 failed"],
        ),
        (
            "gone.iv cube.iv",
            2,
            &["gone.iv: error: cannot be read: ", "1 converted, 1 failed"],
        ),
        (
            "folder",
            2,
            &["folder: error: the folder holds no .iv or .wrl files"],
        ),
        (
            "cube.iv --out-dir cube.iv",
            2,
            &["cube.iv: error: cube.iv: "],
        ),
        ("cube.iv -o new/x.glb", 0, &["1 converted"]),
        (
            "cube.iv --report folder",
            2,
            &["--report: error: folder: ", "1 converted"],
        ),
        ("cube.iv --quiet", 0, &[]),
        (
            "cube.iv -o folder",
            2,
            &["`folder` is a folder; use --out-dir"],
        ),
        ("cube.iv -o a.obj", 2, &["`a.obj` ends in none of"]),
        (
            "cube.iv -o a.glb --format iv",
            2,
            &["--format iv does not fit"],
        ),
        ("cube.iv fog.iv -o a.glb", 2, &["-o is for a single input"]),
        ("folder -o a.glb", 2, &["-o is for a single input"]),
        (
            "cube.iv --search gone",
            2,
            &["'gone'", "it is not a folder"],
        ),
        ("cube.iv --jobs 0", 2, &["--jobs"]),
        ("cube.iv --json", 2, &["--info"]),
        ("cube.iv --info --strict", 2, &["cannot be used with"]),
        ("", 2, &["<INPUT>"]),
    ];
    for (args, code, needles) in rows {
        let run = place.run(args);
        assert_eq!(run.code, *code, "{args}: {}", run.err);
        assert_eq!(run.out, "", "{args}");
        assert_eq!(
            run.err.is_empty(),
            needles.is_empty(),
            "{args}: {}",
            run.err
        );
        for needle in *needles {
            assert!(
                run.err.contains(needle),
                "{args}: no `{needle}` in {}",
                run.err
            );
        }
    }
}

#[test]
fn nothing_is_written_for_what_cannot_be_read_or_is_refused() {
    let place = Place::new()
        .file("v2.wrl", "#VRML V2.0 utf8\nShape { }\n")
        .model("a.iv", CUBE)
        .model("b/a.iv", FOG);
    let before = place.files();
    // Arguments, what the messages contain.
    let rows = [
        ("v2.wrl", "error[unsupported-format]"),
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
        let binary = env!("CARGO_BIN_EXE_ivconvert");
        let script = format!("trap '' XFSZ; ulimit -f 8; exec {binary} pavilion.iv -o {output}");
        let run = Command::new("sh")
            .args(["-c", &script])
            .current_dir(place.folder.path())
            .output()
            .unwrap();
        let err = String::from_utf8(run.stderr).unwrap();
        assert_eq!(run.status.code(), Some(2), "{err}");
        assert!(err.contains("pavilion.iv: error: out."), "{err}");
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
    let has_extras = |name: &str| {
        fs::read(place.path(name))
            .unwrap()
            .windows(6)
            .any(|w| w == b"extras")
    };
    assert!(has_extras("a.glb") && !has_extras("small.glb"));
    // Text written anew means the same.
    assert_ne!(
        fs::read(place.path("web/b.iv")).unwrap(),
        fs::read(place.path("a.iv")).unwrap()
    );
    assert_eq!(place.run("web/b.iv -o again.glb").code, 0);
    assert!(fs::read(place.path("again.glb")).unwrap() == fs::read(place.path("a.glb")).unwrap());
}

#[test]
fn folders_are_searched() {
    let place = Place::new()
        .model("models/b.IV", CUBE)
        .model("models/a.iv", CUBE)
        .file("models/c/d.wrl", "#VRML V1.0 ascii\nCube { }\n")
        .file("models/c/readme.md", "")
        .model("models/out/old.iv", CUBE);
    let listed = |run: &Run| {
        let lines = run
            .out
            .lines()
            .filter(|line| !line.is_empty() && !line.starts_with(' '));
        lines.map(str::to_owned).collect::<Vec<_>>()
    };
    let all = [
        "models/a.iv",
        "models/b.IV",
        "models/c/d.wrl",
        "models/out/old.iv",
    ];
    assert_eq!(listed(&place.run("--info models")), all);
    // None twice, however it is named.
    assert_eq!(
        listed(&place.run("--info models ./models/a.iv models/../models")),
        all
    );
    // Earlier outputs below the folder searched are no inputs.
    for _ in 0..2 {
        assert_eq!(
            place.run("models --out-dir models/out --format gltf").code,
            0
        );
        let names = place.names();
        let made = |name: &&String| name.ends_with(".gltf");
        let made: Vec<&String> = names.iter().filter(made).collect();
        let want = [
            "models/out/a.gltf",
            "models/out/b.gltf",
            "models/out/c/d.gltf",
        ];
        assert_eq!(made, want);
    }
}

#[cfg(unix)]
#[test]
fn linked_folders_are_searched_once_and_cycles_end() {
    use std::os::unix::fs::symlink;
    let place = Place::new()
        .model("models/real/a.iv", CUBE)
        .model("other/b.iv", CUBE);
    symlink("..", place.path("models/real/up")).unwrap();
    symlink(".", place.path("models/here")).unwrap();
    symlink("real", place.path("models/alias")).unwrap();
    symlink("../other", place.path("models/other")).unwrap();
    let run = place.run("models --out-dir out");
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(run.err.starts_with("2 converted"), "{}", run.err);
    let names = place.names();
    let out: Vec<&String> = names
        .iter()
        .filter(|name| name.starts_with("out"))
        .collect();
    assert_eq!(out, ["out/other/b.glb", "out/real/a.glb"]);
}

#[test]
fn outputs_and_messages_do_not_depend_on_the_number_of_threads() {
    let data = samples().canonicalize().unwrap();
    let results = ["1", "4", "4"].map(|jobs| {
        let place = Place::new();
        let run = place.run(&format!(
            "{} --out-dir out --report r.json --jobs {jobs}",
            data.display()
        ));
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

#[test]
fn a_report_holds_it_all() {
    let lost = "Separator { USE Lid Environment { fogType FOG fogVisibility 9 } Cube { wide 2 } Cube { } }";
    let place = Place::new()
        .model("lost.iv", lost)
        .model("image.iv", IMAGE)
        .file("v2.wrl", "#VRML V2.0 utf8\n");
    assert_eq!(
        place
            .run("lost.iv gone.iv image.iv v2.wrl --report r.json")
            .code,
        2
    );
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
        ("/inputs/0/losses/0/column", column("Cube { wide").into()),
        ("/inputs/1/status", "failed".into()),
        ("/inputs/1/counts", Value::Null),
        ("/inputs/2/warnings/0/code", "image".into()),
        ("/inputs/3/diagnostics/0/code", "unsupported-format".into()),
    ];
    for (pointer, want) in rows {
        assert_eq!(
            report.pointer(pointer),
            Some(&want),
            "{pointer}: {report:#}"
        );
    }
    assert!(report.get("seconds").is_none());
    assert_eq!(place.run("lost.iv --report t.json --timings").code, 0);
    assert!(place.json("t.json")["inputs"][0]["seconds"].is_f64());
}

/// Triangles of a glTF: stored, and drawn by all nodes with a mesh.
fn triangles(path: &Path) -> (u64, u64) {
    let document = gltf::Gltf::open(path).unwrap();
    let of = |mesh: gltf::Mesh<'_>| -> usize {
        mesh.primitives()
            .map(|p| p.indices().unwrap().count() / 3)
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
fn info_agrees_with_the_text_and_with_the_conversion() {
    let place = Place::new().sample("structure/flange_bolts.iv", "f.iv");
    let run = place.run("--info f.iv --json");
    assert_eq!((run.code, run.err.as_str()), (0, ""));
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

#[test]
fn info_lists_files_textures_lights_and_cameras() {
    // Sample, JSON pointer below its content, value.
    let rows = [
        (
            "structure/include_part.iv",
            "/files/1/name",
            Value::from("bolt_part.iv"),
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
        let run = place.run(&format!(
            "--info --json {}",
            samples().join(sample).display()
        ));
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

#[test]
fn other_files_come_from_the_own_folder_and_search_folders_only() {
    let body = "Separator { File { name \"../parts/lid.iv\" } Separator { Texture2 { filename \"orientation.png\" } Cube { } } }";
    let place = Place::new()
        .model("models/box.iv", body)
        .model("parts/lid.iv", "Separator { Cube { } Sphere { } }")
        .sample("textures/orientation.png", "images/orientation.png");
    // Search options, exit code under --strict, meshes and images in the output.
    let rows = [
        ("", 1, 1, 0),
        ("--search parts", 1, 3, 0),
        ("--search images", 0, 1, 1),
        ("--search images --search parts", 0, 3, 1),
    ];
    for (search, code, meshes, images) in rows {
        let run = place.run(&format!("models/box.iv --strict -o box.glb {search}"));
        assert_eq!(run.code, code, "{search}: {}", run.err);
        let document = gltf::Gltf::open(place.path("box.glb")).unwrap();
        let drawn = document
            .nodes()
            .filter(|node| node.mesh().is_some())
            .count();
        assert_eq!(drawn, meshes, "{search}: {}", run.err);
        assert_eq!(document.images().count(), images, "{search}: {}", run.err);
        assert_eq!(
            run.err.contains("warning[include]"),
            meshes == 1,
            "{search}: {}",
            run.err
        );
    }
}

#[test]
fn long_lists_of_messages_are_cut_and_quiet_shows_errors_only() {
    let unknown_fields: String = (0..40).map(|i| format!("Cube {{ wide{i} 1 }}\n")).collect();
    let place = Place::new().model("a.iv", &format!("{unknown_fields}USE Lid\n{FOG}"));
    let run = place.run("a.iv --report r.json");
    assert_eq!(run.err.matches("warning[unknown-field]").count(), 19);
    assert_eq!(run.err.matches("error[unknown-name]").count(), 1);
    assert!(
        run.err.contains("a.iv: … and 21 more (see r.json)\n"),
        "{}",
        run.err
    );
    let all = place.json("r.json");
    assert_eq!(
        all["inputs"][0]["diagnostics"].as_array().map(Vec::len),
        Some(41)
    );
    let run = place.run("a.iv -q");
    assert_eq!(run.code, 0);
    assert!(run.err.starts_with("a.iv:42:"), "{}", run.err);
    assert_eq!(run.err.matches("[").count(), 1, "{}", run.err);
}
