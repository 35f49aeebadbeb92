//! The containers: `.glb`, and `.gltf` with `.bin` or with all in it.

use std::io::Write;

use crate::base64::Base64;
use crate::plan::Plan;
use crate::{Error, Report};

const GLB_MAGIC: u32 = 0x4654_6c67;
const GLB_VERSION: u32 = 2;
const CHUNK_JSON: u32 = 0x4e4f_534a;
const CHUNK_BIN: u32 = 0x004e_4942;
const DATA_URI: &str = "data:application/octet-stream;base64,";
const HEADER_BYTES: u64 = 12;
const CHUNK_HEADER_BYTES: u64 = 8;

impl Plan<'_> {
    /// Writes a `.glb`; the plan must be one for it.
    pub(crate) fn write_glb(&self, out: &mut dyn Write) -> Result<Report, Error> {
        let (mut json, nodes) = self.json(|_| None);
        while !json.len().is_multiple_of(4) {
            json.push(b' ');
        }
        let bin_bytes = self.layout.buffers.first().copied();
        let padded = bin_bytes.map(|bytes| bytes.next_multiple_of(4));
        let bin_chunk = padded.map_or(0, |bytes| CHUNK_HEADER_BYTES + bytes);
        let bytes = HEADER_BYTES + CHUNK_HEADER_BYTES + json.len() as u64 + bin_chunk;
        let limit = self.options.max_glb_bytes.min(u32::MAX.into());
        if bytes > limit {
            return Err(Error::GlbTooLarge { bytes, limit });
        }
        // All lengths are parts of the one just checked.
        let words = |out: &mut dyn Write, words: &[u32]| {
            words
                .iter()
                .try_for_each(|word| out.write_all(&word.to_le_bytes()))
        };
        words(
            out,
            &[
                GLB_MAGIC,
                GLB_VERSION,
                bytes as u32,
                json.len() as u32,
                CHUNK_JSON,
            ],
        )?;
        out.write_all(&json)?;
        if let (Some(bin_bytes), Some(padded)) = (bin_bytes, padded) {
            words(out, &[padded as u32, CHUNK_BIN])?;
            self.write_buffer(0, out)?;
            let zeros = [0; 3];
            out.write_all(&zeros[..(padded - bin_bytes) as usize])?;
        }
        Ok(self.report_with(nodes, bytes))
    }

    /// Writes the text of a `.gltf`; `uris` name its buffers.
    pub(crate) fn write_gltf_text(
        &self,
        uris: &[String],
        out: &mut dyn Write,
    ) -> Result<Report, Error> {
        let (json, nodes) = self.json(|buffer| uris.get(buffer).cloned());
        out.write_all(&json)?;
        let bytes = json.len() as u64 + self.layout.buffers.iter().sum::<u64>();
        Ok(self.report_with(nodes, bytes))
    }

    /// Writes the text of a `.gltf` that holds its buffers too.
    pub(crate) fn write_gltf_embedded(&self, out: &mut dyn Write) -> Result<Report, Error> {
        let mut uris = Vec::new();
        for buffer in 0..self.layout.buffers.len() {
            let mut text = Base64::new(DATA_URI.as_bytes().to_vec());
            self.write_buffer(buffer, &mut text)?;
            // Digits are ASCII.
            uris.push(String::from_utf8(text.finish()?).unwrap_or_default());
        }
        let (json, nodes) = self.json(|buffer| uris.get(buffer).cloned());
        out.write_all(&json)?;
        Ok(self.report_with(nodes, json.len() as u64))
    }

    fn report_with(&self, nodes: usize, bytes: u64) -> Report {
        let mut report = self.report.clone();
        report.counts.nodes = nodes;
        report.counts.bytes = bytes;
        report
    }
}
