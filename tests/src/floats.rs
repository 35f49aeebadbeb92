//! The yardstick for readers of text: all numbers of a file turned into f32, and nothing else.

/// How many there are, and their sum, so that no compiler leaves the work out.
pub fn sum(text: &[u8]) -> (usize, f64) {
    let mut values: Vec<f32> = Vec::new();
    let mut rest = text;
    while let Some(&first) = rest.first() {
        let begins_number = first.is_ascii_digit() || b"-+.".contains(&first);
        let parsed = if begins_number {
            fast_float2::parse_partial::<f32, _>(rest).ok()
        } else {
            None
        };
        let length = match parsed {
            Some((value, length)) => {
                values.push(value);
                length
            }
            None if first.is_ascii_alphabetic() => word(rest),
            None => 1,
        };
        rest = rest.get(length.max(1)..).unwrap_or_default();
    }
    let sum = values.iter().copied().map(f64::from).sum();
    (values.len(), sum)
}

/// Length of a word, with the digits in it.
fn word(text: &[u8]) -> usize {
    let end = text.iter().position(u8::is_ascii_whitespace);
    end.unwrap_or(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_numbers() {
        for (text, want) in [
            ("", (0, 0.0)),
            ("1 2.5,-4", (3, -0.5)),
            ("Coordinate3 { point [ 1e2 .5 -1, ] }", (3, 99.5)),
            ("- + . 7", (1, 7.0)),
        ] {
            assert_eq!(sum(text.as_bytes()), want, "{text}");
        }
    }
}
