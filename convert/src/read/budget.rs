//! How much a file may make of itself: a few bytes of text can ask for any number of copies.

use super::error::ReadError;

/// Limits of a reader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadLimits {
    /// Nesting of nodes: those of an Inventor file, twice where they shear, and some.
    pub depth: usize,
    /// Nodes, instances, lights and cameras in the scene together.
    pub items: usize,
    /// Bytes of files, geometry and images together.
    pub bytes: u64,
}

impl Default for ReadLimits {
    fn default() -> Self {
        Self {
            depth: 4000,
            items: 2_000_000,
            bytes: 16 << 30,
        }
    }
}

/// What any file may make.
const BASE_BYTES: u64 = 256 << 20;
/// What each of its bytes may make besides: a one-byte index becomes, unlit, four bytes, and
/// lit without normals a vertex of 48 bytes too.
const GROWTH: u64 = 64;

/// What may still be made.
#[derive(Debug)]
pub(crate) struct Budget {
    limits: ReadLimits,
    read: u64,
    made: u64,
    items: usize,
}

impl Budget {
    pub(crate) fn new(limits: ReadLimits) -> Self {
        Self {
            limits,
            read: 0,
            made: 0,
            items: 0,
        }
    }

    /// Takes note of bytes read.
    pub(crate) fn grow(&mut self, bytes: u64) -> Result<(), ReadError> {
        self.read = self.read.saturating_add(bytes);
        self.take(0)
    }

    /// Takes bytes that are about to be made.
    pub(crate) fn take(&mut self, bytes: u64) -> Result<(), ReadError> {
        self.made = self.made.saturating_add(bytes);
        let by_size = BASE_BYTES.saturating_add(self.read.saturating_mul(GROWTH));
        let limit = by_size.min(self.limits.bytes);
        if self.made.saturating_add(self.read) > limit {
            let what = "bytes of geometry and images";
            return Err(ReadError::Limit { what, limit });
        }
        Ok(())
    }

    /// Takes items that are about to be added to the scene.
    pub(crate) fn take_items(&mut self, count: usize) -> Result<(), ReadError> {
        self.items = self.items.saturating_add(count);
        let limit = self.limits.items;
        if self.items > limit {
            let (what, limit) = ("nodes and instances", limit as u64);
            return Err(ReadError::Limit { what, limit });
        }
        Ok(())
    }

    pub(crate) fn check_depth(&self, depth: usize) -> Result<(), ReadError> {
        let limit = self.limits.depth;
        if depth > limit {
            let (what, limit) = ("levels of nodes", limit as u64);
            return Err(ReadError::Limit { what, limit });
        }
        Ok(())
    }
}
