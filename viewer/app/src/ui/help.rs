//! The cheat sheet.

use egui::{Context, Grid, Key, KeyboardShortcut, Window};

use super::command::{ALL, MOUSE, Menu};
use super::state::App;

/// A key as it stands on keyboards.
pub(super) fn key_text(ctx: &Context, key: &KeyboardShortcut) -> String {
    if key.logical_key == Key::Questionmark {
        return "?".to_owned();
    }
    ctx.format_shortcut(key)
}

impl App {
    pub(super) fn help_window(&mut self, ctx: &Context) {
        let mut is_open = self.shows_help;
        Window::new("Keys and mouse")
            .open(&mut is_open)
            .resizable(false)
            .default_pos([320.0, 60.0])
            .show(ctx, |ui| {
                ui.horizontal_top(|ui| {
                    let columns: [&[Menu]; 2] = [
                        &[Menu::File, Menu::View],
                        &[Menu::Show, Menu::Select, Menu::Help],
                    ];
                    for (column, menus) in columns.into_iter().enumerate() {
                        Grid::new(("keys", column)).striped(true).show(ui, |ui| {
                            let listed = ALL.iter().filter(|e| menus.contains(&e.menu));
                            for entry in listed {
                                let Some(key) = &entry.key else {
                                    continue;
                                };
                                ui.strong(key_text(ctx, key));
                                ui.label(entry.text);
                                ui.end_row();
                            }
                        });
                        ui.separator();
                    }
                    Grid::new("mouse").striped(true).show(ui, |ui| {
                        for (what, does) in MOUSE {
                            ui.strong(*what);
                            ui.label(*does);
                            ui.end_row();
                        }
                    });
                });
            });
        self.shows_help = is_open;
    }
}
