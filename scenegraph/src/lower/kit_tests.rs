//! Node kits against the same nodes in groups.

use std::path::Path;

use glam::DVec3;

use crate::scene::Scene;
use crate::{FileLoader, ResolveOptions, load, resolve};

/// The place, the colour and the number of triangles of an instance.
type Drawn = (DVec3, [f64; 3], usize);

/// What is drawn, and all codes.
fn drawn(body: &str) -> (Vec<Drawn>, Vec<&'static str>, Scene) {
    drawn_text(&format!("#Inventor V2.1 ascii\nSeparator {{ {body} }}"))
}

/// As `drawn`, of a whole text.
fn drawn_text(text: &str) -> (Vec<Drawn>, Vec<&'static str>, Scene) {
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
fn a_part_that_holds_its_kit_is_refused() {
    let rows: &[(&str, &str, &str)] = &[
        (
            "by way of a group",
            "DEF A AppearanceKit { } \
             ShapeKit { appearance USE A appearance.material DEF B Group { USE A } }",
            "Cube {}",
        ),
        (
            "at once",
            "DEF A AppearanceKit { } ShapeKit { appearance USE A appearance.material USE A }",
            "Cube {}",
        ),
        (
            "by way of a part that was put there before",
            "DEF A AppearanceKit { } DEF B AppearanceKit { } \
             ShapeKit { appearance USE A appearance.material USE B } \
             ShapeKit { appearance USE B appearance.material USE A }",
            "Cube {} Cube {}",
        ),
    ];
    for (name, kit, plain) in rows {
        let (shown, said, _) = drawn(kit);
        assert_eq!(shown, drawn(plain).0, "{name}");
        assert_eq!(said, ["cycle"], "{name}");
    }
    // The same part twice is no circle.
    let (_, said, _) = drawn(
        "DEF M Material {} ShapeKit { appearance.material USE M } \
         ShapeKit { appearance.material USE M }",
    );
    assert_eq!(said, [] as [&str; 0]);
}

#[test]
fn prototypes_copy_kits_and_connections() {
    let red = "BaseColor { rgb 1 0 0 }";
    let rows: Vec<(&str, String, String)> = vec![
        (
            "a part from the interface",
            format!(
                "PROTO P [ field SFNode m NULL ] {{ ShapeKit {{ appearance AppearanceKit {{ material IS m }} }} }} \
                 P {{ m {red} }} P {{ }}"
            ),
            format!("Separator {{ {red} Cube {{}} }} Cube {{}}"),
        ),
        (
            "an engine fed by the interface",
            "PROTO P [ field MFFloat x 3 ] { Separator { Translation { translation = \
             ComposeVec3f { x IS x y 1 } . vector } Cube { } } } P { x 7 } P { }"
                .into(),
            "Separator { Translation { translation 7 1 0 } Cube {} } \
             Separator { Translation { translation 3 1 0 } Cube {} }"
                .into(),
        ),
        (
            "field to field",
            "PROTO P [ field SFVec3f t 0 0 0 ] { Separator { DEF T Translation { translation IS t } \
             Cube { } Translation { translation = USE T . translation } Cube { } } } P { t 1 2 3 }"
                .into(),
            "Separator { Translation { translation 1 2 3 } Cube {} \
             Translation { translation 1 2 3 } Cube {} }"
                .into(),
        ),
        (
            "an input that no class lists",
            "PROTO P [ field SFVec3f t 0 0 0 ] { Separator { Translation { translation = Gate { \
             type \"SFVec3f\" enable TRUE input IS t } . output } Cube { } } } P { t 1 2 3 }"
                .into(),
            "Translation { translation 1 2 3 } Cube {}".into(),
        ),
        (
            "the box around a part of the interface",
            "PROTO P [ field SFNode n NULL ] { Separator { Translation { translation = \
             ComputeBoundingBox { node Group { Shuttle { } Separator { AppearanceKit { } \
             WrapperKit { contents IS n } } } } . max } Cube { } } } P { n Cube { width 6 } }"
                .into(),
            "Translation { translation 3 1 1 } Cube {}".into(),
        ),
        (
            "prototypes in prototypes",
            "PROTO Q [ field MFFloat x 1 ] { Separator { Translation { translation = \
             ComposeVec3f { x IS x } . vector } ShapeKit { } } } \
             PROTO P [ field MFFloat x 2 ] { Q { x IS x } } P { } P { x 5 }"
                .into(),
            "Separator { Translation { translation 2 0 0 } Cube {} } \
             Separator { Translation { translation 5 0 0 } Cube {} }"
                .into(),
        ),
    ];
    for (name, proto, plain) in rows {
        // Only VRML 2 has prototypes; as in Coin, its files may hold nodes of Inventor.
        let vrml = |body: &str| drawn_text(&format!("#VRML V2.0 utf8\n{body}"));
        let (shown, said, _) = vrml(&proto);
        assert!(!shown.is_empty(), "{name}");
        assert_eq!(shown, vrml(&plain).0, "{name}");
        assert_eq!(said, [] as [&str; 0], "{name}");
    }
}

#[test]
fn clip_planes_are_said_with_their_planes() {
    let text = "#Inventor V2.1 ascii\nSeparator { Translation { translation 0 0 5 }\n\
                ClipPlane { plane 0 0 2 3 }\nClipPlane { on FALSE } Cube {} }";
    let graph = load(text.as_bytes(), "t.iv", Path::new(""), &FileLoader::new([]));
    let said = resolve(&graph, &ResolveOptions::default()).diagnostics;
    let said: Vec<(&str, u32, &str)> = said
        .iter()
        .map(|d| (d.code, d.pos.line, &*d.message))
        .collect();
    let wanted = "a ClipPlane cuts nothing off: the plane through (0.000000, 0.000000, 8.000000) \
                  that keeps what lies towards (0.000000, 0.000000, 1.000000)";
    assert_eq!(said, [("clip-plane", 3, wanted)]);
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
