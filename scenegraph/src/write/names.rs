//! Names as Inventor can write them, and names for what is used several times.
//!
//! `+N` behind a name tells instances apart and is no part of it (SoBase's rule, which readers
//! follow); so a shared node keeps its name, and one without a name stays without.

use std::borrow::Cow;

/// A name with every character replaced that cannot stand in one: blanks, controls, brackets and
/// those with a meaning of their own. A digit cannot be the first (SbName::isBaseNameStartChar).
/// `None` for the empty name.
pub fn legal(name: &str) -> Option<Cow<'_, str>> {
    let first = name.chars().next()?;
    let is_legal =
        |c: char| !(c.is_control() || c.is_whitespace() || "\"'#+.,\\{}[]()|~=".contains(c));
    if name.chars().all(is_legal) && !first.is_ascii_digit() {
        return Some(Cow::Borrowed(name));
    }
    let mut changed = String::with_capacity(name.len() + 1);
    if first.is_ascii_digit() {
        changed.push('_');
    }
    changed.extend(name.chars().map(|c| if is_legal(c) { c } else { '_' }));
    Some(Cow::Owned(changed))
}

/// Numbers behind `+`.
#[derive(Default)]
pub(super) struct Shared {
    next: u32,
}

impl Shared {
    /// A name that no other node has.
    pub(super) fn name(&mut self, name: Option<&str>) -> String {
        let number = self.next;
        self.next += 1;
        let name = name.and_then(legal).unwrap_or_default();
        format!("{name}+{number}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_kept_where_inventor_can_write_them() {
        for (name, want) in [
            ("Wall", Some("Wall")),
            ("Wall-2_b", Some("Wall-2_b")),
            ("Tür", Some("Tür")),
            ("", None),
            ("Cube.001", Some("Cube_001")),
            ("two words", Some("two_words")),
            ("3d", Some("_3d")),
            ("a{b}\n+\"", Some("a_b____")),
            ("\u{3000}", Some("_")),
        ] {
            assert_eq!(legal(name).as_deref(), want, "{name}");
        }
    }
}
