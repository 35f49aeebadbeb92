//! Placed glyphs to a mesh: fronts, sides along the profile, backs.
//!
//! Part numbers are Inventor's: front 0, sides 1, back 2. Texture coordinates are those of the
//! Inventor Reference (SoText3): the height of the font is one, S and T run from the text's origin
//! on the front, S to the left on the back; on the sides S runs from the rear edge forward.

use std::sync::Arc;

use geometry::outline::Area;
use glam::{DVec2, DVec3};

use crate::resolve::Binding;
use crate::scene::{Mesh, Topology};

use super::super::assemble::drop_collapsed;
use super::super::attributes::{Attributes, TexCoordSource};
use super::super::texcoords::{function, transformed};
use super::Solid;
use super::glyphs::Glyph;
use super::layout::Placed;
use super::profile::ProfilePoint;

/// Border directions this close are one: fonts store points in whole units, so smooth curves meet
/// at an angle of about a unit over the length of a control handle.
const SMOOTH_COSINE: f64 = 0.995;

/// The mesh of placed glyphs; `None` if they draw nothing.
pub(super) fn mesh(
    placed: &[Placed],
    solid: &Solid,
    size: f64,
    attributes: &Attributes<'_>,
    mut glyph: impl FnMut(u16) -> Arc<Glyph>,
) -> Option<Mesh> {
    let mut maker = Maker {
        attributes,
        solid,
        size,
        smooth_cosine: SMOOTH_COSINE.min(crease_cosine(solid.profile.crease_angle_rad)),
        mesh: Mesh {
            topology: Topology::Triangles,
            origin: DVec3::ZERO,
            positions: Vec::new(),
            normals: Vec::new(),
            texcoords: Vec::new(),
            colors_srgb: Vec::new(),
            indices: Vec::new(),
            pos: attributes.pos,
        },
    };
    for place in placed {
        let glyph = glyph(place.glyph);
        let letter = Letter {
            area: &glyph.area,
            miters: &glyph.miters,
            place,
        };
        maker.letter(&letter);
    }
    let mut mesh = maker.mesh;
    drop_collapsed(&mut mesh);
    (!mesh.indices.is_empty()).then_some(mesh)
}

/// The cosine of the largest turn that is smooth.
fn crease_cosine(angle_rad: f64) -> f64 {
    angle_rad.clamp(0.0, std::f64::consts::PI).cos()
}

/// A glyph in its place.
struct Letter<'a> {
    area: &'a Area,
    miters: &'a [DVec2],
    place: &'a Placed,
}

impl Letter<'_> {
    /// Where corner `i` is at a point of the profile.
    fn point(&self, i: usize, profile: DVec2) -> DVec3 {
        let flat = self.place.at + self.area.corners[i].p * self.place.scale;
        (flat + self.miters[i] * profile.y).extend(-profile.x)
    }
}

struct Maker<'a> {
    attributes: &'a Attributes<'a>,
    solid: &'a Solid,
    size: f64,
    smooth_cosine: f64,
    mesh: Mesh,
}

/// Parts by number.
const FRONT: usize = 0;
const SIDES: usize = 1;
const BACK: usize = 2;

