//! Binary files by rows: words and strings, the tree in short, the codes of the problems.

use super::testing::{Known, brief, bytes, codes, read};
use crate::{Limits, parse_any};

/// Version, body, tree, problems.
type Row = (&'static str, &'static str, &'static str, &'static str);

fn check(rows: &[Row]) {
    for (version, body, tree, problems) in rows {
        let bytes = bytes(version, body);
        let parse = read(&bytes);
        assert_eq!(brief(&parse.tree).trim_end(), *tree, "{version} {body}");
        assert_eq!(codes(&parse.problems), *problems, "{version} {body}");
    }
}

#[test]
fn values_of_all_kinds() {
    check(&[
        ("2.1", "Shape 0 0", "Shape{}", ""),
        ("2.1", "Shape 0 1 flag 1 0", "Shape{flag=TRUE}", ""),
        ("2.1", "Shape 0 1 flag 0 0", "Shape{flag=FALSE}", ""),
        (
            "2.1",
            "Shape 0 2 int -7 0 int 8 0",
            "Shape{int=-7 int=8}",
            "",
        ),
        (
            "2.1",
            "Shape 0 1 ints 3 1 2 -1 0",
            "Shape{ints=[1,2,-1]}",
            "",
        ),
        ("2.1", "Shape 0 1 ints 1 5 0", "Shape{ints=5}", ""),
        ("2.1", "Shape 0 1 ints 0 0", "Shape{ints=[]}", ""),
        (
            "2.1",
            "Shape 0 1 colors 2 255 4278190335 0",
            "Shape{colors=[255.0,4278190335.0]}",
            "",
        ),
        ("2.1", "Shape 0 1 colors 1 255 0", "Shape{colors=255}", ""),
        ("2.1", "Shape 0 1 wide -1 -2 0", "Shape{wide=-2.0}", ""),
        ("2.1", "Shape 0 1 time 0.1d 0", "Shape{time=0.1}", ""),
        ("2.1", "Shape 0 1 size 0.1 0", "Shape{size=0.1}", ""),
        (
            "2.1",
            "Shape 0 1 size 0.7853982 0",
            "Shape{size=0.7853981852531433}",
            "",
        ),
        (
            "2.1",
            "Shape 0 1 point 1 1.0 2.5 -0.3 0",
            "Shape{point=1.0,2.5,-0.3}",
            "",
        ),
        (
            "2.1",
            "Shape 0 1 size nan 0",
            "Shape{size=0.0}",
            "not-a-number",
        ),
        (
            "2.1",
            "Shape 0 1 size inf 0",
            "Shape{size=0.0}",
            "not-a-number",
        ),
        ("2.1", "Shape 0 1 style AUTO 0", "Shape{style=AUTO}", ""),
        (
            "2.1",
            "Shape 0 1 parts SIDES TOP \"\" 0",
            "Shape{parts=(SIDES|TOP)}",
            "",
        ),
        ("2.1", "Shape 0 1 parts \"\" 0", "Shape{parts=()}", ""),
        ("2.1", "Shape 0 1 touch 0", "Shape{touch=}", ""),
        (
            "2.1",
            "Shape 0 1 text \"a b{\" 0",
            "Shape{text=\"a b{\"}",
            "",
        ),
        (
            "2.1",
            "Shape 0 1 texts 2 \"\" abcde 0",
            "Shape{texts=[\"\",\"abcde\"]}",
            "",
        ),
    ]);
}

