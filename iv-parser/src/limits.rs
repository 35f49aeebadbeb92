//! Named limits on what an input may demand.

/// Limits of one parse. Each exists so that no input can exhaust memory or time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Longest input. Spans are 32 bits wide.
    pub bytes: usize,
    /// Deepest nesting of nodes. Real models stay below 100; glTF readers recurse over what we write.
    pub depth: usize,
    /// Problems kept; later ones are only counted.
    pub problems: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            bytes: u32::MAX as usize,
            depth: 1000,
            problems: 200,
        }
    }
}
