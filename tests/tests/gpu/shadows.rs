//! Shadow volumes against rays: pixel by pixel, what is seen and whether it is lit.

use glam::{DVec3, DVec4};
use scenegraph::scene::{Light, LightKind, Scene, Topology};
use tests::reference::{RefCamera, RefImage, RefLens, RefOptions, Reference};
use tests::shadow_scenes::{self, GridLight, GridSize, ShadowScene, scene_of, sphere_grid};
use viewer::frame::Settings;

use super::device::Stage;
use super::mask;

/// Most pixels of geometry that may differ, as a share of them: centres of pixels that lie on an
/// edge to within the rounding of f32 vertices and of depth.
const MOST: f64 = 0.0002;

/// Vertices are snapped to this many places along a pixel (Vulkan's `subPixelPrecisionBits`, 8
/// here), so of the pixels on edges this share can go to the other side.
const SNAP: f64 = 256.0;

/// Most pixels for which an edge finer than a pixel is looked for.
const MOST_FINE: usize = 64;

const SIZES: [[u32; 2]; 2] = [[512, 512], [1024, 768]];

/// How a picture differs from what it must be.
#[derive(Debug, Default)]
struct Figures {
    /// Pixels that show something opaque, in either.
    geometry: usize,
    /// Pixels with an edge within one pixel.
    edges: usize,
    /// Of another object or with other light.
    differing: usize,
    /// Of these, pixels without an edge within one pixel.
    away: usize,
}

impl Figures {
    fn of(rgba: &[u8], truth: &Truth<'_>, light: usize) -> Self {
        let edge = truth.image.near_edge_of(1, 1 << light);
        let expected = mask::expected(&truth.image, light);
        let mut figures = Self::default();
        let mut away = Vec::new();
        for (i, (seen, expected)) in mask::read(rgba).into_iter().zip(expected).enumerate() {
            if truth.is_grazed(i, light) {
                continue;
            }
            let differs = seen != Some(expected);
            figures.geometry += usize::from(differs || expected.0.is_some());
            figures.edges += usize::from(edge[i]);
            figures.differing += usize::from(differs);
            if differs && !edge[i] {
                away.push(i);
            }
        }
        // A broken renderer is not asked about each of its pixels.
        if away.len() <= MOST_FINE {
            away.retain(|&i| !truth.has_fine_edge(i, light));
        }
        figures.away = away.len();
        figures
    }

    fn is_right(&self) -> bool {
        let most = (MOST * self.geometry as f64).max(self.edges as f64 / SNAP);
        self.geometry > 0 && self.away == 0 && self.differing as f64 <= most
    }
}

/// What a picture must show.
struct Truth<'a> {
    reference: &'a Reference<'a>,
    name: &'static str,
    camera: RefCamera,
    image: RefImage,
    /// Points and directions to the lights, homogeneous.
    lights: Vec<DVec4>,
}

impl<'a> Truth<'a> {
    fn new(
        reference: &'a Reference<'a>,
        scene: &Scene,
        name: &'static str,
        camera: RefCamera,
        size: [u32; 2],
    ) -> Self {
        // The renderer shows what lies behind the eye of a parallel view, as Inventor's viewers do.
        let behind = match camera.lens {
            RefLens::Orthographic { .. } => camera.forward * -100.0,
            RefLens::Perspective { .. } => DVec3::ZERO,
        };
        let camera = camera.moved(behind);
        Self {
            reference,
            name,
            camera,
            image: reference.render(&camera, size, [0.0; 3]),
            lights: scene.lights.iter().map(place_of).collect(),
        }
    }

    /// Whether there is an edge within one pixel that is finer than the picture: looked for with
    /// eight times as many pixels. Triangles of a large mesh are smaller than a pixel, and each
    /// throws its shadow.
    fn has_fine_edge(&self, pixel: usize, light: usize) -> bool {
        let RefImage { width, height, .. } = self.image;
        let RefLens::Perspective { tan_half_height } = self.camera.lens else {
            return false;
        };
        let center = [pixel as u32 % width, pixel as u32 / width].map(|at| f64::from(at) + 0.5);
        let ray = self.camera.ray(center, [width, height]);
        // Three pixels across, of a picture that the middle of the view fills least densely.
        let lens = RefLens::Perspective {
            tan_half_height: 3.0 * tan_half_height / f64::from(height),
        };
        let target = ray.origin + ray.direction;
        let camera = RefCamera::look_at(ray.origin, target, self.camera.up, lens);
        let near = self.reference.render(&camera, [24, 24], [0.0; 3]);
        let seen = |i: usize| (near.object[i], near.lit[i] >> light & 1);
        (1..near.object.len()).any(|i| seen(i) != seen(0))
    }

