//! Connected fields against the values they must have.

use std::path::Path;

use crate::graph::FieldValue;
use crate::registry::Class;
use crate::{FileLoader, Graph, load};

fn read(body: &str) -> (Graph, Vec<&'static str>) {
    let text = format!("#Inventor V2.1 ascii\n{body}");
    let graph = load(text.as_bytes(), "t.iv", Path::new(""), &FileLoader::new([]));
    let codes = graph.diagnostics.iter().map(|d| d.code).collect();
    (graph, codes)
}

/// The value of a field of the first node of a class.
fn value(graph: &Graph, class: Class, field: &str) -> FieldValue {
    let node = graph.nodes().iter().find(|n| n.class() == Some(class));
    node.unwrap().value(field).clone()
}

#[test]
fn engines_give_their_values() {
    // What `translation` is connected to, and what it then is.
    let rows: &[(&str, [f64; 3])] = &[
        ("ComposeVec3f { x 1 y 2 z 3 } . vector", [1.0, 2.0, 3.0]),
        (
            "Translation { translation 4 5 6 } . translation",
            [4.0, 5.0, 6.0],
        ),
        (
            "Coordinate3 { point [ 7 8 9, 1 1 1 ] } . point",
            [7.0, 8.0, 9.0],
        ),
        (
            "Calculator { a 2 A 1 2 3 expression \"oA = A * a + vec3f(1, 0, 0)\" } . oA",
            [3.0, 4.0, 6.0],
        ),
        (
            "Calculator { expression \"ta = 1 + 2 * 3; oA[1] = ta; oA[2] = -ta / 2\" } . oA",
            [0.0, 7.0, -3.5],
        ),
        (
            "Calculator { expression [ \"tA = cross(vec3f(1,0,0), vec3f(0,1,0))\", \"oB = tA * (2 > 1 ? 5 : 6)\" ] } . oB",
            [0.0, 0.0, 5.0],
        ),
        (
            "Calculator { A 3 0 4 expression \"oA = vec3f(length(A), dot(A, A), normalize(A)[0])\" } . oA",
            [5.0, 25.0, 0.6],
        ),
        (
            "Calculator { expression \"oA = vec3f(sqrt(16), pow(2, 10), fabs(-1.5e0))\" } . oA",
            [4.0, 1024.0, 1.5],
        ),
        (
            "Calculator { a 1 b 0 expression \"oA = vec3f(a && !b, a == b || b, 7 % 4)\" } . oA",
            [1.0, 0.0, 3.0],
        ),
        (
            "InterpolateVec3f { alpha 0.25 input0 0 0 0 input1 4 8 12 } . output",
            [1.0, 2.0, 3.0],
        ),
        (
            "Gate { type \"MFVec3f\" enable TRUE input 1 2 3 } . output",
            [1.0, 2.0, 3.0],
        ),
        (
            "SelectOne { type \"MFVec3f\" index 1 input0 1 1 1 input1 2 2 2 } . output",
            [2.0, 2.0, 2.0],
        ),
        (
            "Concatenate { type \"MFVec3f\" input0 9 8 7 input1 2 2 2 } . output",
            [9.0, 8.0, 7.0],
        ),
        (
            "TransformVec3f { vector 1 0 0 matrix 2 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1 } . point",
            [7.0, 6.0, 7.0],
        ),
        (
            "TransformVec3f { vector 1 0 0 matrix 2 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1 } . direction",
            [2.0, 0.0, 0.0],
        ),
        (
            "DecomposeMatrix { matrix 0 2 0 0 -3 0 0 0 0 0 4 0 5 6 7 1 } . translation",
            [5.0, 6.0, 7.0],
        ),
        (
            "DecomposeMatrix { matrix 0 2 0 0 -3 0 0 0 0 0 4 0 5 6 7 1 } . scaleFactor",
            [2.0, 3.0, 4.0],
        ),
        (
            "DecomposeMatrix { matrix 0 2 0 0 -3 0 0 0 0 0 4 0 5 6 7 1 center 1 0 0 } . translation",
            [4.0, 8.0, 7.0],
        ),
        (
            "DecomposeMatrix { matrix -1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 } . scaleFactor",
            [-1.0, -1.0, -1.0],
        ),
        (
            "ComputeBoundingBox { node Cube { width 4 } } . min",
            [-2.0, -1.0, -1.0],
        ),
        (
            "ComputeBoundingBox { node Group { Translation { translation 1 2 3 } Sphere { } \
             DrawStyle { style INVISIBLE } Translation { translation 10 0 0 } Cube { } } } . max",
            [12.0, 3.0, 4.0],
        ),
        (
            "ComputeBoundingBox { node Separator { Translation { translation 1 0 0 } \
             Cube { width = Cone { height 8 } . height } } } . boxCenter",
            [1.0, 0.0, 0.0],
        ),
        (
            "ComputeBoundingBox { node Separator { Cube { } Separator { Cube { } \
             Translation { translation 8 0 0 } Cube { } } } } . objectCenter",
            [2.0, 0.0, 0.0],
        ),
        (
            "ComputeBoundingBox { node ShapeKit { appearance.material Material { } \
             transform Transform { translation 0 0 5 } } } . max",
            [1.0, 1.0, 6.0],
        ),
        (
            "ComputeBoundingBox { node Group { Cube { height = ComputeBoundingBox { \
             node Sphere { radius 3 } } . max } } } . max",
            [1.0, 1.5, 1.0],
        ),
        ("ComputeBoundingBox { } . max", [0.0, 0.0, 0.0]),
        (
            "ComposeVec3f { x = DecomposeVec3f { vector 7 8 9 } . z y = TimeCounter { min 4 } . output } . vector",
            [9.0, 4.0, 0.0],
        ),
    ];
    for (master, wanted) in rows {
        let (graph, codes) = read(&format!(
            "Separator {{ Transform {{ translation = {master} }} }}"
        ));
        let got = value(&graph, Class::Transform, "translation");
        let near = got
            .numbers()
            .iter()
            .zip(wanted)
            .all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(near && got.numbers().len() == 3, "{master}: {got:?}");
        assert_eq!(codes, [] as [&str; 0], "{master}");
    }
}

