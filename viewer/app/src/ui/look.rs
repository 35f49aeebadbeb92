//! The panel of how things look.

use egui::{ComboBox, DragValue, Response, Ui};
use viewer::content::FaceEdit;
use viewer::frame::{Extraction, Shadows, VolumeMethod};
use viewer::view::framing::Up;

use super::command::Command;
use super::state::App;
use crate::cli::background;

/// Gives a widget without a text a name for those who do not see it.
pub(super) fn named(response: &Response, name: &str) {
    response
        .ctx
        .accesskit_node_builder(response.id, |node| node.set_label(name));
}

/// The techniques, by the words of `--shadows`.
const TECHNIQUES: [(&str, Shadows); 5] = [
    (
        "Volumes",
        Shadows::Volumes {
            method: VolumeMethod::Silhouette,
            extraction: Extraction::Auto,
        },
    ),
    (
        "Volumes of each triangle",
        Shadows::Volumes {
            method: VolumeMethod::PerTriangle,
            extraction: Extraction::Auto,
        },
    ),
    ("Map", Shadows::Map { size: 2048 }),
    ("Map 8k", Shadows::Map { size: 8192 }),
    ("Rays", Shadows::Rays),
];

impl App {
    pub(super) fn look(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let mut shadows = self.has_shadows();
        ui.horizontal(|ui| {
            if ui.checkbox(&mut shadows, "Shadows").changed() {
                self.run(Command::Shadows, &ctx);
            }
            self.techniques(ui);
        });
        ui.horizontal(|ui| {
            ui.label("Samples");
            for samples in [1, 4] {
                ui.selectable_value(&mut self.settings.samples, samples, samples.to_string());
            }
        });
        self.overlay_switches(ui);
        self.section(ui);
        self.faces(ui);
        self.backgrounds(ui);
        if let Some(model) = &self.model {
            let mut up = model.up;
            ui.horizontal(|ui| {
                ui.label("Up");
                ui.selectable_value(&mut up, Up::Z, "+Z");
                ui.selectable_value(&mut up, Up::Y, "+Y");
            });
            if up != model.up {
                self.set_up(up);
            }
        }
        self.picture_sizes(ui);
    }

    fn techniques(&mut self, ui: &mut Ui) {
        let mut wanted = self.shadows;
        let known = TECHNIQUES.iter().find(|(_, shadows)| *shadows == wanted);
        let text = known.map_or("Other", |(text, _)| text);
        let choice = ComboBox::from_id_salt("technique")
            .selected_text(text)
            .show_ui(ui, |ui| {
                for (text, shadows) in TECHNIQUES {
                    ui.selectable_value(&mut wanted, shadows, text);
                }
            });
        named(&choice.response, "How shadows are made");
        if wanted != self.shadows {
            self.shadows = wanted;
            self.settings.shadows = wanted;
        }
    }

    fn faces(&mut self, ui: &mut Ui) {
        let Some(model) = &mut self.model else {
            return;
        };
        let mut faces = model.edits.faces;
        ui.horizontal(|ui| {
            ui.label("Faces");
            ui.selectable_value(&mut faces, FaceEdit::AsIs, "as they are");
            ui.selectable_value(&mut faces, FaceEdit::Both, "both");
            ui.selectable_value(&mut faces, FaceEdit::FrontOnly, "front");
        });
        model.edit(|edits| edits.faces = faces);
    }

    fn backgrounds(&mut self, ui: &mut Ui) {
        let colors = &mut self.settings.background_srgb;
        ui.horizontal(|ui| {
            ui.label("Background");
            for color in colors.iter_mut() {
                let mut srgb = color.map(|c| (c * 255.0).round() as u8);
                if ui.color_edit_button_srgb(&mut srgb).changed() {
                    *color = srgb.map(|c| f64::from(c) / 255.0);
                }
            }
            let choice = ComboBox::from_id_salt("background")
                .selected_text("named")
                .show_ui(ui, |ui| {
                    for (name, color) in background::NAMED {
                        if ui.button(name).clicked() {
                            *colors = [color; 2];
                        }
                    }
                });
            named(&choice.response, "Named backgrounds");
        });
    }

    fn picture_sizes(&mut self, ui: &mut Ui) {
        let mut is_own = self.picture_size.is_some();
        ui.horizontal(|ui| {
            ui.checkbox(&mut is_own, "Saved pictures of");
            let mut size = self.picture_size.unwrap_or(self.canvas.size);
            let width = ui.add_enabled(is_own, DragValue::new(&mut size.0).range(1..=8192));
            named(&width, "Width of saved pictures");
            ui.label("×");
            let height = ui.add_enabled(is_own, DragValue::new(&mut size.1).range(1..=8192));
            named(&height, "Height of saved pictures");
            self.picture_size = is_own.then_some(size);
        });
    }
}
