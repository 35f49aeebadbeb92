//! What a model has besides what it shows, in glTF: hidden nodes (`KHR_node_visibility`), levels of
//! detail (`MSFT_lod`), and other materials (`KHR_materials_variants`).
//!
//! Inventor changes levels at a distance or at an area in pixels, `MSFT_screencoverage` at a share
//! of the picture. The share is computed for one view: the height angle of the first perspective
//! camera, else 45 degrees, square and [`VIEW_PX`] pixels high. A part whose box has the half
//! diagonal r covers a disc of π r² at the distance d, of the (2 d tan(angle / 2))² that are seen.
//! So levels change where they do in Inventor as far as that disc is the part's outline, the middle
//! of its box is the centre that Inventor measures from, and the view is that one. The limits as
//! Inventor has them are in the node's `extras.iv`.

use scenegraph::scene::{Coarser, Projection, Scene};

use crate::json::Json;

/// Height and width of the view that shares of the picture are meant for.
const VIEW_PX: f64 = 600.0;
/// Inventor's default height angle: 45 degrees.
const HEIGHT_ANGLE_RAD: f64 = std::f64::consts::FRAC_PI_4;

pub(crate) const VISIBILITY: &str = "KHR_node_visibility";
pub(crate) const LEVELS: &str = "MSFT_lod";
pub(crate) const VARIANTS: &str = "KHR_materials_variants";
const COVERAGE: &str = "MSFT_screencoverage";

/// The limits of a part's levels.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Limits {
    /// Where each level takes the place of the one before it.
    pub(crate) coarser: Vec<Coarser>,
    /// The share of the picture down to which each level but the last is shown. Empty if it is not
    /// known.
    coverage: Vec<f64>,
}

impl Limits {
    /// `radius` is half the diagonal of the finest level's box in the world.
    pub(crate) fn new(coarser: Vec<Coarser>, radius: f64, view: &View) -> Self {
        let mut least = 1.0_f64;
        let share = |limit: &Coarser| {
            let share = match *limit {
                Coarser::Beyond(distance) => view.share(radius, distance),
                Coarser::Below(area) => area / (VIEW_PX * VIEW_PX),
                Coarser::Never => 0.0,
            };
            // A level cannot begin at a larger share than a finer one.
            least = share.clamp(0.0, least);
            least
        };
        let known = coarser.iter().any(|limit| *limit != Coarser::Never);
        let by_size = coarser.iter().any(|c| matches!(c, Coarser::Below(_)));
        let coverage = match known && (by_size || radius > 0.0) {
            true => coarser.iter().map(share).collect(),
            false => Vec::new(),
        };
        Self { coarser, coverage }
    }

    /// The members of a node's extras that stand beside `iv`.
    pub(crate) fn write_coverage(&self, json: &mut Json) {
        // The last level is shown however small it is.
        let last = (!self.coverage.is_empty()).then_some(0.0);
        let shares = self.coverage.iter().copied().chain(last);
        json.array_unless_empty(COVERAGE, shares, Json::f64);
    }

    /// Inventor's own limits, under the names of its fields.
    pub(crate) fn write_fields(&self, json: &mut Json) {
        let ranges = self.coarser.iter().map_while(|limit| match limit {
            Coarser::Beyond(distance) => Some(*distance),
            Coarser::Below(_) | Coarser::Never => None,
        });
        json.array_unless_empty("range", ranges, Json::field);
        let areas = self.coarser.iter().map_while(|limit| match limit {
            Coarser::Below(area) => Some(*area),
            Coarser::Beyond(_) | Coarser::Never => None,
        });
        json.array_unless_empty("screenArea", areas, Json::field);
    }
}

/// The view that shares of the picture are meant for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    half_height_at_one: f64,
}

impl View {
    pub(crate) fn of(scene: &Scene) -> Self {
        let angle = scene.cameras.first().and_then(|c| match c.projection {
            Projection::Perspective { height_angle_rad } => Some(height_angle_rad),
            Projection::Orthographic { .. } => None,
        });
        let usable = |angle: &f64| *angle > 1e-3 && *angle < 3.0;
        let angle = angle.filter(usable).unwrap_or(HEIGHT_ANGLE_RAD);
        Self {
            half_height_at_one: (angle / 2.0).tan(),
        }
    }

    fn share(&self, radius: f64, distance: f64) -> f64 {
        let height = 2.0 * distance * self.half_height_at_one;
        let share = std::f64::consts::PI * (radius / height).powi(2);
        // At no distance all of the picture is covered.
        if share.is_nan() { 1.0 } else { share.min(1.0) }
    }
}

/// The extension of a node that is not shown.
pub(crate) fn write_hidden(json: &mut Json) {
    json.key(VISIBILITY)
        .object(|json| json.key("visible").bool(false));
}

/// The extension of a node that has coarser levels, by their numbers.
pub(crate) fn write_levels(json: &mut Json, levels: std::ops::Range<usize>) {
    json.key(LEVELS)
        .object(|json| json.array_unless_empty("ids", levels, Json::usize));
}

/// The names of the variants, among the extensions of the file.
pub(crate) fn write_variants(json: &mut Json, scene: &Scene) {
    json.key(VARIANTS).object(|json| {
        json.array_unless_empty("variants", &scene.variants, |json, variant| {
            json.object(|json| json.key("name").str(&variant.name));
        });
    });
}

/// The materials of a primitive by variant; readers need not fall back on its own then.
pub(crate) fn write_mappings(json: &mut Json, materials: &[u32]) {
    let mut distinct = materials.to_vec();
    distinct.sort_unstable();
    distinct.dedup();
    json.key("extensions").object(|json| {
        json.key(VARIANTS).object(|json| {
            json.array_unless_empty("mappings", distinct, |json, material| {
                json.object(|json| {
                    json.key("material").u64(material.into());
                    let variants = (materials.iter().enumerate()).filter(|(_, m)| **m == material);
                    let variants = variants.map(|(variant, _)| variant);
                    json.array_unless_empty("variants", variants, Json::usize);
                });
            });
        });
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_become_shares_of_the_picture() {
        let view = View {
            half_height_at_one: 1.0,
        };
        let pi = std::f64::consts::PI;
        let rows: [(&str, Vec<Coarser>, f64, Vec<f64>); 6] = [
            (
                "a disc of radius 1 at 5 and 10 of pictures 10 and 20 wide",
                vec![Coarser::Beyond(5.0), Coarser::Beyond(10.0)],
                1.0,
                vec![pi / 100.0, pi / 400.0],
            ),
            (
                "all of the picture at no distance",
                vec![Coarser::Beyond(0.0)],
                1.0,
                vec![1.0],
            ),
            (
                "half of 600 by 600 pixels",
                vec![Coarser::Below(180_000.0)],
                0.0,
                vec![0.5],
            ),
            (
                "limits that do not fall",
                vec![Coarser::Beyond(10.0), Coarser::Beyond(5.0)],
                1.0,
                vec![pi / 400.0, pi / 400.0],
            ),
            ("no limits", vec![Coarser::Never], 1.0, vec![]),
            (
                "nothing to measure",
                vec![Coarser::Beyond(5.0)],
                0.0,
                vec![],
            ),
        ];
        for (what, coarser, radius, want) in rows {
            let got = Limits::new(coarser, radius, &view).coverage;
            assert_eq!(got.len(), want.len(), "{what}");
            let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-15;
            assert!(got.iter().zip(&want).all(near), "{what}: {got:?}");
        }
    }
}
