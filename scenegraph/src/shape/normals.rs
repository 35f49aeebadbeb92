//! Normals where the file gives none: Coin's crease-angle rule.

use geometry::normal::{Corners as Joined, CreaseNormals, face_normal};
use glam::DVec3;

use super::corners::Corners;

/// Makes normals; holds scratch memory only.
#[derive(Default)]
pub struct NormalMaker {
    creases: CreaseNormals,
    loop_points: Vec<DVec3>,
    face_normals: Vec<DVec3>,
    corner_face: Vec<u32>,
}

impl NormalMaker {
    /// Fills `normals` with one for each corner. Corners meet where their numbered coordinate, one
    /// of `points`, is the same, or, with `groups`, where their positions are (`groups` gives the
    /// group of each numbered coordinate).
    pub fn make(
        &mut self,
        corners: &Corners,
        points: &[DVec3],
        groups: Option<(&[u32], usize)>,
        crease_angle_rad: f64,
        clockwise: bool,
        normals: &mut Vec<[f32; 3]>,
    ) {
        self.face_normals.clear();
        self.corner_face.clear();
        for range in corners.faces() {
            let at = |n: u32| points[n as usize];
            // Arrays of known length take no loops.
            let normal = match corners.coordinates[range.clone()] {
                [a, b, c] => face_normal(&[at(a), at(b), at(c)]),
                [a, b, c, d] => face_normal(&[at(a), at(b), at(c), at(d)]),
                ref numbers => {
                    self.loop_points.clear();
                    self.loop_points.extend(numbers.iter().map(|&n| at(n)));
                    face_normal(&self.loop_points)
                }
            };
            let face = self.face_normals.len() as u32;
            self.face_normals
                .push(if clockwise { -normal } else { normal });
            self.corner_face.resize(range.end, face);
        }
        let by_position: Vec<u32>;
        let (corner_group, group_count) = match groups {
            None => (&corners.coordinates[..], points.len()),
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
            crease_angle_rad
        };
        self.creases.compute(&joined, crease_angle_rad, normals);
    }
}
