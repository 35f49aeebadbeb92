//! Shadow volumes against rays: pixel by pixel, what is seen and whether it is lit.

use std::fmt::Write;

use glam::DVec3;
use tests::reference::{RefImage, RefOptions, Reference};
use tests::shadow_scenes::{self, ShadowScene, scene_of};
use viewer::frame::Settings;

use super::device::Stage;
use super::mask;

/// Most pixels of geometry that may differ, as a share of them: centres of pixels that lie on an
/// edge to within the rounding of f32 vertices and of depth.
const MOST: f64 = 0.0002;

const SMALL: [u32; 2] = [512, 512];
const LARGE: [u32; 2] = [1024, 768];

/// How a picture differs from what it must be.
#[derive(Debug, Default)]
struct Figures {
    /// Pixels that show something opaque, in either.
    geometry: usize,
    /// Of another object or with other light.
    differing: usize,
    /// Of these, pixels without an edge within one pixel.
    away: usize,
}

impl Figures {
    fn of(rgba: &[u8], reference: &RefImage, light: usize) -> Self {
        let edge = reference.near_edge_of(1, 1 << light);
        let expected = mask::expected(reference, light);
        let mut figures = Self::default();
        for ((seen, expected), edge) in mask::read(rgba).into_iter().zip(expected).zip(edge) {
            let differs = seen != Some(expected);
            figures.geometry += usize::from(differs || expected.0.is_some());
            figures.differing += usize::from(differs);
            figures.away += usize::from(differs && !edge);
        }
        figures
    }

    fn is_right(&self) -> bool {
        self.away == 0 && self.differing as f64 <= MOST * self.geometry as f64
    }
}

/// Compares pictures of all lights and cameras; the lines of those that are wrong, and all lines.
fn judge(
    scene: &ShadowScene,
    size: impl Fn(usize) -> [u32; 2],
    settings: &Settings,
) -> [String; 2] {
    let resolved = scene_of(&scene.text);
    let options = RefOptions::of(&resolved);
    let reference = Reference::new(&resolved, &options);
    let truth: Vec<_> = (scene.cameras.iter().enumerate())
        .map(|(i, (_, camera))| reference.render(camera, size(i), [0.0; 3]))
        .collect();
    let mut lines = [String::new(), String::new()];
    for light in 0..resolved.lights.len() {
        let mut stage = Stage::new(mask::repainted(&resolved, light));
        for ((name, camera), truth) in scene.cameras.iter().zip(&truth) {
            let size = [truth.width, truth.height];
            let shot = stage.shoot(camera, size, &mask::settings(settings));
            let figures = Figures::of(&shot.rgba, truth, light);
            let line = format!(
                "{:>9} {:>6} {:>5}  {}x{} {}, {name}, light {light}\n",
                figures.geometry, figures.differing, figures.away, size[0], size[1], scene.name
            );
            lines[1].push_str(&line);
            if !figures.is_right() {
                lines[0].push_str(&line);
                save(
                    &format!("{}_{name}_{light}", scene.name),
                    &shot.rgba,
                    truth,
                    light,
                );
            }
        }
    }
    lines
}

/// Three pictures for the eye, side by side: drawn, expected, where they differ.
fn save(name: &str, rgba: &[u8], truth: &RefImage, light: usize) {
    let expected = mask::expected(truth, light);
    let (width, height) = (truth.width, truth.height);
    let mut strip = image::RgbImage::new(3 * width, height);
    for (i, (seen, expected)) in mask::read(rgba).into_iter().zip(expected).enumerate() {
        let (x, y) = (i as u32 % width, i as u32 / width);
        let at = 4 * i;
        strip.put_pixel(x, y, image::Rgb([rgba[at], rgba[at + 1], rgba[at + 2]]));
        let byte = |n: u8| n & 15 << 4 | 8;
        let color = expected.0.map_or([128, 0, 0], |(object, lit)| {
            [
                255 * u8::from(lit),
                (object & 15) << 4 | 8,
                object & 0xf0 | 8,
            ]
        });
        let _ = byte;
        strip.put_pixel(x + width, y, image::Rgb(color));
        let differs = 255 * u8::from(seen != Some(expected));
        strip.put_pixel(x + 2 * width, y, image::Rgb([differs; 3]));
    }
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("shadows");
    std::fs::create_dir_all(&folder).expect("target can be written");
    let file = folder.join(format!("{}.png", name.replace(' ', "-")));
    strip.save(file).expect("target can be written");
}

fn check(scenes: &[ShadowScene], size: impl Fn(usize) -> [u32; 2], settings: &Settings) {
    let mut all = String::from(" geometry differ  away  picture\n");
    let mut wrong = String::new();
    for scene in scenes {
        let start = std::time::Instant::now();
        let [bad, lines] = judge(scene, &size, settings);
        all.push_str(&lines);
        wrong.push_str(&bad);
        let _ = writeln!(all, "{:?}", start.elapsed());
    }
    println!("{all}");
    assert!(wrong.is_empty(), "wrong pictures:\n{wrong}");
}

#[test]
fn scenes_that_shadows_are_hard_on() {
    let scenes = shadow_scenes::all(DVec3::new(1e4, -3e3, 2e4));
    check(&scenes, |_| SMALL, &Settings::default());
}
