//! Inventor text being laid out: nodes, fields, numbers and strings. Knows no class.

/// Text in the making.
#[derive(Default)]
pub(super) struct Text {
    out: Vec<u8>,
    depth: usize,
    floats: zmij::Buffer,
}

/// A number as a field holds it.
#[derive(Clone, Copy)]
pub(super) enum Number {
    /// Shortest text that reads back to this f64.
    F64(f64),
    /// Shortest text that reads back to this f32.
    F32(f32),
}

impl Number {
    /// Inventor's own fields are f32: what is one is written as one.
    pub(super) fn field(value: f64) -> Self {
        let narrow = value as f32;
        if f64::from(narrow) == value {
            Self::F32(narrow)
        } else {
            Self::F64(value)
        }
    }
}

impl Text {
    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.out
    }

    pub(super) fn indent_by(&mut self, depth: usize) {
        self.depth += depth;
    }

    pub(super) fn raw(&mut self, text: &str) {
        self.out.extend_from_slice(text.as_bytes());
    }

    fn pad(&mut self) {
        const BLANKS: &[u8] = b"                                ";
        let width = (2 * self.depth).min(BLANKS.len());
        self.out.extend_from_slice(&BLANKS[..width]);
    }

    /// `DEF name Class {` on a line of its own.
    pub(super) fn open(&mut self, def: Option<&str>, class: &str) {
        self.pad();
        self.begin(def, class);
    }

    fn begin(&mut self, def: Option<&str>, class: &str) {
        if let Some(name) = def {
            self.raw("DEF ");
            self.raw(name);
            self.raw(" ");
        }
        self.raw(class);
        self.raw(" {\n");
        self.depth += 1;
    }

    pub(super) fn close(&mut self) {
        self.depth = self.depth.saturating_sub(1);
        self.pad();
        self.raw("}\n");
    }

    /// `field DEF name Class {`, for a node in a field.
    pub(super) fn open_field(&mut self, field: &str, class: &str) {
        self.key(field);
        self.begin(None, class);
    }

    pub(super) fn use_node(&mut self, name: &str) {
        self.pad();
        self.raw("USE ");
        self.raw(name);
        self.raw("\n");
    }

    fn key(&mut self, field: &str) {
        self.pad();
        self.raw(field);
        self.raw(" ");
    }

    pub(super) fn word(&mut self, field: &str, word: &str) {
        self.key(field);
        self.raw(word);
        self.raw("\n");
    }

    /// The only escape of Inventor's strings is that of the quote. Before a line end it is none
    /// (what lets a text end in a backslash), so a blank goes between.
    pub(super) fn string(&mut self, field: &str, value: &str) {
        self.key(field);
        self.raw("\"");
        let escaped = value.replace('"', "\\\"");
        let apart = escaped.replace("\"\n", "\" \n").replace("\"\r", "\" \r");
        self.raw(&apart);
        self.raw("\"\n");
    }

    pub(super) fn numbers(&mut self, field: &str, values: impl IntoIterator<Item = f64>) {
        self.key(field);
        for (i, value) in values.into_iter().enumerate() {
            self.raw(if i == 0 { "" } else { " " });
            self.number(Number::field(value));
        }
        self.raw("\n");
    }

    /// Numbers at full width, as transforms need them.
    pub(super) fn exact_numbers(&mut self, field: &str, values: &[f64]) {
        self.key(field);
        for (i, &value) in values.iter().enumerate() {
            self.raw(if i == 0 { "" } else { " " });
            self.number(Number::F64(value));
        }
        self.raw("\n");
    }

    /// A list of values of `N` numbers each, one on a line.
    pub(super) fn list<const N: usize>(
        &mut self,
        field: &str,
        values: impl IntoIterator<Item = [Number; N]>,
    ) {
        self.key(field);
        self.raw("[ ");
        self.depth += 1;
        for (i, value) in values.into_iter().enumerate() {
            if i > 0 {
                self.raw(",\n");
                self.pad();
            }
            for (k, number) in value.into_iter().enumerate() {
                self.raw(if k == 0 { "" } else { " " });
                self.number(number);
            }
        }
        self.depth -= 1;
        self.raw(" ]\n");
    }

    /// A list of indices; `None` ends a face or line, and a line of the text.
    pub(super) fn indices(&mut self, field: &str, values: impl IntoIterator<Item = Option<u32>>) {
        self.key(field);
        self.raw("[ ");
        self.depth += 1;
        let mut before = None;
        for value in values {
            match before {
                None => {}
                Some(None) => {
                    self.raw(",\n");
                    self.pad();
                }
                Some(Some(_)) => self.raw(", "),
            }
            match value {
                Some(index) => self.whole(i64::from(index)),
                None => self.raw("-1"),
            }
            before = Some(value);
        }
        self.depth -= 1;
        self.raw(" ]\n");
    }

    /// Words separated by blanks, for pixels.
    pub(super) fn words(&mut self, field: &str, words: impl IntoIterator<Item = String>) {
        self.key(field);
        self.depth += 1;
        for (i, word) in words.into_iter().enumerate() {
            match i {
                0 => {}
                _ if i % 16 == 3 => {
                    self.raw("\n");
                    self.pad();
                }
                _ => self.raw(" "),
            }
            self.raw(&word);
        }
        self.depth -= 1;
        self.raw("\n");
    }

    fn whole(&mut self, value: i64) {
        self.raw(&value.to_string());
    }

    /// 0 for what no text can say.
    fn number(&mut self, number: Number) {
        let value = match number {
            Number::F64(value) => value,
            Number::F32(value) => f64::from(value),
        };
        // Below 2^53 every whole number is exact in f64.
        let is_whole = value.fract() == 0.0 && value.abs() < 9_007_199_254_740_992.0;
        if !value.is_finite() {
            self.raw("0");
        } else if is_whole && !(value == 0.0 && value.is_sign_negative()) {
            self.whole(value as i64);
        } else {
            let text = match number {
                Number::F64(value) => self.floats.format_finite(value),
                Number::F32(value) => self.floats.format_finite(value),
            };
            self.out.extend_from_slice(text.as_bytes());
        }
    }
}
