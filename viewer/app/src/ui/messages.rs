//! The list of what is wrong with the model.

use egui::{Color32, RichText, ScrollArea, Ui};
use iv_parser::{Diagnostic, Severity};

use super::state::App;

impl App {
    pub(super) fn message_list(&self, ui: &mut Ui) {
        let failed = self.failure.as_ref().map_or(&[][..], |f| &f.diagnostics);
        let shown = self.model.as_ref().map_or(&[][..], |m| &m.diagnostics);
        if failed.is_empty() && shown.is_empty() {
            ui.weak("Nothing is wrong.");
            return;
        }
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            if let Some(failure) = &self.failure {
                ui.strong(format!("{} was not read", failure.path.display()));
            }
            for diagnostic in failed.iter().chain(shown) {
                message(ui, diagnostic);
            }
        });
    }
}

fn message(ui: &mut Ui, diagnostic: &Diagnostic) {
    let (word, color) = match diagnostic.severity {
        Severity::Error => ("error", Color32::from_rgb(0xe0, 0x50, 0x40)),
        Severity::Warning => ("warning", Color32::from_rgb(0xd0, 0x90, 0x20)),
        Severity::Note => ("note", ui.visuals().weak_text_color()),
    };
    let place = match diagnostic.pos.line {
        0 => diagnostic.file.to_string(),
        line => format!("{}:{line}:{}", diagnostic.file, diagnostic.pos.column),
    };
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(word).color(color));
        ui.monospace(format!("[{}]", diagnostic.code));
        ui.weak(place);
    });
    ui.label(&diagnostic.message);
    if let Some(snippet) = &diagnostic.snippet {
        ui.monospace(&snippet.line);
        let before = " ".repeat(snippet.start);
        ui.monospace(format!("{before}{}", "^".repeat(snippet.len)));
    }
    if !diagnostic.hint.is_empty() {
        ui.weak(&diagnostic.hint);
    }
    ui.separator();
}
