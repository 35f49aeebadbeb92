//! Packed and binary inputs, and binary outputs.

use std::io::{Cursor, Write};

use zip::write::SimpleFileOptions;
use zip::{AesMode, ZipWriter};

use crate::place::{CUBE, Place, samples};

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut out = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    out.write_all(bytes).unwrap();
    out.finish().unwrap()
}

fn zip(files: &[(&str, &[u8])], password: Option<&str>) -> Vec<u8> {
    let mut out = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files {
        let options = SimpleFileOptions::default();
        match password {
            Some(key) => out.start_file(*name, options.with_aes_encryption(AesMode::Aes256, key)),
            None => out.start_file(*name, options),
        }
        .unwrap();
        out.write_all(bytes).unwrap();
    }
    out.finish().unwrap().into_inner()
}

fn model(body: &str) -> Vec<u8> {
    format!("#Inventor V2.1 ascii\n{body}\n").into_bytes()
}

#[test]
fn what_a_model_is_packed_in_does_not_matter() {
    let plain = model(CUBE);
    let place = Place::new()
        .bytes("plain.iv", &plain)
        .bytes("packed.iv.gz", &gzip(&plain))
        .bytes("odd.name", &gzip(&plain))
        .bytes(
            "a.ivz",
            &zip(&[("readme.txt", b"x"), ("dir/a.iv", &plain)], None),
        )
        .bytes("b.iv", &zip(&[("b.ivx", &gzip(&plain))], None))
        .bytes("twice.iv", &gzip(&gzip(&plain)))
        .bytes("c.zip", &zip(&[("c.iv", &gzip(&gzip(&plain)))], None));
    assert_eq!(place.run("plain.iv --out-dir out").code, 0);
    let wanted = std::fs::read(place.path("out/plain.glb")).unwrap();
    for (input, output) in [
        ("packed.iv.gz", "packed.glb"),
        ("odd.name", "odd.glb"),
        ("a.ivz", "a.glb"),
        ("b.iv", "b.glb"),
        ("twice.iv", "twice.glb"),
        ("c.zip", "c.glb"),
    ] {
        let run = place.run(&format!("{input} --strict --out-dir out"));
        assert_eq!(run.code, 0, "{input}: {}", run.err);
        let got = std::fs::read(place.path("out").join(output)).unwrap();
        assert!(got == wanted, "{input}");
    }
    // Text is written from what is read.
    assert_eq!(place.run("plain.iv -o out/plain.iv").code, 0);
    let wanted = std::fs::read(place.path("out/plain.iv")).unwrap();
    for input in ["packed.iv.gz", "b.iv", "twice.iv", "c.zip"] {
        let run = place.run(&format!("{input} --strict -o out/text.iv"));
        assert_eq!(run.code, 0, "{input}: {}", run.err);
        let got = std::fs::read(place.path("out/text.iv")).unwrap();
        assert!(got == wanted, "{input}");
    }
    let run = place.run("--info a.ivz");
    assert_eq!(run.code, 0, "{}", run.err);
}

#[test]
fn odd_archives_are_explained() {
    let mut deep = model(CUBE);
    for _ in 0..6 {
        deep = gzip(&deep);
    }
    let twins = zip(
        &[("./a.iv", &model("Sphere { }")), ("a.iv", &model(CUBE))],
        None,
    );
    let own = zip(
        &[("a.iv", &model("File { name \"gone/a.iv\" } Cube { }"))],
        None,
    );
    let place = Place::new()
        .bytes("deep.iv", &deep)
        .bytes("twins.zip", &twins)
        .bytes("own.zip", &own);
    for output in ["glb", "iv"] {
        let run = place.run(&format!("deep.iv -o deep-out.{output}"));
        assert_eq!(run.code, 2, "{}", run.err);
        assert!(
            run.err.contains("it is packed more than 4 times"),
            "{}",
            run.err
        );
    }
    let run = place.run("twins.zip --report r.json");
    assert_eq!(run.code, 0, "{}", run.err);
    let said = "warning[repeated-entry]: several entries of the archive have the same name";
    assert_eq!(run.err.matches(said).count(), 1, "{}", run.err);
    // The last one is the cube.
    let counts = &place.json("r.json")["inputs"][0]["counts"];
    assert_eq!(counts["triangles"]["unique"], 12);
    let run = place.run("own.zip");
    assert!(run.err.contains("includes this file"), "{}", run.err);
    assert!(run.err.contains("if another file is meant"), "{}", run.err);
    assert!(!run.err.contains("it is looked for"), "{}", run.err);
    for bad in ["many", "0", "-1", "1.5", "9999999"] {
        let run = place.run(&format!("twins.zip --max-unpacked={bad}"));
        assert_eq!(run.code, 2, "{}", run.err);
        let said = "it is a whole number of MiB, from 1 to 1048576";
        assert!(run.err.contains(said), "{bad}: {}", run.err);
    }
}

