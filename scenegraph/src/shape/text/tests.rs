//! Letters against the font's own outlines, by formulas that share nothing with the code: areas by
//! Green's theorem over the curves, volumes by the divergence theorem over the mesh.

use std::collections::BTreeMap;
use std::path::Path;

use glam::{DVec2, DVec3};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

use super::layout::{Justify, Layout, Line, Placed, place};
use crate::scene::{Mesh, Scene};
use crate::{AddedFont, FileLoader, ResolveOptions, load, resolve};

/// All that a model says, resolved, and the codes of all remarks.
fn resolved(body: &str) -> (Scene, Vec<&'static str>) {
    let text = format!("#Inventor V2.1 ascii\n{body}");
    let graph = load(
        text.as_bytes(),
        "test.iv",
        Path::new(""),
        &FileLoader::new([]),
    );
    let resolved = resolve(&graph, &ResolveOptions::default());
    let all = graph.diagnostics.iter().chain(&resolved.diagnostics);
    let codes = all.map(|d| d.code).collect();
    (resolved.scene, codes)
}

fn mesh_of(body: &str) -> Mesh {
    let (mut scene, _) = resolved(body);
    assert_eq!(scene.meshes.len(), 1, "{body}");
    scene.meshes.swap_remove(0)
}

fn triangles(mesh: &Mesh) -> impl Iterator<Item = [u32; 3]> + '_ {
    mesh.indices.as_chunks::<3>().0.iter().copied()
}

fn corners(mesh: &Mesh, triangle: [u32; 3]) -> [DVec3; 3] {
    triangle.map(|i| mesh.p_in_local(i))
}

fn area(mesh: &Mesh) -> f64 {
    let double = triangles(mesh).map(|t| {
        let [a, b, c] = corners(mesh, t);
        (b - a).cross(c - a).length()
    });
    double.sum::<f64>() / 2.0
}

fn volume(mesh: &Mesh) -> f64 {
    let six = triangles(mesh).map(|t| {
        let [a, b, c] = corners(mesh, t);
        a.dot(b.cross(c))
    });
    six.sum::<f64>() / 6.0
}

/// The area within an outline without overlaps, and the length of its border at most.
#[derive(Default)]
struct Exact {
    first: DVec2,
    last: DVec2,
    area: f64,
    length: f64,
}

impl Exact {
    fn to(&mut self, control: DVec2, p: DVec2) {
        // Green's theorem over a quadratic: its chord, and two thirds of its control triangle.
        let chord = self.last.perp_dot(p) / 2.0;
        let bulge = (control - self.last).perp_dot(p - self.last) / 3.0;
        self.area += chord + bulge;
        self.length += self.last.distance(control) + control.distance(p);
        self.last = p;
    }
}

impl OutlineBuilder for Exact {
    fn move_to(&mut self, x: f32, y: f32) {
        self.first = DVec2::new(x.into(), y.into());
        self.last = self.first;
    }
    fn line_to(&mut self, x: f32, y: f32) {
        let p = DVec2::new(x.into(), y.into());
        self.to((self.last + p) / 2.0, p);
    }
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.to(
            DVec2::new(x1.into(), y1.into()),
            DVec2::new(x.into(), y.into()),
        );
    }
    fn curve_to(&mut self, _: f32, _: f32, _: f32, _: f32, _: f32, _: f32) {
        panic!("a TrueType font has no cubics");
    }
    fn close(&mut self) {
        let first = self.first;
        self.to((self.last + first) / 2.0, first);
    }
}

/// Area and length of border of a glyph at size 1, and how far it leads.
fn exact(font: &[u8], c: char) -> (f64, f64, f64) {
    let face = Face::parse(font, 0).unwrap();
    let units = f64::from(face.units_per_em());
    let id = face.glyph_index(c).unwrap_or(GlyphId(0));
    let mut exact = Exact::default();
    face.outline_glyph(id, &mut exact);
    let advance = f64::from(face.glyph_hor_advance(id).unwrap()) / units;
    (
        exact.area.abs() / (units * units),
        exact.length / units,
        advance,
    )
}

