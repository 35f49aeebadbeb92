//! Indented Inventor ASCII text: nodes, fields, lists and numbers. Not a scene graph: it knows no
//! node names and checks nothing.

use crate::solid::Solid;

/// Grows one file, four blanks a level.
pub(crate) struct IvWriter {
    text: String,
    depth: usize,
}

impl IvWriter {
    /// Starts a V2.1 ASCII file with `about` as its comment.
    pub(crate) fn new(about: &[&str]) -> Self {
        let mut writer = Self {
            text: "#Inventor V2.1 ascii\n".to_owned(),
            depth: 0,
        };
        for line in about {
            writer.line(&format!("# {line}"));
        }
        writer
    }

    /// Writes one line at the current level.
    pub(crate) fn line(&mut self, content: &str) {
        for _ in 0..self.depth {
            self.text.push_str("    ");
        }
        self.text.push_str(content);
        self.text.push('\n');
    }

    /// Writes an empty line, to set groups apart.
    pub(crate) fn blank(&mut self) {
        self.text.push('\n');
    }

    /// Writes `head {`, the body one level deeper, and `}`. `head` is `Separator` or
    /// `DEF Roof Separator`.
    pub(crate) fn node(&mut self, head: &str, body: impl FnOnce(&mut Self)) {
        self.line(&format!("{head} {{"));
        self.depth += 1;
        body(self);
        self.depth -= 1;
        self.line("}");
    }

    /// Writes a list field, `per_line` values to a line.
    pub(crate) fn list(&mut self, field: &str, values: &[String], per_line: usize) {
        self.line(&format!("{field} ["));
        self.depth += 1;
        for row in values.chunks(per_line) {
            self.line(&format!("{},", row.join(", ")));
        }
        self.depth -= 1;
        self.line("]");
    }

    /// Writes `Translation { translation x y z }`.
    pub(crate) fn translation(&mut self, by: [f64; 3]) {
        self.line(&format!("Translation {{ translation {} }}", vec3(by)));
    }

    /// Writes a `Separator` that moves by `by`, turns by `angle_rad` about +Z and then runs `body`.
    pub(crate) fn placed(&mut self, by: [f64; 3], angle_rad: f64, body: impl FnOnce(&mut Self)) {
        self.node("Separator", |w| {
            if angle_rad == 0.0 {
                w.translation(by);
            } else {
                w.line(&format!(
                    "Transform {{ translation {}  rotation 0 0 1 {} }}",
                    vec3(by),
                    angle(angle_rad)
                ));
            }
            body(w);
        });
    }

    /// Writes a box from its least to its greatest corner as a moved `Cube`.
    pub(crate) fn cuboid(&mut self, min: [f64; 3], max: [f64; 3]) {
        let centre = [0, 1, 2].map(|i| f64::midpoint(min[i], max[i]));
        let size = [0, 1, 2].map(|i| max[i] - min[i]);
        self.node("Separator", |w| {
            w.translation(centre);
            w.line(&format!(
                "Cube {{ width {}  height {}  depth {} }}",
                num(size[0]),
                num(size[1]),
                num(size[2])
            ));
        });
    }

    /// Writes a round bar standing on `foot`: Inventor's `Cylinder` lies along Y, so it is turned.
    pub(crate) fn upright_cylinder(&mut self, foot: [f64; 3], radius: f64, height: f64) {
        let centre = [foot[0], foot[1], foot[2] + height / 2.0];
        self.node("Separator", |w| {
            w.upright_frame(centre);
            w.line(&format!(
                "Cylinder {{ radius {}  height {} }}",
                num(radius),
                num(height)
            ));
        });
    }

    /// Moves to `centre` and turns Inventor's Y axis up to +Z, for `Cone` and `Cylinder`.
    pub(crate) fn upright_frame(&mut self, centre: [f64; 3]) {
        self.line(&format!(
            "Transform {{ translation {}  rotation 1 0 0 1.570796 }}",
            vec3(centre)
        ));
    }

    /// Writes `Coordinate3` and `IndexedFaceSet` of a solid, which must be closed and face outward.
    pub(crate) fn solid(&mut self, solid: &Solid) {
        debug_assert!(solid.is_closed() && solid.volume() > 0.0);
        let points: Vec<String> = solid.points.iter().map(|&p| vec3(p)).collect();
        let faces: Vec<String> = solid.faces.iter().map(|face| face_indices(face)).collect();
        self.node("Coordinate3", |w| w.list("point", &points, 4));
        self.node("IndexedFaceSet", |w| w.list("coordIndex", &faces, 5));
    }

    /// Ends the file.
    pub(crate) fn finish(self) -> String {
        self.text
    }
}

fn face_indices(face: &[usize]) -> String {
    let mut text = String::new();
    for index in face {
        text.push_str(&format!("{index},"));
    }
    text + "-1"
}

/// A length in metres with at most four decimals (a tenth of a millimetre), no trailing zeros.
pub(crate) fn num(value: f64) -> String {
    trimmed(format!("{value:.4}"))
}

/// An angle in radians with six decimals: at 20 m that is a hundredth of a millimetre.
pub(crate) fn angle(angle_rad: f64) -> String {
    trimmed(format!("{angle_rad:.6}"))
}

/// Three numbers with blanks between.
pub(crate) fn vec3(v: [f64; 3]) -> String {
    v.map(num).join(" ")
}

fn trimmed(digits: String) -> String {
    let short = digits.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0" } else { short }.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_carry_just_enough_decimals() {
        let rows = [
            (0.0, "0"),
            (-0.000_01, "0"),
            (100.0, "100"),
            (0.012, "0.012"),
            (-2.5, "-2.5"),
            (2_600_072.35, "2600072.35"),
            (1.0 / 3.0, "0.3333"),
        ];
        for (value, expected) in rows {
            assert_eq!(num(value), expected);
        }
    }

    #[test]
    fn nodes_are_indented_by_depth() {
        let mut w = IvWriter::new(&["A shelf."]);
        w.node("DEF Shelf Separator", |w| {
            w.cuboid([0.0, 0.0, 0.0], [1.0, 0.3, 0.02]);
        });
        assert_eq!(
            w.finish(),
            "#Inventor V2.1 ascii\n# A shelf.\nDEF Shelf Separator {\n    Separator {\n        \
             Translation { translation 0.5 0.15 0.01 }\n        \
             Cube { width 1  height 0.3  depth 0.02 }\n    }\n}\n"
        );
    }
}
