//! The command `ivview`: shows Inventor and glTF models.

use std::process::ExitCode;

fn main() -> ExitCode {
    app::cli::run()
}
