//! Geometry that VRML 2 gives by rule, as indexed faces: `ElevationGrid` and `Extrusion`.
//!
//! What is made here goes the way of an `IndexedFaceSet`: bindings, normals, triangles and sharing
//! are not known to this file.

use std::ops::Range;

use glam::{DMat3, DQuat, DVec2, DVec3};

use crate::graph::Node;

/// Most corners that the rings of one `Extrusion` may have together: a short text can ask for any
/// number.
const MAX_RING_CORNERS: usize = 4_000_000;

/// Sine of the angle up to which two segments of a spine count as one line: coordinates written
/// with six digits are off by up to half a millionth of their size.
const COLLINEAR_SIN: f64 = 1e-6;

/// Indexed faces, counter-clockwise from outside or above.
#[derive(Clone, Debug, Default)]
pub struct MadeFaces {
    /// Coordinates, flat.
    pub coordinates: Vec<f64>,
    /// Polygons, each ended by -1.
    pub coord_index: Vec<i32>,
    /// Texture coordinates, flat.
    pub texcoords: Vec<f64>,
    /// As `coord_index`; empty when each coordinate has its texture coordinate.
    pub texcoord_index: Vec<i32>,
}

impl MadeFaces {
    fn point(&mut self, p: DVec3) -> i32 {
        self.coordinates.extend(p.to_array());
        (self.coordinates.len() / 3) as i32 - 1
    }

    fn texcoord(&mut self, st: DVec2) -> i32 {
        self.texcoords.extend(st.to_array());
        (self.texcoords.len() / 2) as i32 - 1
    }

    fn face(&mut self, corners: impl IntoIterator<Item = (i32, i32)>) {
        for (coordinate, texcoord) in corners {
            self.coord_index.push(coordinate);
            self.texcoord_index.push(texcoord);
        }
        self.coord_index.push(-1);
        self.texcoord_index.push(-1);
    }
}

/// Why nothing was made, or less than asked for.
pub type Complaint = &'static str;

/// The faces of an `ElevationGrid`: one a cell, in rows along x (ISO 14772-1, 6.17).
///
/// # Errors
///
/// Says what is missing.
pub fn elevation_grid(node: &Node) -> Result<MadeFaces, Complaint> {
    let count = |field: &str| usize::try_from(node.int(field)).unwrap_or(0);
    let (columns, rows) = (count("xDimension"), count("zDimension"));
    if columns < 2 || rows < 2 {
        return Err("an ElevationGrid has fewer than two heights along a side");
    }
    let heights = node.numbers("height");
    if heights.len() / columns < rows {
        return Err("an ElevationGrid has fewer heights than its dimensions need");
    }
    let (dx, dz) = (node.number("xSpacing"), node.number("zSpacing"));
    let mut made = MadeFaces::default();
    for (i, height) in heights[..columns * rows].iter().enumerate() {
        let (x, z) = ((i % columns) as f64, (i / columns) as f64);
        made.point(DVec3::new(x * dx, *height, z * dz));
        made.texcoord(DVec2::new(x / (columns - 1) as f64, z / (rows - 1) as f64));
    }
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let corner = (row * columns + column) as i32;
            let below = corner + columns as i32;
            made.coord_index
                .extend([corner, below, below + 1, corner + 1, -1]);
        }
    }
    Ok(made)
}

/// The faces of an `Extrusion`: a quadrilateral for each segment of the cross-section and of the
/// spine, then the caps (ISO 14772-1, 6.18). Caps share no coordinates with the sides, so that the
/// edge between them stays sharp.
///
/// # Errors
///
/// Says what is missing.
pub fn extrusion(node: &Node) -> Result<MadeFaces, Complaint> {
    let section: Vec<DVec2> = pairs(node.numbers("crossSection"));
    let spine: Vec<DVec3> = node
        .numbers("spine")
        .as_chunks::<3>()
        .0
        .iter()
        .map(|&p| DVec3::from(p))
        .collect();
    if section.len() < 2 || spine.len() < 2 {
        return Err("an Extrusion has fewer than two points in its spine or cross-section");
    }
    if section.len().saturating_mul(spine.len()) > MAX_RING_CORNERS {
        return Err("an Extrusion has more corners than can be made");
    }
    let planes = section_planes(&spine);
    let scales: Vec<DVec2> = pairs(node.numbers("scale"));
    let turns = node.numbers("orientation").as_chunks::<4>().0;
    let rings: Vec<Vec<DVec3>> = (0..spine.len())
        .map(|i| {
            let scale = at_or_last(&scales, i).unwrap_or(DVec2::ONE);
            let turn = at_or_last(turns, i).map_or(DQuat::IDENTITY, turn);
            let place = |p: &DVec2| {
                let p = *p * scale;
                spine[i] + planes[i] * (turn * DVec3::new(p.x, 0.0, p.y))
            };
            section.iter().map(place).collect()
        })
        .collect();
    let mut made = MadeFaces::default();
    sides(&rings, &mut made);
    if node.flag("beginCap") {
        cap(&rings[0], &section, true, &mut made);
    }
    if node.flag("endCap") {
        cap(&rings[rings.len() - 1], &section, false, &mut made);
    }
    Ok(made)
}

fn pairs(numbers: &[f64]) -> Vec<DVec2> {
    let (pairs, _) = numbers.as_chunks::<2>();
    pairs.iter().map(|&p| DVec2::from(p)).collect()
}

