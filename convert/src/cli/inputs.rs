//! From the paths given to the list of inputs: folders are searched. Nothing is read here.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{self, Path, PathBuf};

/// One file to work on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// Where it is, beginning with what the user gave.
    pub path: PathBuf,
    /// Its place below an output folder: the path below the folder searched, or the file name.
    pub relative: PathBuf,
    /// Whether it was found in a folder, rather than named.
    pub is_found: bool,
    /// Why it, a folder, could not be searched.
    pub fault: Option<String>,
}

impl Input {
    fn named(path: &Path) -> Self {
        Self {
            path: path.to_owned(),
            relative: path.file_name().map(PathBuf::from).unwrap_or_default(),
            is_found: false,
            fault: None,
        }
    }

    fn found(path: PathBuf, root: &Path) -> Self {
        let relative = path.strip_prefix(root).unwrap_or(&path).to_owned();
        Self {
            path,
            relative,
            is_found: true,
            fault: None,
        }
    }

    fn fault(path: &Path, why: String) -> Self {
        Self {
            fault: Some(why),
            is_found: true,
            ..Self::named(path)
        }
    }
}

/// All inputs in the order given, those of a folder sorted by path; none twice. The output folder,
/// if it lies in a folder searched, is passed over: an earlier run's outputs are no inputs.
pub fn find(given: &[PathBuf], out_dir: Option<&Path>) -> Vec<Input> {
    let skip = out_dir.and_then(|path| path.canonicalize().ok());
    let mut inputs = Vec::new();
    for path in given {
        if path.is_dir() {
            inputs.extend(search(path, skip.as_deref()));
        } else {
            // One that is missing is reported when its turn to be read comes.
            inputs.push(Input::named(path));
        }
    }
    let mut known = BTreeSet::new();
    inputs.retain(|input| {
        // One file that has two places below an output folder is two inputs.
        let place = out_dir.map(|_| input.relative.clone());
        known.insert((identity(&input.path), place))
    });
    inputs
}

/// The same for all spellings of a path, whether or not it exists: the real folder, as far as it
/// exists, and the rest as written. The last part is not followed if it is a link.
pub fn identity(path: &Path) -> PathBuf {
    let absolute = path::absolute(path).unwrap_or_else(|_| path.to_owned());
    for folder in absolute.ancestors().skip(1) {
        if let Ok(real) = folder.canonicalize()
            && let Ok(rest) = absolute.strip_prefix(folder)
        {
            return real.join(rest);
        }
    }
    absolute
}

/// All models below a folder. Every folder is entered once, however many links lead to it, so
/// that cycles end; links wait until all else is done, so that real paths win.
fn search(root: &Path, skip: Option<&Path>) -> Vec<Input> {
    let mut inputs = Vec::new();
    let mut entered = BTreeSet::new();
    let mut folders = vec![root.to_owned()];
    let mut links: Vec<PathBuf> = Vec::new();
    loop {
        let Some(folder) = folders.pop() else {
            links.sort_by(|a, b| b.cmp(a));
            match links.pop() {
                Some(link) => folders.push(link),
                None => break,
            }
            continue;
        };
        let real = folder.canonicalize().unwrap_or_else(|_| folder.clone());
        let is_skipped = folder != root && skip == Some(real.as_path());
        if is_skipped || !entered.insert(real) {
            continue;
        }
        match Listing::of(&folder) {
            Ok(listing) => {
                let models = listing.models.into_iter();
                inputs.extend(models.map(|path| Input::found(path, root)));
                folders.extend(listing.folders);
                links.extend(listing.links);
            }
            Err(why) => {
                let why = format!("the folder cannot be searched: {why}");
                inputs.push(Input::fault(&folder, why));
            }
        }
    }
    inputs.sort_by(|a, b| a.path.cmp(&b.path));
    if inputs.is_empty() {
        let why = "the folder holds no models: no .iv, .wrl or the like".to_owned();
        inputs.push(Input::fault(root, why));
    }
    inputs
}

/// What is directly in a folder.
#[derive(Default)]
struct Listing {
    models: Vec<PathBuf>,
    folders: Vec<PathBuf>,
    /// Links to folders.
    links: Vec<PathBuf>,
}

impl Listing {
    fn of(folder: &Path) -> io::Result<Self> {
        let mut listing = Self::default();
        for entry in fs::read_dir(folder)? {
            let entry = entry?;
            let path = entry.path();
            let is_link = entry.file_type()?.is_symlink();
            if path.is_dir() {
                let list = if is_link {
                    &mut listing.links
                } else {
                    &mut listing.folders
                };
                list.push(path);
            } else if is_model(&path) {
                listing.models.push(path);
            }
        }
        listing.folders.sort_by(|a, b| b.cmp(a));
        Ok(listing)
    }
}

/// Endings of the names that models have, as far as folders are searched for them.
const ENDINGS: [&str; 8] = ["iv", "ivx", "ivl", "ivz", "ivzl", "wrl", "wrz", "vrml"];

fn is_model(path: &Path) -> bool {
    let unpacked = without_packing(path);
    let ending = unpacked.extension().unwrap_or_default();
    ENDINGS
        .iter()
        .any(|known| ending.eq_ignore_ascii_case(known))
}

/// The path without the ending that packing adds: `a.iv` for `a.iv.gz`.
pub fn without_packing(path: &Path) -> PathBuf {
    let is_packed = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("gz") || e.eq_ignore_ascii_case("bz2"));
    let inner = if is_packed {
        path.with_extension("")
    } else {
        path.to_owned()
    };
    match inner.extension() {
        // Of `a.gz` the name is all there is.
        None => path.to_owned(),
        Some(_) => inner,
    }
}
