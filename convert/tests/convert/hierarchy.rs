//! Groups and items as nodes.

use std::f64::consts::FRAC_PI_3;
use std::io;

use convert::{Options, write_glb};
use glam::{DAffine3, DVec3};
use scenegraph::scene::Mesh;
use serde_json::json;

use crate::read::{assert_near, convert, convert_with};
use crate::scenes::{Build, Images, material, scale, shift, triangle, turn};

/// The hierarchy as text: names (`-` for none), `*` on nodes with a mesh, children in brackets.
fn outline(build: &Build) -> String {
    let converted = convert(&build.scene);
    let nodes = converted.nodes();
    // Children come after their parents.
    let mut texts = vec![String::new(); nodes.len()];
    let join = |texts: &[String], list: &serde_json::Value| {
        let children = crate::read::indices(list);
        children
            .iter()
            .map(|&i| texts[i].clone())
            .collect::<Vec<_>>()
            .join(" ")
    };
    for (i, node) in nodes.iter().enumerate().rev() {
        let name = node["name"].as_str().unwrap_or("-");
        let mesh = if node["mesh"].is_null() { "" } else { "*" };
        let children = join(&texts, &node["children"]);
        texts[i] = format!("{name}{mesh}");
        if !children.is_empty() {
            texts[i] += &format!("[{children}]");
        }
    }
    join(&texts, &converted.json["scenes"][0]["nodes"])
}

#[test]
fn groups_and_items_become_as_few_nodes_as_keep_all_names() {
    type Make = fn(&mut Build);
    const ID: DAffine3 = DAffine3::IDENTITY;
    let rows: [(&str, Make); 10] = [
        ("", |_| {}),
        ("a*", |b| b.shape(None, Some("a"), ID)),
        ("-*", |b| {
            let g = b.group(None, None, ID);
            b.shape(Some(g), None, ID);
        }),
        ("g*", |b| {
            let g = b.group(None, Some("g"), ID);
            b.shape(Some(g), None, ID);
        }),
        ("g[a*]", |b| {
            let g = b.group(None, Some("g"), ID);
            b.shape(Some(g), Some("a"), ID);
        }),
        ("a*", |b| {
            let outer = b.group(None, None, ID);
            let inner = b.group(Some(outer), None, ID);
            b.shape(Some(inner), Some("a"), ID);
        }),
        ("g*", |b| {
            let outer = b.group(None, None, ID);
            let named = b.group(Some(outer), Some("g"), ID);
            let inner = b.group(Some(named), None, ID);
            b.shape(Some(inner), None, ID);
        }),
        ("-[a* -*]", |b| {
            let g = b.group(None, None, ID);
            b.shape(Some(g), Some("a"), ID);
            b.shape(Some(g), None, ID);
        }),
        ("g[h[-* -*]] g*", |b| {
            let g = b.group(None, Some("g"), ID);
            let h = b.group(Some(g), Some("h"), ID);
            b.shape(Some(h), None, ID);
            b.shape(Some(h), None, ID);
            let second = b.group(None, Some("g"), ID);
            b.shape(Some(second), None, ID);
        }),
        // Nothing in it: not what the scene promises, but no name is lost.
        ("g", |b| {
            b.group(None, Some("g"), ID);
            b.group(None, None, ID);
        }),
    ];
    for (want, make) in rows {
        let mut build = Build::new();
        make(&mut build);
        assert_eq!(outline(&build), want);
    }
}

#[test]
fn every_instance_stands_where_the_scene_puts_it() {
    let far = shift(2_600_123.123_456_789, 1_200_456.987_654_321, 432.1);
    let tilt = turn(DVec3::new(1.0, 2.0, 3.0), 0.7);
    let chains: [(&[DAffine3], usize); 9] = [
        (&[DAffine3::IDENTITY], 1),
        (&[far], 1),
        (&[far, tilt, scale(2.0, 3.0, 4.0)], 1),
        (&[tilt, scale(-1.0, 1.0, 1.0), turn(DVec3::Y, FRAC_PI_3)], 1),
        // A mirror that cannot be told from turned axes, and all axes mirrored.
        (
            &[
                scale(1.0, -1.0, -1.0),
                shift(1.0, 2.0, 3.0),
                scale(-2.0, -2.0, -2.0),
            ],
            1,
        ),
        // Shears only as a product: the two nodes stay apart.
        (&[scale(1.0, 2.0, 3.0), tilt], 2),
        (&[scale(1.0, 2.0, 3.0), tilt, shift(1.0, 1.0, 1.0)], 2),
        // Shears by itself: an outer and an inner node.
        (&[far, scale(1.0, 2.0, 3.0) * tilt], 2),
        (&[scale(0.0, 1.0, 1.0)], 1),
    ];
    for (chain, nodes) in chains {
        let mut build = Build::new();
        let mut group = None;
        for &local in &chain[..chain.len() - 1] {
            group = Some(build.group(group, None, local));
        }
        let mesh = Mesh {
            origin: DVec3::new(1e6 + 0.1, -7.25, 0.3),
            ..triangle()
        };
        let origin = DAffine3::from_translation(mesh.origin);
        build.instance(
            group,
            Some("part"),
            chain[chain.len() - 1],
            mesh,
            material(),
        );
        let converted = convert(&build.scene);
        assert_eq!(converted.nodes().len(), nodes, "{chain:?}");
        let placed = converted.placed_with("/mesh");
        let want = build.scene.instances[0].placement.world_from_local * origin;
        assert_near(&placed[0].world_from_local, &want);
    }
}

