//! Text to bytes and back, by rows.

use crate::binary::testing::{Known, brief, bytes, codes, read};
use crate::{parse, print_binary};

/// Writes text as binary: the bytes, and the codes of what is left out.
fn written(text: &str) -> (Vec<u8>, String) {
    let parsed = parse(text.as_bytes());
    assert_eq!(parsed.problems, [], "{text}");
    let mut out = Vec::new();
    let problems = print_binary(&parsed.tree, &Known, &mut out).unwrap();
    (out, codes(&problems))
}

/// Version, text, body of the binary file, what is told.
type Row = (&'static str, &'static str, &'static str, &'static str);

const ROWS: &[Row] = &[
    ("2.1", "Shape { }", "Shape 0 0", ""),
    (
        "2.1",
        "NULL USE a DEF b Group { }",
        "NULL USE a DEF b Group 2 0 0",
        "",
    ),
    (
        "2.1",
        "Group { Shape { } Switch { int 3 USE a } }",
        "Group 2 0 2 Shape 0 0 Switch 2 1 int 3 0 1 USE a",
        "",
    ),
    ("2.1", "Shape { flag TRUE }", "Shape 0 1 flag 1 0", ""),
    ("2.1", "Shape { flag false }", "Shape 0 1 flag 0 0", ""),
    ("2.1", "Shape { int 010 }", "Shape 0 1 int 8 0", ""),
    ("2.1", "Shape { size 010 }", "Shape 0 1 size 10.0 0", ""),
    (
        "2.1",
        "Shape { ints [ 1, -1 ] }",
        "Shape 0 1 ints 2 1 -1 0",
        "",
    ),
    ("2.1", "Shape { ints [ ] }", "Shape 0 1 ints 0 0", ""),
    (
        "2.1",
        "Shape { colors 0xff0000ff }",
        "Shape 0 1 colors 1 4278190335 0",
        "",
    ),
    ("2.1", "Shape { wide -2 }", "Shape 0 1 wide -1 -2 0", ""),
    ("2.1", "Shape { time 0.1 }", "Shape 0 1 time 0.1d 0", ""),
    ("2.1", "Shape { size 0.1 }", "Shape 0 1 size 0.1 0", ""),
    (
        "2.1",
        "Shape { size 2600123.456 }",
        "Shape 0 1 size 2600123.5 0",
        "rounded",
    ),
    (
        "2.1",
        "Shape { point 1 2 3 }",
        "Shape 0 1 point 1 1.0 2.0 3.0 0",
        "",
    ),
    (
        "2.1",
        "Shape { point [ 1 2 3, 4 ] }",
        "Shape 0 1 point 1 1.0 2.0 3.0 0",
        "not-in-binary",
    ),
    (
        "2.1",
        r#"Shape { text "a \"b\" c:\d" }"#,
        r#"Shape 0 1 text 'xxxx' 0"#,
        "",
    ),
    ("2.1", "Shape { text word }", "Shape 0 1 text word 0", ""),
    (
        "2.1",
        "Shape { text 1.50 }",
        "Shape 0 1 text \"1.50\" 0",
        "",
    ),
    (
        "2.1",
        "Shape { texts [ a, \"\" ] }",
        "Shape 0 1 texts 2 a \"\" 0",
        "",
    ),
    ("2.1", "Shape { style AUTO }", "Shape 0 1 style AUTO 0", ""),
    (
        "2.1",
        "Shape { parts ( A | B ) }",
        "Shape 0 1 parts A B \"\" 0",
        "",
    ),
    (
        "2.1",
        "Shape { node Shape { } }",
        "Shape 0 1 node Shape 0 0 0",
        "",
    ),
    (
        "2.1",
        "Shape { nodes [ USE a, NULL ] }",
        "Shape 0 1 nodes 2 USE a NULL 0",
        "",
    ),
    (
        "2.1",
        "Shape { image 1 1 3 0x616263 }",
        "Shape 0 1 image 1 1 3 'abc\0' 0",
        "",
    ),
    (
        "2.0",
        "Shape { image 1 1 3 0x616263 }",
        "Shape 1 image 1 1 3 6382179 0",
        "",
    ),
    // Flags and connections.
    ("2.1", "Shape { int 5 ~ }", "Shape 0 1 int 5 1", ""),
    ("2.1", "Shape { int ~ }", "Shape 0 1 int 7 5", ""),
    ("2.1", "Shape { size ~ }", "Shape 0 1 size 0.0 5", ""),
    (
        "2.1",
        "Shape { int 5 = Shape { } . size flag TRUE }",
        "Shape 0 2 int 5 2 Shape 0 0 size flag 1 0",
        "",
    ),
    (
        "2.1",
        "Shape { int = USE a . size }",
        "Shape 0 1 int 7 6 USE a size",
        "",
    ),
    // The last of a field counts.
    ("2.1", "Shape { int 1 int 2 }", "Shape 0 1 int 2 0", ""),
    // What has no place.
    (
        "2.1",
        "Shape { odd 1 int 2 }",
        "Shape 0 1 int 2 0",
        "not-in-binary",
    ),
    ("2.1", "Shape { int WORD }", "Shape 0 0", "not-in-binary"),
    (
        "2.1",
        "Shape { point 1 2 3 Shape { } }",
        "Shape 0 1 point 1 1.0 2.0 3.0 0",
        "not-in-binary",
    ),
    (
        "2.1",
        "Switch { Shape { } node USE a }",
        "Switch 2 1 node USE a 0 1 Shape 0 0",
        "field-moved",
    ),
    // Classes that describe themselves, or must.
    (
        "2.1",
        "Odd { fields [ SFFloat x, SFNode n ] x 1 n NULL Shape { } }",
        "Odd 2 16386 SFFloat x SFNode n x 1.0 0 n NULL 0 1 Shape 0 0",
        "",
    ),
    ("2.1", "Odd { x 1.5 }", "Odd 0 16385 SFFloat x x 1.5 0", ""),
    ("2.1", "Odd { }", "Odd 0 16384", ""),
    (
        "2.0",
        "Odd { fields [ SFFloat x ] x 1 Shape { } }",
        "Odd fields 1 SFFloat x 1 x 1.0 0 1 Shape 0",
        "",
    ),
    (
        "2.1",
        "Gate { type MFFloat input [ 1, 2 ] }",
        "Gate 0 type MFFloat 1 input 2 1.0 2.0 0",
        "",
    ),
    // Old versions.
    (
        "2.0",
        "Group { Default { } Shape { int 3 } }",
        "Group 2 Default Shape 1 int 3 0",
        "",
    ),
    (
        "1.0",
        "Separator { Group { } Shape { } }",
        "Separator 2 Group 0 -1 Shape 0 -1",
        "",
    ),
];

