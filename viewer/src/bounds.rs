//! World boxes of what a scene draws, computed once, in f64. Not a tree: frames have few enough
//! instances to look at each.

use geometry::bounds::Aabb;
use geometry::num::gamma;
use glam::{DAffine3, DVec3};
use scenegraph::scene::{Mesh, Scene};

/// Boxes around meshes and instances.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneBounds {
    /// In the local frame, by `MeshId`: the box around all vertices that an index uses.
    pub meshes: Vec<Aabb>,
    /// In the world, by position in `Scene::instances`. Each holds the whole instance, also as
    /// rounded by transforms in f64.
    pub instances: Vec<Aabb>,
    /// Around all instances; empty if there are none.
    pub scene: Aabb,
}

impl SceneBounds {
    /// Looks at each vertex of each mesh once.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let meshes: Vec<Aabb> = scene.meshes.iter().map(mesh_box).collect();
        let instances: Vec<Aabb> = (scene.instances.iter())
            .map(|instance| {
                let in_local = meshes.get(instance.mesh.index()).copied();
                let world_from_local = &instance.placement.world_from_local;
                world_box(&in_local.unwrap_or_default(), world_from_local)
            })
            .collect();
        let scene = (instances.iter()).fold(Aabb::EMPTY, |all, b| all.union(b));
        Self {
            meshes,
            instances,
            scene,
        }
    }
}

/// The box in the local frame around all vertices that an index uses.
#[must_use]
pub fn mesh_box(mesh: &Mesh) -> Aabb {
    let mut min = [f32::INFINITY; 3];
    let mut max = [f32::NEG_INFINITY; 3];
    for &i in &mesh.indices {
        let Some(position) = mesh.positions.get(i as usize) else {
            continue;
        };
        for axis in 0..3 {
            min[axis] = min[axis].min(position[axis]);
            max[axis] = max[axis].max(position[axis]);
        }
    }
    // Rounding keeps order, so adding the origin to the ends gives the ends of the sums.
    let at = |[x, y, z]: [f32; 3]| mesh.origin + DVec3::new(x.into(), y.into(), z.into());
    Aabb {
        min: at(min),
        max: at(max),
    }
}

/// Coordinates beyond this are cut to it, so that centres and sizes of boxes stay finite.
const LARGEST: f64 = 1e300;

