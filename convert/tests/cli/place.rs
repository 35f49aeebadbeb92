//! A scratch folder with models in it, and the command run there.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

pub const CUBE: &str = "Cube { }";
pub const UNKNOWN_USE: &str = "Separator { Cube { } USE Lid }";
pub const FOG: &str = "Separator { Environment { fogType FOG fogVisibility 9 } Cube { } }";
pub const IMAGE: &str = "Separator { Texture2 { filename \"wood.png\" } Cube { } }";

/// A scratch folder, in which the command runs.
pub struct Place {
    pub folder: tempfile::TempDir,
}

pub struct Run {
    pub code: i32,
    pub out: String,
    pub err: String,
}

impl Run {
    pub fn of(command: &mut Command) -> Self {
        let output = command.output().unwrap();
        Self {
            code: output.status.code().unwrap(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }
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

    /// Writes a model below the header of Inventor 2.1.
    pub fn model(self, name: &str, body: &str) -> Self {
        self.file(name, &format!("#Inventor V2.1 ascii\n{body}\n"))
    }

    pub fn file(self, name: &str, text: &str) -> Self {
        self.bytes(name, text.as_bytes())
    }

    pub fn bytes(self, name: &str, bytes: &[u8]) -> Self {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
        self
    }

    /// Copies the sample `from` to `to`.
    pub fn sample(self, from: &str, to: &str) -> Self {
        let bytes = fs::read(samples().join(from)).unwrap();
        fs::create_dir_all(self.path(to).parent().unwrap()).unwrap();
        fs::write(self.path(to), bytes).unwrap();
        self
    }

    pub fn command(&self, args: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ivconvert"));
        command.current_dir(self.folder.path());
        command.args(args.split_whitespace());
        command
    }

    pub fn run(&self, args: &str) -> Run {
        Run::of(&mut self.command(args))
    }

    /// As [`Self::run`], with a path behind the arguments.
    pub fn run_on(&self, args: &str, path: &Path) -> Run {
        Run::of(self.command(args).arg(path))
    }

    /// All files, by their path below the folder, with their bytes; hidden ones too.
    pub fn files(&self) -> Vec<(String, Vec<u8>)> {
        let mut files = Vec::new();
        let mut folders = vec![self.folder.path().to_owned()];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).unwrap() {
                let entry = entry.unwrap();
                let path = entry.path();
                if entry.file_type().unwrap().is_dir() {
                    folders.push(path);
                } else if entry.file_type().unwrap().is_file() {
                    let name = path.strip_prefix(self.folder.path()).unwrap();
                    files.push((name.display().to_string(), fs::read(&path).unwrap()));
                }
            }
        }
        files.sort();
        files
    }

    pub fn names(&self) -> Vec<String> {
        self.files().into_iter().map(|(name, _)| name).collect()
    }

    pub fn json(&self, name: &str) -> Value {
        serde_json::from_slice(&fs::read(self.path(name)).unwrap()).unwrap()
    }
}

pub fn samples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../samples/data")
}

/// Messages without the last line, which holds the time taken.
pub fn without_summary(err: &str) -> &str {
    err.trim_end()
        .rsplit_once('\n')
        .map_or("", |(rest, _)| rest)
}
