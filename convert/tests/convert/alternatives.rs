//! Hidden nodes and levels of detail in files of others: passed over when they are shown, kept on the
//! way to Inventor text, and harmless whatever they say.

use std::path::Path;

use convert::{InventorOptions, gltf_to_inventor};
use scenegraph::{ResolveOptions, resolve};
use serde_json::{Value, json};

use crate::reading::{OneFile, five, glb, read};

/// What a node list makes of a file.
struct Row {
    name: &'static str,
    nodes: Value,
    /// Shapes that are shown.
    shown: usize,
    /// How often `Switch` and `LOD` stand in the text, and how many shapes it has in all.
    text: [usize; 3],
}

fn rows() -> Vec<Row> {
    let hidden = json!({"KHR_node_visibility": {"visible": false}});
    let levels = |ids: Value| json!({"MSFT_lod": {"ids": ids}});
    vec![
        Row {
            name: "a hidden group hides what is below, visible or not",
            nodes: json!([
                {"mesh": 0, "children": [1]},
                {"extensions": hidden, "children": [2]},
                {"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": true}}},
            ]),
            shown: 1,
            text: [1, 0, 2],
        },
        Row {
            name: "what is no boolean hides nothing",
            nodes: json!([
                {"children": [1, 2, 3]},
                {"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": 0}}},
                {"mesh": 0, "extensions": {"KHR_node_visibility": {}}},
                {"mesh": 0, "extensions": {"KHR_node_visibility": [7]}},
            ]),
            shown: 3,
            text: [0, 0, 3],
        },
        Row {
            name: "extensions that are null are none",
            nodes: json!([{"mesh": 0, "extensions": null}]),
            shown: 1,
            text: [0, 0, 1],
        },
        Row {
            name: "levels stand beside the finest",
            nodes: json!([{"mesh": 0, "extensions": levels(json!([1, 2]))}, {"mesh": 0}, {}]),
            shown: 1,
            text: [0, 1, 2],
        },
        Row {
            name: "a level that is the node itself, a child, twice there or nowhere is none",
            nodes: json!([
                {"mesh": 0, "children": [1], "extensions": levels(json!([0, 1, 2, 2, 99, -1, "2"]))},
                {"mesh": 0},
                {"mesh": 0},
            ]),
            shown: 2,
            text: [0, 1, 3],
        },
        Row {
            name: "a node is the level of one part only, and levels may have levels",
            nodes: json!([
                {"children": [1, 2]},
                {"mesh": 0, "extensions": levels(json!([3]))},
                {"mesh": 0, "extensions": levels(json!([3]))},
                {"mesh": 0, "extensions": levels(json!([4]))},
                {"mesh": 0},
            ]),
            shown: 2,
            text: [0, 2, 4],
        },
        Row {
            name: "of levels of a hidden part only the part is kept",
            nodes: json!([
                {"mesh": 0, "children": [1]},
                {"mesh": 0, "extensions": {
                    "KHR_node_visibility": {"visible": false}, "MSFT_lod": {"ids": [2]},
                }},
                {"mesh": 0},
            ]),
            shown: 1,
            text: [1, 0, 2],
        },
    ]
}

#[test]
fn files_of_others_show_what_they_show_and_keep_the_rest() {
    for row in rows() {
        let accessor =
            json!({"bufferView": 1, "componentType": 5121, "count": 5, "type": "SCALAR"});
        let primitive = json!({"attributes": {"POSITION": 0}, "indices": 1, "mode": 5});
        let (mut text, bin) = five(&[0, 1, 2, 3, 4], accessor, primitive);
        text["nodes"] = row.nodes;
        let model = read(&text, &bin).unwrap();
        assert_eq!(model.scene.instances.len(), row.shown, "{}", row.name);
        assert!(model.scene.shows_all(), "{}", row.name);
        let options = InventorOptions::default();
        let nothing = OneFile(Vec::new());
        let bytes = glb(&text, &bin);
        let files = gltf_to_inventor(
            &bytes,
            "m.glb",
            Path::new(""),
            &nothing,
            &|_| None,
            &options,
        );
        let inventor = String::from_utf8(files.unwrap().text).unwrap();
        let count = |word: &str| inventor.matches(word).count();
        let graph = scenegraph::load(inventor.as_bytes(), "m.iv", Path::new(""), &nothing);
        let keeps = ResolveOptions {
            alternatives: true,
            ..ResolveOptions::default()
        };
        let shapes = resolve(&graph, &keeps).scene.instances.len();
        let got = [count("Switch {"), count("LOD {"), shapes];
        assert_eq!(got, row.text, "{}:\n{inventor}", row.name);
    }
}

/// A camera in a hidden node can still be looked through (KHR_node_visibility); a light there is out.
#[test]
fn hidden_cameras_stay_and_hidden_lights_go() {
    let (mut text, bin) = five(
        &[0, 1, 2, 3, 4],
        json!({"bufferView": 1, "componentType": 5121, "count": 5, "type": "SCALAR"}),
        json!({"attributes": {"POSITION": 0}, "indices": 1, "mode": 5}),
    );
    text["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}]);
    text["extensions"] = json!({"KHR_lights_punctual": {"lights": [{"type": "point"}]}});
    text["nodes"] = json!([
        {"mesh": 0, "children": [1]},
        {"extensions": {"KHR_node_visibility": {"visible": false}}, "children": [2, 3]},
        {"camera": 0},
        {"extensions": {"KHR_lights_punctual": {"light": 0}}},
    ]);
    let model = read(&text, &bin).unwrap();
    let scene = &model.scene;
    assert_eq!((scene.cameras.len(), scene.lights.len()), (1, 0));
    let said = |word: &str| model.warnings.iter().any(|warning| warning.contains(word));
    assert!(said("lights of hidden nodes") && said("hidden nodes and coarser levels"));
}
