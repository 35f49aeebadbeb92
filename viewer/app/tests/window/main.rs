//! The window's contents, driven by synthetic events on the software adapter: what is clicked, typed
//! and dropped, judged by what is then shown. The window of the system itself is not opened.

// Helpers of tests stop a test as an assertion does.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod driver;
mod files;
mod idle;
mod look;
mod model;
mod views;
