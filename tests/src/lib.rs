//! What the tests over all crates share: measures of a scene, the corpus, and inputs made to break.

pub mod corpus;
pub mod measure;
