//! Lights, eyes and solids in awkward places.

use glam::DVec3;

use super::text::{Mesh, Text};
use super::{ShadowScene, orthographic, over, perspective};
use crate::reference::{RefCamera, RefLens};

/// Slabs over the eye, so that it is in one, two or three shadow volumes, or just outside.
pub fn eye_in_shadow() -> ShadowScene {
    let mut text = Text::new();
    text.point_light([0.0, 6.0, 0.0]);
    text.floor(0.0, 8.0);
    for (y, low, high) in [(3.0, -1.5, 0.5), (2.0, -0.5, 1.0), (1.2, -0.4, 0.4)] {
        let slab = Mesh::cuboid([low, y, low], [high, y + 0.1, high]);
        text.colored([0.3 * y, 0.8, 0.5], &slab);
    }
    let target = DVec3::new(1.5, 0.0, 1.3);
    let from = |x: f64| perspective(DVec3::new(x, 0.55, 0.011), target, 0.7);
    ShadowScene {
        name: "eye in shadow volumes",
        text: text.finish(),
        cameras: vec![
            ("in three", from(0.01)),
            ("in one", from(-0.9)),
            ("in none", from(-3.0)),
        ],
    }
}

/// A square under a lamp, with eyes in the plane through the lamp and one of its sides, a hair
/// beside it, and so near to the square that a near plane could cut it.
pub fn eye_on_side_plane() -> ShadowScene {
    let mut text = Text::new();
    text.point_light([0.0, 4.0, 0.0]);
    text.floor(0.0, 5.0);
    let quad = Mesh::quad([-1.0, 2.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]);
    text.colored([0.9, 0.4, 0.4], &quad);
    // At height y the plane is at x = (4 - y) / 2.
    let to =
        |eye: [f64; 3], target: [f64; 3]| perspective(DVec3::from(eye), DVec3::from(target), 0.8);
    let across = |x: f64| to([x, 1.0, 0.25], [-1.0, 0.5, -0.5]);
    ShadowScene {
        name: "eye on the side of a shadow volume",
        text: text.finish(),
        cameras: vec![
            ("on it", across(1.5)),
            ("a hair inside", across(1.5 - 1e-5)),
            ("a hair outside", across(1.5 + 1e-5)),
            ("inside", across(1.5 - 1e-3)),
            ("outside", across(1.5 + 1e-3)),
            ("on two", to([1.5, 1.0, 1.5], [-1.0, 0.5, -0.5])),
            (
                "just above the square",
                to([0.9, 2.001, 0.3], [3.0, 0.5, 1.0]),
            ),
            (
                "just below the square",
                to([0.9, 1.999, 0.3], [3.0, 0.5, 1.0]),
            ),
            ("at the lamp", to([0.0, 4.0, 0.0], [0.9, 2.0, 0.7])),
        ],
    }
}

/// A lamp in a closed room, with furniture; outside it is dark.
pub fn closed_room() -> ShadowScene {
    room("light in a closed room", false)
}

/// The same with a window.
pub fn room_with_window() -> ShadowScene {
    room("light in a room with a window", true)
}

fn room(name: &'static str, window: bool) -> ShadowScene {
    let mut text = Text::new();
    text.point_light([0.2, 1.6, -0.3]);
    text.floor(-0.05, 6.0);
    let mut walls = Mesh::cuboid([-1.5, 0.0, -1.5], [1.5, 2.0, 1.5]);
    if window {
        // The wall at +X becomes a frame of four trapezoids.
        walls.faces.remove(1);
        let first = walls.points.len();
        let hole = [(0.6, -0.7), (1.5, -0.7), (1.5, 0.8), (0.6, 0.8)];
        walls
            .points
            .extend(hole.map(|(y, z)| DVec3::new(1.5, y, z)));
        let outer = [1, 3, 7, 5];
        for i in 0..4 {
            let j = (i + 1) % 4;
            walls
                .faces
                .push(vec![outer[i], outer[j], first + j, first + i]);
        }
    }
    text.colored([0.8, 0.8, 0.9], &walls);
    text.colored(
        [0.7, 0.4, 0.2],
        &Mesh::cuboid([0.4, 0.0, 0.2], [1.0, 0.7, 0.9]),
    );
    let inside = perspective(DVec3::new(-1.2, 1.3, 1.2), DVec3::new(0.8, 0.5, 0.0), 0.8);
    ShadowScene {
        name,
        text: text.finish(),
        cameras: vec![
            ("inside", inside),
            (
                "outside",
                perspective(DVec3::new(5.0, 3.0, 3.0), DVec3::X, 0.5),
            ),
        ],
    }
}

