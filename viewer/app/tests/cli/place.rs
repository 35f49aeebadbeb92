//! A scratch folder with models in it, and the command run there.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use image::RgbaImage;
use serde_json::Value;

/// A red cube, without lights or cameras.
pub const CUBE: &str = "#Inventor V2.1 ascii\nMaterial { diffuseColor 0.8 0 0 } Cube { }\n";

/// Options of all runs: a small picture, drawn alike everywhere.
const SMALL: &str = "--size 64x48 --adapter software";

pub struct Place {
    pub folder: tempfile::TempDir,
}

pub struct Run {
    pub code: i32,
    pub out: String,
    pub err: String,
}

impl Place {
    pub fn new() -> Self {
        Self {
            folder: tempfile::tempdir().unwrap(),
        }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn file(self, name: &str, bytes: impl AsRef<[u8]>) -> Self {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
        self
    }

    /// Copies a sample, under its own name without folders.
    pub fn sample(self, path: &str) -> Self {
        let from = samples::data_dir().join(path);
        let name = from.file_name().unwrap().to_str().unwrap().to_owned();
        let bytes = fs::read(from).unwrap();
        self.file(&name, bytes)
    }

    /// Converts a model in the folder to a `.glb` of the same name.
    pub fn glb_of(self, name: &str) -> Self {
        let path = self.path(name);
        let bytes = fs::read(&path).unwrap();
        let files = scenegraph::FileLoader::new([self.folder.path()]);
        let graph = scenegraph::load(&bytes, name, self.folder.path(), &files);
        let scene = scenegraph::resolve(&graph, &scenegraph::ResolveOptions::default()).scene;
        let images = convert::command::model::Images(&files);
        let options = convert::Options::default();
        let target = path.with_extension("glb");
        convert::write_file(&scene, &options, &images, &target).unwrap();
        self
    }

    /// Runs the command on `args`, split at blanks.
    pub fn run(&self, args: &str) -> Run {
        self.run_words(&args.split_whitespace().collect::<Vec<_>>())
    }

    pub fn run_words(&self, args: &[&str]) -> Run {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ivview"));
        command.current_dir(self.folder.path());
        let has_size = args.contains(&"--size");
        let small = SMALL.split_whitespace().skip(if has_size { 2 } else { 0 });
        command.args(args).args(small);
        // Mesa's layer that chooses devices complains where there is no desktop.
        command.env("NODEVICE_SELECT", "1");
        // A window would wait for somebody to close it.
        for display in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
            command.env_remove(display);
        }
        let output = command.output().unwrap();
        Run {
            code: output.status.code().unwrap(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }

    /// Draws and expects that nothing is wrong.
    pub fn draw(&self, args: &str) -> RgbaImage {
        let run = self.run(&format!("{args} -o drawn.png"));
        assert_eq!(run.code, 0, "{args}: {}", run.err);
        self.picture("drawn.png")
    }

    pub fn picture(&self, name: &str) -> RgbaImage {
        image::open(self.path(name)).unwrap().into_rgba8()
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap()
    }

    /// The statistics of a run that must go well.
    pub fn stats(&self, args: &str) -> Value {
        let run = self.run(&format!("{args} -q -o drawn.png --stats -"));
        assert_eq!(run.code, 0, "{args}: {}", run.err);
        serde_json::from_str(&run.out).unwrap()
    }

    /// All files, hidden ones too.
    pub fn names(&self) -> Vec<String> {
        let name = |path: PathBuf| path.file_name().unwrap().to_str().unwrap().to_owned();
        let entries = fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<String> = entries.map(|e| name(e.unwrap().path())).collect();
        names.sort();
        names
    }
}

pub fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .nth(2)
        .unwrap()
}
