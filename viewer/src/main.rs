//! The command `ivview`. The renderer and the window are not part of this version.

use std::process::ExitCode;

fn main() -> ExitCode {
    eprintln!(
        "ivview: drawing is not part of this version yet; `ivconvert MODEL.iv -o MODEL.glb` converts the model for any glTF viewer"
    );
    ExitCode::from(2)
}
