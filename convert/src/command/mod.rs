//! What the commands of this project share: how they read a model from a file, word their messages
//! and leave files behind. Decides nothing about a conversion or a picture, and prints nothing.

pub mod access;
pub mod archive;
pub mod atomic;
pub mod bytes;
pub mod fonts;
pub mod json;
pub mod messages;
pub mod model;
