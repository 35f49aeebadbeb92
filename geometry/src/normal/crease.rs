//! Vertex normals by crease angle. Which corners belong together (a shared coordinate index,
//! a shared position) is the caller's to say.

use crate::num::gamma;
use glam::DVec3;
use std::f64::consts::PI;

/// The most distinct face normals around one vertex that are compared pair by pair. Above
/// it, the corners of that vertex keep their face normals (flat shading there).
///
/// It bounds the cost: a group of `k` corners takes at most `k * MAX_DISTINCT_NORMALS` dot
/// products. The tip of a cone has as many normals as the cone has sides.
pub const MAX_DISTINCT_NORMALS: usize = 512;

/// [`CreaseNormals::compute`] without reuse of scratch memory.
#[must_use]
pub fn crease_normals(
    face_normals: &[DVec3],
    corner_face: &[u32],
    corner_group: &[u32],
    group_count: usize,
    crease_angle_rad: f64,
) -> Vec<[f32; 3]> {
    let faces = Corners {
        face_normals,
        corner_face,
        corner_group,
        group_count,
    };
    let mut normals = Vec::new();
    CreaseNormals::new().compute(&faces, crease_angle_rad, &mut normals);
    normals
}

/// Face corners, and the vertices they meet in.
#[derive(Clone, Copy, Debug)]
pub struct Corners<'a> {
    /// The unit normal of each face; zero for a degenerate face.
    pub face_normals: &'a [DVec3],
    /// The face of each corner.
    pub corner_face: &'a [u32],
    /// The group of each corner: corners of one group share a vertex.
    pub corner_group: &'a [u32],
    /// The number of groups; all of `corner_group` should be below it.
    pub group_count: usize,
}

impl Corners<'_> {
    /// The number of corners, at most `u32::MAX`.
    fn len(&self) -> usize {
        let len = self.corner_face.len().min(self.corner_group.len());
        len.min(u32::MAX as usize)
    }

    fn normal_of_face(&self, face: u32) -> DVec3 {
        self.face_normals
            .get(face as usize)
            .copied()
            .unwrap_or(DVec3::ZERO)
    }
}

/// Computes vertex normals by crease angle. Holds only scratch memory: one instance may
/// serve many meshes.
#[derive(Default)]
pub struct CreaseNormals {
    /// `corners[starts[i]..starts[i + 1]]` are the corners of one group.
    starts: Vec<u32>,
    corners: Vec<u32>,
    group: Group,
}

impl CreaseNormals {
    /// An instance without memory yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Overwrites `out` with one unit normal per corner.
    ///
    /// The normal of a corner is its own face normal plus those of all other faces of the
    /// corner's group at an angle below `crease_angle_rad` to its own, each counted once and
    /// unweighted, normalised (Coin's rule, `SoNormalCache`). The angle is compared as
    /// `dot > cos(crease_angle_rad)`, so 0 gives flat shading, and pi or more joins all. Degenerate
    /// faces add nothing. A sum of zero gives the own face normal, else (0, 0, 1). Above
    /// [`MAX_DISTINCT_NORMALS`] a group is shaded flat.
    ///
    /// A NaN angle counts as 0. A face index out of range is a degenerate face, a group out
    /// of range is a group of its own; of index slices of different lengths the longer is
    /// cut.
    pub fn compute(&mut self, faces: &Corners, crease_angle_rad: f64, out: &mut Vec<[f32; 3]>) {
        out.clear();
        out.reserve(faces.len());
        // The corners of a face stand together.
        for corners in faces.corner_face[..faces.len()].chunk_by(|a, b| a == b) {
            let normal = stored(faces.normal_of_face(corners[0]));
            out.extend(corners.iter().map(|_| normal));
        }
        if crease_angle_rad.is_nan() || crease_angle_rad <= 0.0 {
            return;
        }
        let min_dot = if crease_angle_rad >= PI {
            f64::NEG_INFINITY
        } else {
            crease_angle_rad.cos()
        };
        self.sort_corners_by_group(faces);
        for range in self.starts.windows(2) {
            let corners = &self.corners[range[0] as usize..range[1] as usize];
            if corners.len() > 1 {
                self.group.smooth(faces, corners, min_dot, out);
            }
        }
    }

