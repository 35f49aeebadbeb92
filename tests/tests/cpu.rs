//! All tests over all crates that need no graphics card, in one binary.

mod cpu {
    mod corpus;
}
