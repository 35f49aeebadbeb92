//! Where in the range of 16 bits the positions of a mesh lie, chosen for compression.
//!
//! The codec stores each byte of a coordinate by itself, as differences from vertex to vertex, 16
//! vertices at a time; a group without a difference takes no bytes. Moved along its grid a mesh is the
//! same, with its nodes moved back; its lower bytes change by the same differences, but other vertices
//! step over a multiple of 256, where the upper bytes change.

use scenegraph::scene::Mesh;

use super::grid::SCALE_BYTES;

/// Vertices whose differences are stored together.
const GROUP: usize = 16;
/// What a group takes whose upper bytes change: two bits a vertex.
const GROUP_BYTES: u64 = GROUP as u64 / 4;
/// Values of a byte.
const BYTE: usize = 256;

/// Moves a mesh along its grid where its upper bytes change least, if that pays for the longer
/// numbers in the nodes of its instances.
pub(super) fn settle(mesh: &mut Mesh, step: f32, instances: u64) {
    let mut saved_bytes = 0;
    let mut shift = [0.0_f32; 3];
    for (axis, shift) in shift.iter_mut().enumerate() {
        let steps = |p: &[f32; 3]| (p[axis] / step).round() as u32;
        let last = mesh.positions.iter().map(steps).max().unwrap_or(0);
        let counts = changes(mesh.positions.iter().map(steps));
        let room = (u32::from(u16::MAX).saturating_sub(last) as usize).min(BYTE - 1);
        let best = (0..=room).min_by_key(|&by| counts[by]).unwrap_or(0);
        saved_bytes += GROUP_BYTES * u64::from(counts[0] - counts[best]);
        *shift = best as f32 * step;
    }
    if saved_bytes <= SCALE_BYTES * instances {
        return;
    }
    for position in &mut mesh.positions {
        for (value, shift) in position.iter_mut().zip(shift) {
            // Exact: both are multiples of the step, whose multiples are exact in this range.
            *value += shift;
        }
    }
    for (axis, shift) in shift.into_iter().enumerate() {
        mesh.origin[axis] -= f64::from(shift);
    }
}

/// In how many groups upper bytes change, by how far the values are moved.
fn changes(values: impl Iterator<Item = u32>) -> [u32; BYTE] {
    let mut counts = [0; BYTE];
    let mut group = [0_i32; BYTE + 1];
    let mut before = None;
    let mut in_group = 0;
    for value in values {
        let from = before.replace(value).unwrap_or(value);
        let (low, high) = (from.min(value) as usize, from.max(value) as usize);
        // Moved by this much the lower one is just below the step, the higher one on it.
        let length = (high - low).min(BYTE);
        let first = (2 * BYTE - length - low % BYTE) % BYTE;
        let end = first + length;
        group[first] += 1;
        group[end.min(BYTE)] -= 1;
        if end > BYTE {
            group[0] += 1;
            group[end - BYTE] -= 1;
        }
        in_group += 1;
        if in_group == GROUP {
            count(&mut counts, &mut group);
            in_group = 0;
        }
    }
    count(&mut counts, &mut group);
    counts
}

/// Adds a group, and begins another.
fn count(counts: &mut [u32; BYTE], group: &mut [i32; BYTE + 1]) {
    let mut open = 0;
    for (count, begun) in counts.iter_mut().zip(group.iter()) {
        open += begun;
        *count += u32::from(open > 0);
    }
    group.fill(0);
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use iv_parser::SourcePos;
    use scenegraph::scene::Topology;

    use super::*;

    fn mesh(positions: Vec<[f32; 3]>) -> Mesh {
        Mesh {
            topology: Topology::Points,
            origin: DVec3::ZERO,
            indices: (0..positions.len() as u32).collect(),
            positions,
            normals: Vec::new(),
            texcoords: Vec::new(),
            colors_srgb: Vec::new(),
            pos: SourcePos::default(),
        }
    }

    #[test]
    fn counts_are_those_of_each_shift_tried() {
        let mut state = 7_u64;
        let mut next = |range: u64| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 33) % range
        };
        for range in [1, 5, 40, 300, 3000] {
            let mut value = 5000_i64;
            let values: Vec<u32> = (0..1000)
                .map(|_| {
                    value += next(2 * range + 1) as i64 - range as i64;
                    value.clamp(0, 60_000) as u32
                })
                .collect();
            let counts = changes(values.iter().copied());
            for (by, &count) in counts.iter().enumerate() {
                let upper: Vec<usize> = values.iter().map(|&v| (v as usize + by) / BYTE).collect();
                let changes = |i: &usize| *i > 0 && upper[*i] != upper[i - 1];
                let groups: Vec<usize> = (0..values.len()).collect();
                let groups = groups.chunks(GROUP);
                let wanted = groups.filter(|group| group.iter().any(changes));
                assert_eq!(count as usize, wanted.count(), "{range}: by {by}");
            }
        }
    }

    #[test]
    fn a_mesh_is_moved_with_its_origin_and_takes_less() {
        let step = 0.25;
        // Up and down around a multiple of 256.
        let heights = (0..4000).map(|i| 250 + (i * 7) % 13);
        let positions = heights.map(|k| [3.0, 0.0, k as f32 * step]).collect();
        let mut mesh = mesh(positions);
        let before = mesh.clone();
        settle(&mut mesh, step, 1_000_000);
        assert_eq!(mesh, before, "it does not pay");
        settle(&mut mesh, step, 1);
        assert_ne!(mesh, before);
        for (p, q) in mesh.positions.iter().zip(&before.positions) {
            let world = |mesh: &Mesh, p: &[f32; 3]| mesh.origin.z + f64::from(p[2]);
            assert_eq!(world(&mesh, p), world(&before, q));
        }
        let size = |mesh: &Mesh| {
            let steps = mesh.positions.iter().map(|p| p.map(|v| (v / step) as u16));
            let padded: Vec<[u16; 4]> = steps.map(|[x, y, z]| [x, y, z, 0]).collect();
            let encoded = meshopt::encode_vertex_buffer_level(&padded, 2, Some(0));
            encoded.unwrap().len()
        };
        assert!(size(&mesh) + 500 < size(&before), "{}", size(&mesh));
    }

    #[test]
    fn a_mesh_that_fills_the_range_stays_in_it() {
        let top = f32::from(u16::MAX);
        let positions = (0..4000).map(|i| [top - (i % 3) as f32, 256.0, (i % 2) as f32 * 256.0]);
        let mut mesh = mesh(positions.collect());
        settle(&mut mesh, 1.0, 1);
        let most = mesh
            .positions
            .iter()
            .flatten()
            .fold(0.0_f32, |a, &b| a.max(b));
        assert!(most <= top, "{most}");
    }
}
