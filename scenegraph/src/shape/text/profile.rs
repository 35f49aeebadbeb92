//! How deep letters are and how their edges are cut: the profile in force, as a polygon from the
//! front to the back.

use geometry::nurbs::{Fineness, TrimPiece};
use glam::DVec2;

use crate::remarks::Remarks;

use super::super::Job;
use super::super::primitives::slices;
use super::super::profiles::trim_loops;

/// A polygon: x is the depth behind the front, y how far outside of the letter's outline.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// At least one. Neighbours are not equal.
    pub points: Vec<ProfilePoint>,
    /// Corners that turn by less have one normal, radians.
    pub crease_angle_rad: f64,
}

/// A corner of the polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfilePoint {
    pub p: DVec2,
    /// It lies within a curve.
    pub smooth: bool,
}

/// Points of a profile; each makes a band around every letter.
const MAX_POINTS: usize = 1024;

impl Profile {
    fn of_corners(corners: &[DVec2], crease_angle_rad: f64) -> Self {
        let point = |&p: &DVec2| ProfilePoint { p, smooth: false };
        Self {
            points: corners.iter().map(point).collect(),
            crease_angle_rad,
        }
    }

    /// No depth.
    pub fn flat() -> Self {
        Self::of_corners(&[DVec2::ZERO], 0.0)
    }
}

/// The profile in force: the first loop of those that trim surfaces. Without one, letters are one
/// unit deep, whatever their size. `tolerance` is how far chords may miss a curve.
pub fn of(job: &Job<'_>, tolerance: f64, remarks: &mut Remarks) -> Profile {
    let crease_angle_rad = job.state.hints.crease_angle_rad;
    let mut points: Vec<ProfilePoint> = Vec::new();
    let mut cut = false;
    let loops = trim_loops(job, remarks);
    for piece in loops.first().map_or(&[][..], |first| &first.pieces) {
        let made = match piece {
            TrimPiece::Line(corners) => corners.clone(),
            TrimPiece::Curve(curve) => {
                let fineness = Fineness {
                    chord: tolerance,
                    turn_rad: std::f64::consts::TAU / f64::from(slices(job.state.complexity)),
                    most_points: MAX_POINTS,
                };
                let line = curve.polyline(&fineness);
                line.map_or_else(
                    |_| Vec::new(),
                    |l| l.points.iter().map(|p| p.truncate()).collect(),
                )
            }
        };
        let is_curve = matches!(piece, TrimPiece::Curve(_));
        let last = made.len().saturating_sub(1);
        for (i, &p) in made.iter().enumerate() {
            cut |= points.len() >= MAX_POINTS;
            if points.last().is_none_or(|before| before.p != p) && !cut {
                let smooth = is_curve && i > 0 && i < last;
                points.push(ProfilePoint { p, smooth });
            }
        }
    }
    if cut {
        remarks.warn(
            "long-profile",
            "a profile that shapes text has too many points",
            "the rest of them was left out",
            job.graph.node(job.node).pos,
        );
    }
    // A profile that runs forward would turn the letters inside out.
    if let (Some(first), Some(last)) = (points.first(), points.last())
        && last.p.x < first.p.x
    {
        points.reverse();
    }
    if points.is_empty() {
        return Profile::of_corners(&[DVec2::ZERO, DVec2::X], crease_angle_rad);
    }
    Profile {
        points,
        crease_angle_rad,
    }
}
