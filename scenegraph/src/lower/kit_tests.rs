//! Node kits against the same nodes in groups.

use std::path::Path;

use glam::DVec3;

use crate::scene::Scene;
use crate::{FileLoader, ResolveOptions, load, resolve};

/// The place, the colour and the number of triangles of an instance.
type Drawn = (DVec3, [f64; 3], usize);

/// What is drawn, and all codes.
fn drawn(body: &str) -> (Vec<Drawn>, Vec<&'static str>, Scene) {
    let text = format!("#Inventor V2.1 ascii\nSeparator {{ {body} }}");
    let graph = load(text.as_bytes(), "t.iv", Path::new(""), &FileLoader::new([]));
    let resolved = resolve(&graph, &ResolveOptions::default());
    let scene = resolved.scene;
    let shown = scene.instances.iter().map(|instance| {
        (
            instance.placement.world_from_local.translation,
            scene.materials[instance.material.index()].diffuse_srgb,
            scene.meshes[instance.mesh.index()].primitive_count(),
        )
    });
    let shown = shown.collect();
    let all = graph.diagnostics.iter().chain(&resolved.diagnostics);
    (shown, all.map(|d| d.code).collect(), scene)
}

#[test]
fn kits_draw_what_their_parts_do() {
    let red = "Material { diffuseColor 1 0 0 }";
    let moved = "Translation { translation 1 2 3 }";
    let transform = "Transform { translation 1 2 3 }";
    let rows: Vec<(&str, String, String, &[&str])> = vec![
        ("default shape", "ShapeKit {}".into(), "Cube {}".into(), &[]),
        (
            "no shape",
            "ShapeKit { shape NULL }".into(),
            String::new(),
            &[],
        ),
        (
            "parts in catalog order",
            format!(
                "ShapeKit {{ shape Cone {{}} transform {transform} appearance AppearanceKit {{ material {red} }} }}"
            ),
            format!("{red} {moved} Cone {{}}"),
            &[],
        ),
        (
            "compound name",
            format!("ShapeKit {{ appearance.material {red} shape Cone {{}} }}"),
            format!("{red} Cone {{}}"),
            &[],
        ),
        (
            "compound name of a part that is there",
            format!(
                "ShapeKit {{ appearance AppearanceKit {{ complexity Complexity {{ value 0 }} }} appearance.material {red} shape Sphere {{}} }}"
            ),
            format!("{red} Complexity {{ value 0 }} Sphere {{}}"),
            &[],
        ),
        (
            "a compound name of nothing",
            format!("ShapeKit {{ paint.material {red} }} ShapeKit {{ transform.material {red} }}"),
            "Cube {} Cube {}".into(),
            &["unknown-part", "unknown-part"],
        ),
        (
            "a shape kit keeps its state",
            format!("ShapeKit {{ appearance.material {red} }} Cube {{}}"),
            format!("Separator {{ {red} Cube {{}} }} Cube {{}}"),
            &[],
        ),
        (
            "an appearance kit does not",
            format!("AppearanceKit {{ material {red} }} Cube {{}}"),
            format!("{red} Cube {{}}"),
            &[],
        ),
        (
            "lists",
            format!(
                "SeparatorKit {{ transform {transform} childList NodeKitListPart {{ containerTypeName \"Separator\" childTypeNames \"SeparatorKit\" containerNode Separator {{ ShapeKit {{}} ShapeKit {{ shape Cone {{}} }} }} }} }}"
            ),
            format!("{moved} Cube {{}} Cone {{}}"),
            &[],
        ),
        (
            "wrapper",
            format!(
                "WrapperKit {{ contents Separator {{ Cone {{}} }} localTransform {transform} }}"
            ),
            format!("{moved} Cone {{}}"),
            &[],
        ),
        (
            "scene",
            "SceneKit { childList NodeKitListPart { containerNode Separator { ShapeKit {} } } }"
                .into(),
            "Cube {}".into(),
            &[],
        ),
        (
            "used twice",
            format!("DEF k ShapeKit {{ shape Cone {{}} }} {moved} USE k"),
            format!("Cone {{}} {moved} Cone {{}}"),
            &[],
        ),
        (
            "manipulators are what they move",
            "TransformerManip { translation 1 2 3 } Cube {}".into(),
            format!("{moved} Cube {{}}"),
            &[],
        ),
        (
            "draggers are left out",
            "TrackballDragger { rotation 0 0 1 1 } Cube {}".into(),
            "Cube {}".into(),
            &["dragger"],
        ),
    ];
    for (name, kit, plain, codes) in rows {
        let (shown, said, _) = drawn(&kit);
        assert_eq!(shown, drawn(&plain).0, "{name}");
        assert_eq!(said, codes, "{name}");
    }
}

#[test]
fn kits_of_lights_and_cameras_reach_what_follows() {
    let (shown, codes, scene) = drawn(
        "CameraKit { transform Transform { translation 0 0 9 } camera OrthographicCamera {} } \
         LightKit { transform Transform { translation 5 0 0 } light PointLight {} } Cube {}",
    );
    assert_eq!(codes, [] as [&str; 0]);
    assert_eq!(
        shown[0].0,
        DVec3::ZERO,
        "the transforms end with their kits"
    );
    assert_eq!(
        scene.lights[0].placement.world_from_local.translation.x,
        5.0
    );
    assert_eq!(
        scene.cameras[0].placement.world_from_local.translation.z,
        9.0
    );
    let set = scene.instances[0].light_set;
    assert_eq!(scene.light_sets[set.index()].len(), 1);
}
