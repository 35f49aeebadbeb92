//! The command `ivview`: the window, and pictures without one.
//!
//! The only crate that names a window or its interface. What is drawn, picked or measured is
//! `viewer`'s; files are read by `convert` and `scenegraph`.

pub mod cli;
pub mod config;
pub mod fields;
mod input;
pub mod load;
pub mod model;
pub mod outline;
pub mod ui;
mod watch;
mod window;
