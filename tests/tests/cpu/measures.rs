//! What `Geometry::Measure` counts is what `Geometry::Build` makes.

use std::path::Path;

use geometry::bounds::Aabb;
use scenegraph::scene::{Mesh, Topology};
use scenegraph::{FileLoader, Geometry, ResolveOptions, load, resolve};

/// Under a list of nine coordinates, a grid of 3 by 3.
const SHAPES: &[&str] = &[
    "Cube { }",
    "Sphere { }",
    "Cone { parts SIDES }",
    "Cylinder { }",
    "FaceSet { startIndex 1 numVertices [ 3, 3 ] }",
    "IndexedFaceSet { coordIndex [ 0, 1, 4, 3, -1, 1, 2, 5, 4, -1 ] }",
    "TriangleStripSet { numVertices 6 }",
    "IndexedTriangleStripSet { coordIndex [ 0, 3, 1, 4, 2, 5, -1 ] }",
    "QuadMesh { verticesPerRow 3 verticesPerColumn 3 }",
    "IndexedLineSet { coordIndex [ 0, 1, 2, -1, 3, 4, -1 ] }",
    "PointSet { numPoints 5 }",
    "NurbsCurve { numControlPoints 5 knotVector [ 0, 0, 0, 1, 2, 3, 3, 3 ] }",
    "NurbsSurface { numUControlPoints 3 numVControlPoints 3
        uKnotVector [ 0, 0, 0, 1, 1, 1 ] vKnotVector [ 0, 0, 1, 2, 2 ] }",
];

fn bounds_of(mesh: &Mesh) -> Aabb {
    let mut bounds = Aabb::EMPTY;
    for &i in &mesh.indices {
        bounds.include(mesh.p_in_local(i));
    }
    bounds
}

#[test]
fn measured_is_made_in_every_style() {
    for style in ["FILLED", "LINES", "POINTS"] {
        for shape in SHAPES {
            let text = format!(
                "#Inventor V2.1 ascii\nSeparator {{ DrawStyle {{ style {style} }}
                Coordinate3 {{ point [ 0 0 0, 1 0 0, 2 0 0, 0 1 0, 1 1 1, 2 1 0,
                    0 2 0, 1 2 0, 2 2 0 ] }} {shape} }}"
            );
            let loader = FileLoader::default();
            let graph = load(text.as_bytes(), "shape.iv", Path::new("."), &loader);
            let resolved = |geometry| {
                let options = ResolveOptions {
                    geometry,
                    ..ResolveOptions::default()
                };
                resolve(&graph, &options)
            };
            let made = resolved(Geometry::Build).scene.meshes;
            let measured = resolved(Geometry::Measure).measures;
            let made: Vec<(Topology, usize, Aabb)> = made
                .iter()
                .map(|mesh| (mesh.topology, mesh.primitive_count(), bounds_of(mesh)))
                .collect();
            let measured: Vec<(Topology, usize, Aabb)> = measured
                .iter()
                .map(|m| (m.topology, m.primitives, m.bounds))
                .collect();
            assert_eq!(measured, made, "{shape} as {style}");
        }
    }
}