#[test]
fn an_archive_brings_its_textures_and_files() {
    let image = std::fs::read(samples().join("textures/bricks.png")).unwrap();
    let main = model(
        "Separator { Texture2 { filename \"C:\\maps\\Checker.png\" } Cube { } \
         File { name \"parts/door.iv\" } }",
    );
    let files: [(&str, &[u8]); 4] = [
        ("parts/door.iv", &gzip(&model("Sphere { }"))),
        ("main.iv", &main),
        ("maps/checker.png", &image),
        ("other.iv", &model(CUBE)),
    ];
    let place = Place::new().bytes("house.zip", &zip(&files, None));
    let run = place.run("house.zip");
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(
        run.err
            .contains("of 3 models in the archive, `main.iv` is read"),
        "{}",
        run.err
    );
    let report = place.run("house.zip --report r.json --strict");
    assert_eq!(report.code, 0, "{}", report.err);
    let counts = &place.json("r.json")["inputs"][0]["counts"];
    assert_eq!(counts["textures"], 1);
    assert_eq!(counts["meshes"], 2);
    // Written as text it would not find them.
    let text = place.run("house.zip -o house.iv");
    assert_eq!(text.err.matches("left-behind").count(), 2, "{}", text.err);
}

#[test]
fn passwords_come_by_option_file_or_environment() {
    let bytes = zip(&[("a.iv", &model(CUBE))], Some("open sesame"));
    let place = Place::new()
        .bytes("a.ivz", &bytes)
        .file("key.txt", "open sesame\nmore\n")
        .file("wrong.txt", "sesame\n");
    for (args, code, needle) in [
        (
            "a.ivz",
            2,
            "the archive takes a password; give it with --password",
        ),
        (
            "a.ivz --password-file wrong.txt",
            2,
            "the password does not open",
        ),
        ("a.ivz --password guess", 2, "the password does not open"),
        (
            "a.ivz --password-file gone.txt",
            2,
            "gone.txt cannot be read",
        ),
        ("a.ivz --password-file key.txt", 0, "1 converted"),
    ] {
        let run = place.run(args);
        assert_eq!(run.code, code, "{args}: {}", run.err);
        assert!(run.err.contains(needle), "{args}: {}", run.err);
    }
    let mut command = place.command("a.ivz");
    command.env("IVORY_PASSWORD", "open sesame");
    assert!(command.status().unwrap().success());
}

#[test]
fn what_is_made_to_do_harm_is_refused() {
    let mut bomb = model(CUBE);
    bomb.resize(70 << 20, b' ');
    let evil = zip(
        &[("aaaaaaa.iv", &model(CUBE)), ("good.iv", &model(CUBE))],
        None,
    );
    let evil = replaced(&evil, b"aaaaaaa.iv", b"../../a.iv");
    let place = Place::new()
        .bytes("bomb.iv.gz", &gzip(&bomb))
        .bytes("bomb.zip", &zip(&[("a.iv", &bomb)], None))
        .bytes("evil.zip", &evil)
        .bytes("none.zip", &zip(&[("a.txt", b"text")], None))
        .bytes("nested.zip", &zip(&[("a.zip", &evil)], None));
    for (args, code, needle) in [
        ("bomb.iv.gz", 2, "more than 200 times as long"),
        ("bomb.zip", 2, "more than 200 times as long"),
        ("bomb.iv.gz --max-unpacked 50", 2, "longer than 50 MiB"),
        ("bomb.iv.gz --max-unpacked 100", 0, "1 converted"),
        (
            "evil.zip",
            0,
            "the entry `../../a.iv` is not used: it leads out of the archive",
        ),
        ("none.zip", 2, "the archive holds no model"),
        ("nested.zip", 2, "the archive holds no model"),
    ] {
        let run = place.run(args);
        assert_eq!(run.code, code, "{args}: {}", run.err);
        assert!(run.err.contains(needle), "{args}: {}", run.err);
    }
}

