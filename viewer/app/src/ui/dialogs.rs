//! Questions for a file, and what is done with the answer.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::thread;

use convert::command::{atomic, bytes};
use egui::Context;
use image::RgbaImage;
use viewer::view::ivv::{self, SavedView};

use super::state::App;
use crate::cli::picture;

/// What a file is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// A model to show.
    Open,
    /// Where the picture goes.
    SavePicture,
    /// Where the scene goes.
    Export,
    /// Where what is selected goes.
    ExportSelection,
    /// A saved view.
    LoadView,
    /// Where the view goes.
    SaveView,
}

/// A question that is open.
#[derive(Default)]
pub struct Dialogs {
    open: Option<(Question, Receiver<Option<PathBuf>>)>,
}

/// What models are called.
pub const MODELS: &[&str] = &[
    "iv", "ivx", "ivl", "ivz", "ivzl", "wrl", "wrz", "vrml", "zip", "gz", "glb", "gltf",
];

impl App {
    /// Asks in a dialog of the system; the answer comes later.
    pub(super) fn ask(&mut self, question: Question) {
        if self.dialogs.open.is_some() {
            return;
        }
        let shown = self.model.as_ref().map(|m| m.path.clone());
        if shown.is_none() && question != Question::Open {
            return;
        }
        let shown = shown.unwrap_or_default();
        let stem = shown
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let mut dialog = rfd::AsyncFileDialog::new();
        if let Some(folder) = shown.parent().and_then(|f| f.canonicalize().ok()) {
            dialog = dialog.set_directory(folder);
        }
        let (sender, receiver) = channel();
        let wake = Arc::clone(&self.wake);
        let answer: std::pin::Pin<Box<dyn Future<Output = Option<rfd::FileHandle>> + Send>> =
            match question {
                Question::Open => Box::pin(
                    dialog
                        .add_filter("Models", MODELS)
                        .add_filter("All files", &["*"])
                        .pick_file(),
                ),
                Question::LoadView => Box::pin(dialog.add_filter("Views", &["ivv"]).pick_file()),
                Question::SaveView => Box::pin(
                    dialog
                        .add_filter("Views", &["ivv"])
                        .set_file_name(format!("{stem}.ivv"))
                        .save_file(),
                ),
                Question::SavePicture => Box::pin(
                    dialog
                        .add_filter("PNG", &["png"])
                        .set_file_name(format!("{stem}.png"))
                        .save_file(),
                ),
                Question::Export | Question::ExportSelection => Box::pin(
                    dialog
                        .add_filter("glTF", &["glb", "gltf"])
                        .add_filter("Inventor", &["iv"])
                        .add_filter("Web page", &["html"])
                        .set_file_name(format!("{stem}.glb"))
                        .save_file(),
                ),
            };
        thread::spawn(move || {
            let file = pollster::block_on(answer).map(|handle| handle.path().to_owned());
            // If the window is gone nobody waits for the answer.
            let _ = sender.send(file);
            wake();
        });
        self.dialogs.open = Some((question, receiver));
    }

    pub(super) fn take_answer(&mut self) {
        use std::sync::mpsc::TryRecvError;
        let Some((question, receiver)) = &self.dialogs.open else {
            return;
        };
        let question = *question;
        match receiver.try_recv() {
            Ok(answer) => {
                self.dialogs.open = None;
                if let Some(path) = answer {
                    self.answered(question, &path);
                }
            }
            Err(TryRecvError::Disconnected) => self.dialogs.open = None,
            Err(TryRecvError::Empty) => {}
        }
    }

    /// Does what a file was asked for.
    pub fn answered(&mut self, question: Question, path: &Path) {
        let done = match question {
            Question::Open => {
                self.open(path);
                return;
            }
            Question::LoadView => self.load_view(path),
            Question::SaveView => self.save_view(path),
            Question::SavePicture => self.save_picture(path),
            Question::Export => self.export(path, false),
            Question::ExportSelection => self.export(path, true),
        };
        match done {
            Ok(text) => self.tell(text),
            Err(why) => self.fail(why),
        }
    }

    /// Opens the files that were dropped on the window: a saved view is looked through, all else
    /// is read.
    pub(super) fn take_dropped(&mut self, ctx: &Context) {
        let dropped = ctx.input(|i| i.raw.dropped_files.clone());
        let paths: Vec<PathBuf> = dropped.iter().map(|f| f.path().to_owned()).collect();
        for path in &paths {
            let is_view = path
                .extension()
                .is_some_and(|e| e.eq_ignore_ascii_case("ivv"));
            let question = if is_view {
                Question::LoadView
            } else {
                Question::Open
            };
            self.answered(question, path);
        }
    }

    fn load_view(&mut self, path: &Path) -> Result<String, String> {
        let named = |why: String| format!("{}: {why}", path.display());
        let content = bytes::read(path).map_err(named)?;
        let saved = ivv::read(&content).map_err(|error| named(error.to_string()))?;
        let view = saved
            .view()
            .ok_or_else(|| named("it has no direction".to_owned()))?;
        self.set_view(view);
        if let Some(navigator) = &mut self.navigator {
            navigator.set_pivot_depth(saved.look_at);
        }
        Ok(match saved.name.as_str() {
            "" => format!("view of {}", path.display()),
            name => format!("view {name}"),
        })
    }

    fn save_view(&mut self, path: &Path) -> Result<String, String> {
        let navigator = self.navigator.as_ref().ok_or("there is no view to save")?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let saved = SavedView::new(&navigator.view, navigator.distance, &name)
            .ok_or("saved views hold perspective views only: press P first")?;
        let text = saved.write();
        atomic::write(path, |out| out.write_all(text.as_bytes()))
            .map_err(|error| atomic::cannot_write(path, &error))?;
        Ok(format!("view saved to {}", path.display()))
    }

    /// The picture as it is drawn, at a size of the user's or that of the window.
    fn picture_at(&mut self, size: (u32, u32)) -> Result<RgbaImage, String> {
        let navigator = self.navigator.as_ref().ok_or("nothing is shown")?;
        let model = self.model.as_mut().ok_or("nothing is shown")?;
        let region = viewer::view::Region::whole(size.0, size.1);
        let drawn = model
            .renderer
            .draw(&navigator.view, &region, size, &self.settings);
        let pixels = drawn.and_then(|_| model.renderer.read());
        // The window draws its own size again.
        self.canvas.forget();
        let pixels = pixels.map_err(|error| error.to_string())?;
        RgbaImage::from_raw(size.0, size.1, pixels)
            .ok_or_else(|| "the graphics device gave a picture of another size".to_owned())
    }

    fn save_picture(&mut self, path: &Path) -> Result<String, String> {
        let size = self.picture_size.unwrap_or(self.canvas.size);
        picture::write(path, &self.picture_at(size)?)?;
        let (width, height) = size;
        Ok(format!(
            "picture of {width}x{height} saved to {}",
            path.display()
        ))
    }

    pub(super) fn copy_picture(&mut self, ctx: &Context) {
        match self.picture_at(self.canvas.size) {
            Ok(picture) => {
                let size = [picture.width() as usize, picture.height() as usize];
                ctx.copy_image(egui::ColorImage::from_rgba_unmultiplied(size, &picture));
                self.tell("picture copied".to_owned());
            }
            Err(why) => self.fail(why),
        }
    }
}
