//! The four outer walls with doors and windows, the partition, and the glazing that fills them.
//!
//! A wall is one closed solid; its faces are concave at doors and bridged at windows.

use crate::iv_writer::{IvWriter, num, vec3};
use crate::solid::{Opening, Outline, Solid, prism};

/// Least and greatest corner of the walls on plan.
pub(super) const WEST_SOUTH: [f64; 2] = [0.9, 2.1];
pub(super) const EAST_NORTH: [f64; 2] = [8.1, 7.2];
/// Height of the walls, thickness of the outer walls and of the partition.
pub(super) const HEIGHT: f64 = 2.7;
pub(super) const THICK: f64 = 0.24;
const PARTITION: [f64; 2] = [5.2, 5.32];

/// Width and height of the two kinds of glazing.
const WINDOW: [f64; 2] = [1.5, 1.2];
const FRENCH_WINDOW: [f64; 2] = [2.4, 2.3];
/// Frame width, frame depth, pane thickness and the gap between the two panes.
const FRAME: f64 = 0.06;
const FRAME_DEPTH: f64 = 0.07;
const PANE: f64 = 0.006;
const PANE_GAP: f64 = 0.012;
/// How far a frame sits behind the outer face.
const REVEAL: f64 = 0.1;
const DOOR: [f64; 2] = [0.9, 2.1];

/// An outer wall: its lower left corner and its direction to the right, seen from outside.
struct Facade {
    name: &'static str,
    corner: [f64; 2],
    right: [f64; 2],
    width: f64,
    openings: &'static [(Opening, &'static str)],
}

const fn window(left: f64) -> (Opening, &'static str) {
    let opening = Opening {
        left,
        width: WINDOW[0],
        sill: 0.95,
        head: 0.95 + WINDOW[1],
    };
    (opening, "Window")
}

const fn french_window(left: f64) -> (Opening, &'static str) {
    let opening = Opening {
        left,
        width: FRENCH_WINDOW[0],
        sill: 0.0,
        head: FRENCH_WINDOW[1],
    };
    (opening, "FrenchWindow")
}

const fn door(left: f64) -> (Opening, &'static str) {
    let opening = Opening {
        left,
        width: DOOR[0],
        sill: 0.0,
        head: DOOR[1],
    };
    (opening, "Door")
}

const LONG: f64 = EAST_NORTH[0] - WEST_SOUTH[0];
const SHORT: f64 = EAST_NORTH[1] - WEST_SOUTH[1] - 2.0 * THICK;

const FACADES: [Facade; 4] = [
    Facade {
        name: "Wall_South",
        corner: WEST_SOUTH,
        right: [1.0, 0.0],
        width: LONG,
        openings: &[french_window(1.0), window(4.95)],
    },
    Facade {
        name: "Wall_East",
        corner: [EAST_NORTH[0], WEST_SOUTH[1] + THICK],
        right: [0.0, 1.0],
        width: SHORT,
        openings: &[door(0.7), window(2.4)],
    },
    Facade {
        name: "Wall_North",
        corner: EAST_NORTH,
        right: [-1.0, 0.0],
        width: LONG,
        openings: &[window(0.8), window(4.2)],
    },
    Facade {
        name: "Wall_West",
        corner: [WEST_SOUTH[0], EAST_NORTH[1] - THICK],
        right: [0.0, -1.0],
        width: SHORT,
        openings: &[window(1.56)],
    },
];

impl Facade {
    /// The point `u` to the right, `v` up and `depth` behind the outer face.
    fn point(&self, u: f64, v: f64, depth: f64) -> [f64; 3] {
        let [dx, dy] = self.right;
        [
            self.corner[0] + dx * u - dy * depth,
            self.corner[1] + dy * u + dx * depth,
            v,
        ]
    }

