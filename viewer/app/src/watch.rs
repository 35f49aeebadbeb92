//! Watches files, and says that one of them has changed.
//!
//! Folders are watched, not files: programs that save write another file and rename it.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use notify::{EventKind, RecommendedWatcher, RecursiveMode, Watcher};

use crate::load::Wake;

/// Changes come in bursts; a file is read again when it has been left alone for so long.
const QUIET: Duration = Duration::from_millis(150);

/// Files under watch.
pub struct Watch {
    receiver: Receiver<PathBuf>,
    files: Vec<PathBuf>,
    changed: Option<Instant>,
    _watcher: RecommendedWatcher,
}

impl Watch {
    /// Watches files. `wake` is called when something happens beside them. `None` if the system
    /// cannot watch.
    pub fn new(files: &[PathBuf], wake: Wake) -> Option<Self> {
        let (sender, receiver) = channel();
        let handler = move |event: notify::Result<notify::Event>| {
            let Ok(event) = event else {
                return;
            };
            if matches!(event.kind, EventKind::Access(_)) {
                return;
            }
            for path in event.paths {
                // Nobody is there any more: nothing is to be told.
                let _ = sender.send(path);
            }
            wake();
        };
        let mut watcher = notify::recommended_watcher(handler).ok()?;
        let files: Vec<PathBuf> = files.iter().map(|file| full(file)).collect();
        let mut folders: Vec<&Path> = files.iter().filter_map(|file| file.parent()).collect();
        folders.sort_unstable();
        folders.dedup();
        for folder in folders {
            // A folder that cannot be watched is not: `F5` reads the model again.
            let _ = watcher.watch(folder, RecursiveMode::NonRecursive);
        }
        Some(Self {
            receiver,
            files,
            changed: None,
            _watcher: watcher,
        })
    }

    /// Whether a file has changed and come to rest; or how long to wait before asking again.
    pub fn poll(&mut self) -> Result<bool, Duration> {
        while let Ok(path) = self.receiver.try_recv() {
            if self.files.contains(&full(&path)) {
                self.changed = Some(Instant::now());
            }
        }
        match self.changed.map(|at| at.elapsed()) {
            None => Ok(false),
            Some(since) if since < QUIET => Err(QUIET - since),
            Some(_) => {
                self.changed = None;
                Ok(true)
            }
        }
    }
}

/// With its folder's full name; the file itself may be gone for a moment.
fn full(file: &Path) -> PathBuf {
    let folder = match file.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    match (folder.canonicalize(), file.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => file.to_owned(),
    }
}
