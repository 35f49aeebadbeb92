//! Rules that stand apart from the numbered list; their number is 0.

use super::check::{RULE, Rule};

const RED: [f64; 3] = [1.0, 0.0, 0.0];
const BLUE: [f64; 3] = [0.0, 0.0, 1.0];
const GREY: [f64; 3] = [0.8; 3];

/// One triangle, for rules about how something is drawn.
const TRIANGLE: &[&[[f64; 3]]] = &[&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]]];

/// All of them.
pub const RULES: &[Rule] = &[
    Rule {
        name: "in VRML 1 a material of emissive colours alone is unlit in them",
        text: "#VRML V1.0 ascii
            Separator { Coordinate3 { point [ 0 0 0, 2 0 0, 0 2 0 ] }
            Material { ambientColor [ ] diffuseColor [ ] specularColor [ ]
                emissiveColor [ 0 0 1, 1 0 0 ] transparency 0.25 }
            MaterialBinding { value PER_VERTEX_INDEXED }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] materialIndex [ 0, 1, 0 ] } }",
        draws: TRIANGLE,
        colors: &[&[BLUE, RED, BLUE]],
        transparency: Some(0.25),
        unlit: Some(true),
        ..RULE
    },
    Rule {
        name: "so is one of several emissive colours",
        text: "#VRML V1.0 ascii
            Separator { Coordinate3 { point [ 0 0 0, 2 0 0, 0 2 0 ] }
            Material { emissiveColor [ 1 0 0, 0 0 1 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } }",
        draws: TRIANGLE,
        colors: &[&[RED; 3]],
        unlit: Some(true),
        ..RULE
    },
    Rule {
        name: "and one that reflects nothing",
        text: "#VRML V1.0 ascii
            Separator { Coordinate3 { point [ 0 0 0, 2 0 0, 0 2 0 ] }
            Material { diffuseColor 0 0 0 emissiveColor 0 0 1 }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } }",
        draws: TRIANGLE,
        colors: &[&[BLUE; 3]],
        unlit: Some(true),
        ..RULE
    },
    Rule {
        name: "one emissive colour beside the diffuse one glows in the light",
        text: "#VRML V1.0 ascii
            Separator { Coordinate3 { point [ 0 0 0, 2 0 0, 0 2 0 ] }
            Material { emissiveColor 0 0 1 }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } }",
        draws: TRIANGLE,
        colors: &[&[GREY; 3]],
        unlit: Some(false),
        ..RULE
    },
    Rule {
        name: "a Material after such a one is lit again",
        text: "#VRML V1.0 ascii
            Separator { Coordinate3 { point [ 0 0 0, 2 0 0, 0 2 0 ] }
            Material { diffuseColor [ ] emissiveColor 0 0 1 } Material { diffuseColor 1 0 0 }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } }",
        draws: TRIANGLE,
        colors: &[&[RED; 3]],
        unlit: Some(false),
        ..RULE
    },
    Rule {
        name: "Inventor files know nothing of that",
        text: "Separator { Coordinate3 { point [ 0 0 0, 2 0 0, 0 2 0 ] }
            Material { diffuseColor [ ] emissiveColor [ 0 0 1, 1 0 0 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } }",
        draws: TRIANGLE,
        colors: &[&[GREY; 3]],
        unlit: Some(false),
        ..RULE
    },
];
