//! What surrounds the building: the surveyed boundary in full LV95 coordinates, the terrain as a
//! coloured grid, the garden path, hedges and trees.

use super::in_lv95;
use super::rooms::{GROUND, PLATFORM};
use crate::iv_writer::{IvWriter, num, vec3};
use crate::textures::hash;

/// The terrain's south-west corner, cell size and number of points along x and y.
const GRID_CORNER: [f64; 2] = [-13.0, -15.0];
const CELL: f64 = 1.25;
const GRID_POINTS: [u32; 2] = [34, 31];

/// Boundary points on plan, counter-clockwise, measured to the millimetre.
const BOUNDARY: [[f64; 2]; 6] = [
    [-11.482, -13.215],
    [9.137, -14.006],
    [25.904, -12.871],
    [27.318, 9.442],
    [18.655, 20.183],
    [-10.927, 19.764],
];

/// Hills and hollows: centre, radius and height above the level ground.
const HILLS: [([f64; 2], f64, f64); 4] = [
    ([-9.0, 18.0], 15.0, 2.3),
    ([24.0, 17.0], 13.0, 1.5),
    ([25.0, -13.0], 10.0, -0.5),
    ([-12.0, -9.0], 9.0, 0.8),
];

/// Line and points of the boundary, unlit, in full coordinates.
pub(super) fn boundary(w: &mut IvWriter) {
    let stones: Vec<String> = BOUNDARY
        .iter()
        .map(|&[x, y]| vec3(in_lv95([x, y, terrain_height(x, y) + 0.05])))
        .collect();
    w.node("DEF SiteBoundary Separator", |w| {
        w.line("# LV95 easting, northing and height: no Transform above these points.");
        w.line("LightModel { model BASE_COLOR }");
        w.line("BaseColor { rgb 0.85 0.12 0.1 }");
        w.line("DrawStyle { lineWidth 2  pointSize 7 }");
        w.node("DEF SurveyPoints Coordinate3", |w| {
            w.list("point", &stones, 1)
        });
        w.line("PointSet { }");
        w.node("IndexedLineSet", |w| {
            w.line("coordIndex [ 0, 1, 2, 3, 4, 5, 0, -1 ]")
        });
    });
}

/// Tree, hedge and paving stone.
pub(super) fn parts(w: &mut IvWriter) {
    w.node("DEF Tree Separator", |w| {
        w.line("USE Bark");
        w.upright_cylinder([0.0, 0.0, -0.3], 0.16, 2.6);
        w.line("USE Leaves");
        w.line("Complexity { value 0.6 }");
        let crown = [
            ([0.0, 0.0, 3.3], 1.5),
            ([0.8, 0.4, 2.8], 1.05),
            ([-0.7, 0.55, 2.9], 1.1),
            ([-0.2, -0.85, 2.75], 1.05),
            ([0.15, 0.1, 4.4], 1.0),
        ];
        for (centre, radius) in crown {
            w.node("Separator", |w| {
                w.translation(centre);
                w.line(&format!("Sphere {{ radius {} }}", num(radius)));
            });
        }
    });
    w.node("DEF Hedge Separator", |w| {
        w.line("USE Boxwood");
        w.cuboid([-1.4, -0.3, -0.4], [1.4, 0.3, 0.75]);
    });
    w.node("DEF PavingStone Separator", |w| {
        w.line("USE Limestone");
        w.cuboid([-0.75, -0.36, -0.1], [0.75, 0.36, 0.035]);
    });
}

/// Terrain and planting.
pub(super) fn garden(w: &mut IvWriter) {
    w.node("DEF Terrain Separator", terrain);
    w.node("DEF Path Separator", |w| {
        for stone in 0..11 {
            let y = -2.2 - f64::from(stone) * 0.98;
            let sway = 0.1 * f64::from(stone * 3 % 5 - 2);
            standing(
                w,
                "PavingStone",
                [6.75 + sway, y],
                0.04 * f64::from(stone % 3 - 1),
            );
        }
    });
    w.node("DEF Hedges Separator", |w| {
        for x in [-0.6, 2.6, 10.9, 14.1] {
            standing(w, "Hedge", [x, -2.4], 0.0);
        }
        for x in [-3.0, 0.4, 3.8, 7.2, 10.6, 14.0, 17.4] {
            standing(w, "Hedge", [x, 12.2], 0.0);
        }
    });
    w.node("DEF Trees Separator", |w| {
        let trees = [
            ([-5.2, 2.5], 0.4, 1.0),
            ([-7.5, 9.5], 1.9, 1.25),
            ([3.0, 15.5], 2.7, 1.15),
            ([11.5, 17.0], 4.0, 1.3),
            ([19.5, 13.5], 5.1, 1.05),
            ([-8.0, -6.0], 3.2, 0.9),
        ];
        for ([x, y], angle_rad, size) in trees {
            w.placed([x, y, terrain_height(x, y)], angle_rad, |w| {
                w.line(&format!("Scale {{ scaleFactor {} }}", vec3([size; 3])));
                w.line("USE Tree");
            });
        }
    });
}

fn standing(w: &mut IvWriter, part: &str, [x, y]: [f64; 2], angle_rad: f64) {
    w.placed([x, y, terrain_height(x, y)], angle_rad, |w| {
        w.line(&format!("USE {part}"));
    });
}

/// The ground as a mesh, rows from north to south so that its quads face up; a colour a vertex.
fn terrain(w: &mut IvWriter) {
    let [columns, rows] = GRID_POINTS;
    let mut points = Vec::new();
    let mut colours = Vec::new();
    for row in (0..rows).rev() {
        for column in 0..columns {
            let x = GRID_CORNER[0] + f64::from(column) * CELL;
            let y = GRID_CORNER[1] + f64::from(row) * CELL;
            points.push(vec3([x, y, terrain_height(x, y)]));
            colours.push(format!("0x{:08x}", ground_colour(column, row)));
        }
    }
    w.line("ShapeHints { vertexOrdering COUNTERCLOCKWISE  shapeType UNKNOWN_SHAPE_TYPE }");
    w.node("QuadMesh", |w| {
        w.line(&format!("verticesPerRow {columns}"));
        w.line(&format!("verticesPerColumn {rows}"));
        w.node("vertexProperty VertexProperty", |w| {
            w.line("materialBinding PER_VERTEX");
            w.list("vertex", &points, 6);
            w.list("orderedRGBA", &colours, 8);
        });
    });
}

/// Meadow green with a little variation, as 0xRRGGBBAA.
fn ground_colour(column: u32, row: u32) -> u32 {
    let shade = u32::from(hash(column, row, 5) % 22);
    let dryness = u32::from(hash(column / 3, row / 3, 6) % 24);
    let (red, green, blue) = (92 + shade + dryness, 118 + shade, 58 + shade / 2);
    red << 24 | green << 16 | blue << 8 | 0xff
}

/// Height in building coordinates: level round the platform, hills farther out.
fn terrain_height(x: f64, y: f64) -> f64 {
    let [[west, south], [east, north]] = PLATFORM;
    let away_x = (west - x).max(x - east).max(0.0);
    let away_y = (south - y).max(y - north).max(0.0);
    let away = away_x.hypot(away_y);
    let hills: f64 = HILLS
        .iter()
        .map(|&([cx, cy], radius, height)| {
            let t = 1.0 - ((x - cx).powi(2) + (y - cy).powi(2)) / (radius * radius);
            height * t.max(0.0).powi(2)
        })
        .sum();
    GROUND + smooth_step((away - 2.0) / 6.0) * hills
}

fn smooth_step(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
