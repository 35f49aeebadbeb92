//! The panel of lights.

use egui::{DragValue, Grid, Ui};
use viewer::content::{LightEdit, LightShape};

use super::look::named;
use super::state::App;

impl App {
    pub(super) fn lights(&mut self, ui: &mut Ui) {
        let mut headlight = self.has_headlight();
        if ui.checkbox(&mut headlight, "Headlight").changed() {
            self.settings.headlight = if headlight {
                viewer::frame::Headlight::On
            } else {
                viewer::frame::Headlight::Off
            };
        }
        let Some(model) = &mut self.model else {
            return;
        };
        let count = model.scene.lights.len();
        let mut edits = model.edits.clone();
        edits.lights.resize(count, LightEdit::default());
        let before = edits.clone();
        ui.horizontal(|ui| {
            ui.label("Ambient ×");
            let drag = DragValue::new(&mut edits.ambient_factor)
                .speed(0.01)
                .range(0.0..=10.0);
            named(&ui.add(drag), "Ambient light");
        });
        Grid::new("lights").num_columns(3).show(ui, |ui| {
            let lights = model.renderer.content().lights.iter();
            for (i, (light, edit)) in lights.zip(&mut edits.lights).enumerate() {
                let name = match &light.name {
                    Some(name) => name.to_string(),
                    None => format!("Light {i}"),
                };
                ui.checkbox(&mut edit.is_on, &name);
                ui.weak(match light.shape {
                    LightShape::Directional { .. } => "directional",
                    LightShape::Point { .. } => "point",
                    LightShape::Spot { .. } => "spot",
                });
                let factor = DragValue::new(&mut edit.factor)
                    .speed(0.01)
                    .range(0.0..=100.0);
                let factor = ui.add_enabled(edit.is_on, factor.prefix("× "));
                named(&factor, &format!("Intensity of {name}"));
                ui.end_row();
            }
        });
        if count == 0 {
            ui.weak("The model has no lights.");
        }
        // Writing down what is so anyway would bring the scene to the device again.
        if edits != before {
            model.edit(|now| *now = edits);
        }
    }
}
