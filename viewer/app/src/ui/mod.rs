//! The window's contents: what is shown, and what becomes of what the user does.
//!
//! Knows no window: a host (`window`, or a test) gives it input and a device, and shows the picture
//! that [`App::picture`] names. Everything is decided anew in each pass from the state below; the
//! scene is drawn only when what is wanted of it differs from what was drawn last.

mod actions;
mod canvas;
pub mod command;
mod dialogs;
mod export;
mod help;
mod lights;
mod look;
pub mod manual;
mod measure;
mod menu;
mod messages;
mod models;
mod overlays;
mod password;
mod properties;
mod select;
mod state;
mod statistics;
mod status;
mod tree;

pub use canvas::Canvas;
pub use dialogs::Question;
pub use measure::{Measure, Measured};
pub use overlays::{Over, Section};
pub use state::{App, Counters, Notice, Start};

use std::sync::Arc;

use egui::{CentralPanel, Frame, Panel, Ui};
use egui_system_font_provider::SystemFontProvider;

/// A line of text and room around it. Where the size followed from the contents, texts that come
/// and go would change the picture's size, and it would be drawn twice at the start.
fn bar(panel: Panel) -> Panel {
    const HEIGHT_POINTS: f32 = 26.0;
    panel.exact_size(HEIGHT_POINTS)
}

impl App {
    /// One pass: takes what the threads have sent, does what is asked for, shows everything.
    pub fn show(&mut self, ui: &mut Ui) {
        self.counters.passes += 1;
        let ctx = ui.ctx().clone();
        self.receive(&ctx);
        if self.asked.is_none() {
            for command in command::pressed(&ctx) {
                self.run(command, &ctx);
            }
        }
        self.take_dropped(&ctx);
        self.learn_letters(&ctx);
        bar(Panel::top("menu")).show(ui, |ui| {
            ui.take_available_height();
            self.menu_bar(ui);
        });
        bar(Panel::bottom("status")).show(ui, |ui| {
            ui.take_available_height();
            self.status_bar(ui);
        });
        if self.config.shows_tree {
            Panel::left("model")
                .default_size(260.0)
                .show(ui, |ui| self.left_panel(ui));
        }
        if self.config.shows_settings {
            Panel::right("settings")
                .default_size(310.0)
                .show(ui, |ui| self.right_panel(ui));
        }
        CentralPanel::default()
            .frame(Frame::NONE)
            .show(ui, |ui| self.canvas(ui));
        self.help_window(&ctx);
        self.password_window(&ctx);
        self.remember();
    }

    /// Finds letters that the interface's own fonts lack, such as Chinese ones, in the fonts of the
    /// computer. Listing those takes time that the first picture needs.
    fn learn_letters(&mut self, ctx: &egui::Context) {
        if !self.knows_all_letters && self.loading.is_none() {
            self.knows_all_letters = true;
            ctx.add_font_provider(Arc::new(SystemFontProvider::new()));
        }
    }

    fn left_panel(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            ui.selectable_value(&mut self.left_tab, state::LeftTab::Model, "Model");
            let count = self.model.as_ref().map_or(0, |m| m.diagnostics.len())
                + self.failure.as_ref().map_or(0, |f| f.diagnostics.len());
            let text = match count {
                0 => "Messages".to_owned(),
                count => format!("Messages ({count})"),
            };
            ui.selectable_value(&mut self.left_tab, state::LeftTab::Messages, text);
        });
        ui.separator();
        match self.left_tab {
            state::LeftTab::Model => self.tree(ui),
            state::LeftTab::Messages => self.message_list(ui),
        }
    }

    fn right_panel(&mut self, ui: &mut Ui) {
        let width = ui.available_width() - ui.spacing().scroll.allocated_width();
        egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
            ui.set_max_width(width);
            let open = |title: &str| egui::CollapsingHeader::new(title).default_open(true);
            open("Properties").show(ui, |ui| {
                // Long values do not make the other panels wider.
                egui::ScrollArea::horizontal()
                    .id_salt("properties")
                    .max_width(width)
                    .show(ui, |ui| self.properties(ui));
            });
            if self.measure.is_active {
                open("Measure").show(ui, |ui| self.measure_panel(ui));
            }
            open("Look").show(ui, |ui| self.look(ui));
            open("Lights").show(ui, |ui| self.lights(ui));
            egui::CollapsingHeader::new("Statistics").show(ui, |ui| self.statistics(ui));
        });
    }
}
