//! Images as glTF allows them: PNG and JPEG files stay byte for byte, all else becomes PNG.
//!
//! Knows bytes and pixels only; which image belongs to which material is in `texture`.

use std::io::Cursor;

use ::image::codecs::png::PngEncoder;
use ::image::codecs::webp::WebPEncoder;
use ::image::{
    DynamicImage, ExtendedColorType, GrayAlphaImage, GrayImage, ImageDecoder, ImageEncoder,
    ImageFormat, ImageReader, Limits, RgbImage, RgbaImage,
};
use scenegraph::scene;

use crate::options::TextureFormat;

/// Largest width and height taken; the limit of current graphics devices is half of it.
const MAX_IMAGE_SIDE: u32 = 32_768;
/// Most memory a decoder may take: a 16k x 8k RGBA image. A few bytes can claim far more.
const MAX_DECODED_BYTES: u64 = 512 << 20;
const UNKNOWN_FORMAT: &str = "neither the content nor the name tells a known image format";
/// First bytes of SGI `.rgb`, `.rgba` and `.bw` files.
const SGI_MAGIC: [u8; 2] = [0x01, 0xda];

/// Of [`Encoded::mime`].
pub(crate) const WEBP: &str = "image/webp";
const PNG: &str = "image/png";

/// What the alpha channel of an image holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Alpha {
    /// No channel, or 1 everywhere.
    Opaque,
    /// 0 and 1 only.
    Mask,
    /// Something between, too.
    Blend,
}

/// An image ready for glTF.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Encoded {
    pub(crate) bytes: Vec<u8>,
    pub(crate) mime: &'static str,
    pub(crate) alpha: Alpha,
    /// How many there are.
    pub(crate) pixels: u64,
}

/// How a texture meets a colour without lighting, for [`Encoded::mixed_with`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Mix {
    /// The texture over the colour by its alpha.
    Decal,
    /// From the colour to this one by the texture's intensity, in each channel.
    Blend([u8; 3]),
}

impl Encoded {
    /// Takes a file's bytes; `name` only tells formats apart that have no signature.
    pub(crate) fn from_file(bytes: Vec<u8>, name: &str) -> Result<Self, String> {
        let Some(format) = sniff(&bytes, name) else {
            return Err(UNKNOWN_FORMAT.to_owned());
        };
        let (known, mime) = match format {
            Format::Known(known @ ImageFormat::Png) => (known, "image/png"),
            Format::Known(known @ ImageFormat::Jpeg) => (known, "image/jpeg"),
            _ => return Self::from_pixels(&decode(&bytes, format)?),
        };
        let header = Header::read(&bytes, known)?;
        let alpha = if header.has_alpha {
            alpha_of(&decode(&bytes, format)?)
        } else {
            Alpha::Opaque
        };
        let pixels = header.pixels;
        Ok(Self {
            bytes,
            mime,
            alpha,
            pixels,
        })
    }

    /// Takes an `SFImage`, whose rows go from bottom to top.
    pub(crate) fn from_inline(image: &scene::Image) -> Result<Self, String> {
        Self::from_pixels(&inline_pixels(image)?)
    }

    /// A copy mixed with a colour; all of it display-referred, as Inventor mixes. The alpha
    /// channel is used up by [`Mix::Decal`] and kept by [`Mix::Blend`].
    pub(crate) fn mixed_with(&self, color_srgb: [u8; 3], mix: Mix) -> Result<Self, String> {
        let format = sniff(&self.bytes, "").ok_or("not an image")?;
        let mut pixels = decode(&self.bytes, format)?.into_rgba8();
        let between = |from: u8, to: u8, share: u8| {
            let (from, to, share) = (u32::from(from), u32::from(to), u32::from(share));
            ((from * (255 - share) + to * share + 127) / 255) as u8
        };
        for pixel in pixels.pixels_mut() {
            let [r, g, b, alpha] = pixel.0;
            let texel = [r, g, b];
            for (channel, value) in texel.into_iter().enumerate() {
                let under = color_srgb[channel];
                pixel.0[channel] = match mix {
                    Mix::Decal => between(under, value, alpha),
                    Mix::Blend(to) => between(under, to[channel], value),
                };
            }
        }
        let pixels = DynamicImage::from(pixels);
        match mix {
            Mix::Blend(_) if self.alpha != Alpha::Opaque => Self::from_pixels(&pixels),
            _ => Self::from_pixels(&pixels.into_rgb8().into()),
        }
    }