#[test]
fn letters_cover_what_their_outlines_do() {
    let rows: [(&str, &[u8], &str); 4] = [
        ("Helvetica", dejavu::sans::regular(), "IHLOoQ8&i"),
        ("Times-Bold", dejavu::serif::bold(), "IHLOoQ8&i"),
        ("Courier", dejavu::sans_mono::regular(), "IHLOoQ8i"),
        ("Helvetica-Oblique", dejavu::sans::regular(), "IHLOoQ8&i"),
    ];
    for (name, font, letters) in rows {
        for c in letters.chars() {
            for (complexity, tolerance) in [(0.0, 0.02), (0.5, 0.02 / 9.0), (1.0, 0.02 / 25.0)] {
                let size = 7.0;
                let mesh = mesh_of(&format!(
                    "Complexity {{ value {complexity} }} Font {{ name \"{name}\" size {size} }} \
                     AsciiText {{ string \"{c}\" }}"
                ));
                let (wanted, length, _) = exact(font, c);
                let got = area(&mesh) / (size * size);
                // Straight letters have no error but that of storing f32.
                let bound = if "IHL".contains(c) {
                    0.0
                } else {
                    length * tolerance
                };
                let error = (got - wanted).abs();
                assert!(
                    error <= bound + 1e-6,
                    "{name} {c} {complexity}: {got} for {wanted}"
                );
            }
        }
    }
}

/// Every edge of a triangle, by the places of its ends, has as many opposites.
fn assert_closed(mesh: &Mesh, what: &str) {
    let key = |i: u32| mesh.positions[i as usize].map(f32::to_bits);
    let mut edges: BTreeMap<_, i32> = BTreeMap::new();
    for [a, b, c] in triangles(mesh) {
        for (a, b) in [(a, b), (b, c), (c, a)] {
            *edges.entry((key(a), key(b))).or_default() += 1;
            *edges.entry((key(b), key(a))).or_default() -= 1;
        }
    }
    let open = edges.values().filter(|&&n| n != 0).count();
    assert_eq!(open, 0, "{what}: edges without an opposite");
}

/// Printable characters of European scripts and mathematics.
fn alphabet() -> String {
    let ranges = [
        0x21..0x7f,
        0xa1..0x180,
        0x370..0x400,
        0x400..0x460,
        0x2190..0x2300,
    ];
    let quoted = |c: &char| !matches!(c, '"' | '\\');
    ranges
        .into_iter()
        .flatten()
        .filter_map(char::from_u32)
        .filter(quoted)
        .collect()
}

const FONTS: [&str; 6] = [
    "Helvetica",
    "Helvetica-BoldOblique",
    "Times-Roman",
    "Times-BoldItalic",
    "Courier",
    "Courier-Bold",
];

#[test]
fn solid_letters_are_closed_and_as_deep_as_the_profile() {
    let bevel = "ProfileCoordinate2 { point [ 0 0, 0.1 0.1, 0.9 0.1, 1 0 ] } \
                 LinearProfile { index [ 0, 1, 2, 3 ] }";
    let shifted = "ProfileCoordinate2 { point [ 2 0, 5 0 ] } LinearProfile { index [ 0, 1 ] }";
    let backward = "ProfileCoordinate2 { point [ 0 0, -3 0 ] } LinearProfile { index [ 0, 1 ] }";
    let weighted = "ProfileCoordinate3 { point [ 0 0 1, 6 0 2 ] } LinearProfile { index [ 0, 1 ] }";
    let alphabet = alphabet();
    for font in FONTS {
        let font = format!("Font {{ name \"{font}\" size 10 }}");
        let flat = mesh_of(&format!("{font} AsciiText {{ string \"{alphabet}\" }}"));
        for (name, profile, front, back) in [
            ("none", "", 0.0, -1.0),
            ("bevel", bevel, 0.0, -1.0),
            ("shifted", shifted, -2.0, -5.0),
            ("backward", backward, 3.0, 0.0),
            ("weighted", weighted, 0.0, -3.0),
        ] {
            // The profiles are the same for all fonts.
            if name != "none" && !font.contains("Times-Roman") {
                continue;
            }
            let what = format!("{font} {name}");
            let text = format!("{font} {profile} Text3 {{ string \"{alphabet}\" parts ALL }}");
            let mesh = mesh_of(&text);
            assert_closed(&mesh, &what);
            let z = |f: fn(f64, f64) -> f64, from: f64| {
                let depths = mesh.positions.iter().map(|p| f64::from(p[2]));
                depths.fold(from, f)
            };
            let (low, high) = (z(f64::min, f64::MAX), z(f64::max, f64::MIN));
            assert_eq!((high, low), (front, back), "{what}");
            if name != "bevel" {
                let wanted = area(&flat) * (front - back);
                let error = (volume(&mesh) - wanted).abs() / wanted;
                assert!(error < 1e-5, "{what}: {error}");
            }
        }
    }
}