#[test]
fn numbers_of_a_plain_node_are_the_scenes_own() {
    let mut build = Build::new();
    build.shape(
        None,
        None,
        shift(2_600_123.123_456_789, 0.1, -0.0) * scale(1.0, 0.1, -7.5),
    );
    let node = json!({
        "mesh": 0,
        "translation": [2_600_123.123_456_789, 0.1, 0],
        "scale": [1, 0.1, -7.5],
    });
    assert_eq!(convert(&build.scene).json["nodes"], json!([node]));
}

#[test]
fn transforms_that_shear_only_together_stay_as_they_are() {
    let mut build = Build::new();
    let g = build.group(None, None, scale(1.0, 2.0, 3.0));
    build.shape(Some(g), None, turn(DVec3::ONE, 0.4));
    let nodes = convert(&build.scene).json["nodes"].clone();
    assert_eq!(nodes[0], json!({"scale": [1, 2, 3], "children": [1]}));
    assert_eq!(nodes[1]["scale"], json!(null));
}

#[test]
fn a_sheared_group_keeps_its_name_outside_and_its_children_inside() {
    let mut build = Build::new();
    let shear = scale(1.0, 2.0, 3.0) * turn(DVec3::ONE, 0.4);
    let g = build.group(None, Some("g"), shear);
    build.shape(Some(g), Some("a"), DAffine3::IDENTITY);
    build.shape(Some(g), Some("b"), DAffine3::IDENTITY);
    assert_eq!(outline(&build), "g[-[a* b*]]");
    let placed = convert(&build.scene).placed();
    for child in &placed[2..] {
        assert_near(&child.world_from_local, &shear);
    }
}

#[test]
fn a_group_with_a_mesh_origin_inside_a_scale_is_exact() {
    let mut build = Build::new();
    let g = build.group(None, Some("g"), scale(1e-3, 1e-3, 1e-3));
    let mesh = Mesh {
        origin: DVec3::new(2.6e9, 1.2e9, 5.0),
        ..triangle()
    };
    build.instance(Some(g), None, DAffine3::IDENTITY, mesh, material());
    let converted = convert(&build.scene);
    assert_eq!(outline(&build), "g*");
    let [placed] = &converted.placed()[..] else {
        panic!()
    };
    assert_near(
        &placed.world_from_local,
        &(scale(1e-3, 1e-3, 1e-3) * shift(2.6e9, 1.2e9, 5.0)),
    );
}

#[test]
fn class_and_notes_of_groups_are_in_the_extras() {
    let mut build = Build::new();
    let door = build.group(None, Some("Door"), DAffine3::IDENTITY);
    let leaf = build.group(Some(door), None, DAffine3::IDENTITY);
    build.shape(Some(leaf), None, DAffine3::IDENTITY);
    build.scene.nodes[0].class = "Switch".into();
    build.scene.nodes[1].notes = vec!["oak".into(), "\"fire\"\n".into()];
    let extras = json!({"iv": {"type": "Switch", "notes": ["oak", "\"fire\"\n"]}});
    let merged = json!([{"name": "Door", "mesh": 0, "extras": extras}]);
    assert_eq!(convert(&build.scene).json["nodes"], merged);

    // What two say in the same words stays apart.
    build.scene.nodes[1].class = "LOD".into();
    assert_eq!(convert(&build.scene).nodes().len(), 2);

    let options = Options {
        extras: false,
        ..Default::default()
    };
    let plain = convert_with(&build.scene, &options, &Images::default());
    assert!(!plain.json.to_string().contains("extras"));
}

#[test]
fn depth_is_no_danger() {
    let mut build = Build::new();
    let mut group = None;
    for _ in 0..100_000 {
        group = Some(build.group(group, Some("g"), DAffine3::IDENTITY));
    }
    build.shape(group, None, DAffine3::IDENTITY);
    // Not kept for the validator, whose own stack is too small for it.
    let (options, images) = (Options::default(), Images::default());
    let report = write_glb(&build.scene, &options, &images, &mut io::sink()).unwrap();
    assert_eq!(report.counts.nodes, 100_000);
}

#[test]
fn any_name_is_written() {
    let name = "Tür \"5\"\\\u{1}\u{7f}\n😀";
    let mut build = Build::new();
    build.shape(None, Some(name), DAffine3::IDENTITY);
    assert_eq!(convert(&build.scene).json["nodes"][0]["name"], name);
}
