//! The command `ivconvert`: Inventor models to glTF, or a summary of what is in them.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run()
}
