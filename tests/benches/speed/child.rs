//! One process, measured: its processor time, its memory and the time it took.
//!
//! Unix tells the usage of all children together. So each program gets a parent of its own: this
//! benchmark, started again, which starts the program and prints what it used.

use std::env;
use std::ffi::OsString;
use std::process::{Command, Stdio};
use std::time::Instant;

/// Makes this process the parent of the command that follows.
pub const FLAG: &str = "--child";

/// What a process used.
#[derive(Clone, Copy, Debug)]
pub struct Usage {
    /// User and system time, seconds.
    pub cpu_s: f64,
    /// From start to end, seconds.
    pub wall_s: f64,
    /// Most memory resident at a time, bytes.
    pub peak_bytes: f64,
}

/// Runs a command and measures it.
///
/// # Errors
///
/// When it cannot be run or fails.
pub fn measure(command: &[OsString]) -> Result<Usage, String> {
    let exe = env::current_exe().map_err(|why| why.to_string())?;
    let run = Command::new(exe).arg(FLAG).args(command).output();
    let run = run.map_err(|why| why.to_string())?;
    let text = String::from_utf8_lossy(&run.stdout);
    let numbers: Vec<f64> = text.split(' ').flat_map(|n| n.trim().parse()).collect();
    match (run.status.success(), &numbers[..]) {
        (true, &[cpu_s, wall_s, peak_bytes]) => Ok(Usage {
            cpu_s,
            wall_s,
            peak_bytes,
        }),
        _ => Err(format!(
            "{command:?}: {}",
            String::from_utf8_lossy(&run.stderr)
        )),
    }
}

/// The body of the parent process.
///
/// # Errors
///
/// When the command cannot be run or fails.
#[cfg(unix)]
pub fn run(command: &[OsString]) -> Result<(), String> {
    use nix::sys::resource::{UsageWho, getrusage};
    use nix::sys::time::TimeValLike;

    let (program, args) = command.split_first().ok_or("no command")?;
    let start = Instant::now();
    let status = Command::new(program)
        .args(args)
        .stdout(Stdio::null())
        .status()
        .map_err(|why| why.to_string())?;
    let wall_s = start.elapsed().as_secs_f64();
    if !status.success() {
        return Err(status.to_string());
    }
    let usage = getrusage(UsageWho::RUSAGE_CHILDREN).map_err(|why| why.to_string())?;
    let cpu = usage.user_time() + usage.system_time();
    let cpu_s = cpu.num_microseconds() as f64 * 1e-6;
    // Linux counts in KiB, macOS in bytes.
    let unit = if cfg!(target_os = "macos") {
        1.0
    } else {
        1024.0
    };
    println!("{cpu_s} {wall_s} {}", usage.max_rss() as f64 * unit);
    Ok(())
}

/// Other systems tell these numbers in other ways.
///
/// # Errors
///
/// Always.
#[cfg(not(unix))]
pub fn run(_command: &[OsString]) -> Result<(), String> {
    Err("the benchmark needs Unix".to_owned())
}
