//! The meaning of Open Inventor.

pub mod scene;