    /// Fills in `starts` and `corners`; the corners of a group stay in order.
    fn sort_corners_by_group(&mut self, faces: &Corners) {
        /// Groups per corner up to which it pays to have a counter for each group. Beyond it,
        /// a part that uses little of a large coordinate list would pay for all of it.
        const DENSE_GROUPS: usize = 4;
        let groups = &faces.corner_group[..faces.len()];
        self.starts.clear();
        self.corners.clear();
        if faces.group_count <= groups.len().saturating_mul(DENSE_GROUPS) {
            self.count_groups(groups, faces.group_count);
        } else {
            self.sort_groups(groups, faces.group_count);
        }
    }

    /// A counting sort, for group numbers that are mostly used.
    fn count_groups(&mut self, groups: &[u32], group_count: usize) {
        let in_range = |g: u32| (g as usize) < group_count;
        self.starts.resize(group_count + 1, 0);
        for &g in groups.iter().filter(|&&g| in_range(g)) {
            self.starts[g as usize] += 1;
        }
        let mut end = 0;
        for start in &mut self.starts {
            end += *start;
            *start = end;
        }
        self.corners.resize(end as usize, 0);
        // Backwards, each count moves from its group's end to its start.
        for (corner, &g) in groups
            .iter()
            .enumerate()
            .rev()
            .filter(|&(_, &g)| in_range(g))
        {
            self.starts[g as usize] -= 1;
            self.corners[self.starts[g as usize] as usize] = corner as u32;
        }
    }

    /// A comparison sort, for sparse group numbers; groups without corners are left out.
    fn sort_groups(&mut self, groups: &[u32], group_count: usize) {
        let group = |corner: u32| groups[corner as usize];
        let all = 0..groups.len() as u32;
        self.corners
            .extend(all.filter(|&corner| (group(corner) as usize) < group_count));
        self.corners
            .sort_unstable_by_key(|&corner| (group(corner), corner));
        self.starts.push(0);
        let mut end = 0;
        for members in self.corners.chunk_by(|&a, &b| group(a) == group(b)) {
            end += members.len() as u32;
            self.starts.push(end);
        }
    }
}

/// Distinct normals up to which their neighbourhoods fit a word each.
const MAX_MASKED: usize = u64::BITS as usize;

/// The faces around one vertex.
#[derive(Default)]
struct Group {
    faces: Vec<u32>,
    /// For each face its place in `normals`; `NONE` for a degenerate one.
    slots: Vec<u32>,
    /// Distinct normals, and how many faces have each.
    normals: Vec<(DVec3, f64)>,
    /// For each normal a bit for each one within the crease angle, its own included.
    masks: Vec<u64>,
    /// The sums made so far, by mask.
    sums: Vec<(u64, Option<[f32; 3]>)>,
}

/// No place in a list.
const NONE: u32 = u32::MAX;

impl Group {
    fn smooth(&mut self, faces: &Corners, corners: &[u32], min_dot: f64, out: &mut [[f32; 3]]) {
        self.collect(faces, corners);
        if let [(_, times)] = self.normals[..]
            && times as usize == self.faces.len()
        {
            // All face normals agree: the sum of equal vectors points the same way.
            return;
        }
        if min_dot == f64::NEG_INFINITY {
            let mut sum = NormalSum::default();
            for &(n, times) in &self.normals {
                sum.add(n, times);
            }
            for &corner in corners {
                let own = faces.normal_of_face(faces.corner_face[corner as usize]);
                out[corner as usize] = sum.stored(own);
            }
            return;
        }
        if self.normals.len() > MAX_DISTINCT_NORMALS {
            return;
        }
        if self.normals.len() <= MAX_MASKED {
            return self.smooth_by_masks(faces, corners, min_dot, out);
        }
        for &corner in corners {
            let own = faces.normal_of_face(faces.corner_face[corner as usize]);
            out[corner as usize] = self.sum_within(own, min_dot).stored(own);
        }
    }

