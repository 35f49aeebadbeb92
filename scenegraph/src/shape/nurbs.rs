//! NurbsCurve, NurbsSurface and their indexed kin: from Inventor's fields to segments and
//! triangles. Evaluating, dividing and trimming are `geometry::nurbs`; profiles are read in
//! `profiles.rs`.
//!
//! Points and knots are GLU's: the order is the number of knots less that of points, points of a
//! surface stand with U fastest, and those of a Coordinate4 are multiplied by their weight. The
//! front is where dS/du x dS/dv points, and normals are the surface's own.

use geometry::nurbs::{Curve, Fineness, NurbsError, Surface, SurfaceMesh};
use glam::{DVec2, DVec3, DVec4, Vec3};

use crate::registry::Class;
use crate::remarks::Remarks;
use crate::resolve::Ordering;
use crate::scene::{Mesh, Topology};

use super::Job;
use super::assemble::{drop_collapsed, fill_positions, turn};
use super::attributes::{Attributes, TexCoordList, TexCoordSource};
use super::outline;
use super::primitives::slices;
use super::profiles::trim_loops;
use super::texcoords::{function, transformed};

/// Vertices for each control point, unless a chord is asked for: so large weights or wild nets, and
/// small files of many, do not become large models. A patch of a teapot takes about 15.
const POINTS_EACH: usize = 64;

/// Vertices that every shape may have, however few its control points.
const MIN_POINTS: usize = 16_384;

/// Whether a class is made here.
pub fn is_nurbs(class: Class) -> bool {
    is_trimmed(class) || matches!(class, Class::NurbsCurve | Class::IndexedNurbsCurve)
}

/// Whether profiles trim a class.
pub fn is_trimmed(class: Class) -> bool {
    matches!(class, Class::NurbsSurface | Class::IndexedNurbsSurface)
}

/// The mesh of a curve or surface; `None`, with a remark, if there is none.
pub fn mesh(job: &Job<'_>, attributes: &Attributes<'_>, remarks: &mut Remarks) -> Option<Mesh> {
    let made = if is_trimmed(job.class) {
        surface(job, attributes, remarks)
    } else {
        curve(job, attributes, remarks)
    };
    made.unwrap_or_else(|error| {
        let message = format!("{}: {error}", attributes.node.class_name());
        let hint = "it was left out";
        remarks.warn("bad-nurbs", &message, hint, attributes.pos);
        None
    })
}

/// How finely a shape is cut whose control points have a box with this diagonal: as asked for, or
/// with as many slices `n` to a full turn as a sphere of that complexity has, and a chord of at most
/// `1 - cos(pi / n)` of the diagonal, which is what such slices miss of a radius.
fn fineness(job: &Job<'_>, diagonal: f64, points: usize) -> Fineness {
    if let Some(chord) = job.chord {
        return Fineness {
            chord,
            turn_rad: f64::INFINITY,
            most_points: usize::MAX,
        };
    }
    let n = f64::from(slices(job.state.complexity));
    Fineness {
        // A shape whose points are all in one place has nothing to divide.
        chord: (diagonal * (1.0 - (std::f64::consts::PI / n).cos())).max(f64::MIN_POSITIVE),
        turn_rad: std::f64::consts::TAU / n,
        most_points: MIN_POINTS.max(POINTS_EACH.saturating_mul(points)),
    }
}

fn warn_coarse(asked: f64, bound: f64, attributes: &Attributes<'_>, remarks: &mut Remarks) {
    // A bound is at most the chord asked for but for a rounding error.
    if bound > asked * 1.01 {
        remarks.warn(
            "coarse-nurbs",
            &format!(
                "{} is cut more coarsely than its chord tolerance asks for",
                attributes.node.class_name()
            ),
            "it would have too many parts",
            attributes.pos,
        );
    }
}

/// A number of control points as the field has it; negative counts as none.
fn count(attributes: &Attributes<'_>, field: &str) -> usize {
    usize::try_from(attributes.node.int(field)).unwrap_or(0)
}

