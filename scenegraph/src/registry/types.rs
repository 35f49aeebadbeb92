//! The field types of Open Inventor, with what a reader must know to take a value apart by
//! its type's name alone (as in `fields [ MFVec3f points ]` of a class nobody registered).
//! It holds no values and does not parse.

/// How the numbers of a field type are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Numbers {
    /// No numbers: words, strings, nodes, paths, pictures, triggers.
    None,
    Integer,
    Real,
}

macro_rules! field_types {
    ($( $numbers:ident $size:literal: $($name:ident)*; )*) => {
        /// A field type by Inventor's name (`SF…` holds one value, `MF…` a list).
        ///
        /// The set is Open Inventor 2.1's plus Coin's additions (`SFDouble`, `SFVec2s`, …).
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[repr(u8)]
        pub enum FieldType {
            $($(
                #[doc = concat!("`", stringify!($name), "`: ", stringify!($size), " number(s) a value.")]
                $name,
            )*)*
        }

        impl FieldType {
            /// Every field type, in declaration order.
            pub const ALL: &'static [Self] = &[$($(Self::$name,)*)*];

            /// Inventor's name, for example `MFVec3f`.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $($(Self::$name => stringify!($name),)*)*
                }
            }

            /// How many numbers make one value: `SFVec3f` and `MFVec3f` 3, `SFRotation` 4 (axis,
            /// angle), `SFMatrix` 16, `SFInt32` and `SFTime` 1. 0 for types not written as a fixed
            /// run of numbers: `SFBool` (a word, though `0` and `1` are accepted too), enums,
            /// strings, nodes, images, triggers.
            #[must_use]
            pub const fn tuple_size(self) -> usize {
                match self {
                    $($(Self::$name)|* => $size,)*
                }
            }

            const fn numbers(self) -> Numbers {
                match self {
                    $($(Self::$name)|* => Numbers::$numbers,)*
                }
            }
        }
    };
}

field_types! {
    None 0:
        SFBool SFBitMask SFEnum SFName SFString SFImage SFImage3
        SFNode SFPath SFEngine SFTrigger
        MFBool MFBitMask MFEnum MFName MFString MFNode MFPath MFEngine;
    Integer 1:
        SFInt32 SFUInt32 SFShort SFUShort MFInt32 MFUInt32 MFShort MFUShort
        SFInt8 SFUInt8 SFInt64 SFUInt64 MFInt8 MFUInt8 MFInt64 MFUInt64;
    Integer 2: SFVec2b SFVec2s SFVec2i32 MFVec2b MFVec2s MFVec2i32;
    Integer 3: SFVec3b SFVec3s SFVec3i32 MFVec3b MFVec3s MFVec3i32;
    Integer 4:
        SFVec4b SFVec4ub SFVec4s SFVec4us SFVec4i32 SFVec4ui32 SFBox2s SFBox2i32
        MFVec4b MFVec4ub MFVec4s MFVec4us MFVec4i32 MFVec4ui32;
    Integer 6: SFBox3s SFBox3i32;
    Real 1: SFFloat SFDouble SFTime MFFloat MFDouble MFTime;
    Real 2: SFVec2f SFVec2d MFVec2f MFVec2d;
    Real 3: SFVec3f SFVec3d SFColor MFVec3f MFVec3d MFColor;
    Real 4:
        SFVec4f SFVec4d SFColorRGBA SFRotation SFPlane SFBox2f SFBox2d
        MFVec4f MFVec4d MFColorRGBA MFRotation MFPlane;
    Real 6: SFBox3f SFBox3d;
    Real 16: SFMatrix MFMatrix;
}

impl FieldType {
    /// The type of that exact name. The four `Long` names of Inventor 1 and 2.0 mean today's
    /// `Int32` types.
    #[must_use]
    pub fn from_name(name: &[u8]) -> Option<Self> {
        match name {
            b"SFLong" => Some(Self::SFInt32),
            b"SFULong" => Some(Self::SFUInt32),
            b"MFLong" => Some(Self::MFInt32),
            b"MFULong" => Some(Self::MFUInt32),
            _ => Self::ALL
                .iter()
                .copied()
                .find(|known| known.name().as_bytes() == name),
        }
    }

    /// Whether the field holds a list of values (`MF…`).
    #[must_use]
    pub const fn is_multiple(self) -> bool {
        self.name().as_bytes()[0] == b'M'
    }

    /// Whether every number of a value is an integer. `false` for types without numbers.
    #[must_use]
    pub const fn is_integer(self) -> bool {
        matches!(self.numbers(), Numbers::Integer)
    }

    /// Whether values are words out of a list that the class declares (enum or bit mask).
    #[must_use]
    pub const fn has_words(self) -> bool {
        matches!(
            self,
            Self::SFEnum | Self::MFEnum | Self::SFBitMask | Self::MFBitMask
        )
    }
}
