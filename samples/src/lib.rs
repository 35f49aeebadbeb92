//! The project's own sample models: one list for tests, documentation and the viewer's menu.
//!
//! [`manifest::ALL`] names every model below `samples/data`. The small ones are written by
//! hand, one idea each. The large one, `pavilion.iv`, and the PNG textures are written by
//! [`pavilion`] and [`textures`]; `cargo run -p samples --bin gen-pavilion` writes them again.
//! Nothing here reads Inventor files: a fault of the reader must not hide in its own test data.

mod iv_writer;
pub mod manifest;
pub mod pavilion;
mod solid;
pub mod textures;

pub use manifest::{ALL, Sample, data_dir, path_of};
