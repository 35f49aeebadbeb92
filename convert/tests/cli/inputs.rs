//! Which files are read: folders searched, and what models refer to.

use crate::place::{CUBE, Place, Run};

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
        ("--search images", 1, 1, 1),
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
            run.err.contains("error[include]"),
            meshes == 1,
            "{search}: {}",
            run.err
        );
    }
}

#[test]
fn found_files_of_one_stem_keep_both_outputs() {
    let place = Place::new()
        .model("models/x.iv", CUBE)
        .model("models/x.wrl", CUBE);
    let run = place.run("models --out-dir out");
    assert_eq!(run.code, 0, "{}", run.err);
    let names = place.names();
    let out: Vec<&String> = names.iter().filter(|n| n.starts_with("out")).collect();
    assert_eq!(out, ["out/x.glb", "out/x.wrl.glb"]);
    // Named ones are not guessed at.
    let run = place.run("models/x.iv models/x.wrl --out-dir named");
    assert_eq!(run.code, 2, "{}", run.err);
}
