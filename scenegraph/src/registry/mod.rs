//! The table of all Open Inventor classes: their fields, types, defaults, words and how much of
//! each takes effect. It describes classes and holds no nodes; VRML 2.0 classes are not in it.
//!
//! Fields and defaults are those of Open Inventor 2.1 with Coin's additions.

mod appearance;
mod groups;
mod info;
mod lights;
mod lookup;
mod property;
mod sets;
mod shapes;
mod spec;
mod table;
mod textures;
mod transforms;
mod types;

pub use spec::{ClassSpec, Family, FieldSpec, Support, Word};
pub use types::FieldType;

use appearance::appearance;
use groups::groups;
use info::info;
use lights::lights;
use property::property;
use shapes::shapes;
use table::define_classes;
use textures::textures;
use transforms::transforms;

/// Names that occur as [`ClassSpec::parent`] but cannot be instantiated and so have no entry.
pub const ABSTRACT: &[&str] = &[
    "Camera",
    "IndexedShape",
    "Light",
    "Node",
    "NonIndexedShape",
    "Profile",
    "Shape",
    "Texture",
    "TextureCoordinateFunction",
    "Transformation",
];

groups! { [transforms appearance textures property shapes lights info define_classes] }

impl Class {
    /// What is known about the class.
    #[must_use]
    pub fn spec(self) -> &'static ClassSpec {
        &SPECS[self as usize]
    }

    /// Inventor's spelling without the prefix `So`.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.spec().name
    }

    /// The class as which a node of this class acts in a static scene: its
    /// [`base`](ClassSpec::base), else itself.
    #[must_use]
    pub fn acts_as(self) -> Self {
        self.spec().base.unwrap_or(self)
    }
}