    fn solid(&self) -> Solid {
        let openings: Vec<Opening> = self.openings.iter().map(|&(o, _)| o).collect();
        prism(&Outline::wall(self.width, HEIGHT, &openings), THICK)
            .mapped(|[u, v, w]| self.point(u, v, THICK - w))
    }

    fn angle_rad(&self) -> f64 {
        self.right[1].atan2(self.right[0])
    }
}

/// Glazing and door, each in a frame of its own: x right, y into the building, z up from the
/// opening's lower left corner.
pub(super) fn parts(w: &mut IvWriter) {
    glazing(w, "Window", WINDOW, &[0.5]);
    glazing(w, "FrenchWindow", FRENCH_WINDOW, &[1.0 / 3.0, 2.0 / 3.0]);
    w.node("DEF Screw Separator", |w| {
        w.line("USE Steel");
        w.line("Complexity { value 0.3 }");
        w.line("Cylinder { radius 0.0035  height 0.002 }");
    });
    door_handle(w);
    door_part(w);
}

/// Frame, mullions at fractions of the width, and two panes with the gap between them.
fn glazing(w: &mut IvWriter, name: &str, [width, height]: [f64; 2], mullions: &[f64]) {
    w.node(&format!("DEF {name} Separator"), |w| {
        w.line("USE PaintedGreen");
        let light = Opening {
            left: FRAME,
            width: width - 2.0 * FRAME,
            sill: FRAME,
            head: height - FRAME,
        };
        let frame = prism(&Outline::wall(width, height, &[light]), FRAME_DEPTH);
        w.solid(&frame.mapped(|[u, v, w]| [u, FRAME_DEPTH - w, v]));
        for fraction in mullions {
            let centre = fraction * width;
            w.cuboid(
                [centre - 0.025, 0.01, FRAME],
                [centre + 0.025, FRAME_DEPTH - 0.01, height - FRAME],
            );
        }
        // Panes are sheets, not bodies: seen and lit from both sides.
        w.line("USE Glass");
        w.line("ShapeHints { vertexOrdering COUNTERCLOCKWISE  shapeType UNKNOWN_SHAPE_TYPE }");
        let first = f64::midpoint(0.0, FRAME_DEPTH) - PANE_GAP / 2.0 - PANE;
        for depth in [first, first + PANE + PANE_GAP] {
            let (x, z) = ([FRAME, width - FRAME], [FRAME, height - FRAME]);
            let corners = [[x[0], z[0]], [x[1], z[0]], [x[1], z[1]], [x[0], z[1]]];
            let points = corners.map(|[x, z]| vec3([x, depth, z]));
            w.node("Coordinate3", |w| w.list("point", &points, 4));
            w.line("FaceSet { numVertices 4 }");
        }
    });
}

/// Rose, lever and two screws; the lever lies along -x.
fn door_handle(w: &mut IvWriter) {
    w.node("DEF DoorHandle Separator", |w| {
        w.line("USE Brass");
        w.line("DEF HandleRose Cylinder { radius 0.026  height 0.008 }");
        w.node("Separator", |w| {
            w.translation([0.0, 0.03, 0.0]);
            w.line("Cylinder { radius 0.009  height 0.052 }");
        });
        w.node("Separator", |w| {
            w.line("Transform { translation -0.055 0.052 0  rotation 0 0 1 1.570796 }");
            w.line("Cylinder { radius 0.008  height 0.126 }");
        });
        for z in [-0.019, 0.019] {
            w.placed([0.0, 0.0045, z], 0.0, |w| w.line("USE Screw"));
        }
    });
}

