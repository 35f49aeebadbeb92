//! Node kits: nodes that fill a fixed catalog of parts. The parts stand as node fields in the
//! catalog's order, which is the order of traversal; a part that holds others stands before them.

macro_rules! kits {
    ([$next:ident $($rest:ident)*] $($seen:tt)*) => { $next! { [$($rest)*] $($seen)* Kit {

NodeKitListPart: Node, Full, [],
    "A part that is a list: a container of one class whose children are of the named classes." {
    containerTypeName: SFName = "\"Group\"";
    childTypeNames: MFName = "\"Node\"";
    containerNode: SFNode = "NULL";
}
BaseKit: Node, Full, [KIT],
    "A kit without parts of its own." {}
AppearanceKit: BaseKit, Full, [KIT],
    "Appearance nodes." {
    lightModel: SFNode = "NULL";
    environment: SFNode = "NULL";
    drawStyle: SFNode = "NULL";
    material: SFNode = "NULL";
    complexity: SFNode = "NULL";
    texture2: SFNode = "NULL";
    font: SFNode = "NULL";
}
SeparatorKit: BaseKit, Full, [KIT, SEPARATOR, SEPARATOR_KIT],
    "A Separator with appearance, transform and children." {
    childList: SFNode = "NULL";
}
ShapeKit: SeparatorKit, Full, [KIT, SEPARATOR, SEPARATOR_KIT],
    "A shape with its properties; without a shape part it is a Cube." {
    materialBinding: SFNode = "NULL";
    normalBinding: SFNode = "NULL";
    textureCoordinateBinding: SFNode = "NULL";
    shapeHints: SFNode = "NULL";
    coordinate3: SFNode = "NULL";
    coordinate4: SFNode = "NULL";
    normal: SFNode = "NULL";
    textureCoordinate2: SFNode = "NULL";
    profileCoordinate2: SFNode = "NULL";
    profileCoordinate3: SFNode = "NULL";
    profileList: SFNode = "NULL";
    childList: SFNode = "NULL";
    textureCoordinateFunction: SFNode = "NULL";
    localTransform: SFNode = "NULL";
    shapeSeparator: SFNode = "NULL";
    shape: SFNode = "NULL";
}
WrapperKit: SeparatorKit, Full, [KIT, SEPARATOR, SEPARATOR_KIT],
    "Any nodes, as a kit." {
    childList: SFNode = "NULL";
    localTransform: SFNode = "NULL";
    contents: SFNode = "NULL";
}
SceneKit: BaseKit, Full, [KIT],
    "Cameras, lights and children; the container of cameraList is a Switch." {
    topSeparator: SFNode = "NULL";
    cameraList: SFNode = "NULL";
    lightList: SFNode = "NULL";
    childList: SFNode = "NULL";
}
CameraKit: BaseKit, Full, [KIT],
    "A camera and its transform, which ends with the kit." {
    transformGroup: SFNode = "NULL";
    transform: SFNode = "NULL";
    camera: SFNode = "NULL";
}
LightKit: BaseKit, Full, [KIT],
    "A light, its transform, which ends with the kit, and a shape to show it." {
    transformGroup: SFNode = "NULL";
    transform: SFNode = "NULL";
    light: SFNode = "NULL";
    iconSeparator: SFNode = "NULL";
    icon: SFNode = "NULL";
}
InteractionKit: BaseKit, Kept, [KIT, SEPARATOR],
    "The base of draggers." {
    topSeparator: SFNode = "NULL";
    geomSeparator: SFNode = "NULL";
}
GeneralizedCylinder: SeparatorKit, Full, [KIT, SEPARATOR, SEPARATOR_KIT],
    "A cross section swept along a spine; becomes a Separator with a face set. SGI's modeller noodle." {
    renderShapeType: SFEnum = "FACE_SET" [
        FACE_SET, TRIANGLE_STRIP_SET, QUAD_MESH, BEZIER_SURFACE, CUBIC_SPLINE_SURFACE,
        CUBIC_TO_EDGE_SURFACE,
    ];
    normsFlipped: SFBool = "FALSE";
    profileClosed: SFBool = "FALSE";
    crossSectionClosed: SFBool = "FALSE";
    spineClosed: SFBool = "FALSE";
    twistClosed: SFBool = "FALSE";
    minNumRows: SFInt32 = "1";
    minNumCols: SFInt32 = "1";
    withSides: SFBool = "TRUE";
    withTopCap: SFBool = "TRUE";
    withBottomCap: SFBool = "TRUE";
    withTextureCoords: SFBool = "FALSE";
    inputSwitch: SFNode = "NULL";
    profileCoords: SFNode = "NULL";
    crossSectionCoords: SFNode = "NULL";
    spineCoords: SFNode = "NULL";
    twistCoords: SFNode = "NULL";
    childList: SFNode = "NULL";
}

    } } };
}
pub(super) use kits;
