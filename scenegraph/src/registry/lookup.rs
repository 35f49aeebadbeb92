//! Classes by name: exact for reading, near for hints in messages.

use std::sync::LazyLock;

use rustc_hash::FxHashMap;

use super::Class;

static BY_NAME: LazyLock<FxHashMap<&'static [u8], Class>> = LazyLock::new(|| {
    let entry = |&class: &Class| (class.name().as_bytes(), class);
    Class::ALL.iter().map(entry).collect()
});

static VRML_NAMES: LazyLock<FxHashMap<&'static [u8], Class>> = LazyLock::new(|| {
    let own = |&class: &Class| Some((class.name().strip_prefix("VRML")?.as_bytes(), class));
    Class::ALL.iter().filter_map(own).collect()
});

/// Names longer than this are nobody's typing error; it bounds the cost of [`Class::closest`].
const LONGEST_GUESS: usize = 64;

impl Class {
    /// The class of that exact name, with or without the prefix `So`, as Coin reads it.
    #[must_use]
    pub fn from_name(name: &[u8]) -> Option<Self> {
        let found = BY_NAME.get(name);
        found
            .or_else(|| BY_NAME.get(name.strip_prefix(b"So")?))
            .copied()
    }

    /// The class that a VRML 2.0 file means: one of VRML, which other files write with the prefix
    /// `VRML`, else one of Inventor, as Coin allows.
    #[must_use]
    pub fn from_vrml_name(name: &[u8]) -> Option<Self> {
        let own = VRML_NAMES.get(name).copied();
        own.or_else(|| Self::from_name(name))
    }

    /// The name in a VRML 2.0 file.
    #[must_use]
    pub fn vrml_name(self) -> &'static str {
        self.name().strip_prefix("VRML").unwrap_or(self.name())
    }

    /// The class that a misspelt name most likely means: letter case is disregarded, and up to
    /// one letter in four (at most two in all) may be missing, extra or wrong. Among equally
    /// near classes the first of the registry is taken.
    #[must_use]
    pub fn closest(name: &str) -> Option<Self> {
        if name.len() > LONGEST_GUESS {
            return None;
        }
        let lower = name.to_ascii_lowercase();
        let bare = lower.strip_prefix("so").unwrap_or(&lower);
        let nearest = |wanted: &str| {
            let distances = Self::ALL.iter().map(|&class| {
                let known = class.name().to_ascii_lowercase();
                (edit_distance(wanted.as_bytes(), known.as_bytes()), class)
            });
            distances.min_by_key(|&(distance, _)| distance)
        };
        let (distance, class) = [&lower, bare]
            .into_iter()
            .filter_map(nearest)
            .min_by_key(|&(distance, _)| distance)?;
        (distance <= (bare.len() / 4).min(2)).then_some(class)
    }
}

/// Levenshtein's distance in bytes: insertions, deletions and replacements, one row at a time.
fn edit_distance(a: &[u8], b: &[u8]) -> usize {
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, &from) in a.iter().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, &to) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(from != to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}
