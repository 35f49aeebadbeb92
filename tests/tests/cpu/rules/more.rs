//! Rules that stand apart from the numbered list; their number is 0.

use iv_parser::SourcePos;
use scenegraph::scene::{Environment, Fog, FogType};

use super::check::{RULE, Rule};

const RED: [f64; 3] = [1.0, 0.0, 0.0];
const BLUE: [f64; 3] = [0.0, 0.0, 1.0];
const GREY: [f64; 3] = [0.8; 3];

/// Places are not compared.
const NOWHERE: SourcePos = SourcePos {
    file: 0,
    line: 0,
    column: 0,
};

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
    Rule {
        name: "a texture whose picture is marked as ignored leaves the one before it",
        text: "Separator { Texture2 { image 1 1 1 0x80 } Texture2 { filename ~ }
            Coordinate3 { point [ 0 0 0, 2 0 0, 0 2 0 ] }
            TextureCoordinate2 { point [ 1 0, 2 0, 1 3 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } }",
        draws: TRIANGLE,
        texcoords: &[&[[1.0, 0.0], [2.0, 0.0], [1.0, 3.0]]],
        ..RULE
    },
    Rule {
        name: "ignored fields of texture transforms do nothing",
        text: "Separator { Texture2 { image 1 1 1 0x80 }
            Texture2Transform { translation 5 5 ~ rotation 2 ~ scaleFactor 9 9 ~ }
            Texture2Transform { center 7 7 ~ scaleFactor 2 2 }
            TextureMatrixTransform { matrix 3 0 0 0  0 3 0 0  0 0 1 0  4 4 0 1 ~ }
            Coordinate3 { point [ 0 0 0, 2 0 0, 0 2 0 ] }
            TextureCoordinate2 { point [ 1 0, 2 0, 1 3 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } }",
        draws: TRIANGLE,
        texcoords: &[&[[2.0, 0.0], [4.0, 0.0], [2.0, 6.0]]],
        ..RULE
    },
    Rule {
        name: "ignored fields of transforms do nothing",
        text: "Separator { RotationXYZ { axis Z angle 1 ~ } RotationXYZ { axis Y ~ angle 1 }
            Shuttle { translation0 1 1 1 ~ } Units { units FEET ~ }
            Coordinate3 { point [ 0 0 0, 2 0 0, 0 2 0 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } }",
        draws: TRIANGLE,
        codes: &["hidden"],
        ..RULE
    },
    Rule {
        name: "ignored fields of an Environment keep what was before",
        text: "Separator {
            Environment { ambientIntensity 0.5 ambientColor 1 0 0 attenuation 1 2 3
                fogType FOG fogColor 0 0 1 fogVisibility 40 }
            Environment { ambientIntensity 0.9 ~ ambientColor 0 1 0 ~ attenuation 4 5 6
                fogType SMOKE fogColor 0 1 0 ~ fogVisibility 50 }
            Environment { ambientIntensity ~ ambientColor ~ attenuation 7 8 9 ~ fogType ~ }
            Cube { } }",
        environment: Some(Environment {
            ambient_intensity: 0.5,
            ambient_color_srgb: RED,
            attenuation: [4.0, 5.0, 6.0],
            fog: Some(Fog {
                fog_type: FogType::Smoke,
                color_srgb: BLUE,
                visibility: 50.0,
            }),
            pos: NOWHERE,
        }),
        ..RULE
    },
    Rule {
        name: "texture coordinates in space give s and t, undivided",
        text: "Separator { Texture2 { image 1 1 1 0x80 }
            Coordinate3 { point [ 0 0 0, 2 0 0, 0 2 0 ] }
            TextureCoordinate3 { point [ 1 0 2, 2 0 4, 1 3 8 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } }",
        draws: TRIANGLE,
        texcoords: &[&[[1.0, 0.0], [2.0, 0.0], [1.0, 3.0]]],
        ..RULE
    },
    Rule {
        name: "so do those of a VertexProperty in the state",
        text: "Separator { Texture2 { image 1 1 1 0x80 } VertexProperty {
            vertex [ 0 0 0, 2 0 0, 0 2 0 ] texCoord3 [ 1 0 2, 2 0 4, 1 3 8 ] }
            TextureCoordinate2 { point [ 5 5 ] ~ }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } }",
        draws: TRIANGLE,
        texcoords: &[&[[1.0, 0.0], [2.0, 0.0], [1.0, 3.0]]],
        ..RULE
    },
    Rule {
        name: "and of one in the shape, where it has no others",
        text: "Separator { Texture2 { image 1 1 1 0x80 } FaceSet { vertexProperty VertexProperty {
            vertex [ 0 0 0, 2 0 0, 0 2 0 ] texCoord3 [ 1 0 2, 2 0 4, 1 3 8 ] } } }",
        draws: TRIANGLE,
        texcoords: &[&[[1.0, 0.0], [2.0, 0.0], [1.0, 3.0]]],
        ..RULE
    },
    Rule {
        name: "flat texture coordinates go before those in space",
        text: "Separator { Texture2 { image 1 1 1 0x80 } FaceSet { vertexProperty VertexProperty {
            vertex [ 0 0 0, 2 0 0, 0 2 0 ] texCoord [ 1 0, 2 0, 1 3 ]
            texCoord3 [ 9 0 2, 9 0 4, 9 3 8 ] } } }",
        draws: TRIANGLE,
        texcoords: &[&[[1.0, 0.0], [2.0, 0.0], [1.0, 3.0]]],
        ..RULE
    },
    Rule {
        name: "a group described for old readers holds its alternateRep",
        text: "#Inventor V2.0 ascii
            WWWAnchor { fields [ SFString name, SFNode alternateRep ] name \"a.html\"
            alternateRep Separator { Coordinate3 { point [ 0 0 0, 2 0 0, 0 2 0 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } } }",
        draws: TRIANGLE,
        ..RULE
    },
    Rule {
        name: "but not beside its children",
        text: "#Inventor V2.0 ascii
            WWWAnchor { fields [ SFString name, SFNode alternateRep ] name \"a.html\"
            alternateRep Cube { } Coordinate3 { point [ 0 0 0, 2 0 0, 0 2 0 ] }
            IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } }",
        draws: TRIANGLE,
        ..RULE
    },
    Rule {
        name: "a DEF without class keeps its name and what is in it",
        text: "Separator { DEF Tri{Coordinate3{point[0 0 0,2 0 0,0 2 0]} IndexedFaceSet{
            coordIndex[0,1,2,-1]}} }",
        draws: TRIANGLE,
        codes: &["no-class"],
        ..RULE
    },
];
