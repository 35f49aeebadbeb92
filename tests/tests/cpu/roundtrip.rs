//! Printing loses nothing: what is printed and read again, of text or of binary, is the same tree and
//! resolves to the same scene.

use std::fs;
use std::path::Path;

use iv_parser::{Limits, SourcePos, parse, parse_any};
use scenegraph::scene::{Placement, Scene, TextureSource};
use scenegraph::{RegistryLayout, ResolveOptions, load, resolve};
use tests::fuzz_body::{self, print};
use tests::same_tree;

use super::models::{Model, check_all, samples};

/// A scene without the places of the text it was read from.
pub fn scene_of(bytes: &[u8], model: &Model) -> Scene {
    let beside = model.path.parent().unwrap_or(Path::new("."));
    let graph = load(bytes, &model.name, beside, &model.loader());
    let mut scene = resolve(&graph, &ResolveOptions::default()).scene;
    let nowhere = SourcePos::default();
    let clear = |placement: &mut Placement| placement.pos = nowhere;
    scene.nodes.iter_mut().for_each(|n| n.pos = nowhere);
    scene.meshes.iter_mut().for_each(|m| m.pos = nowhere);
    scene.materials.iter_mut().for_each(|m| {
        (m.pos, m.style_pos) = (nowhere, nowhere);
    });
    scene.environments.iter_mut().for_each(|e| e.pos = nowhere);
    scene.textures.iter_mut().for_each(|t| t.pos = nowhere);
    scene
        .instances
        .iter_mut()
        .for_each(|i| clear(&mut i.placement));
    scene
        .lights
        .iter_mut()
        .for_each(|l| clear(&mut l.placement));
    scene
        .cameras
        .iter_mut()
        .for_each(|c| clear(&mut c.placement));
    scene
}

/// What is not equal, if anything.
pub fn difference(a: &Scene, b: &Scene) -> Option<&'static str> {
    let parts = [
        ("nodes", a.nodes == b.nodes),
        ("instances", a.instances == b.instances),
        ("meshes", a.meshes == b.meshes),
        ("materials", a.materials == b.materials),
        ("textures", a.textures == b.textures),
        ("lights", a.lights == b.lights),
        ("cameras", a.cameras == b.cameras),
        ("light sets", a.light_sets == b.light_sets),
        ("environments", a.environments == b.environments),
    ];
    parts.iter().find(|(_, same)| !same).map(|(name, _)| *name)
}

fn check(model: &Model) -> Result<(), String> {
    let bytes = fs::read(&model.path).map_err(|e| e.to_string())?;
    let parsed = parse_any(&bytes, &RegistryLayout, &Limits::default());
    let text = print(&parsed.tree);
    let again = parse(&text);
    if let Some(difference) = same_tree::difference(&parsed.tree, &again.tree) {
        return Err(difference);
    }
    if print(&again.tree) != text {
        return Err("a second print differs".to_owned());
    }
    let (first, second) = (scene_of(&bytes, model), scene_of(&text, model));
    match difference(&first, &second) {
        None => Ok(()),
        Some(part) => Err(format!("{part} differ")),
    }
}

#[test]
fn printed_files_give_the_same_tree_and_scene() {
    check_all(check);
}

/// The comparison sees what it must see.
#[test]
fn differences_are_seen() {
    let sample = |name: &str| {
        let all = samples();
        let found = all.iter().find(|m| m.name == name).cloned();
        found.expect("a sample of this name")
    };
    let model = sample("textures/inline_image.iv");
    let bytes = fs::read(&model.path).expect("a sample");
    let original = scene_of(&bytes, &model);
    let changed = |change: &dyn Fn(&mut Scene)| {
        let mut scene = scene_of(&bytes, &model);
        change(&mut scene);
        difference(&original, &scene)
    };
    assert_eq!(changed(&|_| ()), None);
    let moved = |s: &mut Scene| s.meshes[0].positions[0][0] += 1e-6;
    assert_eq!(changed(&moved), Some("meshes"));
    let shiny = |s: &mut Scene| s.materials[0].shininess += 1e-12;
    assert_eq!(changed(&shiny), Some("materials"));
    let pixel = |s: &mut Scene| {
        s.textures[0].source = TextureSource::File {
            name: "other.png".into(),
            beside: "".into(),
        };
    };
    assert_eq!(changed(&pixel), Some("textures"));
}

/// What is hard to print: each must read back equal, and without a problem.
#[test]
fn hard_texts() {
    for text in [
        "Cube { width 2 ~ depth = USE name.of.width height ~ }",
        "Translation { translation 1 2 3 = Cube { } . width }",
        "Info { string \"a backslash at the end \\\"\n }",
        "Info { string \"a \\\" quote, and a\nline end\" }",
        "Switch { whichChild 010 } IndexedFaceSet { coordIndex [ 010, -1 # c\n 0x10 ] }",
        "IndexedFaceSet { coordIndex [ 0, 1, 1e38, -1, 2.0 ] }",
        "Coordinate3 { point [ -0.0 1e-320 3.4028234663852886e38, 0.1 0.30000000000000004 -1 ] }",
        "DEF a+3 Cube { } DEF 1-b Cube { } USE a+3 USE 1-b",
        "Cone { parts ( SIDES | BOTTOM ) } Cone { parts SIDES }",
        "X { fields [ SFNode n, MFNode m ] n NULL m [ Cube { }, USE y, NULL ] }",
        "Texture2 { image 1 2 3 0xff00ff 255 }",
    ] {
        let text = format!("#Inventor V2.1 ascii\n{text}");
        assert_eq!(parse(text.as_bytes()).problems, [], "{text}");
        fuzz_body::parse(text.as_bytes());
    }
}
