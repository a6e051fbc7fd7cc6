use super::{Mistake, Tally};
use crate::algebraic::field::{FieldBuilder, Number};

/// Reads the entries of a literal from left to right.
pub(super) struct Scanner<'a> {
    text: &'a str,
    at: usize,
    pub tally: Tally,
    pub builder: FieldBuilder,
}

impl<'a> Scanner<'a> {
    pub fn new(text: &'a str, at: usize) -> Self {
        Self { text, at, tally: Tally::default(), builder: FieldBuilder::new() }
    }

    pub fn position(&self) -> usize {
        self.at
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// Skips white space, continuation dots and comments; true when a line ended.
    pub fn skip_blanks(&mut self) -> bool {
        let mut new_line = false;
        loop {
            let rest = self.rest();
            if rest.starts_with("...") || rest.starts_with(['%', '#']) {
                let continued = rest.starts_with('.');
                self.at += rest.find('\n').map_or(rest.len(), |i| if continued { i + 1 } else { i });
            } else if let Some(c) = rest.chars().next().filter(|c| c.is_whitespace()) {
                new_line |= c == '\n';
                self.at += c.len_utf8();
            } else {
                return new_line;
            }
        }
    }

    pub fn accept(&mut self, c: char) -> bool {
        self.skip_blanks();
        let found = self.rest().starts_with(c);
        if found {
            self.at += c.len_utf8();
        }
        found
    }

    pub fn expect(&mut self, c: char) -> Result<(), Mistake> {
        if self.accept(c) {
            return Ok(());
        }
        let found = self.rest().chars().next().map_or("the end of the text".to_owned(), |c| format!("`{c}`"));
        Err(Mistake::new("syntax", self.at, format!("`{c}` is expected here, not {found}")))
    }

    /// What may follow the matrix: closing brackets of a call, a semicolon.
    pub fn finish(&mut self) -> Result<(), Mistake> {
        loop {
            self.skip_blanks();
            match self.rest().chars().next() {
                None => return Ok(()),
                Some(')' | ';') => self.at += 1,
                Some(c) => return Err(Mistake::new("syntax", self.at, format!("`{c}` comes after the matrix"))),
            }
        }
    }

    /// An entry, white space allowed.
    pub fn expression(&mut self) -> Result<Number, Mistake> {
        self.entry(false)
    }

    /// An entry without white space outside of brackets: `1/2`, `-3`, `(1 + 2)/4`.
    pub fn tight_entry(&mut self) -> Result<Number, Mistake> {
        self.entry(true)
    }

    fn entry(&mut self, tight: bool) -> Result<Number, Mistake> {
        self.skip_blanks();
        let (value, end) = self.tally.entry(&mut self.builder, self.text, self.at, tight)?;
        self.at = end;
        Ok(value)
    }
}
