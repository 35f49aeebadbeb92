//! Large models for the benchmark, made by a program that always writes the same bytes.
//!
//! They are what slow readers are slow at: very many numbers, very many small parts, and very many
//! copies of one part. The samples have no such files because of their size.

mod number;

use std::f64::consts::TAU;
use std::fmt::Write;

use number::Number;

/// A model, and what a reader must find in it.
#[derive(Clone, Debug)]
pub struct Large {
    /// Short file name.
    pub name: &'static str,
    /// Open Inventor V2.1.
    pub text: String,
    /// Triangles drawn.
    pub triangles: usize,
    /// Shapes drawn.
    pub instances: usize,
}

/// How large the models are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    /// Cells of the grid in X and Y, of two triangles each.
    pub grid: [usize; 2],
    /// Parts with coordinates of their own.
    pub parts: usize,
    /// Copies of the one part.
    pub copies: usize,
}

impl Sizes {
    /// A million triangles, 20,000 parts, 5,000 copies.
    pub const FULL: Self = Self {
        grid: [1000, 500],
        parts: 20_000,
        copies: 5000,
    };
}

/// The three models.
pub fn all(sizes: Sizes) -> [Large; 3] {
    [grid(sizes.grid), parts(sizes.parts), copies(sizes.copies)]
}

const HEADER: &str = "#Inventor V2.1 ascii\n\n";
const MATERIALS: usize = 200;
/// Cells of the part that is copied: 2,000 triangles.
const PART: [usize; 2] = [50, 20];

/// One face set with a normal for each of its vertices.
fn grid(cells: [usize; 2]) -> Large {
    let mut out = HEADER.to_owned();
    out.push_str(
        "Separator {\n  ShapeHints { vertexOrdering COUNTERCLOCKWISE }\n  \
         Material { diffuseColor 0.6 0.7 0.4 }\n",
    );
    hills(&mut out, cells);
    out.push_str("}\n");
    Large {
        name: "a_grid.iv",
        text: out,
        triangles: 2 * cells[0] * cells[1],
        instances: 1,
    }
}

/// Small prisms as a CAD program writes them: transform, material, coordinates and faces each.
fn parts(count: usize) -> Large {
    let mut out = HEADER.to_owned();
    out.push_str(
        "Separator {\n  ShapeHints {\n    vertexOrdering COUNTERCLOCKWISE\n    shapeType SOLID\n    \
         creaseAngle 0.5\n  }\n",
    );
    let mut random = Random(1);
    let mut triangles = 0;
    for part in 0..count {
        out.push_str("  Separator {\n");
        transform(&mut out, &mut random, true);
        material(&mut out, &mut random, part);
        triangles += prism(&mut out, &mut random);
        out.push_str("  }\n");
    }
    out.push_str("}\n");
    Large {
        name: "b_parts.iv",
        text: out,
        triangles,
        instances: count,
    }
}

/// One part, copied by `USE`.
fn copies(count: usize) -> Large {
    let mut out = HEADER.to_owned();
    out.push_str("Separator {\n  ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType SOLID }\n");
    let mut random = Random(2);
    for copy in 0..count {
        out.push_str("  Separator {\n");
        transform(&mut out, &mut random, false);
        if copy == 0 {
            out.push_str("    DEF Part Separator {\n");
            hills(&mut out, PART);
            out.push_str("    }\n");
        } else {
            out.push_str("    USE Part\n");
        }
        out.push_str("  }\n");
    }
    out.push_str("}\n");
    Large {
        name: "c_copies.iv",
        text: out,
        triangles: 2 * PART[0] * PART[1] * count,
        instances: count,
    }
}