/// A box in the world around the image of a local box, grown by the rounding errors of the
/// transform. Empty for an empty box; never empty for another.
#[must_use]
pub fn world_box(in_local: &Aabb, world_from_local: &DAffine3) -> Aabb {
    if in_local.is_empty() {
        return Aabb::EMPTY;
    }
    // Arvo, "Transforming Axis-Aligned Bounding Boxes", Graphics Gems, 1990.
    let matrix = world_from_local.matrix3;
    let (center, half) = (in_local.center(), in_local.size() * 0.5);
    let center_in_world = world_from_local.transform_point3(center);
    let half_in_world = matrix.abs() * half;
    // A transformed point is off by at most five roundings of the sum of absolute values, and the
    // box by the two of the halves, five for its centre and four for its half size, two for its
    // ends.
    let magnitude = matrix.abs() * (center.abs() + half) + world_from_local.translation.abs();
    let reach = half_in_world + magnitude * gamma(20);
    let cut = |p: DVec3, otherwise: f64| {
        DVec3::from_array(p.to_array().map(|x| {
            if x.is_nan() {
                otherwise
            } else {
                x.clamp(-LARGEST, LARGEST)
            }
        }))
    };
    Aabb {
        min: cut(center_in_world - reach, -LARGEST),
        max: cut(center_in_world + reach, LARGEST),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat3, DQuat};
    use iv_parser::SourcePos;
    use scenegraph::scene::{
        EnvironmentId, Instance, LightSetId, MaterialId, MeshId, Placement, Topology,
    };

    fn v(x: f64, y: f64, z: f64) -> DVec3 {
        DVec3::new(x, y, z)
    }

    fn mesh(origin: DVec3, positions: &[[f32; 3]], indices: &[u32]) -> Mesh {
        Mesh {
            topology: Topology::Points,
            origin,
            positions: positions.to_vec(),
            normals: Vec::new(),
            texcoords: Vec::new(),
            colors_srgb: Vec::new(),
            indices: indices.to_vec(),
            pos: SourcePos::default(),
        }
    }

    fn instance(mesh: u32, world_from_local: DAffine3) -> Instance {
        Instance {
            placement: Placement {
                node: None,
                parent_from_local: world_from_local,
                world_from_local,
                name: None,
                pos: SourcePos::default(),
            },
            mesh: MeshId(mesh),
            material: MaterialId(0),
            light_set: LightSetId(0),
            environment: EnvironmentId(0),
        }
    }

    #[test]
    fn boxes_of_a_scene() {
        let far = v(2_600_000.0, 1_200_000.0, 400.0);
        let scene = Scene {
            meshes: vec![
                mesh(
                    far,
                    &[[-1.0, 0.0, 0.5], [3.0, -2.0, 0.25], [9.0, 9.0, 9.0]],
                    &[0, 1],
                ),
                mesh(DVec3::ZERO, &[[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]], &[1, 0]),
            ],
            instances: vec![
                instance(0, DAffine3::from_translation(-far)),
                instance(1, DAffine3::from_scale(v(-2.0, 1.0, 1.0))),
                // Not in the scene; a checked scene has none such.
                instance(7, DAffine3::IDENTITY),
            ],
            ..Scene::default()
        };
        let bounds = SceneBounds::new(&scene);
        let expected = [
            (v(-1.0, -2.0, 0.25), v(3.0, 0.0, 0.5)),
            (v(-2.0, 0.0, 0.0), v(0.0, 2.0, 3.0)),
        ];
        assert_eq!(bounds.meshes[0].min, far + expected[0].0);
        assert_eq!(bounds.meshes[0].max, far + expected[0].1);
        for (b, (min, max)) in bounds.instances.iter().zip(expected) {
            // Holds the exact box, and is larger by roundings of the coordinates only.
            assert!(b.min.cmple(min).all() && b.max.cmpge(max).all(), "{b:?}");
            assert!((b.min - min).length() < 1e-7, "{b:?}");
            assert!((b.max - max).length() < 1e-7, "{b:?}");
        }
        assert!(bounds.instances[2].is_empty());
        assert_eq!(bounds.scene.min.x, bounds.instances[1].min.x);
        assert_eq!(bounds.scene.max.x, bounds.instances[0].max.x);
        assert!(SceneBounds::new(&Scene::default()).scene.is_empty());
    }

    #[test]
    fn world_boxes_hold_their_points_tightly() {
        let local = Aabb {
            min: v(-1.0, 2.0, 0.1),
            max: v(3.0, 2.0, 7.3),
        };
        let shear = DMat3::from_cols(v(1.0, 0.5, 0.0), v(0.3, -2.0, 0.0), v(0.0, 0.7, 1e-3));
        for (i, matrix) in [
            DMat3::IDENTITY,
            DMat3::from_quat(DQuat::from_rotation_z(0.7)),
            DMat3::from_quat(DQuat::from_euler(glam::EulerRot::XYZ, 1.0, 2.0, 3.0)),
            shear,
            DMat3::ZERO,
            DMat3::from_diagonal(DVec3::splat(1e12)),
        ]
        .into_iter()
        .enumerate()
        {
            for translation in [DVec3::ZERO, v(2.6e6, -1.2e6, 1e-3)] {
                let m = DAffine3::from_mat3_translation(matrix, translation);
                let world = world_box(&local, &m);
                let corners = local.corners().map(|p| m.transform_point3(p));
                for p in corners {
                    assert!(
                        p.cmpge(world.min).all() && p.cmple(world.max).all(),
                        "{i}: {p}"
                    );
                }
                let tight = corners
                    .into_iter()
                    .fold((corners[0], corners[0]), |(a, b), p| (a.min(p), b.max(p)));
                let slack = (tight.0 - world.min).max(world.max - tight.1).max_element();
                let scale = world.min.abs().max(world.max.abs()).max_element();
                assert!(slack <= 1e-13 * scale, "{i}: {slack}");
            }
        }
    }

    #[test]
    fn overflowing_boxes_stay_finite_and_are_not_lost() {
        let local = Aabb {
            min: v(-1.0, 0.0, 0.0),
            max: v(1.0, 0.0, 1.0),
        };
        for scale in [1e307, f64::MAX, f64::INFINITY, f64::NAN] {
            let m = DAffine3::from_scale(DVec3::splat(scale));
            let world = world_box(&local, &m);
            assert!(!world.is_empty(), "{scale}");
            assert!(world.size().is_finite() && world.center().is_finite());
        }
        assert!(world_box(&Aabb::EMPTY, &DAffine3::IDENTITY).is_empty());
    }
}
