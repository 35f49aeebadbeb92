//! One function for each target of cargo-fuzz, `tests/fuzz`: any bytes, brought into the target's
//! form, go through the bodies of `fuzz_body`. The ordinary tests run the same functions.

// A fault is a panic here: that is what fuzzers look for.
#![allow(clippy::panic)]

use std::path::Path;

use convert::{InventorOptions, Options, Recorder, Source, gltf_to_inventor};
use scenegraph::{FileLoader, ResolveOptions};

use crate::fuzz_body;

/// Inputs longer than this are cut: what is slow for its length shows in shorter ones, too.
const LONGEST: usize = 64 << 10;

/// A target's name and its function.
pub type Target = (&'static str, fn(&[u8]));

/// All targets.
pub const ALL: [Target; 7] = [
    ("ascii", ascii),
    ("binary", binary),
    ("vrml97", vrml97),
    ("zip", zip),
    ("resolve", resolve),
    ("convert", convert),
    ("round_trip", round_trip),
];

fn cut(bytes: &[u8]) -> &[u8] {
    &bytes[..bytes.len().min(LONGEST)]
}

/// The bytes behind a header, unless they have one.
fn headed(header: &str, bytes: &[u8]) -> Vec<u8> {
    let bytes = cut(bytes);
    if bytes.starts_with(b"#") {
        return bytes.to_vec();
    }
    [header.as_bytes(), b"\n", bytes].concat()
}

/// Text of Inventor and what is printed of it.
pub fn ascii(bytes: &[u8]) {
    fuzz_body::parse(&headed("#Inventor V2.1 ascii", bytes));
}

/// Binary files of all versions, by the first byte.
pub fn binary(bytes: &[u8]) {
    let (header, rest) = match bytes {
        [b'1', rest @ ..] => ("#Inventor V1.0 binary  ", rest),
        [b'2', rest @ ..] => ("#Inventor V2.0 binary  ", rest),
        _ => ("#Inventor V2.1 binary  ", bytes),
    };
    let file = headed(header, rest);
    fuzz_body::binary(&file);
    fuzz_body::resolve(&file);
}

/// VRML 2.0.
pub fn vrml97(bytes: &[u8]) {
    let file = headed("#VRML V2.0 utf8", bytes);
    fuzz_body::parse(&file);
    fuzz_body::resolve(&file);
}

/// What is packed: streams and archives, with the password `ivory`.
pub fn zip(bytes: &[u8]) {
    let bytes = cut(bytes);
    let limits = unpack::Limits {
        bytes: 4 << 20,
        ratio: 200,
    };
    if let Some(Ok(unpacked)) = unpack::unpack(bytes, &limits) {
        assert!(unpacked.bytes.len() as u64 <= limits.bytes);
        fuzz_body::parse(cut(&unpacked.bytes));
    }
    let Ok(archive) = unpack::Archive::open(bytes.to_vec(), Some(b"ivory"), limits) else {
        return;
    };
    for entry in archive.entries.iter().take(100) {
        if let Ok(unpacked) = archive.read(entry) {
            assert!(unpacked.len() as u64 <= limits.bytes);
        }
    }
}

/// Any file to a scene.
pub fn resolve(bytes: &[u8]) {
    fuzz_body::resolve(cut(bytes));
}

/// Any file to glTF, and any glTF to a scene.
pub fn convert(bytes: &[u8]) {
    let bytes = cut(bytes);
    fuzz_body::convert(&fuzz_body::resolve(bytes));
    fuzz_body::convert(&fuzz_body::resolve_alternatives(bytes));
    // Any answer is right.
    let _ = fuzz_body::read_gltf(bytes);
}

/// Any file to glTF with its source, and back to the same bytes; any glTF to Inventor.
///
/// # Panics
///
/// When other bytes come back.
pub fn round_trip(bytes: &[u8]) {
    let bytes = cut(bytes);
    let nothing = FileLoader::default();
    let back = |glb: &[u8]| {
        let options = InventorOptions::default();
        gltf_to_inventor(glb, "m.glb", Path::new(""), &nothing, &|_| None, &options)
    };
    // Any answer is right.
    let _ = back(bytes);
    let scene = fuzz_body::resolve(bytes).scene;
    let recorder = Recorder::new(&nothing, Path::new("."));
    let source = Source {
        text: bytes,
        recorder: &recorder,
        resolve: &ResolveOptions::default(),
    };
    let mut glb = Vec::new();
    let written = convert::write_glb_with_source(&scene, &Options::default(), &source, &mut glb);
    if let Err(error) = written {
        panic!("not written: {error}");
    }
    match back(&glb) {
        Ok(files) => assert!(files.text == bytes, "another source came back"),
        Err(error) => panic!("not read back: {error}"),
    }
}
