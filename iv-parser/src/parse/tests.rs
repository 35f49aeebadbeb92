//! The grammar by rows: text, the tree in short, the codes of the problems.

use std::fmt::Write;

use crate::{Atom, Child, Item, Numbers, Tree, Value, parse, text_of};

mod vrml;

/// The tree in one line: `Class{field=value Child{}}`.
pub(crate) fn brief(tree: &Tree<'_>) -> String {
    let mut out = String::new();
    for &root in tree.children_of_root() {
        child(tree, root, &mut out);
    }
    out
}

fn child(tree: &Tree<'_>, child_: Child<'_>, out: &mut String) {
    match child_ {
        Child::Null => out.push_str("NULL "),
        Child::Use(name, _) => write!(out, "USE:{} ", text_of(name)).unwrap(),
        Child::Node(id) => {
            let node = tree.node(id);
            if let Some(name) = node.def {
                write!(out, "{}:", text_of(name)).unwrap();
            }
            write!(out, "{}{{", text_of(node.class)).unwrap();
            for item in tree.items(id) {
                match *item {
                    Item::Child(c) => child(tree, c, out),
                    Item::Field(f) => field(tree, f, out),
                }
            }
            *out = out.trim_end().to_owned();
            out.push_str("} ");
        }
    }
}

fn field(tree: &Tree<'_>, id: crate::FieldId, out: &mut String) {
    let field = tree.field(id);
    if let Some(declaration) = tree.declaration(id) {
        let (access, of) = (declaration.access.word(), declaration.field_type);
        write!(out, "{access}:{}:", text_of(of)).unwrap();
    }
    write!(out, "{}=", text_of(field.name)).unwrap();
    match &field.value {
        Value::Missing => {}
        Value::Is(range) => {
            write!(out, "IS:{}", atom(tree, &tree.atoms(*range)[0])).unwrap();
        }
        Value::Numbers {
            numbers, bracketed, ..
        } => {
            let list: Vec<String> = match numbers {
                Numbers::Ints(..) | Numbers::ManyInts(_) => tree
                    .ints(numbers)
                    .unwrap()
                    .iter()
                    .map(ToString::to_string)
                    .collect(),
                _ => tree
                    .floats(numbers)
                    .unwrap()
                    .iter()
                    .map(|v| format!("{v:?}"))
                    .collect(),
            };
            let list = list.join(",");
            out.push_str(&if *bracketed {
                format!("[{list}]")
            } else {
                list
            });
        }
        Value::Mask(range) => {
            let words: Vec<String> = tree.atoms(*range).iter().map(|a| atom(tree, a)).collect();
            write!(out, "({})", words.join("|")).unwrap();
        }
        Value::Atoms { atoms, bracketed } => {
            let list: Vec<String> = tree.atoms(*atoms).iter().map(|a| atom(tree, a)).collect();
            let list = list.join(",");
            out.push_str(&if *bracketed {
                format!("[{list}]")
            } else {
                list
            });
        }
    }
    if field.ignored {
        out.push('~');
    }
    if let Some(connection) = &field.connection {
        out.push('<');
        child(tree, connection.master, out);
        *out = out.trim_end().to_owned();
        write!(out, ".{}>", text_of(connection.output)).unwrap();
    }
    out.push(' ');
}

fn atom(tree: &Tree<'_>, atom: &Atom<'_>) -> String {
    match atom {
        Atom::Number(v, _) => format!("{v:?}"),
        Atom::String(raw, _) => format!("\"{}\"", text_of(raw)),
        Atom::Word(word, _) => text_of(word),
        Atom::Child(c) => {
            let mut out = String::new();
            child(tree, *c, &mut out);
            out.trim_end().to_owned()
        }
    }
}

/// Checks rows of (body, tree, codes); the header is added.
fn check(rows: &[(&str, &str, &[&str])]) {
    check_under("#Inventor V2.1 ascii", rows);
}

fn check_under(header: &str, rows: &[(&str, &str, &[&str])]) {
    for (text, tree, codes) in rows {
        let bytes = format!("{header}\n{text}");
        let parsed = parse(bytes.as_bytes());
        assert_eq!(brief(&parsed.tree).trim_end(), *tree, "{text}");
        let found: Vec<&str> = parsed.problems.iter().map(|p| p.code).collect();
        assert_eq!(found, *codes, "{text}");
    }
}

