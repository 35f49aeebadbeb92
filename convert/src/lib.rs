//! Open Inventor to glTF 2.0.
//!
//! [`Scene`] in, `.glb` or `.gltf` out. Two passes: a plan decides
//! everything and measures it, then the output is streamed from the scene's own arrays, so that
//! memory holds little more than the scene and the JSON text.
//!
//! What is promised:
//!
//! - the same scene gives the same bytes, with no time or machine in them;
//! - the output is free of errors and warnings of the Khronos validator;
//! - transforms are f64 to the last digit, and a mesh's origin goes into its node;
//! - no name is lost and none is invented;
//! - what glTF cannot carry is listed in the [`Report`], and Inventor's own values are in
//!   `extras.iv`, under the names of Inventor's fields.
//!
//! [`read_gltf`] is the way back, for files of others too; [`gltf_to_inventor`] goes on to Inventor
//! text.
//!
//! No question of Inventor's is asked here: defaults, inheritance and bindings are resolved in the
//! scene. Files are opened by the caller's [`TextureLoader`] only, and written by [`write_file`]
//! only.

mod alike;
mod alternatives;
mod base64;
mod binary;
mod blocks;
mod bounds;
mod camera;
mod color;
pub mod command;
mod compress;
mod container;
mod error;
mod extras;
mod file;
mod formats;
mod frame;
mod hierarchy;
mod html;
mod image;
mod instancing;
mod json;
mod layout;
mod light;
mod loss;
mod material;
mod mesh;
mod options;
mod parallel;
mod pixels;
mod plan;
mod prepare;
mod read;
mod remarks;
mod report;
mod round_trip;
mod sound;
mod texture;
mod to_inventor;

use std::io::Write;

use plan::Plan;
use prepare::Prepared;
use scenegraph::scene::Scene;

pub use error::Error;
pub use file::write_file;
pub use loss::{Effect, Loss, LossKind, losses_markdown};
pub use options::{Container, Lights, Materials, Options, Quantize, TextureFormat, Up, Weld};
pub use pixels::Pixels;
pub use read::{Model, ReadError, ReadLimits, read_gltf};
pub use report::{Counts, Report, Warning};
pub use round_trip::{Recorder, Source, write_file_with_source, write_glb_with_source};
pub use texture::TextureLoader;
pub use to_inventor::{
    InventorCounts, InventorFiles, InventorOptions, Note, gltf_to_inventor, is_gltf,
};

/// Writes a scene as `.glb`, whatever container the options name. Wants a buffered stream.
///
/// # Errors
///
/// [`Error::GlbTooLarge`] before anything is written, [`Error::Scene`] for a scene that breaks its
/// guarantees, [`Error::Io`] from the stream.
pub fn write_glb(
    scene: &Scene,
    options: &Options,
    textures: &dyn TextureLoader,
    out: &mut dyn Write,
) -> Result<Report, Error> {
    let options = Options {
        container: Container::Glb,
        ..options.clone()
    };
    let prepared = Prepared::new(scene, &options)?;
    Plan::new(&prepared, &options, textures)?.write_glb(out)
}

/// Writes a scene as `.gltf` text and one `.bin`, whatever container the options name. `bin_uri`
/// goes into the text as it is. Wants buffered streams.
///
/// # Errors
///
/// [`Error::SeveralBins`] if one `.bin` does not hold it all, [`Error::BinTooLarge`] if no number
/// of them would, [`Error::Scene`] for a scene that breaks its guarantees, [`Error::Io`] from the
/// streams.
pub fn write_gltf(
    scene: &Scene,
    options: &Options,
    textures: &dyn TextureLoader,
    bin_uri: &str,
    json_out: &mut dyn Write,
    bin_out: &mut dyn Write,
) -> Result<Report, Error> {
    let options = Options {
        container: Container::GltfBin,
        ..options.clone()
    };
    let prepared = Prepared::new(scene, &options)?;
    let plan = Plan::new(&prepared, &options, textures)?;
    match plan.layout.buffers.len() {
        0 => {}
        1 => plan.write_buffer(0, bin_out)?,
        count => return Err(Error::SeveralBins { count }),
    }
    plan.write_gltf_text(&[bin_uri.to_owned()], json_out)
}
