//! Values from one type of field to another, as far as Inventor converts them: numbers, integers
//! and truth values into each other and from and to text; values of as many numbers into each
//! other; a list gives its first value, a value is a list of one.

use std::sync::Arc;

use crate::graph::FieldValue;
use crate::registry::FieldType;

/// The value for a field of this type; `None` if it cannot be one.
pub fn to_type(value: &FieldValue, to: FieldType) -> Option<FieldValue> {
    use FieldType as T;
    let one = |n: usize, size: usize| if to.is_multiple() { n } else { size.min(n) };
    match to {
        T::SFBool | T::MFBool => scalars(value)?.first().map(|v| FieldValue::Bool(*v != 0.0)),
        T::SFEnum | T::SFBitMask => match value {
            FieldValue::Word(word) => Some(FieldValue::Word(*word)),
            _ => None,
        },
        T::SFString | T::SFName | T::MFString | T::MFName => {
            let texts = texts(value)?;
            let count = one(texts.len(), 1);
            (count > 0).then(|| FieldValue::Texts(texts[..count].to_vec()))
        }
        T::SFNode | T::MFNode | T::SFImage => match value {
            FieldValue::Nodes(_) if to != T::SFImage => Some(value.clone()),
            FieldValue::Image(_) if to == T::SFImage => Some(value.clone()),
            _ => None,
        },
        _ if to.tuple_size() == 0 => None,
        _ if to.tuple_size() == 1 => {
            let numbers = scalars(value)?;
            let numbers = &numbers[..one(numbers.len(), 1)];
            if numbers.is_empty() && !to.is_multiple() {
                return None;
            }
            Some(if to.is_integer() {
                // The cast saturates, and takes NaN to 0.
                let ints: Vec<i32> = numbers.iter().map(|&v| v as i64 as i32).collect();
                match ints[..] {
                    [only] => FieldValue::Int(only),
                    _ => FieldValue::Ints(ints.into()),
                }
            } else {
                FieldValue::from_numbers(numbers)
            })
        }
        _ => {
            let (size, numbers) = (to.tuple_size(), value.numbers());
            let fits = numbers.len().is_multiple_of(size)
                && (numbers.len() == size || to.is_multiple() || numbers.len() > size);
            let count = one(numbers.len(), size);
            (fits && count > 0).then(|| FieldValue::from_numbers(&numbers[..count]))
        }
    }
}

/// The value as single numbers.
fn scalars(value: &FieldValue) -> Option<Vec<f64>> {
    Some(match value {
        FieldValue::Bool(flag) => vec![f64::from(u8::from(*flag))],
        FieldValue::Int(_) | FieldValue::Ints(_) => {
            value.ints().iter().map(|&i| f64::from(i)).collect()
        }
        FieldValue::Few(..) | FieldValue::Many(_) => value.numbers().to_vec(),
        FieldValue::Texts(texts) => {
            let numbers: Result<Vec<f64>, _> = texts.iter().map(|t| t.trim().parse()).collect();
            let numbers = numbers.ok()?;
            numbers.iter().all(|v| v.is_finite()).then_some(numbers)?
        }
        _ => return None,
    })
}

fn texts(value: &FieldValue) -> Option<Vec<Arc<str>>> {
    Some(match value {
        FieldValue::Texts(texts) => texts.clone(),
        FieldValue::Bool(flag) => vec![if *flag { "TRUE" } else { "FALSE" }.into()],
        _ => {
            let numbers = scalars(value)?;
            numbers.iter().map(|v| v.to_string().into()).collect()
        }
    })
}
