//! How much two images differ: the measure behind `--reference`. It does not judge what is seen;
//! it counts bytes.
//!
//! Two numbers guard against two kinds of fault: the share of pixels that differ, against faint
//! differences everywhere, and the largest connected blob of them, because a small object that is
//! missing disappears in any average.

use std::fmt;

use image::RgbaImage;

/// What counts as equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// A pixel differs if one of its channels does by more than this.
    pub step: u8,
    /// Largest share of pixels that may differ, 0 to 1.
    pub max_share: f64,
    /// Largest number of differing pixels that may hang together.
    pub max_blob: usize,
}

impl Default for Tolerance {
    /// Two steps for roundings in f32 shading; 0.2 % and 12 pixels for edges that fall onto other
    /// pixel centres with another driver.
    fn default() -> Self {
        Self {
            step: 2,
            max_share: 0.002,
            max_blob: 12,
        }
    }
}

impl Tolerance {
    /// Equal bytes only.
    pub const EXACT: Self = Self {
        step: 0,
        max_share: 0.0,
        max_blob: 0,
    };
}

/// The difference of two images.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Pixels in the image.
    pub pixels: usize,
    /// Pixels with a channel beyond the step.
    pub differing: usize,
    /// Pixels in the largest group of differing ones that touch by a side or a corner.
    pub largest_blob: usize,
    /// Mean of the absolute difference over all channels of all pixels, 0 to 255.
    pub mean_abs: f64,
    /// Largest difference of a channel.
    pub max_step: u8,
}

impl Difference {
    /// Share of pixels beyond the step, 0 to 1; 0 for an image without pixels.
    #[must_use]
    pub fn share(&self) -> f64 {
        if self.pixels == 0 {
            0.0
        } else {
            self.differing as f64 / self.pixels as f64
        }
    }

    /// Whether it is small enough. `step` is not asked again: it was used to count.
    #[must_use]
    pub fn is_within(&self, tolerance: &Tolerance) -> bool {
        self.share() <= tolerance.max_share && self.largest_blob <= tolerance.max_blob
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} of {} pixels differ ({:.3} %), largest blob {}, largest step {}, mean {:.4}",
            self.differing,
            self.pixels,
            100.0 * self.share(),
            self.largest_blob,
            self.max_step,
            self.mean_abs
        )
    }
}

/// The images cannot be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SizesDiffer {
    /// Width and height of the first.
    pub a: (u32, u32),
    /// Width and height of the second.
    pub b: (u32, u32),
}

impl fmt::Display for SizesDiffer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ((aw, ah), (bw, bh)) = (self.a, self.b);
        write!(
            f,
            "the images are of different size: {aw} x {ah} and {bw} x {bh}"
        )
    }
}

impl std::error::Error for SizesDiffer {}

/// Compares channel by channel, alpha included. Time and memory are linear in the pixels.
///
/// # Errors
///
/// [`SizesDiffer`] if the images are not of one size.
pub fn compare(a: &RgbaImage, b: &RgbaImage, step: u8) -> Result<Difference, SizesDiffer> {
    same_size(a, b)?;
    let mut total = 0_u64;
    let mut max_step = 0;
    let mut beyond = Vec::with_capacity(a.len() / 4);
    for (p, q) in a.pixels().zip(b.pixels()) {
        let steps = steps(p.0, q.0);
        let most = steps.into_iter().fold(0, u8::max);
        total += steps.into_iter().map(u64::from).sum::<u64>();
        max_step = max_step.max(most);
        beyond.push(most > step);
    }
    let channels = 4 * beyond.len();
    Ok(Difference {
        pixels: beyond.len(),
        differing: beyond.iter().filter(|&&is_beyond| is_beyond).count(),
        max_step,
        mean_abs: if channels == 0 {
            0.0
        } else {
            total as f64 / channels as f64
        },
        largest_blob: largest_blob(beyond, a.width() as usize),
    })
}

