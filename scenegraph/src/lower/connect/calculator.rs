//! The Calculator's expressions: numbers and vectors, its functions and operators (SoCalculator in
//! the Inventor Reference).
//!
//! ```text
//! statement := name [ "[" number "]" ] "=" expression       several, separated by ";"
//! a … h  A … H  inputs      ta … th  tA … tH  temporaries      oa … od  oA … oD  outputs
//! ```

mod parse;

use std::collections::BTreeMap;

use glam::DVec3;

use crate::graph::{FieldValue, Node};
use parse::{Expression, Statement, parse};

/// Times that all expressions together are calculated, times the length of their text in bytes.
const MAX_WORK: usize = 1_000_000;

/// A number or a vector.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Value {
    Number(f64),
    Vector(DVec3),
}

/// Names by what they hold.
type Names = BTreeMap<String, Value>;

/// The work of calculating all once: it grows with the text of the expressions.
fn round(engine: &Node) -> usize {
    let texts = engine.value("expression").texts();
    texts.iter().map(|text| text.len()).sum::<usize>().max(1)
}

/// The work of an output at the most.
pub fn work(engine: &Node) -> usize {
    let lists = engine
        .fields
        .iter()
        .map(|field| field.value.numbers().len());
    let longest = lists.max().unwrap_or(1).max(1);
    longest
        .saturating_mul(round(engine))
        .min(MAX_WORK + round(engine))
}

/// An output of a Calculator; `None` if an expression cannot be read or none gives it.
pub fn output(engine: &Node, name: &str) -> Option<FieldValue> {
    let texts = engine.value("expression").texts();
    let statements: Option<Vec<Vec<Statement>>> = texts.iter().map(|t| parse(t)).collect();
    let statements: Vec<Statement> = statements?.into_iter().flatten().collect();
    let small: Vec<char> = ('a'..='h').collect();
    let numbers = small.iter().map(|&c| (c, engine.numbers(name_of(c))));
    let numbers: Vec<(char, &[f64])> = numbers.collect();
    let large: Vec<char> = ('A'..='H').collect();
    let vectors = large.iter().map(|&c| (c, engine.numbers(name_of(c))));
    let vectors: Vec<(char, &[f64])> = vectors.collect();
    let lengths = numbers.iter().map(|(_, list)| list.len());
    let lengths = lengths.chain(vectors.iter().map(|(_, list)| list.len() / 3));
    let count = lengths
        .max()
        .unwrap_or(1)
        .clamp(1, MAX_WORK / round(engine) + 1);
    let mut out = Vec::new();
    for i in 0..count {
        let mut names = Names::new();
        for (c, list) in &numbers {
            let value = list.get(i).or(list.last()).copied().unwrap_or(0.0);
            names.insert(c.to_string(), Value::Number(value));
        }
        for (c, list) in &vectors {
            let (tuples, _) = list.as_chunks::<3>();
            let value = tuples.get(i).or(tuples.last()).copied().unwrap_or_default();
            names.insert(c.to_string(), Value::Vector(value.into()));
        }
        for statement in &statements {
            let value = calculate(&statement.value, &names)?;
            assign(&mut names, statement, value)?;
        }
        match names.get(name).filter(|_| name.starts_with('o'))? {
            Value::Number(x) => out.push(finite(*x)),
            Value::Vector(v) => out.extend(v.to_array().map(finite)),
        }
    }
    Some(FieldValue::from_numbers(&out))
}

/// The field of a letter.
fn name_of(c: char) -> &'static str {
    const NAMES: [&str; 16] = [
        "a", "b", "c", "d", "e", "f", "g", "h", "A", "B", "C", "D", "E", "F", "G", "H",
    ];
    let name = NAMES.iter().find(|name| name.starts_with(c));
    name.copied().unwrap_or("a")
}

fn finite(x: f64) -> f64 {
    let limit = f64::from(f32::MAX);
    if x.is_nan() {
        0.0
    } else {
        x.clamp(-limit, limit)
    }
}

/// Whether a name holds a vector: its last letter is large.
fn is_vector(name: &str) -> bool {
    name.ends_with(|c: char| c.is_ascii_uppercase())
}

fn assign(names: &mut Names, statement: &Statement, value: Value) -> Option<()> {
    let name = &statement.name;
    let new = match (statement.index, is_vector(name), value) {
        (Some(index), true, Value::Number(x)) => {
            let Some(Value::Vector(mut v)) = names.get(name).copied().or(Some(ZERO)) else {
                return None;
            };
            *v.as_mut().get_mut(index)? = x;
            Value::Vector(v)
        }
        (None, true, Value::Vector(_)) | (None, false, Value::Number(_)) => value,
        _ => return None,
    };
    names.insert(name.clone(), new);
    Some(())
}

const ZERO: Value = Value::Vector(DVec3::ZERO);

