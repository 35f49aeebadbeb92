//! Node kits: the parts that a kit's fields hold become its children, in the catalog's order, which
//! is the order of traversal. `appearance.material` is the part `material` of the part
//! `appearance`, which is made if it is not there (SoBaseKit in the Inventor Reference).

use iv_parser::{Severity, Span};

use super::File;
use super::upgrade::set;
use crate::graph::{FieldValue, Kind, Node, NodeId};
use crate::registry::{Class, Family, FieldType};

/// A part given by the path to it.
pub(super) struct Compound {
    /// The kit whose field it stands as.
    pub kit: NodeId,
    /// `appearance.material`.
    pub path: String,
    /// The part.
    pub part: NodeId,
    /// Where it stands.
    pub span: Span,
}

/// Parts that hold others and are not written to files, and those that draw nothing.
const INNER: [&str; 6] = [
    "callbackList",
    "topSeparator",
    "transformGroup",
    "shapeSeparator",
    "iconSeparator",
    "geomSeparator",
];

/// Gives kits their children; all nodes of the file are in the graph.
pub(super) fn settle(file: &mut File<'_, '_, '_, '_>, mut kits: Vec<NodeId>) {
    for compound in std::mem::take(&mut file.compounds) {
        let made = place(&mut file.builder.nodes, &compound, &mut kits);
        if made.is_none() {
            let message = format!("`{}` is no part that a kit has here", compound.path);
            let hint = "a part within a part needs the outer one to be there; it was left out";
            file.problem(
                Severity::Warning,
                "unknown-part",
                message,
                hint,
                compound.span,
            );
        }
    }
    for kit in kits {
        let children = children(file, kit);
        file.builder.nodes[kit.0 as usize].children = children;
    }
}

/// Puts a part where its path says.
fn place(nodes: &mut Vec<Node>, compound: &Compound, kits: &mut Vec<NodeId>) -> Option<()> {
    let mut kit = compound.kit;
    let mut names = compound.path.split('.').peekable();
    while let Some(name) = names.next() {
        let node = &nodes[kit.0 as usize];
        let spec = node.class()?.spec();
        let (_, field) = spec.field(name.as_bytes())?;
        if !matches!(spec.family, Family::Kit) || field.field_type != FieldType::SFNode {
            return None;
        }
        let existing = node.node_field(name);
        let held = match (names.peek(), existing) {
            (None, _) => compound.part,
            (Some(_), Some(held)) => {
                kit = held;
                continue;
            }
            (Some(_), None) if name == "appearance" => {
                let pos = node.pos;
                nodes.push(bare(Class::AppearanceKit, pos));
                let made = NodeId(nodes.len() as u32 - 1);
                kits.push(made);
                made
            }
            (Some(_), None) => return None,
        };
        set(
            &mut nodes[kit.0 as usize],
            name,
            FieldValue::Nodes(vec![held]),
        );
        kit = held;
    }
    Some(())
}

fn bare(class: Class, pos: iv_parser::SourcePos) -> Node {
    Node {
        kind: Kind::Known(class),
        name: None,
        fields: Vec::new(),
        children: Vec::new(),
        pos,
    }
}

fn children(file: &mut File<'_, '_, '_, '_>, kit: NodeId) -> Vec<NodeId> {
    let node = &file.builder.nodes[kit.0 as usize];
    let Some(class) = node.class() else {
        return Vec::new();
    };
    if class == Class::NodeKitListPart {
        return node.node_field("containerNode").into_iter().collect();
    }
    let is_part = |name: &str| !INNER.contains(&name);
    let fields = class.spec().fields.iter();
    let mut children: Vec<NodeId> = fields
        .filter(|field| field.field_type == FieldType::SFNode && is_part(field.name))
        .filter_map(|field| node.node_field(field.name))
        .collect();
    // The only part that a kit has without being given it.
    if class == Class::ShapeKit && node.entry("shape").is_none() {
        let cube = bare(Class::Cube, node.pos);
        children.push(file.builder.add(cube));
    }
    children
}