/// The first `count` control points, by index if the class has indices.
fn control_points(attributes: &Attributes<'_>, count: usize) -> Result<Vec<DVec4>, NurbsError> {
    let indexed = matches!(
        attributes.node.class(),
        Some(Class::IndexedNurbsCurve | Class::IndexedNurbsSurface)
    );
    let size = attributes.coordinate_size;
    let point = |index: usize| match *attributes
        .coordinates
        .get(index.checked_mul(size)?..index.checked_add(1)?.checked_mul(size)?)?
    {
        [x, y, z] => Some(DVec4::new(x, y, z, 1.0)),
        [x, y, z, w] => Some(DVec4::new(x, y, z, w)),
        _ => None,
    };
    let points: Option<Vec<DVec4>> = if indexed {
        let indices = attributes.node.ints("coordIndex").get(..count);
        let point_of = |&i: &i32| usize::try_from(i).ok().and_then(point);
        indices.and_then(|list| list.iter().map(point_of).collect())
    } else if count <= attributes.coordinate_count() {
        (0..count).map(point).collect()
    } else {
        None
    };
    points.ok_or(NurbsError::PointCount)
}

fn knots(attributes: &Attributes<'_>, field: &str) -> Vec<f64> {
    attributes.node.numbers(field).to_vec()
}

fn empty_mesh(topology: Topology, attributes: &Attributes<'_>) -> Mesh {
    Mesh {
        topology,
        origin: DVec3::ZERO,
        positions: Vec::new(),
        normals: Vec::new(),
        texcoords: Vec::new(),
        colors_srgb: Vec::new(),
        indices: Vec::new(),
        pos: attributes.pos,
    }
}

fn curve(
    job: &Job<'_>,
    attributes: &Attributes<'_>,
    remarks: &mut Remarks,
) -> Result<Option<Mesh>, NurbsError> {
    let count = count(attributes, "numControlPoints");
    if count == 0 {
        return Ok(None);
    }
    let points = control_points(attributes, count)?;
    let curve = Curve::new(points, knots(attributes, "knotVector"))?;
    let fineness = fineness(job, curve.diagonal(), count);
    let line = curve.polyline(&fineness)?;
    warn_coarse(fineness.chord, line.chord_bound, attributes, remarks);
    let mut mesh = empty_mesh(Topology::Lines, attributes);
    (mesh.origin, _) = fill_positions(line.points.iter().copied(), &mut mesh.positions);
    let last = mesh.positions.len() as u32 - 1;
    mesh.indices = (0..last).flat_map(|i| [i, i + 1]).collect();
    let differ = |i: &[u32; 2]| mesh.positions[i[0] as usize] != mesh.positions[i[1] as usize];
    let draws = mesh.indices.as_chunks::<2>().0.iter().any(differ);
    Ok(draws.then_some(mesh))
}

fn surface(
    job: &Job<'_>,
    attributes: &Attributes<'_>,
    remarks: &mut Remarks,
) -> Result<Option<Mesh>, NurbsError> {
    let u_count = count(attributes, "numUControlPoints");
    let v_count = count(attributes, "numVControlPoints");
    if u_count == 0 && v_count == 0 {
        return Ok(None);
    }
    let total = u_count.checked_mul(v_count).ok_or(NurbsError::TooLarge)?;
    let points = control_points(attributes, total)?;
    let [u_knots, v_knots] = ["uKnotVector", "vKnotVector"].map(|f| knots(attributes, f));
    let surface = Surface::new(points, u_count, u_knots, v_knots)?;
    let texture = Texture::of(attributes, &surface, remarks);
    let lines = texture.as_ref().map_or((&[][..], &[][..]), Texture::knots);
    let trim = trim_loops(job, remarks);
    let fineness = fineness(job, surface.diagonal(), total);
    let made = surface.triangles(&fineness, lines, &trim)?;
    warn_coarse(fineness.chord, made.chord_bound, attributes, remarks);
    if made.trim_crossings > 0 {
        remarks.warn(
            "crossing-trim",
            &format!(
                "trimming curves of a {} cross each other",
                attributes.node.class_name()
            ),
            "what is inside there is a guess",
            attributes.pos,
        );
    }
    let mut mesh = filled(made, texture.as_ref(), job, attributes);
    drop_collapsed(&mut mesh);
    if attributes.ordering == Ordering::Clockwise {
        turn(&mut mesh, true);
    }
    Ok(outline::styled_primitive(mesh, job.style).filter(|mesh| !mesh.indices.is_empty()))
}