#[test]
fn nodes_names_and_connections() {
    check(&[
        ("2.1", "NULL", "NULL", ""),
        ("2.1", "Shape 0 0 Shape 0 0", "Shape{} Shape{}", ""),
        (
            "2.1",
            "DEF a Group 2 0 3 USE a DEF \"b+1\" Shape 0 0 NULL",
            "a:Group{USE:a b+1:Shape{} NULL}",
            "",
        ),
        ("2.1", "Shape 0 1 int 5 1", "Shape{int=5~}", ""),
        ("2.1", "Shape 0 1 int 5 5", "Shape{int=~}", ""),
        ("2.1", "Shape 0 1 int 5 4", "Shape{int=5}", ""),
        (
            "2.1",
            "Shape 0 2 int 5 2 Shape 0 0 size size 1.0 0",
            "Shape{int=5<Shape{}.size> size=1.0}",
            "",
        ),
        (
            "2.1",
            "Shape 0 1 int 5 6 USE a int",
            "Shape{int=<USE:a.int>}",
            "",
        ),
        (
            "2.1",
            "Shape 0 2 node Group 2 0 1 Shape 0 0 0 int 1 0",
            "Shape{node=Group{Shape{}} int=1}",
            "",
        ),
        ("2.1", "Shape 0 1 node NULL 0", "Shape{node=NULL}", ""),
        (
            "2.1",
            "Shape 0 1 nodes 2 Shape 0 0 USE a 0 Shape 0 0",
            "Shape{nodes=[Shape{},USE:a]} Shape{}",
            "",
        ),
        ("2.1", "Kit 0 1 part Shape 0 0 0", "Kit{part=Shape{}}", ""),
        (
            "2.1",
            "Shape 0 1 node Path 0 Group 2 0 0 2 0 1 0",
            "Shape{node=Path{Group{}}}",
            "path-indices",
        ),
    ]);
}

#[test]
fn nodes_that_describe_themselves() {
    check(&[
        (
            "2.1",
            "Odd 2 16385 SFFloat x x 1.5 0 1 Shape 0 0",
            "Odd{fields=[SFFloat,x] x=1.5 Shape{}}",
            "",
        ),
        // The description goes before what the class is known to have.
        (
            "2.1",
            "Shape 0 16385 SFFloat int int 1.5 0",
            "Shape{fields=[SFFloat,int] int=1.5}",
            "",
        ),
        (
            "2.1",
            "Odd 0 16385 SFNode x x Odd 0 16385 SFFloat y y 2.0 0 0",
            "Odd{fields=[SFNode,x] x=Odd{fields=[SFFloat,y] y=2.0}}",
            "",
        ),
        (
            "2.0",
            "Odd fields 1 SFFloat x 1 x 1.5 0 1 Shape 0",
            "Odd{fields=[SFFloat,x] x=1.5 Shape{}}",
            "",
        ),
        (
            "2.0",
            "Odd inputs 1 SFFloat x 0 Shape 0",
            "Odd{inputs=[SFFloat,x]} Shape{}",
            "",
        ),
        (
            "2.1",
            "Gate 1 type MFFloat 1 input 2 1.0 2.0 0",
            "Gate{type=MFFloat input=[1.0,2.0]}",
            "",
        ),
    ]);
}

#[test]
fn old_versions() {
    check(&[
        // Classes without fields have no number of fields.
        (
            "2.0",
            "Group 2 Default Shape 1 int 3 0",
            "Group{Default{} Shape{int=3}}",
            "",
        ),
        ("2.0", "Separator 0 1 Shape 0", "Separator{Shape{}}", ""),
        (
            "2.0",
            "Switch 1 int 0 0 1 Group 0",
            "Switch{int=0 Group{}}",
            "",
        ),
        // In 1.0 a Separator has none either, and -1 ends groups and the file.
        (
            "1.0",
            "Separator 2 Group 0 -1 Shape 0 -1 -1",
            "Separator{Group{} Shape{}}",
            "",
        ),
        (
            "1.0",
            "Separator 1 Shape 0 -1 Shape 0",
            "Separator{Shape{}} Shape{}",
            "",
        ),
    ]);
}

#[test]
fn pictures() {
    check(&[
        ("2.1", "Shape 0 1 image 0 0 0 0", "Shape{image=0,0,0}", ""),
        (
            "2.1",
            "Shape 0 1 image 2 1 4 'abcdefgh' 0",
            "Shape{image=2,1,4,1633837924,1701209960}",
            "",
        ),
        // Without padding, as SGI writes, and with it.
        (
            "2.1",
            "Shape 0 2 image 1 1 3 'abc' 0 int 9 0",
            "Shape{image=1,1,3,6382179 int=9}",
            "",
        ),
        (
            "2.1",
            "Shape 0 2 image 1 1 3 'abc0' 0 int 9 0",
            "Shape{image=1,1,3,6382179 int=9}",
            "",
        ),
        // Padding of zeros looks like the beginning of the flags.
        (
            "2.1",
            "Group 2 0 2 Shape 0 1 image 1 1 2 'ab\0\0' 0 Shape 0 0",
            "Group{Shape{image=1,1,2,24930} Shape{}}",
            "",
        ),
        (
            "2.1",
            "Shape 0 1 image 1 1 1 'a\0\0\0' 0",
            "Shape{image=1,1,1,97}",
            "",
        ),
        (
            "2.0",
            "Shape 1 image 2 1 1 7 8 0",
            "Shape{image=2,1,1,7,8}",
            "",
        ),
        (
            "2.1",
            "Shape 0 1 image 65536 65536 4 'abcd' 0",
            "Shape{image=}",
            "unreadable",
        ),
        (
            "2.1",
            "Shape 0 1 image 1 1 5 'abcd' 0",
            "Shape{image=}",
            "unreadable",
        ),
    ]);
}

