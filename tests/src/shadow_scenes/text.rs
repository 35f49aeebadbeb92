//! Inventor text, piece by piece. Not a general writer: what the scenes need, and numbers with all
//! their digits.

use std::fmt::Write;

use glam::DVec3;

/// A polyhedron: points, and faces as lists of their numbers.
#[derive(Clone, Debug, Default)]
pub(super) struct Mesh {
    pub(super) points: Vec<DVec3>,
    pub(super) faces: Vec<Vec<usize>>,
}

impl Mesh {
    /// A mesh of the given faces.
    pub(super) fn new(points: &[[f64; 3]], faces: &[&[usize]]) -> Self {
        Self {
            points: points.iter().map(|&p| DVec3::from(p)).collect(),
            faces: faces.iter().map(|face| face.to_vec()).collect(),
        }
    }

    /// A parallelogram: `corner`, `corner + u`, `corner + u + v`, `corner + v`.
    pub(super) fn quad(corner: [f64; 3], u: [f64; 3], v: [f64; 3]) -> Self {
        let [p, u, v] = [corner, u, v].map(DVec3::from);
        Self {
            points: vec![p, p + u, p + u + v, p + v],
            faces: vec![vec![0, 1, 2, 3]],
        }
    }

    /// A box, outward faces in the order -x, +x, -y, +y, -z, +z.
    pub(super) fn cuboid(low: [f64; 3], high: [f64; 3]) -> Self {
        let axis = |bit: usize, i: usize| if bit == 0 { low[i] } else { high[i] };
        let corner = |i: usize| DVec3::new(axis(i & 1, 0), axis(i & 2, 1), axis(i & 4, 2));
        let faces = [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ];
        Self {
            points: (0..8).map(corner).collect(),
            faces: faces.map(Vec::from).to_vec(),
        }
    }

    /// Adds the points and faces of `other`, which share none with these.
    pub(super) fn with(mut self, other: &Self) -> Self {
        let first = self.points.len();
        self.points.extend(&other.points);
        let moved = |face: &Vec<usize>| face.iter().map(|i| i + first).collect();
        self.faces.extend(other.faces.iter().map(moved));
        self
    }

    /// Every face the other way round.
    pub(super) fn reversed(mut self) -> Self {
        for face in &mut self.faces {
            face.reverse();
        }
        self
    }

    /// Every point moved.
    pub(super) fn moved(mut self, by: DVec3) -> Self {
        for point in &mut self.points {
            *point += by;
        }
        self
    }
}

/// A file that grows. All points that are given as coordinates, lights too, are moved by `offset`.
pub(super) struct Text {
    out: String,
    offset: DVec3,
}

impl Text {
    /// A V2.1 file whose surfaces have two sides and a plain material.
    pub(super) fn new() -> Self {
        Self::at(DVec3::ZERO)
    }

    /// As [`Text::new`], moved.
    pub(super) fn at(offset: DVec3) -> Self {
        let mut text = Self {
            out: "#Inventor V2.1 ascii\n".to_owned(),
            offset,
        };
        text.raw("ShapeHints { vertexOrdering COUNTERCLOCKWISE }");
        text.color([0.8, 0.8, 0.8]);
        text
    }

    /// The file.
    pub(super) fn finish(self) -> String {
        self.out
    }

    /// A line as it is.
    pub(super) fn raw(&mut self, line: &str) {
        self.out.push_str(line);
        self.out.push('\n');
    }

    /// Formatted text as it is.
    pub(super) fn add(&mut self, text: std::fmt::Arguments<'_>) {
        // Writing to a String does not fail.
        let _ = self.out.write_fmt(text);
    }

    /// `head { ... }`.
    pub(super) fn node(&mut self, head: &str, body: impl FnOnce(&mut Self)) {
        self.add(format_args!("{head} {{\n"));
        body(self);
        self.out.push_str("}\n");
    }

    /// A `Separator`.
    pub(super) fn separator(&mut self, body: impl FnOnce(&mut Self)) {
        self.node("Separator", body);
    }

    /// A material with this diffuse colour.
    pub(super) fn color(&mut self, [r, g, b]: [f64; 3]) {
        self.add(format_args!("Material {{ diffuseColor {r} {g} {b} }}\n"));
    }

    /// Three numbers.
    pub(super) fn triple(&mut self, v: impl Into<[f64; 3]>) {
        let [x, y, z] = v.into();
        self.add(format_args!("{x} {y} {z}, "));
    }

    /// A position, moved by the offset.
    pub(super) fn position(&mut self, p: DVec3) {
        let offset = self.offset;
        self.triple(p + offset);
    }

    /// `Translation` by a vector: not moved by the offset.
    pub(super) fn translation(&mut self, [x, y, z]: [f64; 3]) {
        self.add(format_args!("Translation {{ translation {x} {y} {z} }}\n"));
    }

    /// A point light.
    pub(super) fn point_light(&mut self, location: [f64; 3]) {
        self.lamp("PointLight", DVec3::from(location), "");
    }

    /// A light of this class at a place, with more fields.
    pub(super) fn lamp(&mut self, class: &str, location: DVec3, fields: &str) {
        let [x, y, z] = (location + self.offset).to_array();
        self.add(format_args!(
            "{class} {{ location {x} {y} {z} {fields} }}\n"
        ));
    }

    /// A directional light; `direction` is the way it travels.
    pub(super) fn sun(&mut self, [x, y, z]: [f64; 3], intensity: f64) {
        self.add(format_args!(
            "DirectionalLight {{ direction {x} {y} {z} intensity {intensity} }}\n"
        ));
    }

    /// Coordinates and faces.
    pub(super) fn mesh(&mut self, mesh: &Mesh) {
        self.out.push_str("Coordinate3 { point [ ");
        for &p in &mesh.points {
            self.position(p);
        }
        self.out.push_str("] }\nIndexedFaceSet { coordIndex [ ");
        for face in &mesh.faces {
            for i in face {
                self.add(format_args!("{i}, "));
            }
            self.out.push_str("-1, ");
        }
        self.out.push_str("] }\n");
    }

    /// A mesh with a colour of its own.
    pub(super) fn colored(&mut self, rgb: [f64; 3], mesh: &Mesh) {
        self.separator(|t| {
            t.color(rgb);
            t.mesh(mesh);
        });
    }

    /// A square floor, facing up, of side 2 `half` around the Y axis.
    pub(super) fn floor(&mut self, y: f64, half: f64) {
        let side = 2.0 * half;
        let quad = Mesh::quad([-half, y, half], [side, 0.0, 0.0], [0.0, 0.0, -side]);
        self.colored([0.7, 0.7, 0.6], &quad);
    }
}
