//! Outputs of engines from their inputs, as they are before time runs or anything happens.
//!
//! An engine of lists gives a list as long as its longest input; shorter ones go on with their last
//! value (SoEngine in the Inventor Reference).

use glam::{DMat3, DMat4, DQuat, DVec3, DVec4};

use super::calculator;
use crate::graph::{FieldValue, Node};
use crate::registry::Class;

/// Looks up an input that is in no class's list.
type Input<'i> = dyn Fn(&str) -> Option<FieldValue> + 'i;

/// Longest list that an engine makes.
const MAX_LENGTH: usize = 100_000;

/// An output; `None` if there is none of this name, or if it waits for time or events.
pub fn output(engine: &Node, name: &str, input: &Input<'_>) -> Option<FieldValue> {
    let numbers = |field: &str| engine.numbers(field);
    let class = engine.class()?;
    let is = |wanted: &str| (name == wanted).then_some(());
    match class {
        Class::ComposeVec2f => is("vector").map(|()| compose(&[numbers("x"), numbers("y")])),
        Class::ComposeVec3f => {
            is("vector").map(|()| compose(&[numbers("x"), numbers("y"), numbers("z")]))
        }
        Class::ComposeVec4f => is("vector")
            .map(|()| compose(&[numbers("x"), numbers("y"), numbers("z"), numbers("w")])),
        Class::DecomposeVec2f => part(numbers("vector"), 2, "xy", name),
        Class::DecomposeVec3f => part(numbers("vector"), 3, "xyz", name),
        Class::DecomposeVec4f => part(numbers("vector"), 4, "xyzw", name),
        Class::ComposeRotation => is("rotation").map(|()| {
            each(&[(numbers("axis"), 3), (numbers("angle"), 1)], |v| {
                vec![v[0][0], v[0][1], v[0][2], v[1][0]]
            })
        }),
        Class::ComposeRotationFromTo => is("rotation").map(|()| {
            each(&[(numbers("from"), 3), (numbers("to"), 3)], |v| {
                let unit = |v: &[f64]| DVec3::from_slice(v).normalize_or(DVec3::Z);
                axis_angle(DQuat::from_rotation_arc(unit(v[0]), unit(v[1])))
            })
        }),
        Class::DecomposeRotation => {
            let axis = each(&[(numbers("rotation"), 4)], |v| v[0][..3].to_vec());
            let angle = each(&[(numbers("rotation"), 4)], |v| vec![v[0][3]]);
            match name {
                "axis" => Some(axis),
                "angle" => Some(angle),
                _ => None,
            }
        }
        Class::ComposeMatrix => is("matrix").map(|()| {
            let parts = [
                (numbers("translation"), 3),
                (numbers("rotation"), 4),
                (numbers("scaleFactor"), 3),
                (numbers("scaleOrientation"), 4),
                (numbers("center"), 3),
            ];
            each(&parts, |v| matrix(v).to_cols_array().to_vec())
        }),
        Class::DecomposeMatrix => super::decompose::output(engine, name),
        Class::TransformVec3f => transformed(engine, name),
        Class::InterpolateFloat => is("output").map(|()| interpolated(engine, 1)),
        Class::InterpolateVec2f => is("output").map(|()| interpolated(engine, 2)),
        Class::InterpolateVec3f => is("output").map(|()| interpolated(engine, 3)),
        Class::InterpolateVec4f => is("output").map(|()| interpolated(engine, 4)),
        Class::InterpolateRotation => is("output").map(|()| slerped(engine)),
        Class::BoolOperation => bool_operation(engine, name),
        Class::Gate => engine.flag("enable").then(|| input("input"))?,
        Class::SelectOne => {
            is("output")?;
            let index = engine.int("index");
            (0..=9)
                .contains(&index)
                .then(|| input(&format!("input{index}")))?
        }
        Class::Concatenate => is("output").and_then(|()| concatenated(input)),
        Class::Calculator => calculator::output(engine, name),
        // What runs with time stands at its beginning.
        Class::Counter | Class::TimeCounter => {
            is("output").map(|()| FieldValue::Int(engine.int("min")))
        }
        Class::ElapsedTime => is("timeOut").map(|()| FieldValue::from_numbers(&[0.0])),
        Class::OneShot => match name {
            "timeOut" | "ramp" => Some(FieldValue::from_numbers(&[0.0])),
            "isActive" => Some(FieldValue::Bool(false)),
            _ => None,
        },
        Class::OnOff => match name {
            "isOn" => Some(FieldValue::Bool(false)),
            "isOff" => Some(FieldValue::Bool(true)),
            _ => None,
        },
        _ => None,
    }
}

/// Calls `make` with one tuple of each list at a time.
pub(super) fn each(lists: &[(&[f64], usize)], make: impl Fn(&[&[f64]]) -> Vec<f64>) -> FieldValue {
    let lengths = lists.iter().map(|(list, size)| list.len() / size);
    let count = lengths.clone().max().unwrap_or(0).min(MAX_LENGTH);
    if lengths.min().unwrap_or(0) == 0 {
        return FieldValue::from_numbers(&[]);
    }
    let mut out = Vec::new();
    for i in 0..count {
        let tuple = |&(list, size): &(&'_ [f64], usize)| -> std::ops::Range<usize> {
            let at = i.min(list.len() / size - 1);
            at * size..(at + 1) * size
        };
        let tuples: Vec<&[f64]> = lists.iter().map(|pair| &pair.0[tuple(pair)]).collect();
        out.extend(make(&tuples));
    }
    FieldValue::from_numbers(&out)
}

