//! The gable roof: beams on the columns, rafter pairs, ridge, boarding and a stepped tile covering.

use super::columns::{BAY, COLUMN_HEIGHT, COUNT};
use crate::iv_writer::{IvWriter, num, vec3};
use crate::solid::{Outline, Solid, prism};

/// Rise per metre.
const PITCH: f64 = 0.42;
/// Underside of the rafters at the wall plate, and the y of the ridge.
const EAVE_Z: f64 = 3.0;
const RIDGE_Y: f64 = 4.05;
/// Horizontal reach of a rafter from the ridge.
const REACH: f64 = RIDGE_Y + 0.75;
const RAFTER_PAIRS: usize = 17;
const RAFTER_SPACING: f64 = 0.9;
/// Depth of a rafter, thickness of the boarding, both measured vertically.
const RAFTER_DEPTH: f64 = 0.18;
const BOARDING: f64 = 0.025;
/// The covering runs from here to here along x.
const VERGE: [f64; 2] = [-0.7, 14.2];
/// Tile courses on one side, and how far each overlaps the next below.
const COURSES: usize = 16;
const LAP: f64 = 0.035;

/// Rafter, covering of one side and tie beam: in ridge coordinates, the side that falls to -y.
pub(super) fn parts(w: &mut IvWriter) {
    w.node("DEF Rafter Separator", |w| {
        w.line("USE Spruce");
        w.solid(&along_x(&sloped_band(0.0, RAFTER_DEPTH), [-0.05, 0.05]));
    });
    w.node("DEF RoofSide Separator", |w| {
        w.line("USE Larch");
        let boards = sloped_band(RAFTER_DEPTH, RAFTER_DEPTH + BOARDING);
        w.solid(&along_x(&boards, VERGE));
        covering(w);
    });
    w.node("DEF TieBeam Separator", |w| {
        w.line("USE Spruce");
        w.cuboid([-0.07, 0.12, 2.83], [0.07, 2.0 * RIDGE_Y - 0.12, EAVE_Z]);
    });
}

/// Beams, gables, rafters and both sides of the covering.
pub(super) fn roof(w: &mut IvWriter) {
    w.node("DEF Roof Separator", |w| {
        beams(w);
        gables(w);
        let half_turn = std::f64::consts::PI;
        w.node("DEF Rafters Separator", |w| {
            for pair in 0..RAFTER_PAIRS {
                let x = -0.45 + pair as f64 * RAFTER_SPACING;
                for angle_rad in [0.0, half_turn] {
                    w.placed(ridge_point(x), angle_rad, |w| w.line("USE Rafter"));
                }
            }
        });
        w.node("DEF Covering Separator", |w| {
            w.placed(ridge_point(0.0), 0.0, |w| w.line("USE RoofSide"));
            w.placed(ridge_point(VERGE[0] + VERGE[1]), half_turn, |w| {
                w.line("USE RoofSide");
            });
            w.line("USE Terracotta");
            let ridge_z = ridge_point(0.0)[2] + RAFTER_DEPTH;
            w.node("Separator", |w| {
                w.line(&format!(
                    "Transform {{ translation {}  rotation 0 0 1 -1.570796 }}",
                    vec3([f64::midpoint(VERGE[0], VERGE[1]), RIDGE_Y, ridge_z + 0.03])
                ));
                w.line(&format!(
                    "Cylinder {{ radius 0.09  height {} }}",
                    num(VERGE[1] - VERGE[0])
                ));
            });
        });
    });
}