#[test]
fn well_formed() {
    check(&[
        ("Cube{width 2height 3}", "Cube{width=2 height=3}", &[]),
        (
            "Cube { width 2#c\nheight .5 }",
            "Cube{width=2 height=0.5}",
            &[],
        ),
        (
            "Cube { width 2 } # c\r Sphere{}",
            "Cube{width=2} Sphere{}",
            &[],
        ),
        ("DEF A+1 Cube { } USE A+1", "A+1:Cube{} USE:A+1", &[]),
        ("A { f [ 1 2, 3 4 , ] }", "A{f=[1,2,3,4]}", &[]),
        ("A { f [ 1, 2.5, -3 ] }", "A{f=[1.0,2.5,-3.0]}", &[]),
        ("A { f [] g 1 ~ h ~ }", "A{f=[] g=1~ h=~}", &[]),
        (
            "A { p (SIDES | TOP) q ( ) r X | Y }",
            "A{p=(SIDES|TOP) q=() r=(X|Y)}",
            &[],
        ),
        (
            "A { s \"x\\\"y\n}\" t [ \"a\" \"b\", \"c\" ] }",
            "A{s=\"x\\\"y\n}\" t=[\"a\",\"b\",\"c\"]}",
            &[],
        ),
        (
            "A { n Cube { width 1 } m [ Cube{}, USE x NULL ] k NULL }",
            "A{n=Cube{width=1} m=[Cube{},USE:x,NULL] k=NULL}",
            &[],
        ),
        (
            "A { on TRUE Cube { } B { x ON } }",
            "A{on=TRUE Cube{} B{x=ON}}",
            &[],
        ),
        (
            "A { t 1 2 3 = DEF e E { } . out u = USE e.in }",
            "A{t=1,2,3<e:E{}.out> u=<USE:e.in>}",
            &[],
        ),
        ("A { a.b C { } }", "A{a.b=C{}}", &[]),
        (
            "Foo { fields [ SFFloat x, MFNode kids ] x 1 }",
            "Foo{fields=[SFFloat,x,MFNode,kids] x=1}",
            &[],
        ),
        (
            "F { name armar/hands/x-1.iv }",
            "F{name=armar/hands/x-1.iv}",
            &[],
        ),
        (
            "A { i 0xff j 0XFF000080 k -2147483648 l 4294967295 }",
            "A{i=255 j=4278190208.0 k=-2147483648 l=4294967295.0}",
            &[],
        ),
        (
            "A { x +1 y 1e1 z 1E+2 w 5. v -.5e-1 }",
            "A{x=1 y=10.0 z=100.0 w=5.0 v=-0.05}",
            &[],
        ),
        ("", "", &[]),
    ]);
}