#[test]
fn a_bevelled_box_has_its_volume() {
    // The letter I of this font is a rectangle.
    let flat = mesh_of("Font { size 10 } AsciiText { string \"I\" }");
    let size = |axis: usize| {
        let along = flat.positions.iter().map(|p| f64::from(p[axis]));
        along.clone().fold(f64::MIN, f64::max) - along.fold(f64::MAX, f64::min)
    };
    let (w, h, b) = (size(0), size(1), 0.25);
    let mesh = mesh_of(
        "Font { size 10 } ProfileCoordinate2 { point [ 0 0, 0.25 0.25, 1.25 0.25, 1.5 0 ] } \
         LinearProfile { index [ 0, 1, 2, 3 ] } Text3 { string \"I\" parts ALL }",
    );
    let (wide, high) = (w + 2.0 * b, h + 2.0 * b);
    let middle = (w + wide) / 2.0 * (h + high) / 2.0;
    // Simpson's rule is exact for a frustum.
    let frustum = b / 6.0 * (w * h + 4.0 * middle + wide * high);
    let wanted = 2.0 * frustum + wide * high;
    assert!(
        (volume(&mesh) - wanted).abs() < 1e-5,
        "{} {wanted}",
        volume(&mesh)
    );
}

#[test]
fn normals_agree_with_the_triangles() {
    for profile in [
        "",
        "ProfileCoordinate2 { point [ 0 0, 0.1 0.1, 0.9 0.1, 1 0 ] } \
         LinearProfile { index [ 0, 1, 2, 3 ] }",
    ] {
        let mesh = mesh_of(&format!(
            "{profile} Font {{ size 60 }} Text3 {{ string \"abcdefgOQ8&@\" parts ALL }}"
        ));
        for t in triangles(&mesh) {
            let [a, b, c] = corners(&mesh, t);
            let face = (b - a).cross(c - a).normalize();
            for i in t {
                let normal = DVec3::from(mesh.normals[i as usize].map(f64::from));
                // Chords of equal parameter turn by 45 degrees or so, unevenly.
                assert!(normal.dot(face) > 0.6, "{normal} on a face of {face}");
            }
        }
    }
}

#[test]
fn curved_sides_are_smooth_and_corners_are_not() {
    // O has no corner: each place on its sides has one normal. H has corners only.
    for (letter, normals_each) in [("O", 1), ("H", 2)] {
        let text = format!("Text3 {{ string \"{letter}\" parts SIDES }}");
        let mesh = mesh_of(&format!("Font {{ size 10 }} {text}"));
        let mut seen: BTreeMap<_, Vec<[f32; 3]>> = BTreeMap::new();
        for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
            let list = seen.entry(p.map(f32::to_bits)).or_default();
            if !list.contains(n) {
                list.push(*n);
            }
        }
        assert!(seen.values().all(|l| l.len() == normals_each), "{letter}");
    }
}

#[test]
fn lines_are_set_by_justification_and_spacing() {
    let bounds = |justification: &str, spacing: f64| {
        let mesh = mesh_of(&format!(
            "Font {{ name \"Courier\" size 4 }} AsciiText {{ string [ \"HH\", \"\", \"H\" ] \
             justification {justification} spacing {spacing} }}"
        ));
        let along = |axis: usize, f: fn(f64, f64) -> f64, from: f64| {
            mesh.positions
                .iter()
                .map(|p| f64::from(p[axis]))
                .fold(from, f)
        };
        [
            along(0, f64::min, f64::MAX),
            along(0, f64::max, f64::MIN),
            along(1, f64::min, f64::MAX),
            along(1, f64::max, f64::MIN),
        ]
    };
    let (_, _, advance) = exact(dejavu::sans_mono::regular(), 'H');
    let width = 2.0 * 4.0 * advance;
    let left = bounds("LEFT", 1.0);
    for (word, shift) in [("CENTER", -width / 2.0), ("RIGHT", -width)] {
        let got = bounds(word, 1.0);
        // The single H of the last line lies within the first one.
        assert!(
            (got[0] - left[0] - shift).abs() < 1e-5,
            "{word}: {got:?} {left:?}"
        );
        assert!(
            (got[1] - left[1] - shift).abs() < 1e-5,
            "{word}: {got:?} {left:?}"
        );
    }
    assert!(left[0] > 0.0 && left[1] < width);
    // Two lines down at once the size, each.
    assert!((left[2] + 8.0).abs() < 1e-5, "{left:?}");
    assert!((bounds("LEFT", 1.5)[2] + 12.0).abs() < 1e-5);
}

