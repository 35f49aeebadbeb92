//! Random meshes in which degeneracy, coplanarity and shared edges are frequent.

use proptest::prelude::*;

use crate::oracle::{Case, Point, SCALE};

fn position() -> impl Strategy<Value = [i8; 3]> {
    prop::array::uniform3(-3_i8..=3)
}

/// A homogeneous light: half of them points, half directions.
pub fn light() -> impl Strategy<Value = [i8; 4]> {
    (prop::array::uniform3(-4_i8..=4), 0_i8..=1)
        .prop_filter("no direction", |(xyz, w)| *w == 1 || *xyz != [0; 3])
        .prop_map(|([x, y, z], w)| [x, y, z, w])
}

/// Any triangles over few positions, some of them equal.
fn soup() -> impl Strategy<Value = (Vec<[i8; 3]>, Vec<u32>)> {
    (3_usize..10).prop_flat_map(|count| {
        let index = 0..count as u32;
        (
            prop::collection::vec(position(), count),
            prop::collection::vec(index, 3..60).prop_map(|mut indices| {
                indices.truncate(indices.len() / 3 * 3);
                indices
            }),
        )
    })
}

/// The faces of a tetrahedron and of an octahedron, outwards for vertices in the usual places.
const SOLIDS: [&[u32]; 2] = [
    &[0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3],
    &[
        0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5,
    ],
];

/// Closed surfaces with vertices anywhere: convex ones, inside-out ones, and ones that are
/// folded through themselves; several in one mesh.
fn solids() -> impl Strategy<Value = (Vec<[i8; 3]>, Vec<u32>)> {
    let one = (0..SOLIDS.len(), prop::collection::vec(position(), 6));
    prop::collection::vec(one, 1..4).prop_map(|solids| {
        let mut positions = Vec::new();
        let mut indices = Vec::new();
        for (number, corners) in solids {
            let base = positions.len() as u32;
            positions.extend(corners);
            indices.extend(SOLIDS[number].iter().map(|v| v + base));
        }
        (positions, indices)
    })
}

/// Octahedra in their usual place, stretched; convex, with some of them turned inside out.
fn octahedra() -> impl Strategy<Value = (Vec<[i8; 3]>, Vec<u32>)> {
    let one = (prop::array::uniform6(1_i8..=3), any::<bool>());
    prop::collection::vec(one, 1..3).prop_map(|solids| {
        let mut positions = Vec::new();
        let mut indices = Vec::new();
        for ([a, b, c, d, e, f], inside_out) in solids {
            let base = positions.len() as u32;
            positions.extend([
                [a, 0, 0],
                [-b, 0, 0],
                [0, c, 0],
                [0, -d, 0],
                [0, 0, e],
                [0, 0, -f],
            ]);
            for face in SOLIDS[1].chunks(3) {
                let [x, y, z] = [face[0], face[1], face[2]].map(|v| v + base);
                indices.extend(if inside_out { [x, z, y] } else { [x, y, z] });
            }
        }
        (positions, indices)
    })
}

/// A mesh with a light.
pub fn case() -> impl Strategy<Value = Case> {
    (
        prop_oneof![soup(), solids(), octahedra()],
        light(),
        any::<bool>(),
    )
        .prop_map(|((positions, indices), light, mirrored)| Case {
            positions,
            indices,
            light,
            mirrored,
        })
}

/// Points around the mesh, nearly always in general position.
pub fn points() -> impl Strategy<Value = Vec<Point>> {
    let reach = 4 * SCALE as i64;
    let point = prop::array::uniform3(-reach..=reach);
    prop::collection::vec(point, 8)
        .prop_map(|points| points.into_iter().map(|p| with_w(p, 1)).collect())
}

/// Directions, as points at infinity.
pub fn directions() -> impl Strategy<Value = Vec<Point>> {
    let direction = prop::array::uniform3(-9973_i64..=9973);
    prop::collection::vec(direction, 3)
        .prop_map(|directions| directions.into_iter().map(|d| with_w(d, 0)).collect())
}

fn with_w([x, y, z]: [i64; 3], w: i128) -> Point {
    [x.into(), y.into(), z.into(), w]
}

/// Many triangles over few positions, with a light.
pub fn crowd() -> impl Strategy<Value = Case> {
    let indices = prop::collection::vec(0_u32..14, 60..180);
    (
        prop::collection::vec(position(), 14),
        indices,
        light(),
        any::<bool>(),
    )
        .prop_map(|(positions, mut indices, light, mirrored)| {
            indices.truncate(indices.len() / 3 * 3);
            Case {
                positions,
                indices,
                light,
                mirrored,
            }
        })
}
