//! The arguments that choose how a glTF is made. docs/OPTIONS.md says what each costs.

use clap::{Args, ValueEnum};
use convert::{Lights, Materials, Options, Quantize, TextureFormat, Up, Weld};

use super::length::{Length, Unit};

/// Tolerance of `--quantize` alone.
const DEFAULT_TOLERANCE: &str = "0.1mm";
/// Angle of `--quantize` alone, degrees: [`Quantize::NORMAL_TOLERANCE_RAD`].
const DEFAULT_NORMAL_TOLERANCE: f64 = 0.5;

/// How a glTF is made.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "How the glTF is made")]
pub struct Choices {
    /// Which axis of the model points upwards; z turns the model so that glTF viewers, for which
    /// that is +Y, show it upright
    #[arg(long, value_enum, value_name = "AXIS", default_value = "y")]
    pub up: Axis,

    /// Unit of the model's lengths; the model is scaled to metres, as glTF has it
    #[arg(long, value_enum, value_name = "UNIT", default_value = "m")]
    pub units: Unit,

    /// What becomes of materials
    #[arg(long, value_enum, value_name = "LOOK", default_value = "fidelity")]
    pub materials: MaterialChoice,

    /// Unit of the lights' intensity
    #[arg(long, value_enum, value_name = "UNIT", default_value = "unitless")]
    pub lights: LightChoice,

    /// Format of images
    #[arg(long, value_enum, value_name = "FORMAT", default_value = "keep")]
    pub textures: TextureChoice,

    /// Vertices that are stored alike are one; this is the default
    #[arg(long, overrides_with = "no_weld")]
    pub weld: bool,

    /// Gives each corner of a triangle a vertex of its own
    #[arg(long, overrides_with = "weld", conflicts_with = "optimize")]
    pub no_weld: bool,

    /// Puts triangles and vertices in an order that graphics devices draw fast
    #[arg(long)]
    pub optimize: bool,

    /// Makes one node of copies of a part below one node (EXT_mesh_gpu_instancing)
    #[arg(long)]
    pub instancing: bool,

    /// Keeps what the model has besides what it shows: children that Switches hide
    /// (KHR_node_visibility), coarser levels of detail (MSFT_lod), and materials that Switches choose
    /// (KHR_materials_variants). Viewers that do not know KHR_node_visibility show the hidden parts
    #[arg(long)]
    pub alternatives: bool,

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

/// What `--up` names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Axis {
    /// Nothing is turned: so Inventor's own cameras have it
    Y,
    /// As most CAD systems have it
    Z,
}

/// What `--materials` names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MaterialChoice {
    /// Highlights as in Inventor (KHR_materials_specular, KHR_materials_ior)
    Fidelity,
    /// Colour and roughness alone, without extensions
    Simple,
    /// Colours as they are, without light (KHR_materials_unlit)
    Unlit,
}

/// What `--lights` names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LightChoice {
    /// For viewers without exposure: intensity 1 makes a white surface white
    Unitless,
    /// Lux and candela, for renderers with exposure: 683 times as much
    Physical,
}

/// What `--textures` names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TextureChoice {
    /// PNG and JPEG files stay byte for byte, all else becomes PNG
    Keep,
    /// All become PNG
    Png,
    /// Lossless WebP where that is smaller (EXT_texture_webp)
    Webp,
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
        let metres_per_unit = self.units.metres();
        let quantize = self.quantize.then(|| Quantize {
            tolerance: self
                .tolerance
                .map_or(0.0, |length| length.metres(metres_per_unit)),
            normal_tolerance_rad: self.normal_tolerance.to_radians(),
        });
        Options {
            up: match self.up {
                Axis::Y => Up::Y,
                Axis::Z => Up::Z,
            },
            metres_per_unit,
            materials: match self.materials {
                MaterialChoice::Fidelity => Materials::Fidelity,
                MaterialChoice::Simple => Materials::Simple,
                MaterialChoice::Unlit => Materials::Unlit,
            },
            lights: match self.lights {
                LightChoice::Unitless => Lights::Unitless,
                LightChoice::Physical => Lights::Physical,
            },
            textures: match self.textures {
                TextureChoice::Keep => TextureFormat::Keep,
                TextureChoice::Png => TextureFormat::Png,
                TextureChoice::Webp => TextureFormat::Webp,
            },
            weld: if self.no_weld {
                Weld::Apart
            } else {
                Weld::Shared
            },
            optimize: self.optimize,
            quantize,
            compress: self.compress.is_some(),
            instancing: self.instancing,
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
