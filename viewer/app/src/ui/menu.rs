//! The menus, made from the table of commands.

use egui::{Button, MenuBar, Ui};

use super::command::{ALL, Command, Menu};
use super::help::key_text;
use super::state::App;

impl App {
    pub(super) fn menu_bar(&mut self, ui: &mut Ui) {
        MenuBar::new().ui(ui, |ui| {
            for (menu, title) in [
                (Menu::File, "File"),
                (Menu::View, "View"),
                (Menu::Show, "Show"),
                (Menu::Select, "Select"),
                (Menu::Help, "Help"),
            ] {
                ui.menu_button(title, |ui| self.menu(ui, menu));
            }
        });
    }

    fn menu(&mut self, ui: &mut Ui, menu: Menu) {
        let ctx = ui.ctx().clone();
        for entry in ALL.iter().filter(|entry| entry.menu == menu) {
            let mut button = Button::new(entry.text);
            if let Some(key) = &entry.key {
                button = button.shortcut_text(key_text(&ctx, key));
            }
            if let Some(is_on) = self.is_on(entry.command) {
                button = button.selected(is_on);
            }
            if ui.add(button).clicked() {
                self.run(entry.command, &ctx);
                ui.close();
            }
            match entry.command {
                Command::Open => self.recent_menu(ui),
                Command::NextCamera => self.camera_menu(ui),
                _ => {}
            }
        }
        if menu == Menu::Show && ui.button("Light or dark").clicked() {
            self.config.is_dark ^= true;
            ctx.set_theme(if self.config.is_dark {
                egui::Theme::Dark
            } else {
                egui::Theme::Light
            });
        }
    }

    fn recent_menu(&mut self, ui: &mut Ui) {
        ui.menu_button("Open recent", |ui| {
            if self.config.recent.is_empty() {
                ui.weak("nothing yet");
            }
            for path in self.config.recent.clone() {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                let button = ui.button(name).on_hover_text(path.display().to_string());
                if button.clicked() {
                    self.open(&path);
                    ui.close();
                }
            }
        });
    }

    fn camera_menu(&mut self, ui: &mut Ui) {
        let Some(model) = &self.model else {
            return;
        };
        let cameras = model.scene.cameras.iter().enumerate();
        let names: Vec<String> = cameras
            .map(|(i, camera)| match &camera.placement.name {
                Some(name) => name.to_string(),
                None => format!("Camera {i}"),
            })
            .collect();
        if names.is_empty() {
            return;
        }
        ui.menu_button("Cameras of the file", |ui| {
            for (i, name) in names.iter().enumerate() {
                if ui.selectable_label(self.camera == Some(i), name).clicked() {
                    self.look_through(i);
                    ui.close();
                }
            }
        });
    }

    /// Whether a command that switches something has switched it on.
    pub(super) fn is_on(&self, command: Command) -> Option<bool> {
        Some(match command {
            Command::Shadows => self.has_shadows(),
            Command::Headlight => self.has_headlight(),
            Command::ChangeLens => self.is_parallel(),
            Command::Tree => self.config.shows_tree,
            Command::Settings => self.config.shows_settings,
            Command::Measure => self.measure.is_active,
            _ => return self.is_over(command),
        })
    }
}