    /// Whether the light lies in the plane of what a pixel shows. It gives no light there, so
    /// neither answer is wrong: the cosine is zero.
    fn is_grazed(&self, pixel: usize, light: usize) -> bool {
        let RefImage {
            width,
            height,
            ref depth,
            ref facet,
            ..
        } = self.image;
        let center = [pixel as u32 % width, pixel as u32 / width].map(|at| f64::from(at) + 0.5);
        let ray = self.camera.ray(center, [width, height]);
        // The parameter along a ray is the depth.
        let p = ray.origin + ray.direction * depth[pixel];
        let light = self.lights[light];
        let way = light.truncate() - p * light.w;
        // f64 places are known to far less than this share of the way to the light.
        DVec3::from(facet[pixel].normal).dot(way).abs() <= 1e-9 * way.length()
    }
}

fn place_of(light: &Light) -> DVec4 {
    let world_from_local = light.placement.world_from_local;
    match light.kind {
        LightKind::Directional { direction } => {
            (-world_from_local.transform_vector3(direction)).extend(0.0)
        }
        LightKind::Point { location } | LightKind::Spot { location, .. } => {
            world_from_local.transform_point3(location).extend(1.0)
        }
    }
}

/// Compares pictures of all lights and cameras; the lines of those that are wrong, and all lines.
fn judge(scene: &Scene, name: &str, cameras: &[(&'static str, RefCamera)]) -> [String; 2] {
    let options = RefOptions::of(scene);
    let reference = Reference::new(scene, &options);
    let truth: Vec<Truth> = SIZES
        .iter()
        .flat_map(|&size| cameras.iter().map(move |camera| (size, camera)))
        .map(|(size, &(name, camera))| Truth::new(&reference, scene, name, camera, size))
        .collect();
    let mut lines = [String::new(), String::new()];
    for light in 0..scene.lights.len() {
        let mut stage = Stage::new(mask::repainted(scene, light));
        for truth in &truth {
            let size = [truth.image.width, truth.image.height];
            let settings = mask::settings(&Settings::default());
            let shot = stage.shoot(&truth.camera, size, &settings);
            let figures = Figures::of(&shot.rgba, truth, light);
            let line = format!(
                "{:>9} {:>6} {:>5}  {}x{} {name}, {}, light {light}\n",
                figures.geometry, figures.differing, figures.away, size[0], size[1], truth.name
            );
            lines[1].push_str(&line);
            if !figures.is_right() {
                lines[0].push_str(&line);
                save(
                    &format!("{name}_{}_{light}", truth.name),
                    &shot.rgba,
                    &truth.image,
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

fn check(scenes: &[ShadowScene]) {
    let mut report = Report::default();
    for scene in scenes {
        report.add(judge(&scene_of(&scene.text), scene.name, &scene.cameras));
    }
    report.end();
}

struct Report {
    all: String,
    wrong: String,
}

impl Default for Report {
    fn default() -> Self {
        Self {
            all: String::from(" geometry differ  away  picture\n"),
            wrong: String::new(),
        }
    }
}

impl Report {
    fn add(&mut self, [wrong, all]: [String; 2]) {
        self.wrong.push_str(&wrong);
        self.all.push_str(&all);
    }

    fn end(self) {
        println!("{}", self.all);
        assert!(self.wrong.is_empty(), "wrong pictures:\n{}", self.wrong);
    }
}

#[test]
fn scenes_that_shadows_are_hard_on() {
    let mut scenes = shadow_scenes::all(DVec3::splat(1e6));
    // Their images make these transparent, and repainted they are not.
    scenes.retain(|scene| !scene.name.starts_with("textures"));
    check(&scenes);
}

#[test]
fn grids_of_spheres() {
    let mut scenes = Vec::new();
    for size in [GridSize::SMALL, GridSize::HUGE] {
        for light in [GridLight::Point, GridLight::Directional] {
            scenes.push(sphere_grid(size, light));
        }
    }
    check(&scenes);
}

#[test]
fn the_pavilion_with_all_its_lights() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../samples/data");
    let text = std::fs::read(folder.join("pavilion.iv")).expect("the sample is there");
    let files = scenegraph::FileLoader::new([folder.as_path()]);
    let graph = scenegraph::load(&text, "pavilion.iv", &folder, &files);
    let mut scene = scenegraph::resolve(&graph, &scenegraph::ResolveOptions::default()).scene;
    // The reference has no lines.
    scene
        .instances
        .retain(|instance| scene.meshes[instance.mesh.index()].topology == Topology::Triangles);
    // Where the survey's grid has the pavilion, far from the origin.
    let place = DVec3::new(2_600_072.35, 1_200_058.125, 555.4);
    let cameras = [
        ("garden", DVec3::new(22.4, -14.2, 4.1)),
        ("back", DVec3::new(-6.0, 18.0, 4.0)),
        ("inside", DVec3::new(2.0, 2.0, 1.6)),
    ]
    .map(|(name, eye)| {
        let lens = RefLens::Perspective {
            tan_half_height: 0.5,
        };
        let middle = place + DVec3::new(8.0, 3.0, 1.2);
        (
            name,
            RefCamera::look_at(place + eye, middle, DVec3::Z, lens),
        )
    });
    let mut report = Report::default();
    report.add(judge(&scene, "pavilion", &cameras));
    report.end();
}
