//! Colours against the reference: light, textures, fog and glass, with and without shadows.

use std::fmt::Write;
use std::path::Path;

use glam::DVec3;
use scenegraph::scene::{Scene, Topology};
use scenegraph::{FileLoader, ResolveOptions, load, resolve};
use tests::reference::{RefCamera, RefImage, RefLens, RefOptions, Reference};
use tests::shadow_scenes::{self, ShadowScene, scene_of};
use viewer::frame::{Settings, Shadows};
use viewer::view::{Lens, View};

use super::device::Stage;

/// Largest mean difference, in steps of 8 bits: what rounding to bytes alone may take.
const MEAN: f64 = 0.5;
/// A pixel that differs by more steps is wrong: light is summed in half floats, which err by an
/// eighth of a step a pass, and images are filtered with weights of 8 bits.
const STEPS: u8 = 2;
/// Largest share of wrong pixels: edges of light that are no edges of shadow, such as a spot's.
const WRONG: f64 = 0.001;
/// Smallest share of the picture that is judged.
const JUDGED: f64 = 0.1;

const BACKGROUND: [f64; 3] = [0.2, 0.4, 0.6];

const SMALL: [u32; 2] = [256, 256];
const LARGE: [u32; 2] = [512, 512];
const WIDE: [u32; 2] = [512, 384];

/// A scene to be seen from some places.
struct Row {
    name: String,
    scene: Scene,
    cameras: Vec<(&'static str, RefCamera)>,
    size: [u32; 2],
}

/// How a picture differs from what it must be, in pixels that show a surface and are not at an
/// edge.
struct Figures {
    judged: f64,
    mean: f64,
    wrong: f64,
    largest: u8,
}

impl Figures {
    fn of(rgba: &[u8], truth: &RefImage) -> Self {
        let edge = truth.near_edge(1);
        let bytes = truth.bytes();
        let pixels = rgba.as_chunks::<4>().0.iter().zip(bytes.as_chunks::<3>().0);
        let differences: Vec<u8> = (pixels.enumerate())
            .filter(|(i, _)| !edge[*i] && (truth.object[*i].is_some() || truth.layers[*i] != 0))
            .map(|(_, ([r, g, b, _], expected))| {
                let channels = [r, g, b].into_iter().zip(expected);
                channels.map(|(a, b)| a.abs_diff(*b)).fold(0, u8::max)
            })
            .collect();
        let count = differences.len().max(1) as f64;
        let wrong = differences.iter().filter(|&&d| d > STEPS).count();
        Self {
            judged: differences.len() as f64 / edge.len() as f64,
            mean: differences.iter().map(|&d| f64::from(d)).sum::<f64>() / count,
            wrong: wrong as f64 / count,
            largest: differences.into_iter().fold(0, u8::max),
        }
    }

