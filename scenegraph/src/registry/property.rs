//! Geometry properties: coordinates, normals, texture coordinates, profiles.

macro_rules! property {
    ([$next:ident $($rest:ident)*] $($seen:tt)*) => { $next! { [$($rest)*] $($seen)* Property {

Coordinate3: Node, Full, [],
    "Points of the following vertex shapes." {
    point: MFVec3f = "0 0 0";
}
Coordinate4: Node, Full, [],
    "Points with a weight: x·w, y·w, z·w, w." {
    point: MFVec4f = "0 0 0 1";
}
Normal: Node, Full, [],
    "Normals of the following vertex shapes." {
    vector: MFVec3f = "[]";
}
NormalBinding: Node, Full, [],
    "How normals are dealt out over a shape. DEFAULT and NONE mean PER_VERTEX_INDEXED." {
    value: SFEnum = "DEFAULT" in NORMAL_BINDING;
}
TextureCoordinate2: Node, Full, [],
    "Texture coordinates." {
    point: MFVec2f = "[]";
}
TextureCoordinate3: Node, Full, [],
    "Texture coordinates in space; a Texture2 takes s and t as they are, and no r. Coin and TGS \
     addition." {
    point: MFVec3f = "[]";
}
TextureCoordinateBinding: Node, Full, [],
    "How texture coordinates are dealt out. DEFAULT means PER_VERTEX_INDEXED." {
    value: SFEnum = "PER_VERTEX_INDEXED" [PER_VERTEX, PER_VERTEX_INDEXED, DEFAULT = 1];
}
TextureCoordinateDefault: TextureCoordinateFunction, Full, [],
    "Back to each shape's own texture coordinates." {}
TextureCoordinateEnvironment: TextureCoordinateFunction, Planned, [],
    "Texture coordinates from the reflected view direction." {}
TextureCoordinatePlane: TextureCoordinateFunction, Full, [],
    "Texture coordinates by projection on a plane. directionR is Coin's and TGS's." {
    directionS: SFVec3f = "1 0 0";
    directionT: SFVec3f = "0 1 0";
    directionR: SFVec3f = "0 0 1";
}
TextureCoordinateObject: TextureCoordinateFunction, Partial, [],
    "Texture coordinates by planes in object space; R and Q are not used. Coin addition." {
    factorS: SFVec4f = "1 0 0 0";
    factorT: SFVec4f = "0 1 0 0";
    factorR: SFVec4f = "0 0 1 0";
    factorQ: SFVec4f = "0 0 0 1";
}
TextureCoordinateCube: TextureCoordinateFunction, Planned, [],
    "Texture coordinates by projection on a cube. Coin addition; Inventor 1 had other fields." {}
TextureCoordinateCylinder: TextureCoordinateFunction, Planned, [],
    "Texture coordinates by projection on a cylinder. Coin addition; Inventor 1 had other fields." {}
TextureCoordinateSphere: TextureCoordinateFunction, Planned, [],
    "Texture coordinates by projection on a sphere. Coin addition; Inventor 1 had other fields." {}
TextureCoordinateNormalMap: TextureCoordinateFunction, Planned, [],
    "Cube map coordinates along the normal. Coin addition." {}
TextureCoordinateReflectionMap: TextureCoordinateFunction, Planned, [],
    "Cube map coordinates along the reflected view direction. Coin addition." {}
GeoCoordinate: Node, Planned, [],
    "Points on the globe. Coin addition." {
    point: MFVec3d = "0 0 0";
    geoSystem: MFString = "[ \"GD\", \"WE\" ]";
}
VertexAttribute: Node, Kept, [],
    "Values for a vertex shader. Coin addition." {
    name: SFName = "\"\"";
    typeName: SFName = "\"\"";
}
VertexAttributeBinding: Node, Kept, [],
    "How vertex attributes are dealt out. Coin addition." {
    value: SFEnum = "OVERALL" [OVERALL, PER_VERTEX, PER_VERTEX_INDEXED, DEFAULT = 2];
}
VertexProperty: Node, Partial, [],
    "Coordinates, normals, colours and texture coordinates in one node; lists that are not empty \
     override the state. texCoord3 (s and t of it) and textureUnit are Coin's and TGS's; \
     textureUnit is not used." {
    vertex: MFVec3f = "[]";
    texCoord: MFVec2f = "[]";
    texCoord3: MFVec3f = "[]";
    normal: MFVec3f = "[]";
    normalBinding: SFEnum = "PER_VERTEX_INDEXED" in NORMAL_BINDING;
    orderedRGBA: MFUInt32 = "[]";
    materialBinding: SFEnum = "OVERALL" in MATERIAL_BINDING;
    textureUnit: MFInt32 = "0";
}
ProfileCoordinate2: Node, Full, [],
    "Points of the following profiles." {
    point: MFVec2f = "0 0";
}
ProfileCoordinate3: Node, Full, [],
    "Points of the following profiles with a weight." {
    point: MFVec3f = "0 0 1";
}
LinearProfile: Profile, Full, [PROFILE],
    "Polygon that trims a NURBS surface or shapes Text3. For Text3 the first of a set counts." {}
NurbsProfile: Profile, Full, [PROFILE],
    "Curve that trims a NURBS surface or shapes Text3." {
    knotVector: MFFloat = "0";
}

    } } };
}
pub(super) use property;
