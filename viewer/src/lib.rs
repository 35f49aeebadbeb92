//! The renderer: a resolved scene in, an image out.
//!
//! It needs no window; pictures in files and the window are two callers of the same functions.

pub mod bounds;
pub mod compare;
pub mod content;
pub mod frame;
pub mod gpu;
pub mod hierarchy;
pub mod navigate;
pub mod overlay;
pub mod pick;
pub mod shader;
pub mod texture;
pub mod view;
pub mod volume;
