//! When two objects of glTF files are the same, but for what other tools make of their numbers.

use glam::{DAffine3, DVec3};
use scenegraph::scene::{Camera, Light, LightKind, Material, Mesh, Projection, Topology};

use crate::alike::{alike, alike_in_size, all_alike};
use crate::read::PrimitiveObject;

/// Rotations and scales, relative: quaternions that tools hold in f32 and make unit again.
const LINEAR_TOLERANCE: f64 = 1e-6;
/// f64 transforms that went through another text or another order of products.
const EXACT_TOLERANCE: f64 = 1e-12;
/// Positions relative to the extent of their mesh, and normals: a few roundings of f32.
const VERTEX_TOLERANCE: f32 = 1e-6;
const NORMAL_TOLERANCE: f32 = 2e-3;
/// Vertex colours: half a step of 8-bit ones.
const COLOR_TOLERANCE: f32 = 2.5e-3;

/// Equal, or what is left of the one in f32.
fn same_place(a: DVec3, b: DVec3) -> bool {
    let scale = a.abs().max_element();
    let same =
        |a: f64, b: f64| (a - b).abs() <= EXACT_TOLERANCE * scale || b == f64::from(a as f32);
    same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z)
}

pub(crate) fn same_frame(a: &DAffine3, b: &DAffine3) -> bool {
    let axes = |frame: &DAffine3| {
        let m = frame.matrix3;
        [m.x_axis, m.y_axis, m.z_axis]
    };
    // Each axis by its own length: parts may be scaled flat.
    let same = |(a, b): (DVec3, DVec3)| a.distance(b) <= LINEAR_TOLERANCE * a.length();
    axes(a).into_iter().zip(axes(b)).all(same) && same_place(a.translation, b.translation)
}

pub(crate) fn same_material(a: &Material, b: &Material) -> bool {
    let numbers = |m: &Material| {
        let colors = [m.diffuse_srgb, m.specular_srgb, m.emissive_srgb].concat();
        [colors, vec![m.shininess, m.transparency]].concat()
    };
    a.name == b.name
        && all_alike(&numbers(a), &numbers(b))
        && (a.light_model, a.faces) == (b.light_model, b.faces)
}

pub(crate) fn same_light(
    (a, fall): &(Light, [f64; 3]),
    (b, fall_back): &(Light, [f64; 3]),
    other_size: bool,
) -> bool {
    let cone = |light: &Light| match light.kind {
        LightKind::Directional { .. } => (0, 0.0, 0.0),
        LightKind::Point { .. } => (1, 0.0, 0.0),
        LightKind::Spot {
            drop_off_rate,
            cut_off_angle_rad,
            ..
        } => (2, drop_off_rate, cut_off_angle_rad),
    };
    let ((kind, rate, angle_rad), (kind_back, rate_back, angle_back_rad)) = (cone(a), cone(b));
    kind == kind_back
        && alike(rate, rate_back)
        && alike_in_size(angle_rad, angle_back_rad)
        && all_alike(&a.color_srgb, &b.color_srgb)
        && (other_size && kind > 0 || alike_in_size(a.intensity, b.intensity))
        && fall == fall_back
}

pub(crate) fn same_camera(a: &Camera, b: &Camera, other_size: bool) -> bool {
    let same_view = match (a.projection, b.projection) {
        (
            Projection::Perspective { height_angle_rad },
            Projection::Perspective {
                height_angle_rad: back_rad,
            },
        ) => alike_in_size(height_angle_rad, back_rad),
        (Projection::Orthographic { height }, Projection::Orthographic { height: back }) => {
            alike_in_size(height, back)
        }
        _ => false,
    };
    same_view
        && alike_in_size(a.aspect_ratio, b.aspect_ratio)
        && (other_size
            || alike_in_size(a.near_distance, b.near_distance)
                && alike_in_size(a.far_distance, b.far_distance))
}

pub(crate) fn same_geometry(a: &PrimitiveObject, b: &PrimitiveObject) -> bool {
    match (&a.mesh, &b.mesh) {
        (Some(a), Some(b)) => same_mesh(a, b),
        (None, None) => true,
        _ => false,
    }
}

