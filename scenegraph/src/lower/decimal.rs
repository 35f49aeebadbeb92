//! Numbers written with a decimal comma (`1,5`), which read as two each. A guess, for hints only.

/// Longest part of a value that is looked at.
const REACH: usize = 1000;

/// Whether a field looks as if its numbers had decimal commas: no word of it has more than one
/// comma between digits, and some have one. Lists without blanks (`0,0,1`) do not look so.
pub(super) fn has_decimal_commas(field: &[u8]) -> bool {
    let field = &field[..field.len().min(REACH)];
    let commas_between_digits = |word: &[u8]| {
        let threes = word.windows(3);
        threes
            .filter(|w| w[1] == b',' && w[0].is_ascii_digit() && w[2].is_ascii_digit())
            .count()
    };
    let words = field.split(u8::is_ascii_whitespace);
    words.map(commas_between_digits).max() == Some(1)
}

#[cfg(test)]
mod tests {
    use super::has_decimal_commas;

    #[test]
    fn words_with_one_comma_each_look_like_decimal_commas() {
        let rows: [(&str, bool); 9] = [
            ("width 2,5", true),
            ("translation 1,5 2,0 -3,0", true),
            ("translation 1,5 2 3", true),
            ("point [ 1,5 2,0 3,25, 4,0 5,5 6 ]", true),
            ("point [0,0,0,1,1]", false),
            ("point [ 0 0 0, 1 1 ]", false),
            ("point [ 0 0 0 ,1 1 ]", false),
            ("translation 1.5 2.5", false),
            ("", false),
        ];
        for (text, want) in rows {
            assert_eq!(has_decimal_commas(text.as_bytes()), want, "{text}");
        }
    }
}
