//! Files that ask for too much, each with the code of the diagnostic that says so.

/// A file made to exhaust something.
pub struct Hostile {
    /// What it tries.
    pub name: &'static str,
    /// Its text.
    pub make: fn() -> Vec<u8>,
    /// A code that must be among the diagnostics; empty when it is a good file.
    pub code: &'static str,
}

const fn hostile(name: &'static str, make: fn() -> Vec<u8>, code: &'static str) -> Hostile {
    Hostile { name, make, code }
}

/// All of them.
pub const ALL: &[Hostile] = &[
    hostile("100,000 nested Separators", nested, "too-deep"),
    hostile("100,000 nested lists of nodes", nested_fields, "too-deep"),
    hostile(
        "a node that uses itself",
        || iv("DEF A Separator { USE A Cube { } }"),
        "cycle",
    ),
    hostile("2^30 copies by sharing", shared, "too-many-items"),
    hostile(
        "2^30 copies of nothing",
        || shared_leaf(""),
        "too-many-nodes",
    ),
    hostile("a billion billion array elements", arrays, "too-many-items"),
    hostile("a billion copies of nothing", empty_array, "too-many-nodes"),
    hostile("copies of no child at all", childless_array, ""),
    hostile(
        "a billion vertices",
        || iv("Coordinate3 { point [0 0 0, 1 0 0, 0 1 0] } FaceSet { numVertices 1000000000 }"),
        "short-coordinates",
    ),
    hostile(
        "2^31 - 1 rows and columns",
        || {
            iv(
                "Coordinate3 { point [0 0 0, 1 0 0, 0 1 0, 1 1 0] } QuadMesh { verticesPerRow 2147483647 verticesPerColumn 2147483647 }",
            )
        },
        "short-coordinates",
    ),
    hostile(
        "2^31 - 1 rows of one",
        || {
            iv(
                "Coordinate3 { point [0 0 0, 1 0 0, 0 1 0, 1 1 0] } QuadMesh { verticesPerRow 1 verticesPerColumn 2147483647 }",
            )
        },
        "short-coordinates",
    ),
    hostile(
        "a huge first coordinate",
        || {
            iv(
                "Coordinate3 { point [0 0 0, 1 0 0, 0 1 0] } FaceSet { startIndex 2147483647 numVertices 3 }",
            )
        },
        "short-coordinates",
    ),
    hostile(
        "an image of 17 GB",
        || iv("Texture2 { image 65535 65535 4 0xff 0xff } Cube { }"),
        "too-few-pixels",
    ),
    hostile(
        "an image of negative size",
        || iv("Texture2 { image -1 -65535 4 0xff } Cube { }"),
        "wrong-type",
    ),
    hostile(
        "huge coordinate indices",
        || {
            iv(
                "Coordinate3 { point [0 0 0, 1 0 0, 0 1 0] } IndexedFaceSet { coordIndex [0, 1, 2147483647, -1, 2147483646, 1, 2, -1] }",
            )
        },
        "bad-index",
    ),
    hostile(
        "a file that includes itself",
        || iv("File { name \"input.iv\" }"),
        "include",
    ),
    hostile(
        "an identifier of five megabytes",
        || [iv("DEF "), vec![b'a'; 5 << 20], b" Cube { }".to_vec()].concat(),
        "",
    ),
    hostile(
        "a class name of five megabytes",
        || [iv(""), vec![b'a'; 5 << 20], b" { }".to_vec()].concat(),
        "unknown-class",
    ),
    hostile(
        "a string of five megabytes",
        || {
            [
                iv("Info { string \""),
                vec![b'a'; 5 << 20],
                b"\" } Cube { }".to_vec(),
            ]
            .concat()
        },
        "",
    ),
    hostile(
        "a string without end",
        || iv("Separator { Info { string \"abc } Cube { } }"),
        "unclosed-string",
    ),
    hostile(
        "a list without end",
        || iv("Separator { Coordinate3 { point [ 0 0 0, 1 1 1"),
        "missing-bracket",
    ),
    hostile(
        "a body without end",
        || iv("Separator { Cube { width 3"),
        "missing-brace",
    ),
    hostile(
        "a mask without end",
        || iv("Separator { Cone { parts ( SIDES | "),
        "missing-paren",
    ),
    hostile(
        "a megabyte of opening brackets",
        || repeated("["),
        "not-a-node",
    ),
    hostile(
        "a megabyte of opening brackets in a list",
        || [iv("Coordinate3 { point "), b"[".repeat(1 << 20)].concat(),
        "bad-value",
    ),
    hostile("a megabyte of opening braces", || repeated("{"), "too-deep"),
    hostile(
        "a megabyte of closing braces",
        || repeated("}"),
        "extra-brace",
    ),
    hostile("a megabyte of DEF", || repeated("DEF "), "bad-def"),
    hostile("a megabyte of USE", || repeated("USE "), "unknown-name"),
    hostile("a megabyte of parentheses", || repeated("("), "not-a-node"),
    hostile(
        "a megabyte of parentheses in a mask",
        || [iv("Cone { parts "), b"(".repeat(1 << 20)].concat(),
        "missing-paren",
    ),
    hostile("a megabyte of quotes", || repeated("\""), "not-a-node"),
    hostile(
        "a megabyte of commas in a list",
        || [iv("Coordinate3 { point ["), b",".repeat(1 << 20)].concat(),
        "stray-comma",
    ),
    hostile(
        "a megabyte of connections",
        || [iv("Cube { width "), b"= Cube { } . a ".repeat(60_000)].concat(),
        "stray-value",
    ),
    hostile(
        "a megabyte of nested field descriptions",
        || [iv("X { fields "), b"[".repeat(1 << 20)].concat(),
        "bad-value",
    ),
    hostile("one polygon with 200,000 corners", polygon, ""),
    hostile("one star with 200,000 corners", star, ""),
    hostile("one scribble with 20,000 corners", scribble, "hard-polygon"),
    hostile("200,000 faces around one vertex", fan, ""),
    hostile(
        "50,000 lights",
        || iv(&"PointLight { } ".repeat(50_000)),
        "",
    ),
    hostile("2,000 lights over 2,000 shapes", lights, ""),
    hostile(
        "10,000 lights over 10,000 shapes",
        more_lights,
        "too-many-lights",
    ),
    hostile("30,000 materials", materials, ""),
    hostile("30,000 environments", environments, ""),
    hostile("30,000 textures", textures, ""),
    hostile("40,000 names with a brace", odd_names, "hidden"),
    hostile("5,000 levels by sharing", shared_levels, "too-deep"),
];