/// A lamp in the plane of a quad and of a box's top, and a sun along sides of the box.
pub fn light_in_plane() -> ShadowScene {
    let mut text = Text::new();
    text.lamp("PointLight", DVec3::from([0.0, 1.0, 0.0]), "intensity 0.5");
    text.sun([-1.0, -1.0, 0.0], 0.5);
    text.floor(0.0, 4.0);
    let quad = Mesh::quad([0.5, 1.0, 0.5], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]);
    text.colored([0.9, 0.7, 0.2], &quad);
    text.colored(
        [0.3, 0.7, 0.9],
        &Mesh::cuboid([-1.75, 0.25, -0.5], [-0.75, 1.0, 0.5]),
    );
    // The lamp is on this one.
    let around = Mesh::quad([-0.25, 1.0, 1.25], [0.5, 0.0, 0.0], [0.0, 0.0, -2.5]);
    text.colored([0.9, 0.3, 0.3], &around);
    ShadowScene {
        name: "light in the plane of faces",
        text: text.finish(),
        cameras: vec![
            ("over", over()),
            ("low", perspective(DVec3::new(3.0, 0.6, 2.0), DVec3::Y, 0.5)),
        ],
    }
}

/// Solids whose faces on the eye's side are not drawn, because they have none inside or are inside
/// out: what is behind them is seen, and in their shadow.
pub fn culled_casters() -> ShadowScene {
    let mut text = Text::new();
    text.sun([0.0, -1.0, 0.0], 0.5);
    text.lamp("PointLight", DVec3::new(1.1, 4.0, 0.7), "intensity 0.5");
    text.floor(0.0, 3.0);
    text.raw("ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType SOLID }");
    // Facing down.
    let sheet = Mesh::quad([-1.75, 1.0, -0.75], [1.5, 0.0, 0.0], [0.0, 0.25, 1.5]);
    text.colored([0.9, 0.7, 0.2], &sheet);
    let inside_out = Mesh::cuboid([0.25, 0.25, -0.5], [1.25, 1.0, 0.5]).reversed();
    text.colored([0.3, 0.7, 0.9], &inside_out);
    let above = DVec3::Y * 9.0;
    let lens = RefLens::Orthographic { half_height: 3.2 };
    ShadowScene {
        name: "casters that are not drawn from their back",
        text: text.finish(),
        cameras: vec![
            ("over", over()),
            (
                "along the sun",
                RefCamera::look_at(above, DVec3::ZERO, DVec3::Z, lens),
            ),
            (
                "parallel",
                orthographic(DVec3::new(3.0, 7.0, 5.0), DVec3::ZERO, 2.5),
            ),
            (
                "from below",
                orthographic(DVec3::new(1.0, -7.0, 3.0), DVec3::ZERO, 2.5),
            ),
        ],
    }
}

/// One solid, placed by transforms of which some mirror, some scale unevenly.
pub fn mirrored() -> ShadowScene {
    let mut text = Text::new();
    text.lamp("PointLight", DVec3::from([0.5, 5.0, 1.0]), "intensity 0.5");
    text.sun([0.6, -1.0, -0.4], 0.5);
    text.floor(0.0, 4.0);
    let mut wedge = Mesh::cuboid([-0.4, 0.0, -0.3], [0.6, 0.5, 0.4]);
    wedge.points[7] += DVec3::new(0.3, 0.6, 0.1);
    // A corner that is moved bends quads: triangles only.
    let fans = |face: &Vec<usize>| [1, 2].map(|i| vec![face[0], face[i], face[i + 1]]);
    wedge.faces = wedge.faces.iter().flat_map(fans).collect();
    let places = [
        ("-1.5 0.4 -1", "1 1 1", "0 1 0 0.3"),
        ("0 0.4 -1", "-1 1 1", "0 1 0 0.3"),
        ("1.5 0.4 -1", "-1 -1 1", "1 0 0 0.2"),
        ("-1.5 1.5 1", "-1 -1 -1", "0 0 1 0.4"),
        ("0 0.4 1", "1.5 0.5 -1", "1 1 0 0.5"),
        ("1.5 0.4 1", "1 -0.7 1", "0 0 1 3.1"),
    ];
    for (i, (translation, scale, rotation)) in places.into_iter().enumerate() {
        text.separator(|t| {
            if i % 2 == 0 {
                t.raw("ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType SOLID }");
            }
            t.color([0.5 + 0.08 * i as f64, 0.6, 0.9 - 0.1 * i as f64]);
            t.raw(&format!(
                "Transform {{ translation {translation} rotation {rotation} scaleFactor {scale} }}"
            ));
            if i == 0 {
                t.node("DEF Wedge Group", |t| t.mesh(&wedge));
            } else {
                t.raw("USE Wedge");
            }
        });
    }
    ShadowScene {
        name: "mirrored instances",
        text: text.finish(),
        cameras: vec![
            ("over", over()),
            (
                "behind",
                perspective(DVec3::new(-3.0, 2.0, -4.0), DVec3::Y, 0.4),
            ),
        ],
    }
}

