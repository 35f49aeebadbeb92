//! The command `ivview` as its users run it: the real binary in a scratch folder, on the software
//! adapter, judged by its exit code, what it prints and the files it leaves. What is in a picture
//! is judged by the renderer's tests.

// Helpers of tests stop a test as an assertion does.
#![allow(clippy::unwrap_used)]

mod messages;
mod pictures;
mod place;
mod stats;
mod views;