fn same_size(a: &RgbaImage, b: &RgbaImage) -> Result<(), SizesDiffer> {
    if a.dimensions() == b.dimensions() {
        Ok(())
    } else {
        Err(SizesDiffer {
            a: a.dimensions(),
            b: b.dimensions(),
        })
    }
}

fn steps(p: [u8; 4], q: [u8; 4]) -> [u8; 4] {
    std::array::from_fn(|i| p[i].abs_diff(q[i]))
}

/// Pixels in the largest 8-connected group of set ones. Each is taken out of `set` when it is
/// found, so it is visited once.
fn largest_blob(mut set: Vec<bool>, width: usize) -> usize {
    let mut largest = 0;
    let mut found = Vec::new();
    for start in 0..set.len() {
        if !std::mem::take(&mut set[start]) {
            continue;
        }
        let mut size = 0;
        found.push(start);
        while let Some(i) = found.pop() {
            size += 1;
            let (x, y) = (i % width, i / width);
            for y in y.saturating_sub(1)..=y + 1 {
                for x in x.saturating_sub(1)..=(x + 1).min(width - 1) {
                    let neighbour = y * width + x;
                    if set.get_mut(neighbour).is_some_and(std::mem::take) {
                        found.push(neighbour);
                    }
                }
            }
        }
        largest = largest.max(size);
    }
    largest
}

/// Differences are shown this many times as large, so that four steps are visible and sixteen
/// saturate.
const AMPLIFICATION: u8 = 16;

