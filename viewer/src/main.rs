//! The command `ivview`: shows Inventor and glTF models.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run()
}
