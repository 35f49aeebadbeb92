//! Coin's reader as a program, where a C++ compiler and Coin are installed.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Compiles it; says loudly why not.
pub fn reader(folder: &Path) -> Option<PathBuf> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/speed/coin_read.cpp");
    let program = folder.join("coin_read");
    let compiler = Command::new("g++")
        .args(["-O2", "-o"])
        .arg(&program)
        .arg(source)
        .arg("-lCoin")
        .output();
    let why = match compiler {
        Ok(run) if run.status.success() => return Some(program),
        Ok(run) => String::from_utf8_lossy(&run.stderr).into_owned(),
        Err(why) => why.to_string(),
    };
    let first = why.lines().next().unwrap_or_default();
    eprintln!("\nNO COMPARISON WITH COIN: {first}");
    eprintln!("Install it with: apt-get install g++ libcoin-dev\n");
    None
}
