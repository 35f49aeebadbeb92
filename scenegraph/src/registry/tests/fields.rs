//! The fields: every default and word has the form its type asks for, and rows taken from Open
//! Inventor's reference are found as they stand there.

use std::collections::BTreeSet;

use super::all_specs;
use crate::registry::{Class, FieldSpec, FieldType, OLD_FIELDS};

/// Every field of the registry with the name of its class, old ones included.
fn all_fields() -> Vec<(&'static str, &'static FieldSpec)> {
    let new = all_specs().flat_map(|spec| spec.fields.iter().map(|field| (spec.name, field)));
    let old = OLD_FIELDS
        .iter()
        .flat_map(|old| old.fields.iter().map(|field| (old.class.name(), field)));
    new.chain(old).collect()
}

#[test]
fn field_names_are_unique_in_their_class() {
    for spec in all_specs() {
        for (i, field) in spec.fields.iter().enumerate() {
            let found = spec.field(field.name.as_bytes()).map(|(at, _)| at);
            assert_eq!(found, Some(i), "{}.{}", spec.name, field.name);
        }
    }
    assert!(Class::Cube.spec().field(b"Width").is_none());
}

#[test]
fn words_and_their_defaults() {
    for (class, field) in all_fields() {
        let place = format!("{class}.{}", field.name);
        let has_words = field.field_type.has_words();
        assert_eq!(has_words, !field.words.is_empty(), "{place}");
        let names: BTreeSet<_> = field.words.iter().map(|word| word.name).collect();
        assert_eq!(names.len(), field.words.len(), "{place}: a word twice");
        let is_mask = field.field_type.name().ends_with("BitMask");
        if has_words && !(is_mask && field.default == "()") && field.default != "[]" {
            assert!(field.word(field.default.as_bytes()).is_some(), "{place}");
        }
        if is_mask {
            let bits = field.words.iter().fold(0, |bits, word| bits | word.value);
            let all = field.word(b"ALL").unwrap_or(bits);
            assert_eq!(
                (all, field.word(b"NONE").unwrap_or(0)),
                (bits, 0),
                "{place}"
            );
        }
    }
}

/// The pieces of a default: quoted strings and runs of other characters between blanks, commas.
fn pieces(text: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    let mut rest = text.trim_start();
    while !rest.is_empty() {
        let quoted = rest.strip_prefix('"').and_then(|tail| tail.find('"'));
        let end = match quoted {
            Some(end) => end + 2,
            None => rest.find([' ', ',']).unwrap_or(rest.len()),
        };
        pieces.push(&rest[..end]);
        rest = rest[end..].trim_start_matches([' ', ',']);
    }
    pieces
}

fn is_number(text: &str, integer: bool) -> bool {
    match (integer, text.strip_prefix("0x")) {
        (true, Some(hex)) => u32::from_str_radix(hex, 16).is_ok(),
        (true, None) => text.parse::<i32>().is_ok(),
        (false, _) => text.parse::<f32>().is_ok_and(f32::is_finite),
    }
}

#[test]
fn defaults_have_the_shape_of_their_type() {
    for (class, field) in all_fields() {
        let place = format!("{class}.{} = {}", field.name, field.default);
        let of = field.field_type;
        let list = field.default.strip_prefix('[');
        assert!(list.is_none() || of.is_multiple(), "{place}");
        let list = list.map(|text| text.strip_suffix(']').expect("a closing bracket"));
        let pieces = pieces(list.unwrap_or(field.default));
        let values = match list {
            Some(_) => pieces.len() / of.tuple_size().max(1),
            None => 1,
        };
        if of.tuple_size() > 0 {
            assert_eq!(pieces.len(), values * of.tuple_size(), "{place}");
            let good = pieces.iter().all(|text| is_number(text, of.is_integer()));
            assert!(good, "{place}");
            continue;
        }
        let single: fn(&str) -> bool = match &of.name()[2..] {
            "Bool" => |text| matches!(text, "TRUE" | "FALSE"),
            "String" | "Name" => {
                |text| text.len() >= 2 && text.starts_with('"') && text.ends_with('"')
            }
            "Node" | "Path" | "Engine" => |text| text == "NULL",
            "Image" | "Image3" => |text| text == "0",
            _ => |_| true,
        };
        let count = match of {
            FieldType::SFImage => 3,
            FieldType::SFImage3 => 4,
            FieldType::SFTrigger => 0,
            _ => values,
        };
        assert_eq!(pieces.len(), count, "{place}");
        assert!(pieces.iter().all(|text| single(text)), "{place}");
    }
}

