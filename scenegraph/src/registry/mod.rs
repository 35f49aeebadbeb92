//! The table of all Open Inventor classes: their fields, types, defaults, words and how much of
//! each takes effect. It describes classes and holds no nodes.
//!
//! Fields and defaults are those of Open Inventor 2.1 with Coin's additions, and of VRML 2.0.

mod appearance;
mod doc;
mod draggers;
mod engines;
mod groups;
mod info;
mod kits;
mod lights;
mod lookup;
mod old;
mod property;
mod sets;
mod shaders;
mod shapes;
mod spec;
mod table;
#[cfg(test)]
mod tests;
mod textures;
mod transforms;
mod types;
mod vrml;

pub use doc::nodes_markdown;
pub use old::{OLD_FIELDS, OldFields};
pub use spec::{ClassSpec, Family, FieldSpec, Support, Word};
pub use types::FieldType;

use appearance::appearance;
use draggers::draggers;
use engines::engines;
use groups::groups;
use info::info;
use kits::kits;
use lights::lights;
use old::old;
use property::property;
use shaders::shaders;
use shapes::shapes;
use table::define_classes;
use textures::textures;
use transforms::transforms;
use vrml::vrml;

/// Names that occur as [`ClassSpec::parent`] but cannot be instantiated and so have no entry.
pub const ABSTRACT: &[&str] = &[
    "Camera",
    "Dragger",
    "Engine",
    "IndexedShape",
    "Interpolate",
    "Light",
    "Node",
    "NonIndexedShape",
    "Profile",
    "ShaderObject",
    "Shape",
    "Texture",
    "Texture2Convert",
    "TextureCoordinateFunction",
    "Transformation",
    "UniformShaderParameter",
    "VRMLGeometry",
    "VRMLInterpolator",
    "VRMLLight",
    "VRMLParent",
    "VRMLSensor",
    "VRMLTexture",
];

groups! { [
    transforms appearance textures shaders property shapes lights info engines kits draggers old
    vrml define_classes
] }

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
