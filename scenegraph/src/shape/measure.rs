//! The size of a shape without making it: counts and bounds from the index lists alone. Only what a
//! `DrawStyle` shows as edges or corners is made, because each is drawn once, and NURBS are.

use geometry::bounds::Aabb;

use crate::registry::Class;
use crate::remarks::Remarks;
use crate::resolve::Style;
use crate::scene::{Mesh, Topology};

use super::attributes::Attributes;
use super::{Job, corners, faces, is_nurbs, nurbs, outline, point, primitives, text};

/// How much a shape draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// Of what.
    pub topology: Topology,
    /// Triangles (of polygons: corners less two), segments or points. Degenerate ones count.
    pub primitives: usize,
    /// Around what is drawn, in the local frame.
    pub bounds: Aabb,
}

/// Whether a shape must be made to be measured.
pub fn makes_mesh(job: &Job<'_>) -> bool {
    text::is_text(job.class)
        || is_nurbs(job.class)
        || matches!(job.style, Style::Lines | Style::Points)
}

/// The size of a shape; `None` if it draws nothing.
pub fn measure(
    job: &Job<'_>,
    attributes: &Attributes<'_>,
    glyphs: &mut text::GlyphCache,
) -> Option<Measure> {
    if text::is_text(job.class) {
        // What is wrong with a shape is said when it is made.
        let mesh = text::mesh(job, attributes, glyphs, &mut Remarks::default())?;
        return of_mesh(&outline::styled_primitive(mesh, job.style)?);
    }
    if matches!(job.style, Style::Lines | Style::Points) {
        match job.class {
            Class::Cube | Class::Sphere | Class::Cone | Class::Cylinder => {
                return styled_primitive(job, attributes);
            }
            Class::FaceSet
            | Class::IndexedFaceSet
            | Class::TriangleStripSet
            | Class::IndexedTriangleStripSet
            | Class::QuadMesh => return styled_faces(job, attributes),
            _ => {}
        }
    }
    if is_nurbs(job.class) {
        return made_nurbs(job, attributes);
    }
    let topology = match job.class {
        Class::LineSet | Class::IndexedLineSet => Topology::Lines,
        Class::PointSet | Class::IndexedPointSet | Class::MarkerSet | Class::IndexedMarkerSet => {
            Topology::Points
        }
        _ => Topology::Triangles,
    };
    if let Some(bounds) = primitives::bounds(job.class, attributes) {
        let primitives = primitives::triangle_count(job.class, attributes, job.state.complexity);
        return (primitives > 0).then_some(Measure {
            topology,
            primitives,
            bounds,
        });
    }
    let mut bounds = Aabb::EMPTY;
    let at = |i: usize| point(attributes.coordinates, attributes.coordinate_size, i);
    // Corners of a run that draw: `less` of them only begin it.
    let less = match job.class {
        Class::LineSet | Class::IndexedLineSet => 1,
        Class::PointSet | Class::IndexedPointSet | Class::MarkerSet | Class::IndexedMarkerSet => 0,
        _ => 2,
    };
    let node = attributes.node;
    let mut primitives = 0;
    let is_indexed = |c: Class| c.spec().field(b"coordIndex").is_some();
    if is_indexed(job.class) {
        let exists = |v: &i32| (*v as usize) < attributes.coordinate_count();
        for run in attributes.ints("coordIndex").split(|&v| v < 0) {
            // A bad index costs a face or strip whole, of a polyline only its segments.
            let pieces: Vec<&[i32]> = match less {
                2 => vec![if run.iter().all(exists) { run } else { &[] }],
                _ => run.split(|v| !exists(v)).collect(),
            };
            for piece in pieces.into_iter().filter(|piece| piece.len() > less) {
                primitives += piece.len() - less;
                let points = piece.iter().filter_map(|&v| at(v as usize));
                points.for_each(|p| bounds.include(p));
            }
        }
    } else if job.class == Class::QuadMesh {
        let start = node.int("startIndex").max(0) as usize;
        let columns = node.int("verticesPerRow").max(0) as usize;
        let available = attributes.coordinate_count().saturating_sub(start);
        let rows = (node.int("verticesPerColumn").max(0) as usize)
            .min(available.checked_div(columns).unwrap_or(0));
        if rows > 1 && columns > 1 {
            primitives = 2 * (rows - 1) * (columns - 1);
            (start..start + rows * columns)
                .filter_map(at)
                .for_each(|p| bounds.include(p));
        }
    } else {
        let field = if less == 0 {
            "numPoints"
        } else {
            "numVertices"
        };
        let total = attributes.coordinate_count();
        let mut next = attributes.start_index().min(total);
        for &count in attributes.ints(field) {
            let len = usize::try_from(count)
                .unwrap_or(usize::MAX)
                .min(total - next);
            if len > less {
                primitives += len - less;
                (next..next + len)
                    .filter_map(at)
                    .for_each(|p| bounds.include(p));
            }
            next += len;
            if next == total || less == 0 {
                break;
            }
        }
    }
    (primitives > 0).then_some(Measure {
        topology,
        primitives,
        bounds,
    })
}

/// Faces drawn as edges or corners. Each is drawn once, so they are looked for as for the mesh.
fn styled_faces(job: &Job<'_>, attributes: &Attributes<'_>) -> Option<Measure> {
    // What is wrong with a shape is said when it is made.
    let faces = faces::faces(
        job,
        attributes,
        corners::Spare::default(),
        &mut Remarks::default(),
    )?;
    let (corners, topology) = outline::styled(faces, job.style);
    let mut bounds = Aabb::EMPTY;
    let at = |&i: &u32| {
        let size = attributes.coordinate_size;
        point(attributes.coordinates, size, i as usize)
    };
    let points = corners.coordinates.iter().filter_map(at);
    points.for_each(|p| bounds.include(p));
    let primitives = corners.coordinates.len() / corners.step;
    (primitives > 0).then_some(Measure {
        topology,
        primitives,
        bounds,
    })
}

/// A curve or surface, whose size only its mesh tells.
fn made_nurbs(job: &Job<'_>, attributes: &Attributes<'_>) -> Option<Measure> {
    // What is wrong with a shape is said when it is made.
    let mesh = nurbs::mesh(job, attributes, &mut Remarks::default())?;
    let mut bounds = Aabb::EMPTY;
    let corners = mesh.indices.iter();
    corners.for_each(|&i| bounds.include(mesh.p_in_local(i)));
    Some(Measure {
        topology: mesh.topology,
        primitives: mesh.primitive_count(),
        bounds,
    })
}

/// A primitive drawn as edges or corners.
fn styled_primitive(job: &Job<'_>, attributes: &Attributes<'_>) -> Option<Measure> {
    let bounds = primitives::bounds(job.class, attributes)?;
    let mesh = primitives::mesh(job, attributes)?;
    let mesh = outline::styled_primitive(mesh, job.style)?;
    Some(Measure {
        topology: mesh.topology,
        primitives: mesh.primitive_count(),
        bounds,
    })
}

/// The size of what had to be made.
fn of_mesh(mesh: &Mesh) -> Option<Measure> {
    let mut bounds = Aabb::EMPTY;
    (0..mesh.positions.len() as u32).for_each(|i| bounds.include(mesh.p_in_local(i)));
    Some(Measure {
        topology: mesh.topology,
        primitives: mesh.primitive_count(),
        bounds,
    })
}
