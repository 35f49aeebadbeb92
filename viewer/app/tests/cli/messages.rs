//! Exit codes, and what is printed.

use crate::place::{CUBE, Place};

#[test]
fn exit_codes_and_messages() {
    let place = Place::new()
        .file("cube.iv", CUBE)
        .file(
            "use.iv",
            "#Inventor V2.1 ascii\nSeparator { Cube { } USE Lid }\n",
        )
        .file("empty.iv", "#Inventor V2.1 ascii\nSeparator { }\n")
        .file("x3d.wrl", "#X3D V3.0 utf8\nShape { }\n")
        .file("broken.glb", b"glTF\x02\0\0\0")
        .file("broken.gltf", "{ \"asset\": 1 }")
        .file("moving.gltf", GLTF_WITH_SKIN)
        .file("note.txt", "hello")
        .sample("lights/cameras.iv");
    // Arguments, exit code, what the messages contain.
    let rows: &[(&str, i32, &[&str])] = &[
        (
            "cube.iv -o a.png",
            0,
            &["drawn by ", "a software adapter: ", "written to a.png, 0."],
        ),
        (
            "cube.iv",
            2,
            &["error: there is no window to be had: ", "with --output PNG"],
        ),
        ("", 2, &["error: there is no window to be had: "]),
        (
            "-o a.png",
            2,
            &["error: --output draws one model; give one"],
        ),
        (
            "use.iv -o a.png",
            0,
            &[
                "use.iv:2:",
                ": error[unknown-name]: ",
                "^^",
                "a.png, 1 error, ",
            ],
        ),
        (
            "empty.iv -o a.png",
            0,
            &["empty.iv: warning[no-geometry]", "1 warning"],
        ),
        (
            "x3d.wrl -o x.png",
            2,
            &[
                "error[unsupported-format]: this is X3D",
                "x3d.wrl: error: not shown",
            ],
        ),
        ("gone.iv -o x.png", 2, &["gone.iv: error: cannot be read: "]),
        (". -o x.png", 2, &[".: error: cannot be read: "]),
        (
            "broken.glb -o x.png",
            2,
            &["broken.glb: error: not a whole .glb: "],
        ),
        (
            "broken.gltf -o x.png",
            2,
            &["broken.gltf: error: not a glTF text: "],
        ),
        (
            "moving.gltf -o a.png",
            0,
            &["moving.gltf: warning[gltf]: skins are shown at rest"],
        ),
        (
            "cameras.iv -o x.png --camera Garden",
            2,
            &["error: no camera `Garden`; ", "`View_Room`"],
        ),
        (
            "cameras.iv -o x.png --camera 1",
            2,
            &["error: no camera `1`; ", "`View_Room`"],
        ),
        (
            "cube.iv -o x.png --camera 0",
            2,
            &["no camera `0`; the model has none"],
        ),
        (
            "cube.iv -o x.png --camera 1,2,3",
            2,
            &["error: a view is 7 numbers, not 3"],
        ),
        (
            "cube.iv -o x.png --view note.txt",
            2,
            &["error: note.txt: line 1: not a saved view"],
        ),
        (
            "cube.iv -o x.png --view gone.ivv",
            2,
            &["error: gone.ivv: cannot be read: "],
        ),
        (
            "cube.iv -o x.png --view note.txt --camera 0",
            2,
            &["cannot be used with"],
        ),
        (
            "cube.iv -o x.png --reference note.txt",
            2,
            &["error: note.txt: it is no PNG"],
        ),
        ("cube.iv -o x.jpg", 2, &["must end in .png"]),
        ("cube.iv -o x.png --size 64", 2, &["such as 1920x1080"]),
        ("cube.iv -o x.png --size 0x9", 2, &["such as 1920x1080"]),
        (
            "cube.iv -o x.png --size 4000000000x1",
            2,
            &[
                "error: a picture of 4000000000x1 is too large for ",
                " pixels",
            ],
        ),
        (
            "cube.iv -o x.png --size 8193x8192",
            2,
            &["8193x8192 is too large: it has at most 67108864 pixels"],
        ),
        (
            "cube.iv -o x.png --background pink",
            2,
            &["`pink` is no colour", "griseous"],
        ),
        ("cube.iv -o x.png --background #+12345", 2, &["no colour"]),
        ("cube.iv -o x.png --msaa 2", 2, &["it is 1 or 4"]),
        ("cube.iv -o x.png --threshold exact", 2, &["--reference"]),
        (
            "cube.iv -o x.png --reference x.png --threshold 1,2",
            2,
            &["three numbers"],
        ),
        ("cube.iv -o x.png --search note.txt", 2, &["not a folder"]),
        ("cube.iv -o note.txt/x.png", 2, &["error: cannot "]),
    ];
    for (args, code, texts) in rows {
        let run = place.run(args);
        assert_eq!(run.code, *code, "{args}: {}", run.err);
        for text in *texts {
            assert!(run.err.contains(text), "{args}: {text}\n{}", run.err);
        }
        assert_eq!(run.out, "", "{args}");
        assert_eq!(place.path("a.png").exists(), *code == 0, "{args}");
        let _ = std::fs::remove_file(place.path("a.png"));
    }
    let left = place.names().into_iter().filter(|n| n.ends_with("png"));
    assert_eq!(left.count(), 0, "{:?}", place.names());
}

#[test]
fn quiet_runs_print_errors_only() {
    let place = Place::new()
        .file("cube.iv", CUBE)
        .file(
            "comma.iv",
            "#Inventor V2.1 ascii\nTranslation { translation 1,5 2,0 3,0 } Cube { }\n",
        )
        .file(
            "use.iv",
            "#Inventor V2.1 ascii\nSeparator { Cube { } USE Lid }\n",
        );
    for (args, prints) in [
        ("cube.iv", false),
        ("comma.iv", false),
        ("use.iv", true),
        ("gone.iv", true),
    ] {
        let run = place.run(&format!("{args} -q -o a.png"));
        assert_eq!(!run.err.is_empty(), prints, "{args}: {}", run.err);
    }
}

#[test]
fn images_are_searched_for() {
    let model = "#Inventor V2.1 ascii
        Texture2 { filename \"bricks.png\" } Cube { } Texture2 { filename \"bricks.png\" } Sphere { }";
    let bricks = std::fs::read(samples::data_dir().join("textures/bricks.png")).unwrap();
    let place = Place::new()
        .file("cube.iv", model)
        .file("images/bricks.png", &bricks)
        .file("no_image/bricks.png", "no image")
        .file("none/a.txt", "");
    for (args, warning) in [
        (
            "",
            Some("cube.iv:2:9: warning[image]: `bricks.png` is left out: "),
        ),
        (
            "--search none",
            Some("`bricks.png` is left out: it was not found"),
        ),
        ("--search no_image", Some("`bricks.png` is left out: ")),
        ("--search none --search images", None),
    ] {
        let run = place.run(&format!("cube.iv -o a.png {args}"));
        assert_eq!(run.code, 0, "{args}: {}", run.err);
        let count = run.err.matches("is left out").count();
        assert_eq!(count, usize::from(warning.is_some()), "{args}: {}", run.err);
        if let Some(warning) = warning {
            assert!(run.err.contains(warning), "{args}: {}", run.err);
        }
    }
}

const GLTF_WITH_SKIN: &str = r#"{ "asset": { "version": "2.0" },
    "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{}], "skins": [{ "joints": [0] }] }"#;
