//! Names of archive entries: where they lead.

use std::fmt;

/// Why a name is not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NameFault {
    /// It leads out of the archive: it is absolute, has a drive letter, or goes up too far.
    LeadsOut,
    /// It is a link.
    Link,
    /// It is no name of a file.
    NoName,
}

impl fmt::Display for NameFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::LeadsOut => "it leads out of the archive",
            Self::Link => "it is a link",
            Self::NoName => "it is not the name of a file",
        })
    }
}

/// The name with `/` between its parts and neither `.` nor `..` in it.
///
/// # Errors
///
/// When it leads anywhere else than into the archive.
pub fn clean_name(name: &str) -> Result<String, NameFault> {
    if name.contains('\0') {
        return Err(NameFault::NoName);
    }
    let name = name.replace('\\', "/");
    let has_drive = matches!(name.as_bytes(), [letter, b':', ..] if letter.is_ascii_alphabetic());
    if name.starts_with('/') || has_drive {
        return Err(NameFault::LeadsOut);
    }
    let mut parts: Vec<&str> = Vec::new();
    for part in name.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop().ok_or(NameFault::LeadsOut)?;
            }
            part => parts.push(part),
        }
    }
    if parts.is_empty() {
        return Err(NameFault::NoName);
    }
    Ok(parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_inside() {
        for (name, wanted) in [
            ("a.iv", Ok("a.iv")),
            ("./a//b.iv", Ok("a/b.iv")),
            ("a\\b.iv", Ok("a/b.iv")),
            ("a/../b.iv", Ok("b.iv")),
            ("../a.iv", Err(NameFault::LeadsOut)),
            ("a/../../b.iv", Err(NameFault::LeadsOut)),
            ("..\\a.iv", Err(NameFault::LeadsOut)),
            ("/etc/passwd", Err(NameFault::LeadsOut)),
            ("\\\\server\\share", Err(NameFault::LeadsOut)),
            ("C:\\a.iv", Err(NameFault::LeadsOut)),
            ("c:a.iv", Err(NameFault::LeadsOut)),
            ("", Err(NameFault::NoName)),
            ("a/..", Err(NameFault::NoName)),
            ("a\0b", Err(NameFault::NoName)),
        ] {
            assert_eq!(clean_name(name), wanted.map(str::to_owned), "{name}");
        }
    }
}
