//! What each corner of a shape takes: normal, colour, texture coordinates, looked up by index.

use geometry::weld::key_bits;
use glam::DVec3;

use crate::scene::Mesh;

use super::attributes::Attributes;
use super::corners::Take;
use super::texcoords::TexCoordMaker;

/// The values that corners take, ready to be looked up.
pub struct Values<'a> {
    /// Source coordinate index of each numbered coordinate.
    pub used: &'a [u32],
    /// Number of each corner's coordinate.
    pub numbers: &'a [u32],
    pub normals: Normals<'a>,
    pub colors: Option<(&'a Take, &'a Attributes<'a>)>,
    pub texcoords: Option<(&'a Take, TexCoordMaker<'a>)>,
}

/// Where normals come from.
pub enum Normals<'a> {
    /// There are none.
    None,
    /// From the file.
    Given(&'a Take, &'a [f64]),
    /// One for each corner.
    Made(&'a [[f32; 3]]),
}

impl Values<'_> {
    fn index(&self, take: &Take, corner: usize) -> usize {
        match take {
            Take::Nothing | Take::First => 0,
            Take::Coordinate => self.used[self.numbers[corner] as usize] as usize,
            Take::Corners(list) => list[corner] as usize,
        }
    }

    fn normal(&self, corner: usize) -> Option<[f32; 3]> {
        match &self.normals {
            Normals::None => None,
            Normals::Given(take, list) => {
                let at = 3 * self.index(take, corner);
                Some(unit_normal(list.get(at..at + 3)))
            }
            Normals::Made(list) => Some(list[corner]),
        }
    }

    fn color(&self, corner: usize) -> Option<[f32; 4]> {
        let (take, attributes) = self.colors.as_ref()?;
        Some(attributes.colors.rgba_srgb(self.index(take, corner)))
    }

    fn texcoord(&self, corner: usize) -> Option<[f32; 2]> {
        let (take, maker) = self.texcoords.as_ref()?;
        let coordinate = self.used[self.numbers[corner] as usize] as usize;
        Some(maker.texcoord(self.index(take, corner), coordinate))
    }

    /// Appends the bits of all that a corner takes besides its position.
    pub fn push_key(&self, corner: usize, words: &mut Vec<u32>) {
        if let Some(normal) = self.normal(corner) {
            words.extend(normal.map(key_bits));
        }
        if let Some(texcoord) = self.texcoord(corner) {
            words.extend(texcoord.map(key_bits));
        }
        if let Some(color) = self.color(corner) {
            words.extend(color.map(key_bits));
        }
    }

    /// Fills all but positions and indices: vertex `i` has the values of corner `corner_of[i]`.
    pub fn fill(&self, mesh: &mut Mesh, corner_of: &[u32]) {
        match self.normals {
            Normals::None => {}
            Normals::Made(list) => {
                mesh.normals = corner_of.iter().map(|&c| list[c as usize]).collect();
            }
            Normals::Given(..) => {
                let normal = |&c: &u32| self.normal(c as usize).unwrap_or([0.0, 0.0, 1.0]);
                mesh.normals = corner_of.iter().map(normal).collect();
            }
        }
        if self.texcoords.is_some() {
            let texcoord = |&c: &u32| self.texcoord(c as usize).unwrap_or_default();
            mesh.texcoords = corner_of.iter().map(texcoord).collect();
        }
        if self.colors.is_some() {
            let color = |&c: &u32| self.color(c as usize).unwrap_or_default();
            mesh.colors_srgb = corner_of.iter().map(color).collect();
        }
    }

    /// The normals, if they are one for each corner and all that corners take.
    pub fn made_normals_only(&self) -> Option<&[[f32; 3]]> {
        match &self.normals {
            Normals::Made(list) if self.colors.is_none() && self.texcoords.is_none() => Some(list),
            _ => None,
        }
    }

    /// Whether every value follows from the coordinate.
    pub fn follow_coordinates(&self) -> bool {
        let follows = |take: &Take| !matches!(take, Take::Corners(_));
        let normals = match &self.normals {
            Normals::None => true,
            Normals::Given(take, _) => follows(take),
            Normals::Made(_) => false,
        };
        let colors = self.colors.as_ref().is_none_or(|(take, _)| follows(take));
        normals
            && colors
            && self
                .texcoords
                .as_ref()
                .is_none_or(|(take, _)| follows(take))
    }
}

/// A given normal at unit length; (0, 0, 1) for one without direction.
fn unit_normal(given: Option<&[f64]>) -> [f32; 3] {
    let Some(&[x, y, z]) = given else {
        return [0.0, 0.0, 1.0];
    };
    let length = (x * x + y * y + z * z).sqrt();
    if !(length > 1e-150 && length < 1e150) {
        // Squares of such numbers leave the range of f64.
        let v = DVec3::new(x, y, z);
        let v = v / v.abs().max_element();
        return v.normalize_or(DVec3::Z).as_vec3().to_array();
    }
    [x, y, z].map(|v| (v / length) as f32 + 0.0)
}