/// A leaf ajar on its hinges, with a handle on either side.
fn door_part(w: &mut IvWriter) {
    let [width, height] = DOOR;
    w.node("DEF Door Separator", |w| {
        w.line("USE PaintedGreen");
        w.cuboid([0.0, 0.0, 0.0], [0.05, 0.1, height]);
        w.cuboid([width - 0.05, 0.0, 0.0], [width, 0.1, height]);
        w.cuboid([0.05, 0.0, height - 0.05], [width - 0.05, 0.1, height]);
        w.placed([0.053, 0.0, 0.0], -0.6, |w| {
            let (leaf, top) = (width - 0.106, height - 0.053);
            w.line("USE Oak");
            w.cuboid([0.0, 0.0, 0.008], [leaf, 0.04, top]);
            w.cuboid([0.12, -0.006, 0.2], [leaf - 0.12, 0.0, 0.85]);
            w.cuboid([0.12, -0.006, 1.2], [leaf - 0.12, 0.0, 1.9]);
            w.placed([leaf - 0.06, 0.044, 1.03], 0.0, |w| {
                w.line("USE DoorHandle")
            });
            w.node("Separator", |w| {
                w.line(&format!(
                    "Transform {{ translation {}  rotation 1 0 0 3.141593 }}",
                    vec3([leaf - 0.06, -0.004, 1.03])
                ));
                w.line("USE DoorHandle");
            });
            w.line("USE Steel");
            for z in [0.25, 1.05, 1.8] {
                w.upright_cylinder([-0.002, -0.006, z], 0.007, 0.1);
            }
        });
    });
}

/// The outer walls, the partition and the ceiling.
pub(super) fn walls(w: &mut IvWriter) {
    w.node("DEF Walls Separator", |w| {
        for facade in &FACADES {
            w.node(&format!("DEF {} Separator", facade.name), |w| {
                outer_wall(w, facade)
            });
        }
        w.node("DEF Partition Separator", |w| {
            w.line("USE Plaster");
            let outline = Outline::wall(SHORT, HEIGHT, &[door(3.4).0]);
            let thick = PARTITION[1] - PARTITION[0];
            let south = WEST_SOUTH[1] + THICK;
            w.solid(&prism(&outline, thick).mapped(|[u, v, w]| [PARTITION[0] + w, south + u, v]));
        });
        w.node("DEF Ceiling Separator", |w| {
            w.line("USE Plaster");
            let [x, y] = WEST_SOUTH;
            w.cuboid(
                [x, y, HEIGHT],
                [EAST_NORTH[0], EAST_NORTH[1], HEIGHT + 0.12],
            );
        });
    });
}

fn outer_wall(w: &mut IvWriter, facade: &Facade) {
    let solid = facade.solid();
    w.node("Separator", |w| {
        if facade.name == "Wall_South" {
            brick_texture(w, &solid);
        } else {
            w.line("USE Plaster");
        }
        w.solid(&solid);
    });
    for (opening, filling) in facade.openings {
        let place = facade.point(opening.left, opening.sill, REVEAL);
        w.placed(place, facade.angle_rad(), |w| {
            w.line(&format!("USE {filling}"))
        });
        if opening.sill > 0.0 {
            window_sill(w, facade, opening);
        }
    }
}

/// A stone sill that stands out 4 cm.
fn window_sill(w: &mut IvWriter, facade: &Facade, opening: &Opening) {
    let place = facade.point(opening.left, opening.sill, 0.0);
    w.placed(place, facade.angle_rad(), |w| {
        w.line("USE Limestone");
        w.cuboid([-0.04, -0.04, -0.04], [opening.width + 0.04, REVEAL, 0.005]);
    });
}

/// Texture coordinates in metres; the texture transform makes one picture cover 50 cm by 64 cm:
/// two bricks of 25 cm, eight courses of 8 cm.
fn brick_texture(w: &mut IvWriter, solid: &Solid) {
    let uv: Vec<String> = solid
        .points
        .iter()
        .map(|p| format!("{} {}", num(p[0] + p[1]), num(p[2])))
        .collect();
    w.line("USE Textured");
    w.line("Texture2 { filename \"textures/bricks.png\" }");
    w.line("Texture2Transform { scaleFactor 2 1.5625 }");
    w.node("TextureCoordinate2", |w| w.list("point", &uv, 6));
}