/// The way the light of [`parallel_views`] travels.
const SUN: DVec3 = DVec3::new(0.5, -1.0, 0.25);

/// Parallel views along the light, against it and across, from far away and from within.
pub fn parallel_views() -> ShadowScene {
    let mut text = Text::new();
    text.sun(SUN.to_array(), 1.0);
    table(&mut text);
    let at = DVec3::new(0.0, 0.7, 0.0);
    let view =
        |direction: DVec3, distance| orthographic(at - direction.normalize() * distance, at, 3.0);
    let across = SUN.cross(DVec3::new(1.0, 0.3, 0.0));
    ShadowScene {
        name: "parallel views",
        text: text.finish(),
        cameras: vec![
            ("along", view(SUN, 20.0)),
            ("against", view(-SUN, 20.0)),
            ("across", view(across, 20.0)),
            ("oblique", view(DVec3::new(-0.6, -0.5, -0.9), 20.0)),
            ("from within", view(DVec3::new(-0.6, -0.5, -0.9), 1.9)),
        ],
    }
}

/// The same views with a lamp instead of the sun.
pub fn parallel_views_of_lamp() -> ShadowScene {
    let mut text = Text::new();
    text.point_light((SUN * -4.0).to_array());
    table(&mut text);
    ShadowScene {
        name: "parallel views of a lamp",
        text: text.finish(),
        cameras: parallel_views().cameras,
    }
}

/// A scene far from the origin, its coordinates and lights given there.
pub fn far_by_coordinates(offset: DVec3) -> ShadowScene {
    let mut text = Text::at(offset);
    lamp_and_table(&mut text);
    far("far away by coordinates", text, offset)
}

/// The same scene near the origin, moved there by a transform.
pub fn far_by_transform(offset: DVec3) -> ShadowScene {
    let mut text = Text::new();
    text.translation(offset.to_array());
    lamp_and_table(&mut text);
    far("far away by a transform", text, offset)
}

fn far(name: &'static str, text: Text, offset: DVec3) -> ShadowScene {
    let close = perspective(DVec3::new(1.5, 1.2, 1.1), DVec3::new(0.2, 0.0, -0.3), 0.5);
    ShadowScene {
        name,
        text: text.finish(),
        cameras: vec![
            ("over", over().moved(offset)),
            ("close", close.moved(offset)),
        ],
    }
}

fn lamp_and_table(text: &mut Text) {
    text.point_light([0.4, 3.5, 0.6]);
    table(text);
}

/// A floor with a box, a tilted quad and a tetrahedron over it.
fn table(text: &mut Text) {
    text.floor(0.0, 2.5);
    text.colored(
        [0.9, 0.5, 0.3],
        &Mesh::cuboid([-1.25, 0.25, -0.75], [-0.25, 0.75, 0.5]),
    );
    let quad = Mesh::quad([0.25, 1.0, 0.5], [1.0, 0.5, 0.25], [0.0, 0.5, -1.0]);
    text.colored([0.3, 0.8, 0.5], &quad);
    let points = [
        [0.5, 0.25, 0.75],
        [1.25, 0.25, 1.0],
        [0.75, 0.25, 1.5],
        [0.75, 0.875, 1.0],
    ];
    let faces: [&[usize]; 4] = [&[0, 1, 2], &[0, 3, 1], &[1, 3, 2], &[2, 3, 0]];
    text.colored([0.4, 0.5, 0.9], &Mesh::new(&points, &faces));
}
