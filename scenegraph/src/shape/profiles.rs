//! `LinearProfile` and `NurbsProfile` as the trim loops of a surface.
//!
//! START_FIRST and START_NEW begin a loop, ADD_TO_CURRENT continues it. Points are those of the
//! ProfileCoordinate2 in force at the surface, or of a ProfileCoordinate3, whose third number is a
//! weight that multiplies the others (SoProfile in the Inventor Reference).

use geometry::nurbs::{Curve, NurbsError, TrimLoop, TrimPiece};
use glam::{DVec2, DVec4};

use crate::graph::{Node, NodeId};
use crate::registry::Class;
use crate::remarks::Remarks;

use super::Job;

/// The points that profiles choose from.
struct Points<'g> {
    numbers: &'g [f64],
    size: usize,
}

impl Points<'_> {
    /// (x w, y w, 0, w).
    fn get(&self, index: i32) -> Option<DVec4> {
        let start = usize::try_from(index).ok()?.checked_mul(self.size)?;
        match *self.numbers.get(start..start + self.size)? {
            [x, y] => Some(DVec4::new(x, y, 0.0, 1.0)),
            [x, y, w] => Some(DVec4::new(x, y, 0.0, w)),
            _ => None,
        }
    }
}

/// The loops of a job's profiles. A loop with a profile that cannot be used is left out whole.
pub fn trim_loops(job: &Job<'_>, remarks: &mut Remarks) -> Vec<TrimLoop> {
    let graph = job.graph;
    let points = points(job.state.profile_coordinates.map(|id| graph.node(id)));
    let mut loops: Vec<Option<TrimLoop>> = Vec::new();
    for &NodeId(id) in &job.profiles {
        let node = graph.node(NodeId(id));
        let piece = piece(node, &points).map_err(|error| {
            remarks.warn(
                "bad-profile",
                &format!("{}: {error}", node.class_name()),
                "the surfaces it belongs to are not trimmed by its loop",
                node.pos,
            );
        });
        let goes_on = node.word("linkage") == "ADD_TO_CURRENT";
        match (loops.last_mut().filter(|_| goes_on), piece.ok()) {
            (Some(last), Some(piece)) => {
                if let Some(trim) = last {
                    trim.pieces.push(piece);
                }
            }
            (Some(last), None) => *last = None,
            (None, piece) => loops.push(piece.map(|piece| TrimLoop {
                pieces: vec![piece],
            })),
        }
    }
    loops.into_iter().flatten().collect()
}

fn points(node: Option<&Node>) -> Points<'_> {
    // Inventor's default list holds the origin.
    let Some(node) = node else {
        return Points {
            numbers: &[0.0; 2],
            size: 2,
        };
    };
    let size = match node.class() {
        Some(Class::ProfileCoordinate3) => 3,
        _ => 2,
    };
    Points {
        numbers: node.numbers("point"),
        size,
    }
}

fn piece(node: &Node, points: &Points<'_>) -> Result<TrimPiece, NurbsError> {
    let chosen: Option<Vec<DVec4>> = node.ints("index").iter().map(|&i| points.get(i)).collect();
    let chosen = chosen.ok_or(NurbsError::PointCount)?;
    if node.class() == Some(Class::NurbsProfile) {
        let knots = node.numbers("knotVector").to_vec();
        return Curve::new(chosen, knots).map(TrimPiece::Curve);
    }
    let place = |h: &DVec4| (h.w != 0.0).then(|| DVec2::new(h.x, h.y) / h.w);
    let places: Option<Vec<DVec2>> = chosen.iter().map(place).collect();
    places.map(TrimPiece::Line).ok_or(NurbsError::Weight)
}