    /// Takes another format if that is asked for, and for WebP, if it is shorter. What cannot be
    /// decoded stays as it is.
    pub(crate) fn put_into(&mut self, format: TextureFormat) {
        let is_png = self.mime == PNG;
        let other = match format {
            TextureFormat::Keep => None,
            TextureFormat::Png if is_png => None,
            TextureFormat::Png => self.decoded().and_then(|p| Self::from_pixels(&p).ok()),
            TextureFormat::Webp => {
                let webp = self.decoded().and_then(|p| self.webp(&p).ok());
                webp.filter(|webp| webp.bytes.len() < self.bytes.len())
            }
        };
        if let Some(other) = other {
            *self = other;
        }
    }

    fn decoded(&self) -> Option<DynamicImage> {
        decode(&self.bytes, sniff(&self.bytes, "")?).ok()
    }

    fn webp(&self, pixels: &DynamicImage) -> Result<Self, String> {
        let mut bytes = Vec::new();
        let encoder = WebPEncoder::new_lossless(&mut bytes);
        let (width, height) = (pixels.width(), pixels.height());
        let written = if pixels.color().has_alpha() {
            let rgba = pixels.to_rgba8();
            encoder.write_image(&rgba, width, height, ExtendedColorType::Rgba8)
        } else {
            let rgb = pixels.to_rgb8();
            encoder.write_image(&rgb, width, height, ExtendedColorType::Rgb8)
        };
        written.map_err(|e| e.to_string())?;
        Ok(Self {
            bytes,
            mime: WEBP,
            ..*self
        })
    }

    fn from_pixels(pixels: &DynamicImage) -> Result<Self, String> {
        let mut bytes = Vec::new();
        let encoder = PngEncoder::new(&mut bytes);
        let (width, height) = (pixels.width(), pixels.height());
        let color = pixels.color();
        let written = match (color.has_color(), color.has_alpha()) {
            (false, false) => {
                encoder.write_image(&pixels.to_luma8(), width, height, ExtendedColorType::L8)
            }
            (false, true) => encoder.write_image(
                &pixels.to_luma_alpha8(),
                width,
                height,
                ExtendedColorType::La8,
            ),
            (true, false) => {
                encoder.write_image(&pixels.to_rgb8(), width, height, ExtendedColorType::Rgb8)
            }
            (true, true) => {
                encoder.write_image(&pixels.to_rgba8(), width, height, ExtendedColorType::Rgba8)
            }
        };
        written.map_err(|e| e.to_string())?;
        Ok(Self {
            bytes,
            mime: "image/png",
            alpha: alpha_of(pixels),
            pixels: u64::from(width) * u64::from(height),
        })
    }
}

#[derive(Clone, Copy)]
enum Format {
    Known(ImageFormat),
    Sgi,
}

/// By content; only TGA has no signature and goes by its name.
fn sniff(bytes: &[u8], name: &str) -> Option<Format> {
    if bytes.starts_with(&SGI_MAGIC) {
        return Some(Format::Sgi);
    }
    if let Ok(format) = ::image::guess_format(bytes) {
        return Some(Format::Known(format));
    }
    let tga = name.len() >= 4 && name.as_bytes()[name.len() - 4..].eq_ignore_ascii_case(b".tga");
    tga.then_some(Format::Known(ImageFormat::Tga))
}

/// The usual extension of a file with these bytes; PNG's for what is not known.
pub(crate) fn extension_of(bytes: &[u8]) -> &'static str {
    match sniff(bytes, "") {
        Some(Format::Sgi) => "rgb",
        Some(Format::Known(ImageFormat::Jpeg)) => "jpg",
        Some(Format::Known(known)) => known.extensions_str().first().copied().unwrap_or("png"),
        None => "png",
    }
}

fn limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_IMAGE_SIDE);
    limits.max_image_height = Some(MAX_IMAGE_SIDE);
    limits.max_alloc = Some(MAX_DECODED_BYTES);
    limits
}

fn reader(bytes: &[u8], format: ImageFormat) -> ImageReader<Cursor<&[u8]>> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits());
    reader
}

