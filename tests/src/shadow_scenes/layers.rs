//! More layers of shadow than a stencil of eight bits counts.

use glam::DVec3;

use super::text::{Mesh, Text};
use super::{ShadowScene, perspective};

/// Layers in the scenes of this file.
pub const LAYERS: usize = 300;

/// Quads one above the other over a floor.
pub fn quad_stack() -> ShadowScene {
    let mut text = Text::new();
    text.point_light([0.3, 5.0, 0.2]);
    text.floor(0.0, 5.0);
    let stack = (0..LAYERS).fold(Mesh::default(), |stack, i| {
        let y = 0.5 + i as f64 / 128.0;
        stack.with(&Mesh::quad(
            [-0.6, y, 0.6],
            [1.2, 0.0, 0.0],
            [0.0, 0.0, -1.2],
        ))
    });
    text.colored([0.4, 0.7, 0.9], &stack);
    let below = DVec3::new(0.2, 0.21, 0.1);
    let among = DVec3::new(0.05, 1.501, 0.04);
    ShadowScene {
        name: "stack of 300 quads",
        text: text.finish(),
        cameras: vec![
            (
                "over",
                perspective(DVec3::new(2.0, 4.1, 4.5), DVec3::Y, 0.5),
            ),
            ("below", perspective(below, DVec3::new(3.0, 0.1, 1.0), 0.9)),
            ("among", perspective(among, DVec3::new(5.0, 1.2, 1.0), 0.9)),
        ],
    }
}

/// Boxes around the light, each around the one before; nothing outside is lit.
pub fn nested_shells() -> ShadowScene {
    shells("300 shells around the light", false)
}

/// The same without the sides that face +X: light falls out to one side.
pub fn nested_open_shells() -> ShadowScene {
    shells("300 open shells around the light", true)
}

fn shells(name: &'static str, open: bool) -> ShadowScene {
    const LIGHT: [f64; 3] = [0.0, 1.5, 0.0];
    let mut text = Text::new();
    text.point_light(LIGHT);
    text.floor(-0.1, 5.0);
    let shells = (0..LAYERS).fold(Mesh::default(), |shells, i| {
        let half = 0.25 + i as f64 / 256.0;
        let mut shell = Mesh::cuboid([-half; 3], [half; 3]).moved(DVec3::from(LIGHT));
        if open {
            shell.faces.remove(1);
        }
        shells.with(&shell)
    });
    text.colored([0.9, 0.8, 0.4], &shells);
    let inside = DVec3::new(0.2, 1.4, 0.1);
    // The rims of open shells are thinner than a pixel: they are seen from inside only.
    let side = if open { -1.0 } else { 1.0 };
    ShadowScene {
        name,
        text: text.finish(),
        cameras: vec![
            (
                "over",
                perspective(DVec3::new(side * 2.0, 4.5, 1.5), DVec3::Y, 0.7),
            ),
            (
                "side",
                perspective(DVec3::new(side * 4.0, 2.2, 1.0), DVec3::Y, 0.6),
            ),
            (
                "inside",
                perspective(inside, DVec3::new(3.0, 0.3, 0.4), 0.8),
            ),
        ],
    }
}