#[test]
fn recovers() {
    check(&[
        ("Label{label hello}", "Label{label=hello}", &[]),
        (
            "A { f [ 0 0 0,,1 0 0 ] }",
            "A{f=[0,0,0,1,0,0]}",
            &["stray-comma"],
        ),
        ("A { f [ , 1 ] }", "A{f=[1]}", &["stray-comma"]),
        ("A { f 1 2, 3 4 }", "A{f=1,2,3,4}", &["no-brackets"]),
        (
            "A { f [ 1 2 g 3 }",
            "A{f=[1,2,3]}",
            &["not-a-number", "missing-bracket"],
        ),
        (
            "A { f [ 1 2 g [ 3 ] }",
            "A{f=[1,2] g=[3]}",
            &["missing-bracket"],
        ),
        ("A { f [ 1 2 } B {}", "A{f=[1,2]} B{}", &["missing-bracket"]),
        ("A { f [ 1 x 2 ] }", "A{f=[1,2]}", &["not-a-number"]),
        (
            "A { w 1.#QNAN h 3 } B {}",
            "A{w=0.0 h=3} B{}",
            &["not-a-number"],
        ),
        (
            "A { w [ nan -INF 2 ] }",
            "A{w=[0.0,0.0,2.0]}",
            &["not-a-number"],
        ),
        (
            "A { w 1e40 h 1e }",
            "A{w=3.4028234663852886e38 h=1.0}",
            &["overflow", "bad-exponent"],
        ),
        ("A { B {} ", "A{B{}}", &["missing-brace"]),
        ("A {} } B {}", "A{} B{}", &["extra-brace"]),
        ("A { f }", "A{f=}", &["no-value"]),
        ("A { 1 2 B {} }", "A{B{}}", &["stray-value", "stray-value"]),
        (
            "A { s \"C:\\tex\\\" } B {}",
            "A{s=\"C:\\tex\\\"} B{}",
            &["unclosed-string"],
        ),
        (
            "A { s \"abc\n t 1 }",
            "A{s=\"abc\" t=1}",
            &["unclosed-string"],
        ),
        ("A { p (X } B {}", "A{p=(X)} B{}", &["missing-paren"]),
        (
            "A { t 1 = 5 u 2 }",
            "A{t=1 u=2}",
            &["bad-connection", "stray-value"],
        ),
        ("DEF a{Cube{}} B {}", "a:{Cube{}} B{}", &["no-class"]),
        ("DEF a { x 1 }", "a:{x=1}", &["no-class"]),
        ("DEF A } B {}", "NULL B{}", &["bad-def", "extra-brace"]),
        ("{ Cube {} }", "{Cube{}}", &["no-class"]),
        (
            "DEF a{ Cube{} USE a{ USE b}",
            "a{:Cube{} USE:a{ USE:b",
            &["extra-brace"],
        ),
    ]);
}

#[test]
fn headers() {
    let rows: [(&[u8], &[&str]); 6] = [
        (b"#Inventor V2.1 ascii\nCube{}", &[]),
        (b"#VRML V1.0 ascii  extra\nCube{}", &[]),
        (
            b"\xef\xbb\xbf#Inventor V2.0 ascii\nCube{}",
            &["byte-order-mark"],
        ),
        (b" \n#Inventor V1.0 ascii\nCube{}", &["late-header"]),
        (b"Cube{}", &["no-header"]),
        (b"#Inventor V3.7 ascii\nCube{}", &["unknown-version"]),
    ];
    for (bytes, codes) in rows {
        let parsed = parse(bytes);
        assert_eq!(brief(&parsed.tree), "Cube{} ", "{}", text_of(bytes));
        let found: Vec<&str> = parsed.problems.iter().map(|p| p.code).collect();
        assert_eq!(found, codes, "{}", text_of(bytes));
    }
}

#[test]
fn long_lists_turn_into_floats_late() {
    let mut text = String::from("A { f [ ");
    (0..1000).for_each(|i| write!(text, "{i}, ").unwrap());
    text.push_str("0.5 1e3 010 ] }");
    let parsed = parse(text.as_bytes());
    let Some(Child::Node(id)) = parsed.tree.children_of_root().first() else {
        panic!()
    };
    let Some(Item::Field(f)) = parsed.tree.items(*id).first() else {
        panic!()
    };
    let Value::Numbers {
        numbers,
        octal,
        span,
        ..
    } = &parsed.tree.field(*f).value
    else {
        panic!()
    };
    let floats = parsed.tree.floats(numbers).unwrap();
    assert_eq!(floats.len(), 1003);
    assert_eq!(floats[..1000], (0..1000).map(f64::from).collect::<Vec<_>>());
    assert_eq!(floats[1000..], [0.5, 1000.0, 10.0]);
    assert!(octal);
    assert_eq!(parsed.tree.octal_ints(*span)[1002], 8);
}

