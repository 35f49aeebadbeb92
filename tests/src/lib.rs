//! What the tests over all crates share: measures of a scene, the corpus, inputs made to break,
//! and what must hold for any input.

pub mod corpus;
pub mod fuzz_body;
pub mod glb;
pub mod hostile;
pub mod measure;
pub mod mutate;
pub mod same_tree;
