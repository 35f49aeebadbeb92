//! Decoded images, and their values between pixels. Only the largest level: no mipmaps.

use std::collections::BTreeMap;

use glam::DVec4;
use scenegraph::scene::{Image, Scene, TextureId, TextureSource, Wrap};

/// A decoded image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RefTexture {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Four bytes a pixel, row 0 is the top row. Grey is (g, g, g, a).
    pub rgba: Vec<u8>,
    /// Whether the image has an alpha channel; where it has none, alpha is 255 here.
    pub has_alpha: bool,
}

impl RefTexture {
    /// Some pixel is not opaque.
    pub fn is_transparent(&self) -> bool {
        self.rgba.iter().skip(3).step_by(4).any(|&a| a < 255)
    }

    /// Bilinear, 0 to 1; `t` is 0 at the bottom edge.
    pub fn sample(&self, [s, t]: [f64; 2], [wrap_s, wrap_t]: [Wrap; 2]) -> DVec4 {
        let (columns, across) = neighbours(s, self.width, wrap_s);
        let (rows, upwards) = neighbours(t, self.height, wrap_t);
        let [low, high] = rows.map(|row| {
            let [left, right] = columns.map(|column| self.pixel(column, self.height - 1 - row));
            left.lerp(right, across)
        });
        low.lerp(high, upwards)
    }

    fn pixel(&self, column: u32, row: u32) -> DVec4 {
        let at = 4 * (row as usize * self.width as usize + column as usize);
        let [r, g, b, a] = [0, 1, 2, 3].map(|i| f64::from(self.rgba[at + i]) / 255.0);
        DVec4::new(r, g, b, a)
    }
}

/// The two pixels whose centres are around `s`, and the weight of the second.
fn neighbours(s: f64, count: u32, wrap: Wrap) -> ([u32; 2], f64) {
    let size = f64::from(count);
    let at = match wrap {
        Wrap::Repeat => s - s.floor(),
        Wrap::Clamp => s.clamp(0.0, 1.0),
    } * size
        - 0.5;
    let first = at.floor();
    let pixel = |i: f64| match wrap {
        Wrap::Repeat => i.rem_euclid(size) as u32,
        Wrap::Clamp => i.clamp(0.0, size - 1.0) as u32,
    };
    ([pixel(first), pixel(first + 1.0)], at - first)
}

/// The textures whose pixels stand in the scene itself, not encoded.
pub fn inline_textures(scene: &Scene) -> BTreeMap<TextureId, RefTexture> {
    let ids = (0..).map(TextureId);
    ids.zip(&scene.textures)
        .filter_map(|(id, texture)| match &texture.source {
            TextureSource::Inline(image) => Some((id, decoded(image)?)),
            TextureSource::File { .. } | TextureSource::Encoded { .. } => None,
        })
        .collect()
}

/// `None` for an image without pixels.
fn decoded(image: &Image) -> Option<RefTexture> {
    let components = usize::from(image.components);
    let row_bytes = image.width as usize * components;
    if row_bytes == 0 || image.height == 0 {
        return None;
    }
    let pixels = image
        .bytes
        .chunks_exact(row_bytes)
        .rev()
        .flat_map(|row| row.chunks_exact(components));
    let rgba = pixels.flat_map(|pixel| match *pixel {
        [g] => [g, g, g, 255],
        [g, a] => [g, g, g, a],
        [r, g, b] => [r, g, b, 255],
        [r, g, b, a, ..] => [r, g, b, a],
        [] => [0; 4],
    });
    Some(RefTexture {
        width: image.width,
        height: image.height,
        rgba: rgba.collect(),
        has_alpha: components == 2 || components == 4,
    })
}
