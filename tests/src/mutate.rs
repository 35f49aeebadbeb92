//! Broken variants of good files: the same ones for the same seed.

/// Marsaglia's xorshift64: enough to vary inputs, nothing else.
#[derive(Clone, Debug)]
pub struct Rng(u64);

impl Rng {
    /// From any seed.
    pub fn new(seed: u64) -> Self {
        // Zero is the one state it never leaves.
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// The next number.
    pub fn number(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// A number below `n`; 0 when `n` is 0.
    pub fn below(&mut self, n: usize) -> usize {
        if n == 0 {
            0
        } else {
            (self.number() % n as u64) as usize
        }
    }
}

/// Numbers that break arithmetic, counts and indices.
const NUMBERS: &[&str] = &[
    "0",
    "-1",
    "-2",
    "1e38",
    "1e39",
    "-1e300",
    "1e-320",
    "1e400",
    "-1e400",
    "2147483647",
    "-2147483648",
    "4294967295",
    "4294967296",
    "99999999999999999999",
    "1.#QNAN",
    "-1.#IND",
    "1.#INF",
    "nan",
    "inf",
    "0x7fffffff",
    "0xffffffff",
    "0x",
    "010",
    "09",
    ".",
    "-",
    "1e",
    "1e+",
    "3.4028235e38",
    "1.17e-38",
    "65535",
    "65536",
    "1000000000",
    "1.5.5",
    "--1",
];

/// Words that mean something to the parser or to a field.
const WORDS: &[&str] = &[
    "DEF",
    "USE",
    "NULL",
    "fields",
    "isA",
    "TRUE",
    "false",
    "{",
    "}",
    "[",
    "]",
    "(",
    ")",
    "\"",
    "\\\"",
    "~",
    "=",
    ".",
    ",",
    "#",
    "|",
    "Separator",
    "Array",
    "Switch",
    "IndexedFaceSet",
    "vertexProperty",
    "PER_VERTEX_INDEXED",
    "DEF A",
    "USE A",
    "alternateRep",
    "\0",
    "\u{feff}",
];

/// One mutation after another, a few for each input.
pub fn mutate(rng: &mut Rng, input: &[u8], others: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = input.to_vec();
    for _ in 0..=rng.below(4) {
        mutate_once(rng, &mut bytes, others);
    }
    bytes
}

fn mutate_once(rng: &mut Rng, bytes: &mut Vec<u8>, others: &[Vec<u8>]) {
    let at = rng.below(bytes.len() + 1);
    match rng.below(9) {
        0 if at < bytes.len() => bytes[at] ^= 1 << rng.below(8),
        1 => bytes.truncate(at),
        2 => swap_tokens(rng, bytes),
        3 | 4 => {
            let number = NUMBERS[rng.below(NUMBERS.len())];
            replace_token(rng, bytes, number, |b| b.is_ascii_digit() || b == b'-');
        }
        5 => {
            let word = WORDS[rng.below(WORDS.len())];
            replace_token(rng, bytes, word, |b| !b.is_ascii_digit());
        }
        6 => double_brace(rng, bytes),
        7 => {
            let end = (at + rng.below(40)).min(bytes.len());
            bytes.drain(at..end);
        }
        _ => splice(rng, bytes, at, others),
    }
}

/// Ranges of the tokens: what stands between blanks, or a bracket alone.
fn tokens(bytes: &[u8]) -> Vec<(usize, usize)> {
    let mut tokens = Vec::new();
    let mut start = None;
    for (i, b) in bytes.iter().enumerate() {
        let ends = b.is_ascii_whitespace() || b"{}[](),".contains(b);
        if ends && let Some(s) = start.take() {
            tokens.push((s, i));
        }
        if ends && !b.is_ascii_whitespace() {
            tokens.push((i, i + 1));
        } else if !ends && start.is_none() {
            start = Some(i);
        }
    }
    tokens.extend(start.map(|s| (s, bytes.len())));
    tokens
}

fn swap_tokens(rng: &mut Rng, bytes: &mut Vec<u8>) {
    let tokens = tokens(bytes);
    let (i, j) = (rng.below(tokens.len()), rng.below(tokens.len()));
    let (Some(&a), Some(&b)) = (tokens.get(i.min(j)), tokens.get(i.max(j))) else {
        return;
    };
    if a.1 > b.0 {
        return;
    }
    let (first, second) = (bytes[a.0..a.1].to_vec(), bytes[b.0..b.1].to_vec());
    bytes.splice(b.0..b.1, first);
    bytes.splice(a.0..a.1, second);
}

fn replace_token(rng: &mut Rng, bytes: &mut Vec<u8>, by: &str, of_kind: impl Fn(u8) -> bool) {
    let tokens = tokens(bytes);
    let kind: Vec<_> = tokens.iter().filter(|t| of_kind(bytes[t.0])).collect();
    if let Some(&&(start, end)) = kind.get(rng.below(kind.len())) {
        bytes.splice(start..end, by.bytes());
    }
}

fn double_brace(rng: &mut Rng, bytes: &mut Vec<u8>) {
    let braces: Vec<usize> = (0..bytes.len())
        .filter(|&i| b"{}[]()\"".contains(&bytes[i]))
        .collect();
    if let Some(&at) = braces.get(rng.below(braces.len())) {
        let brace = bytes[at];
        if rng.below(3) == 0 {
            bytes.remove(at);
        } else {
            bytes.insert(at, brace);
        }
    }
}

fn splice(rng: &mut Rng, bytes: &mut Vec<u8>, at: usize, others: &[Vec<u8>]) {
    let Some(other) = others.get(rng.below(others.len())) else {
        return;
    };
    let start = rng.below(other.len());
    let end = (start + rng.below(400)).min(other.len());
    bytes.splice(at..at, other[start..end].iter().copied());
}