fn iv(text: &str) -> Vec<u8> {
    format!("#Inventor V2.1 ascii\n{text}").into_bytes()
}

fn repeated(token: &str) -> Vec<u8> {
    iv(&token.repeat((1 << 20) / token.len()))
}

fn nested() -> Vec<u8> {
    iv(&format!(
        "{}Cube {{ }}{}",
        "Separator { ".repeat(100_000),
        " }".repeat(100_000)
    ))
}

fn nested_fields() -> Vec<u8> {
    let open = "Gizmo { fields [ MFNode kids ] kids [ ".repeat(100_000);
    iv(&format!("{open}Cube {{ }}{}", " ] }".repeat(100_000)))
}

/// 30 groups, each holding the one before twice.
fn shared() -> Vec<u8> {
    shared_leaf("Cube { }")
}

fn shared_leaf(leaf: &str) -> Vec<u8> {
    let mut text = format!("Switch {{ DEF L0 Group {{ {leaf} }} ");
    for level in 1..=30 {
        let below = level - 1;
        text += &format!("DEF L{level} Group {{ USE L{below} USE L{below} }} ");
    }
    iv(&(text + "} USE L30"))
}

fn arrays() -> Vec<u8> {
    let counts = "numElements1 32767 numElements2 32767 numElements3 32767";
    iv(&format!(
        "Array {{ {counts} Array {{ {counts} Cube {{ }} }} }}"
    ))
}

