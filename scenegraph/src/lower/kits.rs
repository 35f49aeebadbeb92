//! Node kits: the parts that a kit's fields hold become its children, in the catalog's order, which
//! is the order of traversal. `appearance.material` is the part `material` of the part
//! `appearance`, which is made if it is not there (SoBaseKit in the Inventor Reference).

use iv_parser::Severity;
use rustc_hash::FxHashSet;

use super::Builder;
use super::upgrade::set;
use crate::graph::{FieldValue, Kind, Node, NodeId};
use crate::registry::{Class, Family, FieldType};

/// Handles that are followed to find out which parts would hold themselves, all parts together.
const MAX_SEARCHED: usize = 10_000_000;

/// A part given by the path to it.
pub(super) struct Compound {
    /// The kit whose field it stands as.
    pub kit: NodeId,
    /// `appearance.material`.
    pub path: String,
    /// The part.
    pub part: NodeId,
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

/// Why a part cannot be put where its path says.
enum Refused {
    /// The path leads nowhere.
    Unknown,
    /// The part holds the kit that would hold it.
    Cycle,
    /// It could not be found out in reasonable time.
    Undecided,
}

/// Puts parts where their paths say.
pub(super) fn place_all(builder: &mut Builder<'_>, compounds: Vec<Compound>) {
    let mut room = MAX_SEARCHED;
    for compound in compounds {
        let Err(why) = place(&mut builder.nodes, &compound, &mut room) else {
            continue;
        };
        let path = &compound.path;
        let (severity, code, message, hint) = match why {
            Refused::Unknown => (
                Severity::Warning,
                "unknown-part",
                format!("`{path}` is no part that a kit has here"),
                "a part within a part needs the outer one to be there; it was left out",
            ),
            Refused::Cycle => (
                Severity::Error,
                "cycle",
                format!("the part `{path}` holds the kit that it is a part of"),
                "a node cannot hold itself; the part was left out",
            ),
            Refused::Undecided => (
                Severity::Error,
                "too-many-parts",
                format!("it takes too long to find out whether `{path}` holds itself"),
                "the part was left out; there are too many parts within parts",
            ),
        };
        builder.late_problem(severity, code, message, hint, compound.kit);
    }
}

/// Puts a part where its path says.
fn place(nodes: &mut Vec<Node>, compound: &Compound, room: &mut usize) -> Result<(), Refused> {
    let mut kit = compound.kit;
    let mut names = compound.path.split('.').peekable();
    while let Some(name) = names.next() {
        let node = &nodes[kit.0 as usize];
        let existing = held(node, name).ok_or(Refused::Unknown)?;
        let held = match (names.peek(), existing) {
            (None, _) => {
                check_part(nodes, compound.part, kit, room)?;
                compound.part
            }
            (Some(_), Some(held)) => {
                kit = held;
                continue;
            }
            (Some(_), None) if name == "appearance" => {
                nodes.push(bare(Class::AppearanceKit, node.pos));
                NodeId(nodes.len() as u32 - 1)
            }
            (Some(_), None) => return Err(Refused::Unknown),
        };
        set(
            &mut nodes[kit.0 as usize],
            name,
            FieldValue::Nodes(vec![held]),
        );
        kit = held;
    }
    Ok(())
}

/// What a kit's part `name` holds; `None` if it has no such part.
fn held(kit: &Node, name: &str) -> Option<Option<NodeId>> {
    let spec = kit.class()?.spec();
    let (_, field) = spec.field(name.as_bytes())?;
    let is_part = matches!(spec.family, Family::Kit) && field.field_type == FieldType::SFNode;
    is_part.then(|| kit.node_field(name))
}

/// Whether `part` can stand in `kit` without holding it.
fn check_part(nodes: &[Node], part: NodeId, kit: NodeId, room: &mut usize) -> Result<(), Refused> {
    let mut seen = FxHashSet::default();
    let mut open = vec![part];
    while let Some(id) = open.pop() {
        if id == kit {
            return Err(Refused::Cycle);
        }
        if seen.insert(id) {
            let before = open.len();
            open.extend(nodes[id.0 as usize].handles());
            let cost = 1 + open.len() - before;
            *room = room.checked_sub(cost).ok_or(Refused::Undecided)?;
        }
    }
    Ok(())
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

/// The children of a kit: what its parts hold.
pub(super) fn children(builder: &mut Builder<'_>, kit: NodeId) -> Vec<NodeId> {
    let node = &builder.nodes[kit.0 as usize];
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
        children.push(builder.add(cube));
    }
    children
}