fn filled(
    made: SurfaceMesh,
    texture: Option<&Texture<'_>>,
    job: &Job<'_>,
    attributes: &Attributes<'_>,
) -> Mesh {
    let mut mesh = empty_mesh(Topology::Triangles, attributes);
    (mesh.origin, _) = fill_positions(made.points.iter().copied(), &mut mesh.positions);
    if job.lit {
        // Adding zero turns -0 into +0.
        let store = |n: &DVec3| (n.as_vec3().normalize_or(Vec3::Z) + Vec3::ZERO).to_array();
        mesh.normals = made.normals.iter().map(store).collect();
    }
    if let Some(texture) = texture {
        let places = made.parameters.iter().zip(&made.points);
        mesh.texcoords = places
            .map(|(&at, &p)| transformed(&attributes.texture_transform, texture.texcoord(at, p)))
            .collect();
    }
    mesh.indices = made.triangles.into_flattened();
    mesh
}

/// Where the texture coordinates of a surface come from.
enum Texture<'g> {
    /// The edges of the texture are stretched to those of the surface.
    Domain { low: DVec2, size: DVec2 },
    /// A surface in texture space, and its knots.
    Surface(Surface, Vec<f64>, Vec<f64>),
    /// `TextureCoordinatePlane` or `TextureCoordinateObject`.
    Function(&'g crate::graph::Node),
}

impl<'g> Texture<'g> {
    fn of(attributes: &Attributes<'g>, surface: &Surface, remarks: &mut Remarks) -> Option<Self> {
        let ((u0, u1), (v0, v1)) = (surface.domain_u(), surface.domain_v());
        let domain = Self::Domain {
            low: DVec2::new(u0, v0),
            size: DVec2::new(u1 - u0, v1 - v0),
        };
        let s_count = count(attributes, "numSControlPoints");
        let t_count = count(attributes, "numTControlPoints");
        match attributes.texcoords? {
            TexCoordSource::Function(node) => Some(Self::Function(node)),
            TexCoordSource::List(list) if s_count > 0 && t_count > 0 => {
                let [s, t] = ["sKnotVector", "tKnotVector"].map(|f| knots(attributes, f));
                let made = texture_points(attributes, &list, s_count, t_count)
                    .and_then(|points| Surface::new(points, s_count, s.clone(), t.clone()));
                match made {
                    Ok(surface) => Some(Self::Surface(surface, s, t)),
                    Err(error) => {
                        let class = attributes.node.class_name();
                        remarks.warn(
                            "bad-nurbs",
                            &format!("texture coordinates of a {class}: {error}"),
                            "the texture was stretched to the surface's edges",
                            attributes.pos,
                        );
                        Some(domain)
                    }
                }
            }
            _ => Some(domain),
        }
    }

    fn knots(&self) -> (&[f64], &[f64]) {
        match self {
            Self::Surface(_, s, t) => (s, t),
            _ => (&[], &[]),
        }
    }

    fn texcoord(&self, at: DVec2, p: DVec3) -> DVec2 {
        match self {
            Self::Domain { low, size } => (at - low) / size,
            Self::Surface(surface, ..) => surface.point(at.x, at.y).p.truncate(),
            Self::Function(node) => function(node, p),
        }
    }
}

/// The control points of texture coordinates: by index if the class has a list of indices that does
/// not begin with -1.
fn texture_points(
    attributes: &Attributes<'_>,
    list: &TexCoordList<'_>,
    s_count: usize,
    t_count: usize,
) -> Result<Vec<DVec4>, NurbsError> {
    let total = s_count.checked_mul(t_count).ok_or(NurbsError::TooLarge)?;
    let indices: Option<&[i32]> = (attributes.node.class() == Some(Class::IndexedNurbsSurface))
        .then(|| attributes.node.ints("textureCoordIndex"))
        .filter(|list| list.first().is_some_and(|&i| i >= 0));
    let available = indices.map_or(list.len(), <[i32]>::len);
    if total > available {
        return Err(NurbsError::PointCount);
    }
    let point = |k: usize| {
        let index = indices.map_or(Some(k), |list| usize::try_from(list[k]).ok())?;
        let st = (index < list.len()).then(|| list.get(index))?;
        Some(DVec4::new(st.x, st.y, 0.0, 1.0))
    };
    let points: Option<Vec<DVec4>> = (0..total).map(point).collect();
    points.ok_or(NurbsError::PointCount)
}
