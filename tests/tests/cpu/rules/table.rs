//! The rows.

use super::check::{RULE, Rule};

const RED: [f64; 3] = [1.0, 0.0, 0.0];
const GREEN: [f64; 3] = [0.0, 1.0, 0.0];
const BLUE: [f64; 3] = [0.0, 0.0, 1.0];
const GREY: [f64; 3] = [0.8; 3];

/// All rules; where one has several rows they share its number.
pub const RULES: &[Rule] = &[
    Rule {
        number: 1,
        name: "a Group leaks its transforms, a Separator does not",
        text: "Separator {
            Separator { Translation { translation 3 0 0 } }
            Group { Translation { translation 0 0 4 } }
            PointSet { vertexProperty VertexProperty { vertex 1 1 1 } } }",
        draws: &[&[[1.0, 1.0, 5.0]]],
        ..RULE
    },
    Rule {
        number: 2,
        name: "a TransformSeparator restores the matrix and nothing else",
        text: "Separator {
            TransformSeparator { Scale { scaleFactor 7 7 7 } BaseColor { rgb 0 0 1 } }
            PointSet { vertexProperty VertexProperty { vertex 1 0 0 } } }",
        draws: &[&[[1.0, 0.0, 0.0]]],
        colors: &[&[BLUE]],
        ..RULE
    },
    Rule {
        number: 3,
        name: "a Switch shows nothing by default",
        text: "Separator { Switch { Sphere { } Cone { } } }",
        counts: Some([0, 0, 0]),
        codes: &["hidden"],
        ..RULE
    },
    Rule {
        number: 3,
        name: "a Switch set to -3 shows all",
        text: "Switch { whichChild -3 Cube { } Cube { } }",
        counts: Some([24, 0, 0]),
        ..RULE
    },
    Rule {
        number: 4,
        name: "a Material sets all its fields, the unwritten ones too",
        text: "Separator { Material { diffuseColor 0 1 0 } Material { transparency 0.25 }
            PointSet { vertexProperty VertexProperty { vertex 0 0 2 } } }",
        draws: &[&[[0.0, 0.0, 2.0]]],
        colors: &[&[GREY]],
        transparency: Some(0.25),
        ..RULE
    },
    Rule {
        number: 5,
        name: "an empty list of a Material leaves the state alone",
        text: "Separator { Material { diffuseColor 0 1 0 }
            Material { diffuseColor [ ] transparency 0.25 }
            PointSet { vertexProperty VertexProperty { vertex 0 0 2 } } }",
        draws: &[&[[0.0, 0.0, 2.0]]],
        colors: &[&[GREEN]],
        transparency: Some(0.25),
        ..RULE
    },
    Rule {
        number: 5,
        name: "so does a field marked as ignored",
        text: "Separator { Material { diffuseColor 0 1 0 } Material { diffuseColor 1 0 0 ~ }
            PointSet { vertexProperty VertexProperty { vertex 0 0 2 } } }",
        draws: &[&[[0.0, 0.0, 2.0]]],
        colors: &[&[GREEN]],
        ..RULE
    },
    Rule {
        number: 6,
        name: "without materialIndex the coordIndex is taken, and the last -1 may be missing",
        text: "Separator { Coordinate3 { point [ 5 5 5, 0 0 0, 2 0 0, 0 2 0 ] }
            BaseColor { rgb [ 1 1 1, 1 0 0, 0 1 0, 0 0 1 ] }
            MaterialBinding { value PER_VERTEX_INDEXED }
            IndexedFaceSet { coordIndex [ 1, 2, 3 ] } }",
        draws: &[&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]]],
        colors: &[&[RED, GREEN, BLUE]],
        ..RULE
    },
    Rule {
        number: 7,
        name: "PER_FACE counts the faces",
        text: "Separator { Coordinate3 { point [ 0 0 0, 2 0 0, 0 2 0, 0 0 2 ] }
            BaseColor { rgb [ 1 0 0, 0 0 1 ] } MaterialBinding { value PER_FACE }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1, 0, 1, 3 ] } }",
        draws: &[
            &[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
            &[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]],
        ],
        colors: &[&[RED, RED, RED], &[BLUE, BLUE, BLUE]],
        ..RULE
    },
    Rule {
        number: 8,
        name: "a concave polygon is cut along its outline even when it is said to be convex",
        text: "Separator { Coordinate3 { point [ 0 0 0, 4 0 0, 4 4 0, 2 1 0, 0 4 0 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, 3, 4, -1 ] } }",
        counts: Some([3, 0, 0]),
        area: Some(10.0),
        normal: Some([0.0, 0.0, 1.0]),
        ..RULE
    },
    Rule {
        number: 9,
        name: "a concave polygon of unknown face type",
        text: "Separator { ShapeHints { faceType UNKNOWN_FACE_TYPE }
            Coordinate3 { point [ 0 0 0, 4 0 0, 4 4 0, 2 1 0, 0 4 0 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, 3, 4, -1 ] } }",
        counts: Some([3, 0, 0]),
        area: Some(10.0),
        normal: Some([0.0, 0.0, 1.0]),
        ..RULE
    },
    Rule {
        number: 41,
        name: "a concave quadrilateral is cut at its inner corner",
        text: "Separator { ShapeHints { faceType UNKNOWN_FACE_TYPE }
            Coordinate3 { point [ 4 0 0, 1 1 0, 0 4 0, 0 0 0 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1 ] } }",
        draws: &[
            &[[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [1.0, 1.0, 0.0]],
            &[[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 4.0, 0.0]],
        ],
        ..RULE
    },
    Rule {
        number: 10,
        name: "clockwise faces look the other way, and are turned to say so",
        text: "Separator { ShapeHints { vertexOrdering CLOCKWISE }
            Coordinate3 { point [ 0 0 0, 2 0 0, 0 3 0 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } }",
        draws: &[&[[0.0, 0.0, 0.0], [0.0, 3.0, 0.0], [2.0, 0.0, 0.0]]],
        normal: Some([0.0, 0.0, -1.0]),
        ..RULE
    },
    Rule {
        number: 10,
        name: "where no ordering is told, triangles are turned to the normals of the file",
        text: "Separator { Normal { vector 0 0 -1 } NormalBinding { value OVERALL }
            Coordinate3 { point [ 0 0 0, 2 0 0, 0 3 0 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } }",
        draws: &[&[[0.0, 0.0, 0.0], [0.0, 3.0, 0.0], [2.0, 0.0, 0.0]]],
        normal: Some([0.0, 0.0, -1.0]),
        ..RULE
    },
    Rule {
        number: 11,
        name: "later transforms are inner ones",
        text: "Separator { Rotation { rotation 1 0 0 1.57079633 }
            Translation { translation 0 2 0 }
            PointSet { vertexProperty VertexProperty { vertex 0 1 0 } } }",
        draws: &[&[[0.0, 0.0, 3.0]]],
        ..RULE
    },
    Rule {
        number: 12,
        name: "a matrix has its translation in the last row",
        text: "Separator {
            MatrixTransform { matrix 0 2 0 0  -2 0 0 0  0 0 2 0  5 6 7 1 }
            PointSet { vertexProperty VertexProperty { vertex 1 0 0 } } }",
        draws: &[&[[5.0, 8.0, 7.0]]],
        ..RULE
    },
    Rule {
        number: 13,
        name: "a Transform scales about its center",
        text: "Separator {
            Transform { translation 0 5 0 scaleFactor 3 3 3 center 0 1 0 }
            PointSet { vertexProperty VertexProperty { vertex 0 2 0 } } }",
        draws: &[&[[0.0, 9.0, 0.0]]],
        ..RULE
    },
    Rule {
        number: 14,
        name: "USE means the latest DEF",
        text: "Separator { DEF T Translation { translation 0 0 2 }
            DEF T Translation { translation 0 0 3 } USE T
            PointSet { vertexProperty VertexProperty { vertex 0 0 0 } } }",
        draws: &[&[[0.0, 0.0, 8.0]]],
        ..RULE
    },
    Rule {
        number: 15,
        name: "USE before DEF is left out, with a warning",
        text: "Separator { USE Corner
            DEF Corner PointSet { vertexProperty VertexProperty { vertex 1 2 3 } } }",
        draws: &[&[[1.0, 2.0, 3.0]]],
        codes: &["used-before-def"],
        ..RULE
    },
    Rule {
        number: 16,
        name: "the alternateRep of an unknown class is drawn in its place",
        text: "Separator { Gizmo { fields [ SFNode alternateRep, SFFloat size ] size 2
            alternateRep PointSet { vertexProperty VertexProperty { vertex 4 0 0 } } } }",
        draws: &[&[[4.0, 0.0, 0.0]]],
        codes: &["unknown-class"],
        ..RULE
    },
    Rule {
        number: 17,
        name: "an unknown class without description costs itself only",
        text: "Separator { Gizmo { size 2 mode [ A, B ] }
            PointSet { vertexProperty VertexProperty { vertex 0 4 0 } } }",
        draws: &[&[[0.0, 4.0, 0.0]]],
        codes: &["unknown-class"],
        ..RULE
    },
    Rule {
        number: 18,
        name: "commas in lists may be left out, and one may follow the last value",
        text: "Separator { Coordinate3 { point [ 0 0 0 3 0 0, 0 3 0, ] } FaceSet { } }",
        draws: &[&[[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]]],
        ..RULE
    },
    Rule {
        number: 19,
        name: "two commas in a row cost nothing but a warning",
        text: "Separator { Coordinate3 { point [ 0 0 0,, 3 0 0, 0 3 0 ] } FaceSet { } }",
        draws: &[&[[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]]],
        codes: &["stray-comma"],
        ..RULE
    },
    Rule {
        number: 20,
        name: "a word ends at a blank; one that swallows its brace is cut there",
        text: "Separator { Label { label north}
            PointSet { vertexProperty VertexProperty { vertex 0 4 0 } } }",
        draws: &[&[[0.0, 4.0, 0.0]]],
        notes: &["north"],
        codes: &["glued-brace"],
        ..RULE
    },
    Rule {
        number: 21,
        name: "in a string only \\\" is an escape, and line ends are kept",
        text: "Separator { Info { string \"C:\\new\\\"t\nu\" }
            PointSet { vertexProperty VertexProperty { vertex 0 4 0 } } }",
        notes: &["C:\\new\"t\nu"],
        counts: Some([0, 0, 1]),
        ..RULE
    },
    Rule {
        number: 22,
        name: "a comment may begin right behind a value",
        text: "Separator { Cube { width 4#height 9\nheight 6 } }",
        bounds: Some([[-2.0, -3.0, -1.0], [2.0, 3.0, 1.0]]),
        ..RULE
    },
    Rule {
        number: 23,
        name: "a Windows NaN is one value, not a comment",
        text: "Separator { Translation { translation -1.#IND00 2 3 } Cube { height 4 } }",
        bounds: Some([[-1.0, 0.0, 2.0], [1.0, 4.0, 4.0]]),
        codes: &["not-a-number"],
        ..RULE
    },
    Rule {
        number: 24,
        name: "blanks before the header",
        text: "\n  #Inventor V2.1 ascii\nCube { }",
        counts: Some([12, 0, 0]),
        codes: &["late-header"],
        ..RULE
    },
    Rule {
        number: 25,
        name: "orderedRGBA has red first and alpha last",
        text: "Separator { PackedColor { orderedRGBA 0x00ff0033 }
            PointSet { vertexProperty VertexProperty { vertex 0 4 0 } } }",
        draws: &[&[[0.0, 4.0, 0.0]]],
        colors: &[&[GREEN]],
        transparency: Some(0.8),
        ..RULE
    },
    Rule {
        number: 26,
        name: "the rgba of 2.0 files has alpha first and red last",
        text: "#Inventor V2.0 ascii\nSeparator { PackedColor { rgba 0x3300ff00 }
            Coordinate3 { point [ 0 4 0 ] } PointSet { } }",
        draws: &[&[[0.0, 4.0, 0.0]]],
        colors: &[&[GREEN]],
        transparency: Some(0.8),
        ..RULE
    },
    Rule {
        number: 27,
        name: "an Array places its copies, the first where it stands",
        text: "Array { numElements1 2 separation1 3 0 0 numElements2 2 separation2 0 5 0
            PointSet { vertexProperty VertexProperty { vertex 0 0 1 } } }",
        draws: &[
            &[[0.0, 0.0, 1.0]],
            &[[3.0, 0.0, 1.0]],
            &[[0.0, 5.0, 1.0]],
            &[[3.0, 5.0, 1.0]],
        ],
        ..RULE
    },
    Rule {
        number: 28,
        name: "Units are absolute, not multiplied",
        text: "Separator { Units { units MILLIMETERS } Units { units MILLIMETERS }
            PointSet { vertexProperty VertexProperty { vertex 0 2000 0 } } }",
        draws: &[&[[0.0, 2.0, 0.0]]],
        ..RULE
    },
    Rule {
        number: 29,
        name: "a binding of a VertexProperty counts only with its data",
        text: "Separator { NormalBinding { value PER_FACE }
            Normal { vector [ 0.6 0.8 0, 0.8 0.6 0 ] }
            FaceSet { numVertices [ 3, 3 ] vertexProperty VertexProperty {
                vertex [ 0 0 0, 0 2 0, 0 0 2, 0 0 0, 0 0 2, 2 0 0 ]
                normalBinding OVERALL } } }",
        draws: &[
            &[[0.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]],
            &[[0.0, 0.0, 0.0], [0.0, 0.0, 2.0], [2.0, 0.0, 0.0]],
        ],
        normals: &[&[[0.6, 0.8, 0.0]; 3], &[[0.8, 0.6, 0.0]; 3]],
        ..RULE
    },
    Rule {
        number: 29,
        name: "so the points of a VertexProperty keep the normals of the state",
        text: "Separator { NormalBinding { value PER_FACE } Normal { vector 0 0.6 0.8 }
            PointSet { vertexProperty VertexProperty { vertex 0 0 3 normalBinding OVERALL } } }",
        draws: &[&[[0.0, 0.0, 3.0]]],
        normal: Some([0.0, 0.6, 0.8]),
        ..RULE
    },
    Rule {
        number: 30,
        name: "a connected field keeps the value written",
        text: "Separator { Translation { translation 4 5 6 = Cone { } . height }
            PointSet { vertexProperty VertexProperty { vertex 0 0 0 } } }",
        draws: &[&[[4.0, 5.0, 6.0]]],
        codes: &["connection"],
        ..RULE
    },
    Rule {
        number: 31,
        name: "texture coordinates of a 4 by 1 face keep its aspect ratio",
        text: "Separator { Texture2 { image 1 1 1 0x80 }
            Coordinate3 { point [ 0 0 0, 4 0 0, 4 1 0, 0 1 0 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1, 0, 2, 3, -1 ] } }",
        draws: &[
            &[[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 1.0, 0.0]],
            &[[0.0, 0.0, 0.0], [4.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        ],
        texcoords: &[
            &[[0.0, 0.0], [1.0, 0.0], [1.0, 0.25]],
            &[[0.0, 0.0], [1.0, 0.25], [0.0, 0.25]],
        ],
        ..RULE
    },
    Rule {
        number: 32,
        name: "what is invisible is not drawn",
        text: "Separator { DrawStyle { style INVISIBLE } Cube { } }",
        counts: Some([0, 0, 0]),
        codes: &["hidden"],
        ..RULE
    },
    Rule {
        number: 33,
        name: "of an LOD the nearest level is drawn",
        text: "LOD { range [ 5, 9 ] Cube { width 4 } Sphere { } Cone { } }",
        counts: Some([12, 0, 0]),
        bounds: Some([[-2.0, -1.0, -1.0], [2.0, 1.0, 1.0]]),
        codes: &["hidden"],
        ..RULE
    },
    Rule {
        number: 34,
        name: "several roots are all read",
        text: "Separator { Translation { translation 5 0 0 } Cube { } } Cube { width 6 }",
        counts: Some([24, 0, 0]),
        bounds: Some([[-3.0, -1.0, -1.0], [6.0, 1.0, 1.0]]),
        ..RULE
    },
    Rule {
        number: 35,
        name: "a brace too many at the end",
        text: "Separator { Cube { } } }",
        counts: Some([12, 0, 0]),
        codes: &["extra-brace"],
        ..RULE
    },
    Rule {
        number: 36,
        name: "bit masks in parentheses: sides, and the top at y = 2 only",
        text: "Separator { Complexity { value 0 } Cylinder { height 4 parts ( TOP ) } }",
        bounds: Some([[-1.0, 2.0, -1.0], [1.0, 2.0, 1.0]]),
        ..RULE
    },
    Rule {
        number: 36,
        name: "several words of a bit mask",
        text: "Separator { Cylinder { height 4 parts ( BOTTOM | TOP ) } }",
        bounds: Some([[-1.0, -2.0, -1.0], [1.0, 2.0, 1.0]]),
        ..RULE
    },
    Rule {
        number: 36,
        name: "bit masks without parentheses",
        text: "Separator { Cone { height 4 parts BOTTOM } }",
        bounds: Some([[-1.0, -2.0, -1.0], [1.0, -2.0, 1.0]]),
        ..RULE
    },
    Rule {
        number: 37,
        name: "an ignored field, and a connection to nothing",
        text: "Separator { Cube { width 4 ~ depth = USE gone.width height 6 } }",
        counts: Some([12, 0, 0]),
        codes: &["unknown-name"],
        ..RULE
    },
    Rule {
        number: 38,
        name: "nodes without effect on what follows",
        text: "Separator { ShapeHints { creaseAngle 1 } Label { label \"x\" } Info { string \"y\" }
            Cube { } }",
        counts: Some([12, 0, 0]),
        notes: &["x", "y"],
        area: Some(24.0),
        ..RULE
    },
    Rule {
        number: 39,
        name: "PER_PART counts the segments of lines",
        text: "Separator { BaseColor { rgb [ 0 0 1, 1 0 0 ] } MaterialBinding { value PER_PART }
            Coordinate3 { point [ 0 0 0, 0 2 0, 0 2 2 ] } LineSet { } }",
        draws: &[
            &[[0.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
            &[[0.0, 2.0, 0.0], [0.0, 2.0, 2.0]],
        ],
        colors: &[&[BLUE, BLUE], &[RED, RED]],
        ..RULE
    },
    Rule {
        number: 40,
        name: "a mirror keeps the order of the corners, and generated normals",
        text: "Separator { Scale { scaleFactor 1 -2 1 }
            Coordinate3 { point [ 0 0 0, 3 0 0, 0 3 0 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } }",
        draws: &[&[[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, -6.0, 0.0]]],
        normal: Some([0.0, 0.0, 1.0]),
        ..RULE
    },
];