/// A wavy surface over `cells` of a decimetre.
fn hills(out: &mut String, [columns, rows]: [usize; 2]) {
    let vertices = || {
        let row = move |j| (0..=columns).map(move |i| (0.1 * i as f64, 0.1 * j as f64));
        (0..=rows).flat_map(row)
    };
    out.push_str("    Coordinate3 {\n      point [\n");
    for (x, y) in vertices() {
        let z = 2.0 * (0.8 * x).sin() * (0.6 * y).cos() + 0.25 * (5.3 * x + 4.1 * y).sin();
        triple(out, [x, y, z]);
    }
    out.push_str("      ]\n    }\n    Normal {\n      vector [\n");
    for (x, y) in vertices() {
        let ripple = 0.25 * (5.3 * x + 4.1 * y).cos();
        let slope_x = 1.6 * (0.8 * x).cos() * (0.6 * y).cos() + 5.3 * ripple;
        let slope_y = -1.2 * (0.8 * x).sin() * (0.6 * y).sin() + 4.1 * ripple;
        let length = (slope_x * slope_x + slope_y * slope_y + 1.0).sqrt();
        triple(out, [-slope_x / length, -slope_y / length, 1.0 / length]);
    }
    out.push_str(
        "      ]\n    }\n    NormalBinding { value PER_VERTEX_INDEXED }\n    \
         IndexedFaceSet {\n      coordIndex [\n",
    );
    for j in 0..rows {
        for i in 0..columns {
            let near = j * (columns + 1) + i;
            let far = near + columns + 1;
            add(
                out,
                format_args!(
                    "        {near}, {}, {}, -1, {near}, {}, {far}, -1,\n",
                    near + 1,
                    far + 1,
                    far + 1
                ),
            );
        }
    }
    out.push_str("      ]\n    }\n");
}

fn transform(out: &mut String, random: &mut Random, with_scale: bool) {
    let mut vector = |low, high| [0; 3].map(|_| Number(random.between(low, high)));
    let [x, y, z] = vector(-400.0, 400.0);
    let [u, v, w] = vector(-1.0, 1.0);
    let [a, b, c] = vector(0.5, 2.0);
    let angle_rad = Number(random.between(0.0, 6.0));
    add(
        out,
        format_args!(
            "    Transform {{\n      translation {x} {y} {z}\n      rotation {u} {v} {w} {angle_rad}\n"
        ),
    );
    if with_scale {
        add(out, format_args!("      scaleFactor {a} {b} {c}\n"));
    }
    out.push_str("    }\n");
}

/// The first ones are made, the others used again.
fn material(out: &mut String, random: &mut Random, part: usize) {
    if part >= MATERIALS {
        let which = random.below(MATERIALS);
        add(out, format_args!("    USE Material{which}\n"));
        return;
    }
    add(out, format_args!("    DEF Material{part} Material {{\n"));
    for field in ["ambientColor", "diffuseColor", "specularColor"] {
        let [r, g, b] = [0; 3].map(|_| Number(random.between(0.0, 1.0)));
        add(out, format_args!("      {field} {r} {g} {b}\n"));
    }
    let shininess = Number(random.between(0.0, 1.0));
    add(
        out,
        format_args!("      shininess {shininess}\n      transparency 0\n    }}\n"),
    );
}

/// A prism with 7 to 16 sides, its ends as triangles about their centres. Gives its triangles.
fn prism(out: &mut String, random: &mut Random) -> usize {
    let sides = 7 + random.below(10);
    let (radius, height) = (random.between(1.0, 10.0), random.between(0.5, 20.0));
    out.push_str("    Coordinate3 {\n      point [\n");
    for z in [0.0, height] {
        for side in 0..sides {
            let (sin, cos) = (TAU * side as f64 / sides as f64).sin_cos();
            triple(out, [radius * cos, radius * sin, z]);
        }
    }
    triple(out, [0.0; 3]);
    triple(out, [0.0, 0.0, height]);
    out.push_str("      ]\n    }\n    IndexedFaceSet {\n      coordIndex [\n");
    let (bottom, top) = (2 * sides, 2 * sides + 1);
    for this in 0..sides {
        let next = (this + 1) % sides;
        let (above, next_above) = (this + sides, next + sides);
        add(
            out,
            format_args!(
                "        {this}, {next}, {next_above}, {above}, -1,\n        \
                 {bottom}, {next}, {this}, -1,\n        {top}, {above}, {next_above}, -1,\n"
            ),
        );
    }
    out.push_str("      ]\n    }\n");
    4 * sides
}

fn triple(out: &mut String, v: [f64; 3]) {
    let [x, y, z] = v.map(Number);
    add(out, format_args!("        {x} {y} {z},\n"));
}

fn add(out: &mut String, text: std::fmt::Arguments<'_>) {
    // Writing to a String does not fail.
    let _ = out.write_fmt(text);
}

/// Xorshift with 64 bits (Marsaglia 2003): the same numbers on any machine.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, count: usize) -> usize {
        // The upper bits are the better ones; the bias is below 1e-9.
        ((self.next() >> 32) % count as u64) as usize
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        let share = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * share
    }
}
