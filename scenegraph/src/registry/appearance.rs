//! Material, drawing style, environment and fonts. Textures have a file of their own.

macro_rules! appearance {
    ([$next:ident $($rest:ident)*] $($seen:tt)*) => { $next! { [$($rest)*] $($seen)* Appearance {

Material: Node, Full, [],
    "Sets all six properties, those not written to their defaults. In VRML 1 a material that has more \
     emissive than diffuse colours, or reflects nothing, is unlit in its emissive colours." {
    ambientColor: MFColor = "0.2 0.2 0.2";
    diffuseColor: MFColor = "0.8 0.8 0.8";
    specularColor: MFColor = "0 0 0";
    emissiveColor: MFColor = "0 0 0";
    shininess: MFFloat = "0.2";
    transparency: MFFloat = "0";
}
BaseColor: Node, Full, [],
    "Sets the diffuse colours only." {
    rgb: MFColor = "0.8 0.8 0.8";
}
PackedColor: Node, Full, [],
    "Sets diffuse colours and transparency from 0xRRGGBBAA." {
    orderedRGBA: MFUInt32 = "0xccccccff";
}
ColorIndex: Node, Kept, [],
    "Indices into a window's colour map; no effect." {
    index: MFInt32 = "1";
}
MaterialBinding: Node, Full, [],
    "How materials are dealt out over a shape. DEFAULT and NONE mean OVERALL." {
    value: SFEnum = "OVERALL" in MATERIAL_BINDING;
}
LightModel: Node, Full, [],
    "BASE_COLOR draws unlit." {
    model: SFEnum = "PHONG" [BASE_COLOR, PHONG];
}
DrawStyle: Node, Partial, [],
    "INVISIBLE, LINES and POINTS take effect; sizes are kept as hints, line patterns are lost." {
    style: SFEnum = "FILLED" [FILLED, LINES, POINTS, INVISIBLE];
    pointSize: SFFloat = "0";
    lineWidth: SFFloat = "0";
    linePattern: SFUShort = "0xffff";
    linePatternScaleFactor: SFInt32 = "1";
}
Complexity: Node, Partial, [],
    "Sets how finely curved shapes are divided; SCREEN_SPACE counts as OBJECT_SPACE." {
    type: SFEnum = "OBJECT_SPACE" [SCREEN_SPACE, OBJECT_SPACE, BOUNDING_BOX];
    value: SFFloat = "0.5";
    textureQuality: SFFloat = "0.5";
}
ShapeHints: Node, Full, [],
    "Winding, closedness, convexity and crease angle. windingType and useVBO (Coin, TGS) have no effect." {
    vertexOrdering: SFEnum = "UNKNOWN_ORDERING" [UNKNOWN_ORDERING, CLOCKWISE, COUNTERCLOCKWISE];
    shapeType: SFEnum = "UNKNOWN_SHAPE_TYPE" [UNKNOWN_SHAPE_TYPE, SOLID];
    faceType: SFEnum = "CONVEX" [UNKNOWN_FACE_TYPE, CONVEX];
    creaseAngle: SFFloat = "0";
    windingType: SFEnum = "NO_WINDING_TYPE" [
        NO_WINDING_TYPE, ODD_TYPE, NON_ZERO_TYPE, POSITIVE_TYPE, NEGATIVE_TYPE, ABS_GEQ_TWO_TYPE,
    ];
    useVBO: SFBool = "FALSE";
}
PolygonOffset: Node, Kept, [],
    "Shifts depths to draw lines over faces; no effect. Coin and TGS addition." {
    factor: SFFloat = "1";
    units: SFFloat = "1";
    styles: SFBitMask = "FILLED" [FILLED = 1, LINES = 2, POINTS = 4];
    on: SFBool = "TRUE";
}
Environment: Node, Partial, [],
    "Ambient light, attenuation of the lights after it, and fog; fog is not drawn." {
    ambientIntensity: SFFloat = "0.2";
    ambientColor: SFColor = "1 1 1";
    attenuation: SFVec3f = "0 0 1";
    fogType: SFEnum = "NONE" [NONE, HAZE, FOG, SMOKE];
    fogColor: SFColor = "1 1 1";
    fogVisibility: SFFloat = "0";
}
ClipPlane: Node, Planned, [CLIP_PLANE],
    "Cuts the following shapes by a plane." {}
PickStyle: Node, Kept, [],
    "How shapes are picked." {
    style: SFEnum = "SHAPE" [
        SHAPE, BOUNDING_BOX, UNPICKABLE, SHAPE_ON_TOP, BOUNDING_BOX_ON_TOP, SHAPE_FRONTFACES,
    ];
}
TransparencyType: Node, Kept, [],
    "How transparent shapes are blended. Coin and TGS addition." {
    value: SFEnum = "SCREEN_DOOR" [
        SCREEN_DOOR, ADD, DELAYED_ADD, BLEND, DELAYED_BLEND, SORTED_OBJECT_ADD,
        SORTED_OBJECT_BLEND, SORTED_OBJECT_SORTED_TRIANGLE_ADD,
        SORTED_OBJECT_SORTED_TRIANGLE_BLEND, NONE,
    ];
}
DepthBuffer: Node, Kept, [],
    "Depth test settings. Coin and TGS addition." {
    test: SFBool = "TRUE";
    write: SFBool = "TRUE";
    function: SFEnum = "LESS" in COMPARE;
    range: SFVec2f = "0 1";
}
AlphaTest: Node, Kept, [],
    "Drops pixels by their alpha. Coin and TGS addition." {
    function: SFEnum = "NONE" [
        NONE, NEVER, ALWAYS, LESS, LEQUAL, EQUAL, GEQUAL, GREATER, NOTEQUAL,
    ];
    value: SFFloat = "0.5";
}
ShadowStyle: Node, Kept, [],
    "Which shapes throw and take shadows. Coin addition." {
    style: SFEnum = "CASTS_SHADOW_AND_SHADOWED" [
        NO_SHADOWING, CASTS_SHADOW, SHADOWED, CASTS_SHADOW_AND_SHADOWED,
    ];
}
ShadowCulling: Node, Kept, [],
    "Culling while shadows are drawn. Coin addition." {
    mode: SFEnum = "AS_IS_CULLING" [AS_IS_CULLING, NO_CULLING];
}
Font: Node, Full, [FONT],
    "Font of the following text. Size 10 without any, as in SGI; Coin's is 12." {}
FontStyle as Font: Font, Full, [FONT],
    "Font with family and style, as in VRML 1." {
    family: SFEnum = "SERIF" [SERIF, SANS, TYPEWRITER];
    style: SFBitMask = "NONE" [NONE = 0, BOLD = 1, ITALIC = 2];
}

    } } };
}
pub(super) use appearance;
