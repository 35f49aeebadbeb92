//! Pictures: written whole, the same each time, compared with references.

use viewer::compare::{Tolerance, compare};

use crate::place::{CUBE, Place};

#[test]
fn pictures_have_their_size_and_are_the_same_each_time() {
    let place = Place::new()
        .sample("lights/three_kinds.iv")
        .sample("textures/inline_image.iv")
        .sample("materials/window_panes.iv")
        .glb_of("three_kinds.iv");
    let rows = [
        ("three_kinds.iv", (64, 48)),
        ("three_kinds.iv --msaa 4", (64, 48)),
        ("three_kinds.glb --size 33x20", (33, 20)),
        ("inline_image.iv --size 1x1", (1, 1)),
        ("window_panes.iv --size 20x70", (20, 70)),
    ];
    for (args, size) in rows {
        let run = place.run(&format!("{args} -o a.png"));
        assert_eq!(run.code, 0, "{args}: {}", run.err);
        let bytes = place.bytes("a.png");
        assert!(bytes.starts_with(b"\x89PNG\r\n\x1a\n"), "{args}");
        assert_eq!(place.picture("a.png").dimensions(), size, "{args}");
        place.run(&format!("{args} -o new/b.png"));
        assert!(bytes == place.bytes("new/b.png"), "{args}");
    }
    let names = place.names();
    assert!(names.iter().all(|name| !name.starts_with('.')), "{names:?}");
}

#[test]
fn a_converted_model_looks_like_its_source() {
    for path in [
        "pavilion.iv",
        "lights/cameras.iv",
        "lights/three_kinds.iv",
        "materials/roof_per_vertex.iv",
        "structure/flange_bolts.iv",
        "textures/inline_image.iv",
    ] {
        let name = path.rsplit('/').next().unwrap();
        let mut place = Place::new().sample(path);
        for image in ["bricks", "floor_tiles", "roof_tiles"] {
            place = place.sample(&format!("textures/{image}.png"));
        }
        let place = place.glb_of(name);
        let source = place.draw(name);
        let converted = place.draw(&name.replace(".iv", ".glb"));
        let tolerance = Tolerance::default();
        let difference = compare(&source, &converted, tolerance.step).unwrap();
        assert!(difference.is_within(&tolerance), "{path}: {difference}");
        // A picture of nothing would be equal as well.
        let first = source.get_pixel(0, 0);
        assert!(source.pixels().any(|pixel| pixel != first), "{path}");
    }
}

#[test]
fn references_are_compared_with() {
    let place = Place::new().file("cube.iv", CUBE);
    place.run("cube.iv -o right.png");
    place.run("cube.iv -o moved.png --camera 9,9,9,0,0,0,45");
    place.run("cube.iv -o small.png --size 32x24");
    // A step of one at each pixel.
    let mut faint = place.picture("right.png");
    faint.pixels_mut().for_each(|p| p.0[1] += 1);
    faint.save(place.path("faint.png")).unwrap();
    // Options, exit code, whether there is a strip, what the messages contain.
    let rows = [
        ("right.png", 0, false, "as in the reference: 0 of 3072"),
        ("right.png --threshold exact", 0, false, "as in"),
        ("moved.png", 1, true, "differs from moved.png: "),
        ("moved.png --threshold 255,0,0", 0, false, "as in"),
        ("moved.png --threshold 0,100%,3072", 0, false, "as in"),
        ("moved.png --threshold 0,100,9", 1, true, "9 in a blob"),
        ("moved.png --threshold 0,1,3072", 1, true, "1 % of the"),
        ("moved.png -q", 1, true, "a.diff.png"),
        ("faint.png", 0, false, "0 of 3072 pixels differ"),
        ("faint.png --threshold exact", 1, true, "largest step 1"),
        ("small.png", 1, false, "32 x 24 and 64 x 48"),
    ];
    for (options, code, has_strip, message) in rows {
        let run = place.run(&format!("cube.iv -o a.png --reference {options}"));
        assert_eq!(run.code, code, "{options}: {}", run.err);
        assert!(run.err.contains(message), "{options}: {}", run.err);
        assert!(place.path("a.png").exists(), "{options}");
        let strip = place.path("a.diff.png");
        assert_eq!(strip.exists(), has_strip, "{options}");
        if has_strip {
            assert_eq!(place.picture("a.diff.png").dimensions(), (192, 48));
            std::fs::remove_file(strip).unwrap();
        }
    }
}

#[test]
fn options_change_the_picture() {
    let place = Place::new()
        .sample("lights/gate_shadow.iv")
        .file("cube.iv", CUBE);
    // Two sets of options, and whether they give the same picture.
    let rows = [
        (
            "gate_shadow.iv --up y",
            "--shadows volumes",
            "--shadows none",
            false,
        ),
        ("gate_shadow.iv --up y", "", "--shadows volumes", true),
        (
            "gate_shadow.iv --up y",
            "",
            "--shadows volumes-reference",
            true,
        ),
        (
            "gate_shadow.iv --up y",
            "",
            "--shadows volumes-triangles",
            true,
        ),
        ("gate_shadow.iv --up y", "", "--extraction cpu", true),
        ("gate_shadow.iv --up y", "--msaa 1", "--msaa 4", false),
        ("cube.iv", "", "--no-headlight", false),
        ("cube.iv", "", "--background black", true),
        (
            "cube.iv",
            "--background #808080",
            "--background black",
            false,
        ),
        (
            "cube.iv",
            "--background Grey",
            "--background #7f7f7f",
            false,
        ),
        (
            "cube.iv",
            "--background white",
            "--background #FFFFFF",
            true,
        ),
        (
            "cube.iv",
            "--background dark-gray",
            "--background dark-grey",
            true,
        ),
        (
            "cube.iv",
            "--background white,tan",
            "--background tan,white",
            false,
        ),
        ("cube.iv", "--background tan,tan", "--background tan", true),
    ];
    for (model, a, b, same) in rows {
        let (one, other) = [a, b]
            .map(|options| place.draw(&format!("{model} {options}")))
            .into();
        assert_eq!(one == other, same, "{model}: {a}, {b}");
    }
    let picture = place.draw("cube.iv --background #0080ff,griseous");
    let corner = |y| picture.get_pixel(0, y).0;
    // Blue above and bluish grey below, to within a row of the gradient.
    assert!(corner(0)[2] > 250 && corner(0)[0] < 5, "{:?}", corner(0));
    assert!(corner(47)[0].abs_diff(102) < 5, "{:?}", corner(47));
    assert!(corner(47)[2].abs_diff(153) < 5, "{:?}", corner(47));
}