/// One value serves all; a list that is too short goes on with its last.
fn at_or_last<T: Copy>(list: &[T], index: usize) -> Option<T> {
    list.get(index).or(list.last()).copied()
}

fn turn([x, y, z, angle_rad]: [f64; 4]) -> DQuat {
    let axis = DVec3::new(x, y, z).try_normalize();
    axis.map_or(DQuat::IDENTITY, |axis| {
        DQuat::from_axis_angle(axis, angle_rad)
    })
}

/// Sides. Rings and corners that come back to where they began meet there, so that the seam is
/// smooth where the crease angle wants it.
fn sides(rings: &[Vec<DVec3>], made: &mut MadeFaces) {
    let corners = rings[0].len();
    let last_ring = rings.len() - 1;
    let is_ring = rings[0] == rings[last_ring];
    let is_tube = rings.iter().all(|ring| ring[0] == ring[corners - 1]);
    let mut first: Vec<Range<i32>> = Vec::new();
    for (i, ring) in rings.iter().enumerate() {
        let start = (made.coordinates.len() / 3) as i32;
        if is_ring && i == last_ring && i > 1 {
            first.push(first[0].clone());
        } else {
            ring.iter().for_each(|&p| {
                made.point(p);
            });
            first.push(start..start + corners as i32);
        }
        for j in 0..corners {
            made.texcoord(DVec2::new(
                j as f64 / (corners - 1) as f64,
                i as f64 / last_ring as f64,
            ));
        }
    }
    let coordinate = |i: usize, j: usize| {
        let j = if is_tube && j == corners - 1 && corners > 2 {
            0
        } else {
            j
        };
        first[i].start + j as i32
    };
    let texcoord = |i: usize, j: usize| (i * corners + j) as i32;
    for i in 0..last_ring {
        for j in 0..corners - 1 {
            let around = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)];
            made.face(around.map(|(i, j)| (coordinate(i, j), texcoord(i, j))));
        }
    }
}

/// A cap. Its texture is laid over the cross-section, whose longer side it fills.
fn cap(ring: &[DVec3], section: &[DVec2], is_begin: bool, made: &mut MadeFaces) {
    let closed = section[0] == section[section.len() - 1];
    let count = section.len() - usize::from(closed);
    if count < 3 {
        return;
    }
    let low = section.iter().copied().reduce(DVec2::min);
    let high = section.iter().copied().reduce(DVec2::max);
    let (low, high) = (low.unwrap_or_default(), high.unwrap_or_default());
    let length = (high - low).max_element();
    let st = |p: DVec2| {
        if length > 0.0 {
            (p - low) / length
        } else {
            DVec2::ZERO
        }
    };
    let mut corners: Vec<(i32, i32)> = (0..count)
        .map(|j| (made.point(ring[j]), made.texcoord(st(section[j]))))
        .collect();
    if is_begin {
        corners.reverse();
    }
    made.face(corners);
}

/// For each point of the spine the axes of the plane that holds the cross-section: x, y along the
/// spine, z.
fn section_planes(spine: &[DVec3]) -> Vec<DMat3> {
    let count = spine.len();
    let closed = spine[0] == spine[count - 1] && count > 2;
    let neighbours = |i: usize| match i {
        0 if closed => (spine[count - 2], spine[1]),
        0 => (spine[0], spine[1]),
        i if i == count - 1 && closed => (spine[count - 2], spine[1]),
        i if i == count - 1 => (spine[i - 1], spine[i]),
        i => (spine[i - 1], spine[i + 1]),
    };
    let bend = |i: usize| {
        let (before, after) = neighbours(i);
        let (ahead, back) = (after - spine[i], before - spine[i]);
        let normal = ahead.cross(back);
        let is_straight = normal.length() <= COLLINEAR_SIN * ahead.length() * back.length();
        (!is_straight).then(|| normal.try_normalize()).flatten()
    };
    let along: Vec<Option<DVec3>> = (0..count)
        .map(|i| {
            let (before, after) = neighbours(i);
            (after - before).try_normalize()
        })
        .collect();
    let bends: Vec<Option<DVec3>> = (0..count).map(bend).collect();
    let Some(first_bend) = bends.iter().copied().flatten().next() else {
        // A straight spine turns the plane as it turns the y axis.
        let direction = (spine[count - 1] - spine[0]).try_normalize();
        let direction = direction.or_else(|| along.iter().copied().flatten().next());
        let turn = DQuat::from_rotation_arc(DVec3::Y, direction.unwrap_or(DVec3::Y));
        return vec![DMat3::from_quat(turn); count];
    };
    let first_along = along.iter().copied().flatten().next().unwrap_or(DVec3::Y);
    let (mut z, mut y) = (first_bend, first_along);
    let mut planes = Vec::with_capacity(count);
    for i in 0..count {
        y = along[i].unwrap_or(y);
        // Where the spine is straight it goes on as before; where it bends the other way the
        // plane must not turn over.
        if let Some(own) = bends[i] {
            z = if own.dot(z) < 0.0 { -own } else { own };
        }
        let x = y.cross(z).try_normalize();
        let x = x.unwrap_or_else(|| y.any_orthonormal_vector());
        z = x.cross(y);
        planes.push(DMat3::from_cols(x, y, z));
    }
    planes
}
