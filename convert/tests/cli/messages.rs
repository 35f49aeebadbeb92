//! Exit codes, and what is printed.

use crate::place::{CUBE, FOG, IMAGE, Place, UNKNOWN_USE};

#[test]
fn exit_codes_and_messages() {
    let place = Place::new()
        .model("cube.iv", CUBE)
        .model("use.iv", UNKNOWN_USE)
        .model("fog.iv", FOG)
        .model(
            "comma.iv",
            "Translation { translation 1,5 2,0 3,0 } Cube { }",
        )
        .model("image.iv", IMAGE)
        .model("empty.iv", "Separator { Label { label \"a\" } }")
        .file("x3d.wrl", "#X3D V3.0 utf8\nShape { }\n")
        .file("binary.iv", "#Inventor V2.1 binary  \n\0\0\0\u{1}")
        .file("folder/notes.txt", "");
    // Arguments, exit code, what the messages contain.
    let rows: &[(&str, i32, &[&str])] = &[
        ("cube.iv", 0, &["1 converted to cube.glb, 0."]),
        ("cube.iv --strict", 0, &["1 converted to cube.glb, 0."]),
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
            &[
                "fog.iv:2:13: loss[fog]: ",
                "1 converted to fog.glb, 1 loss, ",
            ],
        ),
        (
            "comma.iv",
            0,
            &[
                "warning[extra-numbers]",
                "numbers take a point, not a comma",
            ],
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
            "x3d.wrl",
            2,
            &[
                "error[unsupported-format]: this is X3D",
                "x3d.wrl: error: ",
                "1 failed",
            ],
        ),
        (
            "x3d.wrl --format iv -o v2.iv",
            2,
            &["error[unsupported-format]: this is X3D", "1 failed"],
        ),
        (
            "binary.iv",
            0,
            &[
                "binary.iv:byte 24: error[unreadable]: a node was expected here",
                "1 converted",
            ],
        ),
        (
            "gone.iv cube.iv",
            2,
            &[
                "gone.iv: error: cannot be read: ",
                "1 converted to cube.glb, 1 failed",
            ],
        ),
        ("folder", 2, &["folder: error: the folder holds no models"]),
        (
            "cube.iv --out-dir cube.iv",
            2,
            &["cube.iv: error: cannot make the folder cube.iv: "],
        ),
        ("cube.iv -o new/x.glb", 0, &["1 converted to new/x.glb, "]),
        (
            "cube.iv use.iv --out-dir new",
            0,
            &["2 converted, 1 error, "],
        ),
        (
            "cube.iv --report folder",
            2,
            &["--report: error: cannot write folder: ", "1 converted"],
        ),
        ("cube.iv --quiet", 0, &[]),
        (
            "cube.iv -o folder",
            2,
            &["`folder` is a folder; use --out-dir"],
        ),
        ("cube.iv -o -", 2, &["standard output"]),
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
        (
            "cube.iv -j 0",
            2,
            &["'0'", "--jobs", "inputs converted at once, 1 or more"],
        ),
        ("cube.iv -j many", 2, &["'many'", "1 or more"]),
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

/// What is wrong with the files is one line; how arguments are written is not explained for it.
#[test]
fn a_plan_that_fails_says_why_and_no_more() {
    let place = Place::new().model("cube.iv", CUBE).model("fog.iv", FOG);
    let rows = [
        (
            "cube.iv fog.iv -o a.glb",
            "error: -o is for a single input file; use --out-dir for several and for folders\n",
        ),
        (
            "cube.iv -q --format iv",
            "error: `cube.iv` would be written over itself; give -o or --out-dir\n",
        ),
    ];
    for (args, want) in rows {
        let run = place.run(args);
        assert_eq!((run.code, &*run.err), (2, want), "{args}");
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

/// The parser keeps a limited number of problems; that there were more is said for both kinds of
/// output, except where the text could not be read at all.
#[test]
fn problems_beyond_the_parsers_limit_are_counted() {
    let limit = iv_parser::Limits::default().problems;
    let braces = CUBE.to_owned() + &"\n}".repeat(limit + 7);
    let place = Place::new()
        .model("a.iv", &braces)
        .file("x3d.wrl", &format!("#X3D V3.0 utf8\n{braces}"));
    let rows = [
        ("a.iv", true),
        ("a.iv -o b.iv", true),
        ("x3d.wrl -o b.iv", false),
    ];
    for (args, is_said) in rows {
        let run = place.run(&format!("{args} --report r.json"));
        let report = place.json("r.json");
        let said = report["inputs"][0]["diagnostics"].to_string();
        let is_in = said.contains("\"7 more problems are not shown\"");
        assert_eq!(is_in, is_said, "{args}: {}", run.err);
    }
}
