//! The arguments, as the user gives them.

use std::path::{Path, PathBuf};

use clap::{Parser, ValueEnum};
use convert::command::access::PackedArgs;
use viewer::compare::Tolerance;
use viewer::frame::{Extraction, Headlight, Settings, Shadows, VolumeMethod};
use viewer::gpu::AdapterChoice;
use viewer::view::framing::Up;

use super::background::{self, Background};

const USAGE: &str = "ivview [OPTIONS] [MODEL]...";

const EXAMPLES: &str = "\
Examples:
  ivview house.iv
        in a window; `?` there lists the keys
  ivview house.iv -o house.png
        as the first camera of the model sees it, or else the whole model
  ivview house.glb -o house.png --size 1920x1080 --msaa 4 --background '#d0e0f0,white'
        a glTF model, before a gradient
  ivview house.iv -o a.png --camera Garden
        as the camera of this name sees it; a number counts the cameras from 0
  ivview house.iv -o a.png --camera '8 -12 5  0 0 1.5  45'
        from a point towards another, with 45 degrees from bottom to top
  ivview house.iv -o a.png --reference expected.png
        for tests: exit code 1 if the picture is another one, and both side by side in a.diff.png
  ivview house.iv -o a.png --stats -
        what was drawn and how long it took, as JSON (docs/STATS.md names the keys)

Exit codes:
  0  done
  1  the picture differs from the reference
  2  something failed";

/// Shows Open Inventor and glTF models.
///
/// Shadows are computed exactly, by shadow volumes, unless another way is asked for. Without
/// --output the model is shown in a window.
#[derive(Clone, Debug, Parser)]
#[command(name = "ivview", version, override_usage = USAGE, after_help = EXAMPLES)]
pub struct Args {
    /// Models: Inventor (.iv, .wrl, .ivz) or glTF (.glb, .gltf), told apart by content. The first is
    /// shown; PageDown goes to the next
    #[arg(value_name = "MODEL")]
    pub models: Vec<PathBuf>,

    /// Draws into this picture, without a window; its folder is made if need be
    #[arg(short, long, value_name = "PNG", value_parser = png)]
    pub output: Option<PathBuf>,

    /// Width and height of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "1024x768", value_parser = size)]
    pub size: (u32, u32),

    /// A camera of the model, by DEF name or number from 0; or a view as seven numbers: the eye, a
    /// point in the middle of the picture, the vertical angle in degrees [default: the first
    /// camera, else all that there is]
    #[arg(
        long,
        value_name = "NAME|INDEX|'x y z  x y z  fovy'",
        allow_hyphen_values = true
    )]
    pub camera: Option<String>,

    /// A saved view of Lexolights
    #[arg(long, value_name = "FILE.ivv", conflicts_with = "camera")]
    pub view: Option<PathBuf>,

    /// Which way is up, for views that are no camera of the model [default: z, as in Lexolights and
    /// CAD; y for glTF that was not converted from Inventor]
    #[arg(long, value_enum)]
    pub up: Option<UpAxis>,

    /// How shadows are made
    #[arg(long, value_enum, default_value_t = ShadowKind::Volumes)]
    pub shadows: ShadowKind,

    /// Where shadow volumes are computed
    #[arg(long, value_enum, default_value_t = Place::Auto)]
    pub extraction: Place,

    /// Samples a pixel
    #[arg(long, value_name = "1|4", default_value = "1", value_parser = samples)]
    pub msaa: u32,

    /// Colour behind the model, or two for a gradient: black, dark grey, grey, light grey, white,
    /// griseous, tan, or #rrggbb
    #[arg(long, value_name = "COLOR|TOP,BOTTOM", default_value = "black", value_parser = background::parse)]
    pub background: Background,

    /// Leaves models without lights in ambient light alone
    #[arg(long)]
    pub no_headlight: bool,

    /// Which graphics adapters may be used
    #[arg(long, value_enum, default_value_t = Adapter::Any)]
    pub adapter: Adapter,

    /// A picture to compare with
    #[arg(long, value_name = "PNG")]
    pub reference: Option<PathBuf>,

    /// How far the picture may be from the reference: `exact`, or the largest step of a channel
    /// that does not count, the percentage of pixels that may differ by more, and how many of these
    /// may hang together
    #[arg(
        long,
        value_name = "STEP,PERCENT,PIXELS",
        default_value = "2,0.2,12",
        requires = "reference",
        value_parser = tolerance
    )]
    pub threshold: Tolerance,

    /// Writes what was drawn and how long it took; `-` is standard output
    #[arg(long, value_name = "FILE.json|-")]
    pub stats: Option<PathBuf>,

    /// Largest distance between triangles and the NURBS they stand for, in units of the scene
    /// [default: by the shape's size and Complexity]
    #[arg(long, value_name = "TOLERANCE", value_parser = convert::command::model::chord)]
    pub chord: Option<f64>,

    /// A further folder that may be read, searched for images and included files behind the
    /// model's own; may be given several times
    #[arg(long, value_name = "DIR", value_parser = folder)]
    pub search: Vec<PathBuf>,

    /// Sets text in this computer's fonts where it has those that the model names; the picture
    /// then depends on the computer
    #[arg(long)]
    pub system_fonts: bool,
    /// How packed files are opened
    #[command(flatten)]
    pub packed: PackedArgs,

    /// Prints errors only
    #[arg(short, long)]
    pub quiet: bool,
}

