//! Lists of numbers that share arrays: many short lists cost no allocation each, and a list that
//! is passed on is not copied.

use std::ops::Deref;
use std::sync::Arc;

/// A part of an array that other lists may have other parts of. Equal when its values are.
#[derive(Clone, Debug)]
pub struct List<T> {
    array: Arc<Vec<T>>,
    start: u32,
    len: u32,
}

impl<T> Deref for List<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.array[self.start as usize..][..self.len as usize]
    }
}

impl<T: PartialEq> PartialEq for List<T> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

/// A list with an array of its own; values beyond `u32::MAX` are not part of it.
impl<T> From<Vec<T>> for List<T> {
    fn from(values: Vec<T>) -> Self {
        let len = u32::try_from(values.len()).unwrap_or(u32::MAX);
        Self {
            array: Arc::new(values),
            start: 0,
            len,
        }
    }
}

/// Which list of a `Lists`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    array: u32,
    start: u32,
    len: u32,
}

impl Part {
    /// Number of values.
    pub(crate) fn len(self) -> usize {
        self.len as usize
    }
}

/// Values in a shared array, as far as one list does not fill an array of its own.
const SHARED: usize = 1 << 16;

/// Lists being collected.
#[derive(Clone, Debug)]
pub(crate) struct Lists<T> {
    full: Vec<Arc<Vec<T>>>,
    /// The array that the next lists go into; its index is the number of the full ones.
    open: Vec<T>,
}

impl<T> Default for Lists<T> {
    fn default() -> Self {
        Self {
            full: Vec::new(),
            open: Vec::new(),
        }
    }
}

impl<T: Copy> Lists<T> {
    /// Adds a list. A long one is taken from `values`, which it leaves empty, others are copied, so
    /// that `values` need not grow again.
    pub(crate) fn add(&mut self, values: &mut Vec<T>) -> Part {
        let len = values.len();
        if self.open.len() + len > self.open.capacity() {
            self.close();
            if len >= SHARED {
                let mut own = std::mem::take(values);
                own.shrink_to_fit();
                self.full.push(Arc::new(own));
                return self.part(self.full.len() - 1, 0, len);
            }
            self.open.reserve_exact(SHARED);
        }
        let start = self.open.len();
        self.open.extend_from_slice(values);
        self.part(self.full.len(), start, len)
    }

    /// A text has fewer than 2^32 bytes, so no count of its numbers is cut here.
    fn part(&self, array: usize, start: usize, len: usize) -> Part {
        Part {
            array: array as u32,
            start: start as u32,
            len: len as u32,
        }
    }

    /// Ends the open array. To be called behind the last list: only then can lists be shared.
    pub(crate) fn close(&mut self) {
        if !self.open.is_empty() {
            let mut array = std::mem::take(&mut self.open);
            array.shrink_to_fit();
            self.full.push(Arc::new(array));
        }
    }

    fn array(&self, part: Part) -> &[T] {
        self.full
            .get(part.array as usize)
            .map_or(&self.open, |array| &**array)
    }

    /// The values of a list.
    pub(crate) fn values(&self, part: Part) -> &[T] {
        &self.array(part)[part.start as usize..][..part.len()]
    }

    /// A list to be passed on.
    pub(crate) fn share(&self, part: Part) -> List<T> {
        match self.full.get(part.array as usize) {
            Some(array) => List {
                array: Arc::clone(array),
                start: part.start,
                len: part.len,
            },
            None => self.values(part).to_vec().into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_keep_their_values_wherever_they_stand() {
        for lengths in [
            &[][..],
            &[0, 1, 5],
            &[SHARED],
            &[SHARED + 1, 3, SHARED - 1, 2, SHARED, 7],
            &[SHARED - 1, 1, 1, 4 * SHARED, 1],
        ] {
            let mut lists = Lists::default();
            let mut expected = Vec::new();
            for (i, &len) in lengths.iter().enumerate() {
                let values: Vec<usize> = (0..len).map(|k| k * 7 + i).collect();
                let part = lists.add(&mut values.clone());
                assert!(*lists.share(part) == values, "before the end, {lengths:?}");
                expected.push((part, values));
            }
            lists.close();
            for (part, values) in expected {
                assert_eq!(part.len(), values.len());
                assert!(lists.values(part) == values, "{lengths:?}");
                assert!(lists.share(part) == List::from(values), "{lengths:?}");
            }
        }
    }
}
