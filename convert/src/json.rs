//! A writer of compact JSON into memory: deterministic, and unable to write an invalid number.
//!
//! It is not a document model: values go out in the order of the calls, and the caller pairs
//! every `open` with its `close`.

/// JSON text being written.
pub(crate) struct Json {
    out: Vec<u8>,
    /// Whether the next value or key follows another one in its array or object.
    follows: bool,
    floats: zmij::Buffer,
}

impl Json {
    pub(crate) fn with_capacity(bytes: usize) -> Self {
        Self {
            out: Vec::with_capacity(bytes),
            follows: false,
            floats: zmij::Buffer::new(),
        }
    }

    pub(crate) fn into_bytes(self) -> Vec<u8> {
        self.out
    }

    fn separate(&mut self) {
        if self.follows {
            self.out.push(b',');
        }
        self.follows = true;
    }

    fn open(&mut self, bracket: u8) {
        self.separate();
        self.out.push(bracket);
        self.follows = false;
    }

    fn close(&mut self, bracket: u8) {
        self.out.push(bracket);
        self.follows = true;
    }

    /// A member's name; the next call writes its value. `name` needs no escaping.
    pub(crate) fn key(&mut self, name: &str) -> &mut Self {
        self.separate();
        self.out.push(b'"');
        self.out.extend_from_slice(name.as_bytes());
        self.out.extend_from_slice(b"\":");
        self.follows = false;
        self
    }

    /// `{` … `}` around what `body` writes.
    pub(crate) fn object(&mut self, body: impl FnOnce(&mut Self)) {
        self.open(b'{');
        body(self);
        self.close(b'}');
    }

    /// `[` … `]` around what `body` writes.
    pub(crate) fn array(&mut self, body: impl FnOnce(&mut Self)) {
        self.open(b'[');
        body(self);
        self.close(b']');
    }

    /// A member `name` with an object, left out altogether when `body` writes nothing.
    pub(crate) fn object_unless_empty(&mut self, name: &str, body: impl FnOnce(&mut Self)) {
        let (start, follows) = (self.out.len(), self.follows);
        self.key(name).open(b'{');
        let inside = self.out.len();
        body(self);
        if self.out.len() == inside {
            self.out.truncate(start);
            self.follows = follows;
        } else {
            self.close(b'}');
        }
    }

    /// A member `name` with one value for each item, left out when there are none.
    pub(crate) fn array_unless_empty<T>(
        &mut self,
        name: &str,
        items: impl IntoIterator<Item = T>,
        mut write: impl FnMut(&mut Self, T),
    ) {
        let mut items = items.into_iter().peekable();
        if items.peek().is_some() {
            self.key(name).array(|json| {
                for item in items {
                    write(json, item);
                }
            });
        }
    }

    /// Text that is JSON already.
    pub(crate) fn raw(&mut self, json: &str) {
        self.separate();
        self.out.extend_from_slice(json.as_bytes());
    }

    pub(crate) fn bool(&mut self, value: bool) {
        self.separate();
        self.out
            .extend_from_slice(if value { b"true" } else { b"false" });
    }

    pub(crate) fn u64(&mut self, value: u64) {
        self.separate();
        let mut digits = [0; 20];
        let mut at = digits.len();
        let mut rest = value;
        loop {
            at -= 1;
            digits[at] = b'0' + (rest % 10) as u8;
            rest /= 10;
            if rest == 0 {
                break;
            }
        }
        self.out.extend_from_slice(&digits[at..]);
    }

    pub(crate) fn usize(&mut self, value: usize) {
        self.u64(value as u64);
    }

    /// The shortest text that reads back as the same f64; 0 for what JSON cannot say.
    pub(crate) fn f64(&mut self, value: f64) {
        self.separate();
        if value == 0.0 || !value.is_finite() {
            self.out.push(b'0');
        } else {
            let text = self.floats.format_finite(value);
            self.out.extend_from_slice(shorten(text).as_bytes());
        }
    }

    /// The shortest text that reads back as the same f32; 0 for what JSON cannot say.
    pub(crate) fn f32(&mut self, value: f32) {
        self.separate();
        if value == 0.0 || !value.is_finite() {
            self.out.push(b'0');
        } else {
            let text = self.floats.format_finite(value);
            self.out.extend_from_slice(shorten(text).as_bytes());
        }
    }

    /// A value of an Inventor field: those are f32, so an f64 that is an f32 is written as one.
    pub(crate) fn field(&mut self, value: f64) {
        let narrow = value as f32;
        if f64::from(narrow) == value {
            self.f32(narrow);
        } else {
            self.f64(value);
        }
    }