impl Maker<'_> {
    fn letter(&mut self, letter: &Letter<'_>) {
        let points = &self.solid.profile.points;
        let (Some(&first), Some(&last)) = (points.first(), points.last()) else {
            return;
        };
        if self.solid.front {
            self.face(letter, first.p, FRONT);
        }
        if self.solid.sides {
            self.sides(letter);
        }
        if self.solid.back {
            self.face(letter, last.p, BACK);
        }
    }

    fn vertex(&mut self, p: DVec3, n: DVec3, st: DVec2, part: usize) -> u32 {
        let limit = DVec3::splat(f64::from(f32::MAX));
        // Adding zero turns -0 into +0, so that equal positions have equal bits.
        let stored = p.clamp(-limit, limit).as_vec3() + glam::Vec3::ZERO;
        self.mesh.positions.push(stored.to_array());
        self.mesh.normals.push(n.as_vec3().to_array());
        if let Some(source) = self.attributes.texcoords {
            let st = match source {
                TexCoordSource::Function(node) => function(node, p),
                _ => st,
            };
            let st = transformed(&self.attributes.texture_transform, st);
            self.mesh.texcoords.push(st);
        }
        if !self.attributes.colors.is_uniform() {
            let index = match self.attributes.color_binding {
                Binding::PerPart | Binding::PerPartIndexed => part,
                _ => 0,
            };
            let color = self.attributes.colors.rgba_srgb(index);
            self.mesh.colors_srgb.push(color);
        }
        self.mesh.positions.len() as u32 - 1
    }

    fn face(&mut self, letter: &Letter<'_>, at: DVec2, part: usize) {
        let first = self.mesh.positions.len() as u32;
        let (normal, toward) = match part {
            FRONT => (DVec3::Z, 1.0),
            _ => (DVec3::NEG_Z, -1.0),
        };
        for i in 0..letter.area.corners.len() {
            let p = letter.point(i, at);
            let st = DVec2::new(p.x * toward, p.y) / self.size;
            self.vertex(p, normal, st, part);
        }
        for &[a, b, c] in &letter.area.triangles {
            let turned = if part == FRONT { [a, b, c] } else { [a, c, b] };
            self.mesh.indices.extend(turned.map(|i| first + i));
        }
    }

    fn sides(&mut self, letter: &Letter<'_>) {
        let solid = self.solid;
        let points = &solid.profile.points;
        let length = |pair: &[ProfilePoint]| pair[0].p.distance(pair[1].p);
        let mut behind: f64 = points.windows(2).map(length).sum();
        for (k, pair) in points.windows(2).enumerate() {
            let length = length(pair);
            let band = Band {
                rows: [pair[0].p, pair[1].p],
                directions: self.band_directions(points, k),
                s: [behind, behind - length],
            };
            for range in letter.area.loop_ranges() {
                self.band(letter, range, &band);
            }
            behind -= length;
        }
    }

    /// The directions of the profile at both ends of piece `k`, shared with the next piece where it
    /// is smooth.
    fn band_directions(&self, points: &[ProfilePoint], k: usize) -> [DVec2; 2] {
        let direction = |k: usize| (points[k + 1].p - points[k].p).normalize_or(DVec2::X);
        let own = direction(k);
        let crease = crease_cosine(self.solid.profile.crease_angle_rad);
        let shared = |other: Option<DVec2>, joint: &ProfilePoint| match other {
            Some(other) if joint.smooth || own.dot(other) > crease => {
                (own + other).normalize_or(own)
            }
            _ => own,
        };
        let before = k.checked_sub(1).map(direction);
        let after = (k + 2 < points.len()).then(|| direction(k + 1));
        [shared(before, &points[k]), shared(after, &points[k + 1])]
    }

    fn band(&mut self, letter: &Letter<'_>, range: std::ops::Range<usize>, band: &Band) {
        let count = range.len();
        // For each corner its column of vertices as the border comes, and as it leaves.
        let mut columns = Vec::with_capacity(count + 1);
        let mut t = 0.0;
        for step in 0..=count {
            let i = range.start + step % count;
            if step > 0 {
                let before = letter.point(range.start + step - 1, DVec2::ZERO);
                t += before.distance(letter.point(i, DVec2::ZERO));
            }
            let [comes, leaves] = letter.area.corners[i].tangents;
            let [comes, leaves] = if comes.dot(leaves) > self.smooth_cosine {
                [(comes + leaves).normalize_or(comes); 2]
            } else {
                [comes, leaves]
            };
            let column_in = self.column(letter, i, comes, t, band);
            let column_out = if comes == leaves {
                column_in
            } else {
                self.column(letter, i, leaves, t, band)
            };
            columns.push((column_in, column_out));
        }
        for pair in columns.windows(2) {
            let (_, [a, d]) = pair[0];
            let ([b, c], _) = pair[1];
            self.mesh.indices.extend([a, d, c, a, c, b]);
        }
    }

    /// The vertices at both ends of a band, above one corner.
    fn column(
        &mut self,
        letter: &Letter<'_>,
        i: usize,
        tangent: DVec2,
        t: f64,
        band: &Band,
    ) -> [u32; 2] {
        // The area lies to the left.
        let outward = DVec2::new(tangent.y, -tangent.x);
        [0, 1].map(|end| {
            let along = band.directions[end];
            let normal = (outward * along.x).extend(along.y).normalize_or(DVec3::Z);
            let st = DVec2::new(band.s[end], t) / self.size;
            let p = letter.point(i, band.rows[end]);
            self.vertex(p, normal, st, SIDES)
        })
    }
}

/// What runs around a letter along one piece of the profile.
struct Band {
    rows: [DVec2; 2],
    /// Unit directions of the profile at both ends.
    directions: [DVec2; 2],
    /// Distance from the rear edge.
    s: [f64; 2],
}
