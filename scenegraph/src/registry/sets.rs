//! Field sets that several classes share because they inherit them, and word lists that
//! several fields share.

use super::table::{fields, number};
use super::{FieldSpec, Word};

pub(super) const AUTO_OFF_ON: &[Word] = &number([("OFF", None), ("ON", None), ("AUTO", None)]);

/// SGI's and Coin's binding words. `DEFAULT` and `NONE` of Inventor 1 stand for `OVERALL` here.
pub(super) const MATERIAL_BINDING: &[Word] = &number([
    ("OVERALL", None),
    ("PER_PART", None),
    ("PER_PART_INDEXED", None),
    ("PER_FACE", None),
    ("PER_FACE_INDEXED", None),
    ("PER_VERTEX", None),
    ("PER_VERTEX_INDEXED", None),
    ("DEFAULT", Some(0)),
    ("NONE", Some(0)),
]);

/// As [`MATERIAL_BINDING`], but `DEFAULT` and `NONE` stand for `PER_VERTEX_INDEXED`.
pub(super) const NORMAL_BINDING: &[Word] = &number([
    ("OVERALL", None),
    ("PER_PART", None),
    ("PER_PART_INDEXED", None),
    ("PER_FACE", None),
    ("PER_FACE_INDEXED", None),
    ("PER_VERTEX", None),
    ("PER_VERTEX_INDEXED", None),
    ("DEFAULT", Some(6)),
    ("NONE", Some(6)),
]);

pub(super) const WRAP: &[Word] = &number([("REPEAT", None), ("CLAMP", None)]);

pub(super) const COMPARE: &[Word] = &number([
    ("NEVER", None),
    ("ALWAYS", None),
    ("LESS", None),
    ("LEQUAL", None),
    ("EQUAL", None),
    ("GEQUAL", None),
    ("GREATER", None),
    ("NOTEQUAL", None),
]);

pub(super) const TEXTURE_MODEL: &[Word] = &number([
    ("MODULATE", None),
    ("DECAL", None),
    ("BLEND", None),
    ("REPLACE", None),
]);

pub(super) const COMBINE_SOURCE: &[Word] = &number([
    ("PRIMARY_COLOR", None),
    ("TEXTURE", None),
    ("CONSTANT", None),
    ("PREVIOUS", None),
]);

pub(super) const COMBINE_OPERAND: &[Word] = &number([
    ("SRC_COLOR", None),
    ("ONE_MINUS_SRC_COLOR", None),
    ("SRC_ALPHA", None),
    ("ONE_MINUS_SRC_ALPHA", None),
]);

pub(super) const COMBINE_OPERATION: &[Word] = &number([
    ("REPLACE", None),
    ("MODULATE", None),
    ("ADD", None),
    ("ADD_SIGNED", None),
    ("SUBTRACT", None),
    ("INTERPOLATE", None),
    ("DOT3_RGB", None),
    ("DOT3_RGBA", None),
]);

pub(super) const VIEWPORT_MAPPING: &[Word] = &number([
    ("CROP_VIEWPORT_FILL_FRAME", None),
    ("CROP_VIEWPORT_LINE_FRAME", None),
    ("CROP_VIEWPORT_NO_FRAME", None),
    ("ADJUST_CAMERA", None),
    ("LEAVE_ALONE", None),
]);

pub(super) const JUSTIFICATION: &[Word] =
    &number([("LEFT", None), ("RIGHT", None), ("CENTER", None)]);

/// Fields of `Separator`.
pub(super) const SEPARATOR: &[FieldSpec] = fields! {
    renderCaching: SFEnum = "AUTO" in AUTO_OFF_ON;
    boundingBoxCaching: SFEnum = "AUTO" in AUTO_OFF_ON;
    renderCulling: SFEnum = "AUTO" in AUTO_OFF_ON;
    pickCulling: SFEnum = "AUTO" in AUTO_OFF_ON;
};

/// Fields that `Selection` adds to `Separator`.
pub(super) const SELECTION: &[FieldSpec] = fields! {
    policy: SFEnum = "SHIFT" [SINGLE, TOGGLE, SHIFT, DISABLE];
};

/// Fields that `LocateHighlight` adds to `Separator`.
pub(super) const HIGHLIGHT: &[FieldSpec] = fields! {
    color: SFColor = "0.3 0.3 0.3";
    style: SFEnum = "EMISSIVE" [EMISSIVE, EMISSIVE_DIFFUSE];
    mode: SFEnum = "AUTO" [AUTO, ON, OFF];
};

/// Fields of `Switch`.
pub(super) const SWITCH: &[FieldSpec] = fields! {
    whichChild: SFInt32 = "-1";
};

/// Fields of `Transform`, shared by the manipulators.
pub(super) const TRANSFORM: &[FieldSpec] = fields! {
    translation: SFVec3f = "0 0 0";
    rotation: SFRotation = "0 0 1 0";
    scaleFactor: SFVec3f = "1 1 1";
    scaleOrientation: SFRotation = "0 0 1 0";
    center: SFVec3f = "0 0 0";
};

/// Fields of `Rotation`.
pub(super) const ROTATION: &[FieldSpec] = fields! {
    rotation: SFRotation = "0 0 1 0";
};

/// Fields of `Translation`.
pub(super) const TRANSLATION: &[FieldSpec] = fields! {
    translation: SFVec3f = "0 0 0";
};

/// Fields that the animated transforms add.
pub(super) const MOTION: &[FieldSpec] = fields! {
    speed: SFFloat = "1";
    on: SFBool = "TRUE";
};

