//! Models in models: what is read, how often, and what is refused.

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use scenegraph::{FileLoader, LoadError, Loader, ResolveOptions, load, resolve};
use tests::measure::totals;

/// Files in memory, which writes down what is asked of it.
struct Library {
    files: &'static [(&'static str, &'static str)],
    reads: RefCell<Vec<String>>,
}

impl Loader for Library {
    fn find(&self, beside: &Path, name: &str) -> Result<PathBuf, LoadError> {
        let path = beside.join(name.trim_start_matches("./"));
        let is_here = |(known, _): &&(&str, &str)| path == Path::new(known);
        match self.files.iter().find(is_here) {
            Some(_) => Ok(path),
            None => Err(LoadError::NotFound),
        }
    }

    fn read(&self, id: &Path) -> Result<Vec<u8>, LoadError> {
        let is_it = |(known, _): &&(&str, &str)| id == Path::new(known);
        let (name, text) = self
            .files
            .iter()
            .find(is_it)
            .expect("a file that was found");
        self.reads.borrow_mut().push((*name).to_owned());
        Ok(text.as_bytes().to_vec())
    }
}

/// The first file is `main.iv`; `reads` is what is read after it.
struct Row {
    files: &'static [(&'static str, &'static str)],
    reads: &'static [&'static str],
    triangles: usize,
    codes: &'static [&'static str],
}

const HEADER: &str = "#Inventor V2.1 ascii\n";
const CUBE: &str = "#Inventor V2.1 ascii\nCube { }";
const FACE: &str = "#Inventor V2.1 ascii\nFaceSet { vertexProperty VertexProperty {
    vertex [ 0 0 0, 1 0 0, 0 1 0 ] } }";

const ROWS: &[Row] = &[
    Row {
        files: &[
            (
                "main.iv",
                "File { name \"a.iv\" } File { name \"./a.iv\" } File { name \"a.iv\" }",
            ),
            ("a.iv", CUBE),
        ],
        reads: &["a.iv"],
        triangles: 36,
        codes: &[],
    },
    Row {
        files: &[
            ("main.iv", "File { name \"a.iv\" } File { name \"b.iv\" }"),
            (
                "a.iv",
                "#Inventor V2.1 ascii\nFile { name \"b.iv\" } File { name \"b.iv\" }",
            ),
            ("b.iv", FACE),
        ],
        reads: &["a.iv", "b.iv"],
        triangles: 3,
        codes: &[],
    },
    // A circle is refused wherever it closes, without reading anything again.
    Row {
        files: &[
            (
                "main.iv",
                "File { name \"a.iv\" } File { name \"b.iv\" } Cube { }",
            ),
            (
                "a.iv",
                "#Inventor V2.1 ascii\nFile { name \"b.iv\" } File { name \"a.iv\" }",
            ),
            (
                "b.iv",
                "#Inventor V2.1 ascii\nFile { name \"a.iv\" } File { name \"main.iv\" }",
            ),
        ],
        reads: &["a.iv", "b.iv"],
        triangles: 12,
        codes: &["include", "include", "include"],
    },
    Row {
        files: &[
            (
                "main.iv",
                "File { name \"a.iv\" } File { name \"gone.iv\" }",
            ),
            ("a.iv", CUBE),
        ],
        reads: &["a.iv"],
        triangles: 12,
        codes: &["include"],
    },
];

#[test]
fn every_file_is_read_once() {
    for (i, row) in ROWS.iter().enumerate() {
        let library = Library {
            files: row.files,
            reads: RefCell::default(),
        };
        let text = format!("{HEADER}{}", row.files[0].1);
        let graph = load(text.as_bytes(), "main.iv", Path::new(""), &library);
        let resolved = resolve(&graph, &ResolveOptions::default());
        let codes: Vec<&str> = graph.diagnostics.iter().map(|d| d.code).collect();
        assert_eq!(library.reads.into_inner(), row.reads, "row {i}");
        assert_eq!(totals(&resolved.scene).triangles, row.triangles, "row {i}");
        assert_eq!(codes, row.codes, "row {i}");
    }
}

#[test]
fn nothing_outside_the_folders_is_read() {
    let inside = samples::data_dir().join("structure");
    let outside = samples::data_dir().join("pavilion.iv");
    let outside = outside.canonicalize().expect("a sample");
    let loader = FileLoader::new([inside.as_path()]);
    assert_eq!(loader.read(&outside), Err(LoadError::Outside));
    let error = loader.find(&inside, "../pavilion.iv");
    assert_eq!(error, Err(LoadError::Outside));
    let found = loader.find(&inside, "bolt_part.iv").expect("a sample");
    assert_eq!(
        loader.read(&found).expect("a sample"),
        std::fs::read(&found).expect("a sample")
    );
}
