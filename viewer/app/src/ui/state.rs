//! What the window's contents consist of, what is told to the user and what is kept.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use egui::Context;
use iv_parser::Diagnostic;
use viewer::frame::{Headlight, Settings, Shadows};
use viewer::navigate::{Navigator, Turning};

use super::canvas::Canvas;
use super::dialogs::Dialogs;
use super::measure::Measure;
use super::overlays::{Over, Overlays};
use super::password::Asked;
use crate::cli::args::Args;
use crate::cli::camera::Viewpoint;
use crate::config::Config;
use crate::load::{Device, Loading, Wake};
use crate::model::Model;
use crate::watch::Watch;

/// What a window begins with.
pub struct Start {
    /// The command line.
    pub args: Args,
    /// The device, or one that is being made.
    pub device: Device,
    /// When the process began.
    pub since: Instant,
    /// Where settings are kept; `None`: nowhere.
    pub config_path: Option<PathBuf>,
    /// Asks for a pass.
    pub wake: Wake,
}

/// Something the user is told in the status bar.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// In words.
    pub text: String,
    /// Something was not done.
    pub is_error: bool,
}

/// Counts since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Passes of the interface.
    pub passes: u64,
    /// Pictures of the scene drawn.
    pub pictures: u64,
    /// Devices that were lost.
    pub lost: u32,
}

/// A model that could not be read.
pub struct Failure {
    /// Its file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub diagnostics: Vec<Diagnostic>,
}

/// What the left panel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeftTab {
    /// The tree.
    Model,
    /// Diagnostics.
    Messages,
}

/// The contents of the window.
pub struct App {
    pub(super) args: Args,
    pub(super) since: Instant,
    /// The device that draws, or is being made.
    pub device: Device,
    /// Counts devices: a host makes its own things anew when it changes.
    pub device_revision: u64,
    /// What is remembered.
    pub config: Config,
    pub(super) kept_config: Config,
    pub(super) config_path: Option<PathBuf>,
    pub(super) wake: Wake,
    /// The files to go through.
    pub(super) files: Vec<PathBuf>,
    pub(super) file: usize,
    /// What is shown.
    pub model: Option<Model>,
    /// What is being read.
    pub loading: Option<Loading>,
    pub(super) is_first: bool,
    /// What could not be read the last time.
    pub(super) failure: Option<Failure>,
    pub(super) watch: Option<Watch>,
    /// Where one looks from.
    pub navigator: Option<Navigator>,
    /// Where one is to look from when the picture's size is known.
    pub(super) first_view: Option<Viewpoint>,
    /// How a frame is drawn.
    pub settings: Settings,
    pub(super) shadows: Shadows,
    /// The picture.
    pub canvas: Canvas,
    /// What is drawn over the picture.
    pub over: Over,
    pub(super) overlays: Overlays,
    /// What is measured.
    pub measure: Measure,
    /// The row of the tree that is selected.
    pub selected: Option<usize>,
    pub(super) search: String,
    pub(super) open_rows: Vec<bool>,
    pub(super) reveals_selection: bool,
    pub(super) camera: Option<usize>,
    /// The size of saved pictures, if not that of the window.
    pub picture_size: Option<(u32, u32)>,
    pub(super) left_tab: LeftTab,
    pub(super) shows_help: bool,
    /// What the user was told last.
    pub notice: Option<Notice>,
    pub(super) dialogs: Dialogs,
    pub(super) asked: Option<Asked>,
    pub(super) passwords: HashMap<PathBuf, String>,
    pub(super) knows_all_letters: bool,
    /// Counts.
    pub counters: Counters,
    pub(super) lost_in_a_row: u32,
    /// The user wants to leave.
    pub quits: bool,
}