#[test]
fn rotations_and_matrices_are_put_together() {
    let (graph, _) = read(
        "Rotation { rotation = ComposeRotation { axis 0 0 1 angle 0.5 } . rotation } \
         MatrixTransform { matrix = ComposeMatrix { translation 1 2 3 scaleFactor 2 2 2 \
         center 1 0 0 } . matrix }",
    );
    let rotation = value(&graph, Class::Rotation, "rotation");
    assert_eq!(rotation.numbers(), [0.0, 0.0, 1.0, 0.5]);
    let matrix = value(&graph, Class::MatrixTransform, "matrix");
    let wanted = [
        2.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 3.0, 1.0,
    ];
    assert_eq!(matrix.numbers(), wanted);
    let (graph, _) =
        read("Rotation { rotation = ComposeRotationFromTo { from 1 0 0 to 0 1 0 } . rotation }");
    let turned = value(&graph, Class::Rotation, "rotation");
    let wanted = [0.0, 0.0, 1.0, std::f64::consts::FRAC_PI_2];
    let near = turned
        .numbers()
        .iter()
        .zip(wanted)
        .all(|(a, b)| (a - b).abs() < 1e-12);
    assert!(near, "{turned:?}");
}

#[test]
fn the_parts_of_a_matrix_make_it_again() {
    let matrices = [
        "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1",
        "0 2 0 0 -3 0 0 0 0 0 4 0 5 6 7 1",
        "-2 0 0 0 0 3 0 0 0 0 4 0 1 1 1 1",
        "1 0.5 0 0 0 1 0.25 0 0.125 0 1 0 5 6 7 1",
        "1 0.5 0 0 0 1 0.25 0 0.125 0 -3 0 5 6 7 1",
    ];
    for matrix in matrices {
        for center in ["0 0 0", "1 -2 3"] {
            let text = format!(
                "DEF d DecomposeMatrix {{ matrix {matrix} center {center} }} \
                 MatrixTransform {{ matrix = ComposeMatrix {{ translation = USE d . translation \
                 rotation = USE d . rotation scaleFactor = USE d . scaleFactor \
                 scaleOrientation = USE d . scaleOrientation center {center} }} . matrix }}"
            );
            let (graph, codes) = read(&text);
            let got = value(&graph, Class::MatrixTransform, "matrix");
            let wanted: Vec<f64> = matrix.split(' ').map(|n| n.parse().unwrap()).collect();
            let near = got.numbers().iter().zip(&wanted);
            let near = near.filter(|(a, b)| (*a - *b).abs() < 1e-12).count() == 16;
            assert!(near, "{matrix}, {center}: {got:?}");
            assert_eq!(codes, [] as [&str; 0], "{matrix}, {center}");
        }
    }
}

