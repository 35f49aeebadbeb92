//! `DrawStyle` LINES and POINTS: polygons as their edges or corners.

use rustc_hash::FxHashSet;

use crate::resolve::Style;
use crate::scene::{Mesh, Topology};

use super::corners::{Corners, Take};

/// The corners as the style draws them.
pub fn styled(faces: Corners, style: Style) -> (Corners, Topology) {
    let pick = match style {
        Style::Filled | Style::Invisible => return (faces, Topology::Triangles),
        Style::Lines => edges(&faces),
        Style::Points => distinct(&faces),
    };
    let (step, topology) = match style {
        Style::Lines => (2, Topology::Lines),
        _ => (1, Topology::Points),
    };
    let take = |from: &Take| match from {
        Take::Corners(list) => Take::Corners(pick.iter().map(|&i| list[i]).collect()),
        other => other.clone(),
    };
    let corners = Corners {
        coordinates: pick.iter().map(|&i| faces.coordinates[i]).collect(),
        ends: Vec::new(),
        step,
        normals: Take::Nothing,
        colors: take(&faces.colors),
        texcoords: Take::Nothing,
        by_position: faces.by_position,
        always_smooth: false,
    };
    (corners, topology)
}

/// Corner pairs of all edges, each drawn once.
fn edges(faces: &Corners) -> Vec<usize> {
    let mut seen = FxHashSet::default();
    let mut pick = Vec::new();
    for range in faces.faces() {
        for i in range.clone() {
            let j = if i + 1 == range.end {
                range.start
            } else {
                i + 1
            };
            let (a, b) = (faces.coordinates[i], faces.coordinates[j]);
            if a != b && seen.insert((a.min(b), a.max(b))) {
                pick.extend([i, j]);
            }
        }
    }
    pick
}

/// One corner for each coordinate.
fn distinct(faces: &Corners) -> Vec<usize> {
    let mut seen = FxHashSet::default();
    let all = 0..faces.coordinates.len();
    all.filter(|&i| seen.insert(faces.coordinates[i])).collect()
}

/// A primitive's mesh as the style draws it.
pub fn styled_primitive(mut mesh: Mesh, style: Style) -> Option<Mesh> {
    match style {
        Style::Filled | Style::Invisible => return Some(mesh),
        Style::Lines => {
            let mut seen = FxHashSet::default();
            let mut pairs = Vec::new();
            let key = |v: u32| mesh.positions[v as usize].map(f32::to_bits);
            for t in mesh.indices.as_chunks::<3>().0 {
                for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                    let (ka, kb) = (key(a), key(b));
                    if ka != kb && seen.insert((ka.min(kb), ka.max(kb))) {
                        pairs.extend([a, b]);
                    }
                }
            }
            mesh.indices = pairs;
            mesh.topology = Topology::Lines;
        }
        Style::Points => {
            mesh.indices = (0..mesh.positions.len() as u32).collect();
            mesh.topology = Topology::Points;
        }
    }
    mesh.normals.clear();
    mesh.texcoords.clear();
    (!mesh.indices.is_empty()).then_some(mesh)
}