impl App {
    /// Begins, with the first file of the command line if there is one.
    pub fn new(start: Start, ctx: &Context) -> Self {
        let Start {
            args,
            device,
            since,
            config_path,
            wake,
        } = start;
        let config = config_path.as_deref().map(Config::read).unwrap_or_default();
        let mut settings = args.settings();
        // What stands on the command line is stronger.
        if !args.has_background()
            && let Some(colors) = config.background_srgb
        {
            settings.background_srgb = colors;
        }
        if args.msaa == 1
            && let Some(samples) = config.samples.filter(|s| [1, 4].contains(s))
        {
            settings.samples = samples;
        }
        let shadows = match settings.shadows {
            Shadows::None => Shadows::default(),
            other => other,
        };
        let mut app = Self {
            files: args.models.clone(),
            file: 0,
            args,
            since,
            device,
            device_revision: 0,
            kept_config: config.clone(),
            config,
            config_path,
            wake,
            model: None,
            loading: None,
            is_first: true,
            failure: None,
            watch: None,
            navigator: None,
            first_view: None,
            settings,
            shadows,
            canvas: Canvas::default(),
            over: Over::default(),
            overlays: Overlays::default(),
            measure: Measure::default(),
            selected: None,
            search: String::new(),
            open_rows: Vec::new(),
            reveals_selection: false,
            camera: None,
            picture_size: None,
            left_tab: LeftTab::Model,
            shows_help: false,
            notice: None,
            dialogs: Dialogs::default(),
            asked: None,
            passwords: HashMap::new(),
            knows_all_letters: false,
            counters: Counters::default(),
            lost_in_a_row: 0,
            quits: false,
        };
        ctx.set_theme(if app.config.is_dark {
            egui::Theme::Dark
        } else {
            egui::Theme::Light
        });
        if let Some(first) = app.files.first().cloned() {
            app.load(&first, false);
        }
        app
    }

    /// Tells the user that something was not done.
    pub(super) fn fail(&mut self, text: String) {
        self.notice = Some(Notice {
            text,
            is_error: true,
        });
    }

    /// Tells the user that something was done.
    pub(super) fn tell(&mut self, text: String) {
        self.notice = Some(Notice {
            text,
            is_error: false,
        });
    }

    /// Keeps what is to be remembered, when it has changed.
    pub fn remember(&mut self) {
        self.config.samples = Some(self.settings.samples);
        self.config.background_srgb = Some(self.settings.background_srgb);
        if let Some(navigator) = &self.navigator {
            self.config.rolls = navigator.turning == Turning::Ball;
        }
        if self.config != self.kept_config
            && let Some(path) = &self.config_path
        {
            if let Err(why) = self.config.write(path) {
                self.notice = Some(Notice {
                    text: format!("the settings were not kept: {why}"),
                    is_error: true,
                });
            }
            self.kept_config = self.config.clone();
        }
    }

    /// Whether shadows are drawn.
    pub fn has_shadows(&self) -> bool {
        self.settings.shadows != Shadows::None
    }

    /// Whether the light at the eye shines.
    pub fn has_headlight(&self) -> bool {
        match self.settings.headlight {
            Headlight::Off => false,
            Headlight::On => true,
            Headlight::WhenAlone => {
                let model = self.model.as_ref();
                model.is_some_and(|m| m.scene.lights.is_empty())
            }
        }
    }

    /// The name of the model's file.
    pub fn title(&self) -> String {
        let path = self.model.as_ref().map(|m| m.path.as_path());
        match path.and_then(Path::file_name) {
            Some(name) => format!("{} – ivview", name.to_string_lossy()),
            None => "ivview".to_owned(),
        }
    }

    /// What the first picture took, once it is there: from the start of the process.
    pub fn first_picture(&mut self) -> Option<String> {
        let since = self.since;
        let model = self.model.as_mut()?;
        self.canvas.last.as_ref()?;
        if model.times.total.is_zero() {
            model.times.total = since.elapsed();
        }
        let times = &model.times;
        let part = |name: &str, time: Duration| format!("{name} {:.3} s", time.as_secs_f64());
        let parts = [
            part("read", times.read),
            part("resolve", times.resolve),
            part("wait for the device", times.device_wait),
            part("upload", times.upload),
            part("compile", times.compile),
            part("draw", times.draw),
        ];
        Some(format!(
            "first picture after {:.3} s: {}",
            times.total.as_secs_f64(),
            parts.join(", ")
        ))
    }
}
