//! Where shadow volumes may end: behind a plane that has the eye and all of the scene on one side,
//! nothing is seen, so a volume that is counted before the scene (z-pass) needs no sides there.
//! It saves the area of the sides below a floor, which is most of it.

use geometry::bounds::Aabb;
use glam::{DVec3, DVec4};

use crate::content::LightShape;
use crate::view::{Lens, View};

/// Room between the scene's box and the plane, as a share of the box's diagonal: far more than
/// what f32 places are off by, and far less than what it costs to fill.
const ROOM: f64 = 1.0 / 64.0;

/// The plane `(n, d)` beside a face of the scene's box, `n . p + d = 0` with n outwards, that most
/// of the casters' boxes lie before as the light sees them; of several the one nearest to the
/// light. `None` if there is none for any caster.
pub fn far_plane(scene: &Aabb, light: &LightShape, casters: &[Aabb]) -> Option<DVec4> {
    if scene.is_empty() {
        return None;
    }
    let room = scene.size().length() * ROOM;
    let planes = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| {
        let (low, high) = (axis.dot(scene.min), axis.dot(scene.max));
        [axis.extend(-high - room), (-axis).extend(low - room)]
    });
    planes
        .filter_map(|plane| {
            let count = casters.iter().filter(|b| is_cut(plane, light, b)).count();
            (count > 0).then_some((plane, count, distance(plane, light)))
        })
        .max_by(|a, b| a.1.cmp(&b.1).then(b.2.total_cmp(&a.2)))
        .map(|(plane, ..)| plane)
}

/// Whether all of a caster throws its shadow towards the plane: away from the light, every point of
/// its box comes nearer to it, and not too slowly.
pub fn is_cut(plane: DVec4, light: &LightShape, caster: &Aabb) -> bool {
    let n = plane.truncate();
    match *light {
        LightShape::Directional { towards } => -n.dot(towards) > LEAST_SLOPE,
        LightShape::Point { p_in_world } | LightShape::Spot { p_in_world, .. } => {
            !caster.is_empty()
                && caster.corners().iter().all(|&corner| {
                    let way = corner - p_in_world;
                    n.dot(way) > LEAST_SLOPE * way.length()
                })
        }
    }
}

/// Sine of the least angle between a shadow's way and the plane: flatter ones end so far away that
/// the plane saves nothing.
const LEAST_SLOPE: f64 = 1.0 / 16.0;

fn distance(plane: DVec4, light: &LightShape) -> f64 {
    let n = plane.truncate();
    match *light {
        LightShape::Directional { towards } => 1.0 + n.dot(towards),
        LightShape::Point { p_in_world } | LightShape::Spot { p_in_world, .. } => {
            -(n.dot(p_in_world) + plane.w)
        }
    }
}

/// The plane relative to the eye, if the view looks from before it; zero, which cuts nothing, if
/// not. A parallel view looks from infinity.
pub fn rel_plane(plane: DVec4, view: &View) -> DVec4 {
    let n = plane.truncate();
    let at_eye = n.dot(view.eye) + plane.w;
    let is_before = match view.lens {
        Lens::Perspective { .. } => at_eye < 0.0,
        Lens::Orthographic { .. } => n.dot(view.forward()) > LEAST_SLOPE,
    };
    if is_before {
        n.extend(at_eye)
    } else {
        DVec4::ZERO
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn aabb(min: [f64; 3], max: [f64; 3]) -> Aabb {
        Aabb {
            min: min.into(),
            max: max.into(),
        }
    }

    #[test]
    fn planes_below_what_throws_shadows() {
        let scene = aabb([-10.0, -10.0, 0.0], [10.0, 10.0, 8.0]);
        let table = aabb([1.0, 1.0, 1.0], [2.0, 2.0, 2.0]);
        let shade = aabb([-1.0, -1.0, 7.0], [1.0, 1.0, 8.0]);
        let lamp = LightShape::Point {
            p_in_world: DVec3::new(0.0, 0.0, 5.0),
        };
        let sun = LightShape::Directional {
            towards: DVec3::new(0.6, 0.0, 0.8),
        };
        let down = Some(DVec3::NEG_Z);
        let rows = [
            ("table", lamp, vec![table], down),
            ("table and shade", lamp, vec![table, table, shade], down),
            ("shade", lamp, vec![shade], Some(DVec3::Z)),
            ("around the lamp", lamp, vec![scene], None),
            ("sun", sun, vec![table, shade], down),
            ("nothing", sun, vec![], None),
        ];
        for (name, light, casters, expected) in rows {
            let plane = far_plane(&scene, &light, &casters);
            assert_eq!(plane.map(DVec4::truncate), expected, "{name}");
            // The whole scene is before it.
            for (plane, corner) in plane
                .into_iter()
                .flat_map(|p| scene.corners().map(|c| (p, c)))
            {
                assert!(plane.truncate().dot(corner) + plane.w < 0.0, "{name}");
            }
        }
    }
}
