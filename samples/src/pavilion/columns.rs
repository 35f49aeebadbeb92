//! One column, defined once and used sixteen times on a grid of 2.7 m.

use crate::iv_writer::IvWriter;
use crate::solid::lathe;

/// Distance between column axes in metres.
pub(super) const BAY: f64 = 2.7;
/// Column axes along x and along y.
pub(super) const COUNT: [usize; 2] = [6, 4];
/// Where the columns end and the beam begins.
pub(super) const COLUMN_HEIGHT: f64 = 2.7;

/// Facets round a shaft.
const SIDES: usize = 24;

/// (radius, height) of the turned shaft: foot, slight swelling, neck ring, flaring capital.
const SHAFT: [[f64; 2]; 12] = [
    [0.17, 0.13],
    [0.15, 0.16],
    [0.15, 0.8],
    [0.146, 1.4],
    [0.138, 1.95],
    [0.128, 2.4],
    [0.14, 2.41],
    [0.14, 2.44],
    [0.128, 2.45],
    [0.132, 2.5],
    [0.155, 2.57],
    [0.185, 2.62],
];

/// The column's definition.
pub(super) fn part(w: &mut IvWriter) {
    w.node("DEF Column Separator", |w| {
        w.line("USE Limestone");
        w.cuboid([-0.22, -0.22, 0.0], [0.22, 0.22, 0.07]);
        w.upright_cylinder([0.0, 0.0, 0.07], 0.195, 0.06);
        w.solid(&lathe(&SHAFT, SIDES));
        w.cuboid([-0.2, -0.2, 2.62], [0.2, 0.2, COLUMN_HEIGHT]);
    });
}

/// The columns along the four sides.
pub(super) fn colonnade(w: &mut IvWriter) {
    w.node("DEF Colonnade Separator", |w| {
        for row in 0..COUNT[1] {
            for column in 0..COUNT[0] {
                let is_inside =
                    (1..COUNT[0] - 1).contains(&column) && (1..COUNT[1] - 1).contains(&row);
                if !is_inside {
                    w.placed([column as f64 * BAY, row as f64 * BAY, 0.0], 0.0, |w| {
                        w.line("USE Column");
                    });
                }
            }
        }
    });
}
