//! Everything that draws.

macro_rules! shapes {
    ([$next:ident $($rest:ident)*] $($seen:tt)*) => { $next! { [$($rest)*] $($seen)* Shape {

Cube: Shape, Full, [],
    "Box about the origin." {
    width: SFFloat = "2";
    height: SFFloat = "2";
    depth: SFFloat = "2";
}
Sphere: Shape, Full, [],
    "Sphere about the origin." {
    radius: SFFloat = "1";
}
Cone: Shape, Full, [],
    "Cone about the y axis, tip up." {
    parts: SFBitMask = "ALL" [SIDES = 1, BOTTOM = 2, ALL = 3];
    bottomRadius: SFFloat = "1";
    height: SFFloat = "2";
}
Cylinder: Shape, Full, [],
    "Cylinder about the y axis." {
    parts: SFBitMask = "ALL" [SIDES = 1, TOP = 2, BOTTOM = 4, ALL = 7];
    radius: SFFloat = "1";
    height: SFFloat = "2";
}
FaceSet: NonIndexedShape, Full, [VERTEX_SHAPE, NON_INDEXED, VERTEX_COUNTS],
    "Polygons from consecutive points; the count -1 takes all that are left." {}
IndexedFaceSet: IndexedShape, Full, [VERTEX_SHAPE, INDEXED],
    "Polygons by index, each ended by -1." {}
TriangleStripSet: NonIndexedShape, Full, [VERTEX_SHAPE, NON_INDEXED, VERTEX_COUNTS],
    "Triangle strips from consecutive points." {}
IndexedTriangleStripSet: IndexedShape, Full, [VERTEX_SHAPE, INDEXED],
    "Triangle strips by index, each ended by -1." {}
QuadMesh: NonIndexedShape, Full, [VERTEX_SHAPE, NON_INDEXED],
    "Grid of quadrilaterals from rows of points." {
    verticesPerColumn: SFInt32 = "1";
    verticesPerRow: SFInt32 = "1";
}
LineSet: NonIndexedShape, Full, [VERTEX_SHAPE, NON_INDEXED, VERTEX_COUNTS],
    "Polylines from consecutive points." {}
IndexedLineSet: IndexedShape, Full, [VERTEX_SHAPE, INDEXED],
    "Polylines by index, each ended by -1." {}
PointSet: NonIndexedShape, Full, [VERTEX_SHAPE, NON_INDEXED, POINT_COUNT],
    "Points." {}
IndexedPointSet: IndexedShape, Full, [VERTEX_SHAPE, INDEXED],
    "Points by index. Coin and TGS addition." {}
MarkerSet: PointSet, Partial, [VERTEX_SHAPE, NON_INDEXED, POINT_COUNT],
    "Small pictures at points; drawn as points. markerIndex is Coin's and TGS's." {
    markerIndex: MFInt32 = "0";
}
IndexedMarkerSet: IndexedPointSet, Partial, [VERTEX_SHAPE, INDEXED],
    "Small pictures at indexed points; drawn as points. Coin and TGS addition." {
    markerIndex: MFInt32 = "0";
}
Text2: Shape, Partial, [],
    "Text that faces the viewer, in pixels; here flat text in the world, as one view shows it." {
    string: MFString = "\"\"";
    spacing: SFFloat = "1";
    justification: SFEnum = "LEFT" in JUSTIFICATION;
}
Text3: Shape, Full, [],
    "Solid text, as deep as the profile in force, or 1." {
    string: MFString = "\"\"";
    spacing: SFFloat = "1";
    justification: SFEnum = "LEFT" in JUSTIFICATION;
    parts: SFBitMask = "FRONT" [FRONT = 1, SIDES = 2, BACK = 4, ALL = 7];
}
AsciiText: Shape, Full, [],
    "Flat text; `width` is the length that a line is stretched to, as in VRML 1. Coin ignores it." {
    string: MFString = "\"\"";
    spacing: SFFloat = "1";
    justification: SFEnum = "LEFT" in JUSTIFICATION;
    width: MFFloat = "0";
}
Image: Shape, Planned, [],
    "Picture that faces the viewer, in screen size. Coin and TGS addition." {
    width: SFInt32 = "-1";
    height: SFInt32 = "-1";
    vertAlignment: SFEnum = "BOTTOM" [BOTTOM, HALF, TOP];
    horAlignment: SFEnum = "LEFT" [LEFT, CENTER, RIGHT];
    image: SFImage = "0 0 0";
    filename: SFString = "\"\"";
}
NurbsCurve: Shape, Full, [],
    "Rational B-spline curve." {
    numControlPoints: SFInt32 = "0";
    knotVector: MFFloat = "0";
}
IndexedNurbsCurve: Shape, Full, [],
    "Rational B-spline curve, points by index." {
    numControlPoints: SFInt32 = "0";
    coordIndex: MFInt32 = "0";
    knotVector: MFFloat = "0";
}
NurbsSurface: Shape, Full, [],
    "Rational B-spline surface, trimmed by the profiles before it." {
    numUControlPoints: SFInt32 = "0";
    numVControlPoints: SFInt32 = "0";
    numSControlPoints: SFInt32 = "0";
    numTControlPoints: SFInt32 = "0";
    uKnotVector: MFFloat = "0";
    vKnotVector: MFFloat = "0";
    sKnotVector: MFFloat = "0";
    tKnotVector: MFFloat = "0";
}
IndexedNurbsSurface: Shape, Full, [],
    "Rational B-spline surface, points by index." {
    numUControlPoints: SFInt32 = "0";
    numVControlPoints: SFInt32 = "0";
    coordIndex: MFInt32 = "0";
    uKnotVector: MFFloat = "0";
    vKnotVector: MFFloat = "0";
    numSControlPoints: SFInt32 = "0";
    numTControlPoints: SFInt32 = "0";
    textureCoordIndex: MFInt32 = "-1";
    sKnotVector: MFFloat = "0";
    tKnotVector: MFFloat = "0";
}

    } } };
}
pub(super) use shapes;
