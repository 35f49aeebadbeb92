//! Files of Inventor 1.0 and 2.0: what their classes and fields are today, by SGI's rules.

use crate::graph::{FieldEntry, FieldValue, Kind, Node, NodeId};
use crate::registry::{Class, FieldSpec};

use super::File;

/// A field in a form that only old files have.
pub(super) struct OldValue {
    pub spec: &'static FieldSpec,
    pub value: FieldValue,
}

impl OldValue {
    fn word(&self) -> &'static str {
        let FieldValue::Word(value) = self.value else {
            return "";
        };
        let words = self.spec.words.iter();
        words
            .into_iter()
            .find(|w| w.value == value)
            .map_or("", |w| w.name)
    }

    fn has_bit(&self, name: &[u8]) -> bool {
        let bit = self.spec.word(name).unwrap_or(0);
        matches!(self.value, FieldValue::Word(bits) if bits & bit != 0)
    }

    fn number(&self) -> f64 {
        match &self.value {
            FieldValue::Int(i) => f64::from(*i),
            other => other.numbers().first().copied().unwrap_or(0.0),
        }
    }
}

/// Sets a field of the node by its name.
pub(super) fn set(node: &mut Node, field: &str, value: FieldValue) {
    let Some((index, _)) = node.class().and_then(|c| c.spec().field(field.as_bytes())) else {
        return;
    };
    node.fields.push(FieldEntry {
        index: index as u16,
        ignored: false,
        value,
    });
}

/// Sets an enum field by its word.
pub(super) fn set_word(node: &mut Node, field: &str, word: &str) {
    let spec = node.class().and_then(|c| c.spec().field(field.as_bytes()));
    let value = spec.and_then(|(_, spec)| spec.word(word.as_bytes()));
    if let Some(value) = value {
        set(node, field, FieldValue::Word(value));
    }
}

/// Gives a node of a file of Inventor 1.0 or 2.0 today's class and fields.
pub(super) fn upgrade(node: &mut Node, old: &[OldValue], version: (u8, u8)) {
    let Some(class) = node.class() else { return };
    let find = |name: &str| old.iter().rev().find(|f| f.spec.name == name);
    match class {
        Class::LayerGroup => node.kind = Kind::Known(Class::Separator),
        Class::CustomNode => node.kind = Kind::Known(Class::Group),
        Class::MaterialIndex => node.kind = Kind::Known(Class::ColorIndex),
        Class::IndexedTriangleMesh => triangle_mesh(node),
        // What a group holds may stand in the replacement that readers of 2.0 were given. For an
        // LOD that is a LevelOfDetail, which is taken whole, as the finest level.
        Class::LOD | Class::WWWAnchor if node.children.is_empty() => {
            if let Some(FieldValue::Nodes(nodes)) = find("alternateRep").map(|f| &f.value) {
                node.children.extend(nodes);
            }
        }
        Class::PackedColor => {
            if let Some(rgba) = find("rgba") {
                // 0xAABBGGRR became 0xRRGGBBAA.
                let swapped = rgba.value.ints().iter().map(|v| v.swap_bytes());
                let swapped: Vec<i32> = swapped.collect();
                set(node, "orderedRGBA", FieldValue::Ints(swapped.into()));
            }
        }
        Class::Material
            if version < (2, 0)
            // Without shininess the first Inventor drew no highlight.
            && (node.entry("shininess").is_none() || node.number("shininess") == 0.0) =>
        {
            set(node, "specularColor", FieldValue::from_numbers(&[0.0; 3]));
        }
        Class::ShapeHints => {
            if let Some(hints) = find("hints") {
                shape_hints(node, hints);
            }
        }
        Class::DrawStyle => {
            if let Some(width) = find("lineWidth") {
                let width = FieldValue::from_numbers(&[width.number()]);
                set(node, "lineWidth", width);
            }
        }
        Class::LightModel => match find("model").map(OldValue::word) {
            Some("DEPTH") => {
                node.kind = Kind::Known(Class::Environment);
                node.fields.clear();
                set_word(node, "fogType", "HAZE");
            }
            Some(word) => set_word(node, "model", word),
            None => {}
        },
        Class::Environment => environment(node, &find),
        Class::TextureCoordinatePlane => texture_plane(node, &find),
        Class::Texture2 => {
            for field in ["filename", "blendColor"] {
                if let Some(old) = find(field) {
                    set(node, field, old.value.clone());
                }
            }
        }
        _ => {}
    }
}

