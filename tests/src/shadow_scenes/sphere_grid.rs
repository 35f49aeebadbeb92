//! Spheres over a plane: the scene of table 1 of Milet, Kobrtek, Zemčík and Pečiva, "Fast and
//! Robust Tessellation-Based Silhouette Shadows", 2014, with as many spheres and triangles as wanted.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::text::Text;
use super::{ShadowScene, perspective};
use crate::reference::RefCamera;

/// The light over the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GridLight {
    /// Above the middle.
    Point,
    /// From one side.
    Directional,
}

/// What to make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridSize {
    /// Spheres, in rows as nearly square as can be.
    pub spheres: usize,
    /// Triangles of all spheres together; the nearest number that equal spheres have is taken.
    pub triangles: usize,
    /// One mesh that is used again, or a mesh for each.
    pub shared: bool,
}

impl GridSize {
    /// 10 by 10 spheres, 28,800 triangles.
    pub const SMALL: Self = Self::hundred(28_800);
    /// 10 by 10 spheres, 96,000 triangles.
    pub const MEDIUM: Self = Self::hundred(96_000);
    /// 10 by 10 spheres, 372,000 triangles.
    pub const LARGE: Self = Self::hundred(372_000);
    /// 10 by 10 spheres, 1,020,000 triangles.
    pub const HUGE: Self = Self::hundred(1_020_000);

    const fn hundred(triangles: usize) -> Self {
        Self {
            spheres: 100,
            triangles,
            shared: true,
        }
    }

    /// Slices around, and bands from pole to pole; the outermost bands have half the triangles.
    fn sphere(self) -> [usize; 2] {
        let own = self.triangles / self.spheres.max(1);
        // 2 n (n / 2) triangles have slices as wide as bands are high.
        let slices = ((own as f64).sqrt() as usize & !1).max(4);
        let bands = (own as f64 / (2 * slices) as f64).round() as usize + 1;
        [slices, bands.max(3)]
    }

    /// Triangles of all spheres.
    pub fn sphere_triangles(self) -> usize {
        let [slices, bands] = self.sphere();
        self.spheres * 2 * slices * (bands - 1)
    }
}

const RADIUS: f64 = 0.35;

/// The grid with a distance of 1 between spheres that float over a plane; cameras `over` all of it
/// and `among` the spheres.
pub fn sphere_grid(size: GridSize, light: GridLight) -> ShadowScene {
    let rows = (size.spheres as f64).sqrt().ceil() as usize;
    let half = rows as f64 / 2.0;
    let mut text = Text::new();
    match light {
        GridLight::Point => text.point_light([0.31, 0.4 * half + 2.0, 0.17]),
        GridLight::Directional => text.sun([-0.5, -1.0, -0.3], 1.0),
    }
    text.floor(0.0, 2.0 * half);
    text.color([0.9, 0.5, 0.3]);
    text.raw("NormalBinding { value PER_VERTEX_INDEXED }");
    for i in 0..size.spheres {
        let [x, z] = [i % rows, i / rows].map(|n| n as f64 + 0.5 - half);
        text.separator(|t| {
            t.translation([x, 0.6, z]);
            if i == 0 || !size.shared {
                t.node("DEF Ball Group", |t| sphere(t, size.sphere(), i));
            } else {
                t.raw("USE Ball");
            }
        });
    }
    ShadowScene {
        name: "sphere grid",
        text: text.finish(),
        cameras: cameras(half),
    }
}

fn cameras(half: f64) -> Vec<(&'static str, RefCamera)> {
    let middle = DVec3::new(0.0, 0.3, 0.0);
    let over = DVec3::new(0.4, 1.1, 1.7) * half;
    let among = DVec3::new(0.03, 0.8, half);
    vec![
        ("over", perspective(over, middle, 0.45)),
        ("among", perspective(among, middle, 0.6)),
    ]
}

/// Triangles of a sphere, with normals. Spheres that are not shared differ by a turn of `number`.
fn sphere(text: &mut Text, [slices, bands]: [usize; 2], number: usize) {
    let ring = |band: usize| {
        let (sin, cos) = (PI * band as f64 / bands as f64).sin_cos();
        (0..slices).map(move |slice| {
            let angle_rad = TAU * slice as f64 / slices as f64 + 0.01 * number as f64;
            DVec3::new(sin * angle_rad.sin(), cos, sin * angle_rad.cos())
        })
    };
    let poles = [DVec3::Y, DVec3::NEG_Y];
    let points = || (1..bands).flat_map(ring).chain(poles);
    text.raw("Coordinate3 { point [");
    points().for_each(|p| text.triple(p * RADIUS));
    text.raw("] }\nNormal { vector [");
    points().for_each(|p| text.triple(p));
    text.raw("] }\nIndexedFaceSet { coordIndex [");
    let (top, bottom) = (slices * (bands - 1), slices * (bands - 1) + 1);
    for slice in 0..slices {
        let next = (slice + 1) % slices;
        let last = slices * (bands - 2);
        text.add(format_args!("{top}, {slice}, {next}, -1, "));
        text.add(format_args!(
            "{bottom}, {}, {}, -1,\n",
            last + next,
            last + slice
        ));
        for band in 0..bands - 2 {
            let (a, b) = (slices * band + slice, slices * band + next);
            let (c, d) = (a + slices, b + slices);
            text.add(format_args!("{a}, {c}, {d}, -1, {a}, {d}, {b}, -1,\n"));
        }
    }
    text.raw("] }");
}
