//! The corpus of real files beside the repository, and what Coin 4.0 makes of each.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde_json::Value;

/// What `SoCallbackAction` gives for one kind of shape, in the world.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counts {
    /// Triangles.
    pub triangles: usize,
    /// Segments.
    pub lines: usize,
    /// Points.
    pub points: usize,
    /// Of all triangles.
    pub area: f64,
    /// Signed, about the origin.
    pub volume: f64,
    /// Of all segments.
    pub length: f64,
    /// Sum of area times dot of geometric and mean vertex normal.
    pub normal_dot: f64,
    /// Triangles with texture coordinates.
    pub textured: usize,
    /// Sums of the texture coordinates, before texture transforms.
    pub texcoord_sum: [f64; 2],
    /// Lower corner, then upper corner.
    pub bounds: Option<[f64; 6]>,
}

impl Counts {
    /// Whether there is anything.
    pub fn is_empty(&self) -> bool {
        self.triangles + self.lines + self.points == 0
    }
}

/// One file and its reference results.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Relative to the corpus's `files`, with `/`.
    pub path: String,
    /// The first line.
    pub header: String,
    /// Coin read it.
    pub coin_ok: bool,
    /// Coin's first messages.
    pub errors: Vec<String>,
    /// Face, line and point sets.
    pub explicit: Counts,
    /// Sphere, Cone, Cylinder and Cube.
    pub analytic: Counts,
    /// Text.
    pub text: Counts,
    /// NURBS.
    pub nurbs: Counts,
    /// Different diffuse colours at corners of triangles.
    pub colors: usize,
    /// Different transparencies there.
    pub transparencies: usize,
    /// Lights that are on.
    pub lights: usize,
    /// Cameras.
    pub cameras: usize,
}

/// The corpus's folder, or `None` with a loud line when it is not there.
pub fn folder() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/corpus");
    if folder.join("oracle.jsonl").is_file() {
        return Some(folder);
    }
    // Written past the test harness, which hides what passing tests print.
    let line = format!("SKIPPED: no corpus at {}\n", folder.display());
    let _ = io::stderr().write_all(line.as_bytes());
    None
}

/// All entries of a corpus.
///
/// # Errors
///
/// When the list cannot be read.
pub fn entries(folder: &Path) -> Result<Vec<Entry>, String> {
    let text = fs::read_to_string(folder.join("oracle.jsonl")).map_err(|e| e.to_string())?;
    let entry = |line: &str| {
        let value: Value = serde_json::from_str(line).map_err(|e| e.to_string())?;
        Ok(entry_of(&value))
    };
    text.lines().map(entry).collect()
}

fn entry_of(value: &Value) -> Entry {
    let coin = &value["coin"];
    let text = |v: &Value| v.as_str().unwrap_or_default().to_owned();
    let count = |key: &str| coin[key].as_u64().unwrap_or(0) as usize;
    let errors = coin["errors"].as_array();
    Entry {
        path: text(&value["path"]),
        header: text(&value["header"]),
        coin_ok: coin["ok"].as_bool().unwrap_or(false),
        errors: errors.into_iter().flatten().map(text).collect(),
        explicit: counts_of(&coin["explicit"]),
        analytic: counts_of(&coin["analytic"]),
        text: counts_of(&coin["text"]),
        nurbs: counts_of(&coin["nurbs"]),
        colors: count("diffuse_colors"),
        transparencies: count("transparencies"),
        lights: count("lights_active"),
        cameras: count("cameras_active"),
    }
}

fn counts_of(value: &Value) -> Counts {
    let count = |key: &str| value[key].as_u64().unwrap_or(0) as usize;
    let number = |key: &str| value[key].as_f64().unwrap_or(0.0);
    let bounds = value["box"].as_array().map(|list| {
        let mut bounds = [0.0; 6];
        for (to, from) in bounds.iter_mut().zip(list) {
            *to = from.as_f64().unwrap_or(f64::NAN);
        }
        bounds
    });
    Counts {
        triangles: count("tris"),
        lines: count("lines"),
        points: count("points"),
        area: number("area"),
        volume: number("vol"),
        length: number("len"),
        normal_dot: number("nrmdot"),
        textured: count("uvtris"),
        texcoord_sum: [0, 1].map(|i| value["uvsum"][i].as_f64().unwrap_or(0.0)),
        bounds,
    }
}
