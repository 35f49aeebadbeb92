//! References of an Inventor text to other files, which do not move with it into another folder.

use std::collections::BTreeSet;
use std::path::Path;

use convert::command::model::{Files, Opened};
use iv_parser::{Atom, Item, NodeId, Problem, Severity, Tree, Value, text_of};
use scenegraph::Loader;

/// A problem for each file that the model finds and that is not found from the folder `to`, where
/// it is named first.
pub fn left_behind(tree: &Tree<'_>, from: &Opened, to: &Path) -> Vec<Problem> {
    let to = match to.as_os_str().is_empty() {
        true => Path::new("."),
        false => to,
    };
    if to.canonicalize().is_ok_and(|to| to == from.folder) {
        return Vec::new();
    }
    let is_found = |path: &Path, name: &str| match &from.files {
        Files::Folders(_) => from.folder.join(path).is_file(),
        Files::Archive(archive) => archive.find(&from.folder, name).is_ok(),
    };
    let mut seen = BTreeSet::new();
    let mut problems = Vec::new();
    for atom in file_names(tree) {
        let (Atom::String(raw, span) | Atom::Word(raw, span)) = *atom else {
            continue;
        };
        let name = text_of(&tree.string(raw));
        // As the loader reads names of other systems.
        let path = name.replace('\\', "/");
        // What VRML addresses inside a file stands behind `#`.
        let path = path.split_once('#').map_or(&*path, |(file, _)| file);
        let path = Path::new(path);
        let is_moved = path.is_relative() && !to.join(path).is_file() && is_found(path, &name);
        if is_moved && seen.insert(raw) {
            problems.push(Problem {
                severity: Severity::Warning,
                code: "left-behind",
                message: format!("`{name}` is not found from the folder of the output"),
                hint:
                    "the text is written as it is; copy the file along, or write beside the input"
                        .to_owned(),
                span,
            });
        }
    }
    problems
}

/// The names of images and of included files.
fn file_names<'t, 'a>(tree: &'t Tree<'a>) -> impl Iterator<Item = &'t Atom<'a>> {
    let nodes = (0..tree.node_count()).map(|i| NodeId(i as u32));
    let fields = nodes.flat_map(|id| {
        let class = tree.node(id).class;
        let includes = matches!(class, b"File" | b"SoFile" | b"WWWInline" | b"SoWWWInline");
        // Anchors link to what need not be there.
        let has_url = matches!(
            class,
            b"Inline" | b"VRMLInline" | b"ImageTexture" | b"VRMLImageTexture" | b"EXTERNPROTO"
        );
        let names_a_file = move |name: &[u8]| {
            matches!(name, b"filename" | b"filenames")
                || (includes && name == b"name")
                || has_url && name == b"url"
        };
        let fields = tree.items(id).iter().filter_map(|item| match item {
            Item::Field(field) => Some(tree.field(*field)),
            Item::Child(_) => None,
        });
        fields.filter(move |field| names_a_file(field.name))
    });
    fields.flat_map(|field| match field.value {
        Value::Atoms { atoms, .. } => tree.atoms(atoms),
        _ => &[],
    })
}
