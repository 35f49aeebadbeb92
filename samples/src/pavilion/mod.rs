//! The garden pavilion: one building of the kind a CAD program exports, as Inventor text.
//!
//! Metres, +Z up, building coordinates: x along the long side (east), y north, z = 0 on the floor.
//! One `Transform` at the root puts the building at its place in the Swiss grid LV95, millions of
//! metres from the origin; the site boundary is given in full LV95 coordinates beside it.

mod columns;
mod furniture;
mod lights;
mod palette;
mod roof;
mod rooms;
mod site;
mod walls;

use crate::iv_writer::{IvWriter, vec3};

/// Where the building's origin lies: easting, northing (LV95) and height above sea level (LN02).
const ORIGIN_LV95: [f64; 3] = [2_600_072.35, 1_200_058.125, 555.4];

/// The whole model file. Every call gives the same text.
#[must_use]
pub fn document() -> String {
    let mut w = IvWriter::new(&[
        "A garden pavilion on its site: 16 columns, four rooms, a timber roof, lamps and a low sun.",
        "Metres, +Z up. The root Transform carries the building to its place in the Swiss grid LV95;",
        "the site boundary is given in full LV95 coordinates.",
        "Written by `cargo run -p samples --bin gen-pavilion`.",
    ]);
    w.node("DEF GardenPavilion Separator", |w| {
        w.line(
            "Info { string \"Garden pavilion, units metre, grid CH1903+ / LV95, heights LN02\" }",
        );
        w.blank();
        lights::cameras(w);
        w.blank();
        site::boundary(w);
        w.blank();
        w.node("DEF Building Separator", building);
    });
    w.finish()
}

fn building(w: &mut IvWriter) {
    origin_transform(w);
    w.line("ShapeHints {");
    w.line("    vertexOrdering COUNTERCLOCKWISE");
    w.line("    shapeType SOLID");
    w.line("    faceType UNKNOWN_FACE_TYPE");
    w.line("    creaseAngle 0.5");
    w.line("}");
    w.blank();
    palette::materials(w);
    w.blank();
    w.line("# Parts drawn only where they are used.");
    w.node("DEF Parts Switch", |w| {
        w.line("whichChild -1");
        columns::part(w);
        roof::parts(w);
        walls::parts(w);
        furniture::parts(w);
        lights::parts(w);
        site::parts(w);
    });
    w.blank();
    lights::lights(w);
    w.blank();
    site::garden(w);
    w.blank();
    rooms::floors_and_stairs(w);
    w.blank();
    columns::colonnade(w);
    w.blank();
    walls::walls(w);
    w.blank();
    rooms::rooms(w);
    w.blank();
    roof::roof(w);
    w.blank();
    lights::fixtures(w);
}

fn origin_transform(w: &mut IvWriter) {
    w.line(&format!(
        "Transform {{ translation {} }}",
        vec3(ORIGIN_LV95)
    ));
}

/// A point in building coordinates as full LV95 coordinates.
fn in_lv95(p: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| p[i] + ORIGIN_LV95[i])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::manifest::data_dir;

    #[test]
    fn committed_model_is_current() {
        let committed = std::fs::read_to_string(data_dir().join("pavilion.iv")).unwrap();
        assert!(
            committed == document(),
            "pavilion.iv is old: run gen-pavilion"
        );
    }

    #[test]
    fn every_use_names_an_earlier_def() {
        let text = document();
        let words: Vec<&str> = text.split_whitespace().collect();
        let mut defined = std::collections::BTreeSet::new();
        for pair in words.windows(2) {
            match pair[0] {
                "DEF" => assert!(defined.insert(pair[1]), "{} twice", pair[1]),
                "USE" => assert!(defined.contains(pair[1]), "{} not defined", pair[1]),
                _ => {}
            }
        }
        assert!(defined.len() > 40, "only {} names", defined.len());
    }

    #[test]
    fn model_stays_small() {
        assert!(document().len() < 400_000);
    }
}
