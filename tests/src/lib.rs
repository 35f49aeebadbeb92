//! What tests and benchmarks over all crates share: measures of a scene, the corpus, inputs made to
//! break, large ones, what must hold for any input, what a picture must be, and scenes to draw.

pub mod corpus;
pub mod floats;
pub mod fuzz_body;
pub mod fuzz_targets;
pub mod glb;
pub mod hostile;
pub mod large;
pub mod measure;
pub mod mutate;
pub mod reference;
pub mod same_scene;
pub mod same_tree;
pub mod shadow_scenes;
pub mod stored_tree;
