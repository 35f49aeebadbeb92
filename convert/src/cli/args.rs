//! The arguments, as the user gives them. What they mean for a set of files is decided in `plan`.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::thread;

use clap::{Parser, ValueEnum};
use convert::Options;
use convert::command::access::PackedArgs;

use super::choices::Choices;

const USAGE: &str = "\
ivconvert [OPTIONS] <INPUT>...
       ivconvert --info [--json] <INPUT>...";

const EXAMPLES: &str = "\
Examples:
  ivconvert house.iv
        writes house.glb beside it
  ivconvert house.iv -o web/house.gltf
        writes house.gltf and house.bin
  ivconvert house.iv --html --up z --units cm
        writes house.html, which any browser shows, upright and in metres
  ivconvert house.iv --quantize --tolerance 0.1mm --compress meshopt
        as small as the tolerance allows
  ivconvert models --out-dir web
        all models below the folder models, in the same structure below web
  ivconvert house.iv --search ~/textures
        takes images and included files from there too
  ivconvert house.iv --strict --report house.json
        for scripts: exit code 1 if anything is lost, and all messages as JSON
  ivconvert old.iv -o new.iv
        Inventor text again, laid out anew; with --binary a binary file
  ivconvert models.ivz --password-file key.txt
        the model in a zip archive, with the textures and files in it
  ivconvert house.glb -o house.iv
        Inventor text of any glTF, with its images beside it
  ivconvert --info house.iv
        what is in the model; nothing is written

Exit codes:
  0  done
  1  done, but something is lost or could not be used (only with --strict)
  2  something failed; all other inputs are done";

/// Converts Open Inventor models to glTF, and glTF to Open Inventor.
///
/// Each input is converted by itself; what glTF cannot carry is listed, and so is all that is
/// wrong with the input. An output file is written whole or not at all.
#[derive(Clone, Debug, Parser)]
#[command(name = "ivconvert", version, override_usage = USAGE, after_help = EXAMPLES)]
pub struct Args {
    /// Models, or folders that are searched for models (.iv, .ivx, .ivl, .ivz, .ivzl, .wrl, .wrz,
    /// .vrml, and these with .gz or .bz2 behind); .glb and .gltf for -o x.iv
    #[arg(value_name = "INPUT", required = true)]
    pub inputs: Vec<PathBuf>,

    /// Output file, for a single input; its extension chooses the format
    #[arg(short, long, value_name = "OUT", conflicts_with = "out_dir")]
    pub output: Option<PathBuf>,

    /// Folder for the outputs, made if need be; searched folders keep their structure below it.
    /// Without this and -o each output goes beside its input
    #[arg(long, value_name = "DIR")]
    pub out_dir: Option<PathBuf>,

    /// Format of the outputs [default: by the extension of -o, else glb]
    #[arg(long, value_enum)]
    pub format: Option<Format>,

    /// The same as --format html: one page with the model and a viewer in it
    #[arg(long, conflicts_with = "format")]
    pub html: bool,

    /// Puts everything into one file: the numbers of a .gltf, the images of an Inventor text made
    /// of glTF; else they go into files beside it
    #[arg(long)]
    pub embed: bool,

    /// Writes all messages, losses and sizes as one JSON document
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,

    /// Puts times into the report, which then differs from run to run
    #[arg(long, requires = "report")]
    pub timings: bool,

    /// Exit code 1 if anything of a model is lost or could not be used
    #[arg(long)]
    pub strict: bool,

    /// How many inputs are converted at once; each holds its model in memory [default: one for
    /// each processor]
    #[arg(short, long, value_name = "N", value_parser = at_least_one)]
    pub jobs: Option<NonZeroUsize>,

    /// A further folder that may be read, searched for images and included files behind the
    /// input's own; may be given several times
    #[arg(long, value_name = "DIR", value_parser = folder)]
    pub search: Vec<PathBuf>,

    /// Largest distance between triangles and the NURBS they stand for, in units of the scene
    /// [default: by the shape's size and Complexity]
    #[arg(long, value_name = "TOLERANCE", value_parser = convert::command::model::chord)]
    pub chord: Option<f64>,
    /// Sets text in this computer's fonts where it has those that a model names; the output then
    /// depends on the computer
    #[arg(long)]
    pub system_fonts: bool,
    #[command(flatten)]
    pub packed: PackedArgs,

    /// Inventor files are written in binary: shorter and faster to read, with numbers of 32 bits
    #[arg(long)]
    pub binary: bool,

    /// Leaves out Inventor's own values that glTF has no place for
    #[arg(long)]
    pub no_extras: bool,

