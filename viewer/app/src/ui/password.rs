//! Asks for the password of an archive. It is kept until the program ends, in memory only.

use std::path::{Path, PathBuf};

use convert::command::archive::OpenError;
use egui::{Context, Id, Key, Modal, TextEdit};

use super::state::App;

/// A question that waits for its answer.
pub struct Asked {
    path: PathBuf,
    password: String,
    is_again: bool,
}

impl Asked {
    /// What to ask after a file was not opened, if an answer can help.
    pub(super) fn after(error: &OpenError, path: &Path) -> Option<Self> {
        let is_again = match error {
            OpenError::PasswordNeeded => false,
            OpenError::PasswordWrong => true,
            OpenError::Other(_) => return None,
        };
        Some(Self {
            path: path.to_owned(),
            password: String::new(),
            is_again,
        })
    }
}

impl App {
    pub(super) fn password_window(&mut self, ctx: &Context) {
        let Some(asked) = &mut self.asked else {
            return;
        };
        let name = asked.path.file_name().unwrap_or_default().to_string_lossy();
        let (mut is_given, mut is_cancelled) = (false, false);
        let modal = Modal::new(Id::unique("password")).show(ctx, |ui| {
            ui.set_width(280.0);
            ui.heading("Password");
            let question = ui.label(if asked.is_again {
                format!("That was not the password of {name}.")
            } else {
                format!("{name} takes a password.")
            });
            let field = ui.add(TextEdit::singleline(&mut asked.password).password(true));
            field.labelled_by(question.id).request_focus();
            is_given = ui.input(|i| i.key_pressed(Key::Enter));
            ui.horizontal(|ui| {
                is_given |= ui.button("Open").clicked();
                is_cancelled = ui.button("Cancel").clicked();
            });
        });
        if is_cancelled || modal.should_close() {
            self.asked = None;
        } else if is_given && let Some(asked) = self.asked.take() {
            self.args.packed.password = Some(asked.password);
            self.args.packed.password_file = None;
            self.load(&asked.path, false);
        }
    }
}
