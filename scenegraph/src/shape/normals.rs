//! Normals where the file gives none: Coin's crease-angle rule.

use geometry::normal::{Corners as Joined, CreaseNormals, face_normal};
use glam::DVec3;

use super::assemble::coordinate;
use super::attributes::Attributes;
use super::faces::Corners;

/// Makes normals; holds scratch memory only.
#[derive(Default)]
pub struct NormalMaker {
    creases: CreaseNormals,
    loop_points: Vec<DVec3>,
    face_normals: Vec<DVec3>,
    corner_face: Vec<u32>,
}

impl NormalMaker {
    /// Fills `normals` with one for each corner. Corners meet where their coordinate index is the same, or,
    /// with `groups`, where their positions are (`groups` gives the group of each numbered
    /// coordinate).
    pub fn make(
        &mut self,
        corners: &Corners,
        attributes: &Attributes<'_>,
        used: &[u32],
        groups: Option<(&[u32], usize)>,
        clockwise: bool,
        normals: &mut Vec<[f32; 3]>,
    ) {
        self.face_normals.clear();
        self.corner_face.clear();
        for range in corners.faces() {
            self.loop_points.clear();
            let numbers = &corners.coordinates[range.clone()];
            self.loop_points.extend(
                numbers
                    .iter()
                    .map(|&n| coordinate(attributes, used[n as usize])),
            );
            let normal = face_normal(&self.loop_points);
            let face = self.face_normals.len() as u32;
            self.face_normals
                .push(if clockwise { -normal } else { normal });
            self.corner_face.extend(range.map(|_| face));
        }
        let by_position: Vec<u32>;
        let (corner_group, group_count) = match groups {
            None => (&corners.coordinates[..], used.len()),
            Some((groups, count)) => {
                by_position = corners
                    .coordinates
                    .iter()
                    .map(|&n| groups[n as usize])
                    .collect();
                (&by_position[..], count)
            }
        };
        let joined = Joined {
            face_normals: &self.face_normals,
            corner_face: &self.corner_face,
            corner_group,
            group_count,
        };
        let crease_angle_rad = if corners.always_smooth {
            std::f64::consts::PI
        } else {
            attributes.crease_angle_rad
        };
        self.creases.compute(&joined, crease_angle_rad, normals);
    }
}