fn shape_hints(node: &mut Node, hints: &OldValue) {
    if hints.has_bit(b"SOLID") {
        set_word(node, "shapeType", "SOLID");
    }
    if hints.has_bit(b"ORDERED") {
        set_word(node, "vertexOrdering", "COUNTERCLOCKWISE");
    }
    if !hints.has_bit(b"CONVEX") {
        set_word(node, "faceType", "UNKNOWN_FACE_TYPE");
    }
}

fn environment<'f>(node: &mut Node, find: &dyn Fn(&str) -> Option<&'f OldValue>) {
    let today = match find("fogType").map(OldValue::word) {
        Some("LINEAR") => "HAZE",
        Some("EXPONENTIAL") => "SMOKE",
        Some("EXPONENTIAL_SQUARED") => "FOG",
        _ => return,
    };
    set_word(node, "fogType", today);
    let density = find("fogDensity").map_or(0.0, OldValue::number);
    if density > 0.0 {
        let reach = if today == "SMOKE" { 2.0 } else { 4.0 };
        set(
            node,
            "fogVisibility",
            FieldValue::from_numbers(&[reach / density]),
        );
    }
}

/// Distance from a plane, repeated: today's direction has the length of one repeat.
fn texture_plane<'f>(node: &mut Node, find: &dyn Fn(&str) -> Option<&'f OldValue>) {
    let Some(normal) = find("normal") else { return };
    let interval = find("repeatInterval").map_or(1.0, OldValue::number);
    let direction: Vec<f64> = normal
        .value
        .numbers()
        .iter()
        .map(|v| v * interval)
        .collect();
    let direction = FieldValue::from_numbers(&direction);
    let coord = find("coord").map_or("ALL", OldValue::word);
    if coord != "T" {
        set(node, "directionS", direction.clone());
    }
    if coord != "S" {
        set(node, "directionT", direction);
    }
}

/// The index -2 swapped the two vertices that a mesh keeps; in a strip the older of them is
/// repeated for that.
fn triangle_mesh(node: &mut Node) {
    const SWAP: i32 = -2;
    let source = node.ints("coordIndex").to_vec();
    let lists = [
        "coordIndex",
        "materialIndex",
        "normalIndex",
        "textureCoordIndex",
    ];
    let unswapped = lists.map(|field| {
        let list = node.ints(field);
        let mut strip: Vec<i32> = Vec::with_capacity(list.len());
        for (slot, &value) in list.iter().enumerate() {
            let swaps = source.get(slot) == Some(&SWAP) || value == SWAP;
            let older = strip.len().checked_sub(2).map(|i| strip[i]);
            strip.push(if swaps { older.unwrap_or(-1) } else { value });
        }
        strip
    });
    let given = lists.map(|field| node.entry(field).is_some());
    node.kind = Kind::Known(Class::IndexedTriangleStripSet);
    node.fields.clear();
    for ((field, strip), given) in lists.into_iter().zip(unswapped).zip(given) {
        if given {
            set(node, field, FieldValue::Ints(strip.into()));
        }
    }
}

/// What takes more than one node today: a Texture2 of Inventor 1.0 with a transform of its own
/// becomes a group of a Texture2Transform and the texture.
pub(super) fn split(file: &mut File<'_, '_, '_, '_>, id: NodeId, old: &[OldValue]) {
    let node = &file.builder.nodes[id.0 as usize];
    let transform = ["translation", "scaleFactor", "rotation", "center"];
    let moved: Vec<&OldValue> = old
        .iter()
        .filter(|f| transform.contains(&f.spec.name))
        .collect();
    if node.class() != Some(Class::Texture2) || moved.is_empty() {
        return;
    }
    let texture = node.clone();
    let mut placed = Node {
        kind: Kind::Known(Class::Texture2Transform),
        name: None,
        fields: Vec::new(),
        children: Vec::new(),
        pos: texture.pos,
    };
    for field in moved {
        set(&mut placed, field.spec.name, field.value.clone());
    }
    let children = vec![file.builder.add(placed), file.builder.add(texture)];
    let node = &mut file.builder.nodes[id.0 as usize];
    node.kind = Kind::Known(Class::Group);
    node.fields.clear();
    node.children = children;
}
