//! Files of Inventor 1.0 and 2.0, by SGI's upgrade rules.

use iv_parser::{Atom, FieldId, Header, Value};

use super::File;
use crate::graph::{FieldEntry, FieldValue, Kind, Node, NodeId};
use crate::registry::Class;

/// Sets a field of the node by its name.
fn set(node: &mut Node, field: &str, value: FieldValue) {
    let Some(class) = node.class() else { return };
    let Some((index, _)) = class.spec().field(field.as_bytes()) else {
        return;
    };
    node.fields.push(FieldEntry {
        index: index as u16,
        ignored: false,
        value,
    });
}

/// Sets an enum field by its word.
fn set_word(node: &mut Node, field: &str, word: &str) {
    let Some(class) = node.class() else { return };
    let Some((_, spec)) = class.spec().field(field.as_bytes()) else {
        return;
    };
    if let Some(value) = spec.word(word.as_bytes()) {
        set(node, field, FieldValue::Word(value));
    }
}

/// Adjusts a node that has just been read to today's meaning.
pub(super) fn adjust(node: &mut Node, header: Header) {
    if !header.is_older_than(2, 0) {
        return;
    }
    if node.class() == Some(Class::Material) && node.number("shininess") == 0.0
        || node.class() == Some(Class::Material) && node.entry("shininess").is_none()
    {
        set(node, "specularColor", FieldValue::from_numbers(&[0.0; 3]));
    }
}

/// A field that only old files have; true if it is one.
pub(super) fn old_field(
    file: &mut File<'_, '_, '_, '_>,
    class: Class,
    id: FieldId,
    node: &mut Node,
) -> bool {
    let tree = file.tree;
    let field = tree.field(id);
    match (class, field.name) {
        (Class::PackedColor, b"rgba") => {
            // 0xAABBGGRR became 0xRRGGBBAA.
            let Value::Numbers { numbers, .. } = &field.value else {
                return false;
            };
            let swap = |v: i64| (v as u32).swap_bytes() as i32;
            let colors: Vec<i32> = match (tree.ints(numbers), tree.floats(numbers)) {
                (Some(ints), _) => ints.iter().map(|&v| swap(i64::from(v))).collect(),
                (_, Some(floats)) => floats.iter().map(|&v| swap(v as i64)).collect(),
                _ => return false,
            };
            set(node, "orderedRGBA", FieldValue::Ints(colors.into()));
        }
        (Class::ShapeHints, b"hints") => {
            let words: Vec<&[u8]> = match &field.value {
                Value::Atoms { atoms, .. } | Value::Mask(atoms) => tree
                    .atoms(*atoms)
                    .iter()
                    .filter_map(|a| {
                        if let Atom::Word(w, _) = a {
                            Some(*w)
                        } else {
                            None
                        }
                    })
                    .collect(),
                _ => return false,
            };
            let has = |word: &[u8]| words.contains(&word);
            if has(b"SOLID") {
                set_word(node, "shapeType", "SOLID");
            }
            if has(b"ORDERED") {
                set_word(node, "vertexOrdering", "COUNTERCLOCKWISE");
            }
            if !has(b"CONVEX") {
                set_word(node, "faceType", "UNKNOWN_FACE_TYPE");
            }
        }
        (Class::Texture2, b"component" | b"minFilter" | b"magFilter") => {}
        (Class::Environment, b"fogComputed" | b"near" | b"far" | b"density") => {}
        _ => return false,
    }
    true
}

/// Gives a node of an old class the class and children it has today.
pub(super) fn replace(file: &mut File<'_, '_, '_, '_>, id: NodeId) {
    let node = &mut file.builder.nodes[id.0 as usize];
    if let Kind::Unknown(name) = &node.kind
        && &**name == "LayerGroup"
        && file.tree.header.is_older_than(2, 1)
    {
        node.kind = Kind::Known(Class::Separator);
    }
}
