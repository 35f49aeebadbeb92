//! The classes: their names, parents and bases, and what old files add.

mod document;
mod fields;

use std::collections::BTreeSet;

use super::*;

fn all_specs() -> impl Iterator<Item = &'static ClassSpec> {
    Class::ALL.iter().map(|class| class.spec())
}

#[test]
fn every_class_is_found_by_its_name() {
    for &class in Class::ALL {
        let name = class.name();
        assert_eq!(name, format!("{class:?}"));
        assert_eq!(class.spec().class, class);
        assert_eq!(Class::from_name(name.as_bytes()), Some(class));
        assert_eq!(
            Class::from_name(format!("So{name}").as_bytes()),
            Some(class)
        );
    }
}

#[test]
fn only_exact_names_are_found() {
    for name in ["", "So", "cube", "SoSoCube", "Cube ", "Node", "soCube"] {
        assert_eq!(Class::from_name(name.as_bytes()), None, "{name:?}");
    }
}

#[test]
fn closest_class() {
    let rows = [
        ("cube", Some(Class::Cube)),
        ("SEPARATOR", Some(Class::Separator)),
        ("Seperator", Some(Class::Separator)),
        ("sotransform", Some(Class::Transform)),
        ("IndexFaceSet", Some(Class::IndexedFaceSet)),
        ("Coordinates3", Some(Class::Coordinate3)),
        ("Sorter", None),
        ("Cub", None),
        ("", None),
        ("SwitchboardOperator", None),
    ];
    for (name, expected) in rows {
        assert_eq!(Class::closest(name), expected, "{name:?}");
    }
    assert_eq!(Class::closest(&"Cube".repeat(1000)), None);
}

#[test]
fn parents_and_abstract_classes() {
    let mut parents = BTreeSet::new();
    for spec in all_specs() {
        let is_class = Class::from_name(spec.parent.as_bytes()).is_some();
        let is_abstract = ABSTRACT.contains(&spec.parent);
        assert!(is_class != is_abstract, "{}: {}", spec.name, spec.parent);
        parents.insert(spec.parent);
    }
    for name in ABSTRACT {
        assert!(parents.contains(name), "{name} is nobody's parent");
    }
    assert!(ABSTRACT.is_sorted());
}

#[test]
fn a_base_comes_first_and_is_final() {
    for spec in all_specs() {
        let Some(base) = spec.base else { continue };
        let base = base.spec();
        assert!(base.base.is_none(), "{}", spec.name);
        assert_eq!(spec.is_group(), base.is_group(), "{}", spec.name);
        let shape = |field: &FieldSpec| (field.name, field.field_type, field.default);
        let head: Vec<_> = spec
            .fields
            .iter()
            .take(base.fields.len())
            .map(shape)
            .collect();
        let whole: Vec<_> = base.fields.iter().map(shape).collect();
        assert_eq!(head, whole, "{}", spec.name);
    }
    assert_eq!(Class::TrackballManip.acts_as(), Class::Transform);
    assert_eq!(Class::Cube.acts_as(), Class::Cube);
}

#[test]
fn old_fields_go_by_version() {
    let rows = [
        (
            Class::ShapeHints,
            "hints",
            (1, 0),
            Some(FieldType::SFBitMask),
        ),
        (Class::ShapeHints, "hints", (2, 0), None),
        (
            Class::PackedColor,
            "rgba",
            (2, 0),
            Some(FieldType::MFUInt32),
        ),
        (Class::PackedColor, "rgba", (2, 1), None),
        (
            Class::DrawStyle,
            "lineWidth",
            (1, 0),
            Some(FieldType::SFShort),
        ),
        (Class::DrawStyle, "style", (1, 0), None),
        (Class::LOD, "alternateRep", (2, 0), Some(FieldType::SFNode)),
        (Class::Cube, "width", (1, 0), None),
    ];
    for (class, name, version, expected) in rows {
        let found = class.spec().old_field(name.as_bytes(), version);
        assert_eq!(
            found.map(|field| field.field_type),
            expected,
            "{class:?}.{name} {version:?}"
        );
    }
}

#[test]
fn groups_and_kits() {
    let rows = [
        (Class::Group, true, false),
        (Class::WWWAnchor, true, false),
        (Class::File, false, false),
        (Class::WWWInline, false, false),
        (Class::LayerGroup, true, false),
        (Class::MaterialIndex, false, false),
        (Class::ShapeKit, false, true),
        (Class::NodeKitListPart, false, false),
        (Class::JackDragger, false, true),
        (Class::JackManip, false, false),
    ];
    for (class, is_group, has_parts) in rows {
        let spec = class.spec();
        let found = (spec.is_group(), spec.has_parts());
        assert_eq!(found, (is_group, has_parts), "{class:?}");
    }
}