#[test]
fn field_types() {
    for &of in FieldType::ALL {
        assert_eq!(FieldType::from_name(of.name().as_bytes()), Some(of));
        assert_eq!(of.name(), format!("{of:?}"));
    }
    let rows = [
        ("SFVec3f", 3, false, false),
        ("MFVec2f", 2, false, true),
        ("SFRotation", 4, false, false),
        ("MFMatrix", 16, false, true),
        ("SFPlane", 4, false, false),
        ("MFColor", 3, false, true),
        ("SFTime", 1, false, false),
        ("SFUShort", 1, true, false),
        ("MFVec4ub", 4, true, true),
        ("SFBool", 0, false, false),
        ("SFImage", 0, false, false),
        ("MFString", 0, false, true),
    ];
    for (name, tuple_size, is_integer, is_multiple) in rows {
        let of = FieldType::from_name(name.as_bytes()).expect(name);
        let found = (of.tuple_size(), of.is_integer(), of.is_multiple());
        assert_eq!(found, (tuple_size, is_integer, is_multiple), "{name}");
    }
    let aliases = [
        ("SFLong", Some(FieldType::SFInt32)),
        ("SFULong", Some(FieldType::SFUInt32)),
        ("MFLong", Some(FieldType::MFInt32)),
        ("MFULong", Some(FieldType::MFUInt32)),
        ("sfvec3f", None),
    ];
    for (name, expected) in aliases {
        assert_eq!(FieldType::from_name(name.as_bytes()), expected, "{name}");
    }
}

/// Rows from the reference pages of Open Inventor 2.1, as `class field type default`.
#[test]
fn agrees_with_the_reference() {
    let rows = [
        ("Separator", "renderCulling", "SFEnum", "AUTO"),
        ("Switch", "whichChild", "SFInt32", "-1"),
        ("LOD", "range", "MFFloat", "[]"),
        ("Array", "separation2", "SFVec3f", "0 1 0"),
        ("Transform", "scaleFactor", "SFVec3f", "1 1 1"),
        ("Units", "units", "SFEnum", "METERS"),
        ("Material", "shininess", "MFFloat", "0.2"),
        ("PackedColor", "orderedRGBA", "MFUInt32", "0xccccccff"),
        ("Environment", "attenuation", "SFVec3f", "0 0 1"),
        ("ShapeHints", "faceType", "SFEnum", "CONVEX"),
        ("Normal", "vector", "MFVec3f", "[]"),
        ("IndexedFaceSet", "coordIndex", "MFInt32", "0"),
        ("IndexedFaceSet", "textureCoordIndex", "MFInt32", "-1"),
        ("FaceSet", "numVertices", "MFInt32", "-1"),
        ("Text3", "parts", "SFBitMask", "FRONT"),
        ("SpotLight", "cutOffAngle", "SFFloat", "0.7853982"),
        ("OrthographicCamera", "height", "SFFloat", "2"),
        ("PerspectiveCamera", "position", "SFVec3f", "0 0 1"),
        ("ShapeKit", "shape", "SFNode", "NULL"),
        ("SpotLightManip", "dropOffRate", "SFFloat", "0"),
        ("Calculator", "expression", "MFString", "\"\""),
    ];
    for (class, name, of, default) in rows {
        let spec = Class::from_name(class.as_bytes()).expect(class).spec();
        let (_, field) = spec.field(name.as_bytes()).expect(name);
        let found = (field.field_type.name(), field.default);
        assert_eq!(found, (of, default), "{class}.{name}");
    }
}

#[test]
fn aliases_of_binding_words() {
    let rows = [
        (Class::MaterialBinding, "value", "OVERALL"),
        (Class::NormalBinding, "value", "PER_VERTEX_INDEXED"),
        (
            Class::TextureCoordinateBinding,
            "value",
            "PER_VERTEX_INDEXED",
        ),
        (Class::VertexProperty, "materialBinding", "OVERALL"),
        (Class::VertexProperty, "normalBinding", "PER_VERTEX_INDEXED"),
    ];
    for (class, name, meaning) in rows {
        let (_, field) = class.spec().field(name.as_bytes()).expect(name);
        let expected = field.word(meaning.as_bytes());
        assert!(expected.is_some());
        assert_eq!(field.word(b"DEFAULT"), expected, "{class:?}");
    }
}
