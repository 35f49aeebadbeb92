//! Lines that belong to no object: a grid, axes, marks of what is measured.

use glam::DVec3;

use super::{Segment, anchor, diagonal, from_anchor};
use crate::content::Content;
use crate::view::framing::Up;

const GRID: [u8; 4] = [128, 128, 128, 110];
const STRONG: [u8; 4] = [128, 128, 128, 220];
const MARK: [u8; 4] = [255, 210, 0, 255];
/// Lines of a grid in each direction, at most; a coarser step is taken instead.
const MOST_LINES: f64 = 60.0;

/// Segments in the world as segments about the anchor.
fn segment(content: &Content, a: DVec3, b: DVec3, rgba: [u8; 4]) -> Segment {
    let anchor = anchor(content);
    Segment {
        a: from_anchor(anchor, a),
        object: content.objects.len() as u32,
        b: from_anchor(anchor, b),
        rgba,
    }
}

/// A grid below the scene, of steps that are powers of ten, every tenth line stronger; and its
/// step.
pub fn grid(content: &Content, up: Up) -> (Vec<Segment>, f64) {
    let bounds = &content.bounds;
    if bounds.is_empty() {
        return (Vec::new(), 0.0);
    }
    let (across, along, vertical) = match up {
        Up::Z => (DVec3::X, DVec3::Y, DVec3::Z),
        Up::Y => (DVec3::X, DVec3::Z, DVec3::Y),
    };
    let size = bounds.size().dot(across).max(bounds.size().dot(along));
    let size = if size > 0.0 {
        size
    } else {
        diagonal(bounds).max(1e-9)
    };
    let mut step = 10_f64.powf((size / MOST_LINES).log10().ceil());
    if !(step > 0.0 && step.is_finite()) {
        step = 1.0;
    }
    let ground = vertical * bounds.min.dot(vertical);
    let ends = |axis: DVec3| {
        let room = step;
        let low = ((bounds.min.dot(axis) - room) / step).floor();
        let high = ((bounds.max.dot(axis) + room) / step).ceil();
        (low, high)
    };
    let mut segments = Vec::new();
    let mut lines = |axis: DVec3, other: DVec3| {
        let ((low, high), (from, to)) = (ends(axis), ends(other));
        let count = (high - low).clamp(0.0, 4.0 * MOST_LINES) as u32;
        for i in 0..=count {
            let number = low + f64::from(i);
            let p = ground + axis * (number * step);
            let is_strong = number.rem_euclid(10.0) == 0.0;
            segments.push(segment(
                content,
                p + other * (from * step),
                p + other * (to * step),
                if is_strong { STRONG } else { GRID },
            ));
        }
    };
    lines(across, along);
    lines(along, across);
    (segments, step)
}

/// The axes, red, green and blue: at the world's origin if the scene is near it, else at the
/// scene's lowest corner.
pub fn axes(content: &Content) -> Vec<Segment> {
    let bounds = &content.bounds;
    let size = diagonal(bounds);
    if size <= 0.0 {
        return Vec::new();
    }
    let is_near = bounds.center().length() <= 2.0 * size;
    let origin = if is_near { DVec3::ZERO } else { bounds.min };
    let axes = [
        (DVec3::X, [230, 60, 50, 255]),
        (DVec3::Y, [70, 180, 60, 255]),
        (DVec3::Z, [60, 110, 240, 255]),
    ];
    axes.map(|(axis, rgba)| segment(content, origin, origin + axis * (0.25 * size), rgba))
        .to_vec()
}

/// Lines between points that were measured, and a cross at each, whose arms have this length.
pub fn marks(content: &Content, points: &[DVec3], arm: f64) -> Vec<Segment> {
    let mut segments: Vec<Segment> = points
        .windows(2)
        .map(|pair| segment(content, pair[0], pair[1], MARK))
        .collect();
    for &p in points {
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            segments.push(segment(content, p - axis * arm, p + axis * arm, MARK));
        }
    }
    segments
}
