//! Exact vertex welding: which vertices have the same bits. There is no tolerance here, and
//! nothing is moved; near but different vertices stay apart.

use glam::DVec3;

/// The key of a number for [`Welder::weld`]: its bits, with -0 taken for +0. NaNs are equal
/// when their bits are.
#[must_use]
pub fn key_bits(x: f32) -> u32 {
    if x == 0.0 { 0 } else { x.to_bits() }
}

/// [`key_bits`] of an `f64`.
#[must_use]
pub fn key_bits_f64(x: f64) -> u64 {
    if x == 0.0 { 0 } else { x.to_bits() }
}

/// A slot that holds no row.
const EMPTY: u32 = u32::MAX;

/// Slots looked at per row, on average, before hashing is given up for sorting. At the
/// table's load of at most 1/2, random hashes need 1.5.
const MEAN_PROBES: u64 = 16;

/// Finds equal vertices. Holds only scratch memory: one welder may serve many meshes, and
/// results do not depend on what it did before.
#[derive(Default)]
pub struct Welder {
    slots: Vec<u32>,
    order: Vec<u32>,
}

impl Welder {
    /// A welder without memory yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Welds rows of `stride` words each, as made by [`key_bits`].
    ///
    /// `remap` is overwritten with one entry per row: the number of its distinct row,
    /// counted in order of first appearance. So the source of distinct row `k` is the first
    /// `i` with `remap[i] == k`. Returns the count of distinct rows.
    ///
    /// Words after the last whole row are ignored, as are rows beyond `u32::MAX - 1`; a
    /// stride of 0 makes no rows. Takes linear time, or `n log n` for rows made to collide.
    pub fn weld(&mut self, words: &[u32], stride: usize, remap: &mut Vec<u32>) -> usize {
        let row = |i: u32| &words[i as usize * stride..][..stride];
        let count = words.len().checked_div(stride).unwrap_or(0);
        // The common widths as constants: comparing and hashing then need no loop.
        match stride {
            3 => self.weld_arrays::<3>(words, remap),
            6 => self.weld_arrays::<6>(words, remap),
            8 => self.weld_arrays::<8>(words, remap),
            _ => self.weld_rows(
                count,
                |i| hash(row(i).chunks(2).map(pair)),
                |i, j| row(i).cmp(row(j)),
                remap,
            ),
        }
    }

    /// Welds points by their `f64` bits, with -0 taken for +0; otherwise as [`Welder::weld`].
    pub fn weld_positions(&mut self, points: &[DVec3], remap: &mut Vec<u32>) -> usize {
        let key = |i: u32| points[i as usize].to_array().map(key_bits_f64);
        self.weld_rows(
            points.len(),
            |i| hash(key(i)),
            |i, j| key(i).cmp(&key(j)),
            remap,
        )
    }

    /// Welds rows that can be equal only within a group: rows `i` and `j` of one group are the
    /// same if `equal(i, j)`. `groups` has the group of each row, all below `group_count`.
    ///
    /// `remap` is as of [`Welder::weld`]; `firsts` gets the first row of each distinct one. Returns
    /// `false`, and nothing of use, if there are groups with so many distinct rows that hashing is
    /// better. Rows beyond `u32::MAX - 1` are ignored.
    pub fn weld_in_groups(
        &mut self,
        groups: impl ExactSizeIterator<Item = u32>,
        group_count: usize,
        equal: impl Fn(u32, u32) -> bool,
        remap: &mut Vec<u32>,
        firsts: &mut Vec<u32>,
    ) -> bool {
        let max_probes = MEAN_PROBES * (groups.len() as u64 + 64);
        // For each group its newest distinct row, for each of these the one before it.
        self.slots.clear();
        self.slots.resize(group_count, EMPTY);
        self.order.clear();
        remap.clear();
        remap.reserve(groups.len());
        firsts.clear();
        let mut probes = 0_u64;
        for (group, row) in groups.zip(0..EMPTY) {
            let newest = &mut self.slots[group as usize];
            let mut at = *newest;
            while at != EMPTY && !equal(firsts[at as usize], row) {
                at = self.order[at as usize];
                probes += 1;
            }
            if at == EMPTY {
                at = firsts.len() as u32;
                firsts.push(row);
                self.order.push(*newest);
                *newest = at;
            }
            remap.push(at);
            if probes > max_probes {
                return false;
            }
        }
        true
    }

    fn weld_arrays<const N: usize>(&mut self, words: &[u32], remap: &mut Vec<u32>) -> usize {
        let (rows, _) = words.as_chunks::<N>();
        self.weld_rows(
            rows.len(),
            |i| hash(rows[i as usize].chunks(2).map(pair)),
            |i, j| rows[i as usize].cmp(&rows[j as usize]),
            remap,
        )
    }

