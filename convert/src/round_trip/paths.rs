//! Paths of files beside a model, as its text names them: with `/`, below the model's folder.

/// Whether a path stays below the folder it is joined to, on any system, and names nothing that is
/// hidden or cannot be shown.
pub(crate) fn is_clean(path: &str) -> bool {
    let legal = |part: &str| !part.is_empty() && !part.starts_with('.');
    let shown = |c: char| !c.is_control() && !matches!(c, '\\' | ':');
    path.is_empty() || (path.chars().all(shown) && path.split('/').all(legal))
}

/// A name as written, with the separators of this form.
fn normal(name: &str) -> String {
    let name = name.trim().trim_matches('"').replace('\\', "/");
    let rest = match name.as_bytes() {
        [drive, b':', ..] if drive.is_ascii_alphabetic() => &name[2..],
        _ => &name,
    };
    rest.strip_prefix("./").unwrap_or(rest).to_owned()
}

fn join(folder: &str, name: &str) -> String {
    match folder {
        "" => name.to_owned(),
        folder => format!("{folder}/{name}"),
    }
}

/// Where a file called `name` by one in `folder` is looked for, in the order of `FileLoader`.
pub(crate) fn candidates(folder: &str, name: &str) -> Vec<String> {
    let name = normal(name);
    let last = name.rsplit('/').next().unwrap_or_default();
    let all = [
        join(folder, &name),
        name.clone(),
        join(folder, last),
        last.to_owned(),
    ];
    all.into_iter()
        .filter(|path| !path.is_empty() && is_clean(path))
        .collect()
}

/// Where a file called `name` by one in `folder` is put, so that it is found again.
pub(crate) fn target(folder: &str, name: &str) -> Option<String> {
    candidates(folder, name).into_iter().next()
}

/// The folder of a path.
pub(crate) fn folder_of(path: &str) -> &str {
    path.rsplit_once('/').map_or("", |(folder, _)| folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_put_where_they_are_found() {
        for (folder, name, want) in [
            ("", "a.iv", Some("a.iv")),
            ("", "parts/a.iv", Some("parts/a.iv")),
            ("parts", "b.png", Some("parts/b.png")),
            ("", "./a.iv", Some("a.iv")),
            ("parts", "../a.iv", Some("parts/a.iv")),
            ("", "C:\\tex\\a.png", Some("a.png")),
            ("", "/tex/a.png", Some("a.png")),
            ("", "tex\\a.png", Some("tex/a.png")),
            ("", "..", None),
            ("", "", None),
        ] {
            assert_eq!(target(folder, name).as_deref(), want, "{folder} {name}");
        }
    }
}
