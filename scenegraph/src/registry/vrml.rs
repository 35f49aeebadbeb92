//! The classes of VRML 2.0 (ISO/IEC 14772-1:1997, chapter 6), under the names that Coin gives them:
//! `VRMLBox` is what a VRML 2.0 file calls `Box`. Events that are no fields are not listed.

macro_rules! vrml {
    ([$next:ident $($rest:ident)*] $($seen:tt)*) => { $next! { [$($rest)*] $($seen)* Vrml {

VRMLGroup: VRMLParent, Full, [SEPARATOR],
    "Children whose state does not leak." {
    children: MFNode = "[]";
    bboxCenter: SFVec3f = "0 0 0";
    bboxSize: SFVec3f = "-1 -1 -1";
}
VRMLTransform: VRMLGroup, Full, [SEPARATOR],
    "A Group in a frame of its own." {
    children: MFNode = "[]";
    bboxCenter: SFVec3f = "0 0 0";
    bboxSize: SFVec3f = "-1 -1 -1";
    translation: SFVec3f = "0 0 0";
    rotation: SFRotation = "0 0 1 0";
    scale: SFVec3f = "1 1 1";
    scaleOrientation: SFRotation = "0 0 1 0";
    center: SFVec3f = "0 0 0";
}
VRMLSwitch: Group, Full, [],
    "Draws one of its choices, or none (-1)." {
    choice: MFNode = "[]";
    whichChoice: SFInt32 = "-1";
}
VRMLLOD: Group, Partial, [],
    "Levels by distance; the finest, the first, is taken." {
    range: MFFloat = "[]";
    center: SFVec3f = "0 0 0";
    level: MFNode = "[]";
}
VRMLInline: Node, Full, [],
    "The nodes of another file; local files are read, the network is never used." {
    bboxCenter: SFVec3f = "0 0 0";
    bboxSize: SFVec3f = "-1 -1 -1";
    url: MFString = "[]";
}
VRMLAnchor: VRMLParent, Full, [],
    "A Group with a link, which stands in the extras." {
    children: MFNode = "[]";
    url: MFString = "[]";
    description: SFString = "\"\"";
    parameter: MFString = "[]";
    bboxCenter: SFVec3f = "0 0 0";
    bboxSize: SFVec3f = "-1 -1 -1";
}
VRMLBillboard: VRMLParent, Partial, [],
    "A Group; that it turns towards the viewer is not kept." {
    children: MFNode = "[]";
    axisOfRotation: SFVec3f = "0 1 0";
    bboxCenter: SFVec3f = "0 0 0";
    bboxSize: SFVec3f = "-1 -1 -1";
}
VRMLCollision: VRMLGroup, Full, [SEPARATOR],
    "A Group; the proxy is for collisions only and not drawn." {
    children: MFNode = "[]";
    bboxCenter: SFVec3f = "0 0 0";
    bboxSize: SFVec3f = "-1 -1 -1";
    collide: SFBool = "TRUE";
    proxy: SFNode = "NULL";
}
VRMLShape: Node, Full, [],
    "A geometry with an appearance." {
    appearance: SFNode = "NULL";
    geometry: SFNode = "NULL";
    renderCaching: SFEnum = "AUTO" [OFF, ON, AUTO];
    boundingBoxCaching: SFEnum = "AUTO" [OFF, ON, AUTO];
}
VRMLAppearance: Node, Full, [],
    "Material and texture of a Shape." {
    material: SFNode = "NULL";
    texture: SFNode = "NULL";
    textureTransform: SFNode = "NULL";
}
VRMLMaterial: Node, Full, [],
    "Colours; a Shape without one is white and unlit." {
    diffuseColor: SFColor = "0.8 0.8 0.8";
    ambientIntensity: SFFloat = "0.2";
    specularColor: SFColor = "0 0 0";
    emissiveColor: SFColor = "0 0 0";
    shininess: SFFloat = "0.2";
    transparency: SFFloat = "0";
}
VRMLImageTexture: VRMLTexture, Full, [],
    "Picture from a file. It is taken as coloured: it replaces the diffuse colour." {
    repeatS: SFBool = "TRUE";
    repeatT: SFBool = "TRUE";
    url: MFString = "[]";
}
VRMLPixelTexture: VRMLTexture, Full, [],
    "Picture given in the file." {
    repeatS: SFBool = "TRUE";
    repeatT: SFBool = "TRUE";
    image: SFImage = "0 0 0";
}
VRMLMovieTexture: VRMLTexture, Planned, [],
    "Moving picture." {
    repeatS: SFBool = "TRUE";
    repeatT: SFBool = "TRUE";
    loop: SFBool = "FALSE";
    speed: SFFloat = "1";
    startTime: SFTime = "0";
    stopTime: SFTime = "0";
    url: MFString = "[]";
}
VRMLTextureTransform: Node, Full, [],
    "Moves texture coordinates, then rotates and scales them about `center`." {
    translation: SFVec2f = "0 0";
    rotation: SFFloat = "0";
    scale: SFVec2f = "1 1";
    center: SFVec2f = "0 0";
}
VRMLBox: VRMLGeometry, Full, [],
    "Box about the origin." {
    size: SFVec3f = "2 2 2";
}
VRMLSphere: VRMLGeometry, Full, [],
    "Sphere about the origin." {
    radius: SFFloat = "1";
}
VRMLCone: VRMLGeometry, Full, [],
    "Cone about the y axis, tip up." {
    bottomRadius: SFFloat = "1";
    height: SFFloat = "2";
    side: SFBool = "TRUE";
    bottom: SFBool = "TRUE";
}
VRMLCylinder: VRMLGeometry, Full, [],
    "Cylinder about the y axis." {
    radius: SFFloat = "1";
    height: SFFloat = "2";
    side: SFBool = "TRUE";
    top: SFBool = "TRUE";
    bottom: SFBool = "TRUE";
}
VRMLIndexedFaceSet: VRMLGeometry, Full, [],
    "Polygons by index, each ended by -1." {
    coord: SFNode = "NULL";
    texCoord: SFNode = "NULL";
    normal: SFNode = "NULL";
    color: SFNode = "NULL";
    colorPerVertex: SFBool = "TRUE";
    normalPerVertex: SFBool = "TRUE";
    coordIndex: MFInt32 = "[]";
    colorIndex: MFInt32 = "[]";
    normalIndex: MFInt32 = "[]";
    texCoordIndex: MFInt32 = "[]";
    ccw: SFBool = "TRUE";
    solid: SFBool = "TRUE";
    convex: SFBool = "TRUE";
    creaseAngle: SFFloat = "0";
}
VRMLIndexedLineSet: VRMLGeometry, Full, [],
    "Polylines by index, each ended by -1; unlit." {
    coord: SFNode = "NULL";
    color: SFNode = "NULL";
    colorPerVertex: SFBool = "TRUE";
    coordIndex: MFInt32 = "[]";
    colorIndex: MFInt32 = "[]";
}
VRMLPointSet: VRMLGeometry, Full, [],
    "Points; unlit." {
    coord: SFNode = "NULL";
    color: SFNode = "NULL";
}
VRMLElevationGrid: VRMLGeometry, Full, [],
    "Heights over a regular grid." {
    ccw: SFBool = "TRUE";
    solid: SFBool = "TRUE";
    creaseAngle: SFFloat = "0";
    zDimension: SFInt32 = "0";
    xDimension: SFInt32 = "0";
    zSpacing: SFFloat = "1";
    xSpacing: SFFloat = "1";
    height: MFFloat = "[]";
    texCoord: SFNode = "NULL";
    normal: SFNode = "NULL";
    color: SFNode = "NULL";
    colorPerVertex: SFBool = "TRUE";
    normalPerVertex: SFBool = "TRUE";
}
VRMLExtrusion: VRMLGeometry, Full, [],
    "A cross-section moved along a spine." {
    beginCap: SFBool = "TRUE";
    ccw: SFBool = "TRUE";
    convex: SFBool = "TRUE";
    creaseAngle: SFFloat = "0";
    crossSection: MFVec2f = "[1 1, 1 -1, -1 -1, -1 1, 1 1]";
    endCap: SFBool = "TRUE";
    orientation: MFRotation = "0 0 1 0";
    scale: MFVec2f = "1 1";
    solid: SFBool = "TRUE";
    spine: MFVec3f = "[0 0 0, 0 1 0]";
}
VRMLText: VRMLGeometry, Full, [],
    "Flat text." {
    string: MFString = "[]";
    fontStyle: SFNode = "NULL";
    maxExtent: SFFloat = "0";
    length: MFFloat = "[]";
}
VRMLFontStyle: Node, Full, [],
    "Size, looks and layout of a Text; language is not used." {
    size: SFFloat = "1";
    family: MFString = "\"SERIF\"";
    style: SFString = "\"PLAIN\"";
    horizontal: SFBool = "TRUE";
    leftToRight: SFBool = "TRUE";
    topToBottom: SFBool = "TRUE";
    language: SFString = "\"\"";
    justify: MFString = "\"BEGIN\"";
    spacing: SFFloat = "1";
}
VRMLCoordinate: Node, Full, [],
    "Points." {
    point: MFVec3f = "[]";
}
VRMLNormal: Node, Full, [],
    "Normals." {
    vector: MFVec3f = "[]";
}
VRMLColor: Node, Full, [],
    "Colours that stand in place of the diffuse one." {
    color: MFColor = "[]";
}
VRMLTextureCoordinate: Node, Full, [],
    "Texture coordinates." {
    point: MFVec2f = "[]";
}
VRMLDirectionalLight: VRMLLight, Full, [],
    "Parallel light on what is in the group it stands in." {
    on: SFBool = "TRUE";
    intensity: SFFloat = "1";
    color: SFColor = "1 1 1";
    ambientIntensity: SFFloat = "0";
    direction: SFVec3f = "0 0 -1";
}
VRMLPointLight: VRMLLight, Partial, [],
    "Light from a point on the whole scene within `radius`. Its ambientIntensity has no effect." {
    on: SFBool = "TRUE";
    intensity: SFFloat = "1";
    color: SFColor = "1 1 1";
    ambientIntensity: SFFloat = "0";
    location: SFVec3f = "0 0 0";
    radius: SFFloat = "100";
    attenuation: SFVec3f = "1 0 0";
}
VRMLSpotLight: VRMLLight, Partial, [],
    "A cone of light on the whole scene within `radius`. Between beamWidth and cutOffAngle it falls \
     off by a power of the cosine. Its ambientIntensity has no effect." {
    on: SFBool = "TRUE";
    intensity: SFFloat = "1";
    color: SFColor = "1 1 1";
    ambientIntensity: SFFloat = "0";
    location: SFVec3f = "0 0 0";
    direction: SFVec3f = "0 0 -1";
    beamWidth: SFFloat = "1.570796";
    cutOffAngle: SFFloat = "0.785398";
    radius: SFFloat = "100";
    attenuation: SFVec3f = "1 0 0";
}
VRMLViewpoint: Node, Full, [],
    "A camera; fieldOfView is that of the window's smaller side." {
    position: SFVec3f = "0 0 10";
    orientation: SFRotation = "0 0 1 0";
    fieldOfView: SFFloat = "0.785398";
    description: SFString = "\"\"";
    jump: SFBool = "TRUE";
}
VRMLBackground: Node, Planned, [],
    "Sky, ground and a panorama." {
    groundColor: MFColor = "[]";
    groundAngle: MFFloat = "[]";
    skyColor: MFColor = "0 0 0";
    skyAngle: MFFloat = "[]";
    backUrl: MFString = "[]";
    bottomUrl: MFString = "[]";
    frontUrl: MFString = "[]";
    leftUrl: MFString = "[]";
    rightUrl: MFString = "[]";
    topUrl: MFString = "[]";
}
VRMLFog: Node, Full, [],
    "Fog over the whole scene; the first one counts." {
    fogType: SFString = "\"LINEAR\"";
    visibilityRange: SFFloat = "0";
    color: SFColor = "1 1 1";
}
VRMLNavigationInfo: Node, Kept, [],
    "How a viewer moves." {
    type: MFString = "[\"WALK\", \"ANY\"]";
    speed: SFFloat = "1";
    avatarSize: MFFloat = "[0.25, 1.6, 0.75]";
    visibilityLimit: SFFloat = "0";
    headlight: SFBool = "TRUE";
}
VRMLWorldInfo: Node, Full, [],
    "Title and remarks for readers; kept as notes of the group it stands in." {
    title: SFString = "\"\"";
    info: MFString = "[]";
}
VRMLAudioClip: Node, Kept, [],
    "Sound from a file." {
    description: SFString = "\"\"";
    loop: SFBool = "FALSE";
    pitch: SFFloat = "1";
    startTime: SFTime = "0";
    stopTime: SFTime = "0";
    url: MFString = "[]";
}
VRMLSound: Node, Kept, [],
    "A place that sounds." {
    direction: SFVec3f = "0 0 1";
    intensity: SFFloat = "1";
    location: SFVec3f = "0 0 0";
    maxBack: SFFloat = "10";
    maxFront: SFFloat = "10";
    minBack: SFFloat = "1";
    minFront: SFFloat = "1";
    priority: SFFloat = "0";
    source: SFNode = "NULL";
    spatialize: SFBool = "TRUE";
}
VRMLScript: Node, Kept, [],
    "A program; never run." {
    url: MFString = "[]";
    directOutput: SFBool = "FALSE";
    mustEvaluate: SFBool = "FALSE";
}
VRMLTimeSensor: VRMLSensor, Kept, [],
    "A clock." {
    cycleInterval: SFTime = "1";
    enabled: SFBool = "TRUE";
    loop: SFBool = "FALSE";
    startTime: SFTime = "0";
    stopTime: SFTime = "0";
}
VRMLTouchSensor: VRMLSensor, Kept, [],
    "Notices clicks." {
    enabled: SFBool = "TRUE";
}
VRMLPlaneSensor: VRMLSensor, Kept, [],
    "Notices drags in a plane." {
    autoOffset: SFBool = "TRUE";
    enabled: SFBool = "TRUE";
    maxPosition: SFVec2f = "-1 -1";
    minPosition: SFVec2f = "0 0";
    offset: SFVec3f = "0 0 0";
}
VRMLSphereSensor: VRMLSensor, Kept, [],
    "Notices drags on a sphere." {
    autoOffset: SFBool = "TRUE";
    enabled: SFBool = "TRUE";
    offset: SFRotation = "0 1 0 0";
}
VRMLCylinderSensor: VRMLSensor, Kept, [],
    "Notices drags round an axis." {
    autoOffset: SFBool = "TRUE";
    diskAngle: SFFloat = "0.262";
    enabled: SFBool = "TRUE";
    maxAngle: SFFloat = "-1";
    minAngle: SFFloat = "0";
    offset: SFFloat = "0";
}
VRMLProximitySensor: VRMLSensor, Kept, [],
    "Notices the viewer in a box." {
    center: SFVec3f = "0 0 0";
    size: SFVec3f = "0 0 0";
    enabled: SFBool = "TRUE";
}
VRMLVisibilitySensor: VRMLSensor, Kept, [],
    "Notices that a box is seen." {
    center: SFVec3f = "0 0 0";
    enabled: SFBool = "TRUE";
    size: SFVec3f = "0 0 0";
}
VRMLColorInterpolator: VRMLInterpolator, Kept, [],
    "Values over time." {
    key: MFFloat = "[]";
    keyValue: MFColor = "[]";
}
VRMLCoordinateInterpolator: VRMLInterpolator, Kept, [],
    "Values over time." {
    key: MFFloat = "[]";
    keyValue: MFVec3f = "[]";
}
VRMLNormalInterpolator: VRMLInterpolator, Kept, [],
    "Values over time." {
    key: MFFloat = "[]";
    keyValue: MFVec3f = "[]";
}
VRMLOrientationInterpolator: VRMLInterpolator, Kept, [],
    "Values over time." {
    key: MFFloat = "[]";
    keyValue: MFRotation = "[]";
}
VRMLPositionInterpolator: VRMLInterpolator, Kept, [],
    "Values over time." {
    key: MFFloat = "[]";
    keyValue: MFVec3f = "[]";
}
VRMLScalarInterpolator: VRMLInterpolator, Kept, [],
    "Values over time." {
    key: MFFloat = "[]";
    keyValue: MFFloat = "[]";
}

    } } };
}
pub(super) use vrml;
