//! From where a model is seen.

use serde_json::Value;

use crate::place::{CUBE, Place};

/// A triangle in the plane of X and Y; nothing says that it was converted.
const GLTF: &str = r#"  { "asset": { "version": "2.0" },
    "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
    "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
    "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
        "min": [0, 0, 0], "max": [1, 1, 0] }],
    "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
    "buffers": [{ "byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" }] }"#;

const SAVED: &str = "CADWORK_IVV_FORMAT_v2\r\nType: PerspectiveCamera\r\nPosition: 1.000 -8.000 3.000\r\nLookAt: 0.000 0.000 0.000\r\nOpeningAngle: 30.000\r\nRotation: 0.000\r\n";

fn triple(value: &Value) -> [f64; 3] {
    serde_json::from_value(value.clone()).unwrap()
}

fn is_near(a: [f64; 3], b: [f64; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12)
}

#[test]
fn views_are_those_asked_for() {
    let place = Place::new()
        .file("cube.iv", CUBE)
        .file("other.model", GLTF)
        .file("saved.ivv", SAVED)
        .sample("lights/cameras.iv")
        .glb_of("cube.iv")
        .glb_of("cameras.iv");
    // The camera stands at 0 1.6 4, turned by 0.6 about +Y.
    let (sin, cos) = 0.6_f64.sin_cos();
    let room = Some([4.0 * sin, 1.6, 4.0 * cos]);
    let typed = "--camera 1,-8,3,0,0,0,30";
    let aside = "--camera -1,2,9,-1,2,-9,30";
    // Arguments, the eye if known, the axis that is up as far as it can be.
    let rows = [
        ("cube.iv", None, 2),
        ("cube.iv --up y", None, 1),
        ("cube.glb", None, 2),
        ("cube.glb --up y", None, 1),
        ("other.model", None, 1),
        ("other.model --up z", None, 2),
        ("cameras.iv", room, 1),
        ("cameras.iv --camera View_Room", room, 1),
        ("cameras.iv --camera 0 --up z", room, 1),
        ("cameras.glb", room, 1),
        ("cube.iv --view saved.ivv", Some([1.0, -8.0, 3.0]), 2),
        ("cube.iv --view saved.ivv --up y", Some([1.0, -8.0, 3.0]), 2),
        ("cameras.iv --view saved.ivv", Some([1.0, -8.0, 3.0]), 2),
        (&format!("cube.iv {typed}"), Some([1.0, -8.0, 3.0]), 2),
        (
            &format!("cube.iv {typed} --up y"),
            Some([1.0, -8.0, 3.0]),
            1,
        ),
        (&format!("other.model {aside}"), Some([-1.0, 2.0, 9.0]), 1),
        (&format!("cameras.iv {aside}"), Some([-1.0, 2.0, 9.0]), 1),
    ];
    for (args, eye, axis) in rows {
        let view = &place.stats(args)["view"];
        if let Some(eye) = eye {
            assert!(is_near(triple(&view["eye"]), eye), "{args}: {view}");
        }
        // Nothing leans to the side: across the view, the axis is in the middle of the picture.
        let (forward, up) = (triple(&view["forward"]), triple(&view["up"]));
        let expected: [f64; 3] = std::array::from_fn(|i| {
            let along = f64::from(u8::from(i == axis)) - forward[i] * forward[axis];
            along / (1.0 - forward[axis] * forward[axis]).sqrt()
        });
        assert!(is_near(up, expected), "{args}: {view}");
    }
    // The two ways to say the same.
    let saved = place.draw("cube.iv --view saved.ivv");
    assert!(saved == place.draw(&format!("cube.iv {typed}")));
    assert!(saved != place.draw("cube.iv"));
}
