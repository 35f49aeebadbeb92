//! What needs files beside a VRML 2 model, and what is said about it.

use std::path::{Path, PathBuf};

use crate::scene::Scene;
use crate::{LoadError, Loader, ResolveOptions, load, resolve};

/// Pictures in memory.
struct Pictures(&'static [(&'static str, &'static [u8])]);

impl Loader for Pictures {
    fn find(&self, beside: &Path, name: &str) -> Result<PathBuf, LoadError> {
        let is_here = self.0.iter().any(|(known, _)| *known == name);
        is_here
            .then(|| beside.join(name))
            .ok_or(LoadError::NotFound)
    }

    fn read(&self, id: &Path) -> Result<Vec<u8>, LoadError> {
        let found = self.0.iter().find(|(known, _)| id.ends_with(known));
        let found = found.map(|(_, bytes)| bytes.to_vec());
        found.ok_or(LoadError::NotFound)
    }
}

/// First bytes of files: a colour type of PNG, and a JPEG of so many components.
const PICTURES: Pictures = Pictures(&[
    (
        "grey.png",
        b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x01\0\0\0\x01\x08\0",
    ),
    (
        "grey_alpha.png",
        b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x01\0\0\0\x01\x08\x04",
    ),
    (
        "rgb.png",
        b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x01\0\0\0\x01\x08\x02",
    ),
    (
        "rgba.png",
        b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x01\0\0\0\x01\x08\x06",
    ),
    (
        "grey.jpg",
        b"\xff\xd8\xff\xc0\0\x0b\x08\0\x01\0\x01\x01\0\0\0",
    ),
    (
        "color.jpg",
        b"\xff\xd8\xff\xc0\0\x0b\x08\0\x01\0\x01\x03\0\0\0",
    ),
    ("unknown.bin", b"what"),
]);

fn scene_of(body: &str) -> (Scene, Vec<String>) {
    let text = format!("#VRML V2.0 utf8\n{body}");
    let graph = load(text.as_bytes(), "m.wrl", Path::new(""), &PICTURES);
    let resolved = resolve(&graph, &ResolveOptions::default());
    let said = graph.diagnostics.iter().chain(&resolved.diagnostics);
    let said = said.map(|d| format!("{}: {}", d.code, d.message)).collect();
    (resolved.scene, said)
}

#[test]
fn grey_pictures_multiply_and_coloured_ones_replace() {
    let image = |name: &str| format!("ImageTexture {{ url [ \"http://x.org/a\" \"{name}\" ] }}");
    let red = ([1.0, 0.0, 0.0], 0.25);
    let white = ([1.0; 3], 0.25);
    let rows = [
        (image("grey.png"), red),
        (image("grey_alpha.png"), (red.0, 0.0)),
        (image("rgb.png"), white),
        (image("rgba.png"), (white.0, 0.0)),
        (image("grey.jpg"), red),
        (image("color.jpg"), white),
        (image("unknown.bin"), white),
        (image("missing.png"), white),
        ("PixelTexture { image 1 1 1 128 }".to_owned(), red),
        ("PixelTexture { image 1 1 2 128 }".to_owned(), (red.0, 0.0)),
        ("PixelTexture { image 1 1 3 128 }".to_owned(), white),
        (
            "PixelTexture { image 1 1 4 128 }".to_owned(),
            (white.0, 0.0),
        ),
    ];
    for (texture, wanted) in rows {
        let (scene, said) = scene_of(&format!(
            "Shape {{ geometry Box {{ }} appearance Appearance {{ texture {texture} \
             material Material {{ diffuseColor 1 0 0 transparency 0.25 }} }} }}"
        ));
        let material = &scene.materials[0];
        let found = (material.diffuse_srgb, material.transparency);
        assert_eq!(found, wanted, "{texture}");
        assert!(material.texture.is_some(), "{texture}");
        assert_eq!(said, [] as [String; 0], "{texture}");
    }
    // By way of a prototype, too.
    let (scene, _) = scene_of(
        "PROTO P [ field MFString u [ ] ] { Shape { geometry Box { } appearance Appearance { \
         texture ImageTexture { url IS u } material Material { diffuseColor 1 0 0 } } } } \
         P { u \"grey.png\" } P { u \"rgb.png\" }",
    );
    let diffuse: Vec<_> = scene.materials.iter().map(|m| m.diffuse_srgb).collect();
    assert_eq!(diffuse, [red.0, white.0]);
}

#[test]
fn point_lights_bring_ambient_light() {
    let rows: &[(&str, [f64; 3], &[&str])] = &[
        ("PointLight { }", [0.0; 3], &[]),
        (
            "PointLight { ambientIntensity 0.5 color 1 0.5 0 }",
            [0.5, 0.25, 0.0],
            &[],
        ),
        (
            "PointLight { ambientIntensity 0.5 attenuation 2 0 0 } \
             PointLight { ambientIntensity 0.5 } DirectionalLight { ambientIntensity 0.125 }",
            [0.875; 3],
            &[],
        ),
        (
            "PointLight { ambientIntensity 0.5 location 50 0 0 radius 9 }",
            [0.0; 3],
            &[],
        ),
        (
            "PointLight { ambientIntensity 0.5 attenuation 0 1 0 } SpotLight { ambientIntensity 1 }",
            [0.0; 3],
            &["light-ambient"],
        ),
    ];
    for (lights, wanted, codes) in rows {
        let (scene, said) = scene_of(&format!("{lights} Shape {{ geometry Box {{ }} }}"));
        let environment = &scene.environments[scene.instances[0].environment.index()];
        let found = environment
            .ambient_color_srgb
            .map(|v| v * environment.ambient_intensity);
        assert_eq!(found, *wanted, "{lights}");
        let said: Vec<_> = said.iter().filter_map(|s| s.split(':').next()).collect();
        assert_eq!(said, *codes, "{lights}");
        assert_eq!(scene.check(), [], "{lights}");
    }
}

#[test]
fn what_belongs_to_the_viewer_is_said() {
    let rows = [
        (
            "Background { skyColor [ 0 0.5 1, 1 1 1 ] skyAngle 1 }",
            "background: the Background is left to the viewer; its sky begins as 0 0.5 1",
        ),
        (
            "NavigationInfo { headlight FALSE }",
            "no-effect: NavigationInfo turns the headlight off, which is left to the viewer",
        ),
        (
            "NavigationInfo { }",
            "no-effect: NavigationInfo has no effect on a static picture",
        ),
    ];
    for (node, wanted) in rows {
        let (_, said) = scene_of(&format!("{node} Shape {{ geometry Box {{ }} }}"));
        assert_eq!(said, [wanted]);
    }
}
