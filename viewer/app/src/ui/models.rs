//! How models come and go: opened, read again, taken over, lost with their device.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use convert::command::archive::OpenError;
use egui::Context;
use iv_parser::Diagnostic;

use super::overlays::Overlays;
use super::state::{App, Failure, LeftTab};
use crate::cli::camera::Viewpoint;
use crate::load::{Device, Loading, Sent};
use crate::model::Model;
use crate::watch::Watch;

/// Devices that are lost in a row before no further one is made.
const MOST_LOST: u32 = 3;

/// For so long after the start a window stays empty if its model may come in this time: painting would
/// take the processor from reading it where there is no graphics card.
const FIRST_WAIT: Duration = Duration::from_millis(600);

impl App {
    /// Reads a file, and shows it when it is there. What is shown stays until then.
    pub fn open(&mut self, path: &Path) {
        match self.files.iter().position(|file| file == path) {
            Some(at) => self.file = at,
            None => {
                self.files.push(path.to_owned());
                self.file = self.files.len() - 1;
            }
        }
        self.load(path, false);
    }

    /// Reads the file again that is shown, or could not be read.
    pub fn reload(&mut self) {
        let failed = self.failure.as_ref().map(|failure| failure.path.clone());
        let shown = self.model.as_ref().map(|model| model.path.clone());
        if let Some(path) = shown.or(failed) {
            self.load(&path, true);
        }
    }

    pub(super) fn load(&mut self, path: &Path, is_reload: bool) {
        let wake = Arc::clone(&self.wake);
        let args = self.args_for(path);
        let loading = Loading::begin(path, &args, &self.device, is_reload, wake);
        self.loading = Some(loading);
    }

    /// Whether the first model is still being read, so soon after the start that nobody misses a
    /// picture of nothing; takes what has been sent. The time until that is over.
    pub fn first_wait(&mut self, ctx: &Context) -> Option<Duration> {
        self.receive(ctx);
        let is_first = self.model.is_none() && self.failure.is_none() && self.loading.is_some();
        FIRST_WAIT
            .checked_sub(self.since.elapsed())
            .filter(|_| is_first)
    }

    /// Takes what threads have sent.
    pub(super) fn receive(&mut self, ctx: &Context) {
        while let Some(sent) = self.loading.as_mut().and_then(Loading::receive) {
            match sent {
                Sent::Stage(_) => {}
                Sent::Model(model) => self.take_model(*model),
                Sent::Images(images, diagnostics, files) => {
                    self.loading = None;
                    if let Some(model) = &mut self.model {
                        model.set_images(&images, diagnostics);
                        model.loader = Some(*files);
                    }
                }
                Sent::Failed(why, diagnostics) => self.take_failure(&why, diagnostics),
            }
        }
        if let Some(watch) = &mut self.watch {
            match watch.poll() {
                Ok(false) => {}
                Ok(true) => self.reload(),
                Err(wait) => ctx.request_repaint_after(wait),
            }
        }
        self.take_answer();
    }

    fn take_model(&mut self, model: Model) {
        let is_reload = self.loading.as_ref().is_some_and(|l| l.is_reload)
            && self.model.as_ref().is_none_or(|m| m.path == model.path)
            && self.navigator.is_some();
        if self.failure.take().is_some() {
            self.left_tab = LeftTab::Model;
        }
        self.notice = None;
        self.asked = None;
        self.watch = Watch::new(&model.files, Arc::clone(&self.wake));
        if !is_reload {
            self.camera = None;
            self.navigator = None;
            self.selected = None;
            self.measure.points.clear();
            self.over.section = None;
            self.first_view = Some(self.viewpoint(&model));
            self.config.remember(&model.path);
        }
        let selected = self.selected.and_then(|row| self.name_of(row));
        let hidden = self.hidden_names();
        self.open_rows = vec![false; model.outline.rows.len()];
        self.model = Some(model);
        self.overlays = Overlays::default();
        self.canvas.forget();
        self.take_over(selected, &hidden);
    }

    /// Where a model is seen from at first: as the command line says for its first model, else by
    /// its first camera, else all of it.
    fn viewpoint(&mut self, model: &Model) -> Viewpoint {
        let is_first = std::mem::replace(&mut self.is_first, false);
        let wanted = self.args.camera.clone().filter(|_| is_first);
        if is_first && let Some(path) = &self.args.view {
            match Viewpoint::saved(path) {
                Ok(viewpoint) => return viewpoint,
                Err(why) => self.fail(why),
            }
        }
        Viewpoint::choose(&model.scene, wanted.as_deref(), model.up).unwrap_or_else(|why| {
            self.fail(why);
            Viewpoint::Whole(model.up)
        })
    }

    fn take_failure(&mut self, why: &OpenError, diagnostics: Vec<Diagnostic>) {
        let Some(loading) = self.loading.take() else {
            return;
        };
        let kept = if self.model.is_some() {
            "; what was shown before stays"
        } else {
            ""
        };
        self.fail(format!("{}: {why}{kept}", loading.path.display()));
        self.ask_password(why, &loading.path, loading.is_reload);
        if self.model.is_none() {
            let file = std::slice::from_ref(&loading.path);
            self.watch = Watch::new(file, Arc::clone(&self.wake));
        }
        self.left_tab = LeftTab::Messages;
        self.failure = Some(Failure {
            path: loading.path.clone(),
            diagnostics,
        });
    }

    /// The device is gone, or refused something: another one, and the model again.
    pub(super) fn recover(&mut self, why: &str) {
        self.counters.lost += 1;
        self.lost_in_a_row += 1;
        let path = self.model.take().map(|model| model.path);
        self.canvas.forget();
        if self.lost_in_a_row > MOST_LOST {
            self.fail(format!("{why}; open the model again to try once more"));
            return;
        }
        self.fail(format!("{why}; it is made anew"));
        self.device = Device::begin(self.args.adapter());
        self.device_revision += 1;
        if let Some(path) = path {
            self.load(&path, true);
        }
    }
}