/// The pixels of an image given in the model, rows from top to bottom.
pub(crate) fn inline_pixels(image: &scene::Image) -> Result<DynamicImage, String> {
    let scene::Image {
        width,
        height,
        components,
        ref bytes,
    } = *image;
    let stride = u64::from(width) * u64::from(components);
    let sound = (1..=4).contains(&components)
        && stride > 0
        && height > 0
        && stride.checked_mul(u64::from(height)) == Some(bytes.len() as u64);
    if !sound {
        return Err(format!(
            "{} bytes do not make {width} x {height} pixels of {components} components",
            bytes.len()
        ));
    }
    // The product above is the length of an array, so the stride fits.
    let rows = bytes.chunks_exact(stride as usize).rev();
    let top_down: Vec<u8> = rows.flatten().copied().collect();
    let pixels: Option<DynamicImage> = match components {
        1 => GrayImage::from_raw(width, height, top_down).map(Into::into),
        2 => GrayAlphaImage::from_raw(width, height, top_down).map(Into::into),
        3 => RgbImage::from_raw(width, height, top_down).map(Into::into),
        _ => RgbaImage::from_raw(width, height, top_down).map(Into::into),
    };
    pixels.ok_or_else(|| "the pixels do not fill the image".to_owned())
}

/// The pixels of a file; `name` only tells formats apart that have no signature.
pub(crate) fn decode_file(bytes: &[u8], name: &str) -> Result<DynamicImage, String> {
    match sniff(bytes, name) {
        Some(format) => decode(bytes, format),
        None => Err(UNKNOWN_FORMAT.to_owned()),
    }
}

/// What an image says before its pixels.
struct Header {
    pixels: u64,
    has_alpha: bool,
}

impl Header {
    fn read(bytes: &[u8], format: ImageFormat) -> Result<Self, String> {
        let decoder = reader(bytes, format).into_decoder();
        let decoder = decoder.map_err(|e| e.to_string())?;
        let (width, height) = decoder.dimensions();
        let allowed = limits().check_dimensions(width, height);
        allowed.map_err(|e| e.to_string())?;
        Ok(Self {
            pixels: u64::from(width) * u64::from(height),
            has_alpha: decoder.color_type().has_alpha(),
        })
    }
}

fn decode(bytes: &[u8], format: Format) -> Result<DynamicImage, String> {
    let decoded = match format {
        Format::Known(format) => reader(bytes, format).decode(),
        Format::Sgi => decode_sgi(bytes),
    };
    decoded.map_err(|e| e.to_string())
}

fn decode_sgi(bytes: &[u8]) -> ::image::ImageResult<DynamicImage> {
    let mut decoder = image_extras::sgi::SgiDecoder::new(Cursor::new(bytes))?;
    let mut limits = limits();
    let (width, height) = decoder.dimensions();
    limits.check_dimensions(width, height)?;
    limits.reserve(decoder.total_bytes())?;
    decoder.set_limits(limits)?;
    DynamicImage::from_decoder(decoder)
}

