//! Where pictures may differ: edges of objects, of shadows, and of a part before another.

use glam::DVec3;
use tests::reference::RefImage;

use super::{WALL, parallel, picture};

const SIZE: [usize; 2] = [60, 40];

fn image(body: &str) -> RefImage {
    picture(body, &parallel(2.5), SIZE.map(|n| n as u32))
}

/// Pixels around which, in the square of this radius, not all have the same key.
fn mixed<T: PartialEq>(keys: &[T], radius: usize) -> Vec<bool> {
    let [width, height] = SIZE;
    let around = |at: usize, count: usize| at.saturating_sub(radius)..(at + radius + 1).min(count);
    (0..keys.len())
        .map(|i| {
            let mut columns = around(i % width, width);
            let rows = around(i / width, height);
            columns.any(|x| rows.clone().any(|y| keys[y * width + x] != keys[i]))
        })
        .collect()
}

#[test]
fn edges_of_objects_and_shadows() {
    // All faces towards the viewer: no edges but those of objects, shadows and glass.
    let body = format!(
        "PointLight {{ location 1 1 3 }} DirectionalLight {{ direction 0.5 0.2 -1 }}
        ShapeHints {{ vertexOrdering COUNTERCLOCKWISE }} {WALL}
        Separator {{ Translation {{ translation 0.3 0.1 1 }} Scale {{ scaleFactor 0.2 0.3 1 }} {WALL} }}
        Separator {{ Material {{ transparency 0.5 }} Translation {{ translation -1 -0.7 0.5 }}
            Scale {{ scaleFactor 0.2 0.2 1 }} {WALL} }}"
    );
    let image = image(&body);
    for lights in [0, 1, 2, 3, u128::MAX] {
        let keys: Vec<_> = (0..image.object.len())
            .map(|i| (image.object[i], image.layers[i], image.lit[i] & lights))
            .collect();
        for radius in [0, 1, 2, 5] {
            let got = image.near_edge_of(radius as u32, lights);
            assert_eq!(
                got,
                mixed(&keys, radius),
                "radius {radius}, lights {lights:x}"
            );
            let count = got.iter().filter(|&&is| is).count();
            assert_eq!(count > 0, radius > 0);
        }
    }
    assert_eq!(image.near_edge(2), image.near_edge_of(2, u128::MAX));
}

#[test]
fn edges_within_an_object() {
    let ordered = "ShapeHints { vertexOrdering COUNTERCLOCKWISE }\n";
    // Two triangles each; the second starts at x = 0 on the same line, in front of it, or bent.
    let pair = |z: f64, end: f64| {
        format!(
            "{ordered} Coordinate3 {{ point [ -9 -9 0, 0 -9 0, 0 9 0, -9 9 0, 0 -9 {z}, 9 -9 {end}, 9 9 {end}, 0 9 {z} ] }}
            IndexedFaceSet {{ coordIndex [ 0, 1, 2, 3, -1, 4, 5, 6, 7, -1 ] }}"
        )
    };
    // The two columns on either side of x = 0.
    let middle: Vec<bool> = (0..SIZE[0] * SIZE[1])
        .map(|i| [29, 30].contains(&(i % SIZE[0])))
        .collect();
    let none = vec![false; middle.len()];
    let rows = [
        ("flat", pair(0.0, 0.0), &none),
        ("bent a little", pair(0.0, 1.0), &none),
        ("bent", pair(0.0, 9.0), &middle),
        ("a step", pair(0.5, 0.5), &middle),
        ("a step to a slope", pair(3.0, 5.0), &middle),
    ];
    for (name, body, expected) in rows {
        let image = image(&body);
        assert_eq!(image.near_edge(1), *expected, "{name}");
        assert!(image.object.iter().all(|&object| object == Some(0)));
    }
}

#[test]
fn a_smooth_surface_has_no_edges_within() {
    let image = image("Complexity { value 1 } Sphere { radius 2 }");
    let objects: Vec<bool> = mixed(&image.object, 3);
    let within = (0..objects.len()).filter(|&i| !objects[i] && image.object[i].is_some());
    let edge = image.near_edge(1);
    let mut count = 0;
    for i in within {
        assert!(!edge[i], "{i}");
        count += 1;
    }
    assert!(count > 200, "{count}");
}

#[test]
fn facets_are_planes() {
    // z = 0.5 x - 0.25 y: a pixel to the right is nearer by 0.5 of its width, one down by 0.25.
    let body = "Coordinate3 { point [ -8 -8 -2, 8 -8 6, 8 8 2, -8 8 -6 ] }
        IndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1 ] }";
    let image = image(body);
    let pixel = 5.0 / SIZE[1] as f64;
    let normal = DVec3::new(-0.5, 0.25, 1.0).normalize();
    for (facet, depth) in image.facet.iter().zip(&image.depth) {
        let [right, down] = facet.next_depth;
        assert!((right - depth + 0.5 * pixel).abs() < 1e-12);
        assert!((down - depth + 0.25 * pixel).abs() < 1e-12);
        assert!((DVec3::from(facet.normal) - normal).length() < 1e-12);
    }
}
