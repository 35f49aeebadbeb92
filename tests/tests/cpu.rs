//! All tests over all crates that need no graphics card, in one binary.

#![allow(clippy::expect_used, clippy::panic)]

mod cpu {
    mod corpus;
    mod models;
    mod robustness;
    mod rules;
    mod validator;
}