    fn is_right(&self) -> bool {
        self.judged >= JUDGED && self.mean <= MEAN && self.wrong <= WRONG
    }
}

fn check(rows: impl IntoIterator<Item = Row>) {
    let mut all = String::from("judged   mean  wrong largest  picture\n");
    let mut bad = String::new();
    for row in rows {
        let mut stage = Stage::new(row.scene.clone());
        for shadows in [true, false] {
            let options = RefOptions {
                shadows,
                ..RefOptions::of(&row.scene)
            };
            let reference = Reference::new(&row.scene, &options);
            for (camera_name, camera) in &row.cameras {
                let truth = reference.render(&with_all_before(camera), row.size, BACKGROUND);
                let shot = stage.shoot(camera, row.size, &settings(shadows));
                let figures = Figures::of(&shot.rgba, &truth);
                let line = format!(
                    "{:>5.1}% {:>6.3} {:>5.2}% {:>7}  {}, {camera_name}{}\n",
                    100.0 * figures.judged,
                    figures.mean,
                    100.0 * figures.wrong,
                    figures.largest,
                    row.name,
                    if shadows { "" } else { ", no shadows" }
                );
                all.push_str(&line);
                if !figures.is_right() {
                    let _ = write!(bad, "{line}");
                    let name = format!("{}_{camera_name}_{shadows}", row.name);
                    save(&name, &shot.rgba, &truth);
                }
            }
        }
    }
    println!("{all}");
    assert!(bad.is_empty(), "wrong pictures:\n{bad}");
}

fn settings(shadows: bool) -> Settings {
    let settings = Settings {
        background_srgb: [BACKGROUND; 2],
        ..Settings::default()
    };
    if shadows {
        settings
    } else {
        Settings {
            shadows: Shadows::None,
            ..settings
        }
    }
}

/// A parallel view shows what is behind its eye too, as Inventor's viewers do; the reference's does
/// not.
fn with_all_before(camera: &RefCamera) -> RefCamera {
    match camera.lens {
        RefLens::Perspective { .. } => *camera,
        RefLens::Orthographic { .. } => camera.moved(-100.0 * camera.forward),
    }
}

/// Two pictures for the eye, side by side: drawn and expected.
fn save(name: &str, rgba: &[u8], truth: &RefImage) {
    let (width, height) = (truth.width, truth.height);
    let bytes = truth.bytes();
    let pairs = image::RgbImage::from_fn(2 * width, height, |x, y| {
        let at = (y * width + x % width) as usize;
        image::Rgb(if x < width {
            [0, 1, 2].map(|i| rgba[4 * at + i])
        } else {
            [0, 1, 2].map(|i| bytes[3 * at + i])
        })
    });
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("shading");
    std::fs::create_dir_all(&folder).expect("target can be written");
    let file = folder.join(format!("{}.png", name.replace(' ', "-")));
    pairs.save(file).expect("target can be written");
}

fn row(scene: ShadowScene, size: [u32; 2]) -> Row {
    Row {
        name: scene.name.to_owned(),
        scene: scene_of(&scene.text),
        cameras: scene.cameras,
        size,
    }
}

/// Highlights in a parallel view, where all ways to the eye are the same.
fn parallel_highlights() -> Row {
    let eye = DVec3::new(2.0, 3.0, 4.0);
    let lens = RefLens::Orthographic { half_height: 2.0 };
    let camera = RefCamera::look_at(eye, DVec3::new(0.0, 0.5, 0.0), DVec3::Y, lens);
    Row {
        name: "lights of all kinds, parallel".to_owned(),
        cameras: vec![("over", camera)],
        ..row(shadow_scenes::many_lights(), SMALL)
    }
}

/// Without lights of its own a scene is lit from the eye.
fn headlight(of: ShadowScene) -> Row {
    let mut row = row(of, SMALL);
    row.name.push_str(" by the headlight");
    row.scene.lights.clear();
    row.scene.light_sets.iter_mut().for_each(Vec::clear);
    row
}

#[test]
fn shading_of_all_looks() {
    let large = [
        shadow_scenes::many_lights(),
        shadow_scenes::beams(),
        shadow_scenes::panes(),
        shadow_scenes::vertex_colors(),
    ];
    let small = [
        shadow_scenes::light_in_plane(),
        shadow_scenes::mirrored(),
        shadow_scenes::parallel_views(),
        shadow_scenes::parallel_views_of_lamp(),
        shadow_scenes::room_with_window(),
        shadow_scenes::inverted_box(),
        shadow_scenes::self_intersecting(),
        shadow_scenes::eye_in_shadow(),
    ];
    let small = (small.into_iter())
        .chain(shadow_scenes::textures())
        .chain(shadow_scenes::fogs());
    let rows = (large.into_iter().map(|scene| row(scene, LARGE)))
        .chain(small.map(|scene| row(scene, SMALL)))
        .chain([
            parallel_highlights(),
            headlight(shadow_scenes::many_lights()),
            headlight(shadow_scenes::mirrored()),
        ]);
    check(rows);
}

/// The pavilion without what the reference has not: images that are seen from far, lines, points.
fn pavilion() -> Row {
    let path = samples::data_dir().join("pavilion.iv");
    let text = std::fs::read(&path).expect("the sample is there");
    let folder = path.parent().expect("it is in a folder");
    let graph = load(&text, "pavilion.iv", folder, &FileLoader::default());
    let mut scene = resolve(&graph, &ResolveOptions::default()).scene;
    for material in &mut scene.materials {
        material.texture = None;
    }
    let meshes = &scene.meshes;
    scene
        .instances
        .retain(|instance| meshes[instance.mesh.index()].topology == Topology::Triangles);
    let [width, height] = WIDE;
    let camera = &scene.cameras[0];
    let (view, region) = View::from_scene_camera(camera, width, height);
    assert_eq!(region.rectangle(), [0, 0, width, height]);
    Row {
        name: "pavilion".to_owned(),
        cameras: vec![("its camera", ref_camera(&view))],
        scene,
        size: WIDE,
    }
}

fn ref_camera(view: &View) -> RefCamera {
    RefCamera {
        eye: view.eye,
        right: view.right(),
        up: view.up(),
        forward: view.forward(),
        lens: match view.lens {
            Lens::Perspective { tan_half_height } => RefLens::Perspective { tan_half_height },
            Lens::Orthographic { half_height } => RefLens::Orthographic { half_height },
        },
    }
}

#[test]
fn shading_of_the_pavilion() {
    check([pavilion()]);
}
