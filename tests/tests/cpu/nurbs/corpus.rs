//! NURBS surfaces of the corpus: their area against that of a fine grid by an evaluator that sums
//! the definition's basis functions.

use std::fs;

use glam::{DAffine3, DVec3, DVec4};
use scenegraph::graph::{Graph, Node};
use scenegraph::registry::Class;
use scenegraph::scene::Mesh;
use scenegraph::{FileLoader, ResolveOptions, load, resolve};
use tests::corpus::{entries, folder};
use tests::measure::totals;

/// Cells of the fine grid along each parameter.
const CELLS: usize = 96;

/// Values of all basis functions at `t`, by their recursive definition.
fn basis(knots: &[f64], degree: usize, t: f64) -> Vec<f64> {
    let last = knots
        .iter()
        .rposition(|&k| k < knots[knots.len() - 1])
        .expect("a span");
    let holds = |i: usize| {
        let at_end = t >= knots[last + 1] && i == last;
        at_end || (knots[i] <= t && t < knots[i + 1])
    };
    let mut values: Vec<f64> = (0..knots.len() - 1)
        .map(|i| f64::from(u8::from(holds(i))))
        .collect();
    for d in 1..=degree {
        let part = |x: f64, width: f64| if width > 0.0 { x / width } else { 0.0 };
        values = (0..knots.len() - 1 - d)
            .map(|i| {
                part(t - knots[i], knots[i + d] - knots[i]) * values[i]
                    + part(knots[i + d + 1] - t, knots[i + d + 1] - knots[i + 1]) * values[i + 1]
            })
            .collect();
    }
    values
}

/// Rows of basis functions at a grid of parameters over the domain.
fn rows(knots: &[f64], count: usize) -> Vec<Vec<f64>> {
    let degree = knots.len() - count - 1;
    let (low, high) = (knots[degree], knots[count]);
    (0..=CELLS)
        .map(|k| basis(knots, degree, low + (high - low) * k as f64 / CELLS as f64))
        .collect()
}

/// The area of a surface in its own frame.
fn area(surface: &Node, coordinates: &Node) -> f64 {
    let count = |field: &str| surface.int(field) as usize;
    let (nu, nv) = (count("numUControlPoints"), count("numVControlPoints"));
    let u = rows(surface.numbers("uKnotVector"), nu);
    let v = rows(surface.numbers("vKnotVector"), nv);
    let size = if coordinates.class() == Some(Class::Coordinate4) {
        4
    } else {
        3
    };
    let points: Vec<DVec4> = coordinates
        .numbers("point")
        .chunks(size)
        .map(|p| DVec4::new(p[0], p[1], p[2], p.get(3).copied().unwrap_or(1.0)))
        .collect();
    let place = |bu: &[f64], bv: &[f64]| {
        let mut h = DVec4::ZERO;
        for (j, b) in bv.iter().enumerate() {
            for (i, a) in bu.iter().enumerate() {
                h += points[j * nu + i] * (a * b);
            }
        }
        h.truncate() / h.w
    };
    let grid: Vec<Vec<DVec3>> = v
        .iter()
        .map(|bv| u.iter().map(|bu| place(bu, bv)).collect())
        .collect();
    let mut sum = 0.0;
    for j in 0..CELLS {
        for i in 0..CELLS {
            let [a, b, c, d] = [
                grid[j][i],
                grid[j][i + 1],
                grid[j + 1][i + 1],
                grid[j + 1][i],
            ];
            sum += (b - a).cross(c - a).length() / 2.0 + (c - a).cross(d - a).length() / 2.0;
        }
    }
    sum
}

/// Each surface with the coordinates before it in the text, which in these files are its own.
fn surfaces(graph: &Graph) -> Vec<(&Node, &Node)> {
    let mut coordinates = None;
    let mut found = Vec::new();
    for node in graph.nodes() {
        match node.class() {
            Some(Class::Coordinate3 | Class::Coordinate4) => coordinates = Some(node),
            Some(Class::NurbsSurface) => found.extend(coordinates.map(|c| (node, c))),
            _ => {}
        }
    }
    found
}

/// The area of a mesh in its own frame, or placed by an instance.
fn area_of(mesh: &Mesh, placed: &DAffine3) -> f64 {
    let triangles = mesh.indices.as_chunks::<3>().0;
    let area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| placed.transform_point3(mesh.p_in_local(i)));
        (b - a).cross(c - a).length() / 2.0
    };
    triangles.iter().map(area).sum()
}

#[test]
fn areas_in_the_corpus_are_those_of_a_fine_grid() {
    let Some(folder) = folder() else { return };
    let entries = entries(&folder).expect("the corpus's list");
    let mut compared = 0;
    for entry in entries.iter().filter(|e| !e.nurbs.is_empty()) {
        let path = folder.join("files").join(&entry.path);
        let beside = path.parent().expect("a folder");
        let bytes = fs::read(&path).expect("a file of the corpus");
        let graph = load(&bytes, &entry.path, beside, &FileLoader::new([beside]));
        let scene = resolve(&graph, &ResolveOptions::default()).scene;
        let surfaces = surfaces(&graph);
        for (surface, coordinates) in &surfaces {
            let mesh = scene.meshes.iter().find(|mesh| mesh.pos == surface.pos);
            let ours = area_of(mesh.expect("a mesh"), &DAffine3::IDENTITY);
            let fine = area(surface, coordinates);
            let place = format!("{}: {:?}", entry.path, surface.pos);
            assert!((ours / fine - 1.0).abs() < 0.01, "{place}: {ours} {fine}");
            compared += 1;
        }
        // Coin's own, coarser, triangles.
        let drawn: f64 = scene
            .instances
            .iter()
            .map(|i| (&scene.meshes[i.mesh.index()], &i.placement.world_from_local))
            .filter(|(mesh, _)| surfaces.iter().any(|(s, _)| s.pos == mesh.pos))
            .map(|(mesh, placed)| area_of(mesh, placed))
            .sum();
        println!(
            "{} {} {drawn} {}",
            entry.path,
            totals(&scene).triangles,
            entry.nurbs.area
        );
        assert!(
            (drawn / entry.nurbs.area - 1.0).abs() < 0.02,
            "{}: {drawn}",
            entry.path
        );
    }
    assert_eq!(compared, 42);
}
