//! Colours behind the model, by name or number.

/// Top and bottom, display-referred, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Background(pub [[f64; 3]; 2]);

/// Lexolights' colours, by its names.
pub const NAMED: [(&str, [f64; 3]); 7] = [
    ("black", [0.0; 3]),
    ("dark grey", [0.25; 3]),
    ("grey", [0.5; 3]),
    ("light grey", [0.75; 3]),
    ("white", [1.0; 3]),
    ("griseous", [0.4, 0.4, 0.6]),
    ("tan", [194.0 / 256.0, 186.0 / 256.0, 150.0 / 256.0]),
];

/// Reads one colour, or two with a comma between them.
///
/// # Errors
///
/// Says which word is no colour, and lists those with a name.
pub fn parse(text: &str) -> Result<Background, String> {
    let (top, bottom) = text.split_once(',').unwrap_or((text, text));
    Ok(Background([color(top)?, color(bottom)?]))
}

fn color(text: &str) -> Result<[f64; 3], String> {
    let word = text.trim().to_ascii_lowercase().replace(['-', '_'], " ");
    // The other spelling is as usual.
    let name = word.replace("gray", "grey");
    let named = NAMED.iter().find(|(known, _)| *known == name);
    named
        .map(|(_, color)| *color)
        .or_else(|| from_hex(&word))
        .ok_or_else(|| {
            let names: Vec<&str> = NAMED.iter().map(|(name, _)| *name).collect();
            format!(
                "`{}` is no colour; it is #rrggbb or one of {}",
                text.trim(),
                names.join(", ")
            )
        })
}

fn from_hex(word: &str) -> Option<[f64; 3]> {
    let digits = word.strip_prefix('#')?;
    // `from_str_radix` takes a sign.
    if digits.len() != 6 || !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    let number = u32::from_str_radix(digits, 16).ok()?;
    let [_, channels @ ..] = number.to_be_bytes();
    Some(channels.map(|channel| f64::from(channel) / 255.0))
}
