//! Platform, tiled floor, stairs, and the named rooms with what stands in them.

use super::walls::{EAST_NORTH, THICK, WEST_SOUTH};
use crate::iv_writer::{IvWriter, num};
use crate::solid::{Outline, prism};

/// The platform's corners on plan, its underside and the thickness of the floor finish.
pub(super) const PLATFORM: [[f64; 2]; 2] = [[-0.6, -0.6], [14.1, 8.7]];
pub(super) const GROUND: f64 = -0.6;
const FINISH: f64 = 0.02;
/// Side of the square that the floor texture covers: two tiles of 45 cm.
const TILE_PAIR: f64 = 0.9;
/// The flight in front of the middle bay.
const STAIR_X: [f64; 2] = [5.25, 8.25];
const RISERS: usize = 4;
const TREAD: f64 = 0.32;

/// The slab, its tiles and the stairs.
pub(super) fn floors_and_stairs(w: &mut IvWriter) {
    let [[west, south], [east, north]] = PLATFORM;
    w.node("DEF FloorSlab Separator", |w| {
        w.line("USE Concrete");
        w.cuboid(
            [west + 0.03, south + 0.03, GROUND - 0.2],
            [east - 0.03, north - 0.03, -FINISH],
        );
    });
    w.node("DEF FloorTiles Separator", |w| {
        let plan = vec![[west, south], [east, south], [east, north], [west, north]];
        let slab = prism(&Outline::polygon(plan), FINISH).mapped(|[x, y, z]| [x, y, z - FINISH]);
        let uv: Vec<String> = slab
            .points
            .iter()
            .map(|p| format!("{} {}", num(p[0] / TILE_PAIR), num(p[1] / TILE_PAIR)))
            .collect();
        w.line("USE Textured");
        w.line("Texture2 { filename \"textures/floor_tiles.png\"  wrapS REPEAT  wrapT REPEAT }");
        w.node("TextureCoordinate2", |w| w.list("point", &uv, 4));
        w.solid(&slab);
    });
    w.node("DEF Stairs Separator", |w| {
        w.line("USE Limestone");
        stairs(w, south);
    });
}

/// One concave solid: the stepped section, extruded along x. The platform's edge is the last riser.
fn stairs(w: &mut IvWriter, south: f64) {
    let steps = RISERS - 1;
    let riser = -GROUND / RISERS as f64;
    let mut section = vec![[0.0, GROUND - 0.2], [0.0, -riser]];
    for step in 1..=steps {
        let y = -(step as f64) * TREAD;
        section.push([y, -riser * step as f64]);
        if step < steps {
            section.push([y, -riser * (step + 1) as f64]);
        }
    }
    section.push([-(steps as f64) * TREAD, GROUND - 0.2]);
    let width = STAIR_X[1] - STAIR_X[0];
    let flight = prism(&Outline::polygon(section), width);
    w.solid(&flight.mapped(|[u, v, w]| [STAIR_X[0] + w, south + 0.03 + u, v]));
}

/// Every room is a named group of its own.
pub(super) fn rooms(w: &mut IvWriter) {
    let [west, south] = WEST_SOUTH.map(|at| at + THICK);
    let [_, north] = EAST_NORTH.map(|at| at - THICK);
    w.node("DEF Room_Salon Separator", |w| {
        w.line("# A larch floor on the tiles, a bench along the north wall.");
        w.node("Separator", |w| {
            w.line("USE Larch");
            w.cuboid([west, south, 0.0], [5.2, north, 0.012]);
        });
        w.placed([2.3, 4.3, 0.012], 0.0, |w| w.line("USE RoundTable"));
        for (x, y, angle_rad) in [(1.5, 4.3, 1.5), (3.1, 4.4, -1.4)] {
            w.placed([x, y, 0.012], angle_rad, |w| w.line("USE Chair"));
        }
        w.placed([1.6, north - 0.42, 0.012], 0.0, |w| w.line("USE Bench"));
    });
    w.node("DEF Room_Kitchen Separator", |w| {
        w.placed([5.32, north - 0.62, 0.0], 0.0, |w| w.line("USE Counter"));
    });
    w.node("DEF Room_Loggia Separator", |w| {
        w.line("# Open to three sides: the long table under the rafters.");
        w.placed([10.8, 4.05, 0.0], 0.0, |w| w.line("USE LongTable"));
        let (front, back) = (3.15, 4.95);
        for x in [10.1, 10.8, 11.5] {
            w.placed([x, front, 0.0], std::f64::consts::PI, |w| {
                w.line("USE Chair")
            });
            w.placed([x, back, 0.0], 0.0, |w| w.line("USE Chair"));
        }
        // One guest has left.
        w.placed([12.5, 3.6, 0.0], -2.1, |w| w.line("USE Chair"));
        w.placed([10.55, 4.0, 0.76], 0.0, |w| w.line("USE FruitBowl"));
    });
    w.node("DEF Room_Veranda Separator", |w| {
        for x in [4.95, 8.55] {
            w.placed([x, -0.25, 0.0], 0.0, |w| w.line("USE Planter"));
        }
        w.placed([1.0, 1.45, 0.0], 0.0, |w| w.line("USE Bench"));
    });
}