/// How shadows are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ShadowKind {
    /// Shadow volumes of silhouettes
    Volumes,
    /// The same, found by a reference edge in each triangle
    VolumesReference,
    /// A shadow volume for each triangle
    VolumesTriangles,
    /// Shadow maps of 2048 x 2048
    Map,
    /// Shadow maps of 8192 x 8192
    #[value(name = "map-8k")]
    Map8k,
    /// Rays
    Rays,
    /// No shadows
    None,
}

/// Where shadow volumes are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Place {
    /// By the CPU for software adapters, else by compute shaders
    Auto,
    /// By the CPU
    Cpu,
    /// By compute shaders
    Compute,
}

/// Which way is up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum UpAxis {
    /// +Z
    Z,
    /// +Y
    Y,
}

/// Which adapters may be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Adapter {
    /// Hardware if there is any, else software
    Any,
    /// Software only: the same picture wherever the same driver runs
    Software,
}

impl Args {
    /// What is the renderer's business.
    pub fn settings(&self) -> Settings {
        let Background([top, bottom]) = self.background;
        Settings {
            shadows: self.shadows.with(self.extraction),
            samples: self.msaa,
            background_srgb: [top, bottom],
            headlight: if self.no_headlight {
                Headlight::Off
            } else {
                Headlight::WhenAlone
            },
            ..Settings::default()
        }
    }

    /// Whether the user wants another background than black.
    pub fn has_background(&self) -> bool {
        self.background != Background([[0.0; 3]; 2])
    }

    /// The axis that the user wants up, if any.
    pub fn up(&self) -> Option<Up> {
        self.up.map(|up| match up {
            UpAxis::Z => Up::Z,
            UpAxis::Y => Up::Y,
        })
    }

    /// The adapters that may be taken.
    pub fn adapter(&self) -> AdapterChoice {
        match self.adapter {
            Adapter::Any => AdapterChoice::Any,
            Adapter::Software => AdapterChoice::Software,
        }
    }
}

impl ShadowKind {
    fn with(self, place: Place) -> Shadows {
        let extraction = match place {
            Place::Auto => Extraction::Auto,
            Place::Cpu => Extraction::Cpu,
            Place::Compute => Extraction::Compute,
        };
        let volumes = |method| Shadows::Volumes { method, extraction };
        match self {
            Self::Volumes => volumes(VolumeMethod::Silhouette),
            Self::VolumesReference => volumes(VolumeMethod::ReferenceEdge),
            Self::VolumesTriangles => volumes(VolumeMethod::PerTriangle),
            Self::Map => Shadows::Map { size: 2048 },
            Self::Map8k => Shadows::Map { size: 8192 },
            Self::Rays => Shadows::Rays,
            Self::None => Shadows::None,
        }
    }
}

fn png(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_png = |extension: &std::ffi::OsStr| extension.eq_ignore_ascii_case("png");
    if path.extension().is_some_and(is_png) {
        Ok(path)
    } else {
        Err("pictures are written as PNG; its name must end in .png".to_owned())
    }
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let side = |text: &str| text.trim().parse().ok().filter(|&side: &u32| side > 0);
    let sides = text.split_once(['x', 'X', '×']);
    sides
        .and_then(|(width, height)| Some((side(width)?, side(height)?)))
        .ok_or_else(|| "a size is width and height in pixels, such as 1920x1080".to_owned())
}

fn samples(text: &str) -> Result<u32, String> {
    match text {
        "1" => Ok(1),
        "4" => Ok(4),
        _ => Err("it is 1 or 4".to_owned()),
    }
}

fn tolerance(text: &str) -> Result<Tolerance, String> {
    if text == "exact" {
        return Ok(Tolerance::EXACT);
    }
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let tolerance = match parts.as_slice() {
        [step, percent, pixels] => (|| {
            let percent: f64 = percent.trim_end_matches('%').trim_end().parse().ok()?;
            Some(Tolerance {
                step: step.parse().ok()?,
                max_share: (0.0..=100.0)
                    .contains(&percent)
                    .then_some(percent / 100.0)?,
                max_blob: pixels.parse().ok()?,
            })
        })(),
        _ => None,
    };
    tolerance.ok_or_else(|| {
        "it is `exact` or three numbers: a step of 0 to 255, a percentage, a count of pixels"
            .to_owned()
    })
}

fn folder(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if path.is_dir() {
        Ok(path)
    } else {
        Err("it is not a folder".to_owned())
    }
}

/// Where the strip of a failed comparison goes: `a.diff.png` for `a.png`.
pub fn strip_path(output: &Path) -> PathBuf {
    output.with_extension("diff.png")
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_arguments_are_consistent() {
        Args::command().debug_assert();
    }

    #[test]
    fn shadows_are_those_of_the_renderer() {
        use Extraction::{Auto, Compute, Cpu};
        let volumes = |method, extraction| Shadows::Volumes { method, extraction };
        let rows = [
            ("", volumes(VolumeMethod::Silhouette, Auto)),
            ("--extraction cpu", volumes(VolumeMethod::Silhouette, Cpu)),
            (
                "--shadows volumes-reference --extraction compute",
                volumes(VolumeMethod::ReferenceEdge, Compute),
            ),
            (
                "--shadows volumes-triangles",
                volumes(VolumeMethod::PerTriangle, Auto),
            ),
            ("--shadows map", Shadows::Map { size: 2048 }),
            ("--shadows map-8k", Shadows::Map { size: 8192 }),
            ("--shadows rays", Shadows::Rays),
            ("--shadows none", Shadows::None),
        ];
        for (options, shadows) in rows {
            let words = ["ivview", "a.iv"].into_iter();
            let args = Args::try_parse_from(words.chain(options.split_whitespace())).unwrap();
            assert_eq!(args.settings().shadows, shadows, "{options}");
        }
    }
}
