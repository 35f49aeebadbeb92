//! Pictures: raw bytes since 2.1, a word for each pixel before.

use super::{Fault, Reader};
use crate::tree::Value;

impl Reader<'_, '_> {
    /// A picture of so many dimensions, as the numbers that text would have written.
    pub(super) fn image(&mut self, dimensions: usize) -> Result<Value, Fault> {
        let start = self.words.at;
        let mut head = [1; 4];
        for size in head.iter_mut().take(dimensions + 1) {
            *size = self.words.word().ok_or(Fault::End)?;
        }
        let components = head[dimensions] as usize;
        head[dimensions] = 1;
        let mut pixels = 1_usize;
        for &size in &head {
            // Beyond the file's length the exact number does not matter.
            pixels = pixels.saturating_mul(size as usize);
        }
        head[dimensions] = components as u32;
        if components > 4 {
            return Err(Fault::Bad("a picture"));
        }
        let head = head.into_iter().take(dimensions + 1);
        let numbers = if self.header.version < (2, 1) {
            let pixels = if components == 0 { 0 } else { pixels };
            let bytes = self
                .words
                .items(pixels, 4)
                .ok_or_else(|| self.fault("a picture"))?;
            let (words, _) = bytes.as_chunks::<4>();
            let words = words.iter().map(|word| u32::from_be_bytes(*word));
            self.whole_numbers(head.chain(words))
        } else {
            let len = pixels.saturating_mul(components);
            let bytes = self
                .words
                .take(len)
                .ok_or_else(|| self.fault("a picture"))?;
            self.skip_padding(len);
            let pixels = bytes.chunks_exact(components.max(1));
            let pixel = |bytes: &[u8]| bytes.iter().fold(0, |word, b| word << 8 | u32::from(*b));
            self.whole_numbers(head.chain(pixels.map(pixel)))
        };
        Ok(Value::Numbers {
            numbers,
            bracketed: false,
            octal: false,
            span: self.span_from(start),
        })
    }

    /// Behind the bytes of a picture: SGI's writer goes on at once, Coin's at the next multiple of
    /// four of their number. What follows tells which it was.
    fn skip_padding(&mut self, len: usize) {
        let plain = self.words.at;
        let padded = plain + (len.next_multiple_of(4) - len);
        let fits = |at| self.follows(at) && self.words.from(at).left() >= 4;
        if !fits(plain) && fits(padded) {
            self.words.at = padded;
        }
    }
}