/// First image, second image and amplified difference side by side, with no gap: what to look at
/// when a comparison fails. A difference in alpha is added to all colours. `None` if a side of the
/// strip would not fit in u32.
///
/// # Errors
///
/// [`SizesDiffer`] if the images are not of one size.
pub fn strip(a: &RgbaImage, b: &RgbaImage) -> Result<Option<RgbaImage>, SizesDiffer> {
    same_size(a, b)?;
    let (width, height) = a.dimensions();
    let Some(strip_width) = width.checked_mul(3) else {
        return Ok(None);
    };
    Ok(Some(RgbaImage::from_fn(strip_width, height, |x, y| {
        if x < width {
            *a.get_pixel(x, y)
        } else if x < 2 * width {
            *b.get_pixel(x - width, y)
        } else {
            let x = x - 2 * width;
            let [r, g, b, alpha] = steps(a.get_pixel(x, y).0, b.get_pixel(x, y).0);
            let shown = |step: u8| step.saturating_add(alpha).saturating_mul(AMPLIFICATION);
            image::Rgba([shown(r), shown(g), shown(b), 255])
        }
    })))
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgba;

    /// An image of grey values given as rows of digits, ten steps each; blanks are left out.
    fn grey(rows: &[&str]) -> RgbaImage {
        let digits: Vec<Vec<u8>> = (rows.iter())
            .map(|row| row.bytes().map(|b| (b - b'0') * 10).collect())
            .collect();
        let width = digits.first().map_or(0, Vec::len);
        RgbaImage::from_fn(width as u32, rows.len() as u32, |x, y| {
            let value = digits[y as usize][x as usize];
            Rgba([value, value, value, 255])
        })
    }

    #[test]
    fn counts_and_blobs() {
        // Second image (the first is all 5), step, differing, largest blob, largest step.
        let rows: [(&[&str], u8, usize, usize, u8); 9] = [
            (&["555", "555"], 0, 0, 0, 0),
            (&["565", "555"], 0, 1, 1, 10),
            (&["565", "555"], 9, 1, 1, 10),
            (&["565", "555"], 10, 0, 0, 10),
            (&["654", "555"], 0, 2, 1, 10),
            (&["655", "545"], 0, 2, 2, 10),
            (&["5559", "9555"], 0, 2, 1, 40),
            (&["66066", "65056", "66066"], 0, 13, 13, 50),
            (&["66566", "65556", "66066"], 0, 11, 11, 50),
        ];
        for (other, step, differing, largest_blob, max_step) in rows {
            let fives = vec!["55555"; other.len()];
            let fives: Vec<&str> = fives.iter().map(|row| &row[..other[0].len()]).collect();
            let (a, b) = (grey(&fives), grey(other));
            for (a, b) in [(&a, &b), (&b, &a)] {
                let d = compare(a, b, step).unwrap();
                assert_eq!(
                    (d.differing, d.largest_blob, d.max_step),
                    (differing, largest_blob, max_step),
                    "{other:?} {step}"
                );
                assert_eq!(d.pixels, other.len() * other[0].len());
            }
        }
    }

    #[test]
    fn a_blob_of_the_whole_image_is_one() {
        let a = RgbaImage::from_pixel(300, 200, Rgba([0, 0, 0, 255]));
        let b = RgbaImage::from_pixel(300, 200, Rgba([0, 0, 9, 255]));
        let d = compare(&a, &b, 2).unwrap();
        assert_eq!((d.differing, d.largest_blob), (60_000, 60_000));
        assert_eq!((d.share(), d.mean_abs), (1.0, 2.25));
    }

    #[test]
    fn each_channel_counts() {
        let a = RgbaImage::from_pixel(1, 1, Rgba([100, 100, 100, 100]));
        for channel in 0..4 {
            let mut b = a.clone();
            b.get_pixel_mut(0, 0).0[channel] = 104;
            let d = compare(&a, &b, 3).unwrap();
            assert_eq!(
                (d.differing, d.max_step, d.mean_abs),
                (1, 4, 1.0),
                "{channel}"
            );
        }
    }

    #[test]
    fn tolerance_sees_many_faint_pixels_and_one_small_object() {
        let a = RgbaImage::from_pixel(160, 120, Rgba([50, 50, 50, 255]));
        let with = |pixels: &[(u32, u32)], step: u8| {
            let mut b = a.clone();
            for &(x, y) in pixels {
                b.get_pixel_mut(x, y).0[1] = 50 + step;
            }
            b
        };
        let square = |side: u32| -> Vec<(u32, u32)> {
            (0..side * side)
                .map(|i| (40 + i % side, 40 + i / side))
                .collect()
        };
        let spread = |count: u32| -> Vec<(u32, u32)> {
            (0..count).map(|i| (i % 50 * 3, i / 50 * 3)).collect()
        };
        // 0.2 % of 19200 pixels is 38.4.
        let rows = [
            (with(&[], 0), true),
            (with(&spread(2000), 2), true),
            (with(&spread(38), 200), true),
            (with(&spread(39), 3), false),
            (with(&square(3), 200), true),
            (with(&square(4), 3), false),
        ];
        let tolerance = Tolerance::default();
        for (i, (b, is_within)) in rows.into_iter().enumerate() {
            let d = compare(&a, &b, tolerance.step).unwrap();
            assert_eq!(d.is_within(&tolerance), is_within, "{i}: {d}");
            let exact = compare(&a, &b, 0).unwrap().is_within(&Tolerance::EXACT);
            assert_eq!(exact, i == 0, "{i}");
        }
    }

    #[test]
    fn sizes_must_agree() {
        let (a, b) = (RgbaImage::new(2, 3), RgbaImage::new(3, 2));
        let expected = SizesDiffer {
            a: (2, 3),
            b: (3, 2),
        };
        assert_eq!(compare(&a, &b, 255), Err(expected));
        assert_eq!(strip(&a, &b), Err(expected));
        let nothing = RgbaImage::new(0, 0);
        let d = compare(&nothing, &nothing, 0).unwrap();
        assert_eq!(d, Difference::default());
        assert!(d.is_within(&Tolerance::EXACT));
    }

    #[test]
    fn strips_show_both_and_the_difference() {
        let a = RgbaImage::from_raw(1, 1, vec![10, 20, 30, 255]).unwrap();
        let b = RgbaImage::from_raw(1, 1, vec![11, 20, 230, 253]).unwrap();
        let strip = strip(&a, &b).unwrap().unwrap();
        assert_eq!(strip.dimensions(), (3, 1));
        assert_eq!(
            strip.into_raw(),
            [10, 20, 30, 255, 11, 20, 230, 253, 48, 32, 255, 255]
        );
    }
}
