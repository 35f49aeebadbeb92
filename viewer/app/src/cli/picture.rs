//! Pictures in files: PNG written, references read, the two compared.

use std::io;
use std::path::Path;

use convert::command::{atomic, bytes};
use image::codecs::png::PngEncoder;
use image::{ImageFormat, RgbaImage};
use viewer::compare::{Difference, Tolerance, compare, strip};

/// Writes a PNG; the same picture gives the same bytes.
///
/// # Errors
///
/// In words with the path.
pub fn write(path: &Path, picture: &RgbaImage) -> Result<(), String> {
    atomic::make_folder_of(path)?;
    let written = atomic::write(path, |out| {
        picture
            .write_with_encoder(PngEncoder::new(out))
            .map_err(|error| match error {
                image::ImageError::IoError(error) => error,
                other => io::Error::other(other),
            })
    });
    match written {
        Ok(_) => Ok(()),
        Err(error) => Err(atomic::cannot_write(path, &error)),
    }
}

/// Reads a PNG.
///
/// # Errors
///
/// In words with the path.
pub fn read(path: &Path) -> Result<RgbaImage, String> {
    let decode = || {
        let bytes = bytes::read(path)?;
        let picture = image::load_from_memory_with_format(&bytes, ImageFormat::Png);
        picture.map_err(|error| format!("it is no PNG that can be read: {error}"))
    };
    match decode() {
        Ok(picture) => Ok(picture.into_rgba8()),
        Err(why) => Err(format!("{}: {why}", path.display())),
    }
}

/// How a picture compares with its reference.
pub enum Verdict {
    /// Within the tolerance.
    Same(Difference),
    /// Beyond it, with a strip to look at.
    Differs(Difference, Option<RgbaImage>),
    /// Of different size: why they cannot be compared.
    SizeDiffers(String),
}

/// Compares.
pub fn judge(reference: &RgbaImage, picture: &RgbaImage, tolerance: &Tolerance) -> Verdict {
    match compare(reference, picture, tolerance.step) {
        Err(error) => Verdict::SizeDiffers(error.to_string()),
        Ok(difference) if difference.is_within(tolerance) => Verdict::Same(difference),
        Ok(difference) => Verdict::Differs(difference, strip(reference, picture).ok().flatten()),
    }
}
