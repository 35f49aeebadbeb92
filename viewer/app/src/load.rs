//! Reading a model in the background: a thread that sends what it has, as soon as it has it.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, OnceLock};
use std::thread;
use std::time::Instant;

use convert::command::access::Access;
use convert::command::archive::OpenError;
use convert::command::messages::image_left_out;
use convert::command::model;
use iv_parser::Diagnostic;
use scenegraph::scene::Scene;
use viewer::gpu::{AdapterChoice, Gpu, Renderer};
use viewer::texture::Images;

use crate::cli::args::Args;
use crate::input::{self, Input};
use crate::model::{Model, Times};

/// Asks the window for a pass; any thread may.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// A device that is being made, or was.
#[derive(Clone, Default)]
pub struct Device(Arc<OnceLock<Result<Gpu, String>>>);

impl Device {
    /// Makes one in the background.
    pub fn begin(choice: AdapterChoice) -> Self {
        let device = Self::default();
        let made = device.clone();
        thread::spawn(move || {
            made.0
                .get_or_init(|| Gpu::new(choice).map_err(|error| error.to_string()));
        });
        device
    }

    /// Waits for it.
    ///
    /// # Errors
    ///
    /// Why there is none, in words.
    pub fn wait(&self) -> Result<Gpu, String> {
        self.0.wait().clone()
    }
}

/// What the thread does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Reading and parsing.
    Reading,
    /// Bringing it to the device.
    Uploading,
    /// Decoding images, while the model is shown without them.
    Textures,
}

impl Stage {
    /// As the user is told.
    pub fn text(self) -> &'static str {
        match self {
            Self::Reading => "reading",
            Self::Uploading => "uploading",
            Self::Textures => "textures",
        }
    }
}

/// What the thread sends.
pub enum Sent {
    /// It begins with something else.
    Stage(Stage),
    /// The model, without its images.
    Model(Box<Model>),
    /// All images, what is wrong with them, and what opens files. The last message.
    Images(Box<Images>, Vec<Diagnostic>, Box<model::Files>),
    /// There is no model: why, and what else is wrong with it. The last message.
    Failed(OpenError, Vec<Diagnostic>),
}

/// A model that is being read.
pub struct Loading {
    /// Its file.
    pub path: PathBuf,
    /// Since when.
    pub since: Instant,
    /// Where it is.
    pub stage: Stage,
    /// Whether it takes the place of the same file, seen from the same place.
    pub is_reload: bool,
    receiver: Receiver<Sent>,
    is_cancelled: Arc<AtomicBool>,
}

impl Loading {
    /// Begins to read. `wake` is called whenever there is something to receive.
    pub fn begin(path: &Path, args: &Args, device: &Device, is_reload: bool, wake: Wake) -> Self {
        let (sender, receiver) = channel();
        let is_cancelled = Arc::new(AtomicBool::new(false));
        let since = Instant::now();
        let worker = Worker {
            path: path.to_owned(),
            args: args.clone(),
            device: device.clone(),
            sender,
            is_cancelled: Arc::clone(&is_cancelled),
            wake,
        };
        thread::spawn(move || worker.run());
        Self {
            path: path.to_owned(),
            since,
            stage: Stage::Reading,
            is_reload,
            receiver,
            is_cancelled,
        }
    }

    /// The next message, if there is one already.
    pub fn receive(&mut self) -> Option<Sent> {
        use std::sync::mpsc::TryRecvError;
        match self.receiver.try_recv() {
            Ok(Sent::Stage(stage)) => {
                self.stage = stage;
                Some(Sent::Stage(stage))
            }
            Ok(sent) => Some(sent),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Sent::Failed(
                "reading stopped unexpectedly".to_owned().into(),
                Vec::new(),
            )),
        }
    }
}

impl Drop for Loading {
    /// The thread ends at its next stage; what it has made by then is thrown away.
    fn drop(&mut self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }
}

struct Worker {
    path: PathBuf,
    args: Args,
    device: Device,
    sender: Sender<Sent>,
    is_cancelled: Arc<AtomicBool>,
    wake: Wake,
}

impl Worker {
    fn run(self) {
        let mut diagnostics = Vec::new();
        match self.read(&mut diagnostics) {
            Ok(Some((scene, files))) => self.textures(&scene, files),
            Ok(None) => {}
            Err(why) => {
                self.send(Sent::Failed(why, diagnostics));
            }
        }
    }

    /// False if nobody waits for it any more.
    fn send(&self, sent: Sent) -> bool {
        if self.is_cancelled.load(Ordering::Relaxed) || self.sender.send(sent).is_err() {
            return false;
        }
        (self.wake)();
        true
    }

    fn read(
        &self,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<Option<(Arc<Scene>, model::Files)>, OpenError> {
        let access = Access::new(&self.args.search, &self.args.packed)?;
        let input = input::read(&self.path, &self.args, &access, diagnostics)?;
        if !self.send(Sent::Stage(Stage::Uploading)) {
            return Ok(None);
        }
        let Input {
            scene,
            format,
            up,
            files,
            read_time,
            resolve_time,
        } = input;
        if scene.instances.is_empty() {
            let message = "nothing in this model is drawn".to_owned();
            diagnostics.push(input::warning(&self.path, "no-geometry", message, ""));
        }
        let scene = Arc::new(scene);
        let waited = Instant::now();
        let gpu = self.device.wait()?;
        let waited = waited.elapsed();
        let renderer = Renderer::new(gpu, Arc::clone(&scene), &Images::none())
            .map_err(|error| error.to_string())?;
        let times = Times {
            read: read_time,
            resolve: resolve_time,
            device_wait: waited,
            upload: renderer.upload_time,
            ..Times::default()
        };
        let model = Model::new(
            &self.path,
            Arc::clone(&scene),
            renderer,
            format,
            self.args.up().unwrap_or(up),
            std::mem::take(diagnostics),
            times,
        );
        Ok(self
            .send(Sent::Model(Box::new(model)))
            .then_some((scene, files)))
    }

    fn textures(&self, scene: &Scene, files: model::Files) {
        if !scene.textures.is_empty() && !self.send(Sent::Stage(Stage::Textures)) {
            return;
        }
        let images = Images::load(scene, &model::Images(&files));
        let problems = images.problems.iter().cloned();
        let diagnostics = problems.map(|p| image_left_out(p, scene)).collect();
        self.send(Sent::Images(Box::new(images), diagnostics, Box::new(files)));
    }
}
