//! Welding, edges and components on small meshes with known answers.

use viewer::volume::CasterMesh;

const NAN: f32 = f32::NAN;

#[test]
fn what_cannot_cast_is_left_out() {
    let positions = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-0.0, 0.0, -0.0],
        [NAN, 0.0, 0.0],
        [0.0, f32::INFINITY, 0.0],
        [2.0, 0.0, 0.0],
    ];
    let rows: [(&[u32], &[[u32; 4]]); 8] = [
        (&[], &[]),
        (&[0, 1], &[]),
        (&[0, 1, 2, 0], &[[0, 1, 2, 0]]),
        (&[2, 3, 1], &[[2, 0, 1, 0]]),
        (&[0, 3, 1], &[]),
        (&[0, 1, 4, 5, 0, 1], &[]),
        (&[0, 1, 99, 1, 2, 3], &[[1, 2, 0, 0]]),
        // Collinear but with three corners.
        (&[0, 1, 6], &[[0, 1, 5, 0]]),
    ];
    for (indices, expected) in rows {
        let mesh = CasterMesh::new(&positions, indices);
        assert_eq!(mesh.triangles, expected, "{indices:?}");
    }
}

#[test]
fn edges_have_any_valence() {
    // Three triangles on the edge 0-1, one of them running the other way.
    let positions = [
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, -1.0, 0.0],
    ];
    let mesh = CasterMesh::new(&positions, &[0, 1, 2, 3, 1, 0, 4, 0, 1]);
    assert_eq!(mesh.edges[0], [0, 1, 0, 3]);
    assert_eq!(mesh.refs[..3], [0, 0b11, 0b100]);
    assert_eq!(mesh.edges.len(), 7);
    assert_eq!(mesh.components.len(), 1);
    assert!(!mesh.components[0].closed);
    assert!(mesh.edges.is_sorted());
}

#[test]
fn components_know_their_winding_numbers() {
    let tetrahedron = [
        [0.0, 0.0, 0.0],
        [3.0, 0.0, 0.0],
        [0.0, 3.0, 0.0],
        [0.0, 0.0, 3.0],
    ];
    let faces = [0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3];
    let inside_out: Vec<u32> = faces.iter().rev().copied().collect();
    let twice = [faces, faces].concat();
    let one_turned = [0, 1, 2, 0, 1, 3, 1, 2, 3, 2, 0, 3];
    type Row<'a> = (&'a [u32], bool, f64, Option<[i32; 2]>);
    let rows: [Row<'_>; 5] = [
        (&faces, true, 4.5, Some([0, 1])),
        (&inside_out, true, -4.5, Some([-1, 0])),
        (&twice, true, 9.0, Some([0, 2])),
        (&one_turned, false, 0.0, None),
        (&faces[..9], false, 0.0, None),
    ];
    for (indices, closed, volume, range) in rows {
        let mesh = CasterMesh::new(&tetrahedron, indices);
        assert_eq!(mesh.components.len(), 1, "{indices:?}");
        let component = &mesh.components[0];
        assert_eq!(component.closed, closed, "{indices:?}");
        assert!(
            (component.signed_volume - volume).abs() < 1e-9,
            "{indices:?}"
        );
        assert_eq!(component.winding_range, range, "{indices:?}");
    }
}

#[test]
fn components_touching_in_a_vertex_are_apart() {
    let positions = [
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
    ];
    let mesh = CasterMesh::new(&positions, &[0, 1, 2, 0, 3, 4, 2, 1, 4]);
    let numbers: Vec<u32> = mesh.triangles.iter().map(|t| t[3]).collect();
    assert_eq!(numbers, [0, 1, 0]);
    assert_eq!(mesh.components[1].bounds.max.to_array(), [0.0; 3]);
}

#[test]
fn parts_keep_their_order() {
    let positions = [
        [9.0; 3],
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
    ];
    let mesh = CasterMesh::new(&positions, &[1, 2, 3, 2, 1, 4, 3, 4, 2]);
    let part = mesh.part(1..99);
    assert_eq!(part.positions, mesh.positions[1..]);
    assert_eq!(part.triangles, [[1, 0, 3, 0], [2, 3, 1, 0]]);
    let part = mesh.part(2..3);
    assert_eq!(part.positions, mesh.positions[2..]);
    assert_eq!(part.triangles, [[1, 2, 0, 0]]);
    assert_eq!(mesh.part(9..99).triangles.len(), 0);
    let reversed = std::ops::Range { start: 2, end: 1 };
    assert_eq!(mesh.part(reversed).triangles.len(), 0);
}