#[test]
fn values_take_the_type_of_their_field() {
    let texts = |t: &str| FieldValue::Texts(vec![t.into()]);
    let rows: &[(&str, &str, Class, &str, FieldValue)] = &[
        (
            "float to text",
            "Text3 { string = Cube { width 1.5 } . width }",
            Class::Text3,
            "string",
            texts("1.5"),
        ),
        (
            "text to float",
            "Cube { width = Text3 { string \"2.5\" } . string }",
            Class::Cube,
            "width",
            FieldValue::from_numbers(&[2.5]),
        ),
        (
            "float to int",
            "Switch { whichChild = Cube { width 2.9 } . width }",
            Class::Switch,
            "whichChild",
            FieldValue::Int(2),
        ),
        (
            "int to float",
            "Cube { width = Switch { whichChild 3 } . whichChild }",
            Class::Cube,
            "width",
            FieldValue::from_numbers(&[3.0]),
        ),
        (
            "bool to int",
            "Switch { whichChild = BoolOperation { a TRUE } . output }",
            Class::Switch,
            "whichChild",
            FieldValue::Int(1),
        ),
        (
            "int to bool",
            "PointLight { on = Switch { whichChild 0 } . whichChild }",
            Class::PointLight,
            "on",
            FieldValue::Bool(false),
        ),
        (
            "color to vector",
            "Translation { translation = PointLight { color 1 2 3 } . color }",
            Class::Translation,
            "translation",
            FieldValue::from_numbers(&[1.0, 2.0, 3.0]),
        ),
        (
            "list to list",
            "Coordinate3 { point = Normal { vector [ 1 2 3, 4 5 6 ] } . vector }",
            Class::Coordinate3,
            "point",
            FieldValue::from_numbers(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]),
        ),
    ];
    for (name, body, class, field, wanted) in rows {
        let (graph, codes) = read(body);
        assert_eq!(value(&graph, *class, field), *wanted, "{name}");
        assert_eq!(codes, [] as [&str; 0], "{name}");
    }
}

#[test]
fn what_is_not_known_beforehand_is_said() {
    let deep = format!(
        "Calculator {{ expression \"oa = {}1{}\" }} . oa",
        "(".repeat(500),
        ")".repeat(500)
    );
    let rows: Vec<(&str, String, f64, &[&str])> = vec![
        (
            "its own value",
            "Cube { width 3 = ComposeVec2f { } . vector }".into(),
            3.0,
            &["connection"],
        ),
        (
            "no output",
            "Cube { width = Sphere { } . colour }".into(),
            2.0,
            &["connection"],
        ),
        (
            "the first number of a vector",
            "Cube { width = ComposeVec3f { } . vector }".into(),
            0.0,
            &[],
        ),
        (
            "node for a number",
            "Cube { width = Sphere { radius = USE none . x } . radius }".into(),
            1.0,
            &["unknown-name"],
        ),
        (
            "a box around a path",
            "Cube { width = ComputeBoundingBox { path Path { } } . max }".into(),
            2.0,
            &["unknown-class", "connection"],
        ),
        (
            "closed gate",
            "Cube { width = Gate { type \"MFFloat\" input 7 } . output }".into(),
            2.0,
            &["connection"],
        ),
        (
            "bad expression",
            "Cube { width = Calculator { expression \"oa = 1 +\" } . oa }".into(),
            2.0,
            &["connection"],
        ),
        (
            "no output of it",
            "Cube { width = Calculator { expression \"ta = 1\" } . ta }".into(),
            2.0,
            &["connection"],
        ),
        (
            "deep",
            format!("Cube {{ width = {deep} }}"),
            2.0,
            &["connection"],
        ),
        (
            "a chain",
            "Cube { width = Cone { height = Cylinder { radius 6 } . radius } . height }".into(),
            6.0,
            &[],
        ),
        (
            "time",
            "Cube { width = ElapsedTime { } . timeOut }".into(),
            0.0,
            &[],
        ),
    ];
    for (name, body, wanted, codes) in rows {
        let (graph, said) = read(&body);
        assert_eq!(
            value(&graph, Class::Cube, "width").numbers(),
            [wanted],
            "{name}"
        );
        assert_eq!(said, codes, "{name}");
    }
}