fn empty_array() -> Vec<u8> {
    iv("Array { numElements1 32767 numElements2 32767 numElements3 32767 Group { } }")
}

fn childless_array() -> Vec<u8> {
    iv("Array { numElements1 2147483647 numElements2 2147483647 numElements3 2147483647 }")
}

const CORNERS: usize = 200_000;

fn face_of(points: impl Iterator<Item = (f64, f64)>) -> Vec<u8> {
    let points: Vec<String> = points.map(|(x, y)| format!("{x} {y} 0")).collect();
    let list = points.join(", ");
    iv(&format!("Coordinate3 {{ point [ {list} ] }} FaceSet {{ }}"))
}

fn on_circle(i: usize, n: usize, radius: f64) -> (f64, f64) {
    let (sin, cos) = (i as f64 / n as f64 * std::f64::consts::TAU).sin_cos();
    (radius * cos, radius * sin)
}

fn polygon() -> Vec<u8> {
    face_of((0..CORNERS).map(|i| on_circle(i, CORNERS, 1000.0)))
}

/// Every second corner lies inwards: as many inner corners as outer ones.
fn star() -> Vec<u8> {
    let radius = |i: usize| if i.is_multiple_of(2) { 1000.0 } else { 500.0 };
    face_of((0..CORNERS).map(|i| on_circle(i, CORNERS, radius(i))))
}

fn scribble() -> Vec<u8> {
    let mut rng = crate::mutate::Rng::new(3);
    let mut number = move || rng.below(1000) as f64;
    let points: Vec<_> = (0..20_000).map(|_| (number(), number())).collect();
    face_of(points.into_iter())
}

fn fan() -> Vec<u8> {
    let mut text = String::from("ShapeHints { creaseAngle 0.5 } Coordinate3 { point [ 0 0 1");
    for i in 0..CORNERS {
        let (x, y) = on_circle(i, CORNERS, 1.0);
        // Uneven heights give every face a normal of its own.
        text += &format!(", {x} {y} {}", (i % 97) as f64 * 1e-3);
    }
    text += " ] } IndexedFaceSet { coordIndex [ ";
    for i in 1..CORNERS {
        text += &format!("0, {i}, {}, -1, ", i + 1);
    }
    iv(&(text + "] }"))
}

fn lights() -> Vec<u8> {
    iv(&"PointLight { } Cube { } ".repeat(2_000))
}

fn materials() -> Vec<u8> {
    let mut text = String::new();
    for i in 0..30_000 {
        text += &format!(
            "Material {{ shininess {} }} Cube {{ }} ",
            f64::from(i) / 30_000.0
        );
    }
    iv(&text)
}

fn environments() -> Vec<u8> {
    let one = |i| {
        format!(
            "Environment {{ ambientIntensity {} }} Cube {{ }} ",
            f64::from(i) / 3e4
        )
    };
    iv(&(0..30_000).map(one).collect::<String>())
}

fn textures() -> Vec<u8> {
    let one = |i| format!("Texture2 {{ image 1 1 1 {} }} Cube {{ }} ", i % 256);
    iv(&(0..30_000).map(one).collect::<String>())
}

/// Flat in the file, deep in the scene.
fn shared_levels() -> Vec<u8> {
    let one = |i| format!("DEF L{} Group {{ USE L{i} }} ", i + 1);
    let levels: String = (0..5_000).map(one).collect();
    iv(&format!(
        "Switch {{ DEF L0 Cube {{ }} {levels} }} USE L5000"
    ))
}

/// Each is a name for Coin, which ends names at blanks only.
fn odd_names() -> Vec<u8> {
    let one = |i| format!("DEF n{i}{{ Cube {{ }} ");
    let again = |i| format!("USE n{i}{{ ");
    let all: String = (0..40_000).map(one).chain((0..40_000).map(again)).collect();
    iv(&format!("Switch {{ {all} }}"))
}

fn more_lights() -> Vec<u8> {
    iv(&"PointLight { } Cube { } ".repeat(10_000))
}
