//! When counting from the near plane is right, and from which value it must start. Not a
//! choice of method: that also depends on the device.
//!
//! Counting the sides in front of a visible point ("z-pass") gives the number of volumes
//! that hold the point less the number that hold the place where its ray begins. So it needs
//! that number, and no caster may be cut by the near plane.

use geometry::bounds::Aabb;
use glam::{DVec3, DVec4};

use crate::volume::exact::direction_sign;
use crate::volume::facing::plane_sign;
use crate::volume::light::Light;
use crate::volume::topology::CasterMesh;
use crate::volume::winding::ray_side;

/// What a device may be off by, relative to the distances from the eye: some four roundings
/// of `f32`, 2^-24 each, on the way from stored positions to pixels.
const DEVICE_ERROR: f64 = 1.0 / (1 << 20) as f64;

/// Whether z-pass with the start value 0 gives the same counts as z-fail for a caster in this
/// box, for a perspective camera: true only if the hull of the light, the eye and the corners
/// of the near rectangle is clear of the box by more than a device's rounding.
///
/// Everything is in one frame, usually the world. False for an empty or non-finite input.
#[must_use]
pub fn zpass_is_safe(bounds: &Aabb, eye: DVec3, near: [DVec3; 4], light: DVec4) -> bool {
    let Some(light) = Light::new(light) else {
        return false;
    };
    let corners = bounds.corners().map(|corner| corner - eye);
    let view = [
        near[0] - eye,
        near[1] - eye,
        near[2] - eye,
        near[3] - eye,
        DVec3::ZERO,
    ];
    let size = |points: &[DVec3]| points.iter().map(|p| p.length()).fold(0.0, f64::max);
    let reach = size(&corners).max(size(&view));
    let (ends, margin) = match light {
        Light::Point(point) => {
            let point = point - eye;
            let reach = reach.max(point.length());
            // The volume's rays start at the caster and are off by an angle; nearer to the
            // light than to the eye, that is more than `reach` alone says.
            let nearest = point.clamp(bounds.min - eye, bounds.max - eye);
            let leverage = 1.0 + reach / point.distance(nearest);
            ([point; 5], DEVICE_ERROR * reach * leverage)
        }
        // A ray from the view that meets the box has done so after twice the reach.
        Light::Towards(direction) => {
            let far = direction.normalize() * (2.0 * reach);
            (view.map(|p| p + far), DEVICE_ERROR * 3.0 * reach)
        }
    };
    // Differences to the eye are off by one rounding of numbers this large.
    let offset = eye.abs().max_element() * f64::EPSILON * 4.0;
    let hull: Vec<DVec3> = view.into_iter().chain(ends).collect();
    !bounds.is_empty() && is_separated(&hull, &edges(&view, &ends), &corners, margin + offset)
}

/// The directions of the edges of the hull of two rectangles with a tip each.
fn edges(view: &[DVec3; 5], ends: &[DVec3; 5]) -> Vec<DVec3> {
    let mut edges = Vec::with_capacity(13);
    for i in 0..4 {
        edges.push(view[(i + 1) % 4] - view[i]);
        edges.push(view[i] - view[4]);
        edges.push(ends[i] - view[i]);
    }
    edges.push(ends[4] - view[4]);
    edges
}

/// Whether a plane keeps the hull and the box apart by more than the margin. Any direction
/// that does is a proof; these are the ones of the separating axis theorem.
fn is_separated(hull: &[DVec3], edges: &[DVec3], corners: &[DVec3; 8], margin: f64) -> bool {
    let separates = |axis: DVec3| {
        let range = |points: &[DVec3]| {
            points
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
                    let x = p.dot(axis);
                    (low.min(x), high.max(x))
                })
        };
        let (hull, corners) = (range(hull), range(corners));
        (corners.0 - hull.1).max(hull.0 - corners.1) > margin * axis.length()
    };
    let axes = DVec3::AXES;
    axes.into_iter().any(separates)
        || edges.iter().enumerate().any(|(i, &edge)| {
            let others = edges[i + 1..].iter().copied();
            axes.into_iter()
                .chain(others)
                .any(|other| separates(edge.cross(other)))
        })
}

/// Directions closer than this to parallel are taken as parallel: their difference may vanish
/// on a device.
const PARALLEL: f64 = DEVICE_ERROR;

/// The number of volumes of casting triangles that hold the point at infinity in the
/// direction to the viewer: the start value of z-pass for an orthographic camera, whose rays
/// come from there when depth is not clipped. Volumes of several casters add up.
///
/// `signs` are those of [`crate::volume::facing()`]. For a light at infinity the answer is 0,
/// but if the viewer looks straight towards the light, it is 1 for a caster that casts at
/// all: sides are then seen edge-on and count nothing, and every visible point is shadowed by
/// its own triangle, which has the light on its far side.
///
/// A ray that meets an edge is decided by an infinitely small shift, the same for all
/// triangles. 0 for inputs that are not finite.
#[must_use]
pub fn count_at_infinity(
    mesh: &CasterMesh,
    signs: &[i8],
    direction_to_viewer: DVec3,
    light: DVec4,
) -> u32 {
    // Read as a light at infinity: the same rules make it finite and of a usable length.
    let Some(Light::Towards(viewer)) = Light::new(direction_to_viewer.extend(0.0)) else {
        return 0;
    };
    match Light::new(light) {
        None => 0,
        Some(Light::Towards(direction)) => {
            let (viewer, direction) = (viewer.normalize(), direction.normalize());
            let parallel = viewer.cross(direction).length() < PARALLEL;
            let casts = signs.iter().any(|&s| s != 0);
            u32::from(parallel && viewer.dot(direction) < 0.0 && casts)
        }
        Some(light @ Light::Point(point)) => {
            let hits = mesh.triangles.iter().zip(signs).filter(|&(triangle, &s)| {
                s != 0 && is_hit(mesh.corners(triangle), light, point, viewer)
            });
            hits.count() as u32
        }
    }
}

/// Whether the ray from the light in a direction meets the triangle.
fn is_hit(corners: [DVec3; 3], light: Light, point: DVec3, direction: DVec3) -> bool {
    let side = |from: DVec3, to: DVec3| match direction_sign(direction, point, from, to) {
        0 => ray_side(point, from, to),
        side => side,
    };
    let [a, b, c] = corners;
    let first = side(a, b);
    first != 0 && side(b, c) == first && side(c, a) == first && plane_sign(corners, light) == -first
}