#[test]
fn vrml_layouts_place_lines_and_columns() {
    let line = |n: usize| Line {
        glyphs: vec![(1, 0.5); n],
        length: 0.0,
    };
    let lines = [line(2), line(4)];
    let base = Layout::rows(10.0, 1.0, Justify::Begin);
    let first_of_each = |layout: &Layout| {
        let placed = place(&lines, layout);
        [placed[0].at, placed[2].at].map(|p| [p.x, p.y])
    };
    let rows = [
        ("rows", base, [[0.0, 0.0], [0.0, -10.0]]),
        (
            "upward",
            Layout {
                top_to_bottom: false,
                ..base
            },
            [[0.0, 0.0], [0.0, 10.0]],
        ),
        (
            "leftward",
            Layout {
                left_to_right: false,
                ..base
            },
            [[-5.0, 0.0], [-5.0, -10.0]],
        ),
        (
            "middle",
            Layout {
                major: Justify::Middle,
                ..base
            },
            [[-5.0, 0.0], [-10.0, -10.0]],
        ),
        (
            "below",
            Layout {
                minor: Justify::Begin,
                ..base
            },
            [[0.0, -8.0], [0.0, -18.0]],
        ),
        (
            "above",
            Layout {
                minor: Justify::End,
                ..base
            },
            [[0.0, 12.0], [0.0, 2.0]],
        ),
        (
            "columns",
            Layout {
                horizontal: false,
                ..base
            },
            [[-2.5, -8.0], [7.5, -8.0]],
        ),
        (
            "limited",
            Layout {
                max_extent: 10.0,
                major: Justify::End,
                ..base
            },
            [[-5.0, 0.0], [-10.0, -10.0]],
        ),
    ];
    for (name, layout, wanted) in rows {
        assert_eq!(first_of_each(&layout), wanted, "{name}");
    }
    let stretched = Line {
        length: 30.0,
        ..line(2)
    };
    let placed = place(&[stretched], &base);
    let wanted = Placed {
        glyph: 1,
        at: DVec2::new(15.0, 0.0),
        scale: DVec2::new(30.0, 10.0),
    };
    assert_eq!(placed[1], wanted);
}

#[test]
fn ascii_text_is_stretched_to_its_width() {
    for (width, wanted) in [
        ("0", 1.0),
        ("[ 40 ]", 40.0),
        ("[ 0, 40 ]", 1.0),
        ("-5", 1.0),
    ] {
        let get = |width: &str| {
            let text = format!("AsciiText {{ string \"HHHH\" width {width} }}");
            let mesh = mesh_of(&format!("Font {{ name \"Courier\" size 4 }} {text}"));
            mesh.positions
                .iter()
                .map(|p| f64::from(p[0]))
                .fold(f64::MIN, f64::max)
        };
        let (_, _, advance) = exact(dejavu::sans_mono::regular(), 'H');
        let factor = if wanted == 1.0 {
            1.0
        } else {
            wanted / (4.0 * 4.0 * advance)
        };
        assert!((get(width) - get("0") * factor).abs() < 1e-4, "{width}");
    }
}

#[test]
fn parts_have_their_colours() {
    let (scene, _) = resolved(
        "Material { diffuseColor [ 1 0 0, 0 1 0, 0 0 1 ] } MaterialBinding { value PER_PART } \
         Text3 { string \"H\" parts ALL }",
    );
    let mesh = &scene.meshes[0];
    for (n, c) in mesh.normals.iter().zip(&mesh.colors_srgb) {
        let wanted = match n[2] {
            1.0 => [1.0, 0.0, 0.0, 1.0],
            -1.0 => [0.0, 0.0, 1.0, 1.0],
            _ => [0.0, 1.0, 0.0, 1.0],
        };
        assert_eq!(*c, wanted, "normal {n:?}");
    }
}