fn replaced(bytes: &[u8], from: &[u8], to: &[u8]) -> Vec<u8> {
    let mut out = bytes.to_vec();
    for at in 0..=out.len() - from.len() {
        if &out[at..at + from.len()] == from {
            out[at..at + from.len()].copy_from_slice(to);
        }
    }
    out
}

#[test]
fn a_damaged_stream_gives_its_beginning() {
    let text = model(&"Cube { } Sphere { }\n".repeat(20_000));
    let packed = gzip(&text);
    let place = Place::new().bytes("cut.iv.gz", &packed[..packed.len() - 20]);
    let run = place.run("cut.iv.gz --strict");
    assert_eq!(run.code, 1, "{}", run.err);
    assert!(run.err.contains("error[damaged]"), "{}", run.err);
}

#[test]
fn binary_files_are_written_and_say_what_is_lost() {
    let place = Place::new()
        .model("short.iv", "Separator { Cube { width 0.1 } }")
        .model(
            "long.iv",
            "Translation { translation 2600123.456 1200000.5 0 }",
        )
        .model("odd.iv", "Cube { bevel 3 }")
        .file("v1.wrl", "#VRML V1.0 ascii\nCube { }\n");
    for (args, code, needle) in [
        ("short.iv -o b.iv --binary --strict", 0, "1 converted"),
        ("b.iv -o c.iv --strict", 0, "1 converted"),
        (
            "long.iv -o d.iv --binary --strict",
            1,
            "long.iv:2:15: warning[rounded]: ",
        ),
        (
            "odd.iv -o e.iv --binary",
            0,
            "warning[not-in-binary]: `Cube.bevel`",
        ),
        ("v1.wrl -o f.iv --binary", 2, "VRML has no binary form"),
        ("short.iv --binary", 2, "--binary is for Inventor outputs"),
    ] {
        let run = place.run(args);
        assert_eq!(run.code, code, "{args}: {}", run.err);
        assert!(run.err.contains(needle), "{args}: {}", run.err);
    }
    let read = |name| std::fs::read(place.path(name)).unwrap();
    assert!(read("b.iv").starts_with(b"#Inventor V2.1 binary"));
    let text = String::from_utf8(read("c.iv")).unwrap();
    assert!(text.contains("width 0.1\n"), "{text}");
}

#[test]
fn folders_are_searched_for_packed_models_too() {
    let plain = model(CUBE);
    let names = [
        "a.iv", "b.IVX", "c.ivl", "d.wrl", "e.vrml", "f.iv.gz", "g.wrz", "h.iv.bz2",
    ];
    let mut place = Place::new().file("m/notes.txt", "").file("m/x.gz", "");
    for name in names {
        place = place.bytes(&format!("m/{name}"), &plain);
    }
    let archive = zip(&[("a.iv", &plain)], None);
    place = place.bytes("m/i.ivz", &archive).bytes("m/j.ivzl", &archive);
    let run = place.run("m --out-dir out");
    assert_eq!(run.code, 0, "{}", run.err);
    let names = place.names();
    let outputs: Vec<_> = names
        .iter()
        .filter(|name| name.starts_with("out/"))
        .collect();
    let wanted: Vec<String> = ('a'..='j').map(|c| format!("out/{c}.glb")).collect();
    assert_eq!(outputs, wanted.iter().collect::<Vec<_>>());
}
