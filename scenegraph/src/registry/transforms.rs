//! Nodes that change the model matrix.

macro_rules! transforms {
    ([$next:ident $($rest:ident)*] $($seen:tt)*) => { $next! { [$($rest)*] $($seen)* Transform {

Transform: Transformation, Full, [TRANSFORM],
    "Scales about `center` along `scaleOrientation`, then rotates about `center`, then moves." {}
Translation: Transformation, Full, [TRANSLATION],
    "Moves." {}
Rotation: Transformation, Full, [ROTATION],
    "Rotates about an axis by an angle in radians." {}
RotationXYZ: Transformation, Full, [],
    "Rotates about a coordinate axis by an angle in radians." {
    axis: SFEnum = "X" [X, Y, Z];
    angle: SFFloat = "0";
}
Scale: Transformation, Full, [],
    "Scales along the axes." {
    scaleFactor: SFVec3f = "1 1 1";
}
MatrixTransform: Transformation, Full, [],
    "Any matrix, for row vectors: the translation is in elements 12 to 14." {
    matrix: SFMatrix = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
}
ResetTransform: Transformation, Full, [],
    "Sets the model matrix back to the identity; BBOX resets bounding boxes only." {
    whatToReset: SFBitMask = "TRANSFORM" [TRANSFORM = 1, BBOX = 2];
}
Units: Transformation, Full, [],
    "Sets the unit of length; absolute, so repeating it changes nothing." {
    units: SFEnum = "METERS" [
        METERS, CENTIMETERS, MILLIMETERS, MICROMETERS, MICRONS = 3, NANOMETERS, ANGSTROMS,
        KILOMETERS, FEET, INCHES, POINTS, YARDS, MILES, NAUTICAL_MILES,
    ];
}
AntiSquish: Transformation, Kept, [],
    "Evens out the scale of the current matrix; no effect." {
    sizing: SFEnum = "AVERAGE_DIMENSION" [
        X, Y, Z, AVERAGE_DIMENSION, BIGGEST_DIMENSION, SMALLEST_DIMENSION, LONGEST_DIAGONAL,
    ];
    recalcAlways: SFBool = "TRUE";
}
SurroundScale: Transformation, Kept, [],
    "Scales a dragger to its surroundings; no effect." {
    numNodesUpToContainer: SFInt32 = "0";
    numNodesUpToReset: SFInt32 = "0";
}
Rotor as Rotation: Rotation, Partial, [ROTATION, MOTION],
    "Turns for ever; the written rotation is used." {}
Pendulum: Rotation, Partial, [ROTATION],
    "Swings between two rotations; `rotation0` is used." {
    rotation0: SFRotation = "0 0 1 0";
    rotation1: SFRotation = "0 0 1 0";
    speed: SFFloat = "1";
    on: SFBool = "TRUE";
}
Shuttle: Translation, Partial, [TRANSLATION],
    "Moves between two places; `translation0` is used." {
    translation0: SFVec3f = "0 0 0";
    translation1: SFVec3f = "0 0 0";
    speed: SFFloat = "1";
    on: SFBool = "TRUE";
}
GeoOrigin: Node, Planned, [GEO_PLACE],
    "The place on the globe that becomes the origin. Coin addition." {}
GeoLocation: Transformation, Planned, [GEO_PLACE],
    "Moves to a place on the globe. Coin addition." {}

    } } };
}
pub(super) use transforms;
