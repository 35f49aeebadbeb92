//! All tests over all crates that need no graphics card, in one binary.

#![allow(clippy::expect_used, clippy::panic)]

mod cpu {
    mod alternatives;
    mod binary;
    mod corpus;
    mod determinism;
    mod edited;
    mod edited_values;
    mod glb;
    mod gltf_in;
    mod includes;
    mod large;
    mod limited;
    mod links;
    mod measures;
    mod models;
    mod nurbs;
    mod outputs;
    mod page;
    mod picking;
    mod precision;
    mod random_models;
    mod reference;
    mod robustness;
    mod roundtrip;
    mod rules;
    mod samples;
    mod source_back;
    mod swept;
    mod to_inventor;
    mod validator;
    mod vrml;
}