/// Corner by corner, so that other vertices in the same places are no edit.
fn same_mesh(a: &Mesh, b: &Mesh) -> bool {
    if a == b {
        return true;
    }
    let step = match a.topology {
        Topology::Triangles => 3,
        Topology::Lines => 2,
        Topology::Points => 1,
    };
    let has = |m: &Mesh| {
        [
            m.normals.is_empty(),
            m.texcoords.is_empty(),
            m.colors_srgb.is_empty(),
        ]
    };
    if a.topology != b.topology || a.indices.len() != b.indices.len() || has(a) != has(b) {
        return false;
    }
    let extent = a
        .positions
        .as_flattened()
        .iter()
        .fold(0.0, |most: f32, v| v.abs().max(most));
    let close = |a: &[f32], b: &[f32], tolerance: f32| {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance)
    };
    let corners = a.indices.chunks(step).zip(b.indices.chunks(step));
    corners.flat_map(|(a, b)| a.iter().zip(b)).all(|(&i, &k)| {
        let (i, k) = (i as usize, k as usize);
        let attribute = |empty: bool, of: &dyn Fn() -> bool| empty || of();
        close(&a.positions[i], &b.positions[k], VERTEX_TOLERANCE * extent)
            && attribute(a.normals.is_empty(), &|| {
                close(&a.normals[i], &b.normals[k], NORMAL_TOLERANCE)
            })
            && attribute(a.texcoords.is_empty(), &|| {
                let size = a.texcoords[i]
                    .iter()
                    .fold(1.0, |most: f32, v| v.abs().max(most));
                close(
                    &a.texcoords[i],
                    &b.texcoords[k],
                    2.0 * VERTEX_TOLERANCE * size,
                )
            })
            && attribute(a.colors_srgb.is_empty(), &|| {
                close(&a.colors_srgb[i], &b.colors_srgb[k], COLOR_TOLERANCE)
            })
    })
}

#[cfg(test)]
mod tests {
    use glam::{DMat3, DQuat};
    use scenegraph::scene::{Placement, ViewportMapping};

    use super::*;

    fn camera(projection: Projection, near_distance: f64, far_distance: f64) -> Camera {
        Camera {
            placement: Placement {
                node: None,
                parent_from_local: DAffine3::IDENTITY,
                world_from_local: DAffine3::IDENTITY,
                name: None,
                pos: iv_parser::SourcePos::default(),
            },
            position: DVec3::ZERO,
            orientation: DQuat::IDENTITY,
            aspect_ratio: 1.0,
            near_distance,
            far_distance,
            focal_distance: 1.0,
            projection,
            viewport_mapping: ViewportMapping::AdjustCamera,
        }
    }

    /// A percent is an edit and a rounding to f32 is none, whatever the unit of the model.
    #[test]
    fn sizes_are_compared_in_their_own_unit() {
        let view = |height: f64, near: f64, far: f64| {
            camera(Projection::Orthographic { height }, near, far)
        };
        let frame = |scale: f64, place: f64| DAffine3 {
            matrix3: DMat3::from_diagonal(DVec3::new(1.0, 1.0, scale)),
            translation: DVec3::splat(place),
        };
        for unit in [1e-9, 1e-4, 1.0, 1e7] {
            let narrow = f64::from(unit as f32) / unit;
            for (by, same) in [(1.01, false), (0.0, false), (narrow, true)] {
                let to = unit * by;
                let was = view(unit, unit, unit);
                for is in [
                    view(to, unit, unit),
                    view(unit, to, unit),
                    view(unit, unit, to),
                ] {
                    assert_eq!(same_camera(&was, &is, false), same, "{unit} {by} {is:?}");
                }
                for is in [frame(to, unit), frame(unit, to)] {
                    let found = same_frame(&frame(unit, unit), &is);
                    assert_eq!(found, same, "{unit} {by} {is:?}");
                }
            }
        }
    }
}
