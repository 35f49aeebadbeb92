//! Asks for the passwords of archives. They are kept until the program ends, in memory only.

use std::path::{Path, PathBuf};

use convert::command::archive::OpenError;
use egui::{Context, Id, Key, Modal, TextEdit};

use super::state::App;
use crate::cli::args::Args;

/// A question that waits for its answer.
pub struct Asked {
    path: PathBuf,
    is_reload: bool,
    password: String,
    is_again: bool,
    is_new: bool,
}

impl App {
    /// The arguments to read a file with.
    pub(super) fn args_for(&self, path: &Path) -> Args {
        let mut args = self.args.clone();
        if let Some(password) = self.passwords.get(path) {
            args.packed.password = Some(password.clone());
            args.packed.password_file = None;
        }
        args
    }

    /// Asks for a password after a file was not opened, if that can help.
    pub(super) fn ask_password(&mut self, error: &OpenError, path: &Path, is_reload: bool) {
        self.asked = match error {
            OpenError::PasswordNeeded | OpenError::PasswordWrong => Some(Asked {
                path: path.to_owned(),
                is_reload,
                password: String::new(),
                is_again: self.passwords.remove(path).is_some(),
                is_new: true,
            }),
            OpenError::Other(_) => None,
        };
    }

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
            let field = field.labelled_by(question.id);
            if std::mem::take(&mut asked.is_new) {
                field.request_focus();
            }
            is_given = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
            ui.horizontal(|ui| {
                is_given |= ui.button("Open").clicked();
                is_cancelled = ui.button("Cancel").clicked();
            });
        });
        if is_cancelled || modal.should_close() {
            self.asked = None;
        } else if is_given && let Some(asked) = self.asked.take() {
            self.passwords.insert(asked.path.clone(), asked.password);
            self.load(&asked.path, asked.is_reload);
        }
    }
}