fn alpha_of(pixels: &DynamicImage) -> Alpha {
    fn scan(values: impl Iterator<Item = u8>) -> Alpha {
        let mut alpha = Alpha::Opaque;
        for value in values {
            match value {
                255 => {}
                0 => alpha = Alpha::Mask,
                _ => return Alpha::Blend,
            }
        }
        alpha
    }
    match pixels {
        _ if !pixels.color().has_alpha() => Alpha::Opaque,
        DynamicImage::ImageLumaA8(image) => scan(image.pixels().map(|p| p.0[1])),
        DynamicImage::ImageRgba8(image) => scan(image.pixels().map(|p| p.0[3])),
        _ => scan(pixels.to_rgba8().pixels().map(|p| p.0[3])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn png(pixels: DynamicImage) -> Vec<u8> {
        encoded(pixels, ImageFormat::Png)
    }

    fn encoded(pixels: DynamicImage, format: ImageFormat) -> Vec<u8> {
        let mut out = Cursor::new(Vec::new());
        pixels.write_to(&mut out, format).unwrap();
        out.into_inner()
    }

    fn rgba(alphas: &[u8]) -> DynamicImage {
        let bytes = alphas.iter().flat_map(|&a| [10, 20, 30, a]).collect();
        RgbaImage::from_raw(alphas.len() as u32, 1, bytes)
            .unwrap()
            .into()
    }

    #[test]
    fn png_and_jpeg_pass_through_whatever_their_name() {
        for (bytes, mime) in [
            (png(rgba(&[255, 0])), "image/png"),
            (
                encoded(RgbImage::new(3, 2).into(), ImageFormat::Jpeg),
                "image/jpeg",
            ),
        ] {
            let got = Encoded::from_file(bytes.clone(), "wrong.tga").unwrap();
            assert!(got.bytes == bytes);
            assert_eq!(got.mime, mime);
        }
    }

    #[test]
    fn other_formats_become_png_with_the_same_pixels() {
        use ImageFormat::{Bmp, Gif, Tga, Tiff, WebP};
        let pixels = rgba(&[255, 255, 0]);
        for format in [Gif, Bmp, Tiff, Tga, WebP] {
            let file = encoded(pixels.clone(), format);
            let name = if format == Tga { "x.TGA" } else { "x" };
            let got = Encoded::from_file(file, name).unwrap();
            assert_eq!(got.mime, "image/png", "{format:?}");
            assert_eq!(got.alpha, Alpha::Mask, "{format:?}");
            let back = ::image::load_from_memory(&got.bytes).unwrap().into_rgba8();
            assert_eq!(back.get_pixel(0, 0).0, [10, 20, 30, 255], "{format:?}");
        }
    }

    #[test]
    fn sgi_images_are_read() {
        // Two rows of one RGB pixel, verbatim, the lower row first, one plane after the other.
        let mut file = vec![0; 512];
        file[..12].copy_from_slice(&[0x01, 0xda, 0, 1, 0, 3, 0, 1, 0, 2, 0, 3]);
        file[19] = 255;
        file.extend([1, 4, 2, 5, 3, 6]);
        let got = Encoded::from_file(file, "x.rgb").unwrap();
        let back = ::image::load_from_memory(&got.bytes).unwrap().into_rgb8();
        assert_eq!(back.into_raw(), [4, 5, 6, 1, 2, 3]);
    }

    #[test]
    fn inline_images_are_turned_upside_down_and_keep_their_components() {
        use ::image::ColorType::{L8, La8, Rgb8, Rgba8};
        for (components, color) in [(1, L8), (2, La8), (3, Rgb8), (4, Rgba8)] {
            let row = |v: u8| vec![v; 2 * usize::from(components)];
            let bytes = [row(1), row(2), row(3)].concat();
            let image = scene::Image {
                width: 2,
                height: 3,
                components,
                bytes,
            };
            let got = Encoded::from_inline(&image).unwrap();
            let back = ::image::load_from_memory(&got.bytes).unwrap();
            assert_eq!(back.color(), color);
            assert_eq!(back.into_bytes(), [row(3), row(2), row(1)].concat());
        }
    }

    #[test]
    fn unsound_images_are_refused() {
        let inline = |width, height, components, len| {
            Encoded::from_inline(&scene::Image {
                width,
                height,
                components,
                bytes: vec![0; len],
            })
        };
        for (width, height, components, len) in [
            (0, 0, 3, 0),
            (1, 1, 0, 0),
            (1, 1, 5, 5),
            (2, 2, 3, 11),
            (u32::MAX, u32::MAX, 4, 4),
        ] {
            assert!(inline(width, height, components, len).is_err());
        }
        let mut bomb = png(rgba(&[0]));
        bomb[16..24].copy_from_slice(&[0, 1, 0, 0, 0, 1, 0, 0]);
        for bytes in [
            vec![],
            b"hello".to_vec(),
            b"\x89PNG\r\n\x1a\n".to_vec(),
            bomb,
        ] {
            assert!(Encoded::from_file(bytes, "x.png").is_err());
        }
    }

    #[test]
    fn alpha_is_judged_by_the_texels() {
        for (alphas, want) in [
            ([255, 255], Alpha::Opaque),
            ([255, 0], Alpha::Mask),
            ([0, 128], Alpha::Blend),
        ] {
            assert_eq!(
                Encoded::from_file(png(rgba(&alphas)), "").unwrap().alpha,
                want
            );
        }
    }

    #[test]
    fn texture_models_are_mixed_in_display_colours() {
        let image = Encoded::from_file(png(rgba(&[255, 0, 51])), "").unwrap();
        let pixels = |mix| {
            let mixed = image.mixed_with([110, 120, 130], mix).unwrap();
            (
                ::image::load_from_memory(&mixed.bytes)
                    .unwrap()
                    .into_rgba8()
                    .into_raw(),
                mixed.alpha,
            )
        };
        let decal = [10, 20, 30, 255, 110, 120, 130, 255, 90, 100, 110, 255];
        assert_eq!(pixels(Mix::Decal), (decal.to_vec(), Alpha::Opaque));
        // 110 * 245/255 + 255 * 10/255 and so on, rounded.
        let (blend, alpha) = pixels(Mix::Blend([255, 0, 130]));
        assert_eq!(blend[..4], [116, 111, 130, 255]);
        assert_eq!(alpha, Alpha::Blend);
    }
}
