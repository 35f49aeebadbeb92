//! The sign of each triangle as seen from a light, and which signs need to cast. The only
//! place where the silhouette method looks at coordinates: all that follows counts integers.
//!
//! Why one sign can be enough: along the way from the light to a point, a triangle with
//! `s = +1` (unmirrored) raises the winding number of its closed component by one, one with
//! `s = -1` lowers it. If the light has the lowest winding number that occurs, the first
//! triangle met must raise it; so a point is behind some triangle if and only if it is behind
//! one with `s = +1`. If the light has the highest one, the same is true of `s = -1`.

use glam::{DVec3, DVec4};

use crate::volume::exact::{direction_sign, volume_sign};
use crate::volume::light::Light;
use crate::volume::topology::CasterMesh;
use crate::volume::winding::windings;

/// Which of the triangles cast.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CastRule {
    /// All, seen from either side.
    BothSigns,
    /// In a closed component with a known range of winding numbers, only those of one sign,
    /// where that gives the same shadows; elsewhere all. It halves the sides.
    #[default]
    OneSignWhereClosed,
}

/// The set bit of [`component_signs`] that says that triangles with `s = +1` cast.
pub const POSITIVE_CASTS: u8 = 1;
/// The set bit of [`component_signs`] that says that triangles with `s = -1` cast.
pub const NEGATIVE_CASTS: u8 = 2;

/// Replaces the contents of `signs` by the sign of each triangle of the mesh.
///
/// The sign is exact for the light as given and the positions as stored. It is 0 for
/// triangles that do not cast, and everywhere when the light is not finite or
/// `(0, 0, 0, 0)`.
pub fn facing(
    mesh: &CasterMesh,
    light: DVec4,
    mirrored: bool,
    rule: CastRule,
    signs: &mut Vec<i8>,
) {
    signs.clear();
    let Some(parsed) = Light::new(light) else {
        signs.resize(mesh.triangles.len(), 0);
        return;
    };
    let casting = component_signs(mesh, light, mirrored, rule);
    let orientation = if mirrored { -1 } else { 1 };
    signs.extend(mesh.triangles.iter().map(|triangle| {
        let s = orientation * plane_sign(mesh.corners(triangle), parsed);
        if casting[triangle[3] as usize] & bit(s) == 0 {
            0
        } else {
            s
        }
    }));
}

/// For each component of the mesh, which signs cast: [`POSITIVE_CASTS`], [`NEGATIVE_CASTS`] or
/// both, the mirroring being applied.
#[must_use]
pub fn component_signs(mesh: &CasterMesh, light: DVec4, mirrored: bool, rule: CastRule) -> Vec<u8> {
    let both = POSITIVE_CASTS | NEGATIVE_CASTS;
    let parsed = Light::new(light);
    let (CastRule::OneSignWhereClosed, Some(light)) = (rule, parsed) else {
        return vec![both; mesh.components.len()];
    };
    let (raising, lowering) = match mirrored {
        false => (POSITIVE_CASTS, NEGATIVE_CASTS),
        true => (NEGATIVE_CASTS, POSITIVE_CASTS),
    };
    light_windings(mesh, light)
        .into_iter()
        .zip(&mesh.components)
        .map(
            |(winding, component)| match (winding, component.winding_range) {
                (Some(winding), Some([low, _])) if winding == low => raising,
                (Some(winding), Some([_, high])) if winding == high => lowering,
                _ => both,
            },
        )
        .collect()
}

/// The winding number of each component that has a known range, at the light; `None` for the
/// others, and where the light touches the component.
fn light_windings(mesh: &CasterMesh, light: Light) -> Vec<Option<i32>> {
    let ranges = mesh.components.iter().map(|c| c.winding_range);
    let Light::Point(point) = light else {
        return ranges.map(|range| range.map(|_| 0)).collect();
    };
    let inside = |min: DVec3, max: DVec3| min.cmple(point).all() && point.cmple(max).all();
    let points: Vec<Option<DVec3>> = mesh
        .components
        .iter()
        .map(|c| {
            let near = c.winding_range.is_some() && inside(c.bounds.min, c.bounds.max);
            near.then_some(point)
        })
        .collect();
    if points.iter().all(Option::is_none) {
        return ranges.map(|range| range.map(|_| 0)).collect();
    }
    ranges
        .zip(&points)
        .zip(windings(mesh, &points))
        .map(|((range, near), winding)| match near {
            Some(_) => winding,
            None => range.map(|_| 0),
        })
        .collect()
}

/// The exact sign of a triangle as seen from the light: +1 counter-clockwise.
#[inline]
pub(crate) fn plane_sign([a, b, c]: [DVec3; 3], light: Light) -> i8 {
    match light {
        Light::Point(point) => -volume_sign(a, b, c, point),
        Light::Towards(direction) => direction_sign(direction, a, b, c),
    }
}

fn bit(s: i8) -> u8 {
    match s {
        1 => POSITIVE_CASTS,
        -1 => NEGATIVE_CASTS,
        _ => 0,
    }
}
