//! Large regular meshes.

use std::f32::consts::{PI, TAU};

/// Positions and indices.
#[derive(Default)]
pub struct Model {
    pub positions: Vec<[f32; 3]>,
    pub indices: Vec<u32>,
}

impl Model {
    /// Adds a closed sphere of `2 * columns * (rows - 1)` triangles, facing outwards.
    pub fn add_sphere(&mut self, center: [f32; 3], radius: f32, columns: u32, rows: u32) {
        let base = self.positions.len() as u32;
        for row in 0..=rows {
            for column in 0..columns {
                let (polar, azimuth) = (
                    PI * row as f32 / rows as f32,
                    TAU * column as f32 / columns as f32,
                );
                // Exactly one point at each pole.
                let ring = if row == 0 || row == rows {
                    0.0
                } else {
                    polar.sin()
                };
                let unit = [ring * azimuth.cos(), ring * azimuth.sin(), polar.cos()];
                self.positions
                    .push([0, 1, 2].map(|axis| center[axis] + radius * unit[axis]));
            }
        }
        let at = |row: u32, column: u32| base + row * columns + column % columns;
        for row in 0..rows {
            for column in 0..columns {
                let (a, b) = (at(row, column), at(row + 1, column));
                let (c, d) = (at(row + 1, column + 1), at(row, column + 1));
                if row + 1 < rows {
                    self.indices.extend([a, b, c]);
                }
                if row > 0 {
                    self.indices.extend([a, c, d]);
                }
            }
        }
    }

    /// Adds a square of two triangles in the plane `z`.
    pub fn add_quad(&mut self, z: f32) {
        let base = self.positions.len() as u32;
        let corners = [
            [-1.0, -1.0, z],
            [1.0, -1.0, z],
            [1.0, 1.0, z],
            [-1.0, 1.0, z],
        ];
        self.positions.extend(corners);
        self.indices.extend([0, 1, 2, 0, 2, 3].map(|v| v + base));
    }
}