fn calculate(expression: &Expression, names: &Names) -> Option<Value> {
    use Value::{Number, Vector};
    Some(match expression {
        Expression::Number(x) => Number(*x),
        Expression::Name(name) => match names.get(name) {
            Some(value) => *value,
            // Temporaries and outputs begin at zero.
            None if is_vector(name) => ZERO,
            None => Number(0.0),
        },
        Expression::Part(of, index) => match calculate(of, names)? {
            Vector(v) => Number(*v.as_ref().get(*index)?),
            Number(_) => return None,
        },
        Expression::Negative(of) => match calculate(of, names)? {
            Number(x) => Number(-x),
            Vector(v) => Vector(-v),
        },
        Expression::Not(of) => truth(!is_true(calculate(of, names)?)),
        Expression::Choice(parts) => {
            let [condition, yes, no] = &**parts;
            let chosen = if is_true(calculate(condition, names)?) {
                yes
            } else {
                no
            };
            calculate(chosen, names)?
        }
        Expression::Binary(operator, sides) => {
            let [left, right] = &**sides;
            binary(operator, calculate(left, names)?, calculate(right, names)?)?
        }
        Expression::Call(name, arguments) => {
            let values: Option<Vec<Value>> =
                arguments.iter().map(|a| calculate(a, names)).collect();
            call(name, &values?)?
        }
    })
}

fn truth(value: bool) -> Value {
    Value::Number(f64::from(u8::from(value)))
}

fn is_true(value: Value) -> bool {
    value != Value::Number(0.0) && value != ZERO
}

fn binary(operator: &str, left: Value, right: Value) -> Option<Value> {
    use Value::{Number, Vector};
    Some(match (operator, left, right) {
        ("&&", a, b) => truth(is_true(a) && is_true(b)),
        ("||", a, b) => truth(is_true(a) || is_true(b)),
        ("==", a, b) => truth(a == b),
        ("!=", a, b) => truth(a != b),
        ("<", Number(a), Number(b)) => truth(a < b),
        (">", Number(a), Number(b)) => truth(a > b),
        ("<=", Number(a), Number(b)) => truth(a <= b),
        (">=", Number(a), Number(b)) => truth(a >= b),
        ("+", Number(a), Number(b)) => Number(a + b),
        ("-", Number(a), Number(b)) => Number(a - b),
        ("*", Number(a), Number(b)) => Number(a * b),
        ("/", Number(a), Number(b)) => Number(a / b),
        ("%", Number(a), Number(b)) => Number(a % b),
        ("+", Vector(a), Vector(b)) => Vector(a + b),
        ("-", Vector(a), Vector(b)) => Vector(a - b),
        ("*", Vector(v), Number(x)) | ("*", Number(x), Vector(v)) => Vector(v * x),
        ("/", Vector(v), Number(x)) => Vector(v / x),
        _ => return None,
    })
}

fn call(name: &str, values: &[Value]) -> Option<Value> {
    use Value::{Number, Vector};
    Some(match (name, values) {
        ("cos", [Number(x)]) => Number(x.cos()),
        ("sin", [Number(x)]) => Number(x.sin()),
        ("tan", [Number(x)]) => Number(x.tan()),
        ("acos", [Number(x)]) => Number(x.acos()),
        ("asin", [Number(x)]) => Number(x.asin()),
        ("atan", [Number(x)]) => Number(x.atan()),
        ("atan2", [Number(y), Number(x)]) => Number(y.atan2(*x)),
        ("cosh", [Number(x)]) => Number(x.cosh()),
        ("sinh", [Number(x)]) => Number(x.sinh()),
        ("tanh", [Number(x)]) => Number(x.tanh()),
        ("sqrt", [Number(x)]) => Number(x.sqrt()),
        ("pow", [Number(x), Number(y)]) => Number(x.powf(*y)),
        ("exp", [Number(x)]) => Number(x.exp()),
        ("log", [Number(x)]) => Number(x.ln()),
        ("log10", [Number(x)]) => Number(x.log10()),
        ("ceil", [Number(x)]) => Number(x.ceil()),
        ("floor", [Number(x)]) => Number(x.floor()),
        ("fabs", [Number(x)]) => Number(x.abs()),
        ("fmod", [Number(x), Number(y)]) => Number(x % y),
        ("cross", [Vector(a), Vector(b)]) => Vector(a.cross(*b)),
        ("dot", [Vector(a), Vector(b)]) => Number(a.dot(*b)),
        ("length", [Vector(v)]) => Number(v.length()),
        ("normalize", [Vector(v)]) => Vector(v.normalize_or_zero()),
        ("vec3f", [Number(x), Number(y), Number(z)]) => Vector(DVec3::new(*x, *y, *z)),
        // `rand` gives another number each time.
        _ => return None,
    })
}