#[test]
fn what_cannot_be_read_costs_little() {
    check(&[
        // Unknown fields of known classes: skipped by what follows.
        (
            "2.1",
            "Shape 0 2 odd 3 1.0 2.0 3.0 0 int 4 0 Shape 0 0",
            "Shape{int=4} Shape{}",
            "unknown-field",
        ),
        (
            "2.1",
            "Shape 0 2 odd 1.0 0 int 4 0",
            "Shape{int=4}",
            "unknown-field",
        ),
        (
            "2.1",
            "Shape 0 2 odd 1.0 2.0 3.0 0 int 4 0",
            "Shape{int=4}",
            "unknown-field",
        ),
        (
            "2.1",
            "Shape 0 2 odd \"some text\" 0 int 4 0",
            "Shape{int=4}",
            "unknown-field",
        ),
        (
            "2.1",
            "Shape 0 2 odd 2 a b 0 int 4 0",
            "Shape{int=4}",
            "unknown-field",
        ),
        (
            "2.1",
            "Group 2 0 2 Shape 0 1 odd 2.0 3.0 0 Shape 0 0 Shape 0 1 int 1 0",
            "Group{Shape{} Shape{}} Shape{int=1}",
            "unknown-field",
        ),
        (
            "2.1",
            "Shape 0 1 odd 2.0 2 USE a int Shape 0 0",
            "Shape{odd=<USE:a.int>} Shape{}",
            "unknown-field",
        ),
        // All else: the rest of the node is lost, what is around it goes on.
        (
            "2.1",
            "Group 2 0 3 Shape 0 1 odd 'nothing that makes sense' Shape 0 1 int 1 0 USE a Shape 0 0",
            "Group{Shape{} Shape{int=1} USE:a} Shape{}",
            "unreadable",
        ),
        (
            "2.1",
            "Shape 0 2 int 4 0 ints 1000000 1 2 3 0 Shape 0 0",
            "Shape{int=4 ints=} Shape{}",
            "unreadable",
        ),
        ("2.1", "17 Shape 0 0", "Shape{}", "unreadable"),
        (
            "2.1",
            "Shape 0 1 node Shape 9 9 9 Shape 0 0",
            "Shape{node=Shape{}} Shape{}",
            "unreadable",
        ),
        ("2.1", "Group 2 0 5 Shape 0 0", "Group{Shape{}}", "cut-off"),
        (
            "2.1",
            "Group 2 0 2 Shape 0 1 int",
            "Group{Shape{int=}}",
            "cut-off",
        ),
        ("2.1", "", "", ""),
    ]);
}

#[test]
fn every_beginning_of_a_file_is_read() {
    let whole = bytes(
        "2.1",
        "Group 2 0 2 Shape 0 3 point 2 1.0 2.0 3.0 4.0 5.0 6.0 0 text abc 2 DEF a Shape 0 0 size \
         image 1 1 3 'abc' 0 Odd 2 16385 SFFloat x x 1.5 0 1 Shape 0 0",
    );
    assert_eq!(codes(&read(&whole).problems), "");
    for len in 0..whole.len() {
        let parse = read(&whole[..len]);
        let is_told = !parse.problems.is_empty();
        // Not told: nothing but the header, and three bytes less than a word.
        assert!(is_told || len < 28, "{len} bytes");
    }
}

#[test]
fn deep_nesting_ends_at_the_limit() {
    let mut body = "Group 2 0 1 ".repeat(3000);
    body.push_str("Shape 0 0");
    let bytes = bytes("2.1", &body);
    let limits = Limits {
        depth: 5,
        ..Limits::default()
    };
    let parse = parse_any(&bytes, &Known, &limits);
    assert_eq!(codes(&parse.problems), "too-deep");
    assert_eq!(brief(&parse.tree).matches("Group").count(), 6);
}
