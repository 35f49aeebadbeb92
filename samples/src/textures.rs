//! The PNG textures of the samples, made from integer arithmetic only, so that every machine makes
//! the same pixels. sRGB values; row 0 is the top row.

use image::{Rgb, RgbImage};

/// File name below `samples/data/textures` and the pixels.
pub type NamedTexture = (&'static str, RgbImage);

/// Every texture file of the samples.
#[must_use]
pub fn all() -> Vec<NamedTexture> {
    vec![
        ("floor_tiles.png", image_of(128, floor_tiles)),
        ("bricks.png", image_of(128, bricks)),
        ("roof_tiles.png", image_of(128, roof_tiles)),
        ("orientation.png", image_of(64, orientation)),
    ]
}

fn image_of(size: u32, pixel: fn(u32, u32) -> [u8; 3]) -> RgbImage {
    RgbImage::from_fn(size, size, |x, y| Rgb(pixel(x, y)))
}

/// Two by two square tiles, sand and terracotta, with grey joints.
fn floor_tiles(x: u32, y: u32) -> [u8; 3] {
    let (column, row) = (x / 64, y / 64);
    let (in_x, in_y) = (x % 64, y % 64);
    if in_x.min(in_y) < 1 || in_x.max(in_y) > 62 {
        return grained([150, 144, 134], x, y, 6);
    }
    let is_worn_edge = in_x.min(in_y) < 3 || in_x.max(in_y) > 60;
    let base = match ((column + row) % 2, is_worn_edge) {
        (0, false) => [214, 199, 170],
        (0, true) => [198, 182, 153],
        (_, false) => [176, 120, 92],
        (_, true) => [160, 106, 80],
    };
    grained(base, x, y, 9)
}

/// Eight courses of bricks in running bond; each brick has a shade of its own.
fn bricks(x: u32, y: u32) -> [u8; 3] {
    let course = y / 16;
    let shifted = (x + 32 * (course % 2)) % 128;
    if y % 16 < 2 || shifted % 64 < 2 {
        return grained([206, 200, 188], x, y, 8);
    }
    let shade = i32::from(hash(shifted / 64, course, 7) % 29) - 14;
    let base = [186, 134, 108].map(|channel| channel + shade);
    grained(base, x, y, 12)
}

/// Eight columns of round clay tiles in one course, dark where the next column overlaps.
fn roof_tiles(x: u32, y: u32) -> [u8; 3] {
    let in_tile = i32::try_from(x % 16).unwrap_or(0);
    let from_crest = (2 * in_tile - 15).abs();
    let roundness = 18 - from_crest * from_crest / 5;
    let weathering = i32::from(hash(x / 16, y / 128, 3) % 25) - 12;
    let base = [162, 84, 62].map(|channel| channel + roundness + weathering);
    grained(base, x, y, 10)
}

/// A letter R that shows mirroring and turning, and four corner colours: top left red, top right
/// green, bottom left blue, bottom right yellow.
fn orientation(x: u32, y: u32) -> [u8; 3] {
    const LETTER: [&[u8; 5]; 7] = [
        b"####.", b"#...#", b"#...#", b"####.", b"#.#..", b"#..#.", b"#...#",
    ];
    let is_corner = x.min(63 - x) < 12 && y.min(63 - y) < 12;
    if is_corner {
        return match (x < 32, y < 32) {
            (true, true) => [214, 48, 49],
            (false, true) => [56, 161, 72],
            (true, false) => [48, 96, 190],
            (false, false) => [240, 200, 60],
        };
    }
    let cell = |at: u32, first: u32| at.checked_sub(first).map(|d| (d / 5) as usize);
    let is_ink = cell(y, 14)
        .and_then(|row| LETTER.get(row))
        .and_then(|row| row.get(cell(x, 20)?))
        .is_some_and(|&mark| mark == b'#');
    if is_ink {
        [40, 44, 52]
    } else {
        [236, 233, 224]
    }
}

/// `base` plus a little noise, the same in all channels and in blocks of 2 x 2 pixels.
fn grained(base: [i32; 3], x: u32, y: u32, amount: u8) -> [u8; 3] {
    let noise = i32::from(hash(x / 2, y / 2, 1) % (2 * amount + 1)) - i32::from(amount);
    base.map(|channel| u8::try_from((channel + noise).clamp(0, 255)).unwrap_or(0))
}

/// A well-mixed byte of two coordinates and a seed.
pub(crate) fn hash(x: u32, y: u32, seed: u32) -> u8 {
    let mut h =
        x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77) ^ seed.wrapping_mul(0xc2b2_ae3d);
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    h.to_be_bytes()[0] ^ h.to_be_bytes()[3]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::manifest::data_dir;

    /// Pixels are compared, not file bytes: another version of the PNG encoder may pack the same
    /// picture differently.
    #[test]
    fn committed_textures_are_current() {
        for (name, expected) in all() {
            let path = data_dir().join("textures").join(name);
            let committed =
                image::open(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
            assert_eq!(
                committed.to_rgb8(),
                expected,
                "{name} is old: run gen-pavilion"
            );
        }
    }
}
