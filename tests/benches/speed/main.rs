//! How fast and how lean `ivconvert` is, beside Coin's reader and beside parsing numbers alone.
//!
//! `cargo bench -p tests` makes three large models and prints a table about them;
//! `cargo bench -p tests -- model.iv` takes models of your own. docs/BENCHMARKS.md says what the
//! columns mean. Every program is measured as a process of its own.

#![cfg_attr(not(unix), allow(dead_code))]

mod child;
mod coin;
mod programs;
mod table;

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use tests::floats;
use tests::large::{self, Sizes};

use programs::Programs;
use table::Row;

/// A model to measure with.
struct Model {
    path: PathBuf,
    goals: Option<table::Goals>,
}

fn main() -> ExitCode {
    let args: Vec<OsString> = env::args_os().skip(1).collect();
    let done = match args.first().and_then(|arg| arg.to_str()) {
        Some(child::FLAG) => child::run(&args[1..]),
        Some(programs::FLOATS_FLAG) => read_floats(&args[1..]),
        _ if args.iter().any(|arg| arg == "--bench") => bench(&args),
        _ => {
            println!("run by: cargo bench -p tests");
            Ok(())
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

/// The body of the process that only parses numbers.
fn read_floats(args: &[OsString]) -> Result<(), String> {
    let path = args.first().ok_or("no file")?;
    let text = fs::read(path).map_err(|why| why.to_string())?;
    let (count, sum) = floats::sum(&text);
    println!("{count} numbers, sum {sum}");
    Ok(())
}

fn bench(args: &[OsString]) -> Result<(), String> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("bench");
    fs::create_dir_all(&folder).map_err(|why| why.to_string())?;
    let named: Vec<PathBuf> = args
        .iter()
        .filter(|arg| !arg.as_encoded_bytes().starts_with(b"--"))
        .map(given)
        .collect();
    let models = if named.is_empty() {
        generated(&folder)?
    } else {
        let own = |path| Model { path, goals: None };
        named.into_iter().map(own).collect()
    };
    let programs = Programs::build(&folder)?;
    println!("{}", table::machine());
    println!("{}", table::HEAD);
    let mut verdicts = Vec::new();
    for model in &models {
        let row = Row::measure(&model.path, &programs, &folder)?;
        println!("{row}");
        verdicts.extend(model.goals.iter().flat_map(|goals| goals.verdicts(&row)));
    }
    verdicts.iter().for_each(|verdict| println!("{verdict}"));
    Ok(())
}

/// Cargo runs benchmarks in the folder of their package; users stand in the one above.
fn given(arg: &OsString) -> PathBuf {
    let path = PathBuf::from(arg);
    if path.is_relative() && !path.exists() {
        Path::new("..").join(path)
    } else {
        path
    }
}

fn generated(folder: &Path) -> Result<Vec<Model>, String> {
    let write = |(model, goals): (large::Large, table::Goals)| {
        let path = folder.join(model.name);
        fs::write(&path, model.text).map_err(|why| why.to_string())?;
        let goals = Some(goals);
        Ok(Model { path, goals })
    };
    let models = large::all(Sizes::FULL).into_iter().zip(table::GOALS);
    models.map(write).collect()
}
