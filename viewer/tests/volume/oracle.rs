//! Shadows of integer triangles in exact arithmetic: by blocked segments, and by walking
//! through the surface of a volume. Shares nothing with the code under test but the table of
//! drawn triangles in the documentation of `viewer::volume`.

use viewer::volume::{CasterMesh, Volume};

/// A homogeneous point with `w >= 0`.
pub type Point = [i128; 4];

/// Geometry lies on multiples of this, so that other points can be in general position.
pub const SCALE: i128 = 997;

/// A light, a mesh of integers, and whether the world is their mirror image.
#[derive(Clone, Debug)]
pub struct Case {
    pub positions: Vec<[i8; 3]>,
    pub indices: Vec<u32>,
    /// `w` is 0 or 1.
    pub light: [i8; 4],
    pub mirrored: bool,
}

impl Case {
    pub fn mesh(&self) -> CasterMesh {
        let positions: Vec<[f32; 3]> = self.positions.iter().map(|p| p.map(f32::from)).collect();
        CasterMesh::new(&positions, &self.indices)
    }

    pub fn light(&self) -> glam::DVec4 {
        glam::DVec4::from(self.light.map(f64::from))
    }

    /// The light in the oracle's world.
    pub fn world_light(&self) -> Point {
        let [x, y, z, w] = self.light.map(i128::from);
        let x = if self.mirrored { -x } else { x };
        [x * SCALE, y * SCALE, z * SCALE, w]
    }

    /// All corners of all triangles in the oracle's world.
    pub fn world_triangles(&self) -> Vec<[Point; 3]> {
        let corner = |&v: &u32| self.world_point(self.positions[v as usize].map(i128::from));
        let (rows, _) = self.indices.as_chunks::<3>();
        rows.iter()
            .map(|[a, b, c]| [corner(a), corner(b), corner(c)])
            .collect()
    }

    fn world_point(&self, [x, y, z]: [i128; 3]) -> Point {
        let x = if self.mirrored { -x } else { x };
        [x * SCALE, y * SCALE, z * SCALE, 1]
    }

    /// A position of the mesh in the oracle's world.
    pub fn mesh_point(&self, mesh: &CasterMesh, v: u32) -> Point {
        let [x, y, z, _] = mesh.positions[v as usize].map(|x| x as i128);
        self.world_point([x, y, z])
    }

    /// All triangles of the volume as documented, the flag being set for dark caps.
    pub fn volume_triangles(&self, mesh: &CasterMesh, volume: &Volume) -> Vec<([Point; 3], bool)> {
        let light = self.world_light();
        let push = |p: Point| {
            let x = |i: usize| p[i] * light[3] - light[i];
            [x(0), x(1), x(2), 0]
        };
        let mut drawn = Vec::new();
        for side in &volume.sides {
            let [a, b, ..] = mesh.edges[(side >> 1) as usize];
            let [a, b] = if side & 1 == 0 { [a, b] } else { [b, a] };
            let [a, b] = [self.mesh_point(mesh, a), self.mesh_point(mesh, b)];
            drawn.push(([b, a, push(a)], false));
            drawn.push(([b, push(a), push(b)], false));
        }
        for (caps, clockwise) in [(&volume.cap_pos, false), (&volume.cap_neg, true)] {
            for &triangle in caps {
                let [a, b, c, _] = mesh.triangles[triangle as usize];
                let [a, b, c] = [a, b, c].map(|v| self.mesh_point(mesh, v));
                let flip = |t: [Point; 3], flip: bool| if flip { [t[0], t[2], t[1]] } else { t };
                drawn.push((flip([a, b, c], clockwise), false));
                drawn.push((flip([push(a), push(b), push(c)], !clockwise), true));
            }
        }
        drawn
    }
}

/// The sign of a 4x4 determinant. For finite points it is negative if the first three run
/// counter-clockwise seen from the last.
pub fn orientation(rows: [Point; 4]) -> i128 {
    let minor = |skip: usize| {
        let columns: Vec<usize> = (0..4).filter(|&c| c != skip).collect();
        let at = |r: usize, c: usize| rows[r][columns[c]];
        (0..3)
            .map(|c| {
                let (d, e) = ((c + 1) % 3, (c + 2) % 3);
                at(1, c) * (at(2, d) * at(3, e) - at(2, e) * at(3, d))
            })
            .sum::<i128>()
    };
    (0..4)
        .map(|c| rows[0][c] * minor(c) * if c % 2 == 0 { 1 } else { -1 })
        .sum::<i128>()
        .signum()
}

/// How many triangles separate `p` from the light, or `None` if the segment meets an edge or
/// `p` a plane.
pub fn blockers(triangles: &[[Point; 3]], light: Point, p: Point) -> Option<usize> {
    let mut count = 0;
    for &[a, b, c] in triangles {
        let from_light = orientation([a, b, c, light]);
        if from_light == 0 {
            continue;
        }
        let from_p = orientation([a, b, c, p]);
        let around = [[a, b], [b, c], [c, a]].map(|[x, y]| orientation([p, light, x, y]));
        if from_p == 0 || around.contains(&0) {
            return None;
        }
        let inside = around[0] == around[1] && around[1] == around[2];
        count += usize::from(inside && from_p == -from_light);
    }
    Some(count)
}

/// The count of volumes that hold `p`: front faces less back faces met on the way from the
/// point at infinity in the direction `u` to `p`. `None` if the way meets an edge.
pub fn volume_count(drawn: &[([Point; 3], bool)], p: Point, u: Point) -> Option<i128> {
    let mut count = 0;
    for &([x, y, z], at_infinity) in drawn {
        let from_p = orientation([x, y, z, p]);
        let from_u = if at_infinity {
            -from_p
        } else {
            orientation([x, y, z, u])
        };
        let around = [[x, y], [y, z], [z, x]].map(|[x, y]| orientation([p, u, x, y]));
        let degenerate = is_degenerate([x, y, z]);
        if !degenerate && (from_p == 0 || from_u == 0 || around.contains(&0)) {
            return None;
        }
        // The signs of a hit forwards; a line also meets the plane at infinity backwards.
        let forwards = around == [-from_p; 3];
        if forwards && from_p == -from_u {
            count -= from_u;
        }
    }
    Some(count)
}

/// Whether all determinants with these rows are zero.
fn is_degenerate(rows: [Point; 3]) -> bool {
    let units: [Point; 4] = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]];
    let [x, y, z] = rows;
    units.iter().all(|&unit| orientation([x, y, z, unit]) == 0)
}
