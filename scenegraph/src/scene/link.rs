//! Where a part leads when it is chosen: `WWWAnchor`, and `Anchor` of VRML 2.0.

use std::sync::Arc;

/// A link of a group.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Link {
    /// The addresses as written, the first that can be had counts. Never empty.
    pub urls: Vec<Arc<str>>,
    /// What is shown of it; may be empty.
    pub description: Arc<str>,
    /// What a browser is told besides (`parameter` of VRML 2.0).
    pub parameters: Vec<Arc<str>>,
    /// Whether the place that was chosen goes into the address (`map POINT`).
    pub tells_point: bool,
}