    /// Puts the source into the output too, so that `ivconvert x.glb -o x.iv` gives it back byte for
    /// byte, with what was edited in between. The output grows by about a quarter of the source; the
    /// conversion takes four times as long
    #[arg(long, conflicts_with = "no_extras")]
    pub round_trip: bool,

    #[command(flatten)]
    pub choices: Choices,

    /// Prints errors only
    #[arg(short, long)]
    pub quiet: bool,

    /// Shows what is in the inputs and writes no files
    #[arg(long, conflicts_with_all = [
        "output", "out_dir", "format", "report", "timings", "strict", "no_extras", "round_trip",
        "html", "embed", "binary", "Choices",
    ])]
    pub info: bool,

    /// Shows it as JSON
    #[arg(long, requires = "info")]
    pub json: bool,
}

/// What is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// glTF 2.0 in one binary file
    Glb,
    /// glTF 2.0 as JSON text with its numbers in a .bin file beside it
    Gltf,
    /// A page that shows the model in any browser, offline
    Html,
    /// Inventor: of Inventor text laid out anew or, with --binary, binary; of glTF made anew
    Iv,
}

impl Format {
    /// The extension of its files.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Glb => "glb",
            Self::Gltf => "gltf",
            Self::Html => "html",
            Self::Iv => "iv",
        }
    }

    /// The format whose extension `path` has.
    pub fn of_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?;
        let all = [Self::Glb, Self::Gltf, Self::Html, Self::Iv];
        all.into_iter()
            .find(|format| extension.eq_ignore_ascii_case(format.extension()))
    }
}

impl Args {
    /// How many inputs are worked on at once.
    pub fn jobs(&self) -> usize {
        let jobs = self.jobs.or_else(|| thread::available_parallelism().ok());
        jobs.map_or(1, NonZeroUsize::get)
    }

    /// The format of the outputs.
    ///
    /// # Errors
    ///
    /// `--format` and the extension of `-o` contradict each other, or neither says a format.
    pub fn format(&self) -> Result<Format, String> {
        let asked = if self.html {
            Some(Format::Html)
        } else {
            self.format
        };
        let Some(output) = &self.output else {
            return self.embeddable(asked.unwrap_or(Format::Glb));
        };
        let shown = output.display();
        match (asked, Format::of_path(output)) {
            (Some(asked), Some(named)) if asked != named => Err(format!(
                "--format {} does not fit the extension of `{shown}`",
                asked.extension()
            )),
            (Some(format), _) | (None, Some(format)) => self.embeddable(format),
            (None, None) => Err(format!(
                "`{shown}` ends in none of .glb, .gltf, .html and .iv; give --format"
            )),
        }
    }
}

impl Args {
    /// `--embed` goes with .gltf and .iv, what shapes glTF with all but .iv.
    fn embeddable(&self, format: Format) -> Result<Format, String> {
        if self.embed && !matches!(format, Format::Gltf | Format::Iv) {
            return Err(
                "--embed is for .gltf and .iv; .glb and .html hold all in one file".to_owned(),
            );
        }
        let usual = Options::default();
        let shapes_gltf = self.choices.apply(usual.clone()) != usual
            || self.choices.alternatives
            || self.round_trip;
        if format == Format::Iv && shapes_gltf {
            return Err(
                "options of how the glTF is made, and --round-trip, have no effect on .iv"
                    .to_owned(),
            );
        }
        Ok(format)
    }
}

fn at_least_one(text: &str) -> Result<NonZeroUsize, String> {
    let why = "it is the number of inputs converted at once, 1 or more";
    text.parse().map_err(|_| why.to_owned())
}

fn folder(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if path.is_dir() {
        Ok(path)
    } else {
        Err("it is not a folder".to_owned())
    }
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
    fn extension_or_option_choose_the_format() {
        let rows: [(&[&str], Option<Format>); 10] = [
            (&[], Some(Format::Glb)),
            (&["--format", "gltf"], Some(Format::Gltf)),
            (&["-o", "b.GLTF"], Some(Format::Gltf)),
            (&["-o", "b.iv"], Some(Format::Iv)),
            (&["-o", "b.model", "--format", "glb"], Some(Format::Glb)),
            (&["-o", "b.glb", "--format", "glb"], Some(Format::Glb)),
            (&["-o", "b.glb", "--format", "iv"], None),
            (&["-o", "b.obj"], None),
            (&["-o", "b.html", "--alternatives"], Some(Format::Html)),
            (&["-o", "b.iv", "--alternatives"], None),
        ];
        for (options, want) in rows {
            let words = ["ivconvert", "a.iv"].iter().chain(options);
            let args = Args::try_parse_from(words).unwrap();
            assert_eq!(args.format().ok(), want, "{options:?}");
        }
    }
}
