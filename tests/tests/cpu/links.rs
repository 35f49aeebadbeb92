//! Links of anchors go to glTF and back to text.

use std::path::Path;

use convert::{Options, write_glb};
use scenegraph::scene::{Link, Scene};
use scenegraph::{FileLoader, ResolveOptions, load, resolve};
use tests::fuzz_body::read_gltf;

use super::models::Images;
use super::source_back::back;

fn scene_of(text: &[u8]) -> Scene {
    let graph = load(text, "m.iv", Path::new(""), &FileLoader::default());
    resolve(&graph, &ResolveOptions::default()).scene
}

/// The links of all groups that have one, with the groups' names.
fn links(scene: &Scene) -> Vec<(Option<String>, Link)> {
    let named = |node: &scenegraph::scene::Node| {
        let link = node.link.as_deref()?.clone();
        Some((node.name.as_deref().map(str::to_owned), link))
    };
    scene.nodes.iter().filter_map(named).collect()
}

fn link(urls: &[&str], description: &str, parameters: &[&str], tells_point: bool) -> Link {
    let texts = |list: &[&str]| list.iter().map(|text| (*text).into()).collect();
    Link {
        urls: texts(urls),
        description: description.into(),
        parameters: texts(parameters),
        tells_point,
    }
}

#[test]
fn links_go_to_gltf_and_back() {
    let rows = [
        (
            "#Inventor V2.1 ascii\nDEF Door WWWAnchor { name \"a \\\"b\\\".wrl\" description \"Way out\" \
             map POINT Cube { } }",
            Some((Some("Door"), link(&["a \"b\".wrl"], "Way out", &[], true))),
        ),
        (
            "#VRML V1.0 ascii\nWWWAnchor { name \"a.wrl\" Translation { translation 1 2 3 } Cube { } }",
            Some((None, link(&["a.wrl"], "", &[], false))),
        ),
        (
            "#VRML V2.0 utf8\nDEF Door Anchor { url [ \"a.wrl\", \"b.wrl\" ] description \"Way out\" \
             parameter \"target=new\" children Shape { geometry Box { } } }",
            Some((
                Some("Door"),
                link(&["a.wrl", "b.wrl"], "Way out", &["target=new"], false),
            )),
        ),
        ("#Inventor V2.1 ascii\nWWWAnchor { Cube { } }", None),
        (
            "#VRML V2.0 utf8\nAnchor { children Shape { geometry Box { } } }",
            None,
        ),
    ];
    for (text, want) in rows {
        let want: Vec<_> = (want.into_iter())
            .map(|(name, link)| (name.map(str::to_owned), link))
            .collect();
        let scene = scene_of(text.as_bytes());
        assert_eq!(links(&scene), want, "{text}");
        let mut glb = Vec::new();
        let images = Images(FileLoader::default());
        write_glb(&scene, &Options::default(), &images, &mut glb).expect("a file");
        let read = read_gltf(&glb).expect("a scene").scene;
        assert_eq!(links(&read), want, "{text}");
        // A WWWAnchor has room for one address and no parameters.
        let kept: Vec<_> = (want.into_iter())
            .map(|(name, mut link)| {
                link.urls.truncate(1);
                link.parameters.clear();
                (name, link)
            })
            .collect();
        let made = back(&glb).expect("a text").text;
        assert_eq!(links(&scene_of(&made)), kept, "{text}");
    }
}
