//! The tree of the model, with a search.

use egui::{ScrollArea, TextEdit, Ui};

use super::state::App;

impl App {
    /// Looks for names in the tree.
    pub fn search(&mut self, text: &str) {
        text.clone_into(&mut self.search);
    }

    pub(super) fn tree(&mut self, ui: &mut Ui) {
        ui.add(TextEdit::singleline(&mut self.search).hint_text("Search names"));
        let rows = self.visible_rows();
        let height = ui.spacing().interact_size.y;
        let mut area = ScrollArea::both().auto_shrink(false);
        if std::mem::take(&mut self.reveals_selection)
            && let Some(at) = rows.iter().position(|&row| Some(row) == self.selected)
        {
            let step = height + ui.spacing().item_spacing.y;
            let middle = ui.available_height() * 0.5;
            area = area.vertical_scroll_offset((at as f32 * step - middle).max(0.0));
        }
        area.show_rows(ui, height, rows.len(), |ui, range| {
            for &row in &rows[range] {
                self.tree_row(ui, row);
            }
        });
    }

    /// The rows to be seen: those in open groups, or those that are searched for.
    fn visible_rows(&self) -> Vec<usize> {
        let Some(model) = &self.model else {
            return Vec::new();
        };
        let all = &model.outline.rows;
        if !self.search.is_empty() {
            let wanted = self.search.to_lowercase();
            let is_found = |&row: &usize| all[row].label.to_lowercase().contains(&wanted);
            return (0..all.len()).filter(is_found).collect();
        }
        let mut rows = Vec::new();
        let mut row = 0;
        while row < all.len() {
            rows.push(row);
            row = if self.open_rows[row] {
                row + 1
            } else {
                all[row].end
            };
        }
        rows
    }

    fn tree_row(&mut self, ui: &mut Ui, row: usize) {
        let Some(model) = &self.model else {
            return;
        };
        let entry = model.outline.rows[row].clone();
        let is_group = entry.end > row + 1;
        let is_flat = !self.search.is_empty();
        ui.horizontal(|ui| {
            if !is_flat {
                ui.add_space(entry.depth as f32 * 12.0);
            }
            let mut is_shown = self.is_shown(row);
            if ui
                .checkbox(&mut is_shown, "")
                .on_hover_text("shown")
                .changed()
            {
                self.set_shown(row, is_shown);
            }
            if is_group && !is_flat {
                let sign = if self.open_rows[row] { "−" } else { "+" };
                if ui.small_button(sign).clicked() {
                    self.open_rows[row] ^= true;
                }
            }
            let is_selected = self.selected == Some(row);
            let label = ui.selectable_label(is_selected, &entry.label);
            if label.clicked() {
                self.selected = Some(row);
            }
            if label.double_clicked() {
                let ctx = ui.ctx().clone();
                self.run(super::command::Command::ZoomSelection, &ctx);
            }
            if let Some(class) = &entry.class {
                ui.weak(class);
            }
        });
    }
}
