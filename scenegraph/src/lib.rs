//! The meaning of Open Inventor: typed scene graph, traversal, and the resolved scene.
//!
//! Three stages, each a total function that reports and goes on:
//!
//! 1. [`load`]: bytes to a [`Graph`]: classes, fields and defaults from the [`registry`], `DEF` and
//!    `USE` as shared nodes, old versions upgraded, `File` nodes read through a [`Loader`].
//! 2. [`resolve()`]: one walk over the graph with the traversal state as a value.
//! 3. [`scene::Scene`]: what the walk leaves: no defaults, no state, no Inventor rule.
//!
//! [`write_scene`] is the way back: a resolved scene as Inventor text.
//!
//! Files are opened by the [`Loader`] only.

mod font;
pub mod graph;
mod loader;
mod lower;
pub mod registry;
mod remarks;
mod resolve;
pub mod scene;
mod shape;
mod write;

pub use font::AddedFont;
pub use graph::Graph;
pub use loader::{FileLoader, LoadError, Loaded, Loader};
pub use lower::{RegistryLayout, is_other_text, load, load_with};
pub use resolve::{Geometry, ResolveLimits, ResolveOptions, Resolved, resolve};
pub use shape::Measure;
pub use write::{ImageForm, SceneText, legal_name, write_scene, write_shape};
