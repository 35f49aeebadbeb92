//! Engines: values computed from other values. A field that an engine feeds keeps the value written
//! in the file; without one it gets the engine's, as it is before time runs or anything happens.

macro_rules! engines {
    ([$next:ident $($rest:ident)*] $($seen:tt)*) => { $next! { [$($rest)*] $($seen)* Engine {

BoolOperation: Engine, Full, [],
    "A logical operation on two truth values; outputs output, inverse." {
    a: MFBool = "FALSE";
    b: MFBool = "FALSE";
    operation: MFEnum = "A" [
        CLEAR, SET, A, NOT_A, B, NOT_B, A_OR_B, NOT_A_OR_B, A_OR_NOT_B, NOT_A_OR_NOT_B, A_AND_B,
        NOT_A_AND_B, A_AND_NOT_B, NOT_A_AND_NOT_B, A_EQUALS_B, A_NOT_EQUALS_B,
    ];
}
Calculator: Engine, Full, [],
    "Expressions on numbers and vectors; outputs oa to od, oA to oD." {
    a: MFFloat = "0";
    b: MFFloat = "0";
    c: MFFloat = "0";
    d: MFFloat = "0";
    e: MFFloat = "0";
    f: MFFloat = "0";
    g: MFFloat = "0";
    h: MFFloat = "0";
    A: MFVec3f = "0 0 0";
    B: MFVec3f = "0 0 0";
    C: MFVec3f = "0 0 0";
    D: MFVec3f = "0 0 0";
    E: MFVec3f = "0 0 0";
    F: MFVec3f = "0 0 0";
    G: MFVec3f = "0 0 0";
    H: MFVec3f = "0 0 0";
    expression: MFString = "\"\"";
}
ComposeVec2f: Engine, Full, [],
    "A vector from numbers; output vector." {
    x: MFFloat = "0";
    y: MFFloat = "0";
}
ComposeVec3f: Engine, Full, [],
    "A vector from numbers; output vector." {
    x: MFFloat = "0";
    y: MFFloat = "0";
    z: MFFloat = "0";
}
ComposeVec4f: Engine, Full, [],
    "A vector from numbers; output vector." {
    x: MFFloat = "0";
    y: MFFloat = "0";
    z: MFFloat = "0";
    w: MFFloat = "0";
}
DecomposeVec2f: Engine, Full, [],
    "The numbers of a vector; outputs x, y." {
    vector: MFVec2f = "0 0";
}
DecomposeVec3f: Engine, Full, [],
    "The numbers of a vector; outputs x, y, z." {
    vector: MFVec3f = "0 0 0";
}
DecomposeVec4f: Engine, Full, [],
    "The numbers of a vector; outputs x, y, z, w." {
    vector: MFVec4f = "0 0 0 0";
}
ComposeRotation: Engine, Full, [],
    "A rotation from axis and angle in radians; output rotation." {
    axis: MFVec3f = "0 0 1";
    angle: MFFloat = "0";
}
ComposeRotationFromTo: Engine, Full, [],
    "The rotation from one direction to another; output rotation." {
    from: MFVec3f = "0 0 1";
    to: MFVec3f = "0 0 1";
}
DecomposeRotation: Engine, Full, [],
    "Axis and angle of a rotation; outputs axis, angle." {
    rotation: MFRotation = "0 0 1 0";
}
ComposeMatrix: Engine, Full, [],
    "A matrix from the parts of a transform; output matrix." {
    translation: MFVec3f = "0 0 0";
    rotation: MFRotation = "0 0 1 0";
    scaleFactor: MFVec3f = "1 1 1";
    scaleOrientation: MFRotation = "0 0 1 0";
    center: MFVec3f = "0 0 0";
}
DecomposeMatrix: Engine, Full, [],
    "The parts of a matrix; outputs translation, rotation, scaleFactor, scaleOrientation." {
    matrix: MFMatrix = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
    center: MFVec3f = "0 0 0";
}
TransformVec3f: Engine, Full, [],
    "A vector through a matrix; outputs point, direction, normalDirection." {
    vector: MFVec3f = "0 0 0";
    matrix: MFMatrix = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
}
ComputeBoundingBox: Engine, Partial, [],
    "The bounding box of a node, not of a path; outputs min, max, boxCenter, objectCenter." {
    node: SFNode = "NULL";
    path: SFPath = "NULL";
}
Concatenate: Engine, Full, [],
    "Lists in a row; inputs input0 to input9 of the type that `type` names; output output." {
    type: SFName = "\"\"";
}
SelectOne: Engine, Full, [],
    "One of ten inputs input0 to input9 of the type that `type` names; output output." {
    type: SFName = "\"\"";
    index: SFInt32 = "0";
}
Gate: Engine, Full, [],
    "Lets its `input`, of the type that `type` names, through or not; output output." {
    type: SFName = "\"\"";
    enable: SFBool = "FALSE";
    trigger: SFTrigger = "";
}
Counter: Engine, Partial, [],
    "Counts triggers; outputs output, syncOut." {
    min: SFShort = "0";
    max: SFShort = "1";
    step: SFShort = "1";
    trigger: SFTrigger = "";
    reset: SFShort = "0";
}
TimeCounter: Engine, Partial, [],
    "Counts by time; outputs output, syncOut." {
    timeIn: SFTime = "0";
    min: SFShort = "0";
    max: SFShort = "1";
    step: SFShort = "1";
    on: SFBool = "TRUE";
    frequency: SFFloat = "1";
    duty: MFFloat = "1";
    reset: SFShort = "0";
    syncIn: SFTrigger = "";
}
ElapsedTime: Engine, Partial, [],
    "A stopwatch; output timeOut." {
    timeIn: SFTime = "0";
    speed: SFFloat = "1";
    on: SFBool = "TRUE";
    pause: SFBool = "FALSE";
    reset: SFTrigger = "";
}
OneShot: Engine, Partial, [],
    "Runs once for a time; outputs timeOut, isActive, ramp." {
    timeIn: SFTime = "0";
    duration: SFTime = "1";
    trigger: SFTrigger = "";
    flags: SFBitMask = "()" [RETRIGGERABLE = 1, HOLD_FINAL = 2];
    disable: SFBool = "FALSE";
}
OnOff: Engine, Partial, [],
    "A switch; outputs isOn, isOff." {
    on: SFTrigger = "";
    off: SFTrigger = "";
    toggle: SFTrigger = "";
}
TriggerAny: Engine, Kept, [TRIGGERS],
    "Passes any of ten triggers on; output output." {}
InterpolateFloat: Interpolate, Full, [],
    "Between two values by alpha from 0 to 1; output output." {
    alpha: SFFloat = "0";
    input0: MFFloat = "0";
    input1: MFFloat = "1";
}
InterpolateVec2f: Interpolate, Full, [],
    "Between two values by alpha from 0 to 1; output output." {
    alpha: SFFloat = "0";
    input0: MFVec2f = "0 0";
    input1: MFVec2f = "0 0";
}
InterpolateVec3f: Interpolate, Full, [],
    "Between two values by alpha from 0 to 1; output output." {
    alpha: SFFloat = "0";
    input0: MFVec3f = "0 0 0";
    input1: MFVec3f = "0 0 0";
}
InterpolateVec4f: Interpolate, Full, [],
    "Between two values by alpha from 0 to 1; output output." {
    alpha: SFFloat = "0";
    input0: MFVec4f = "0 0 0 0";
    input1: MFVec4f = "0 0 0 0";
}
InterpolateRotation: Interpolate, Full, [],
    "Between two values by alpha from 0 to 1; output output." {
    alpha: SFFloat = "0";
    input0: MFRotation = "0 0 1 0";
    input1: MFRotation = "0 0 1 0";
}
HeightMapToNormalMap: Texture2Convert, Kept, [],
    "A normal picture from a height picture; output image. Coin addition." {
    sourceImage: SFImage = "0 0 0";
    format: SFEnum = "INT8" [INT8];
}

    } } };
}
pub(super) use engines;