fn beams(w: &mut IvWriter) {
    let far = [COUNT[0] - 1, COUNT[1] - 1].map(|bays| bays as f64 * BAY);
    w.node("DEF Beams Separator", |w| {
        w.line("USE Spruce");
        for y in [0.0, far[1]] {
            w.cuboid(
                [-0.12, y - 0.12, COLUMN_HEIGHT],
                [far[0] + 0.12, y + 0.12, EAVE_Z],
            );
        }
        for x in [0.0, far[0]] {
            w.cuboid(
                [x - 0.12, 0.12, COLUMN_HEIGHT],
                [x + 0.12, far[1] - 0.12, EAVE_Z],
            );
        }
        for axis in 1..COUNT[0] - 1 {
            w.placed([axis as f64 * BAY, 0.0, 0.0], 0.0, |w| {
                w.line("USE TieBeam");
            });
        }
        let ridge_z = ridge_point(0.0)[2];
        w.cuboid(
            [VERGE[0] + 0.05, RIDGE_Y - 0.06, ridge_z - 0.24],
            [VERGE[1] - 0.05, RIDGE_Y + 0.06, ridge_z - 0.02],
        );
    });
}

/// Boarded triangles between beam and rafters, with a diamond-shaped vent.
fn gables(w: &mut IvWriter) {
    let width = 2.0 * RIDGE_Y;
    let sill = EAVE_Z + 0.7;
    let rise = ridge_point(0.0)[2];
    // The vent hangs on a bridge from the middle of the lower edge; points 1 and 5 are walked twice.
    let points = vec![
        [0.0, EAVE_Z],
        [RIDGE_Y, EAVE_Z],
        [width, EAVE_Z],
        [RIDGE_Y, rise],
        [RIDGE_Y - 0.3, sill + 0.3],
        [RIDGE_Y, sill],
        [RIDGE_Y + 0.3, sill + 0.3],
        [RIDGE_Y, sill + 0.6],
    ];
    let gable = Outline::ring(points, vec![0, 1, 5, 4, 7, 6, 5, 1, 2, 3]);
    w.node("DEF Gables Separator", |w| {
        w.line("USE Larch");
        for x in [0.0, (COUNT[0] - 1) as f64 * BAY] {
            w.solid(&along_x(&gable, [x - 0.02, x + 0.02]));
        }
    });
}

/// Tile courses as a saw-tooth section, textured: S along the eave, T up the slope, in metres.
fn covering(w: &mut IvWriter) {
    let step = REACH / COURSES as f64;
    let base = |y: f64| RAFTER_DEPTH + BOARDING + y * PITCH;
    let mut section = vec![[0.0, base(0.0)], [-REACH, base(-REACH)]];
    // Each course sits flush at its top and stands up by LAP at its lower edge.
    section.push([-REACH, base(-REACH) + LAP]);
    for course in (0..COURSES).rev() {
        let top = -(course as f64) * step;
        section.push([top, base(top) + 0.001]);
        if course > 0 {
            section.push([top, base(top) + LAP]);
        }
    }
    // Clockwise so far, seen from +x.
    section.reverse();
    let solid = along_x(&Outline::polygon(section), VERGE);
    let uv: Vec<String> = solid
        .points
        .iter()
        .map(|p| format!("{} {}", num(p[0] - VERGE[0]), num((p[1] + REACH) / step)))
        .collect();
    w.line("USE Textured");
    w.line("Texture2 { filename \"textures/roof_tiles.png\" }");
    w.line("Texture2Transform { scaleFactor 0.5 1 }");
    w.node("TextureCoordinate2", |w| w.list("point", &uv, 6));
    w.solid(&solid);
}

/// The band between two heights above the rafters' underside, from the eave to the ridge.
fn sloped_band(low: f64, high: f64) -> Outline {
    let fall = REACH * PITCH;
    Outline::polygon(vec![
        [-REACH, low - fall],
        [0.0, low],
        [0.0, high],
        [-REACH, high - fall],
    ])
}

/// Extrudes a section given in (y, z) along x.
fn along_x(section: &Outline, range: [f64; 2]) -> Solid {
    prism(section, range[1] - range[0]).mapped(|[u, v, w]| [range[0] + w, u, v])
}

/// The rafters' underside at the ridge.
fn ridge_point(x: f64) -> [f64; 3] {
    [x, RIDGE_Y, EAVE_Z + RIDGE_Y * PITCH]
}