    fn weld_rows(
        &mut self,
        count: usize,
        hash: impl Fn(u32) -> u64,
        compare: impl Fn(u32, u32) -> std::cmp::Ordering,
        remap: &mut Vec<u32>,
    ) -> usize {
        let count = u32::try_from(count).unwrap_or(EMPTY).min(EMPTY - 1);
        let max_probes = MEAN_PROBES * (u64::from(count) + 64);
        self.weld_by_hash(count, max_probes, hash, |i, j| compare(i, j).is_eq(), remap)
            .unwrap_or_else(|| self.weld_by_sort(count, compare, remap))
    }

    /// Open addressing with linear probing. `None` if it took more than `max_probes`.
    fn weld_by_hash(
        &mut self,
        count: u32,
        max_probes: u64,
        hash: impl Fn(u32) -> u64,
        equal: impl Fn(u32, u32) -> bool,
        remap: &mut Vec<u32>,
    ) -> Option<usize> {
        let capacity = (count as usize * 2).next_power_of_two();
        let mask = capacity - 1;
        self.slots.clear();
        self.slots.resize(capacity, EMPTY);
        remap.clear();
        remap.reserve(count as usize);
        let mut distinct = 0_u32;
        let mut probes = 0_u64;
        for i in 0..count {
            let mut slot = hash(i) as usize & mask;
            loop {
                probes += 1;
                match self.slots[slot] {
                    EMPTY => {
                        self.slots[slot] = i;
                        remap.push(distinct);
                        distinct += 1;
                        break;
                    }
                    j if equal(i, j) => {
                        remap.push(remap[j as usize]);
                        break;
                    }
                    _ => slot = (slot + 1) & mask,
                }
            }
            if probes > max_probes {
                return None;
            }
        }
        Some(distinct as usize)
    }

    /// The same result by comparisons only.
    fn weld_by_sort(
        &mut self,
        count: u32,
        compare: impl Fn(u32, u32) -> std::cmp::Ordering,
        remap: &mut Vec<u32>,
    ) -> usize {
        self.order.clear();
        self.order.extend(0..count);
        self.order
            .sort_unstable_by(|&i, &j| compare(i, j).then(i.cmp(&j)));
        // First each row's earliest equal, then its number.
        remap.clear();
        remap.resize(count as usize, 0);
        for equals in self.order.chunk_by(|&i, &j| compare(i, j).is_eq()) {
            for &i in equals {
                remap[i as usize] = equals[0];
            }
        }
        let mut distinct = 0;
        for i in 0..count as usize {
            let earliest = remap[i] as usize;
            remap[i] = if earliest == i {
                distinct
            } else {
                remap[earliest]
            };
            distinct += u32::from(earliest == i);
        }
        distinct as usize
    }
}

/// One or two words as one.
fn pair(words: &[u32]) -> u64 {
    words
        .iter()
        .fold(0, |high, &word| high << 32 | u64::from(word))
}

