//! The arguments that choose how a glTF is made. docs/OPTIONS.md says what each costs.

use clap::{Args, ValueEnum};
use convert::{Options, Quantize, Weld};

use super::length::Length;

/// Tolerance of `--quantize` alone.
const DEFAULT_TOLERANCE: &str = "0.1mm";
/// Angle of `--quantize` alone, degrees: [`Quantize::NORMAL_TOLERANCE_RAD`].
const DEFAULT_NORMAL_TOLERANCE: f64 = 0.5;

/// How a glTF is made.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "How the glTF is made")]
pub struct Choices {
    /// Vertices that are stored alike are one; this is the default
    #[arg(long, overrides_with = "no_weld")]
    pub weld: bool,

    /// Gives each corner of a triangle a vertex of its own
    #[arg(long, overrides_with = "weld", conflicts_with = "optimize")]
    pub no_weld: bool,

    /// Puts triangles and vertices in an order that graphics devices draw fast
    #[arg(long)]
    pub optimize: bool,

    /// Compresses the numbers of meshes; includes --optimize
    #[arg(long, value_enum, value_name = "CODEC")]
    pub compress: Option<Compression>,

    /// Stores positions, normals, texture coordinates and colours in fewer bits
    /// (KHR_mesh_quantization)
    #[arg(long)]
    pub quantize: bool,

    /// Farthest that --quantize may move a point, with a unit (um, mm, cm, m, km, in, ft) or in the
    /// model's own
    #[arg(long, value_name = "LENGTH", requires = "quantize", default_value = DEFAULT_TOLERANCE)]
    pub tolerance: Option<Length>,

    /// Widest angle that --quantize may turn a normal by, in degrees
    #[arg(long, value_name = "DEGREES", requires = "quantize", default_value_t = DEFAULT_NORMAL_TOLERANCE, value_parser = angle)]
    pub normal_tolerance: f64,
}

/// What `--compress` does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Compression {
    /// EXT_meshopt_compression, which three.js and Babylon.js read
    Meshopt,
}

impl Choices {
    /// These options as the user wants them.
    pub fn apply(&self, options: Options) -> Options {
        let metre = 1.0;
        let quantize = self.quantize.then(|| Quantize {
            tolerance: self.tolerance.map_or(0.0, |length| length.metres(metre)),
            normal_tolerance_rad: self.normal_tolerance.to_radians(),
        });
        Options {
            weld: if self.no_weld {
                Weld::Apart
            } else {
                Weld::Shared
            },
            optimize: self.optimize,
            quantize,
            compress: self.compress.is_some(),
            ..options
        }
    }
}

fn angle(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(degrees) if (0.0..=90.0).contains(&degrees) => Ok(degrees),
        _ => Err("it is an angle of 0 to 90 degrees".to_owned()),
    }
}
