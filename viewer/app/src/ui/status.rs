//! The line below: what is being done, what was done last, what is below the mouse.

use std::time::Duration;

use egui::{Color32, Ui};

use super::state::App;

/// How often the time is shown that a reading has taken.
const TICK: Duration = Duration::from_millis(500);

impl App {
    pub(super) fn status_bar(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            let mut is_cancelled = false;
            if let Some(loading) = &self.loading {
                // Nothing that moves: painting it would slow down a reading that it waits for.
                ui.ctx().request_repaint_after(TICK);
                let name = loading.path.file_name().unwrap_or_default();
                let seconds = loading.since.elapsed().as_secs_f64();
                ui.label(format!(
                    "{}: {} ({seconds:.1} s)",
                    name.to_string_lossy(),
                    loading.stage.text()
                ));
                is_cancelled = ui.small_button("Cancel").clicked();
            }
            if is_cancelled {
                self.loading = None;
                self.tell("reading was cancelled".to_owned());
            }
            if let Some(notice) = &self.notice {
                if notice.is_error {
                    ui.colored_label(Color32::from_rgb(0xe0, 0x50, 0x40), &notice.text);
                } else {
                    ui.label(&notice.text);
                }
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if let Some((_, report)) = &self.canvas.last {
                    let took = report.plan
                        + report.shadows
                        + report.encode
                        + report.occlusion
                        + report.draw;
                    ui.weak(format!("{:.1} ms", took.as_secs_f64() * 1e3));
                }
                if let Some(p) = self.canvas.below {
                    ui.monospace(format!("{:.3}  {:.3}  {:.3}", p.x, p.y, p.z));
                }
            });
        });
    }
}