/// A place on the globe in a system such as latitude and longitude in degrees.
pub(super) const GEO_PLACE: &[FieldSpec] = fields! {
    geoCoords: SFVec3d = "0 0 0";
    geoSystem: MFString = "[ \"GD\", \"WE\" ]";
};

/// Fields of `ClipPlane`.
pub(super) const CLIP_PLANE: &[FieldSpec] = fields! {
    plane: SFPlane = "1 0 0 0";
    on: SFBool = "TRUE";
};

/// Fields of `Font`.
pub(super) const FONT: &[FieldSpec] = fields! {
    name: SFName = "\"defaultFont\"";
    size: SFFloat = "10";
};

/// Fields of the abstract class `VertexShape`.
pub(super) const VERTEX_SHAPE: &[FieldSpec] = fields! {
    vertexProperty: SFNode = "NULL";
};

/// Fields that the abstract class `NonIndexedShape` adds to `VertexShape`.
pub(super) const NON_INDEXED: &[FieldSpec] = fields! {
    startIndex: SFInt32 = "0";
};

/// The vertex counts of `FaceSet`, `LineSet` and `TriangleStripSet`.
pub(super) const VERTEX_COUNTS: &[FieldSpec] = fields! {
    numVertices: MFInt32 = "-1";
};

/// The point count of `PointSet`.
pub(super) const POINT_COUNT: &[FieldSpec] = fields! {
    numPoints: SFInt32 = "-1";
};

/// Fields that the abstract class `IndexedShape` adds to `VertexShape`.
pub(super) const INDEXED: &[FieldSpec] = fields! {
    coordIndex: MFInt32 = "0";
    materialIndex: MFInt32 = "-1";
    normalIndex: MFInt32 = "-1";
    textureCoordIndex: MFInt32 = "-1";
};

/// Fields of the abstract class `Profile`.
pub(super) const PROFILE: &[FieldSpec] = fields! {
    index: MFInt32 = "0";
    linkage: SFEnum = "START_FIRST" [START_FIRST, START_NEW, ADD_TO_CURRENT];
};

/// Fields of the abstract class `Light`.
pub(super) const LIGHT: &[FieldSpec] = fields! {
    on: SFBool = "TRUE";
    intensity: SFFloat = "1";
    color: SFColor = "1 1 1";
};

/// What `DirectionalLight` adds to `Light`.
pub(super) const DIRECTIONAL_LIGHT: &[FieldSpec] = fields! {
    direction: SFVec3f = "0 0 -1";
};

/// What `PointLight` adds to `Light`.
pub(super) const POINT_LIGHT: &[FieldSpec] = fields! {
    location: SFVec3f = "0 0 1";
};

/// What `SpotLight` adds to `Light`.
pub(super) const SPOT_LIGHT: &[FieldSpec] = fields! {
    location: SFVec3f = "0 0 1";
    direction: SFVec3f = "0 0 -1";
    dropOffRate: SFFloat = "0";
    cutOffAngle: SFFloat = "0.7853982";
};

/// Fields of the abstract class `Camera`.
pub(super) const CAMERA: &[FieldSpec] = fields! {
    viewportMapping: SFEnum = "ADJUST_CAMERA" in VIEWPORT_MAPPING;
    position: SFVec3f = "0 0 1";
    orientation: SFRotation = "0 0 1 0";
    aspectRatio: SFFloat = "1";
    nearDistance: SFFloat = "1";
    farDistance: SFFloat = "10";
    focalDistance: SFFloat = "5";
};

/// The part that every kit has.
pub(super) const KIT: &[FieldSpec] = fields! {
    callbackList: SFNode = "NULL";
};

/// Parts of a kit that is a Separator inside.
pub(super) const SEPARATOR_KIT: &[FieldSpec] = fields! {
    topSeparator: SFNode = "NULL";
    pickStyle: SFNode = "NULL";
    appearance: SFNode = "NULL";
    units: SFNode = "NULL";
    transform: SFNode = "NULL";
    texture2Transform: SFNode = "NULL";
};

/// Parts and fields that every dragger has besides those of a kit and a Separator.
pub(super) const DRAGGER: &[FieldSpec] = fields! {
    topSeparator: SFNode = "NULL";
    motionMatrix: SFNode = "NULL";
    geomSeparator: SFNode = "NULL";
    isActive: SFBool = "FALSE";
};

/// The scale of a dragger.
pub(super) const SCALE: &[FieldSpec] = fields! {
    scaleFactor: SFVec3f = "1 1 1";
};

/// Fields of a shader.
pub(super) const SHADER: &[FieldSpec] = fields! {
    isActive: SFBool = "TRUE";
    sourceType: SFEnum = "FILENAME" [ARB_PROGRAM, CG_PROGRAM, GLSL_PROGRAM, FILENAME];
    sourceProgram: SFString = "\"\"";
    parameter: MFNode = "[]";
};

/// Fields of a shader parameter besides its value.
pub(super) const PARAMETER: &[FieldSpec] = fields! {
    name: SFString = "\"\"";
    identifier: SFInt32 = "0";
};

/// The inputs of a ten-way trigger.
pub(super) const TRIGGERS: &[FieldSpec] = fields! {
    input0: SFTrigger = "";
    input1: SFTrigger = "";
    input2: SFTrigger = "";
    input3: SFTrigger = "";
    input4: SFTrigger = "";
    input5: SFTrigger = "";
    input6: SFTrigger = "";
    input7: SFTrigger = "";
    input8: SFTrigger = "";
    input9: SFTrigger = "";
};

/// What `PerspectiveCamera` adds to `Camera`.
pub(super) const PERSPECTIVE: &[FieldSpec] = fields! {
    heightAngle: SFFloat = "0.7853982";
};