/// Folds each value in by a 64x64 to 128 bit product, whose halves are joined so that every
/// input bit reaches the low bits that choose the slot (the mixing step of Wang Yi's wyhash).
fn hash(values: impl IntoIterator<Item = u64>) -> u64 {
    // The first digits of pi's fraction, odd.
    const SEED: u64 = 0x243f_6a88_85a3_08d3;
    const FACTOR: u64 = 0x1319_8a2e_0370_7345;
    let mix = |x: u64| {
        let product = u128::from(x) * u128::from(FACTOR);
        product as u64 ^ (product >> 64) as u64
    };
    let h = values
        .into_iter()
        .fold(SEED, |h, v| mix(h.rotate_left(23) ^ v));
    mix(h)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_rng::Rng;
    use std::collections::BTreeMap;

    /// Welding by an ordered map.
    fn expected<K: Ord>(keys: impl IntoIterator<Item = K>) -> (Vec<u32>, usize) {
        let mut seen = BTreeMap::new();
        let mut remap = Vec::new();
        for key in keys {
            let next = seen.len() as u32;
            remap.push(*seen.entry(key).or_insert(next));
        }
        (remap, seen.len())
    }

    #[test]
    fn negative_zero_is_zero() {
        assert_eq!(key_bits(-0.0), key_bits(0.0));
        assert_eq!(key_bits_f64(-0.0), key_bits_f64(0.0));
        for x in [1.0, -1.0, 1e-45, -1e-45, f32::NAN, f32::INFINITY] {
            assert_eq!(key_bits(x), x.to_bits());
            assert_eq!(key_bits_f64(x.into()), f64::from(x).to_bits());
        }
    }

    #[test]
    fn small_inputs() {
        let rows: [(&[u32], usize, &[u32]); 8] = [
            (&[], 3, &[]),
            (&[1, 2, 3], 0, &[]),
            (&[7], 3, &[]),
            (&[1, 2, 3, 1, 2, 3], 3, &[0, 0]),
            (&[1, 2, 3, 1, 2, 4, 9], 3, &[0, 1]),
            (&[5, 4, 5, 5, 4], 1, &[0, 1, 0, 0, 1]),
            (&[1, 2, 2, 1, 1, 2], 2, &[0, 1, 0]),
            (&[0, 0, 1, 0, 0, 0, 0, 0, 0, 1], 5, &[0, 1]),
        ];
        let mut welder = Welder::new();
        let mut remap = vec![9; 9];
        for (words, stride, expected_remap) in rows {
            let count = welder.weld(words, stride, &mut remap);
            assert_eq!(remap, expected_remap, "{words:?} by {stride}");
            let distinct = expected_remap.iter().max().map_or(0, |&m| m as usize + 1);
            assert_eq!(count, distinct, "{words:?} by {stride}");
        }
    }

    #[test]
    fn random_rows_of_any_stride() {
        let mut rng = Rng(4);
        let mut welder = Welder::new();
        let mut remap = Vec::new();
        for stride in 1..=9 {
            for (count, values) in [(10, 2), (3000, 3), (3000, 1000)] {
                let words: Vec<u32> = (0..count * stride)
                    .map(|_| rng.below(values) as u32)
                    .collect();
                let distinct = welder.weld(&words, stride, &mut remap);
                assert_eq!((remap.clone(), distinct), expected(words.chunks(stride)));
            }
        }
    }

    #[test]
    fn positions_weld_by_bits() {
        let mut rng = Rng(5);
        let mut points: Vec<DVec3> = (0..2000)
            .map(|_| (rng.vec3() * 4.0).round() * 0.1)
            .collect();
        points.extend([
            DVec3::NAN,
            DVec3::splat(-0.0),
            DVec3::ZERO,
            DVec3::INFINITY,
            DVec3::NAN,
        ]);
        let mut remap = Vec::new();
        let distinct = Welder::new().weld_positions(&points, &mut remap);
        let keys = points
            .iter()
            .map(|p| (*p + DVec3::ZERO).to_array().map(f64::to_bits));
        assert_eq!((remap, distinct), expected(keys));
    }

    #[test]
    fn colliding_rows_are_sorted_instead() {
        let mut rng = Rng(6);
        let keys: Vec<u64> = (0..5000).map(|_| rng.below(4000)).collect();
        let mut welder = Welder::new();
        let mut remap = Vec::new();
        let same_hash = |_| 7;
        let by_hash = welder.weld_by_hash(
            5000,
            5000 * MEAN_PROBES,
            same_hash,
            |_, _| false,
            &mut remap,
        );
        assert_eq!(by_hash, None);
        let compare = |i: u32, j: u32| keys[i as usize].cmp(&keys[j as usize]);
        let distinct = welder.weld_rows(5000, same_hash, compare, &mut remap);
        assert_eq!((remap, distinct), expected(keys.iter()));
    }

    #[test]
    fn rows_in_groups_are_welded_as_hashing_would() {
        let mut rng = Rng(7);
        let mut welder = Welder::new();
        let (mut remap, mut firsts) = (Vec::new(), Vec::new());
        // Many distinct rows in a single group are left to hashing.
        for (count, groups, values, welds) in [
            (0, 0, 1, true),
            (10, 1, 2, true),
            (3000, 1000, 4, true),
            (3000, 5, 3, true),
            (3000, 1, 3000, false),
        ] {
            let rows: Vec<(u32, u64)> = (0..count)
                .map(|_| (rng.below(groups) as u32, rng.below(values)))
                .collect();
            let (expected_remap, distinct) = expected(rows.iter());
            let welded = welder.weld_in_groups(
                rows.iter().map(|&(group, _)| group),
                groups as usize,
                |i, j| rows[i as usize].1 == rows[j as usize].1,
                &mut remap,
                &mut firsts,
            );
            assert_eq!(welded, welds, "{count} rows in {groups} groups");
            if welds {
                assert_eq!(remap, expected_remap);
                let first_of = |k| expected_remap.iter().position(|&r| r == k).unwrap() as u32;
                let expected_firsts: Vec<u32> = (0..distinct as u32).map(first_of).collect();
                assert_eq!(firsts, expected_firsts);
            }
        }
    }

    #[test]
    fn structured_rows_do_not_collide() {
        // Grids, small integers, single bits: what weak hashes cluster on.
        let patterns: [fn(u32) -> [u32; 3]; 5] = [
            |i| [(i % 64) as f32, (i / 64 % 64) as f32, (i / 4096) as f32].map(key_bits),
            |i| [i, 0, 0],
            |i| [0, 0, i << 14],
            |i| [i.rotate_left(20), i, i],
            |i| [i << 9, 0, i],
        ];
        for (number, pattern) in patterns.iter().enumerate() {
            let count = 1 << 17;
            let rows: Vec<[u32; 3]> = (0..count).map(pattern).collect();
            let by_hash = Welder::new().weld_by_hash(
                count,
                2 * u64::from(count),
                |i| hash(rows[i as usize].chunks(2).map(pair)),
                |i, j| rows[i as usize] == rows[j as usize],
                &mut Vec::new(),
            );
            assert_eq!(by_hash, Some(count as usize), "pattern {number}");
        }
    }
}
