//! What a resolved scene holds, measured in the world in f64: counts, area, volume, bounds.
//!
//! Shares no code with what it judges: it reads the scene's arrays and multiplies itself.

use std::collections::BTreeSet;

use glam::{DAffine3, DMat3, DVec3};
use scenegraph::scene::{Instance, Mesh, Scene, Topology};

/// One corner of a primitive, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Position.
    pub p_in_world: DVec3,
    /// Unit normal; `None` for unlit lines and points.
    pub n_in_world: Option<DVec3>,
    /// Texture coordinates, T upwards.
    pub texcoord: Option<[f64; 2]>,
    /// Diffuse colour.
    pub color_srgb: [f64; 3],
    /// 0 opaque.
    pub transparency: f64,
}

/// A triangle, a segment or a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Primitive {
    /// Three, two or one.
    pub corners: Vec<Corner>,
}

/// All primitives of a scene in traversal order.
pub fn primitives(scene: &Scene) -> impl Iterator<Item = Primitive> + '_ {
    scene.instances.iter().flat_map(move |instance| {
        let mesh = &scene.meshes[instance.mesh.index()];
        let size = match mesh.topology {
            Topology::Triangles => 3,
            Topology::Lines => 2,
            Topology::Points => 1,
        };
        let normals = normals_to_world(&instance.placement.world_from_local);
        mesh.indices.chunks_exact(size).map(move |indices| {
            let corner = |&i: &u32| corner(scene, instance, mesh, &normals, i as usize);
            Primitive {
                corners: indices.iter().map(corner).collect(),
            }
        })
    })
}

/// World positions of all vertices that primitives use.
pub fn world_positions(scene: &Scene) -> impl Iterator<Item = DVec3> + '_ {
    primitives(scene).flat_map(|p| p.corners.into_iter().map(|c| c.p_in_world))
}

fn corner(scene: &Scene, instance: &Instance, mesh: &Mesh, normals: &DMat3, i: usize) -> Corner {
    let material = &scene.materials[instance.material.index()];
    let p = mesh.origin + wide(mesh.positions[i]);
    let normal = mesh.normals.get(i).map(|n| *normals * wide(*n));
    let color = mesh.colors_srgb.get(i).map(|c| c.map(f64::from));
    Corner {
        p_in_world: instance.placement.world_from_local.transform_point3(p),
        n_in_world: normal.map(DVec3::normalize_or_zero),
        texcoord: mesh.texcoords.get(i).map(|t| t.map(f64::from)),
        color_srgb: color.map_or(material.diffuse_srgb, |[r, g, b, _]| [r, g, b]),
        transparency: color.map_or(material.transparency, |[.., a]| 1.0 - a),
    }
}

/// The matrix for normals: cofactors of the linear part, which also serves singular matrices.
fn normals_to_world(world_from_local: &DAffine3) -> DMat3 {
    let m = world_from_local.matrix3;
    let cofactors = DMat3::from_cols(
        m.y_axis.cross(m.z_axis),
        m.z_axis.cross(m.x_axis),
        m.x_axis.cross(m.y_axis),
    );
    if m.determinant() < 0.0 {
        -cofactors
    } else {
        cofactors
    }
}

/// Totals over a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Totals {
    /// Triangles.
    pub triangles: usize,
    /// Segments.
    pub lines: usize,
    /// Points.
    pub points: usize,
    /// Of all triangles.
    pub area: f64,
    /// Signed, about the world's origin.
    pub volume: f64,
    /// Of all segments.
    pub length: f64,
    /// Sum over triangles of area times the dot product of geometric and mean vertex normal.
    pub normal_dot: f64,
    /// Triangles with texture coordinates.
    pub textured: usize,
    /// Sums of the texture coordinates of their corners.
    pub texcoord_sum: [f64; 2],
    /// Different diffuse colours, as f32, at corners of triangles.
    pub colors: usize,
    /// Different transparencies there, to a thousandth.
    pub transparencies: usize,
    /// Lower and upper corner; `None` when there is nothing.
    pub bounds: Option<[DVec3; 2]>,
}

/// Measures a scene.
pub fn totals(scene: &Scene) -> Totals {
    let mut t = Totals {
        triangles: 0,
        lines: 0,
        points: 0,
        area: 0.0,
        volume: 0.0,
        length: 0.0,
        normal_dot: 0.0,
        textured: 0,
        texcoord_sum: [0.0; 2],
        colors: 0,
        transparencies: 0,
        bounds: None,
    };
    let (mut colors, mut transparencies) = (BTreeSet::new(), BTreeSet::new());
    for primitive in primitives(scene) {
        for corner in &primitive.corners {
            let p = corner.p_in_world;
            let [low, high] = t.bounds.unwrap_or([p, p]);
            t.bounds = Some([low.min(p), high.max(p)]);
        }
        match primitive.corners[..] {
            [a, b, c] => {
                let (p, q, r) = (a.p_in_world, b.p_in_world, c.p_in_world);
                let twice_area = (q - p).cross(r - p);
                t.triangles += 1;
                t.textured += usize::from(a.texcoord.is_some());
                for corner in [a, b, c] {
                    let [u, v] = corner.texcoord.unwrap_or_default();
                    t.texcoord_sum = [t.texcoord_sum[0] + u, t.texcoord_sum[1] + v];
                    colors.insert(corner.color_srgb.map(|x| (x as f32).to_bits()));
                    transparencies.insert((1000.0 * corner.transparency).round() as i64);
                }
                t.area += 0.5 * twice_area.length();
                t.volume += p.dot(q.cross(r)) / 6.0;
            }
            [a, b] => {
                t.lines += 1;
                t.length += a.p_in_world.distance(b.p_in_world);
            }
            _ => t.points += 1,
        }
    }
    t.colors = colors.len();
    t.transparencies = transparencies.len();
    t.normal_dot = normal_dot(scene);
    t
}

/// Sum over the triangles of area times the dot product of the geometric normal and the mean of
/// the three vertex normals, in the frames of the shapes: 1 times the area when they agree.
fn normal_dot(scene: &Scene) -> f64 {
    let of_mesh = |mesh: &Mesh| {
        if mesh.topology != Topology::Triangles || mesh.normals.is_empty() {
            return 0.0;
        }
        let dot = |t: &[u32]| {
            let [p, q, r] = [t[0], t[1], t[2]].map(|i| wide(mesh.positions[i as usize]));
            let [a, b, c] = [t[0], t[1], t[2]].map(|i| wide(mesh.normals[i as usize]));
            0.5 * (q - p).cross(r - p).dot((a + b + c) / 3.0)
        };
        mesh.indices.chunks_exact(3).map(dot).sum()
    };
    let meshes: Vec<f64> = scene.meshes.iter().map(of_mesh).collect();
    let of_instance = |i: &Instance| meshes[i.mesh.index()];
    scene.instances.iter().map(of_instance).sum()
}

fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}
