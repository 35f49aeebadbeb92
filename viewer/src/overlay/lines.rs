//! Lines along objects: edges, normals, silhouettes as lights see them.

use glam::{DMat3, DVec3, DVec4};
use scenegraph::scene::Scene;

use super::{MOST, Meshes, Segment, as_f64, diagonal, shown, xyz};
use crate::content::positions::positions;
use crate::content::{Content, LightShape, Object, WorldLight};
use crate::volume::facing::{CastRule, facing};
use crate::volume::topology::CasterMesh;

/// Faces that meet at more than this angle have an edge between them.
const COS_EDGE: f64 = 0.866_025_403_784_438_6; // 30 degrees
/// Length of a normal, as a share of the diagonal of its object.
const NORMAL_SHARE: f64 = 0.03;

const EDGE: [u8; 4] = [20, 20, 20, 255];
const NORMAL: [u8; 4] = [40, 120, 255, 255];

/// Borders, creases, and edges where more than two faces meet.
pub fn edges(scene: &Scene, content: &Content, meshes: &mut Meshes) -> Vec<Segment> {
    let mut segments = Vec::new();
    for (index, object) in shown(content) {
        let Some(mesh) = meshes.of(scene, object) else {
            continue;
        };
        for edge in mesh.edges.iter().filter(|edge| is_sharp(mesh, edge)) {
            push(&mut segments, mesh, edge, index, EDGE);
        }
    }
    segments
}

fn push(
    segments: &mut Vec<Segment>,
    mesh: &CasterMesh,
    edge: &[u32; 4],
    object: u32,
    rgba: [u8; 4],
) {
    if segments.len() < MOST {
        segments.push(Segment {
            a: xyz(&mesh.positions[edge[0] as usize]),
            object,
            b: xyz(&mesh.positions[edge[1] as usize]),
            rgba,
        });
    }
}

fn refs<'m>(mesh: &'m CasterMesh, edge: &[u32; 4]) -> &'m [u32] {
    &mesh.refs[edge[2] as usize..][..edge[3] as usize]
}

fn is_sharp(mesh: &CasterMesh, edge: &[u32; 4]) -> bool {
    let [first, second] = refs(mesh, edge) else {
        return true;
    };
    let normal = |reference: u32| {
        let [a, b, c, _] = mesh.triangles[(reference >> 1) as usize];
        let [a, b, c] = [a, b, c].map(|i| as_f64(&mesh.positions[i as usize]));
        let normal = (b - a).cross(c - a).normalize_or_zero();
        if reference & 1 == 1 { -normal } else { normal }
    };
    // Around an edge that both faces agree upon, one runs along it and one against it.
    normal(*first).dot(-normal(*second)) < COS_EDGE
}

/// The normals of all vertices.
pub fn normals(scene: &Scene, content: &Content) -> Vec<Segment> {
    let mut segments = Vec::new();
    for (index, object) in shown(content) {
        let mesh = &scene.meshes[object.mesh.index()];
        let matrix = object.world_from_mesh.matrix3;
        let normal_matrix = matrix.inverse().transpose();
        let mesh_from_world = object.world_from_mesh.matrix3.inverse();
        let length = diagonal(&object.bounds) * NORMAL_SHARE;
        if !mesh_from_world.is_finite() {
            continue;
        }
        for (p, normal) in positions(mesh).iter().zip(&mesh.normals) {
            let way = tip(normal, &normal_matrix, &mesh_from_world, length);
            let to: [f32; 3] = std::array::from_fn(|i| p[i] + way[i]);
            if segments.len() < MOST {
                segments.push(Segment {
                    a: *p,
                    object: index,
                    b: to,
                    rgba: NORMAL,
                });
            }
        }
    }
    segments
}

/// A normal of this length in the world, in the frame of the mesh.
fn tip(normal: &[f32; 3], normal_matrix: &DMat3, mesh_from_world: &DMat3, length: f64) -> [f32; 3] {
    let normal = DVec3::from_array(normal.map(f64::from));
    let in_world = (*normal_matrix * normal).normalize_or_zero() * length;
    (*mesh_from_world * in_world).as_vec3().to_array()
}

/// The edges at which the sides of shadow volumes begin, for each light in a colour of its own.
pub fn silhouettes(scene: &Scene, content: &Content, meshes: &mut Meshes) -> Vec<Segment> {
    const COLORS: [[u8; 4]; 6] = [
        [255, 140, 0, 255],
        [0, 200, 255, 255],
        [255, 60, 160, 255],
        [120, 220, 0, 255],
        [180, 120, 255, 255],
        [255, 230, 0, 255],
    ];
    let mut segments = Vec::new();
    let mut signs = Vec::new();
    let lights = content.lights.iter().zip(COLORS.iter().cycle());
    for (light, &color) in lights.filter(|(light, _)| !light.is_black()) {
        for (index, object) in shown(content).filter(|(_, object)| object.is_caster()) {
            let in_mesh = light_in_mesh(light, object);
            let Some(mesh) = meshes.of(scene, object) else {
                continue;
            };
            facing(
                mesh,
                in_mesh,
                object.is_mirrored,
                CastRule::BothSigns,
                &mut signs,
            );
            for edge in &mesh.edges {
                let sides: i32 = refs(mesh, edge)
                    .iter()
                    .map(|reference| {
                        let sign = i32::from(signs[(reference >> 1) as usize]);
                        if reference & 1 == 1 { -sign } else { sign }
                    })
                    .sum();
                if sides != 0 {
                    push(&mut segments, mesh, edge, index, color);
                }
            }
        }
    }
    segments
}

fn light_in_mesh(light: &WorldLight, object: &Object) -> DVec4 {
    let mesh_from_world = object.world_from_mesh.inverse();
    match light.shape {
        LightShape::Directional { towards } => {
            mesh_from_world.transform_vector3(towards).extend(0.0)
        }
        LightShape::Point { p_in_world } | LightShape::Spot { p_in_world, .. } => {
            mesh_from_world.transform_point3(p_in_world).extend(1.0)
        }
    }
}
