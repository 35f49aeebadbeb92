//! A window without a window: the contents in a harness, and hands to use them with.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use app::cli::args::Args;
use app::load::Device;
use app::ui::{App, Start};
use clap::Parser;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::Harness;
use image::RgbaImage;
use tempfile::TempDir;
use viewer::gpu::AdapterChoice;

/// Longer than anything takes on a busy machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// Contents of a window, in a folder of their own.
pub struct Driver {
    pub harness: Harness<'static, Option<App>>,
    pub folder: TempDir,
    wakes: Arc<AtomicU32>,
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

impl Driver {
    /// A window with a sample model.
    pub fn with_sample(path: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        Self::begin(
            folder,
            &[&samples::data_dir().join(path).display().to_string()],
        )
    }

    /// A window with a model of this text, in `model.iv`.
    pub fn with_text(text: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("model.iv");
        std::fs::write(&path, text).unwrap();
        Self::begin(folder, &[&path.display().to_string()])
    }

    /// A window for a command line.
    pub fn begin(folder: TempDir, arguments: &[&str]) -> Self {
        let words = ["ivview", "--adapter", "software"].into_iter();
        let args = Args::parse_from(words.chain(arguments.iter().copied()));
        let config_path = Some(folder.path().join("config").join("ivview.json"));
        let since = Instant::now();
        let wakes = Arc::new(AtomicU32::new(0));
        let counted = Arc::clone(&wakes);
        let mut start = Some((args, config_path));
        let harness = Harness::builder()
            .with_size(vec2(1300.0, 640.0))
            .with_step_dt(1.0 / 60.0)
            .build_ui_state(
                move |ui, app: &mut Option<App>| {
                    let ctx = ui.ctx().clone();
                    let begin = || {
                        let (args, config_path) = start.take().unwrap();
                        let (waker, wakes) = (ctx.clone(), Arc::clone(&wakes));
                        let start = Start {
                            args,
                            device: Device::begin(AdapterChoice::Software),
                            since,
                            config_path,
                            wake: Arc::new(move || {
                                wakes.fetch_add(1, Ordering::Relaxed);
                                waker.request_repaint();
                            }),
                        };
                        App::new(start, &ctx)
                    };
                    app.get_or_insert_with(begin).show(ui);
                },
                None,
            );
        let mut driver = Self {
            harness,
            folder,
            wakes: counted,
        };
        driver.settle();
        driver
    }

    pub fn app(&mut self) -> &mut App {
        self.harness.state_mut().as_mut().unwrap()
    }

    /// How often a thread has asked for a pass.
    pub fn wakes(&self) -> u32 {
        self.wakes.load(Ordering::Relaxed)
    }

    /// Waits until nothing is being read and the picture is sharp.
    pub fn settle(&mut self) {
        self.until("nothing is being read", |app| app.loading.is_none());
        for _ in 0..3 {
            self.harness.step();
        }
        // A moving view is drawn coarser until it rests.
        std::thread::sleep(Duration::from_millis(220));
        for _ in 0..3 {
            self.harness.step();
        }
    }

    /// Goes on until something is so.
    pub fn until(&mut self, what: &str, is_so: impl Fn(&App) -> bool) {
        let start = Instant::now();
        loop {
            self.harness.step();
            if is_so(self.app()) {
                return;
            }
            assert!(start.elapsed() < PATIENCE, "never: {what}");
            std::thread::sleep(Duration::from_millis(10));
        }
    }

    /// The picture of the scene.
    pub fn picture(&mut self) -> RgbaImage {
        let model = self.app().model.as_ref().unwrap();
        let pixels = model.renderer.read().unwrap();
        let (width, height) = self.app().canvas.size;
        RgbaImage::from_raw(width, height, pixels).expect("the picture fills its place")
    }

    /// The place on the screen for a part of the picture: (0, 0) is its top left corner.
    pub fn place(&mut self, x: f32, y: f32) -> Pos2 {
        let rect = self.app().canvas.rect.unwrap();
        rect.min + rect.size() * vec2(x, y)
    }

    /// The place on the screen of a point of the world.
    pub fn place_of(&mut self, p_in_world: glam::DVec3) -> Pos2 {
        let (width, height) = self.app().canvas.size;
        let region = viewer::view::Region::whole(width, height);
        let view = self.app().navigator.unwrap().view;
        let [x, y] = viewer::pick::pixel_of(&view, &region, p_in_world).unwrap();
        self.place(x as f32 / width as f32, y as f32 / height as f32)
    }

    pub fn key(&mut self, key: Key) {
        self.harness.key_press(key);
        self.settle();
    }

    fn button(&self, pos: Pos2, button: PointerButton, pressed: bool, modifiers: Modifiers) {
        self.harness.event(Event::PointerButton {
            pos,
            button,
            pressed,
            modifiers,
        });
    }

    pub fn click(&mut self, pos: Pos2) {
        self.harness.hover_at(pos);
        self.button(pos, PointerButton::Primary, true, Modifiers::NONE);
        self.button(pos, PointerButton::Primary, false, Modifiers::NONE);
        self.settle();
    }

    pub fn double_click(&mut self, pos: Pos2) {
        self.harness.hover_at(pos);
        for _ in 0..2 {
            self.button(pos, PointerButton::Primary, true, Modifiers::NONE);
            self.button(pos, PointerButton::Primary, false, Modifiers::NONE);
        }
        self.settle();
    }

    pub fn drag(&mut self, from: Pos2, to: Pos2, button: PointerButton) {
        self.harness.hover_at(from);
        self.button(from, button, true, Modifiers::NONE);
        for i in 1..=4 {
            let part = i as f32 / 4.0;
            self.harness.hover_at(from + (to - from) * part);
        }
        self.button(to, button, false, Modifiers::NONE);
        self.settle();
    }

    pub fn scroll(&mut self, pos: Pos2, points: f32) {
        self.harness.hover_at(pos);
        self.harness.event(Event::MouseWheel {
            unit: egui::MouseWheelUnit::Point,
            delta: vec2(0.0, points),
            phase: egui::TouchPhase::Move,
            source: egui::MouseWheelSource::Unknown,
            modifiers: Modifiers::NONE,
        });
        // The wheel's way is spread over some passes.
        for _ in 0..20 {
            self.harness.step();
        }
        self.settle();
    }

    /// Drops a file onto the window.
    pub fn drop_file(&mut self, path: &Path) {
        let file = Arc::new(Dropped(path.to_owned()));
        self.harness.input_mut().dropped_files.push(file);
        self.harness.step();
        self.settle();
    }

    /// Does what a menu's dialog would do with this answer.
    pub fn answer(&mut self, question: app::ui::Question, path: &Path) {
        self.app().answered(question, path);
        self.settle();
    }

    /// The name of what is selected.
    pub fn selected(&mut self) -> Option<String> {
        let app = self.app();
        let row = app.selected?;
        Some(app.model.as_ref()?.outline.rows[row].label.clone())
    }
}

/// Pixels that differ in any channel.
pub fn different(a: &RgbaImage, b: &RgbaImage) -> usize {
    assert_eq!(a.dimensions(), b.dimensions());
    a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count()
}