/// Runs of numbers of all lengths, against the standard library's parser.
#[test]
fn runs_round_like_the_standard_library() {
    let mut seed = 0x2545_f491_4f6c_dd1d_u64;
    let mut random = move |below: u64| {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        seed % below
    };
    for floats in [false, true] {
        let mut text = String::from("A { f [ ");
        let mut expected = Vec::new();
        for i in 0..50_000 {
            let sign = ["", "-", "+"][random(3) as usize];
            let digits = random(12) as u32;
            let whole = random(10_u64.pow(digits.max(1))).min(2_000_000_000);
            let token = match (floats, random(3)) {
                (true, 0) => format!("{sign}{whole}.{}", random(10_u64.pow(digits + 1))),
                (true, 1) => format!(
                    "{sign}.{:0width$}e{}",
                    whole,
                    random(9),
                    width = digits as usize
                ),
                _ => format!("{sign}{whole}"),
            };
            expected.push(token.parse::<f64>().unwrap());
            let separators = [" ", ", ", ",", "\n          ", " # c\n", "\t,\r\n"];
            text.push_str(&token);
            text.push_str(separators[if i == 0 { 1 } else { random(6) as usize }]);
        }
        text.push_str(" ] }");
        let parsed = parse(text.as_bytes());
        let Some(Child::Node(id)) = parsed.tree.children_of_root().first() else {
            panic!()
        };
        let Some(Item::Field(f)) = parsed.tree.items(*id).first() else {
            panic!()
        };
        let Value::Numbers { numbers, .. } = &parsed.tree.field(*f).value else {
            panic!()
        };
        let found: Vec<f64> = match parsed.tree.ints(numbers) {
            Some(ints) => ints.iter().map(|&i| f64::from(i)).collect(),
            None => parsed.tree.floats(numbers).unwrap().to_vec(),
        };
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!(found, expected);
        }
    }
}

#[test]
fn depth_is_limited() {
    let text = "A{".repeat(5000);
    let parsed = parse(text.as_bytes());
    assert!(parsed.problems.iter().any(|p| p.code == "too-deep"));
    assert!(parsed.tree.node_count() <= 1001);
}

/// What is marked, and the line named in the hint.
#[test]
fn a_missing_brace_is_looked_for_by_indentation() {
    let rows = [
        // Cut off.
        ("A {\n  B {\n  }\n", "A", None),
        ("A {\n  B {\n    C {\n    }\n", "A", None),
        // B is open: its line 4 belongs to A.
        ("A {\n  B {\n    x 1\n}", "B", Some(4)),
        ("A {\n  B {\n    C {\n      x 1\n  }\n}\n", "C", Some(5)),
        ("A {\n\tB {\n\t\tC { x 1\n\t}\n\tD { }\n}\n", "C", Some(4)),
        ("A {\r  DEF b B {\r    x 1\r  C {\r  }\r}", "B", Some(6)),
        // Fields count as their lines do.
        ("A {\n  p P {\n    x 1\n}", "P", Some(4)),
        // Nothing to go by: no indentation, one line, tabs against blanks.
        ("A {\nB {\nC {\n}\n}", "A", None),
        ("  A { B { C { } }", "A", None),
        ("A {\n  B {\n    C {\n\t}\n  }\n", "A", None),
        ("A {\n  B {\nx 1 }\n", "A", None),
    ];
    for (text, marked, line) in rows {
        let problems = parse(text.as_bytes()).problems;
        let found: Vec<_> = (problems.iter())
            .filter(|p| p.code == "missing-brace")
            .collect();
        assert_eq!(found.len(), 1, "{text:?}");
        assert_eq!(&text[found[0].span.range()], marked, "{text:?}");
        let named = found[0].hint.split_once(" in line ");
        let named = named.and_then(|(_, rest)| rest.split_once(','));
        let named = named.map(|(digits, _)| digits.parse::<u32>().unwrap());
        assert_eq!(named, line, "{text:?}: {}", found[0].hint);
    }
}

#[test]
fn what_is_said_again_and_again_is_said_once() {
    let text = b"#Inventor V2.1 ascii\n) ) Cube { widht 1 } ) Cube { widht 2 }";
    let parsed = parse(text);
    assert!(parsed.problems.len() > 2);
    let name = "a.iv".into();
    let source = crate::Source {
        name: &name,
        file: 0,
        bytes: text,
    };
    let said = source.diagnostics(parsed.problems);
    let messages: Vec<(u32, u32, &str)> = said
        .iter()
        .map(|d| (d.pos.line, d.pos.column, &*d.message))
        .collect();
    assert_eq!(
        messages,
        [(2, 1, "a node was expected here (3 times, first here)")]
    );
}
