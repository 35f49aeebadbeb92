//! The macros that turn the family files' text into the class enum, the static specs and the
//! list of all classes, and the constant functions they use.
//!
//! A family file defines one macro holding its table. Each passes everything it was given plus
//! its own table on to the next, and the last link, `define_classes`, sees the whole text.

use super::{FieldSpec, FieldType, Word};

/// One field: `name: Type = "default"`, then the words of an enum or bit mask, either
/// `[A, B, C = 1]` or `in LIST` with a constant of `sets`.
macro_rules! field {
    ($name:ident $type:ident $default:literal) => {
        $crate::registry::table::field!(@ $name $type $default &[])
    };
    ($name:ident $type:ident $default:literal [$($word:ident $(= $value:literal)?),*]) => {
        $crate::registry::table::field!(@ $name $type $default &$crate::registry::table::number([
            $((stringify!($word), $crate::registry::table::field!(@value $($value)?)),)*
        ]))
    };
    ($name:ident $type:ident $default:literal in $list:ident) => {
        $crate::registry::table::field!(@ $name $type $default $crate::registry::sets::$list)
    };
    (@ $name:ident $type:ident $default:literal $words:expr) => {
        $crate::registry::FieldSpec {
            name: stringify!($name),
            field_type: $crate::registry::FieldType::$type,
            default: $default,
            words: $words,
        }
    };
    (@value) => { None };
    (@value $value:literal) => { Some($value) };
}
pub(super) use field;

/// A slice of fields, in the same notation as the class tables.
macro_rules! fields {
    ($( $name:ident: $type:ident = $default:literal
        $([$($word:ident $(= $value:literal)?),* $(,)?])? $(in $list:ident)?; )*) => {
        &[$( $crate::registry::table::field!(
            $name $type $default $([$($word $(= $value)?),*])? $(in $list)?
        ), )*]
    };
}
pub(super) use fields;

/// The base of a class, if it has one.
macro_rules! base {
    () => {
        None
    };
    ($base:ident) => {
        Some(Class::$base)
    };
}
pub(super) use base;

/// The last link: declares `Class` and the specs from
/// `Family { Name as Base: Parent, Support, [INHERITED, …], "note" { fields } … } …`.
macro_rules! define_classes {
    ([] $( $family:ident { $(
        $name:ident $(as $base:ident)?: $parent:ident, $support:ident, [$($set:ident),*],
        $note:literal { $($field:tt)* }
    )* } )*) => {
        /// A node, engine or kit class in Inventor's spelling, without the prefix `So`.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[repr(u16)]
        pub enum Class {
            $($( #[doc = $note] $name, )*)*
        }

        impl Class {
            /// Every class, in the order of the registry's sections.
            pub const ALL: &'static [Self] = &[$($(Self::$name,)*)*];
        }

        static SPECS: [ClassSpec; Class::ALL.len()] = [$($(
            ClassSpec {
                class: Class::$name,
                name: stringify!($name),
                parent: stringify!($parent),
                base: table::base!($($base)?),
                family: Family::$family,
                fields: {
                    const PARTS: &[&[FieldSpec]] = &[$(sets::$set,)* table::fields!($($field)*)];
                    const FIELDS: &[FieldSpec] = &table::join::<{ table::total(PARTS) }>(PARTS);
                    FIELDS
                },
                support: Support::$support,
                note: $note,
            },
        )*)*];
    };
}
pub(super) use define_classes;

/// Words with their values: the position in the list unless one is given.
pub(super) const fn number<const N: usize>(list: [(&'static str, Option<u32>); N]) -> [Word; N] {
    let mut words = [Word { name: "", value: 0 }; N];
    let mut i = 0;
    while i < N {
        let value = match list[i].1 {
            Some(value) => value,
            None => i as u32,
        };
        words[i] = Word {
            name: list[i].0,
            value,
        };
        i += 1;
    }
    words
}

/// The number of fields in all parts.
pub(super) const fn total(parts: &[&[FieldSpec]]) -> usize {
    let mut count = 0;
    let mut part = 0;
    while part < parts.len() {
        count += parts[part].len();
        part += 1;
    }
    count
}

/// The fields of all parts in a row; `N` is their [`total`].
pub(super) const fn join<const N: usize>(parts: &[&[FieldSpec]]) -> [FieldSpec; N] {
    let mut fields = [FieldSpec {
        name: "",
        field_type: FieldType::SFBool,
        default: "",
        words: &[],
    }; N];
    let (mut next, mut part) = (0, 0);
    while part < parts.len() {
        let mut i = 0;
        while i < parts[part].len() {
            fields[next] = parts[part][i];
            next += 1;
            i += 1;
        }
        part += 1;
    }
    fields
}