#[test]
fn what_cannot_be_drawn_is_said() {
    let long = "x".repeat(super::MAX_CHARACTERS + 1);
    let rows: [(&str, &str, usize, &[&str]); 12] = [
        ("nothing", "Text3 {}", 0, &[]),
        ("empty", "AsciiText { string \"\" }", 0, &[]),
        ("empty lines", "Text2 { string [ \"\", \"\" ] }", 0, &[]),
        ("blanks", "AsciiText { string \"   \" }", 0, &[]),
        (
            "no size",
            "Font { size 0 } AsciiText { string \"a\" }",
            0,
            &["font-size"],
        ),
        ("no parts", "Text3 { string \"a\" parts () }", 0, &[]),
        ("a box", "AsciiText { string \"日本\" }", 1, &["no-glyph"]),
        (
            "a name",
            "Font { name \"Utopia\" } AsciiText { string \"a\" }",
            1,
            &["font-substituted"],
        ),
        (
            "no name",
            "Font { name \"defaultFont\" } AsciiText { string \"a\" }",
            1,
            &[],
        ),
        (
            "families",
            "FontStyle { family SANS style BOLD } AsciiText { string \"a\" }",
            1,
            &[],
        ),
        (
            "control characters",
            "AsciiText { string \"a\tb\u{1}\" }",
            1,
            &[],
        ),
        (
            "long",
            &format!("AsciiText {{ string \"{long}\" }}"),
            1,
            &["long-text"],
        ),
    ];
    for (name, body, meshes, wanted) in rows {
        let (scene, codes) = resolved(body);
        assert_eq!(scene.meshes.len(), meshes, "{name}");
        assert_eq!(codes, wanted, "{name}");
        assert_eq!(scene.texts.len(), meshes, "{name}");
    }
}

#[test]
fn old_files_may_be_latin_1() {
    let get = |bytes: &[u8]| {
        let graph = load(bytes, "test.iv", Path::new(""), &FileLoader::new([]));
        let scene = resolve(&graph, &ResolveOptions::default()).scene;
        (
            scene.texts[0].strings[0].to_string(),
            scene.meshes[0].positions.clone(),
        )
    };
    let latin = get(b"#Inventor V2.0 ascii\nAsciiText { string \"Gr\xfc\xdfe\" }");
    let utf8 = get("#Inventor V2.1 ascii\nAsciiText { string \"Grüße\" }".as_bytes());
    assert_eq!(latin.0, "Grüße");
    assert_eq!(latin, utf8);
}

#[test]
fn added_fonts_are_used_by_name() {
    let text = "#Inventor V2.1 ascii\nFont { name \"Utopia\" } AsciiText { string \"agf\" }";
    let mut graph = load(text.as_bytes(), "t.iv", Path::new(""), &FileLoader::new([]));
    let before = resolve(&graph, &ResolveOptions::default());
    assert_eq!(before.diagnostics.len(), 1);
    assert!(AddedFont::new("Utopia", b"no font".as_slice().into(), 0).is_none());
    let bytes = dejavu::sans_mono::bold();
    graph
        .fonts
        .extend(AddedFont::new("Utopia", bytes.into(), 0));
    let after = resolve(&graph, &ResolveOptions::default());
    assert_eq!(after.diagnostics.len(), 0);
    let mono = mesh_of("Font { name \"Courier-Bold\" } AsciiText { string \"agf\" }");
    assert_eq!(after.scene.meshes[0].positions, mono.positions);
    assert_ne!(before.scene.meshes[0].positions, mono.positions);
}

