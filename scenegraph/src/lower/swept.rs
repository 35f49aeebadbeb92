//! `GeneralizedCylinder` of SGI's modeller noodle: becomes a Separator that holds what the kit
//! holds and, as an IndexedFaceSet, the surface that the modeller makes of its curves. The
//! numerics are in `geometry::generalized_cylinder`.

use std::f64::consts::FRAC_PI_6;

use geometry::generalized_cylinder::{Curves, rows};
use glam::DVec3;
use iv_parser::Severity;

use super::Builder;
use super::upgrade::{set, set_word};
use crate::graph::{FieldValue, Kind, Node, NodeId};
use crate::registry::Class;

/// Parts that stand before the surface, in the kit's order.
const BEFORE: [&str; 5] = [
    "pickStyle",
    "appearance",
    "units",
    "transform",
    "texture2Transform",
];

/// The surface of a node whose parts are all in the graph.
pub(super) fn expand(builder: &mut Builder<'_>, handle: NodeId) {
    let kit = builder.nodes[handle.0 as usize].clone();
    let nodes = &builder.nodes;
    let part = |field: &str| kit.node_field(field);
    let mut children: Vec<NodeId> = BEFORE.into_iter().filter_map(part).collect();
    let after = part("childList").and_then(|list| {
        let list = &nodes[list.0 as usize];
        list.node_field("containerNode")
    });
    let curves = [
        "profileCoords",
        "crossSectionCoords",
        "spineCoords",
        "twistCoords",
    ];
    let curves = curves.map(|field| curve(nodes, &kit, field));
    match surface(&kit, &curves) {
        Some((points, faces)) => {
            let hints = shape_hints(&kit);
            let mut coordinates = bare(Class::Coordinate3, &kit);
            set(&mut coordinates, "point", FieldValue::Many(points.into()));
            let mut set_of_faces = bare(Class::IndexedFaceSet, &kit);
            set(
                &mut set_of_faces,
                "coordIndex",
                FieldValue::Ints(faces.into()),
            );
            let made = [hints, coordinates, set_of_faces];
            children.extend(made.map(|node| builder.add(node)));
        }
        None => builder.late_problem(
            Severity::Warning,
            "no-surface",
            "the curves of a GeneralizedCylinder make no surface".to_owned(),
            "profile and cross section need two points at least, and all together at most ten \
             million points",
            handle,
        ),
    }
    if flag(&kit, "withTextureCoords") {
        builder.late_problem(
            Severity::Note,
            "not-supported",
            "texture coordinates of a GeneralizedCylinder are not those of the modeller".to_owned(),
            "they are made from its bounds",
            handle,
        );
    }
    children.extend(after);
    let node = &mut builder.nodes[handle.0 as usize];
    node.kind = Kind::Known(Class::Separator);
    node.fields.clear();
    node.children = children;
}

fn bare(class: Class, like: &Node) -> Node {
    Node {
        kind: Kind::Known(class),
        name: None,
        fields: Vec::new(),
        children: Vec::new(),
        pos: like.pos,
    }
}

/// The modeller's hints, but that caps may be concave.
fn shape_hints(kit: &Node) -> Node {
    let mut hints = bare(Class::ShapeHints, kit);
    set_word(&mut hints, "vertexOrdering", "COUNTERCLOCKWISE");
    set_word(&mut hints, "faceType", "UNKNOWN_FACE_TYPE");
    set(
        &mut hints,
        "creaseAngle",
        FieldValue::from_numbers(&[FRAC_PI_6]),
    );
    hints
}

fn flag(kit: &Node, field: &str) -> bool {
    matches!(kit.value(field), FieldValue::Bool(true))
}

/// The points of a part, or those it has by default.
fn curve(nodes: &[Node], kit: &Node, field: &str) -> Vec<DVec3> {
    let numbers = kit
        .node_field(field)
        .map(|id| nodes[id.0 as usize].numbers("point"));
    let default: &[f64] = match field {
        "profileCoords" => &[1.0, -1.0, 0.0, 1.0, 1.0, 0.0],
        "crossSectionCoords" => &[
            1.0, 0.0, 1.0, 1.0, 0.0, -1.0, -1.0, 0.0, -1.0, -1.0, 0.0, 1.0,
        ],
        _ => &[0.0, -1.0, 0.0, 0.0, 1.0, 0.0],
    };
    let (points, _) = numbers.unwrap_or(default).as_chunks::<3>();
    points.iter().map(|&p| DVec3::from(p)).collect()
}

/// The curve with its first point again at its end.
fn closed(mut curve: Vec<DVec3>, closes: bool) -> Vec<DVec3> {
    if closes && curve.len() > 1 && curve.first() != curve.last() {
        curve.push(curve[0]);
    }
    curve
}

/// Coordinates and face indices.
fn surface(kit: &Node, curves: &[Vec<DVec3>; 4]) -> Option<(Vec<f64>, Vec<i32>)> {
    let [profile, section, spine, twist] = curves.clone();
    let is_section_closed = flag(kit, "crossSectionClosed");
    let least = ["minNumRows", "minNumCols"].map(|field| kit.int(field).max(1) as usize);
    let section = closed(section, is_section_closed);
    let rows = rows(&Curves {
        profile: &closed(profile, flag(kit, "profileClosed")),
        cross_section: &section,
        spine: &closed(spine, flag(kit, "spineClosed")),
        twist: &closed(twist, flag(kit, "twistClosed")),
        is_spine_closed: flag(kit, "spineClosed"),
        least,
    })?;
    let columns = rows[0].len();
    let points = rows.iter().flatten().flat_map(|p| p.to_array()).collect();
    // Where the cross section closes, both ends are one point, and smooth.
    let around = if section.first() == section.last() {
        columns - 1
    } else {
        columns
    };
    let at = |row: usize, column: usize| (row * columns + column % around) as i32;
    let mut faces = Faces {
        list: Vec::new(),
        flips: flag(kit, "normsFlipped"),
    };
    if flag(kit, "withSides") {
        for row in 1..rows.len() {
            for column in 1..columns {
                let [above, below] = [at(row - 1, column - 1), at(row, column - 1)];
                let [above_next, below_next] = [at(row - 1, column), at(row, column)];
                faces.add([above, above_next, below].into_iter());
                faces.add([below, above_next, below_next].into_iter());
            }
        }
    }
    if is_section_closed && columns >= 4 {
        if flag(kit, "withTopCap") {
            faces.add((0..around).rev().map(|column| at(0, column)));
        }
        if flag(kit, "withBottomCap") {
            faces.add((0..around).map(|column| at(rows.len() - 1, column)));
        }
    }
    Some((points, faces.list))
}

struct Faces {
    list: Vec<i32>,
    flips: bool,
}

impl Faces {
    fn add(&mut self, corners: impl DoubleEndedIterator<Item = i32>) {
        if self.flips {
            self.list.extend(corners.rev());
        } else {
            self.list.extend(corners);
        }
        self.list.push(-1);
    }
}