fn compose(lists: &[&[f64]]) -> FieldValue {
    let lists: Vec<(&[f64], usize)> = lists.iter().map(|list| (*list, 1)).collect();
    each(&lists, |v| v.iter().map(|n| n[0]).collect())
}

fn part(list: &[f64], size: usize, names: &str, name: &str) -> Option<FieldValue> {
    let index = names.find(name).filter(|_| name.len() == 1)?;
    Some(each(&[(list, size)], |v| vec![v[0][index]]))
}

/// Axis and angle, as fields have them, as a rotation.
fn rotation(v: &[f64]) -> DQuat {
    let axis = DVec3::new(v[0], v[1], v[2]).try_normalize();
    axis.map_or(DQuat::IDENTITY, |axis| DQuat::from_axis_angle(axis, v[3]))
}

pub(super) fn axis_angle(q: DQuat) -> Vec<f64> {
    let (axis, angle_rad) = q.to_axis_angle();
    vec![axis.x, axis.y, axis.z, angle_rad]
}

/// A Transform's matrix in Inventor's order of numbers, which is that of glam's columns.
fn matrix(v: &[&[f64]]) -> DMat4 {
    let (translation, center) = (DVec3::from_slice(v[0]), DVec3::from_slice(v[4]));
    let turned = DMat3::from_quat(rotation(v[1]));
    let oriented = DMat3::from_quat(rotation(v[3]));
    let scale = DMat3::from_diagonal(DVec3::from_slice(v[2]));
    let linear = turned * oriented * scale * oriented.transpose();
    let mut out = DMat4::from_mat3(linear);
    out.w_axis = (translation + center - linear * center).extend(1.0);
    out
}

fn transformed(engine: &Node, name: &str) -> Option<FieldValue> {
    let normal = match name {
        "point" | "direction" => false,
        "normalDirection" => true,
        _ => return None,
    };
    let w = if name == "point" { 1.0 } else { 0.0 };
    let lists = [
        (engine.numbers("vector"), 3),
        (engine.numbers("matrix"), 16),
    ];
    Some(each(&lists, |v| {
        let mut numbers = [0.0; 16];
        numbers.copy_from_slice(v[1]);
        let m = DMat4::from_cols_array(&numbers);
        let p = DVec3::from_slice(v[0]);
        let q: DVec4 = if normal {
            let linear = DMat3::from_mat4(m).inverse().transpose();
            (linear * p).extend(0.0)
        } else {
            m * p.extend(w)
        };
        let q = if w == 1.0 && q.w != 0.0 { q / q.w } else { q };
        let q = if q.is_finite() { q } else { DVec4::ZERO };
        vec![q.x, q.y, q.z]
    }))
}

fn interpolated(engine: &Node, size: usize) -> FieldValue {
    let alpha = engine.number("alpha").clamp(0.0, 1.0);
    let lists = [
        (engine.numbers("input0"), size),
        (engine.numbers("input1"), size),
    ];
    each(&lists, |v| {
        let pairs = v[0].iter().zip(v[1]);
        pairs.map(|(a, b)| a * (1.0 - alpha) + b * alpha).collect()
    })
}

fn slerped(engine: &Node) -> FieldValue {
    let alpha = engine.number("alpha").clamp(0.0, 1.0);
    let lists = [(engine.numbers("input0"), 4), (engine.numbers("input1"), 4)];
    each(&lists, |v| {
        axis_angle(rotation(v[0]).slerp(rotation(v[1]), alpha))
    })
}

fn bool_operation(engine: &Node, name: &str) -> Option<FieldValue> {
    let (a, b) = (engine.flag("a"), engine.flag("b"));
    let result = match engine.word("operation") {
        "CLEAR" => false,
        "SET" => true,
        "A" => a,
        "NOT_A" => !a,
        "B" => b,
        "NOT_B" => !b,
        "A_OR_B" => a || b,
        "NOT_A_OR_B" => !a || b,
        "A_OR_NOT_B" => a || !b,
        "NOT_A_OR_NOT_B" => !a || !b,
        "A_AND_B" => a && b,
        "NOT_A_AND_B" => !a && b,
        "A_AND_NOT_B" => a && !b,
        "NOT_A_AND_NOT_B" => !a && !b,
        "A_EQUALS_B" => a == b,
        "A_NOT_EQUALS_B" => a != b,
        _ => return None,
    };
    match name {
        "output" => Some(FieldValue::Bool(result)),
        "inverse" => Some(FieldValue::Bool(!result)),
        _ => None,
    }
}

fn concatenated(input: &Input<'_>) -> Option<FieldValue> {
    let all: Vec<FieldValue> = (0..10)
        .filter_map(|i| input(&format!("input{i}")))
        .collect();
    let texts: Vec<_> = all.iter().flat_map(FieldValue::texts).cloned().collect();
    let ints: Vec<i32> = all.iter().flat_map(FieldValue::ints).copied().collect();
    let numbers: Vec<f64> = all.iter().flat_map(FieldValue::numbers).copied().collect();
    match (texts.is_empty(), ints.is_empty(), numbers.is_empty()) {
        (false, ..) => Some(FieldValue::Texts(texts)),
        (_, false, _) => Some(FieldValue::Ints(ints.into())),
        (.., false) => Some(FieldValue::from_numbers(&numbers)),
        _ => None,
    }
}