#[test]
fn screen_text_has_the_size_of_one_view() {
    // Corners of a box with a diagonal of 600: a pixel is 1 without a camera.
    let points = "Separator { Coordinate3 { point [ -100 -200 -200, 100 200 200 ] } PointSet {} }";
    let label = "Text2 { string \"H\" }";
    let eye = "position 0 0 1000 nearDistance 1 farDistance 2000";
    let rows = [
        ("whole scene", format!("{points} {label}"), 1.0, DVec3::X),
        ("no scene", label.to_owned(), 1.0 / 600.0, DVec3::X),
        (
            "its own frame does not count",
            format!("{points} Transform {{ rotation 0 1 0 1 scaleFactor 2 3 4 }} {label}"),
            1.0,
            DVec3::X,
        ),
        (
            "one unit high in a thousand",
            format!("OrthographicCamera {{ {eye} height 900 }} {points} {label}"),
            1.5,
            DVec3::X,
        ),
        (
            "perspective",
            format!("PerspectiveCamera {{ {eye} heightAngle 0.6 }} {points} {label}"),
            2000.0 * 0.3_f64.tan() / 600.0,
            DVec3::X,
        ),
        (
            "behind the camera",
            format!("PerspectiveCamera {{ position 0 0 -1000 }} {points} {label}"),
            1.0,
            DVec3::X,
        ),
        (
            "upside down",
            format!(
                "OrthographicCamera {{ {eye} orientation 0 0 1 3.14159265358979 height 600 }} \
                 {points} {label}"
            ),
            1.0,
            DVec3::NEG_X,
        ),
        (
            "not tiny",
            format!("OrthographicCamera {{ {eye} height 1e-6 }} {points} {label}"),
            600.0 / 5000.0,
            DVec3::X,
        ),
        (
            "not huge",
            format!("OrthographicCamera {{ {eye} height 1e9 }} {points} {label}"),
            600.0 / 200.0,
            DVec3::X,
        ),
        (
            "flat frame",
            format!("{points} Scale {{ scaleFactor 1 0 1 }} {label}"),
            1.0,
            DVec3::X,
        ),
    ];
    for (name, body, pixel, right) in rows {
        let (scene, _) = resolved(&format!("Separator {{ {body} }}"));
        let text = scene.texts.first().unwrap();
        assert!(text.faces_viewer);
        let placement = &scene.instances[text.instance as usize].placement;
        let got = placement.world_from_local.matrix3;
        let error = (got.x_axis - right * pixel).length() + (got.y_axis.length() - pixel).abs();
        assert!(error < 1e-9 * pixel, "{name}: {got}, not {pixel}");
        assert_eq!(scene.check(), [], "{name}");
    }
}

#[test]
fn vrml_text_has_its_own_font_style() {
    let vrml = |text: &str| {
        let text = format!("#VRML V2.0 utf8\nShape {{ geometry Text {{ {text} }} }}");
        let graph = load(
            text.as_bytes(),
            "t.wrl",
            Path::new(""),
            &FileLoader::new([]),
        );
        let mut resolved = resolve(&graph, &ResolveOptions::default());
        let codes: Vec<_> = resolved.diagnostics.iter().map(|d| d.code).collect();
        (resolved.scene.meshes.pop().map(|m| m.positions), codes)
    };
    let inventor = |text: &str| Some(mesh_of(text).positions);
    let rows: [(&str, &str, &[&str]); 6] = [
        (
            "string \"Ag\"",
            "FontStyle { size 1 } AsciiText { string \"Ag\" }",
            &[],
        ),
        (
            "string \"Ag\" fontStyle FontStyle { size 3 family \"TYPEWRITER\" style \"BOLD\" }",
            "Font { name \"Courier-Bold\" size 3 } AsciiText { string \"Ag\" }",
            &[],
        ),
        (
            "string [ \"A\", \"g\" ] fontStyle FontStyle { justify \"MIDDLE\" spacing 2 }",
            "FontStyle { size 1 } AsciiText { string [ \"A\", \"g\" ] spacing 2 \
             justification CENTER }",
            &[],
        ),
        (
            "string \"Ag\" length 5",
            "FontStyle { size 1 } AsciiText { string \"Ag\" width 5 }",
            &[],
        ),
        (
            "string \"Ag\" fontStyle FontStyle { family [ \"Unknown\", \"SANS\" ] }",
            "FontStyle { size 1 family SANS } AsciiText { string \"Ag\" }",
            &[],
        ),
        (
            "string \"Ag\" fontStyle FontStyle { family \"Unknown\" }",
            "FontStyle { size 1 family SANS } AsciiText { string \"Ag\" }",
            &["font-substituted"],
        ),
    ];
    for (text, same, codes) in rows {
        assert_eq!(vrml(text), (inventor(same), codes.to_vec()), "{text}");
    }
}
