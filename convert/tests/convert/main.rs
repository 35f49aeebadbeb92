//! Scenes made by hand, converted, and read back by other code than wrote them.
//!
//! With `GLTF_DUMP=FOLDER` every converted scene is kept there, for the Khronos validator.

// Helpers of tests stop a test as an assertion does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod alternatives;
mod choices;
mod containers;
mod decode;
mod hierarchy;
mod hostile;
mod instancing;
mod lights_cameras;
mod losses;
mod materials;
mod meshes;
mod options_doc;
mod read;
mod reading;
mod scenes;
mod size;
mod textures;
mod vertices;
