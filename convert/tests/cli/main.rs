//! The command `ivconvert` as its users run it: the real binary in a scratch folder, judged by its
//! exit code, what it prints and the files it leaves. What is in a glTF is judged in `convert`'s
//! other tests.

// Helpers of tests stop a test as an assertion does.
#![allow(clippy::unwrap_used)]

mod info;
mod inputs;
mod messages;
mod outputs;
mod packed;
mod place;
mod report;
