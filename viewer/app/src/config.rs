//! What the window remembers from one time to the next: a small JSON file of the user's.
//!
//! A file that cannot be read is as good as none; one that cannot be written is no reason to stop.

use std::path::{Path, PathBuf};

use convert::command::atomic;
use serde::{Deserialize, Serialize};

/// Files that are remembered at most.
const RECENT: usize = 12;

/// What is remembered. What a file lacks is as at first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Config {
    /// Width and height of the window, points.
    pub window: [f32; 2],
    /// The window's top left corner on the screens, pixels.
    pub place: Option<[i32; 2]>,
    /// Whether it fills the screen.
    pub is_maximized: bool,
    /// Files that were opened, the last one first.
    pub recent: Vec<PathBuf>,
    /// Dark colours.
    pub is_dark: bool,
    /// Whether the tree of the model is shown.
    pub shows_tree: bool,
    /// Whether the panel of settings is shown.
    pub shows_settings: bool,
    /// Colours behind the model, top and bottom.
    pub background_srgb: Option<[[f64; 3]; 2]>,
    /// Samples a pixel.
    pub samples: Option<u32>,
    /// Whether dragging rolls the model as a ball.
    pub rolls: bool,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            window: [1280.0, 800.0],
            place: None,
            is_maximized: false,
            recent: Vec::new(),
            is_dark: true,
            shows_tree: true,
            shows_settings: true,
            background_srgb: None,
            samples: None,
            rolls: false,
        }
    }
}

impl Config {
    /// Where it is kept, if the system has a place for such files.
    pub fn path() -> Option<PathBuf> {
        Some(dirs::config_dir()?.join("ivory").join("ivview.json"))
    }

    /// What is in a file, or the first settings.
    pub fn read(path: &Path) -> Self {
        let text = std::fs::read(path).unwrap_or_default();
        let config: Self = serde_json::from_slice(&text).unwrap_or_default();
        Self {
            // A window of no size could not be found again.
            window: config.window.map(|side| {
                if side >= 200.0 {
                    side.min(16_384.0)
                } else {
                    800.0
                }
            }),
            ..config
        }
    }

    /// Keeps it.
    ///
    /// # Errors
    ///
    /// In words, when the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), String> {
        let document = serde_json::to_value(self).map_err(|error| error.to_string())?;
        atomic::make_folder_of(path)?;
        atomic::write_json(path, &document).map(|_| ())
    }

    /// Remembers a file as the last one opened.
    pub fn remember(&mut self, file: &Path) {
        let file = file.canonicalize().unwrap_or_else(|_| file.to_owned());
        self.recent.retain(|known| *known != file);
        self.recent.insert(0, file);
        self.recent.truncate(RECENT);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_kept_and_survives_damage() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep").join("ivview.json");
        let mut config = Config {
            window: [640.0, 480.0],
            place: Some([-1200, 30]),
            is_dark: false,
            background_srgb: Some([[0.25; 3], [1.0, 0.5, 0.0]]),
            ..Config::default()
        };
        for i in 0..20 {
            config.remember(Path::new(&format!("gone/{i}.iv")));
        }
        config.remember(Path::new("gone/15.iv"));
        assert_eq!(config.recent.len(), 12);
        assert_eq!(
            config.recent[..2],
            ["gone/15.iv", "gone/19.iv"].map(PathBuf::from)
        );
        config.write(&path).unwrap();
        assert_eq!(Config::read(&path), config);
        for damage in [
            "",
            "{",
            "[]",
            "{\"window\": [1e99, -3], \"future\": 1}",
            "{\"recent\": 3}",
        ] {
            std::fs::write(&path, damage).unwrap();
            let config = Config::read(&path);
            assert!(
                config
                    .window
                    .iter()
                    .all(|side| (200.0..=16_384.0).contains(side))
            );
        }
        assert_eq!(Config::read(Path::new("nowhere.json")), Config::default());
    }
}
