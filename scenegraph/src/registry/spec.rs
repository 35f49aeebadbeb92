//! The shape of one registry entry: class, field, word, family and level of support.
//! The entries themselves are in the family files.

use super::{Class, FieldType};

/// What is known about one node, engine or kit class.
#[derive(Clone, Copy, Debug)]
pub struct ClassSpec {
    /// The class itself.
    pub class: Class,
    /// Inventor's spelling without the prefix `So`.
    pub name: &'static str,
    /// The class it is derived from; may be abstract and then has no entry of its own
    /// (see [`ABSTRACT`](super::ABSTRACT)).
    pub parent: &'static str,
    /// The class as which the node acts in a static scene: a manipulator acts as the plain node,
    /// `Rotor` as `Rotation`. The first fields of such a class are the base's fields in the
    /// base's order, so field positions of the base serve for both. A base has no base itself.
    pub base: Option<Class>,
    /// The section of the registry.
    pub family: Family,
    /// All fields, inherited ones first.
    pub fields: &'static [FieldSpec],
    /// How much of the class takes effect.
    pub support: Support,
    /// What it does or what is missing, in one line.
    pub note: &'static str,
}

impl ClassSpec {
    /// Position and description of the field with that exact name.
    #[must_use]
    pub fn field(&self, name: &[u8]) -> Option<(usize, &'static FieldSpec)> {
        self.fields
            .iter()
            .enumerate()
            .find(|(_, field)| field.name.as_bytes() == name)
    }

    /// Whether nodes of this class carry a list of child nodes.
    #[must_use]
    pub const fn is_group(&self) -> bool {
        match self.family {
            Family::Group => !matches!(self.class, Class::File | Class::WWWInline),
            Family::Old => matches!(self.class, Class::LayerGroup | Class::CustomNode),
            Family::Vrml => self.child_list().is_some(),
            _ => false,
        }
    }

    /// The field of a VRML 2.0 class that holds its children.
    #[must_use]
    pub const fn child_list(&self) -> Option<&'static str> {
        match self.class {
            Class::VRMLGroup
            | Class::VRMLTransform
            | Class::VRMLAnchor
            | Class::VRMLBillboard
            | Class::VRMLCollision => Some("children"),
            Class::VRMLSwitch => Some("choice"),
            Class::VRMLLOD => Some("level"),
            _ => None,
        }
    }

    /// Whether a field that is not in the list is a catalog part, that is, an `SFNode`. Kits and
    /// draggers: draggers have hundreds of parts for their looks, which are not listed, and a
    /// kit of somebody's own may add parts.
    #[must_use]
    pub const fn has_parts(&self) -> bool {
        match self.family {
            Family::Kit => !matches!(self.class, Class::NodeKitListPart),
            Family::Dragger => true,
            _ => false,
        }
    }
}

/// One field of a class.
#[derive(Clone, Copy, Debug)]
pub struct FieldSpec {
    /// Inventor's name.
    pub name: &'static str,
    /// Inventor's type.
    pub field_type: FieldType,
    /// The default as Inventor ASCII text: `0 0 1`, `[]`, `TRUE`, `""`, `NULL`, `PHONG`.
    /// A list with a single value stands without brackets. Empty for triggers.
    pub default: &'static str,
    /// The legal words of an enum or bit mask; empty for every other type.
    pub words: &'static [Word],
}

impl FieldSpec {
    /// The value of an enum or bit mask word, exact spelling.
    #[must_use]
    pub fn word(&self, name: &[u8]) -> Option<u32> {
        let found = self.words.iter().find(|word| word.name.as_bytes() == name);
        found.map(|word| word.value)
    }
}

/// One legal word of an enum or bit mask field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Word {
    /// Inventor's spelling.
    pub name: &'static str,
    /// Enum: position in the list, or for an alias the position of the word it stands for.
    /// Bit mask: the bits. The numbers are the registry's own and never stand in files.
    pub value: u32,
}

macro_rules! named_enum {
    ($(#[$doc:meta])* $type:ident { $( $(#[$variant_doc:meta])* $variant:ident = $title:literal, )* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum $type { $( $(#[$variant_doc])* $variant, )* }

        impl $type {
            /// Every value, in declaration order.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)*];

            /// The name in the generated document.
            #[must_use]
            pub const fn title(self) -> &'static str {
                match self { $(Self::$variant => $title,)* }
            }
        }
    };
}

named_enum! {
    /// A section of the registry.
    Family {
        /// Groups, and nodes that bring in other files.
        Group = "Groups",
        /// Nodes that change the model matrix.
        Transform = "Transforms",
        /// Material, drawing style, textures, fonts, environment.
        Appearance = "Appearance",
        /// Coordinates, normals, texture coordinates, profiles.
        Property = "Geometry properties",
        /// Everything that draws.
        Shape = "Shapes",
        /// Light sources.
        Light = "Lights",
        /// Cameras.
        Camera = "Cameras",
        /// Nodes with no effect on the picture.
        Information = "Information",
        /// Engines: field values computed from other field values.
        Engine = "Engines",
        /// Node kits.
        Kit = "Node kits",
        /// Draggers: kits the user drags in a viewer.
        Dragger = "Draggers",
        /// A transform, light or plane that shows a dragger.
        Manipulator = "Manipulators",
        /// Classes found only in files of Inventor 1.0 and 2.0.
        Old = "Old classes",
        /// Classes of VRML 2.0.
        Vrml = "VRML 2.0",
    }
}

named_enum! {
    /// How much of a class takes effect.
    Support {
        /// All of it.
        Full = "full",
        /// Its main effect; the note says what is missing.
        Partial = "partial",
        /// Read and written back; it has no effect on a static model.
        Kept = "kept",
        /// Recognised and read, but its geometry or effect is not there yet: reported as a loss.
        Planned = "planned",
    }
}