#[test]
fn bytes_are_as_assembled_by_hand() {
    for (version, text, body, told) in ROWS {
        let (out, codes) = written(&format!("#Inventor V{version} ascii\n{text}"));
        assert_eq!(codes, *told, "{text}");
        let mut wanted = bytes(version, body);
        if let Some(at) = wanted.windows(4).position(|four| four == b"xxxx") {
            // The string that rows cannot have.
            let text = b"\0\0\0\x0aa \"b\" c:\\d\0\0";
            wanted.splice(at..at + 4, text.iter().copied());
        }
        assert!(out == wanted, "{version} {text}:\n{out:?}\n{wanted:?}");
    }
}

#[test]
fn what_is_written_is_read_back() {
    for (version, text, _, _) in ROWS {
        let (out, _) = written(&format!("#Inventor V{version} ascii\n{text}"));
        let read = read(&out);
        assert_eq!(read.problems, [], "{text}");
        let mut again = Vec::new();
        let told = print_binary(&read.tree, &Known, &mut again).unwrap();
        assert_eq!(told, [], "{text}");
        assert!(again == out, "{text}: {}", brief(&read.tree));
    }
}

#[test]
fn vrml_has_no_binary_form() {
    let parsed = parse(b"#VRML V1.0 ascii\nCube { }");
    let error = print_binary(&parsed.tree, &Known, &mut Vec::new()).unwrap_err();
    assert_eq!(error.kind(), std::io::ErrorKind::Unsupported);
}

#[test]
fn deep_trees_are_written_without_recursion() {
    let depth = 900;
    let text = format!(
        "#Inventor V2.1 ascii\n{}{}",
        "Group { ".repeat(depth),
        "} ".repeat(depth)
    );
    let (out, _) = written(&text);
    assert_eq!(out.len(), 24 + depth * 24);
}