    pub(crate) fn f64s(&mut self, values: &[f64]) {
        self.array(|json| values.iter().for_each(|&v| json.f64(v)));
    }

    pub(crate) fn f32s(&mut self, values: &[f32]) {
        self.array(|json| values.iter().for_each(|&v| json.f32(v)));
    }

    pub(crate) fn fields(&mut self, values: &[f64]) {
        self.array(|json| values.iter().for_each(|&v| json.field(v)));
    }

    pub(crate) fn str(&mut self, text: &str) {
        self.separate();
        self.out.push(b'"');
        let bytes = text.as_bytes();
        let mut done = 0;
        for (i, &byte) in bytes.iter().enumerate() {
            if byte >= 0x20 && byte != b'"' && byte != b'\\' {
                continue;
            }
            self.out.extend_from_slice(&bytes[done..i]);
            done = i + 1;
            self.escape(byte);
        }
        self.out.extend_from_slice(&bytes[done..]);
        self.out.push(b'"');
    }

    fn escape(&mut self, byte: u8) {
        const HEX: &[u8; 16] = b"0123456789abcdef";
        match byte {
            b'"' | b'\\' => self.out.extend_from_slice(&[b'\\', byte]),
            b'\n' => self.out.extend_from_slice(b"\\n"),
            b'\r' => self.out.extend_from_slice(b"\\r"),
            b'\t' => self.out.extend_from_slice(b"\\t"),
            _ => {
                self.out.extend_from_slice(b"\\u00");
                self.out.push(HEX[usize::from(byte >> 4)]);
                self.out.push(HEX[usize::from(byte & 15)]);
            }
        }
    }
}

/// Without the `.0` of a whole number, which JSON does not ask for.
fn shorten(text: &str) -> &str {
    text.strip_suffix(".0").unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(write: impl FnOnce(&mut Json)) -> String {
        let mut json = Json::with_capacity(0);
        write(&mut json);
        String::from_utf8(json.into_bytes()).unwrap()
    }

    #[test]
    fn commas_stand_between_values_only() {
        let text = written(|json| {
            json.object(|json| {
                json.object_unless_empty("none", |_| {});
                json.array_unless_empty("empty", [0_u64; 0], Json::u64);
                json.key("a").u64(0);
                json.object_unless_empty("none", |_| {});
                json.key("b").array(|json| {
                    json.array(|_| {});
                    json.object(|_| {});
                    json.bool(true);
                });
                json.object_unless_empty("c", |json| json.key("d").f64s(&[1.0, 2.5]));
                json.key("e").u64(u64::MAX);
            });
        });
        let want = r#"{"a":0,"b":[[],{},true],"c":{"d":[1,2.5]},"e":18446744073709551615}"#;
        assert_eq!(text, want);
    }

    #[test]
    fn numbers_read_back_as_they_were_and_are_short() {
        for (value, want) in [
            (1.0, "1"),
            (-0.0, "0"),
            (-2.5, "-2.5"),
            (2_600_123.123_456_789, "2600123.123456789"),
            (f64::NAN, "0"),
            (f64::NEG_INFINITY, "0"),
            (0.1, "0.1"),
        ] {
            assert_eq!(written(|json| json.f64(value)), want);
        }
        for value in [1e300, -1e-300, 5e-324, f64::MAX, 1.0 / 3.0, 1e16, 123_456.0] {
            let text = written(|json| json.f64(value));
            assert_eq!(serde_json::from_str::<f64>(&text).unwrap(), value, "{text}");
        }
        for value in [
            f32::MAX,
            f32::MIN_POSITIVE,
            1e-45,
            0.1,
            16_777_216.0,
            1.0 / 3.0,
        ] {
            let text = written(|json| json.f32(value));
            assert_eq!(serde_json::from_str::<f32>(&text).unwrap(), value, "{text}");
        }
        assert_eq!(written(|json| json.f32(0.1)), "0.1");
        assert_eq!(written(|json| json.field(f64::from(0.8_f32))), "0.8");
        assert_eq!(written(|json| json.field(0.8)), "0.8");
    }

    #[test]
    fn any_text_reads_back_as_it_was() {
        let all: String = (0..=0x2100_u32).filter_map(char::from_u32).collect();
        for text in [
            "",
            "a",
            "\"",
            "\\",
            "tab\there",
            "\u{1f}\u{0}\u{7f}",
            "Tür №5 😀",
            &all,
        ] {
            let json = written(|json| json.str(text));
            assert_eq!(serde_json::from_str::<String>(&json).unwrap(), text);
        }
    }
}
