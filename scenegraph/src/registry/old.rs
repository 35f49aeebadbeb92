//! What only old files contain: classes that Inventor 2 dropped, and the fields that a class had
//! in Inventor 1.0 or 2.0 and has no longer or has with another type, default or other words.
//! The upgraders turn both into today's classes and fields.
//!
//! Source: SGI's upgraders (`lib/database/src/so/upgraders`).

use super::table::fields;
use super::{Class, ClassSpec, FieldSpec};

macro_rules! old {
    ([$next:ident $($rest:ident)*] $($seen:tt)*) => { $next! { [$($rest)*] $($seen)* Old {

LayerGroup: Group, Full, [],
    "Becomes a Separator. Inventor 1.0." {}
CustomNode: Group, Partial, [],
    "A class of somebody's own; becomes a Group of its children. Inventor 1.0." {
    className: MFString = "\"\"";
    fields: MFString = "\"\"";
    customData: MFString = "\"\"";
}
IndexedTriangleMesh: Node, Full, [],
    "Triangle strips with swaps (-2); becomes an IndexedTriangleStripSet. Inventor 1.0." {
    coordIndex: MFInt32 = "-1";
    materialIndex: MFInt32 = "-1";
    normalIndex: MFInt32 = "-1";
    textureCoordIndex: MFInt32 = "-1";
}
MaterialIndex: Node, Kept, [],
    "Becomes a ColorIndex. Inventor 1.0 and 2.0." {
    ambientIndex: MFInt32 = "1";
    diffuseIndex: MFInt32 = "2";
    specularIndex: MFInt32 = "3";
    shininess: MFFloat = "0.2";
    transparency: MFFloat = "0";
}

    } } };
}
pub(super) use old;

/// The former fields of one class.
#[derive(Clone, Copy, Debug)]
pub struct OldFields {
    /// Today's class.
    pub class: Class,
    /// The last file version that has them: `(1, 0)` or `(2, 0)`.
    pub until: (u8, u8),
    /// The fields. One with the name of a field of today replaces that field when such a file is
    /// read.
    pub fields: &'static [FieldSpec],
}

/// All former fields.
pub static OLD_FIELDS: &[OldFields] = &[
    OldFields {
        class: Class::DrawStyle,
        until: (1, 0),
        fields: fields! {
            lineWidth: SFShort = "1";
        },
    },
    OldFields {
        class: Class::Environment,
        until: (1, 0),
        fields: fields! {
            fogType: SFEnum = "NONE" [NONE, LINEAR, EXPONENTIAL, EXPONENTIAL_SQUARED];
            fogComputed: SFEnum = "PER_VERTEX" [PER_VERTEX, PER_PIXEL];
            fogDensity: SFFloat = "0";
            fogNearDistance: SFFloat = "1";
            fogFarDistance: SFFloat = "10";
        },
    },
    OldFields {
        class: Class::LightModel,
        until: (1, 0),
        fields: fields! {
            model: SFEnum = "PHONG" [PHONG, BASE_COLOR, DEPTH];
            nearColor: SFColor = "1 1 1";
            farColor: SFColor = "0 0 0";
        },
    },
    OldFields {
        class: Class::PackedColor,
        until: (2, 0),
        fields: fields! {
            rgba: MFUInt32 = "0xffcccccc";
        },
    },
    OldFields {
        class: Class::PickStyle,
        until: (1, 0),
        fields: fields! {
            style: SFEnum = "PICKABLE" [PICKABLE, UNPICKABLE];
        },
    },
    OldFields {
        class: Class::ShapeHints,
        until: (1, 0),
        fields: fields! {
            hints: SFBitMask = "()" [
                SOLID = 1, ORDERED = 2, CONVEX = 4, SURFACE = 0, UNORDERED = 0, CONCAVE = 0, NONE = 0,
            ];
        },
    },
    OldFields {
        class: Class::Text3,
        until: (1, 0),
        fields: fields! {
            parts: SFBitMask = "ALL" [FRONT = 1, SIDES = 2, BACK = 4, ALL = 7];
        },
    },
    OldFields {
        class: Class::Texture2,
        until: (1, 0),
        fields: fields! {
            component: SFBitMask = "INTENSITY" [
                NULL_COMPONENT = 0, INTENSITY = 1, TRANSPARENCY = 2,
            ];
            filename: SFName = "\"\"";
            minFilter: SFEnum = "POINT" [
                POINT, BILINEAR, MIPMAP_POINT, MIPMAP_LINEAR, MIPMAP_BILINEAR, MIPMAP_TRILINEAR,
            ];
            magFilter: SFEnum = "POINT" [POINT, BILINEAR];
            blendColor: SFColor = "1 1 1";
            translation: SFVec2f = "0 0";
            scaleFactor: SFVec2f = "1 1";
            rotation: SFFloat = "0";
            center: SFVec2f = "0 0";
        },
    },
    OldFields {
        class: Class::TextureCoordinateCube,
        until: (1, 0),
        fields: fields! {
            coord: SFEnum = "ALL" [S, T, ALL];
            center: SFVec3f = "0 0 0";
            rotation: SFRotation = "0 0 1 0";
        },
    },
    OldFields {
        class: Class::TextureCoordinateCylinder,
        until: (1, 0),
        fields: fields! {
            coord: SFEnum = "ALL" [S, T, ALL];
            center: SFVec3f = "0 0 0";
            rotation: SFRotation = "0 0 1 0";
            height: SFFloat = "1";
        },
    },
    OldFields {
        class: Class::TextureCoordinateEnvironment,
        until: (1, 0),
        fields: fields! {
            coord: SFEnum = "ALL" [S, T, ALL];
        },
    },
    OldFields {
        class: Class::TextureCoordinatePlane,
        until: (1, 0),
        fields: fields! {
            coord: SFEnum = "ALL" [S, T, ALL];
            normal: SFVec3f = "1 0 0";
            distanceFromOrigin: SFFloat = "0";
            repeatInterval: SFFloat = "1";
        },
    },
    OldFields {
        class: Class::TextureCoordinateSphere,
        until: (1, 0),
        fields: fields! {
            coord: SFEnum = "ALL" [S, T, ALL];
            center: SFVec3f = "0 0 0";
            rotation: SFRotation = "0 0 1 0";
        },
    },
    replaced_in_2_0(Class::AsciiText),
    replaced_in_2_0(Class::FontStyle),
    replaced_in_2_0(Class::LOD),
    replaced_in_2_0(Class::VertexProperty),
    replaced_in_2_0(Class::WWWAnchor),
];

/// Inventor 2.1 wrote its new classes into 2.0 files as unknown nodes with a replacement.
const fn replaced_in_2_0(class: Class) -> OldFields {
    OldFields {
        class,
        until: (2, 0),
        fields: fields! {
            alternateRep: SFNode = "NULL";
        },
    }
}

impl ClassSpec {
    /// The field of that name that the class had in files of the given version, if the version
    /// is old enough and the class had it in another form than today's or has lost it.
    #[must_use]
    pub fn old_field(&self, name: &[u8], version: (u8, u8)) -> Option<&'static FieldSpec> {
        OLD_FIELDS
            .iter()
            .filter(|old| old.class == self.class && version <= old.until)
            .flat_map(|old| old.fields)
            .find(|field| field.name.as_bytes() == name)
    }
}
