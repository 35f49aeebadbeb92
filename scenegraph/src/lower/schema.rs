//! What the registry tells readers and writers of syntax, which know no class.

use iv_parser::{ClassShape, Header, Layout, Schema, ValueKind, ValueType};

use crate::registry::{Class, FieldSpec, FieldType};

/// Answers by the registry's classes and fields.
#[derive(Clone, Copy, Debug, Default)]
pub struct RegistryLayout;

impl Layout for RegistryLayout {
    fn tuple_size(&self, class: &[u8], field: &[u8]) -> usize {
        let size = |class: Option<Class>| {
            let (_, spec) = class?.spec().field(field)?;
            Some(spec.field_type.tuple_size())
        };
        // Classes of both languages with the same name agree in the fields they share.
        let inventor = size(Class::from_name(class));
        inventor
            .or_else(|| size(Class::from_vrml_name(class)))
            .unwrap_or(0)
    }
}

impl Schema for RegistryLayout {
    fn class(&self, class: &[u8], header: &Header) -> Option<ClassShape> {
        let class = Class::from_name(class)?;
        let spec = class.spec();
        // The first Inventor's Separator had none of today's hints.
        let is_bare = class == Class::Separator && header.is_older_than(2, 0);
        Some(ClassShape {
            is_group: spec.is_group(),
            has_fields: !(spec.fields.is_empty() || is_bare),
        })
    }

    fn field(&self, class: &[u8], field: &[u8], header: &Header) -> Option<ValueType> {
        let spec = Class::from_name(class)?.spec();
        match field_spec(spec.class, field, header) {
            Some(found) => Some(stored(found.field_type)),
            None => spec.has_parts().then_some(stored(FieldType::SFNode)),
        }
    }

    fn named_type(&self, name: &[u8]) -> Option<ValueType> {
        FieldType::from_name(name.strip_prefix(b"So").unwrap_or(name)).map(stored)
    }

    fn name_of(&self, wanted: ValueType) -> Option<&'static str> {
        let mut all = FieldType::ALL.iter();
        all.find(|known| stored(**known) == wanted)
            .map(|known| known.name())
    }

    fn default_text(&self, class: &[u8], field: &[u8], header: &Header) -> Option<&'static str> {
        let found = field_spec(Class::from_name(class)?, field, header)?;
        Some(found.default)
    }
}

fn field_spec(class: Class, field: &[u8], header: &Header) -> Option<&'static FieldSpec> {
    let spec = class.spec();
    let is_old = header.is_older_than(2, 1);
    let old = is_old
        .then(|| spec.old_field(field, header.version))
        .flatten();
    old.or_else(|| spec.field(field).map(|(_, spec)| spec))
}

/// How values of a field type are stored in binary files.
fn stored(field_type: FieldType) -> ValueType {
    use FieldType as T;
    let name = field_type.name();
    let size = field_type.tuple_size();
    let kind = match field_type {
        T::SFBool | T::MFBool => ValueKind::Flag,
        T::SFEnum | T::MFEnum => ValueKind::Word,
        T::SFBitMask | T::MFBitMask => ValueKind::Mask,
        T::SFString | T::SFName | T::MFString | T::MFName => ValueKind::Text,
        T::SFNode | T::SFPath | T::SFEngine | T::MFNode | T::MFPath | T::MFEngine => {
            ValueKind::Node
        }
        T::SFImage => ValueKind::Image,
        T::SFImage3 => ValueKind::Volume,
        T::SFTrigger => ValueKind::Nothing,
        T::SFInt64 | T::SFUInt64 | T::MFInt64 | T::MFUInt64 => ValueKind::Wide,
        T::SFTime | T::MFTime | T::SFDouble | T::MFDouble => ValueKind::Double,
        _ if !field_type.is_integer() && name.ends_with('d') => ValueKind::Double,
        _ if !field_type.is_integer() => ValueKind::Float,
        // `SFUInt32`, `SFVec4ub`.
        _ if name[2..].starts_with('U') || name.contains('u') => ValueKind::Unsigned,
        _ => ValueKind::Int,
    };
    ValueType {
        kind,
        size: size.max(1) as u8,
        is_list: field_type.is_multiple(),
    }
}
