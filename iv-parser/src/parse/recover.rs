//! Skipping what cannot be read.

use super::Parser;
use crate::lex;

impl Parser<'_> {
    /// Skips one token that fits nowhere: a string, a word, or a single character.
    pub(super) fn skip_junk(&mut self) {
        self.at = match self.peek() {
            None => self.at,
            Some(b'"') => self.quoted().1,
            Some(_) => lex::word(self.bytes, self.at).max(self.at + 1),
        };
    }

    /// Skips to behind the brace that closes the body we are in; strings and comments may hold
    /// braces.
    pub(super) fn skip_body(&mut self) {
        let mut depth = 1usize;
        while let Some(b) = self.peek() {
            match b {
                b'#' => self.at = lex::skip_comment(self.bytes, self.at),
                b'"' => self.at = self.quoted().1,
                b'{' => {
                    depth += 1;
                    self.at += 1;
                }
                b'}' => {
                    depth -= 1;
                    self.at += 1;
                    if depth == 0 {
                        return;
                    }
                }
                _ => self.at += 1,
            }
        }
    }
}
