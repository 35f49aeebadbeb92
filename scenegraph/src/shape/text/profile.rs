//! How deep letters are and how their edges are cut: the profile in force, as a polygon from the
//! front to the back.

use glam::DVec2;

use crate::graph::Node;
use crate::registry::Class;
use crate::remarks::Remarks;

use super::super::Job;

/// A polygon: x is the depth behind the front, y how far outside of the letter's outline.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// At least one point. Neighbours are not equal.
    pub points: Vec<DVec2>,
    /// Corners that turn by less have one normal, radians.
    pub crease_angle_rad: f64,
}

/// Points of a profile; each makes a band around every letter.
const MAX_POINTS: usize = 1024;

impl Profile {
    /// No depth.
    pub fn flat() -> Self {
        Self {
            points: vec![DVec2::ZERO],
            crease_angle_rad: 0.0,
        }
    }

    /// One unit deep, whatever the size: Inventor's letters without a profile.
    fn unit(crease_angle_rad: f64) -> Self {
        Self {
            points: vec![DVec2::ZERO, DVec2::X],
            crease_angle_rad,
        }
    }
}

/// The profile in force.
pub fn of(job: &Job<'_>, remarks: &mut Remarks) -> Profile {
    let state = job.state;
    let crease_angle_rad = state.hints.crease_angle_rad;
    let Some(node) = state.profile.map(|id| job.graph.node(id)) else {
        return Profile::unit(crease_angle_rad);
    };
    let source = state.profile_coordinates.map(|id| job.graph.node(id));
    let available = source.map_or_else(Vec::new, coordinates);
    let indices = node.ints("index");
    let listed = indices.iter().filter_map(|&i| {
        let index = usize::try_from(i).ok()?;
        available.get(index).copied()
    });
    let mut points: Vec<DVec2> = listed.take(MAX_POINTS).collect();
    if points.len() < indices.len() {
        remarks.warn(
            "profile-points",
            "a profile asks for points that are not there, or for too many",
            "they were left out",
            node.pos,
        );
    }
    points.dedup();
    if node.class() == Some(Class::NurbsProfile) {
        remarks.warn(
            "profile-polygon",
            "a NurbsProfile shapes text",
            "its control points were taken for corners",
            node.pos,
        );
    }
    // A profile that runs forward would turn the letters inside out.
    if let (Some(first), Some(last)) = (points.first(), points.last())
        && last.x < first.x
    {
        points.reverse();
    }
    if points.is_empty() {
        return Profile::unit(crease_angle_rad);
    }
    Profile {
        points,
        crease_angle_rad,
    }
}

/// Points of a `ProfileCoordinate2`, or of a `ProfileCoordinate3` with weights.
fn coordinates(node: &Node) -> Vec<DVec2> {
    let numbers = node.numbers("point");
    if node.class() == Some(Class::ProfileCoordinate3) {
        let divided = |&[x, y, w]: &[f64; 3]| {
            let w = if w == 0.0 { 1.0 } else { w };
            DVec2::new(x, y) / w
        };
        return numbers.as_chunks::<3>().0.iter().map(divided).collect();
    }
    let (pairs, _) = numbers.as_chunks::<2>();
    pairs.iter().map(|&pair| DVec2::from(pair)).collect()
}
