//! A mesh as shadow volumes need it: welded, with edges that know all their triangles.
//! Not a half-edge structure; nothing is moved, and nothing is repaired.

use geometry::weld::{Welder, key_bits};
use glam::DVec3;

use crate::volume::component::{self, Component};

/// Triangles beyond this count are ignored: the numbers of edges and of triangles must fit
/// beside a flag in 32 bits, and a mesh has up to three edges a triangle.
const MAX_TRIANGLES: usize = (1 << 31) / 3;

/// A welded triangle mesh with its edges and components. The first four fields are plain
/// arrays of 16 or 4 byte rows, to be uploaded as they are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CasterMesh {
    /// The distinct positions `(x, y, z, 1)`, in order of first appearance; -0 and +0 are the
    /// same.
    pub positions: Vec<[f32; 4]>,
    /// `(a, b, c, component)`: three different positions in the order of the scene, and the
    /// index of the component.
    pub triangles: Vec<[u32; 4]>,
    /// `(a, b, first_ref, ref_count)` with `a < b`, sorted. The count is the edge's valence:
    /// it is at least 1 and has no upper limit.
    pub edges: Vec<[u32; 4]>,
    /// The triangles at the edges, `triangle << 1 | orientation`, ascending for each edge.
    /// Orientation 0: the triangle runs `a -> b`; 1: `b -> a`.
    pub refs: Vec<u32>,
    /// The sets of triangles that are connected over edges, in order of their first triangle.
    pub components: Vec<Component>,
}

impl CasterMesh {
    /// Welds the positions and finds edges and components.
    ///
    /// Left out, because they cannot cast: triangles with two equal corners, with a corner
    /// that is not finite, or with an index out of range; indices after the last whole
    /// triangle. Collinear triangles with three different corners are kept, because they
    /// close the gaps of T-junctions. Linear time but for edges of extreme valence.
    #[must_use]
    pub fn new(positions: &[[f32; 3]], indices: &[u32]) -> Self {
        let words: Vec<u32> = positions.iter().flatten().map(|&x| key_bits(x)).collect();
        let mut remap = Vec::new();
        let count = Welder::new().weld(&words, 3, &mut remap);
        let mut welded: Vec<[f32; 4]> = Vec::with_capacity(count);
        for (&[x, y, z], &distinct) in positions.iter().zip(&remap) {
            if distinct as usize == welded.len() {
                welded.push([x, y, z, 1.0]);
            }
        }
        let triangles = weld_triangles(indices, &remap, &welded);
        Self::from_welded(welded, triangles)
    }

    /// The mesh of some of the triangles, in the same order, with the positions that they use,
    /// also in the same order. A range beyond the end is cut.
    #[must_use]
    pub fn part(&self, triangles: std::ops::Range<usize>) -> Self {
        let end = triangles.end.min(self.triangles.len());
        let rows = self.triangles.get(triangles.start..end).unwrap_or_default();
        let mut used: Vec<u32> = rows.iter().flat_map(|&[a, b, c, _]| [a, b, c]).collect();
        used.sort_unstable();
        used.dedup();
        let renamed = |v: u32| used.partition_point(|&u| u < v) as u32;
        let rows = rows
            .iter()
            .map(|&[a, b, c, _]| [renamed(a), renamed(b), renamed(c), 0])
            .collect();
        let positions = used.iter().map(|&v| self.positions[v as usize]).collect();
        Self::from_welded(positions, rows)
    }

    fn from_welded(positions: Vec<[f32; 4]>, triangles: Vec<[u32; 4]>) -> Self {
        let (edges, refs) = find_edges(positions.len(), &triangles);
        let mut mesh = Self {
            positions,
            triangles,
            edges,
            refs,
            components: Vec::new(),
        };
        component::find(&mut mesh);
        mesh
    }

    /// The stored position, widened. `index` is one of [`CasterMesh::triangles`] or
    /// [`CasterMesh::edges`].
    #[inline]
    pub(crate) fn position(&self, index: u32) -> DVec3 {
        let [x, y, z, _] = self.positions[index as usize];
        DVec3::new(x.into(), y.into(), z.into())
    }

    /// The corners of a triangle of this mesh.
    #[inline]
    pub(crate) fn corners(&self, &[a, b, c, _]: &[u32; 4]) -> [DVec3; 3] {
        [self.position(a), self.position(b), self.position(c)]
    }

    /// The references of an edge of this mesh.
    #[inline]
    pub(crate) fn refs_of(&self, &[_, _, first, count]: &[u32; 4]) -> &[u32] {
        &self.refs[first as usize..][..count as usize]
    }
}

/// The triangles over welded positions, without those that cannot cast; components are 0.
fn weld_triangles(indices: &[u32], remap: &[u32], welded: &[[f32; 4]]) -> Vec<[u32; 4]> {
    let finite = |v: u32| welded[v as usize].iter().all(|x| x.is_finite());
    let corner = |v: u32| remap.get(v as usize).copied();
    let (rows, _) = indices.as_chunks::<3>();
    let mut triangles = Vec::with_capacity(rows.len());
    for &[a, b, c] in &rows[..rows.len().min(MAX_TRIANGLES)] {
        let (Some(a), Some(b), Some(c)) = (corner(a), corner(b), corner(c)) else {
            continue;
        };
        if a != b && b != c && c != a && finite(a) && finite(b) && finite(c) {
            triangles.push([a, b, c, 0]);
        }
    }
    triangles
}

/// Edges and references: a counting sort by the smaller end, then a sort of each bucket.
fn find_edges(position_count: usize, triangles: &[[u32; 4]]) -> (Vec<[u32; 4]>, Vec<u32>) {
    let sides = |&[a, b, c, _]: &[u32; 4]| [(a, b), (b, c), (c, a)];
    let mut starts = vec![0_u32; position_count + 1];
    for triangle in triangles {
        for (from, to) in sides(triangle) {
            starts[from.min(to) as usize + 1] += 1;
        }
    }
    for v in 0..position_count {
        starts[v + 1] += starts[v];
    }
    let mut cursors = starts.clone();
    // The larger end above, the reference below.
    let mut entries = vec![0_u64; triangles.len() * 3];
    for (number, triangle) in (0_u32..).zip(triangles) {
        for (from, to) in sides(triangle) {
            let cursor = &mut cursors[from.min(to) as usize];
            let reference = number << 1 | u32::from(from > to);
            entries[*cursor as usize] = u64::from(from.max(to)) << 32 | u64::from(reference);
            *cursor += 1;
        }
    }
    let mut edges: Vec<[u32; 4]> = Vec::with_capacity(triangles.len() * 3 / 2);
    for (a, bucket) in (0_u32..).zip(starts.windows(2)) {
        let (start, end) = (bucket[0] as usize, bucket[1] as usize);
        entries[start..end].sort_unstable();
        let mut first = bucket[0];
        for edge in entries[start..end].chunk_by(|x, y| x >> 32 == y >> 32) {
            edges.push([a, (edge[0] >> 32) as u32, first, edge.len() as u32]);
            first += edge.len() as u32;
        }
    }
    let refs = entries.into_iter().map(|entry| entry as u32).collect();
    (edges, refs)
}
