//! Groups, and the nodes that bring in another file.

macro_rules! groups {
    ([$next:ident $($rest:ident)*] $($seen:tt)*) => { $next! { [$($rest)*] $($seen)* Group {

Group: Node, Full, [],
    "Children in a row; their state leaks to what follows." {}
Separator: Group, Full, [SEPARATOR],
    "Restores the whole state after its children. Caching and culling hints have no effect." {}
Annotation as Separator: Separator, Partial, [SEPARATOR],
    "A Separator; that it is drawn last and over everything is not kept." {}
Selection as Separator: Separator, Full, [SEPARATOR, SELECTION],
    "A Separator; the selection policy has no effect." {}
ExtSelection as Separator: Selection, Full, [SEPARATOR, SELECTION],
    "A Separator; lasso settings have no effect. Coin addition." {
    lassoType: SFEnum = "NOLASSO" [NOLASSO, LASSO, RECTANGLE];
    lassoPolicy: SFEnum = "FULL_BBOX" [FULL_BBOX, PART_BBOX, FULL, PART];
    lassoMode: SFEnum = "ALL_SHAPES" [VISIBLE_SHAPES, ALL_SHAPES];
}
LocateHighlight as Separator: Separator, Full, [SEPARATOR, HIGHLIGHT],
    "A Separator; highlighting under the pointer has no effect." {}
WWWAnchor as Separator: LocateHighlight, Full, [SEPARATOR, HIGHLIGHT],
    "A Separator with a link, which stands in the extras." {
    name: SFString = "\"<Undefined URL>\"";
    description: SFString = "\"\"";
    map: SFEnum = "NONE" [NONE, POINT];
}
TransformSeparator: Group, Full, [],
    "Restores the model matrix only; everything else leaks." {}
Switch: Group, Full, [SWITCH],
    "Draws one child, none (-1), the inherited choice (-2) or all (-3)." {}
Blinker: Switch, Partial, [SWITCH, MOTION],
    "A Switch that cycles; the chosen child, else the first, is shown." {}
PathSwitch: Group, Partial, [],
    "Draws its children only where the traversal matches the path; drawn always." {
    path: SFPath = "NULL";
}
LOD: Group, Partial, [],
    "Levels by distance; the finest level, child 0, is taken." {
    range: MFFloat = "[]";
    center: SFVec3f = "0 0 0";
}
LevelOfDetail: Group, Partial, [],
    "Levels by area on the screen; the finest level, child 0, is taken." {
    screenArea: MFFloat = "[]";
}
Array: Group, Full, [],
    "Copies of its children on a regular grid." {
    origin: SFEnum = "FIRST" [FIRST, CENTER, LAST];
    numElements1: SFShort = "1";
    numElements2: SFShort = "1";
    numElements3: SFShort = "1";
    separation1: SFVec3f = "1 0 0";
    separation2: SFVec3f = "0 1 0";
    separation3: SFVec3f = "0 0 1";
}
MultipleCopy: Group, Full, [],
    "A copy of its children for every matrix." {
    matrix: MFMatrix = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
}
ShadowGroup as Separator: Separator, Partial, [SEPARATOR],
    "A Separator; the shadows inside it are not kept. Coin addition." {
    isActive: SFBool = "TRUE";
    intensity: SFFloat = "0.5";
    precision: SFFloat = "0.5";
    quality: SFFloat = "0.5";
    shadowCachingEnabled: SFBool = "TRUE";
    visibilityNearRadius: SFFloat = "-1";
    visibilityRadius: SFFloat = "-1";
    epsilon: SFFloat = "0.00001";
    threshold: SFFloat = "0.1";
    smoothBorder: SFFloat = "0";
    visibilityFlag: SFEnum = "LONGEST_BBOX_EDGE_FACTOR" [
        ABSOLUTE_RADIUS, LONGEST_BBOX_EDGE_FACTOR, PROJECTED_BBOX_DEPTH_FACTOR,
    ];
}
GeoSeparator: Separator, Planned, [SEPARATOR, GEO_PLACE],
    "A Separator at a place on the globe. Coin addition." {}
File: Node, Full, [],
    "The nodes of another Inventor file, as a Group." {
    name: SFString = "\"<Undefined file>\"";
}
WWWInline: Node, Partial, [],
    "The nodes of another file: local files are read, the network is never used; else alternateRep." {
    name: SFString = "\"<Undefined file>\"";
    bboxCenter: SFVec3f = "0 0 0";
    bboxSize: SFVec3f = "0 0 0";
    alternateRep: SFNode = "NULL";
}

    } } };
}
pub(super) use groups;
