//! The grammar of VRML 2: its statements, names, commas and strings; and that printing keeps them.

use crate::{Form, Layout, NodeId, parse, print};

use super::{brief, check_under};

/// Checks rows of (body, tree, codes); the header is added.
fn check(rows: &[(&str, &str, &[&str])]) {
    check_under("#VRML V2.0 utf8", rows);
}

const LAMP: &str = "PROTO Lamp [ exposedField SFColor color 1, 0 .5\n field MFNode parts [ Box { } ]\n\
     eventIn SFTime go eventOut SFBool is-on ] { Shape { a IS color } ROUTE A.x TO B.y }";

#[test]
fn tokens() {
    check(&[
        ("A { x 1,,2 , 3 }", "A{x=1,2,3}", &[]),
        ("A { x [ 1,,2,\n,3, ] y 2 }", "A{x=[1,2,3] y=2}", &[]),
        ("A { x [ , \"a\",,\"b\" ] }", "A{x=[\"a\",\"b\"]}", &[]),
        (
            "A { s \"a\\\\\" t \"\\\"\" }",
            "A{s=\"a\\\\\" t=\"\\\"\"}",
            &[],
        ),
        (
            "DEF a-b:1, A-1 { x+y 2 }, USE a-b:1",
            "a-b:1:A-1{x+y=2} USE:a-b:1",
            &[],
        ),
        ("A{c[DEF B C{}USE B]}", "A{c=[B:C{},USE:B]}", &[]),
        // Leading zeros are decimal.
        ("A { x 010 }", "A{x=10}", &[]),
        ("A { \u{e9}t\u{e9} 1 }", "A{\u{e9}t\u{e9}=1}", &[]),
    ]);
}

#[test]
fn statements() {
    let lamp = "Lamp:PROTO{exposedField:SFColor:color=1.0,0.0,0.5 \
         field:MFNode:parts=[Box{}] eventIn:SFTime:go= eventOut:SFBool:is-on= \
         Shape{a=IS:color} ROUTE{A.x=B.y}}";
    check(&[
        (LAMP, lamp, &[]),
        (
            "EXTERNPROTO L [ field SFFloat x eventIn SFTime y ] [ \"a.wrl#L\", \"b\" ] L { x 2 }",
            "L:EXTERNPROTO{field:SFFloat:x= eventIn:SFTime:y= url=[\"a.wrl#L\",\"b\"]} L{x=2}",
            &[],
        ),
        (
            "EXTERNPROTO L [] \"a.wrl\" ROUTE a.b TO c.d B{}",
            "L:EXTERNPROTO{url=\"a.wrl\"} ROUTE{a.b=c.d} B{}",
            &[],
        ),
        (
            "Script { url \"x\" field SFNode n USE B eventIn SFTime t IS u eventOut SFBool v }",
            "Script{url=\"x\" field:SFNode:n=USE:B eventIn:SFTime:t=IS:u eventOut:SFBool:v=}",
            &[],
        ),
        (
            "A { c [ PROTO B [ ] { C { } } B { } ROUTE x.y TO z.w ] }",
            "A{c=[B:PROTO{C{}},B{},ROUTE{x.y=z.w}]}",
            &[],
        ),
        (
            "PROTO A [ field SFNode n B { c D { } } ] { PROTO E [ ] { F { } } E { } }",
            "A:PROTO{field:SFNode:n=B{c=D{}} E:PROTO{F{}} E{}}",
            &[],
        ),
        // A field may be called as a type is, and a class as a statement.
        ("A { field 1 }", "A{field=1}", &[]),
    ]);
}

#[test]
fn mistakes_cost_little() {
    check(&[
        (
            "PROTO A { B { } } C { }",
            "A:PROTO{B{}} C{}",
            &["no-interface"],
        ),
        (
            "PROTO A [ field SFFloat x 1 { B { } } C { }",
            "A:PROTO{field:SFFloat:x=1 B{}} C{}",
            &["missing-bracket"],
        ),
        ("PROTO A [ ] B { }", "A:PROTO{} B{}", &["bad-proto"]),
        (
            "PROTO A [ 7 field SFFloat x 1 ] { B { } }",
            "A:PROTO{field:SFFloat:x=1 B{}}",
            &["bad-declaration"],
        ),
        (
            "ROUTE a.b TO",
            "",
            &["not-a-node", "not-a-node", "not-a-node"],
        ),
        ("PROTO A [ field", "A:PROTO{}", &["bad-declaration"]),
        ("EXTERNPROTO A [ ]", "A:EXTERNPROTO{}", &["bad-proto"]),
    ]);
    // In Inventor files the words are nothing special.
    check_under(
        "#Inventor V2.1 ascii",
        &[("PROTO { field 1 IS 2 }", "PROTO{field=1 IS=2}", &[])],
    );
}

#[test]
fn a_statement_has_its_form() {
    let text = format!("#VRML V2.0 utf8\n{LAMP} ROUTE A.x TO B.y\nEXTERNPROTO E [ ] \"e\"");
    let tree = parse(text.as_bytes()).tree;
    let forms: Vec<Form> = (0..tree.node_count() as u32)
        .map(|i| tree.node(NodeId(i)).form)
        .collect();
    use Form::*;
    assert_eq!(forms, [Proto, Node, Node, Route, Route, ExternProto]);
}

struct Plain;

impl Layout for Plain {
    fn tuple_size(&self, _: &[u8], _: &[u8]) -> usize {
        0
    }
}

#[test]
fn printing_keeps_statements() {
    let text = format!(
        "#VRML V2.0 utf8\n{LAMP}\nEXTERNPROTO E [ field SFFloat x eventIn SFTime y ] [ \"e\" \"f\" ]\n\
         EXTERNPROTO F [ ] \"f\\\\\"\n\
         Script {{ field SFNode n Lamp {{ color 1 1 1 }} eventIn SFTime t IS u }} ROUTE a.b TO c.d"
    );
    let tree = parse(text.as_bytes()).tree;
    let mut out = Vec::new();
    print(&tree, &Plain, &mut out).unwrap();
    let again = parse(&out);
    assert!(again.problems.is_empty(), "{:?}", again.problems);
    assert_eq!(brief(&again.tree), brief(&tree));
}

#[test]
fn deep_prototypes_do_not_overflow() {
    let text = format!(
        "#VRML V2.0 utf8\n{}",
        "PROTO A [ field SFNode n B { ".repeat(50_000)
    );
    assert!(
        parse(text.as_bytes())
            .problems
            .iter()
            .any(|p| p.code == "too-deep")
    );
}
