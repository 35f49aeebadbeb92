//! The items that binary files are made of: words of four bytes, and strings.

use crate::lex;

/// Longest name of a class or a field.
const LONGEST_NAME: usize = 255;

/// Bytes with a place to read from.
#[derive(Clone, Copy, Debug)]
pub struct Words<'a> {
    bytes: &'a [u8],
    pub at: usize,
}

impl<'a> Words<'a> {
    pub fn new(bytes: &'a [u8], at: usize) -> Self {
        Self { bytes, at }
    }

    /// How many bytes follow.
    pub fn left(&self) -> usize {
        self.bytes.len().saturating_sub(self.at)
    }

    /// The same bytes from another place.
    pub fn from(&self, at: usize) -> Self {
        Self { at, ..*self }
    }

    /// The next `len` bytes.
    pub fn take(&mut self, len: usize) -> Option<&'a [u8]> {
        let taken = self.bytes.get(self.at..)?.get(..len)?;
        self.at += len;
        Some(taken)
    }

    /// The next `count` items of `size` bytes.
    pub fn items(&mut self, count: usize, size: usize) -> Option<&'a [u8]> {
        self.take(count.checked_mul(size)?)
    }

    pub fn word(&mut self) -> Option<u32> {
        let taken = self.take(4)?;
        Some(u32::from_be_bytes(taken.try_into().ok()?))
    }

    /// A count of things that take at least `size` bytes each, all of which are there.
    pub fn count(&mut self, size: usize) -> Option<u32> {
        let count = self.word()?;
        let needed = (count as usize).checked_mul(size)?;
        (needed <= self.left()).then_some(count)
    }

    /// A string: its length, its bytes, and zeros up to the next multiple of four. Goes past
    /// nothing if there is none.
    pub fn string(&mut self) -> Option<&'a [u8]> {
        let mut ahead = *self;
        let len = ahead.word()? as usize;
        let padded = len.checked_next_multiple_of(4)?;
        let taken = ahead.take(padded)?;
        *self = ahead;
        Some(&taken[..len])
    }

    /// A string that can be the name of a class, a field or a type. Goes past nothing if there is
    /// none.
    pub fn name(&mut self) -> Option<&'a [u8]> {
        // Most places that are tried hold no name: the length alone tells.
        let len = self.from(self.at).word()? as usize;
        if !(1..=LONGEST_NAME).contains(&len) {
            return None;
        }
        let mut ahead = *self;
        let name = ahead.string().filter(|name| is_name(name))?;
        *self = ahead;
        Some(name)
    }

    /// Goes past the string if it is the one here.
    pub fn skip_string(&mut self, wanted: &[u8]) -> bool {
        let mut next = *self;
        let found = next.string() == Some(wanted);
        if found {
            *self = next;
        }
        found
    }
}

/// Whether text would read this as one identifier.
pub fn is_name(bytes: &[u8]) -> bool {
    lex::name(bytes, 0) == Some(bytes.len())
}

/// Whether text would read this as one word without quotes that means nothing else.
pub fn is_plain_word(bytes: &[u8]) -> bool {
    const OTHERS: [&[u8]; 3] = [b"DEF", b"USE", b"NULL"];
    const NUMBERS: [&[u8]; 4] = [b"nan", b"inf", b"infinity", b"ind"];
    let is_number = NUMBERS.iter().any(|n| bytes.eq_ignore_ascii_case(n));
    is_name(bytes) && !OTHERS.contains(&bytes) && !is_number
}
