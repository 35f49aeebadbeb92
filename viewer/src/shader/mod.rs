//! Generated shaders: a key, its text, and the layout of the data both sides share.
//!
//! Pure: neither device nor cache. What is compiled, and how often, is the business of `gpu`.

mod emit;
mod emit_light;
mod emit_place;
mod key;
mod layout;
#[cfg(test)]
mod tests;

pub use emit::{
    BACKGROUND, EXTRACT, MAP, OVERLAY, TYPES, VOLUME, emit, emit_occlusion, emit_present, emit_rays,
};
pub use key::{Contribution, LightForm, LightKey, Shade, ShaderKey, ShadowLookup, SpotForm};
pub use layout::{Frame, Instance, Light, PassValues, Surface, layouts};