    /// As [`Self::smooth`], comparing each pair of normals once. Corners with no neighbour within
    /// the angle are left alone: they have their face's normal already.
    fn smooth_by_masks(
        &mut self,
        faces: &Corners,
        corners: &[u32],
        min_dot: f64,
        out: &mut [[f32; 3]],
    ) {
        self.masks.clear();
        self.masks
            .extend((0..self.normals.len()).map(|i| 1_u64 << i));
        for i in 1..self.normals.len() {
            for j in 0..i {
                let (a, b) = (self.normals[i].0, self.normals[j].0);
                if a.dot(b) > min_dot || a == b {
                    self.masks[i] |= 1 << j;
                    self.masks[j] |= 1 << i;
                }
            }
        }
        self.sums.clear();
        for (i, &corner) in corners.iter().enumerate() {
            let face = faces.corner_face[corner as usize];
            // The corners are in the order of the faces unless those had to be sorted.
            let at = match self.faces.get(i) {
                Some(&same) if same == face => Ok(i),
                _ => self.faces.binary_search(&face),
            };
            let slot = at.map_or(NONE, |at| self.slots[at]);
            let Some(&(own, times)) = self.normals.get(slot as usize) else {
                // A degenerate face takes part in nothing but has corners to fill.
                let sum = self.sum_within(DVec3::ZERO, min_dot);
                out[corner as usize] = sum.stored(DVec3::ZERO);
                continue;
            };
            let mask = self.masks[slot as usize];
            if mask == 1 << slot && times == 1.0 {
                continue;
            }
            out[corner as usize] = self.sum_of(mask).unwrap_or_else(|| stored(own));
        }
    }

    /// The normalised sum of the normals in `mask`, computed once; `None` if it has no direction.
    fn sum_of(&mut self, mask: u64) -> Option<[f32; 3]> {
        if let Some((_, known)) = self.sums.iter().find(|(of, _)| *of == mask) {
            return *known;
        }
        let mut sum = NormalSum::default();
        let mut rest = mask;
        while rest != 0 {
            let (n, times) = self.normals[rest.trailing_zeros() as usize];
            sum.add(n, times);
            rest &= rest - 1;
        }
        let result = sum.has_direction().then(|| stored(sum.sum));
        self.sums.push((mask, result));
        result
    }

    /// Fills in the distinct normals of the group's faces, each face counted once.
    fn collect(&mut self, faces: &Corners, corners: &[u32]) {
        self.faces.clear();
        self.faces.extend(
            corners
                .iter()
                .map(|&corner| faces.corner_face[corner as usize]),
        );
        // Usually in order already. Summing in face order gives corners with the same
        // neighbours the same bits, so that they weld.
        if !self.faces.is_sorted_by(|a, b| a < b) {
            self.faces.sort_unstable();
            self.faces.dedup();
        }
        self.normals.clear();
        self.slots.clear();
        for &face in &self.faces {
            let n = faces.normal_of_face(face);
            match self.normals.last_mut() {
                _ if n == DVec3::ZERO => {
                    self.slots.push(NONE);
                    continue;
                }
                Some((last, times)) if *last == n => *times += 1.0,
                _ => self.normals.push((n, 1.0)),
            }
            self.slots.push(self.normals.len() as u32 - 1);
        }
        if self.normals.len() > MAX_DISTINCT_NORMALS {
            self.merge_equal_normals();
        }
    }

    fn merge_equal_normals(&mut self) {
        let bits = |n: DVec3| n.to_array().map(f64::to_bits);
        self.normals.sort_unstable_by_key(|&(n, _)| bits(n));
        self.normals.dedup_by(|(n, times), (kept, kept_times)| {
            let equal = bits(*n) == bits(*kept);
            if equal {
                *kept_times += *times;
            }
            equal
        });
    }

    /// The sum of the normals within the crease angle of `own`, `own` included.
    fn sum_within(&self, own: DVec3, min_dot: f64) -> NormalSum {
        let mut sum = NormalSum::default();
        for &(n, times) in &self.normals {
            // Its own normal counts at any angle: rounding may leave its square below 1.
            if n == own || n.dot(own) > min_dot {
                sum.add(n, times);
            }
        }
        sum
    }
}

/// A sum of unit vectors.
#[derive(Default)]
struct NormalSum {
    sum: DVec3,
    count: f64,
    additions: u32,
}

impl NormalSum {
    fn add(&mut self, n: DVec3, times: f64) {
        self.sum += n * times;
        self.count += times;
        self.additions += 1;
    }

    /// The normalised sum, or if it has no direction the own face normal, or (0, 0, 1).
    ///
    /// Opposite normals cancel only up to rounding: each normal carries up to five roundings
    /// of its own and one of its product, each addition one more.
    fn stored(&self, own: DVec3) -> [f32; 3] {
        stored(if self.has_direction() { self.sum } else { own })
    }

    fn has_direction(&self) -> bool {
        let rounding = gamma(self.additions.saturating_add(6)) * self.count;
        self.sum.abs().max_element() > rounding
    }
}

fn stored(n: DVec3) -> [f32; 3] {
    n.normalize_or(DVec3::Z).as_vec3().to_array()
}
