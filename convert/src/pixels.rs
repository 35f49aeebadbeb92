//! Decoded images, for those who show a scene. The converter itself passes files through where
//! glTF allows it, and does not come here.

use scenegraph::scene;

use crate::image::{decode_file, inline_pixels};

/// An image in memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pixels {
    /// Pixels; at least 1.
    pub width: u32,
    /// Pixels; at least 1.
    pub height: u32,
    /// Four bytes a pixel (grey is repeated), rows from top to bottom.
    pub rgba: Vec<u8>,
    /// Some alpha is below 255.
    pub has_alpha: bool,
}

impl Pixels {
    /// Decodes a file's bytes; `name` only tells formats apart that have no signature.
    ///
    /// # Errors
    ///
    /// In words: the format is not known, the content broken, or the image too large.
    pub fn from_file(bytes: &[u8], name: &str) -> Result<Self, String> {
        decode_file(bytes, name).map(|image| Self::new(&image))
    }

    /// The pixels of an image given in the model.
    ///
    /// # Errors
    ///
    /// In words: its bytes do not fill its size.
    pub fn from_inline(image: &scene::Image) -> Result<Self, String> {
        inline_pixels(image).map(|image| Self::new(&image))
    }

    fn new(image: &::image::DynamicImage) -> Self {
        let rgba = image.to_rgba8();
        Self {
            width: rgba.width(),
            height: rgba.height(),
            has_alpha: rgba.pixels().any(|p| p.0[3] < 255),
            rgba: rgba.into_raw(),
        }
    }
}
