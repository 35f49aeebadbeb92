//! What commands do.

use egui::Context;
use viewer::frame::{Headlight, Shadows};
use viewer::navigate::Turning;
use viewer::view::framing::Up;
use viewer::view::{Lens, View};

use super::command::Command;
use super::dialogs::Question;
use super::state::App;

/// Inventor's default `heightAngle` of 45 degrees: tan(pi / 8).
const TAN_HALF_HEIGHT: f64 = std::f64::consts::SQRT_2 - 1.0;

impl App {
    /// Does what is asked for.
    pub fn run(&mut self, command: Command, ctx: &Context) {
        match command {
            Command::Open => self.ask(Question::Open),
            Command::Reload => self.reload(),
            Command::NextFile => self.step_file(1),
            Command::PreviousFile => self.step_file(self.files.len().saturating_sub(1)),
            Command::SavePicture => self.ask(Question::SavePicture),
            Command::CopyPicture => self.copy_picture(ctx),
            Command::Export => self.ask(Question::Export),
            Command::ExportSelection => self.ask(Question::ExportSelection),
            Command::LoadView => self.ask(Question::LoadView),
            Command::SaveView => self.ask(Question::SaveView),
            Command::Quit => self.quits = true,
            Command::NextCamera => self.next_camera(),
            Command::Shadows => self.toggle_shadows(),
            Command::Headlight => {
                self.settings.headlight = if self.has_headlight() {
                    Headlight::Off
                } else {
                    Headlight::On
                };
            }
            Command::Hide => self.hide_selection(),
            Command::Isolate => self.isolate_selection(),
            Command::ShowAll => self.show_everything(),
            Command::Deselect => self.selected = None,
            Command::Tree => self.config.shows_tree ^= true,
            Command::Settings => self.config.shows_settings ^= true,
            Command::Help => self.shows_help ^= true,
            Command::ZoomAll
            | Command::ZoomSelection
            | Command::Look(_)
            | Command::ChangeLens
            | Command::Level
            | Command::ChangeTurning
            | Command::FirstView => self.change_view(command),
            Command::Measure => self.measure.is_active ^= true,
            Command::Wireframe
            | Command::Edges
            | Command::Points
            | Command::Normals
            | Command::Silhouettes
            | Command::Volumes
            | Command::Grid
            | Command::Axes
            | Command::Section => self.toggle_over(command),
        }
    }

    fn change_view(&mut self, command: Command) {
        let aspect = self.aspect();
        let Some(model) = &self.model else {
            return;
        };
        let all = self.shown_bounds();
        let selection = self.selection_bounds();
        let Some(navigator) = &mut self.navigator else {
            return;
        };
        match command {
            Command::ZoomAll => navigator.show_all(&all, aspect),
            Command::ZoomSelection => navigator.show_all(&selection.unwrap_or(all), aspect),
            Command::Look(standard) => navigator.show_from(standard, &all, aspect),
            Command::ChangeLens => navigator.change_lens(TAN_HALF_HEIGHT),
            Command::Level => navigator.level(),
            Command::ChangeTurning => {
                navigator.turning = match navigator.turning {
                    Turning::Turntable => Turning::Ball,
                    Turning::Ball => Turning::Turntable,
                };
            }
            Command::FirstView => {
                let view = match model.scene.cameras.first() {
                    Some(camera) => {
                        let (width, height) = self.canvas.size;
                        View::from_scene_camera(camera, width, height).0
                    }
                    None => View::of_whole(&all, model.up, aspect),
                };
                self.camera = None;
                self.set_view(view);
            }
            _ => {}
        }
    }

    fn step_file(&mut self, by: usize) {
        if self.files.len() < 2 {
            self.tell("there is no other file: give several on the command line".to_owned());
            return;
        }
        self.file = (self.file + by) % self.files.len();
        let path = self.files[self.file].clone();
        self.load(&path, false);
    }

    fn next_camera(&mut self) {
        let Some(model) = &self.model else {
            return;
        };
        let count = model.scene.cameras.len();
        if count == 0 {
            self.tell("the model has no cameras".to_owned());
            return;
        }
        let next = self.camera.map_or(0, |camera| (camera + 1) % count);
        self.look_through(next);
    }

    /// Looks as a camera of the file does.
    pub(super) fn look_through(&mut self, camera: usize) {
        let Some(of_scene) = self
            .model
            .as_ref()
            .and_then(|m| m.scene.cameras.get(camera))
        else {
            return;
        };
        let name = of_scene.placement.name.clone();
        let (width, height) = self.canvas.size;
        let (view, _) = View::from_scene_camera(of_scene, width, height);
        self.camera = Some(camera);
        self.set_view(view);
        self.tell(match name {
            Some(name) => format!("camera {name}"),
            None => format!("camera {camera}"),
        });
    }

    fn toggle_shadows(&mut self) {
        if self.has_shadows() {
            self.shadows = self.settings.shadows;
            self.settings.shadows = Shadows::None;
        } else {
            self.settings.shadows = self.shadows;
        }
    }

    /// Another vertical.
    pub(super) fn set_up(&mut self, up: Up) {
        if let Some(model) = &mut self.model {
            model.up = up;
        }
        if let Some(navigator) = &mut self.navigator {
            navigator.up = up;
            navigator.level();
        }
    }

    /// Whether the view is a parallel one.
    pub fn is_parallel(&self) -> bool {
        let navigator = self.navigator.as_ref();
        navigator.is_some_and(|n| matches!(n.view.lens, Lens::Orthographic { .. }))
    }
}
